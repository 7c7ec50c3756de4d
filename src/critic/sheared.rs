//! Sheared walls whose formula is known: what is hidden in them is found, and the other load is predicted by it.

use std::path::Path as Folder;

use crate::critic::causes::evidence;
use crate::critic::discrepancy::Predicted;
use crate::critic::fixture::{ALIKE, EFFORT, Made};
use crate::critic::simulate::{Bank, Campaign, Design, NUMBERS, Path, Plan, Seen, Truth, Unused, World};
use crate::critic::verdict::Judge;
use crate::math::ln;
use crate::protocol::Protocol;
use crate::random::Streams;
use crate::stats;
use crate::study::{MeasuredQuantity, Study, described, nuisances};

/// The places of a curve, as shares of the widest drift.
const SHARES: [f64; 9] = [0.0125, 0.025, 0.05, 0.09, 0.16, 0.28, 0.5, 0.75, 1.0];

/// The nine walls of `studies/dry-shear-walls`. Pushes go with kn at small drifts, and with friction and the load at large ones. Under one cause they go with the load at small
/// drifts as well; another weakens all of them by a factor.
fn made() -> Made {
    let root = Folder::new(env!("CARGO_MANIFEST_DIR"));
    let folder = root.join("studies/dry-shear-walls");
    let study = Study::load(&folder, None).unwrap_or_else(|f| panic!("{f}")).study;
    let distributions = root.join("distributions");
    let mut mechanisms = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
    mechanisms.retain(|m| ["stress_stiffening", "density", "cohesion"].contains(&m.name));
    let nuisances = nuisances(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
    let plan = Plan::new(&study, &mechanisms, &nuisances, 20).unwrap_or_else(|f| panic!("{f}"));
    let path = |wall: usize| {
        let place = &plan.places[wall];
        let Protocol::Shear(shear) = study.protocol_of(&study.arms[place.family]) else { panic!("sheared") };
        let (load, [kn, phi, _]) = (shear.vertical_load / 1e5, place.joints);
        let (stiffens, weakens) = match place.cause.map(|cause| mechanisms[cause].name) {
            // Specimens of one load differ by a seventh in their stiffness: two loads tell little less than a square.
            Some("stress_stiffening") => (2.0 * place.parameters[0], 0.0),
            Some("density") => (0.0, 0.3 * (place.parameters[0] - 0.5)),
            _ => (0.0, 0.0),
        };
        let stiffness = 1.5e7 * crate::math::exp(0.5 * kn + stiffens * ln(load));
        let bears = 3.6e4 * load * crate::math::exp(0.02 * phi);
        let mut numbers = [0.0; NUMBERS];
        numbers[0] = ln(2.0);
        for (number, share) in numbers[1..].iter_mut().zip(SHARES) {
            *number = -ln(1.0 / (stiffness * 0.02 * share) + 1.0 / bears) - weakens;
        }
        Some(Path { numbers })
    };
    let paths: Vec<Option<Path>> = (0..plan.places.len()).map(path).collect();
    let endings = vec!["equilibrium".to_string(); paths.len()];
    let bank = Bank { paths, endings };
    Made { study, mechanisms, nuisances, plan, bank }
}

/// A campaign under joints that are as stated, and a cause of this strength (as a score).
fn campaign(made: &Made, world: &World<'_>, design: &Design, cause: Option<(&str, f64)>, k: u64) -> Campaign {
    let mut truth = world.truth(None, &vec![0.0; world.inputs(None)]);
    if let Some((name, score)) = cause {
        let own = made.cause(name);
        let parameters = vec![score; made.mechanisms[own].parameters.len()];
        truth = Truth { causes: Some(own).into(), parameters, ..truth };
    }
    world.campaign(design, &truth, &Streams::new(71, k))
}

#[test]
fn arms_that_differ_in_their_names_alone_share_their_walls() {
    let made = made();
    let world = made.world();
    assert_eq!([0, 1, 2, 3].map(|family| world.stands_for(family)), [0, 0, 2, 2]);
    assert!(made.plan.places.iter().all(|place| [0, 2].contains(&place.family)));
    let (design, _) = Design::of(&made.study);
    assert_eq!((design.specimens.len(), design.unused.len()), (9, 0));
    // Without errors of reading and with specimens whose joints are alike: nothing else is drawn, so that those of one load are one.
    let truth = Truth { scatter: ALIKE, ..world.truth(None, &vec![0.0; world.inputs(None)]) };
    let values = world.values(&design, &truth, &Streams::new(3, 1));
    let of = |name: &str| {
        let specimen = design.specimens.iter().position(|s| s.name == name).expect("it was tested");
        values[specimen].clone()
    };
    assert_eq!(of("WS100"), of("WS1100"));
    assert_ne!(of("WS100"), of("WS175"));
    let written = made.bank.table(&made.plan).expect("it is written");
    assert_eq!(Bank::read(&written, &made.plan).expect("it is its own"), made.bank);
    // What is read in tests of another kind says nothing.
    let mut mixed = made.study.clone();
    mixed.measured[0].quantity = MeasuredQuantity::CollapseAngle;
    (mixed.measured[0].drift, mixed.measured[0].value) = (None, 0.2);
    let unused = Design::of(&mixed).0.unused;
    assert_eq!(unused, [(Unused::OtherTest, mixed.measured[0].line)]);
}

#[test]
fn joints_that_stiffen_under_the_load_are_told_from_others_and_nothing_is_found_where_nothing_is() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let judge = Judge::trained(&world, &design, EFFORT, 5).expect("it can be told");
    let stiffening = Some(made.cause("stress_stiffening"));
    let found = (0..10).filter(|&k| {
        let finding = judge.compare(&campaign(&made, &world, &design, Some(("stress_stiffening", 1.0)), k));
        finding.p_value < 0.02 && finding.ranked.causes[0].0 == stiffening
    });
    assert!(found.count() >= 9);
    let still = (0..10).filter(|&k| judge.compare(&campaign(&made, &world, &design, None, k)).p_value > 0.01);
    assert!(still.count() >= 9);
}

#[test]
fn what_is_fitted_to_one_load_predicts_the_other_where_it_is_the_cause() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let campaign = campaign(&made, &world, &design, Some(("stress_stiffening", 1.0)), 1);
    let mut known = design.clone();
    let light = |family: usize| world.stands_for(family) == 0;
    known.specimens.retain(|specimen| light(specimen.family));
    let seen = design.specimens.iter().zip(&campaign.specimens).filter(|(own, _)| light(own.family));
    let seen = Campaign { specimens: seen.map(|(_, seen)| seen.clone()).collect(), apart: Vec::new() };
    // How far the means are from what is seen of the walls under the larger load.
    let off = |cause: Option<usize>| {
        let draws = evidence(&world, &known, &seen, cause, 3).draws;
        let walls = Predicted::of(&world, &design, &draws, 3);
        let all = design.specimens.iter().enumerate().filter(|(_, own)| !light(own.family));
        let each = all.flat_map(|(specimen, own)| {
            let (walls, campaign) = (&walls, &campaign);
            (0..own.readings.len()).map(move |reading| {
                let Seen::Value(value) = campaign.specimens[specimen][reading] else { panic!("it was read") };
                (stats::mean(&walls.reading(specimen, reading)).expect("drawn") / value - 1.0).abs()
            })
        });
        stats::mean(&each.collect::<Vec<f64>>()).expect("some")
    };
    let (base, own) = (off(None), off(Some(made.cause("stress_stiffening"))));
    // The strength is not known from one load: half of what the base model lacks is predicted.
    assert!(own < 0.7 * base && base > 0.05, "{own} {base}");
}
