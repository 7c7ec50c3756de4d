//! How many real specimens tell what: the numbers, and how they are told.

mod difference;
mod document;
mod reading;

use serde::Serialize;

pub use difference::{PlannedArm, PlannedDifference};
pub use document::{test_plan_document, test_plan_warnings};
pub use reading::Reading;

use crate::ensemble::{Quantity, Row};
use crate::stats::Aim;
use crate::study::Study;
use crate::verb::plan_tests::answer::reading::{readings, specimens};
use crate::verb::run::answer::stated_cov::StatedCov;

/// What is planned for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Asked {
    /// Specimens of each arm that might be tested.
    pub specimens: usize,
    /// Coefficient of variation of real specimens, where another than that of simulated ones is stated.
    pub known_cov: Option<f64>,
    /// Standard deviation of the error of an angle (deg).
    pub error_deg: f64,
    /// Standard deviation of the error of a displacement (m).
    pub error_m: f64,
    /// What a test of a difference is to reach.
    pub aim: Aim,
    /// Share of the true 5 % fractile that a characteristic value may lose in the mean.
    pub loss: f64,
    /// Index of the kn point.
    pub point: u32,
}

/// A plan of tests.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TestPlan {
    /// Name of the study.
    pub study: String,
    /// Its variant.
    pub variant: Option<String>,
    /// What is planned for.
    pub asked: Asked,
    /// One entry per arm: what its specimens carry.
    pub arms: Vec<PlannedArm>,
    /// One entry per pair of arms and reading; of each pair the readings that need the fewest specimens come first.
    pub differences: Vec<PlannedDifference>,
    /// Where walls or specimens put the coefficient of variation that was stated in doubt: the same by theirs.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub otherwise: Vec<Otherwise>,
}

/// A plan by another scatter than the one that was stated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Otherwise {
    /// Why, in a sentence.
    pub why: String,
    /// By which scatter.
    pub by: &'static str,
    /// The plan.
    pub plan: TestPlan,
}

impl TestPlan {
    /// From the rows of a study.
    pub fn of(study: &Study, rows: &[Row], asked: Asked) -> TestPlan {
        let quantity = Quantity::of(study);
        let readings = readings(study, rows, &asked);
        let arms = readings.iter().filter(|own| own.is_quantity).flat_map(|reading| {
            study.arms.iter().enumerate().map(|(arm, own)| {
                let of_specimens = specimens(study, quantity, &own.name);
                PlannedArm::of(&own.name, (&reading.values[arm], &of_specimens), reading, &asked)
            })
        });
        let arms: Vec<PlannedArm> = arms.collect();
        let mut differences = Vec::new();
        for a in 0..study.arms.len() {
            for b in a + 1..study.arms.len() {
                let names = [a, b].map(|arm| study.arms[arm].name.as_str());
                let of = |reading: &Reading| PlannedDifference::of(names, [a, b], reading, &asked);
                let mut own: Vec<PlannedDifference> = readings.iter().filter_map(of).collect();
                // What the study is about stays where it is among equals: the order is stable.
                own.sort_by_key(|own| own.specimens.unwrap_or(usize::MAX));
                differences.extend(own);
            }
        }
        // A displacement is the worse the larger it is: a low fractile of it is no characteristic value.
        let arms = if quantity == Quantity::TopDisplacement { Vec::new() } else { arms };
        let otherwise = doubts(&arms).into_iter().map(|(by, known_cov, why)| Otherwise {
            why,
            by,
            plan: TestPlan::of(study, rows, Asked { known_cov, ..asked }),
        });
        TestPlan {
            study: study.name.clone(),
            variant: study.variant.clone(),
            asked,
            otherwise: otherwise.collect(),
            arms,
            differences,
        }
    }
}

/// What puts a stated coefficient of variation in doubt: simulated walls or specimens that scatter more. Real walls scatter more than
/// simulated ones, and what is stated may be that of another reading than the angle, so that less is no contradiction. By what, with which variation instead (none: that of the walls), and why.
fn doubts(arms: &[PlannedArm]) -> Vec<(&'static str, Option<f64>, String)> {
    let mut all = Vec::new();
    let named =
        |arm: &PlannedArm, own: &StatedCov, whose: &str| format!("{}: {}", arm.name, own.sentence(whose));
    let walls = arms.iter().filter_map(|arm| Some((arm, arm.stated_cov.as_ref()?)));
    let walls = walls.filter(|(_, own)| own.is_too_small());
    let why: Vec<String> = walls.map(|(arm, own)| named(arm, own, "simulated walls")).collect();
    if !why.is_empty() {
        all.push(("simulated walls", None, why.join(" ")));
    }
    let specimens = || arms.iter().filter_map(|arm| Some((arm, arm.stated_cov_of_specimens.as_ref()?)));
    let doubted = || specimens().filter(|(_, own)| own.is_too_small());
    let why: Vec<String> = doubted().map(|(arm, own)| named(arm, own, "specimens")).collect();
    if let Some(most) = doubted().filter_map(|(_, own)| own.found).reduce(f64::max).filter(|most| *most > 0.0)
    {
        all.push(("specimens", Some(most), why.join(" ")));
    }
    all
}
