//! The answer as it is written.

use std::collections::BTreeMap;

use crate::ensemble::{Influenced, Quantity, Source, base_points, without_value};
use crate::report::number::significant;
use crate::stats::{BasePoint, Estimate, influence};
use crate::study::{Design, Study};

/// What the sources of an arm are responsible for. Intervals are at 95 %; what is not defined is null.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct InfluenceSummary {
    /// Name of the study.
    pub study: String,
    /// Its variant.
    pub variant: Option<String>,
    /// Name of the arm.
    pub arm: String,
    /// Normal stiffness of the joints as stated (Pa/m).
    pub kn_pa_per_m: f64,
    /// Seed of all random streams.
    pub seed: u64,
    /// How what is drawn once per wall covers its space.
    pub design: Design,
    /// Base points.
    pub points: u64,
    /// Walls evaluated: two per base point, and one more for every source.
    pub walls: u64,
    /// Walls without a value, by how they ended.
    pub failed: BTreeMap<String, u64>,
    /// What scatters.
    pub output: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its mean.
    pub mean: Option<f64>,
    /// Its variance (unit squared).
    pub variance: Option<f64>,
    /// Interval of the variance.
    pub variance_ci: Option<[f64; 2]>,
    /// The sources: what is drawn once per wall, the layout as a whole, and what it consists of.
    pub groups: Vec<ShareEntry>,
    /// How the quantity is shown.
    #[serde(skip)]
    pub shown: Quantity,
}

/// What a source is responsible for, as shares of the variance: the value and the ends of its interval.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ShareEntry {
    /// The path of a parameter's key, `layout`, or what of the layout.
    pub name: String,
    /// Whether it is part of the layout, whose share it is counted in.
    pub is_in_layout: bool,
    /// What would go if the source were known.
    pub first: [Option<f64>; 3],
    /// What would be left if all others were known.
    pub total: [Option<f64>; 3],
    /// Base points that it rests on.
    pub points: u64,
}

impl InfluenceSummary {
    /// Of the evaluated walls of a study with one arm, whose base points share so many randomisations in turn.
    pub fn of(
        study: &Study,
        kn_pa_per_m: f64,
        sources: &[Source],
        evaluated: &[Vec<Influenced>],
        randomisations: u64,
    ) -> InfluenceSummary {
        let found = influence(&base_points(evaluated), randomisations as usize);
        let quantity = Quantity::of(study);
        let groups = sources.iter().zip(&found.shares).map(|(source, share)| ShareEntry {
            name: source.name.clone(),
            is_in_layout: source.is_in_layout,
            first: with_ends(share.first),
            total: with_ends(share.total),
            points: share.points as u64,
        });
        InfluenceSummary {
            study: study.name.clone(),
            variant: study.variant.clone(),
            arm: study.arms.first().map_or_else(String::new, |arm| arm.name.clone()),
            kn_pa_per_m,
            seed: study.seed,
            design: study.design,
            points: evaluated.len() as u64,
            walls: evaluated.iter().map(Vec::len).sum::<usize>() as u64,
            failed: without_value(evaluated),
            output: quantity.name(),
            unit: quantity.unit(),
            mean: found.mean.value,
            variance: found.variance.value,
            variance_ci: found.variance.interval,
            groups: groups.collect(),
            shown: quantity,
        }
    }
}

fn with_ends(estimate: Estimate) -> [Option<f64>; 3] {
    let [low, high] = estimate.interval.map_or([None; 2], |ends| ends.map(Some));
    [estimate.value, low, high]
}

/// The answer so far in a few words: the source with the largest total share.
pub fn running(sources: &[Source], points: &[BasePoint], randomisations: u64) -> String {
    let found = influence(points, randomisations as usize);
    let totals = sources
        .iter()
        .zip(&found.shares)
        .filter_map(|(source, share)| Some((source.name.as_str(), share.total.value?)));
    match totals.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((name, total)) => format!("most from {name} so far: {} % in all", significant(100.0 * total, 2)),
        None => "no scatter so far".to_owned(),
    }
}
