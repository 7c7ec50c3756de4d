//! Laws of closure that are learnt from campaigns of small towers: the way that the stiffness goes, the law within its band, and none
//! where the joints are linear.

use std::path::Path;

use pirca::critic::{Bend, LearntLaw, NamedForm, learnt_law};
use pirca::law::{NormalLaw, Stiffening};
use pirca::study::{Loaded, Measurement, StatedLaw, Study, nuisances};
use pirca::verb::diagnose::{Origin, law_text, remove_law, write_law};

use crate::towers::{Hidden, campaign, towers};

type Mechanism = (&'static str, &'static [(&'static str, f64)]);

/// What is learnt from a campaign of towers whose joints have kn 5e7 Pa/m as stated, and a mechanism.
fn learnt(mechanism: Option<Mechanism>, seed: u64) -> LearntLaw {
    learnt_from(mechanism, seed, usize::MAX)
}

/// The same from the first specimens alone.
fn learnt_from(mechanism: Option<Mechanism>, seed: u64, specimens: usize) -> LearntLaw {
    let mut study = towers();
    let hidden = Hidden { mechanism, joints: Some([0.0; 2]), ..Hidden::default() };
    study.measured = campaign(&towers(), &hidden, seed);
    let first = |m: &Measurement| (0..specimens.min(6)).any(|k| m.specimen == format!("T{k}"));
    study.measured.retain(first);
    let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
    let nuisances = nuisances(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
    let law = learnt_law(&study, &nuisances).unwrap_or_else(|why| panic!("{why}"));
    println!(
        "{mechanism:?}, seed {seed}: exponent {:.2} [{:.2}, {:.2}], stiffening {:.4} {:?}, {:.1} numbers, seen {:.0} to {:.0} Pa",
        law.exponent.median,
        law.exponent.interval[0],
        law.exponent.interval[1],
        law.stiffening,
        law.bend,
        law.resolved,
        law.seen[0],
        law.seen[1],
    );
    for own in &law.named {
        println!("  {:?} loses {:.2} nats: {:?}", own.form, own.lost_nats, own.parameters);
    }
    println!("  gain {:?}", law.gain);
    law
}

/// How many of the knots within what was seen have the true closure, since the first of them, in their interval, and how many there are.
fn held(law: &LearntLaw, truth: &NormalLaw) -> [usize; 2] {
    let seen = |stress: f64| stress >= law.seen[0] && stress <= law.seen[1];
    let knots: Vec<_> = law.stresses.iter().zip(&law.closures).filter(|(stress, _)| seen(**stress)).collect();
    let before = truth.closure(*knots[0].0);
    let held = knots[1..].iter().filter(|(stress, closure)| {
        let (exact, [low, high]) = (truth.closure(**stress) - before, closure.interval);
        println!("  {stress:.0} Pa: {:.4e} [{low:.4e}, {high:.4e}], true {exact:.4e}", closure.median);
        low <= exact && exact <= high
    });
    [held.count(), knots.len() - 1]
}

const CLOSURE: Mechanism = ("joint_closure", &[("initial_pa_per_m", 6e6), ("closure_m", 3e-4)]);
const POWER: Mechanism = ("stress_stiffening", &[("at_1_mpa_pa_per_m", 6e8), ("exponent", 0.6)]);

#[test]
#[ignore = "slow: 40 s of processor time"]
fn two_towers_show_that_their_joints_stiffen() {
    let law = learnt_from(Some(CLOSURE), 100, 2);
    assert_eq!((law.bend, law.named[0].form), (Bend::Stiffening, NamedForm::JointClosure));
    let [within, knots] = held(&law, &NormalLaw::Hyperbolic { kn: 5e7, initial: 6e6, closure: 3e-4 });
    assert!(within + 1 >= knots, "{within} of {knots}");
    // Too few to hold some out: the law is shown, and not taken on.
    assert!(law.gain.is_none() && !law.is_accepted());
    let [stays, goes_on] = law.beyond.1;
    assert!(stays > goes_on && goes_on > law.closures[4].median, "{:?}", law.beyond);
}

/// A law that is taken on has its files, and a study that is read with its joints along the table.
fn is_written(law: &LearntLaw) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/hidden-effects/example");
    let Loaded { study, stated, .. } = Study::load(&folder, None).unwrap_or_else(|faults| panic!("{faults}"));
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("learnt-law");
    std::fs::create_dir_all(&out).expect("a folder");
    let origin = Origin { study: &study, stated: &stated, seed: 1, bank: "none" };
    let summary = write_law(&origin, law, &out).unwrap_or_else(|error| panic!("{error:#}"));
    println!("{}", law_text(&summary));
    let extended = summary.extended.expect("it is taken on");
    let own = Study::load(&out.join(extended), None).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!(own.arms[0].joint.normal_law, law.arms[0].joint.normal_law);
    assert!(matches!(own.arms[0].joint.normal_law, StatedLaw::Table(_)));
    for file in ["joint_law.json", "joint_law.svg", "joint_law.png"] {
        assert!(out.join(file).is_file(), "{file}");
    }
    remove_law(&out);
    assert!(!out.join("joint_law.json").exists() && !out.join("extended/joint_law").exists());
}

#[test]
#[ignore = "slow: four laws are learnt, with what they gain: two minutes"]
fn a_law_that_stiffens_is_learnt_with_its_band() {
    let hyperbola = NormalLaw::Hyperbolic { kn: 5e7, initial: 6e6, closure: 3e-4 };
    let power = NormalLaw::Stiffening(Stiffening::new(5e7, 6e8, 0.6, 1e6));
    let (mut within, mut knots, mut nearest) = (0, 0, 0);
    for (mechanism, truth, form) in
        [(CLOSURE, hyperbola, NamedForm::JointClosure), (POWER, power, NamedForm::StressStiffening)]
    {
        for seed in [100, 101] {
            let law = learnt(Some(mechanism), seed);
            assert_eq!(law.bend, Bend::Stiffening, "{mechanism:?}, seed {seed}");
            assert!(law.is_accepted(), "{mechanism:?}, seed {seed}");
            nearest += usize::from(law.named[0].form == form);
            is_written(&law);
            let [own, all] = held(&law, &truth);
            (within, knots) = (within + own, knots + all);
        }
    }
    println!("{within} of {knots} knots, {nearest} of 4 names");
    // Nine in ten intervals hold the truth; the knots of one law go together.
    assert!(10 * within >= 7 * knots, "{within} of {knots}");
    assert!(nearest >= 3, "{nearest} of 4");
}

#[test]
#[ignore = "slow: four laws are learnt, with what they gain: two minutes"]
fn joints_of_constant_stiffness_are_not_said_to_stiffen() {
    for seed in [200, 201, 202, 203] {
        let law = learnt(None, seed);
        held(&law, &NormalLaw::Linear { kn: 5e7 });
        // One in twenty would be by chance.
        assert_eq!(law.bend, Bend::NotShown, "seed {seed}");
        assert!(!law.is_accepted(), "seed {seed}");
    }
}
