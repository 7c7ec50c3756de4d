//! The answer as it is written.

use std::collections::BTreeMap;

use crate::ensemble::{LAYOUT, Quantity, SensitivityValue, Source, base_points, without_value};
use crate::render::number::significant;
use crate::stats::{BasePoint, Estimate, Share, possible_shares, sensitivity, share_alone};
use crate::study::{Design, Study};

/// What the sources of an arm are responsible for. Intervals are at 95 %; what is not defined is null.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct SensitivitySummary {
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
    /// What the sources are responsible for without interactions between them: the sum of their first order shares.
    pub alone: [Option<f64>; 3],
    /// What their interactions are responsible for.
    pub interactions: [Option<f64>; 3],
    /// The widest half width of a share of a source; null where none has an interval.
    pub half_width: Option<f64>,
    /// Base points with which every share of a source is known to within 0.1, as intervals shrink with the root of their number; null where
    /// these points are enough.
    pub points_wanted: Option<u64>,
    /// The sources: what is drawn once per wall, the layout as a whole, and what it consists of.
    pub groups: Vec<ShareEntry>,
    /// How the quantity is shown.
    #[serde(skip)]
    pub shown: Quantity,
}

/// A share that is known to within this half width is known well.
pub(crate) const WELL_KNOWN: f64 = 0.1;

/// What a source is responsible for, as shares of the variance: the value and the ends of its interval. Shares are the possible ones
/// that are nearest to the estimates; see [`possible_shares`].
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
    /// Whether they are known exactly: of the only source.
    pub is_exact: bool,
    /// The estimate of the first order share by itself, which by chance may lie below 0.
    pub estimated_first: [Option<f64>; 3],
    /// That of the total share, which by chance may lie above 1 or below the first order share.
    pub estimated_total: [Option<f64>; 3],
    /// Base points that it rests on.
    pub points: u64,
}

impl SensitivitySummary {
    /// Of the evaluated walls of a study with one arm, whose base points share so many randomisations in turn.
    pub fn of(
        study: &Study,
        kn_pa_per_m: f64,
        sources: &[Source],
        evaluated: &[Vec<SensitivityValue>],
        randomisations: u64,
    ) -> SensitivitySummary {
        let points = base_points(evaluated);
        let found = sensitivity(&points, randomisations as usize);
        let quantity = Quantity::of(study);
        let shares = possible(sources, &found.shares);
        let whole: Vec<usize> = (0..sources.len()).filter(|k| !sources[*k].is_in_layout).collect();
        let groups =
            sources.iter().zip(&found.shares).zip(&shares).map(|((source, estimate), share)| ShareEntry {
                name: source.name.clone(),
                is_in_layout: source.is_in_layout,
                first: with_ends(share.first),
                total: with_ends(share.total),
                is_exact: whole.len() == 1 && !source.is_in_layout && share.first.value.is_some(),
                estimated_first: with_ends(estimate.first),
                estimated_total: with_ends(estimate.total),
                points: share.points as u64,
            });
        let alone = alone(&points, randomisations, &whole, &shares);
        let turned = |x: Option<f64>| x.map(|x| 1.0 - x);
        let [value, low, high] = with_ends(alone);
        let half = |share: Estimate| share.interval.map(|[low, high]| 0.5 * (high - low));
        let halves = whole.iter().flat_map(|k| [shares[*k].first, shares[*k].total]).filter_map(half);
        let half_width = halves.reduce(f64::max);
        let wanted = |half: f64| {
            let ratio = half / WELL_KNOWN;
            let wanted = (evaluated.len() as f64 * ratio * ratio / randomisations as f64).ceil();
            (ratio > 1.0).then_some(wanted as u64 * randomisations)
        };
        SensitivitySummary {
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
            alone: [value, low, high],
            interactions: [turned(value), turned(high), turned(low)],
            half_width,
            points_wanted: half_width.and_then(wanted),
            shown: quantity,
        }
    }
}

/// The possible shares of sources, some of which the layout consists of.
fn possible(sources: &[Source], shares: &[Share]) -> Vec<Share> {
    let layout = sources.iter().position(|own| !own.is_in_layout && own.name == LAYOUT);
    let part_of: Vec<Option<usize>> = sources.iter().map(|own| layout.filter(|_| own.is_in_layout)).collect();
    possible_shares(shares, &part_of)
}

/// The sum of the first order shares: its estimate's interval about the sum of the possible ones, within 0 and 1.
fn alone(points: &[BasePoint], randomisations: u64, whole: &[usize], shares: &[Share]) -> Estimate {
    let firsts: Option<Vec<f64>> = whole.iter().map(|k| shares[*k].first.value).collect();
    let Some(firsts) = firsts else { return Estimate::UNDEFINED };
    let value = firsts.iter().fold(0.0, |sum, first| sum + first).min(1.0);
    if whole.len() == 1 {
        return Estimate { value: Some(value), interval: Some([value; 2]) };
    }
    let estimate = share_alone(points, randomisations as usize, whole);
    let within = |ends: [f64; 2]| {
        let [low, high] = ends.map(|end| end.clamp(0.0, 1.0));
        [low.min(value), high.max(value)]
    };
    Estimate { value: Some(value), interval: estimate.interval.map(within) }
}

fn with_ends(estimate: Estimate) -> [Option<f64>; 3] {
    let [low, high] = estimate.interval.map_or([None; 2], |ends| ends.map(Some));
    [estimate.value, low, high]
}

/// The answer so far in a few words: the source with the largest total share.
pub fn running(sources: &[Source], points: &[BasePoint], randomisations: u64) -> String {
    let found = sensitivity(points, randomisations as usize);
    let shares = possible(sources, &found.shares);
    let totals = sources
        .iter()
        .zip(&shares)
        .filter_map(|(source, share)| Some((source.name.as_str(), share.total.value?)));
    match totals.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((name, total)) => format!("most from {name} so far: {} % in all", significant(100.0 * total, 2)),
        None => "no scatter so far".to_owned(),
    }
}
