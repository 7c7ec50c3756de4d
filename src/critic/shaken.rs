//! Stones on two stands whose formula is known: what is hidden in the outcomes of motions is found, and nothing where nothing is.

use std::fs;
use std::path::Path as Folder;
use std::sync::OnceLock;

use crate::critic::causes::evidence;
use crate::critic::fixture::{EFFORT, Made};
use crate::critic::simulate::{
    Bank, Campaign, Causes, Design, NUMBERS, Path, Plan, Scope, Seen, Truth, Unused, World,
};
use crate::critic::verdict::{Judge, Limits, Verdict};
use crate::math::ln;
use crate::random::Streams;
use crate::random::standard_normal::quantile;
use crate::study::{Described, MeasuredQuantity, Study, described, nuisances};

/// Motions that the stones meet, in this order.
const MOTIONS: usize = 36;
/// Search prior of the distance within which a face does not bear (m): its far end.
const FURTHEST: f64 = 0.12;
/// Half of the width that the stone stands on (m).
const HALF: f64 = 0.1;

/// The strength of a motion over what a stone on its whole face just withstands: from 0.4 to 2.5, out of order.
fn strength(motion: usize) -> f64 {
    crate::math::exp(-0.92 + 1.84 * ((motion * 17) % MOTIONS) as f64 / (MOTIONS - 1) as f64)
}

/// A folder with a study of a stone that meets tiny records, and outcomes to be replaced.
fn study() -> Study {
    let folder = std::env::temp_dir().join(format!("pirca-shaken-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let records: Vec<String> = (0..MOTIONS).map(|k| format!("r{k}.csv")).collect();
    for record in &records {
        fs::write(folder.join(record), "t_s,ay_g\n0,0\n0.01,0.1\n0.02,0\n").expect("written");
    }
    let arm = |name: &str| {
        format!(
            "[[arm]]\nname = \"{name}\"\nmembers = 1\narrangement = \"continuous\"\nblock_length_m = 0.2\ncourse_height_m = 0.8\n"
        )
    };
    let text = format!(
        "[study]\nquestion = \"Which motions overturn it?\"\nseed = 3\n\n[wall]\nheight_m = 0.8\nlength_m = 0.2\n\
         base_thickness_m = 0.2\ntop_thickness_m = 0.2\nbattered_face = \"both\"\nwythes = 1\n\n[block]\n\
         density_kg_per_m3 = 2400\n\n[joint]\nkn_pa_per_m = [1e9]\nkn_over_ks = 2\nphi_deg = 35\ncohesion_pa = 0\n\n\
         [load]\nprotocol = \"base_motion\"\npga_m_per_s2 = [1]\n\n[load.records]\nfrom = \"files\"\nfiles = {records:?}\n\n\
         [restraint]\nbase = \"fixed\"\nends = \"free\"\n\n[solver]\nname = \"nonsmooth\"\n\n{}\n{}",
        arm("one"),
        arm("two")
    );
    fs::write(folder.join("study.toml"), text).expect("written");
    let rows = [1, 2].into_iter().flat_map(|stand| (0..MOTIONS).map(move |k| (stand, k)));
    let rows = rows.map(|(stand, k)| format!("s{stand},{},r{k},{k},stood\n", ["one", "two"][stand - 1]));
    let table = format!("specimen,family,record,stage,outcome\n{}", rows.collect::<String>());
    fs::write(folder.join("measured.csv"), table).expect("written");
    let loaded = Study::load(&folder, None).unwrap_or_else(|faults| panic!("{faults}"));
    fs::remove_dir_all(&folder).expect("removed");
    loaded.study
}

/// Two stands of one stone. It falls under a motion that is as strong, for its face, as the part of the face that bears.
fn made() -> &'static Made {
    static MADE: OnceLock<Made> = OnceLock::new();
    MADE.get_or_init(|| {
        let distributions = Folder::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let study = study();
        let mut mechanisms = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        mechanisms.retain(|m| ["worn_bearing", "motion_scale", "friction"].contains(&m.name));
        let nuisances = nuisances(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        let plan = Plan::new(&study, &mechanisms, &nuisances, 40).unwrap_or_else(|f| panic!("{f}"));
        let path = |wall: usize| {
            let place = &plan.places[wall];
            let value = |k: usize, m: &Described| m.parameters[k].search.quantile(place.parameters[k]);
            let cause = place.cause.map(|cause| &mechanisms[cause]);
            let mut chance = Streams::new(5, place.point).of("rocking");
            let mut numbers = [0.0; NUMBERS];
            for motion in 0..MOTIONS {
                let stands = match cause {
                    Some(m) if m.name == "worn_bearing" => {
                        1.0 - (value(0, m) + value(1, m) * motion as f64) / HALF
                    }
                    Some(m) if m.name == "motion_scale" => 1.0 / value(0, m),
                    _ => 1.0,
                };
                if stands < 0.1 {
                    return None;
                }
                let by_chance = 0.1 * (chance.uniform() - 0.5);
                numbers[1 + motion] = ln(stands / strength(motion)) + by_chance;
            }
            Some(Path { numbers })
        };
        let paths: Vec<Option<Path>> = (0..plan.places.len()).map(path).collect();
        let ending = |path: &Option<Path>| if path.is_some() { "equilibrium" } else { "unstable_at_rest" };
        let bank = Bank { endings: paths.iter().map(|path| ending(path).to_string()).collect(), paths };
        Made { study, mechanisms, nuisances, plan, bank }
    })
}

/// Outcomes under joints as stated, with parameters of causes as quantiles of their search priors.
fn campaign(made: &Made, world: &World<'_>, causes: Causes, quantiles: &[f64], k: u64) -> Campaign {
    let (design, _) = Design::of(&made.study);
    let still = world.truth(None, &vec![0.0; world.inputs(None)]);
    let parameters = quantiles.iter().map(|q| quantile(*q)).collect();
    let truth = Truth { causes, parameters, ..still };
    world.campaign(&design, &truth, &Streams::new(71, k))
}

/// Quantile of a distance in its search prior, a triangle that falls from 0.
fn quantile_of(inset: f64) -> f64 {
    1.0 - (1.0 - inset / FURTHEST) * (1.0 - inset / FURTHEST)
}

#[test]
fn outcomes_are_sides_of_the_scale_at_which_a_stone_just_falls() {
    let made = made();
    let world = made.world();
    let (design, measured) = Design::of(&made.study);
    assert_eq!((design.specimens.len(), design.unused.len()), (2, 0));
    assert!(measured.seen().all(|seen| seen == Seen::Stood));
    // The same stone: one bank serves both stands, and each stand is of a kind of its own.
    assert_eq!((world.stands_for(1), world.joint_kinds()), (0, 2));
    // Of 36 motions those fall that are stronger than the face withstands.
    let shown = campaign(made, &world, Causes::default(), &[], 1);
    for (motion, seen) in shown.specimens[0].iter().enumerate().filter(|(k, _)| ln(strength(*k)).abs() > 0.15)
    {
        assert_eq!(*seen == Seen::Fell, strength(motion) > 1.0, "motion {motion}: {}", strength(motion));
    }
    let written = made.bank.table(&made.plan).expect("it is written");
    assert_eq!(Bank::read(&written, &made.plan).expect("it is its own"), made.bank);
    // What is read of walls that tilt says nothing here.
    let mut mixed = made.study.clone();
    (mixed.measured[0].quantity, mixed.measured[0].under) = (MeasuredQuantity::CollapseAngle, None);
    assert_eq!(Design::of(&mixed).0.unused, [(Unused::OtherTest, mixed.measured[0].line)]);
}

#[test]
fn a_bearing_that_is_narrower_on_one_stand_is_found_there_and_its_width_with_it() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let judge = Judge::trained(&world, &design, EFFORT, 5).expect("it can be told");
    let worn = made.cause("worn_bearing");
    let (one, all) = (Causes::one(worn, Scope::Kind(0)), Causes::one(worn, Scope::All));
    let (limits, mut named) = (Limits::default(), 0);
    for k in 0..5 {
        let campaign = campaign(made, &world, one, &[quantile_of(0.035), 0.02], k);
        let finding = judge.compare(&campaign);
        assert!(finding.p_value < 0.01, "{k}: p {}", finding.p_value);
        let examination = judge.rank(finding, &campaign, &limits, 7);
        let diagnosis = judge.check(examination, &campaign, &limits, 7);
        named += usize::from(diagnosis.verdict.causes().contains(&worn));
        let of = |causes: Causes| evidence(&world, &design, &campaign, causes, 3);
        let (here, everywhere) = (of(one), of(all));
        assert!(here.log > everywhere.log + 2.0, "{k}: {} {}", here.log, everywhere.log);
        let insets: Vec<f64> = here
            .draws
            .iter()
            .map(|truth| made.mechanisms[worn].parameters[0].search.at_score(truth.parameters[0]))
            .collect();
        let (mean, sd) =
            (crate::stats::mean(&insets).expect("many"), crate::stats::sigma(&insets).expect("many"));
        assert!((mean - 0.035).abs() < 3.0 * sd && sd < 0.015, "{k}: {mean} {sd}");
    }
    assert_eq!(named, 5);
    // Nothing is found where nothing is hidden.
    let nothing =
        |k: u64| judge.compare(&campaign(made, &world, Causes::default(), &[], 100 + k)).p_value > 0.01;
    assert!((0..10).filter(|k| nothing(*k)).count() >= 9);
    assert!(matches!(
        {
            let campaign = campaign(made, &world, Causes::default(), &[], 200);
            let examination = judge.rank(judge.compare(&campaign), &campaign, &limits, 7);
            judge.check(examination, &campaign, &limits, 7).verdict
        },
        Verdict::NothingFound
    ));
}
