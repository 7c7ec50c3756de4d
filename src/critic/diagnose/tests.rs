//! Campaigns of walls whose formula is known: what is found of what is hidden in them, and whether anything is where nothing is.

use std::sync::OnceLock;

use crate::critic::bank::tests::shipped;
use crate::critic::bank::{Bank, Path, Plan};
use crate::critic::diagnose::{
    Campaign, Causes, Contrast, Design, Doubt, Effort, Feature, Judge, Limits, Reference, Seen, Truth,
    Unused, Verdict, World, doubts, doubts_beside, extension,
};
use crate::math::{ln, radians};
use crate::random::Streams;
use crate::random::standard_normal::quantile;
use crate::stats;
use crate::study::{Described, MeasuredKind, Nuisance, Study};

pub(crate) struct Made {
    pub(crate) study: Study,
    pub(crate) mechanisms: Vec<Described>,
    pub(crate) nuisances: [Nuisance; 3],
    plan: Plan,
    bank: Bank,
}

/// The nine walls, of a bank that no solver made: the collapse angle goes with kn and phi, displacements go with 1/kn, stones make
/// 2 % of difference.
pub(crate) fn made() -> Made {
    let (study, mechanisms, nuisances) = shipped();
    let plan = Plan::new(&study, &mechanisms, &nuisances, 45).unwrap_or_else(|f| panic!("{f}"));
    let path = |wall: usize| {
        let place = &plan.places[wall];
        let [kn, phi, _] = place.joints;
        // A point has the same stones under every cause.
        let mut noise = Streams::new(5, place.point).of(&format!("stones {}", place.family));
        let mut draw = |sd: f64| if place.family == 0 { 0.0 } else { sd * quantile(noise.uniform()) };
        let mut numbers = [0.0; 37];
        numbers[0] = ln(radians([19.0, 14.5, 19.5][place.family])) + 0.05 * kn + 0.01 * phi + draw(0.02);
        let level = draw(0.05);
        for k in 0..6 {
            numbers[1 + k] = ln(0.02) + 0.3 * (1.0 - f64::from(k as u32) / 5.0) - 0.4 * kn + level;
            numbers[7 + k] = if place.family == 2 { 0.4 } else { 0.02 } + draw(0.02);
            numbers[13 + k] = draw(0.05);
        }
        // Two causes that do something: one weakens, one lets the wall move.
        let strength = || 2.0 * place.parameters[0] - 1.0;
        match place.cause.map(|cause| mechanisms[cause].name) {
            Some("lean") => numbers[0] -= 0.2 * strength(),
            Some("creep") => {
                numbers[1..7].iter_mut().for_each(|x| *x += 2.0 * (1.0 + strength()));
                numbers[19..25].iter_mut().for_each(|x| *x += 0.4 * (1.0 + strength()));
            }
            _ => {}
        }
        Some(Path { numbers })
    };
    let paths: Vec<Option<Path>> = (0..plan.places.len()).map(path).collect();
    let endings = vec!["collapsed".to_string(); paths.len()];
    Made { study, mechanisms, nuisances, plan, bank: Bank { paths, endings } }
}

impl Made {
    pub(crate) fn world(&self) -> World<'_> {
        World::new(&self.study, &self.mechanisms, &self.nuisances, &self.plan, &self.bank)
            .expect("enough walls")
    }

    /// Index of a mechanism.
    pub(super) fn cause(&self, name: &str) -> usize {
        self.mechanisms.iter().position(|m| m.name == name).expect("in the catalogue")
    }

    /// The base model as the paper's design sees it.
    fn told(&self) -> (World<'_>, Design, Reference) {
        let (world, (design, _)) = (self.world(), Design::of(&self.study));
        let reference = Reference::new(&world, &design, 1000, 77).expect("it can be told");
        (world, design, reference)
    }
}

/// Enough for a made-up bank of few ways to differ.
pub(super) const EFFORT: Effort = Effort { reference: 1000, training: 300 };

/// The nine walls and who judges campaigns of the paper's design: he is trained once for all tests that ask him.
pub(super) fn judged() -> (&'static Made, &'static Judge<'static>) {
    static MADE: OnceLock<Made> = OnceLock::new();
    static WORLD: OnceLock<World<'static>> = OnceLock::new();
    static JUDGE: OnceLock<Judge<'static>> = OnceLock::new();
    let made = MADE.get_or_init(made);
    let world = WORLD.get_or_init(|| made.world());
    let (design, _) = Design::of(&made.study);
    (made, JUDGE.get_or_init(|| Judge::trained(world, &design, EFFORT, 5).expect("it can be told")))
}

#[test]
fn little_is_found_where_nothing_is_hidden_also_with_joints_far_out_in_their_priors() {
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let judge = Judge::trained(&world, &design, EFFORT, 77).expect("it can be told");
    let found = |far: f64, seed: u64| {
        let wrong = |k: u64| {
            let streams = Streams::new(seed, k);
            let mut truth = world.stated(&streams);
            truth.joints.iter_mut().filter(|_| far > 0.0).for_each(|joints| joints[0] = far);
            judge.seeming(&world.campaign(&design, &truth, &streams)).p_value < 0.05
        };
        (0..300).filter(|&k| wrong(k)).count()
    };
    let (within, beyond) = (found(0.0, 78), found(2.0, 79));
    println!("{within} and {beyond} of 300");
    // 5 % of 300 are 15 +- 3.8; three sigma of it, and of the 1,000 that set the limit. With joints as they are stated, and
    // doubted further than that, it is less.
    assert!(within <= 28, "{within}");
    // kn lies two of its standard deviations from where it is thought to be: the joints take it up.
    assert!(beyond <= 40, "{beyond}");
}

#[test]
fn a_family_that_moves_four_times_too_far_is_found_and_said_to() {
    let made = made();
    let (world, design, reference) = made.told();
    let streams = Streams::new(3, 3);
    let truth = world.drawn(None, &streams);
    let mut campaign = world.campaign(&design, &truth, &streams);
    for (specimen, seen) in design.specimens.iter().zip(&mut campaign.specimens) {
        for (m, seen) in specimen.readings.iter().zip(seen).filter(|(m, _)| m.tilt.is_some()) {
            if let (true, Seen::Value(value)) = (made.study.arms[specimen.family].name == "sbl", &*seen) {
                *seen = Seen::of(4.0 * value, m);
            }
        }
    }
    let wrong = reference.judge(&design, &campaign);
    // One in 100,000 by chance for one feature, of some thirty.
    assert!(wrong.largest() > 4.5, "{}", wrong.largest());
    let worst = wrong
        .excess
        .iter()
        .filter_map(|(f, x)| Some((*f, (*x)?)))
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let sbl = made.study.arms.iter().position(|arm| arm.name == "sbl").expect("a family");
    let (feature, excess) = worst.expect("something is shown");
    assert!(
        matches!(feature, Feature::Mean(family, Contrast::Level | Contrast::Growth | Contrast::Curvature) if family == sbl)
    );
    assert!(excess > 0.0 || !matches!(feature, Feature::Mean(_, Contrast::Level)), "{feature:?} {excess}");
}

#[test]
fn strong_causes_are_named_and_those_that_do_nothing_are_not() {
    let (made, judge) = judged();
    let test = judge.self_test(&Limits::default(), 100, 4, 6);
    let of = |name: &str| {
        let row =
            test.rows.iter().find(|row| row.cause.is_some_and(|cause| made.mechanisms[cause].name == name));
        row.cloned().expect("it can act")
    };
    let (creep, nothing) = (of("creep"), of("cohesion"));
    println!("{creep:?}\n{nothing:?}\n{:?}", test.rows[0]);
    // The level of all displacements up to e^4 times as large, and only that.
    assert!(creep.all.found > 70 && creep.all.named > 50, "{creep:?}");
    // The strongest third is found and named more often; of the base model none is.
    assert!(creep.strong.campaigns == 33 && 100 * creep.strong.named > 33 * creep.all.named, "{creep:?}");
    assert_eq!(test.rows[0].strong.campaigns, 0);
    // All that a diagnosis does is asked of the first four, and of twenty without any effect.
    assert_eq!((creep.judged.campaigns, test.rows[0].judged.campaigns), (4, 20));
    assert!(creep.judged.named > 0 && test.rows[0].judged.named == 0, "{:?}", creep.judged);
    assert!(test.rows[0].judged.misnamed < 2, "{:?}", test.rows[0].judged);
    // It looks like the base model: found as often as that is, and never named.
    assert!(nothing.all.found < 15 && nothing.all.named == 0 && nothing.all.misnamed < 5, "{nothing:?}");
    assert!(test.rows[0].cause.is_none() && test.rows[0].all.found < 15 && test.rows[0].all.misnamed < 3);
    // What has no name is not given one, by looks or by all that a diagnosis does.
    let [seem, judged] = test.nameless;
    println!("nameless: {seem:?} {judged:?}");
    assert_eq!((seem.campaigns, judged.campaigns), (100, 20));
    // The paper's few readings show a third of it.
    assert!(seem.found > 15 && seem.misnamed < 6 && judged.misnamed < 3, "{seem:?} {judged:?}");
    // Nine in ten of the sets hold the cause; 95 % of 100 such counts are above 84, and those found are a choice of them.
    assert!(creep.covered as f64 > 0.8 * creep.all.found as f64, "{creep:?}");
}

#[test]
fn what_is_like_no_cause_is_seen_to_be_nameless() {
    let (made, judge) = judged();
    let (world, design) = (judge.world, &judge.design);
    let creep = Some(made.cause("creep"));
    // Mean probability over the campaigns, drawn with another seed than the judge's, in which something is found.
    let nameless = |campaign: &dyn Fn(&Streams) -> Campaign| {
        let seeming = (0..100).map(|k| judge.seeming(&campaign(&Streams::new(43, k))));
        let found: Vec<f64> = seeming
            .filter(|seeming| seeming.p_value < 0.05)
            .map(|seeming| {
                let sum = seeming.ranked.causes.iter().fold(seeming.ranked.nameless, |sum, (_, p)| sum + p);
                assert!((sum - 1.0).abs() < 1e-9, "{sum}");
                seeming.ranked.nameless
            })
            .collect();
        stats::mean(&found).expect("some are found")
    };
    let own = nameless(&|streams| world.campaign(design, &world.drawn(creep, streams), streams));
    let others = nameless(&|streams| world.nameless(design, streams));
    println!("{own} of creep, {others} of others");
    // 0.06 and 0.30: the paper's few readings leave it mostly open what they show.
    assert!(own < 0.12 && others > 0.2, "{own} {others}");
}

#[test]
fn a_cause_outside_the_catalogue_is_not_given_the_name_of_one_inside() {
    let (made, judge) = judged();
    let (world, design) = (judge.world, &judge.design);
    let limits = Limits::default();
    let creep = made.cause("creep");
    let (mut right, mut wrongly, mut unexplained) = (0, 0, 0);
    for k in 0..10 {
        let streams = Streams::new(31, k);
        let mut truth = world.drawn(Some(creep), &streams);
        truth.parameters[0] = 1.5;
        let shown = world.campaign(design, &truth, &streams);
        right += usize::from(judge.diagnosed(&shown, &limits, 1).verdict.named() == [creep]);
        // One specimen of each family moves, and far; creep would move all of them.
        let base = world.drawn(None, &streams);
        let mut other = world.campaign(design, &base, &streams);
        for (specimen, seen) in design.specimens.iter().zip(&mut other.specimens) {
            for (m, seen) in specimen.readings.iter().zip(seen).filter(|(m, _)| m.tilt.is_some()) {
                if let (true, Seen::Value(value)) = (specimen.name.ends_with('1'), &*seen) {
                    *seen = Seen::of(value + 0.15, m);
                }
            }
        }
        match judge.diagnosed(&other, &limits, 1).verdict {
            Verdict::Unexplained => unexplained += 1,
            verdict if !verdict.named().is_empty() => wrongly += 1,
            _ => {}
        }
    }
    println!("{right} of 10 named; of the others {wrongly} named, {unexplained} unexplained");
    // 37 of 40 are named, and none of 40 others.
    assert!(right > 6, "{right}");
    assert!(wrongly < 2 && unexplained > 6, "{wrongly} {unexplained}");
}

#[test]
fn two_causes_that_act_together_are_named_together_and_one_alone_is_not() {
    let (made, judge) = judged();
    let (world, design) = (judge.world, &judge.design);
    let (creep, lean) = (made.cause("creep"), made.cause("lean"));
    let pair = Causes::pair(creep, lean);
    assert_eq!((pair, pair.each().collect::<Vec<_>>()), (Causes::pair(lean, creep), vec![lean, creep]));
    let (mut together, mut named, mut alone) = (0, 0, 0);
    for k in 0..8 {
        let streams = Streams::new(37, k);
        let mut truth = world.drawn(pair, &streams);
        // The wall leans downhill, and creeps: it moves far and falls early.
        truth.parameters[..2].copy_from_slice(&[1.5, 1.5]);
        let shown = world.campaign(design, &truth, &streams);
        let found = judge.diagnosed(&shown, &Limits::default(), 1);
        println!("{:?} {:?}", found.verdict, found.pairs.first().map(|pair| (pair.evidence, pair.guard)));
        // Where one of the two explains all that can be told, it is named alone.
        let best = found.pairs.first().map(|best| best.cause);
        together += usize::from(best.map_or(found.verdict.named() == [creep], |best| best == [lean, creep]));
        named += usize::from(found.verdict == Verdict::NamedPair([lean, creep]));
        if let Verdict::NamedPair(_) = found.verdict {
            let [(causes, draws)] = &found.explained_by()[..] else { panic!("the pair") };
            assert_eq!(
                (&causes[..], draws[0].parameters.len()),
                (&[lean, creep][..], truth.parameters.len())
            );
        }
        let one = world.campaign(
            design,
            &Truth { causes: Some(creep).into(), parameters: truth.parameters[1..].to_vec(), ..truth },
            &streams,
        );
        alone += usize::from(matches!(
            judge.diagnosed(&one, &Limits::default(), 1).verdict,
            Verdict::NamedPair(_)
        ));
    }
    println!(
        "{together} of 8 best together or one of them named, {named} named together, {alone} of 8 alone"
    );
    assert!(together == 8 && named > 0 && alone == 0, "{together} {named} {alone}");
}

#[test]
fn an_extension_is_the_median_of_its_truths_and_draws_from_all_of_them() {
    let made = made();
    let world = made.world();
    let friction = made.mechanisms.iter().position(|m| m.name == "friction").expect("it is one");
    let truths: Vec<Truth> = (0..61).map(|k| world.drawn(Some(friction), &Streams::new(3, k))).collect();
    let found = extension(&world, &truths).expect("there are truths");
    let row = |truth: &Truth| (world.parameters(truth), [0, 1, 2].map(|family| world.factors(truth, family)));
    let middle = |of: &dyn Fn(&Truth) -> f64| {
        let mut values: Vec<f64> = truths.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values[30]
    };
    let keys: Vec<&str> = found.median.acting[0].parameters.iter().map(|(key, _)| *key).collect();
    assert_eq!(
        (found.median.acting[0].mechanism, &keys[..]),
        ("friction", &["factor", "residual_share", "slip_distance_m"][..])
    );
    for (k, (_, value)) in found.median.acting[0].parameters.iter().enumerate() {
        assert_eq!(*value, middle(&|truth| row(truth).0[k]));
    }
    for (family, factors) in &found.median.joints {
        assert_eq!(*factors, [0, 1, 2].map(|k| middle(&|truth| row(truth).1[*family][k])));
    }
    // Draws keep together what belongs together: the first, the fourth, ... and one near the end.
    assert_eq!(found.draws.len(), 20);
    for (draw, at) in found.draws.iter().zip((0..20).map(|k| k * 61 / 20)) {
        let values: Vec<f64> = draw.acting[0].parameters.iter().map(|(_, value)| *value).collect();
        let factors: Vec<[f64; 3]> = draw.joints.iter().map(|(_, factors)| *factors).collect();
        assert_eq!((values, &factors[..]), (row(&truths[at]).0, &row(&truths[at]).1[..]));
    }
    // kn of the slightly irregular stones is 5e7 by its factor.
    let known = found.known.iter().find(|known| known.key == "arm.sbl.joint.kn_pa_per_m").expect("it varies");
    assert_eq!(known.median, 5e7 * found.median.joints[1].1[0]);
    assert!(known.interval[0] < known.median && known.median < known.interval[1]);
    assert_eq!(extension(&world, &truths[..3]).map(|few| few.draws.len()), Some(3));
    assert_eq!(extension(&world, &[]), None);
    let both = world.drawn(Causes::pair(friction, made.cause("density")), &Streams::new(3, 0));
    let both = extension(&world, &[both]).expect("there is one").median;
    let names: Vec<(&str, usize)> =
        both.acting.iter().map(|own| (own.mechanism, own.parameters.len())).collect();
    assert_eq!(names, [("friction", 3), ("density", 1)]);
    assert_eq!(extension(&world, &[world.drawn(None, &Streams::new(3, 0))]), None);
}

#[test]
fn what_a_cause_moves_is_nothing_where_it_does_nothing_and_more_the_stronger_it_is() {
    let made = made();
    let (world, design, reference) = made.told();
    let shift = |name: &str, score: f64| {
        let mut truth = world.drawn(Some(made.cause(name)), &Streams::new(61, 0));
        truth.parameters.iter_mut().for_each(|own| *own = score);
        // Joints far out, where a straight fit of them errs.
        truth.joints.iter_mut().for_each(|joints| joints[0] = 2.0);
        reference.shift(&world, &design, &truth, 100, 62)
    };
    // In the made-up bank cohesion does nothing; what is left is the emulator's.
    let [nothing, weak, strong] = [shift("cohesion", 1.5), shift("creep", -1.0), shift("creep", 1.5)];
    assert!(nothing < 0.3 && weak > 2.0 * nothing && strong > 2.0 * weak, "{nothing} {weak} {strong}");
}

#[test]
fn a_zero_reading_is_not_used_and_one_that_is_said_so() {
    let mut made = made();
    let zero = made.study.measured.iter().find(|m| m.specimen == "SBL2" && m.tilt.is_some());
    let mut zero = zero.expect("it was read").clone();
    (zero.tilt, zero.value, zero.error, zero.line) = (Some(0.0), 0.0, 0.0, 99);
    made.study.measured.push(zero);
    let (design, _) = Design::of(&made.study);
    assert_eq!(design.unused, [(Unused::AtLevel, 99)]);
    assert!(design.specimens.iter().all(|own| own.readings.iter().all(|m| m.line != 99)));
    let found = doubts(&made.study, &design);
    assert!(matches!(&found[..], [Doubt::Level { lines }] if *lines == [99]), "{found:?}");
}

#[test]
fn readings_where_every_wall_has_fallen_are_doubted() {
    let made = made();
    let world = made.world();
    let (mut design, campaign) = Design::of(&made.study);
    // A mechanism of three parameters needs 56 walls, and there are 45 points.
    let few = doubts_beside(&world, &design, &campaign, 5);
    assert!(
        matches!(&few[..], [Doubt::NotConsidered { mechanisms }] if mechanisms.contains(&"friction")),
        "{few:?}"
    );
    let sbl = design.specimens.iter().position(|s| s.name == "SBL2").expect("it was tested");
    design.specimens[sbl].readings[1].tilt = Some(radians(60.0));
    let line = design.specimens[sbl].readings[1].line;
    let found = doubts_beside(&world, &design, &campaign, 5).split_off(1);
    assert!(matches!(&found[..], [Doubt::Fallen { lines, .. }] if *lines == [line]), "{found:?}");
    let words = found[0].to_string();
    assert!(words.contains("of SBL2 is 12 mm at 60 deg, where every simulated wall has fallen"), "{words}");
}

#[test]
fn a_bound_that_no_simulated_wall_keeps_is_doubted() {
    let made = made();
    let world = made.world();
    let doubted = |value: f64, kind: MeasuredKind| {
        let mut study = made.study.clone();
        let m = study
            .measured
            .iter_mut()
            .find(|m| m.specimen == "SBL2" && m.tilt.is_some())
            .expect("it was read");
        (m.value, m.kind, m.resolution) = (value, kind, 0.0);
        let (design, campaign) = Design::of(&study);
        let found = doubts_beside(&world, &design, &campaign, 5).into_iter();
        let out = found.filter_map(|doubt| match doubt {
            Doubt::OutOfRange { fits, .. } => Some(fits),
            _ => None,
        });
        out.collect::<Vec<_>>()
    };
    // Walls move downhill by millimetres at the first tilt, and gauges are off by a few.
    assert_eq!(doubted(0.1, MeasuredKind::Below), []);
    assert_eq!(doubted(-0.1, MeasuredKind::Above), []);
    let (less, more) = (doubted(-0.1, MeasuredKind::Below), doubted(2.0, MeasuredKind::Above));
    assert!(less.len() == 1 && more.len() == 1, "{less:?} {more:?}");
    // Two metres were meant as two centimetres, or less.
    assert!(more[0].is_some_and(|fits| fits <= 0.02 + 1e-9), "{more:?}");
}
