//! What results hold for, and the methods in a paragraph.

use crate::study::{Loaded, Study};
use crate::verb::run::answer::page::inputs::assumed;
use crate::verb::run::answer::summary::{ArmSummary, Summary};

/// What holds of every wall here.
pub const RIGID: &str = "Stones are rigid and do not break. What happens in a joint follows from its stiffness, friction and \
                         cohesion; what the model leaves out is listed by pirca reference causes.";

/// What a solver's answer is.
pub fn of_solver(name: &str) -> &'static str {
    match name {
        "limit" => {
            "Limit analysis knows rigid blocks with joints that neither give way nor crush: it gives a load and a mechanism, no \
             displacements. With associative flow the load is an upper bound."
        }
        "implicit" => {
            "The implicit solver goes from equilibrium to equilibrium on elastic joints without tension. It follows no motion after \
             the collapse; a load that passes quickly is another question."
        }
        "nonsmooth" => {
            "The nonsmooth solver steps rigid blocks with Coulomb friction, which does not dilate, in time until they rest or fall. With \
             rigid joints there are no displacements before the fall; where several equilibria exist, the answer is of the one that \
             motion leads to."
        }
        _ => {
            "The explicit solver damps every motion until the wall rests or falls. Its steps in time are a way to equilibrium, and \
             no record of how the wall would move."
        }
    }
}

/// What the results of a study hold for, whatever was asked of it.
pub fn of_study(study: &Study, loaded: &Loaded) -> Vec<String> {
    let mut said = vec![
        "Intervals are at 95 %. They say how well so many simulated walls know the model's own numbers, and nothing of how well the \
         model knows real walls."
            .to_owned(),
    ];
    let assumed = assumed(&loaded.used);
    if !assumed.is_empty() {
        let inputs = assumed.join("; ");
        said.push(format!("Only assumed, and the first suspects where a prediction fails: {inputs}."));
    }
    said.extend([RIGID.to_owned(), of_solver(study.solver.name()).to_owned()]);
    said
}

/// What the results of a run hold for.
pub fn of_run(study: &Study, loaded: &Loaded, summary: &Summary) -> Vec<String> {
    let mut said = of_study(study, loaded);
    let failed = summary.arms.iter().map(ArmSummary::failed).sum::<u64>();
    if failed > 0 {
        said.push(format!("{failed} evaluations brought no value; they are counted, and are in no mean."));
    }
    said.push(match &summary.measured {
        None => "Nothing that was measured is set beside these numbers.".to_owned(),
        Some(_) => "What was measured stands beside these numbers. Where they differ by more than their errors, the model or its \
                    inputs are wrong (pirca diagnose)."
            .to_owned(),
    });
    said
}

/// What was built and loaded, in sentences.
pub fn built(study: &Study) -> String {
    let mut outlines: Vec<String> = Vec::new();
    for arm in &study.arms {
        let of = &arm.layout.outline;
        let said = match arm.file() {
            Some(file) => format!(
                "that of {file}, in a box {} m long (x), {} m thick (y) and {} m high",
                of.length, of.base_thickness, of.height
            ),
            None => format!(
                "{} m long, {} m high, {} m thick at the base and {} m at the top",
                of.length, of.height, of.base_thickness, of.top_thickness
            ),
        };
        if !outlines.contains(&said) {
            outlines.push(said);
        }
    }
    let arms = study.arms.iter().map(|arm| match arm.is_random() {
        true => format!("{} ({} walls)", arm.name, arm.members),
        false => format!("{} (one wall, as nothing is random)", arm.name),
    });
    let arms: Vec<String> = arms.collect();
    let load = match study.effective.get("load.protocol").map(String::as_str) {
        Some("tilting") => {
            "the tilt of a platform, which grows in steps until the wall falls or the largest tilt is reached"
        }
        Some("base_motion") => "the motion of the ground",
        Some("shear") => {
            "a push along the wall at its top under a constant vertical load, from drift to drift"
        }
        _ => "a horizontal pressure on one face that grows in steps to its full value",
    };
    format!("Dry stone walls, {}. Arms: {}. The load is {load}.", outlines.join("; "), arms.join(", "))
}

/// The methods of a run in a paragraph for a paper.
pub fn methods(study: &Study) -> String {
    evaluated(
        study,
        "Intervals are at 95 %: of means by Student's t, of standard deviations by chi-square, of coefficients of variation by McKay's \
         method as modified by Vangel (1996), of quantiles free of a distribution. Walls that failed were counted and left out of the \
         means.",
    )
}

/// How walls were built and evaluated, and what was made of that, in a paragraph for a paper.
pub fn evaluated(study: &Study, then: &str) -> String {
    format!(
        "{} The walls were generated and solved with pirca {} ({} solver). Each is a pure function of study, seed and number: seed {}, \
         SHA-256 of all values that decide a result {}. {then}",
        built(study),
        env!("CARGO_PKG_VERSION"),
        study.solver.name(),
        study.seed,
        study.hash,
    )
}
