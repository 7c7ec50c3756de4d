//! Paths and emulators of walls whose formula is known.

use nalgebra::{DMatrix, DVector};

use crate::critic::simulate::bank::emulator::Emulator;
use crate::critic::simulate::bank::path::{Curves, NUMBERS, PLACES, Path, TILTED};
use crate::critic::simulate::bank::{Bank, NotThisBank, Plan, Test};
use crate::critic::tests::fallen;
use crate::ensemble::{Row, StepRow, TopStep};
use crate::math::radians;
use crate::random::Streams;
use crate::random::standard_normal;
use crate::study::{Described, Nuisance, Study, described, nuisances};

/// The nine walls, the catalogue and the priors of the joints.
pub fn shipped() -> (Study, Vec<Described>, [Nuisance; 3]) {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let study =
        Study::load(&root.join("studies/tilting-table"), None).unwrap_or_else(|f| panic!("{f}")).study;
    let distributions = root.join("distributions");
    let mechanisms = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
    (study, mechanisms, nuisances(&distributions).unwrap_or_else(|lacks| panic!("{lacks}")))
}

/// Displacements (m) at a tilt of a wall that falls at another (deg): compliance, and a parabola's corner at the end.
fn formula(tilt: f64, collapse: f64) -> [f64; 3] {
    let mean = 2e-4 * tilt + 6e-3 * (1.0 - (1.0 - tilt / collapse).sqrt());
    [0.9 * mean, 1.2 * mean, 0.9 * mean].map(|x| x + 1e-5 * tilt)
}

fn wall(collapse: f64, step: f64) -> Row {
    let like = fallen(0, 0, collapse);
    let at = |tilt: f64| {
        let [left, centre, right] = formula(tilt, collapse).map(Some);
        let top = TopStep {
            left_m: left,
            centre_m: centre,
            right_m: right,
            left_remainder_m: left.map(|x| 0.1 * x),
            centre_remainder_m: centre.map(|x| 0.2 * x),
            right_remainder_m: right.map(|x| 0.1 * x),
            ..like.load_steps[0].top
        };
        StepRow { tilt_deg: Some(tilt), top, ..like.load_steps[0].clone() }
    };
    let mut load_steps: Vec<StepRow> =
        (0..).map(|k| f64::from(k) * step).take_while(|tilt| *tilt < collapse).map(at).collect();
    load_steps.push(at(collapse));
    Row { load_steps, ..like }
}

#[test]
fn a_path_tells_what_was_read_between_its_steps() {
    for collapse in [9.3, 17.8, 24.0] {
        let path = Curves::of(&Path::of(&wall(collapse, 2.5)).expect("it fell").adding());
        assert!((path.collapse() - radians(collapse)).abs() < 1e-12);
        for share in [0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.98] {
            let tilt = share * collapse;
            let found = path.displacements(radians(tilt)).expect("it stands");
            for (found, exact) in found.iter().zip(formula(tilt, collapse)) {
                // Cubics between steps of 2.5 deg and then between six places; the corner's last two per cent are the worst.
                let allowed = if share > 0.95 { 0.03 } else { 0.012 };
                assert!(
                    (found / exact - 1.0).abs() < allowed,
                    "{tilt} of {collapse}: {found:e} against {exact:e}"
                );
            }
            let [left, centre, right] = formula(tilt, collapse);
            let left = [0.1 * left, 0.2 * centre, 0.1 * right];
            for (found, exact) in path.remainders(radians(tilt)).expect("it stands").iter().zip(left) {
                let allowed = if share > 0.95 { 0.03 } else { 0.012 };
                assert!((found / exact - 1.0).abs() < allowed, "{tilt}: {found:e} left, not {exact:e}");
            }
        }
        assert!(path.displacements(radians(collapse) + 1e-9).is_none());
        assert!(path.remainders(radians(collapse) + 1e-9).is_none());
    }
}

#[test]
fn displacements_are_the_same_one_by_one_and_all_at_once_and_stay_those_of_the_fall() {
    let path = Curves::of(&Path::of(&wall(14.0, 2.5)).expect("it fell").adding());
    // More than are computed at once, up to three degrees beyond the fall.
    let tilts: Vec<f64> = (0..85).map(|k| radians(0.2 * f64::from(k))).collect();
    assert!(path.displacements(tilts[71]).is_none() && path.displacements(tilts[69]).is_some());
    for (tilt, all) in tilts.iter().zip(path.last_displacements(&tilts)) {
        let alone = path.displacements(tilt.min(path.collapse()));
        assert_eq!(alone.map(|points| points.map(f64::to_bits)), Some(all.map(f64::to_bits)), "{tilt}");
    }
}

#[test]
fn a_wall_that_should_not_stand_falls_right_after_its_zero_reading() {
    let mut adding = Path::of(&wall(15.0, 2.5)).expect("it fell").adding();
    assert!((adding[0] - radians(15.0)).abs() < 1e-12);
    // More than it has.
    adding[0] -= radians(18.0);
    let curves = Curves::of(&adding);
    assert!(curves.collapse() > 0.0 && curves.collapse() < radians(0.1));
    assert!(curves.displacements(0.0).is_some() && curves.displacements(radians(0.1)).is_none());
}

#[test]
fn a_wall_that_did_not_fall_has_no_path() {
    let mut stands = wall(20.0, 2.5);
    stands.outcome = crate::model::Outcome::Equilibrium;
    assert!(Path::of(&stands).is_none());
    let mut leans_back = wall(20.0, 2.5);
    for step in &mut leans_back.load_steps {
        (step.top.left_m, step.top.centre_m, step.top.right_m) = (Some(-1e-3), Some(-1e-3), Some(-1e-3));
    }
    assert!(Path::of(&leans_back).is_none());
}

#[test]
fn of_a_wall_that_fell_before_the_platform_could_go_back_nothing_is_left() {
    let mut never_back = wall(20.0, 2.5);
    never_back.load_steps.iter_mut().for_each(|step| step.top.left_remainder_m = None);
    let path = Curves::of(&Path::of(&never_back).expect("it fell").adding());
    assert_eq!(path.remainders(radians(8.0)), Some([0.0; 3]));
    assert!(path.displacements(radians(8.0)).is_some_and(|points| points[0] > 1e-3));
}

/// Scores and paths: the first number is a quadratic of the inputs, the second that and noise, the others are noise.
fn bank(walls: u64) -> (Vec<Vec<f64>>, Vec<[f64; NUMBERS]>) {
    let normal = |stream: &mut crate::random::Stream| standard_normal::quantile(stream.uniform());
    (0..walls)
        .map(|wall| {
            let streams = Streams::new(11, wall);
            let scores: Vec<f64> = (0..3).map(|k| normal(&mut streams.of(&format!("input {k}")))).collect();
            let mut noise = streams.of("noise");
            let mut numbers = [0.0; NUMBERS];
            numbers.iter_mut().for_each(|number| *number = 0.1 * normal(&mut noise));
            let exact = quadratic(&scores);
            (numbers[0], numbers[1]) = (exact, exact + numbers[1]);
            (scores, numbers)
        })
        .unzip()
}

fn quadratic(z: &[f64]) -> f64 {
    0.3 + 0.5 * z[0] - 0.2 * z[1] + 0.1 * z[0] * z[1] - 0.05 * z[2] * z[2]
}

#[test]
fn an_emulator_finds_the_curve_and_knows_what_it_does_not_tell() {
    let (scores, walls) = bank(200);
    let emulator = Emulator::fit(Test::Tilting, &scores, &walls).expect("twenty walls per term");
    let at = [0.7, -1.1, 0.4];
    let (found, exact) = (emulator.emulated(&at, 0).numbers, quadratic(&at));
    // The penalty takes a thousandth; the noise of 0.1 leaves a mean over 200 walls with ten terms some 0.02.
    assert!((found[0] - exact).abs() < 2e-3, "{} against {exact}", found[0]);
    assert!((found[1] - exact).abs() < 0.06, "{} against {exact}", found[1]);
    let explained = emulator.explained();
    // All but what scores beyond 2.5 lose, which are taken to be there.
    assert!(explained[0] > 0.995, "{explained:?}");
    // Variances: the quadratic's 0.25 + 0.04 + 0.01 + 0.005, the noise's 0.01.
    assert!((explained[1] - 0.305 / 0.315).abs() < 0.02, "{explained:?}");
    // A curve through noise alone explains less than nothing of a wall that it does not know.
    assert!(explained[2..TILTED].iter().all(|share| *share < 0.05), "{explained:?}");
    let left: Vec<f64> = emulator.emulated(&at, 50).left.iter().map(|left| left[1]).collect();
    let sigma = crate::stats::sigma(&left).expect("fifty");
    // 0.1, from 50 values and with the error of a curve that does not know the wall: within 3 sigma of sigma.
    assert!((sigma - 0.1).abs() < 0.03, "{sigma}");
}

#[test]
fn of_what_hangs_on_no_input_an_emulator_knows_no_less_than_the_mean() {
    let (scores, walls) = bank(40);
    let emulator = Emulator::fit(Test::Tilting, &scores, &walls).expect("four walls per term");
    // Form and way back are noise: a quadratic of ten terms through forty walls explains some -0.3 of a wall left out.
    let shares = &emulator.explained()[1 + PLACES.len()..];
    assert!(shares.iter().all(|share| *share > -0.1), "{shares:?}");
    // And the fall, in the same walls, is still found.
    assert!(emulator.explained()[0] > 0.95, "{:?}", emulator.explained());
}

#[test]
fn an_emulator_follows_what_begins_in_the_middle_of_a_prior() {
    // Nothing below a threshold of the fourth input, ever more above it, and 1 % of noise; a quadratic is off by 0.1 and more.
    let begins = |z: f64| if z > 0.0 { 0.5 * z } else { 0.0 };
    let (mut scores, mut walls) = bank(120);
    for (wall, (scores, path)) in scores.iter_mut().zip(&mut walls).enumerate() {
        let mut draws = Streams::new(12, wall as u64).of("fourth");
        let [fourth, noise] = [draws.uniform(), draws.uniform()].map(standard_normal::quantile);
        scores.push(fourth);
        *path = [begins(fourth) + 0.01 * noise; NUMBERS];
    }
    let emulator = Emulator::fit(Test::Tilting, &scores, &walls).expect("four walls per term");
    for fourth in [-1.5, -0.8, -0.3, 0.5, 1.0, 1.6] {
        let at = [0.2, -0.4, 0.5, fourth];
        let found = emulator.emulated(&at, 0).numbers[3];
        assert!((found - begins(fourth)).abs() < 0.04, "{fourth}: {found}");
        // What is nearest lies on the same side, and is left with no more than it is off.
        let left: Vec<f64> = emulator.emulated(&at, 20).left.iter().map(|left| left[3]).collect();
        assert!(crate::stats::sigma(&left).expect("twenty") < 0.05, "{fourth}: {left:?}");
    }
}

#[test]
fn what_an_emulator_does_not_know_of_its_curve_is_that_of_a_regression() {
    let (scores, walls) = bank(60);
    let emulator = Emulator::fit(Test::Tilting, &scores, &walls).expect("six walls per term");
    let terms = |z: &[f64]| {
        let z: [f64; 3] = std::array::from_fn(|k| z[k].clamp(-2.5, 2.5));
        let products = [z[0] * z[0], z[0] * z[1], z[0] * z[2], z[1] * z[1], z[1] * z[2], z[2] * z[2]];
        DVector::from_iterator(10, [1.0].into_iter().chain(z).chain(products))
    };
    // Bayes: the coefficients' covariance is the inverse of the walls' information and the prior's 1/10, in units of the noise.
    let information = scores.iter().fold(DMatrix::identity(10, 10) / 10.0, |sum, z| {
        let t = terms(z);
        sum + &t * t.transpose()
    });
    let covariance = information.try_inverse().expect("it is positive");
    for at in [[0.0, 0.0, 0.0], [1.0, -0.5, 0.3], [2.0, 2.0, -2.0]] {
        let t = terms(&at);
        let unknown = t.dot(&(&covariance * &t));
        let common = emulator.emulated(&at, 0).common[0];
        assert!((common - unknown / (1.0 + unknown)).abs() < 1e-9, "{at:?}: {common} against {unknown}");
    }
    // Ten terms of sixty walls leave a sixth of the noise in the mean over the walls, and far more in a corner.
    let [middle, corner] = [[0.0; 3], [2.0, 2.0, -2.0]].map(|at| emulator.emulated(&at, 0).common[0]);
    assert!(middle < 0.1 && corner > 0.4, "{middle} {corner}");
}

#[test]
fn an_emulator_needs_walls() {
    let (scores, walls) = bank(19);
    assert!(Emulator::fit(Test::Tilting, &scores, &walls).is_none());
    let (scores, walls) = bank(20);
    assert!(Emulator::fit(Test::Tilting, &scores, &walls).is_some());
}

#[test]
fn the_nearest_walls_come_first() {
    let (scores, walls) = bank(40);
    let emulator = Emulator::fit(Test::Tilting, &scores, &walls).expect("enough");
    let at = scores[7].clone();
    let whole = emulator.emulated(&at, 40).left;
    assert_eq!(whole.len(), 40);
    assert_eq!(emulator.emulated(&at, 1).left, whole[..1]);
    // What the wall itself is left with: its own number less the curve's, and further by its own pull.
    let own = walls[7][1] - emulator.emulated(&at, 0).numbers[1];
    let ratio = whole[0][1] / own;
    assert!(ratio > 1.0 && ratio < 3.0, "{ratio}");
}

#[test]
fn a_bank_comes_back_from_its_table_and_only_for_its_own_plan() {
    let (plan, other) = (small(10), small(11));
    let rows: Vec<Row> = (0..plan.places.len())
        .map(|wall| if wall % 7 == 3 { standing(wall) } else { wall_of(wall) })
        .collect();
    let bank = Bank::of(&plan, &rows);
    assert!(bank.paths[3].is_none() && bank.paths[4].is_some());
    let bytes = bank.table(&plan).expect("it is written");
    assert_eq!(bytes, bank.table(&plan).expect("it is written"));
    assert_eq!(Bank::read(&bytes, &plan).expect("it is its own"), bank);
    let why = Bank::read(&bytes, &other).expect_err("of eleven points").to_string();
    assert!(why.contains("it has 10 points, wanted are 11: see --points"), "{why}");
    assert!(matches!(Bank::read(b"no table", &plan), Err(NotThisBank::Table(_))));
}

#[test]
fn a_bank_of_more_families_or_points_serves_a_plan_of_fewer() {
    let (study, _, priors) = shipped();
    let of = |families: &[usize], points: u64| {
        Plan::of_families(&study, families, &[], &priors, points).unwrap_or_else(|f| panic!("{f}"))
    };
    let own = of(&[0, 1, 2], 4);
    let bank = Bank::of(&own, &(0..own.places.len()).map(wall_of).collect::<Vec<_>>());
    let bytes = bank.table(&own).expect("it is written");
    let held = Bank::held(&bytes).expect("it is a bank");
    assert_eq!(
        (held.families.into_iter().collect::<Vec<_>>(), held.points),
        (vec!["cbl".into(), "sbl".into(), "sbr".into()], 4)
    );
    for plan in [of(&[1], 4), of(&[0, 2], 3)] {
        let part = bank.part(&own, &plan).expect("it has all of them");
        assert_eq!(part.paths.len(), plan.places.len());
        for (path, place) in part.paths.iter().zip(&plan.places) {
            let at = own.places.iter().position(|other| other == place).expect("the same wall");
            assert_eq!(path, &bank.paths[at]);
        }
    }
    assert_eq!(bank.part(&own, &of(&[0, 1], 5)), None);
    let why = Bank::read(&bytes, &of(&[1], 4)).expect_err("of three families").to_string();
    assert!(why.contains("its walls are of cbl, sbl, sbr, wanted are those of sbl"), "{why}");
    let soft = Study::load(
        &std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-table"),
        Some("random-dips"),
    );
    let soft = soft.unwrap_or_else(|f| panic!("{f}")).study;
    let soft = Plan::of_families(&soft, &[0, 1, 2], &[], &priors, 4).unwrap_or_else(|f| panic!("{f}"));
    let why = Bank::read(&bytes, &soft).expect_err("of other stones").to_string();
    assert!(why.contains("study, priors or version have changed"), "{why}");
}

fn wall_of(number: usize) -> Row {
    wall(10.0 + 0.01 * number as f64, 2.5)
}

fn standing(number: usize) -> Row {
    Row { outcome: crate::model::Outcome::Equilibrium, ..wall_of(number) }
}

fn small(points: u64) -> Plan {
    let (study, _, priors) = shipped();
    Plan::new(&study, &[], &priors, points).unwrap_or_else(|f| panic!("{f}"))
}
