//! The means of an earlier run of the same study, to be shown in the figure of a new one.

use std::path::Path;

use anyhow::{Context, Result, anyhow, ensure};

use crate::ensemble::Quantity;
use crate::verb::run::answer::files::SUMMARY_JSON;

/// The means of an earlier run.
#[derive(Clone, Debug, PartialEq)]
pub struct Earlier {
    /// Which run it was: its variant and its solver.
    pub label: String,
    /// Its arms with their means, in the order of its summary.
    pub arms: Vec<(String, Vec<Mean>)>,
}

/// A mean of an earlier run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// The mean, in the unit of figures.
    pub shown: f64,
}

/// What is read of a summary.
#[derive(serde::Deserialize)]
struct Recorded {
    study: String,
    variant: Option<String>,
    solver: String,
    arms: Vec<RecordedArm>,
}

#[derive(serde::Deserialize)]
struct RecordedArm {
    arm: String,
    kn_pa_per_m: f64,
    quantity: String,
    mean: Option<f64>,
}

impl Earlier {
    /// Reads the summary in the folder of a run of the study of this name, in any reading, with any solver and any seed.
    ///
    /// # Errors
    /// The file, if it cannot be read or is no summary, is of another study or another quantity, or holds no mean.
    pub fn read(dir: &Path, study: &str, quantity: Quantity) -> Result<Earlier> {
        let path = dir.join(SUMMARY_JSON);
        let shown = path.display();
        let text = std::fs::read_to_string(&path)
            .with_context(|| format!("cannot read {shown}: give the output folder of an earlier run"))?;
        let recorded = serde_json::from_str(&text).map_err(|e| anyhow!("{shown} is no summary: {e}"))?;
        Earlier::of(recorded, study, quantity).with_context(|| shown.to_string())
    }

    fn of(recorded: Recorded, study: &str, quantity: Quantity) -> Result<Earlier> {
        ensure!(
            recorded.study == study,
            "it is of the study {}; only runs of {study} can be shown beside each other",
            recorded.study
        );
        let mut arms: Vec<(String, Vec<Mean>)> = Vec::new();
        for entry in &recorded.arms {
            let (found, wanted) = (entry.quantity.as_str(), quantity.name());
            ensure!(found == wanted, "it is about the {found}; the study now asks for the {wanted}");
            let Some(mean) = entry.mean.filter(|mean| mean.is_finite()) else { continue };
            let mean = Mean { kn: entry.kn_pa_per_m, shown: quantity.shown(mean) };
            match arms.iter_mut().find(|(arm, _)| *arm == entry.arm) {
                Some((_, means)) => means.push(mean),
                None => arms.push((entry.arm.clone(), vec![mean])),
            }
        }
        ensure!(!arms.is_empty(), "none of its arms has a mean");
        let reading = recorded.variant.map_or("main reading".to_owned(), |name| format!("variant {name}"));
        Ok(Earlier { label: format!("{reading}, {} solver", recorded.solver), arms })
    }
}
