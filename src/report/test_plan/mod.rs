//! How many real specimens tell what: `plan-tests.json`, `plan-tests.csv`, and what is printed.

mod csv;
mod difference;
mod reading;
mod text;

use std::path::Path;

use anyhow::{Context, Result};
use serde::Serialize;

pub use difference::{PlannedArm, PlannedDifference};
pub use reading::Reading;
pub use text::test_plan_text;

use crate::ensemble::{Quantity, Row, replace_file};
use crate::report::test_plan::reading::readings;
use crate::stats::Aim;
use crate::study::Study;

/// File name, without ending, of what is written.
const FILE: &str = "plan-tests";

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
}

impl TestPlan {
    /// From the rows of a study.
    pub fn of(study: &Study, rows: &[Row], asked: Asked) -> TestPlan {
        let quantity = Quantity::of(study);
        let readings = readings(study, rows, &asked);
        let arms = readings.iter().filter(|own| own.is_quantity).flat_map(|reading| {
            study
                .arms
                .iter()
                .enumerate()
                .map(|(arm, own)| PlannedArm::of(&own.name, &reading.values[arm], reading, &asked))
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
        TestPlan { study: study.name.clone(), variant: study.variant.clone(), asked, arms, differences }
    }
}

/// Writes the plan as JSON and CSV into an existing folder.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_test_plan(plan: &TestPlan, dir: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(plan).context("the plan cannot be written as JSON")? + "\n";
    replace_file(&dir.join(format!("{FILE}.json")), json.as_bytes())?;
    Ok(replace_file(&dir.join(format!("{FILE}.csv")), csv::csv(plan).as_bytes())?)
}
