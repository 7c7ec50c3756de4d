//! What a tilting test costs by kind of wall: every arm of every study that tilts, under every variant; every mechanism, from
//! one end of a prior four times as wide as the catalogue's to the other; and one wall over all stiffnesses.
//!
//! `cargo bench --bench kinds -- [WALLS] [PART OF A NAME]...` takes so many walls of each kind (default 4), of the kinds whose
//! name has all parts, and prints the median and the worst processor time of one, on one thread. A wall's line follows for
//! each that took longer than two seconds. Records go to `benches/history/`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use pirca::ensemble::{Task, build, solve};
use pirca::generate::canonical;
use pirca::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use pirca::math::{degrees, exp, ln, radians, tan};
use pirca::model::Outcome;
use pirca::protocol::{self, Ends, Protocol, Restraint, Run, Tilting, Witness};
use pirca::random::{Family, Streams};
use pirca::solve::{Solver, explicit, implicit};
use pirca::study::{Described, Study, described};

/// The studies of walls that tilt.
const STUDIES: [&str; 2] = ["tilting-block", "tilting-table"];
/// The arms that mechanisms are tried on: blocks, stones, stones between ropes.
const ARMS: [&str; 3] = ["cbl", "sbl", "sbr"];
/// So many times as wide as in the catalogue are the priors of the mechanisms.
const WIDER: f64 = 4.0;
/// Where a key does not allow that, it is narrowed by this until it does.
const NARROWER: f64 = 0.9;
/// A wall that takes longer (s) is named.
const SLOW: f64 = 2.0;

/// Walls of one kind.
struct Kind {
    name: String,
    /// The tilting test of the n-th of them; `None` where it cannot be built.
    test: Box<dyn Fn(u64) -> Option<Told>>,
}

/// What a test says, and what it took (s) without building the wall.
struct Told {
    seconds: f64,
    run: Run,
    of: String,
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).collect();
    let walls = args.first().and_then(|first| first.parse().ok());
    let parts = &args[usize::from(walls.is_some())..];
    let walls: u64 = walls.unwrap_or(4);
    println!("{:<58} {:>5} {:>8} {:>8} {:>8}  outcomes", "kind", "walls", "median s", "worst s", "steps");
    for kind in kinds().iter().filter(|kind| parts.iter().all(|part| kind.name.contains(part.as_str()))) {
        measure(kind, walls);
    }
}

fn measure(kind: &Kind, walls: u64) {
    let told: Vec<Told> = (0..walls).filter_map(|wall| (kind.test)(wall)).collect();
    if told.is_empty() {
        return println!("{:<58} none could be built", kind.name);
    }
    let mut seconds: Vec<f64> = told.iter().map(|told| told.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let spent: u64 = told.iter().map(|told| steps(&told.run)).sum();
    let mut outcomes: BTreeMap<&str, usize> = BTreeMap::new();
    told.iter().for_each(|told| *outcomes.entry(told.run.outcome.name()).or_default() += 1);
    let outcomes: Vec<String> = outcomes.iter().map(|(name, count)| format!("{count} {name}")).collect();
    let (median, worst) = (seconds[seconds.len() / 2], seconds[seconds.len() - 1]);
    println!(
        "{:<58} {:>5} {median:>8.3} {worst:>8.3} {:>8}  {}",
        kind.name,
        told.len(),
        spent / told.len() as u64,
        outcomes.join(", ")
    );
    let each = std::env::var_os("KINDS_EACH").is_some();
    for Told { seconds, run, of } in told.iter().filter(|told| each || told.seconds > SLOW) {
        let bracket = run
            .bracket
            .map_or(String::new(), |[low, high]| format!(" [{:.4}, {:.4}]", degrees(low), degrees(high)));
        let moved = run.displacements.iter().map(|u| u.norm()).fold(0.0, f64::max);
        println!(
            "    {seconds:8.3} s {:>7} steps, {}{bracket}, {:.9e} m: {of}",
            steps(run),
            said(&run.outcome),
            moved
        );
    }
}

fn said(outcome: &Outcome) -> String {
    match outcome {
        Outcome::NotConverged { why, .. } => format!("not converged: {why}"),
        other => other.name().to_owned(),
    }
}

fn steps(run: &Run) -> u64 {
    run.steps.iter().map(|step| step.solver_steps).sum()
}

/// All kinds.
fn kinds() -> Vec<Kind> {
    let mut kinds: Vec<Kind> = (7..=13).map(of_stiffness).collect();
    kinds.push(explicit_wall());
    for folder in STUDIES {
        let own = Study::load(&root().join("studies").join(folder), None).expect("the study is sound");
        kinds.extend(of_study(folder, "as it is", own.study));
        for variant in own.variants {
            let loaded = Study::load(&root().join("studies").join(folder), Some(&variant.name));
            kinds.extend(of_study(folder, &variant.name, loaded.expect("the study is sound").study));
        }
    }
    kinds.extend(of_mechanisms());
    kinds
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// `canonical::wall_72`, by half degrees, at 10^`power` Pa/m.
fn of_stiffness(power: i32) -> Kind {
    let kn = pirca::math::pow(10.0, f64::from(power));
    Kind {
        name: format!("wall_72, kn 1e{power}"),
        test: Box::new(move |_| Some(canonical_wall(kn, Solver::Implicit(implicit::Settings::default())))),
    }
}

/// The same by the explicit solver.
fn explicit_wall() -> Kind {
    let solver = Solver::Explicit(explicit::Settings::default());
    Kind {
        name: "wall_72 explicitly, kn 1e9".to_owned(),
        test: Box::new(move |_| Some(canonical_wall(1e9, solver))),
    }
}

fn canonical_wall(kn: f64, solver: Solver) -> Told {
    let law = Coulomb {
        normal: NormalLaw::Linear { kn },
        ks: 0.5 * kn,
        tan_phi: tan(radians(35.0)),
        cohesion: 0.0,
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    };
    let protocol = Protocol::Tilting(Tilting::default());
    let restraint = Restraint::at_ends(Ends::Free);
    let wall = canonical::wall_72();
    let (seconds, run) = timed(|| protocol::run(&wall, &law, &protocol, &restraint, [2, 2], &solver));
    Told { seconds, run, of: "the canonical wall".to_owned() }
}

/// The arms of a study under a variant; walls are members, at the points of kn in turn.
fn of_study(folder: &str, variant: &str, study: Study) -> Vec<Kind> {
    (0..study.arms.len() as u32)
        .map(|arm| {
            let study = study.clone();
            let name = format!("{folder}, {variant}, {}", study.arms[arm as usize].name);
            let points = study.arms[arm as usize].kn_points.len() as u64;
            let test = move |wall: u64| member(&study, arm, (wall % points) as u32, wall / points);
            Kind { name, test: Box::new(test) }
        })
        .collect()
}

/// Every mechanism on every arm that it can act on: from wall to wall all its parameters are drawn anew.
fn of_mechanisms() -> Vec<Kind> {
    let study = Study::load(&root().join("studies/tilting-table"), None).expect("the study is sound").study;
    let mut kinds = Vec::new();
    for mechanism in described(&root().join("distributions")).expect("the catalogue is sound") {
        for name in ARMS {
            let arm = study.arms.iter().position(|arm| arm.name == name).expect("there is such an arm");
            let kind = format!("mechanism {}, {name}", mechanism.name);
            let (study, mechanism) = (study.clone(), mechanism.clone());
            let test = move |wall: u64| {
                let values = drawn(&study, &mechanism, wall);
                let on = study.with_mechanism(mechanism.name, &values).expect("the values are allowed");
                let told = member(&on.study, arm as u32, 0, wall)?;
                Some(Told { of: format!("{} {values:?}", told.of), ..told })
            };
            kinds.push(Kind { name: kind, test: Box::new(test) });
        }
    }
    kinds
}

/// Values of a mechanism's parameters, each from its wide prior as far as its key allows.
fn drawn(study: &Study, mechanism: &Described, wall: u64) -> Vec<(&'static str, f64)> {
    let streams = Streams::new(0, wall);
    let mut values: Vec<_> = mechanism.parameters.iter().map(|p| (p.key, p.prior.quantile(0.5))).collect();
    for (at, p) in mechanism.parameters.iter().enumerate() {
        let share = streams.of(&format!("kinds/{}/{}", mechanism.name, p.key)).uniform();
        let mut wider = WIDER;
        loop {
            values[at].1 = wide(&p.prior, share, wider);
            if study.with_mechanism(mechanism.name, &values).is_ok() {
                break;
            }
            wider *= NARROWER;
        }
    }
    values
}

/// A quantile of a prior that is stretched about its median; that of a factor in the logarithm.
fn wide(prior: &Family, share: f64, wider: f64) -> f64 {
    let (middle, there) = (prior.quantile(0.5), prior.quantile(share));
    match prior {
        Family::Lognormal { .. } => exp(ln(middle) + wider * (ln(there) - ln(middle))),
        _ => middle + wider * (there - middle),
    }
}

fn member(study: &Study, arm: u32, point: u32, member: u64) -> Option<Told> {
    let task = Task { arm, point, member };
    let wall = build(study, arm, member).ok()?.wall;
    let (seconds, run) = timed(|| solve(study, task, &wall, Witness::NOBODY));
    let stones = wall.stones().count();
    Some(Told { seconds, run, of: format!("point {point}, member {member}, {stones} stones") })
}

/// Processor time (s) of what is done on this thread, where the system tells it; else the time that passes.
fn timed<T>(what: impl FnOnce() -> T) -> (f64, T) {
    let (begun, before) = (Instant::now(), processor());
    let done = what();
    let seconds = match (before, processor()) {
        (Some(before), Some(after)) => after - before,
        _ => begun.elapsed().as_secs_f64(),
    };
    (seconds, done)
}

fn processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
}
