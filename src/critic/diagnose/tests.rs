//! Campaigns of walls whose formula is known: what is seen of them, and whether anything is found where nothing is wrong.

use crate::critic::bank::tests::shipped;
use crate::critic::bank::{Bank, Path, Plan};
use crate::critic::diagnose::{
    Campaign, Causes, Contrast, Design, Doubt, Effort, Feature, Judge, Limits, Reference, Seen, Truth,
    Verdict, World, doubts_beside, extension,
};
use crate::math::{ln, radians};
use crate::random::Streams;
use crate::random::standard_normal::quantile;
use crate::stats;
use crate::study::{Described, MeasuredKind, MeasuredQuantity, Measurement, Nuisance, Study};

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
        let mut numbers = [0.0; 19];
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
            Some("creep") => numbers[1..7].iter_mut().for_each(|x| *x += 2.0 * (1.0 + strength())),
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

#[test]
fn the_papers_campaign_is_nine_specimens_with_their_bounds() {
    let made = made();
    let (design, campaign) = Design::of(&made.study);
    assert_eq!(design.specimens.len(), 9);
    assert!(design.unused.is_empty() && design.apart.is_empty());
    let at = |name: &str| design.specimens.iter().position(|s| s.name == name).expect("it was tested");
    assert_eq!(campaign.specimens[at("CBL1")][1..], [Seen::Beyond; 3]);
    let Seen::Value(first) = campaign.specimens[at("SBL1")][1] else { panic!("it was read") };
    assert!((first - 0.019).abs() < 1e-12);
}

#[test]
fn a_campaign_has_the_errors_and_the_rounding_of_its_readings() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let truth = world.drawn(None, &Streams::new(9, 0));
    let shown: Vec<Campaign> =
        (0..400).map(|k| world.campaign(&design, &truth, &Streams::new(9, k))).collect();
    assert_eq!(shown[0], world.campaign(&design, &truth, &Streams::new(9, 0)));
    let sbl = design.specimens.iter().position(|s| s.name == "SBL2").expect("it was tested");
    let angles = shown.iter().map(|c| match c.specimens[sbl][0] {
        Seen::Value(angle) => angle,
        other => panic!("{other:?}"),
    });
    for angle in angles {
        let steps = angle / radians(0.5);
        assert!((steps - steps.round()).abs() < 1e-9, "{angle}");
    }
    // The first reading of SBL2: 1.7 mm of error and the stones' own; in steps of 1 mm.
    let read: Vec<f64> =
        shown.iter().filter_map(|c| c.specimens[sbl][1].told(&design.specimens[sbl].readings[1])).collect();
    let sigma = crate::stats::sigma(&read).expect("many");
    assert!(sigma > 1.6e-3 && sigma < 2.1e-3, "{sigma}");
    // CBL stays below 5 mm at 5 deg in nearly every campaign: 2 mm and an error of 1.7.
    let cbl = design.specimens.iter().position(|s| s.name == "CBL1").expect("it was tested");
    let beyond = shown.iter().filter(|c| c.specimens[cbl][1] == Seen::Beyond).count();
    assert!(beyond > 300, "{beyond}");
}

#[test]
fn a_cause_that_changes_nothing_has_the_walls_of_the_base_model() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let base = world.drawn(None, &Streams::new(9, 0));
    let with =
        |name: &str| Truth { causes: Some(made.cause(name)).into(), parameters: vec![0.3], ..base.clone() };
    let shown = |truth: &Truth| world.values(&design, truth, &Streams::new(9, 1));
    // To the rounding of a curve through nothing but zeros.
    let apart = |a: &[Vec<Option<f64>>], b: &[Vec<Option<f64>>]| {
        let pairs = a.iter().flatten().zip(b.iter().flatten());
        pairs.filter_map(|(a, b)| Some((a.as_ref()? - b.as_ref()?).abs())).fold(0.0, f64::max)
    };
    assert!(apart(&shown(&with("density")), &shown(&base)) < 1e-12);
    assert!(apart(&shown(&with("lean")), &shown(&base)) > 1e-2);
}

#[test]
fn a_weight_tells_of_the_density_and_of_nothing_else() {
    let mut made = made();
    let sbl = made.study.arms.iter().position(|arm| arm.name == "sbl").expect("a family");
    let mut weighed = made.study.measured[0].clone();
    (weighed.family, weighed.quantity) = ("sbl".to_owned(), MeasuredQuantity::SpecimenWeight);
    (weighed.tilt, weighed.value, weighed.error) = (None, 1250.0, 7.0);
    (weighed.kind, weighed.common_error) = (MeasuredKind::Exact, 0.0);
    made.study.measured.push(weighed);
    let world = made.world();
    let (design, campaign) = Design::of(&made.study);
    assert_eq!((design.apart.len(), campaign.apart[0]), (1, Seen::Value(1250.0)));
    assert_eq!((design.specimens.len(), design.apart[0].0), (9, sbl));
    let base = world.drawn(None, &Streams::new(9, 0));
    let weight = |name: &str| {
        let cause = Some(made.cause(name));
        let parameters = vec![-1.0; made.mechanisms[made.cause(name)].parameters.len()];
        world.values_apart(&design, &Truth { causes: cause.into(), parameters, ..base.clone() })[0]
    };
    // Table 1 of the source paper: 1371 N.
    let stated = world.values_apart(&design, &base)[0];
    assert!((stated - 1371.0).abs() < 0.1, "{stated}");
    let factor = made.mechanisms[made.cause("density")].parameters[0].prior.at_score(-1.0);
    assert!((weight("density") / stated - factor).abs() < 1e-12 && factor < 1.0);
    assert_eq!([weight("lean"), weight("contact_area")], [stated; 2]);
}

#[test]
fn an_error_of_which_nobody_knows_how_much_is_shared_is_drawn_and_fitted_as_such() {
    let made = made();
    let (world, (mut design, _)) = (made.world(), Design::of(&made.study));
    let joints = vec![0.0; world.inputs(None)];
    let truth = world.truth(None, &joints);
    // Readings whose error is all that differs: 6 mm, on walls that move by 2 % of as much.
    design.specimens.retain(|specimen| specimen.family == 1);
    for m in design.specimens.iter_mut().flat_map(|specimen| &mut specimen.readings) {
        (m.kind, m.resolution) = (MeasuredKind::Exact, 0.0);
        if m.tilt.is_some() {
            let half = 6e-3 * 0.5_f64.sqrt();
            (m.error, m.common_error, m.unknown_share) = (half, half, true);
        }
    }
    let off = |k: u64| -> Vec<f64> {
        let streams = Streams::new(15, k);
        let (values, shown) =
            (world.values(&design, &truth, &streams), world.campaign(&design, &truth, &streams));
        let rows = values.iter().zip(&shown.specimens).zip(&design.specimens);
        rows.flat_map(|((values, seen), specimen)| {
            values.iter().zip(seen).zip(&specimen.readings).filter_map(|((value, seen), m)| {
                match (value, seen) {
                    (Some(value), Seen::Value(seen)) if m.tilt.is_some() => Some(seen - value),
                    _ => None,
                }
            })
        })
        .collect()
    };
    let offs: Vec<Vec<f64>> = (0..600).map(off).collect();
    let whole: Vec<f64> = offs.concat();
    let sigma = stats::sigma(&whole).expect("many");
    assert!((sigma / 6e-3 - 1.0).abs() < 0.05, "{sigma}");
    // In the mean half of the variance is shared, in single campaigns nearly none or nearly all.
    let scatter: Vec<f64> =
        offs.iter().filter_map(|off| stats::sigma(off)).map(|s| s * s / (6e-3 * 6e-3)).collect();
    let mean = stats::mean(&scatter).expect("many");
    assert!((mean - 0.5).abs() < 0.05, "{mean}");
    // Of six readings a scatter below a fifth of the error has a chance of 0.8 % where half is shared, of 8 % with any share.
    let little = scatter.iter().filter(|s| **s < 0.05).count();
    assert!((25..80).contains(&little), "{little}");
    // A campaign that is off by 12 mm throughout is no finding then, and it is if nothing of the error is shared.
    let evidence_of = |design: &Design| {
        let values = world.values(design, &truth, &Streams::new(15, 3));
        let rows = values.iter().zip(&design.specimens).map(|(values, specimen)| {
            let one = |(value, m): (&Option<f64>, &Measurement)| match value {
                Some(value) if m.tilt.is_some() => Seen::Value(value + 12e-3),
                Some(value) => Seen::Value(*value),
                None => Seen::Nothing,
            };
            values.iter().zip(&specimen.readings).map(one).collect()
        });
        let shown = Campaign { specimens: rows.collect(), apart: Vec::new() };
        let creep = Some(made.cause("creep"));
        [None, creep].map(|cause| crate::critic::evidence(&world, design, &shown, cause, 3).log)
    };
    let [base, creep] = evidence_of(&design);
    let unknown = creep - base;
    design.specimens.iter_mut().flat_map(|s| &mut s.readings).filter(|m| m.tilt.is_some()).for_each(|m| {
        (m.error, m.common_error, m.unknown_share) = (6e-3, 0.0, false);
    });
    let [base, creep] = evidence_of(&design);
    println!("{unknown} {}", creep - base);
    assert!(unknown < creep - base - 1.0, "{unknown} {}", creep - base);
}

#[test]
fn a_fixed_target_tells_of_the_gauge_and_of_nothing_else() {
    let mut made = made();
    let mut still = made.study.measured[0].clone();
    (still.quantity, still.tilt, still.value) = (MeasuredQuantity::FixedTarget, None, 5.2e-3);
    (still.kind, still.error, still.common_error) = (MeasuredKind::Exact, 3e-4, 0.0);
    made.study.measured.push(still);
    let world = made.world();
    let (design, campaign) = Design::of(&made.study);
    assert_eq!((design.specimens.len(), &campaign.apart[..]), (9, &[Seen::Value(5.2e-3)][..]));
    let shown = |name: &str| {
        let cause = made.cause(name);
        let parameters = vec![1.0; made.mechanisms[cause].parameters.len()];
        let truth =
            Truth { causes: Some(cause).into(), parameters, ..world.drawn(None, &Streams::new(9, 0)) };
        world.values_apart(&design, &truth)[0]
    };
    let offset = made.mechanisms[made.cause("gauge_offset")].parameters[0].prior.at_score(1.0);
    assert_eq!((shown("gauge_offset"), shown("gauge_scale"), shown("creep")), (offset, 0.0, 0.0));
}

#[test]
fn what_had_fallen_shows_nothing() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let sbl = design.specimens.iter().position(|s| s.name == "SBL2").expect("it was tested");
    let mut late = design.clone();
    late.specimens[sbl].readings[1].tilt = Some(radians(40.0));
    let campaign = world.campaign(&late, &world.drawn(None, &Streams::new(1, 1)), &Streams::new(1, 1));
    assert_eq!(campaign.specimens[sbl][1], Seen::Nothing);
}

#[test]
fn a_gauge_that_has_moved_shows_in_every_reading_and_in_no_angle() {
    let made = made();
    let world = made.world();
    let (mut design, _) = Design::of(&made.study);
    for m in design.specimens.iter_mut().flat_map(|s| &mut s.readings) {
        (m.error, m.kind) = (0.0, MeasuredKind::Exact);
    }
    let base = world.drawn(None, &Streams::new(2, 0));
    let offset = made.cause("gauge_offset");
    let mut moved = base.clone();
    // 5 mm is one standard deviation of the prior.
    (moved.causes, moved.parameters) = (Some(offset).into(), vec![1.0]);
    let (before, after) = (
        world.campaign(&design, &base, &Streams::new(2, 0)),
        world.campaign(&design, &moved, &Streams::new(2, 0)),
    );
    for (specimen, (before, after)) in
        design.specimens.iter().zip(before.specimens.iter().zip(&after.specimens))
    {
        for (m, pair) in specimen.readings.iter().zip(before.iter().zip(after)) {
            let (Seen::Value(a), Seen::Value(b)) = pair else { panic!("all stand: {pair:?}") };
            let expected = match m.quantity {
                MeasuredQuantity::DisplacementMean => 5e-3,
                _ => 0.0,
            };
            assert!((b - a - expected).abs() < 1e-9, "{:?}: {a} {b}", m.quantity);
        }
    }
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
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let judge = Judge::trained(&world, &design, EFFORT, 5).expect("it can be told");
    let test = judge.self_test(&Limits::default(), 100, 6);
    let of = |name: &str| {
        let row =
            test.rows.iter().find(|row| row.cause.is_some_and(|cause| made.mechanisms[cause].name == name));
        row.cloned().expect("it can act")
    };
    let (creep, nothing) = (of("creep"), of("cohesion"));
    println!("{creep:?}\n{nothing:?}\n{:?}", test.rows[0]);
    // The level of all displacements up to e^4 times as large, and only that.
    assert!(creep.found > 70 && creep.named > 50, "{creep:?}");
    // It looks like the base model: found as often as that is, and never named.
    assert!(nothing.found < 15 && nothing.named == 0 && nothing.misnamed < 5, "{nothing:?}");
    assert!(test.rows[0].cause.is_none() && test.rows[0].found < 15 && test.rows[0].misnamed < 3);
    // Nine in ten of the sets hold the cause; 95 % of 100 such counts are above 84, and those found are a choice of them.
    assert!(creep.covered as f64 > 0.8 * creep.found as f64, "{creep:?}");
}

#[test]
fn a_cause_outside_the_catalogue_is_not_given_the_name_of_one_inside() {
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let judge = Judge::trained(&world, &design, EFFORT, 5).expect("it can be told");
    let limits = Limits::default();
    let creep = made.cause("creep");
    let (mut right, mut wrongly, mut unexplained) = (0, 0, 0);
    for k in 0..10 {
        let streams = Streams::new(31, k);
        let mut truth = world.drawn(Some(creep), &streams);
        truth.parameters[0] = 1.5;
        let shown = world.campaign(&design, &truth, &streams);
        right += usize::from(judge.diagnosed(&shown, &limits, 1).verdict == Verdict::Named(creep));
        // One specimen of each family moves, and far; creep would move all of them.
        let base = world.drawn(None, &streams);
        let mut other = world.campaign(&design, &base, &streams);
        for (specimen, seen) in design.specimens.iter().zip(&mut other.specimens) {
            for (m, seen) in specimen.readings.iter().zip(seen).filter(|(m, _)| m.tilt.is_some()) {
                if let (true, Seen::Value(value)) = (specimen.name.ends_with('1'), &*seen) {
                    *seen = Seen::of(value + 0.15, m);
                }
            }
        }
        match judge.diagnosed(&other, &limits, 1).verdict {
            Verdict::Named(_) | Verdict::NamedPair(_) => wrongly += 1,
            Verdict::Unexplained => unexplained += 1,
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
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let judge = Judge::trained(&world, &design, EFFORT, 5).expect("it can be told");
    let (creep, lean) = (made.cause("creep"), made.cause("lean"));
    let pair = Causes::pair(creep, lean);
    assert_eq!((pair, pair.each().collect::<Vec<_>>()), (Causes::pair(lean, creep), vec![lean, creep]));
    let (mut together, mut named, mut alone) = (0, 0, 0);
    for k in 0..8 {
        let streams = Streams::new(37, k);
        let mut truth = world.drawn(pair, &streams);
        // The wall leans downhill, and creeps: it moves far and falls early.
        truth.parameters[..2].copy_from_slice(&[1.5, 1.5]);
        let shown = world.campaign(&design, &truth, &streams);
        let found = judge.diagnosed(&shown, &Limits::default(), 1);
        println!("{:?} {:?}", found.verdict, found.pairs.first().map(|pair| (pair.evidence, pair.guard)));
        // Where one of the two explains all that can be told, it is named alone.
        let best = found.pairs.first().map(|best| best.causes);
        together +=
            usize::from(best.map_or(found.verdict == Verdict::Named(creep), |best| best == [lean, creep]));
        named += usize::from(found.verdict == Verdict::NamedPair([lean, creep]));
        if let Verdict::NamedPair(_) = found.verdict {
            let [(causes, draws)] = &found.explained_by()[..] else { panic!("the pair") };
            assert_eq!(
                (&causes[..], draws[0].parameters.len()),
                (&[lean, creep][..], truth.parameters.len())
            );
        }
        let one = world.campaign(
            &design,
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
fn readings_where_every_wall_has_fallen_are_doubted() {
    let made = made();
    let world = made.world();
    let (mut design, campaign) = Design::of(&made.study);
    assert_eq!(doubts_beside(&world, &design, &campaign, 5), []);
    let sbl = design.specimens.iter().position(|s| s.name == "SBL2").expect("it was tested");
    design.specimens[sbl].readings[1].tilt = Some(radians(60.0));
    let line = design.specimens[sbl].readings[1].line;
    let found = doubts_beside(&world, &design, &campaign, 5);
    assert!(matches!(&found[..], [Doubt::Fallen { lines, .. }] if *lines == [line]), "{found:?}");
    let words = found[0].to_string();
    assert!(words.contains("of SBL2 is 12 mm at 60 deg, where every simulated wall has fallen"), "{words}");
}
