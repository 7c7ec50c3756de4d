//! What a cause leaves open, as values of the study's keys: medians and draws of its parameters and of the joints.

use crate::critic::simulate::{Scored, Truth, World};
use crate::stats;
use crate::study::{Acting, Point};

/// Most draws of an extension.
pub const DRAWS: usize = 20;
/// Quantiles of the intervals.
const INTERVAL: [f64; 2] = [0.05, 0.95];

/// Causes as an extension of the base model.
#[derive(Clone, Debug, PartialEq)]
pub struct Extension {
    /// Every parameter and joint at its median.
    pub median: Point,
    /// Draws: of one all values belong together.
    pub draws: Vec<Point>,
    /// What is known of each value that varies.
    pub known: Vec<Known>,
}

/// What is known of a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Path of its key.
    pub key: String,
    /// Its unit; "1" for a plain number.
    pub unit: &'static str,
    /// Median.
    pub median: f64,
    /// 5 and 95 % quantile.
    pub interval: [f64; 2],
}

/// The extension by the causes of these truths, which are draws from what may be; at most [`DRAWS`] of them are kept, from all of
/// their order. `None` without a truth, or where these have no cause.
pub fn extension(world: &World<'_>, truths: &[Truth]) -> Option<Extension> {
    let scored: Vec<Scored<'_>> = world.scored(truths.first()?.causes).collect();
    if scored.is_empty() {
        return None;
    }
    let name = |score: &Scored<'_>| world.mechanisms()[score.cause].name;
    let families = world.study().measured_arms();
    // A row per truth: the parameters, then the factors on the joints by family.
    let rows: Vec<Vec<f64>> = truths
        .iter()
        .map(|truth| {
            let factors = families.iter().flat_map(|&family| world.factors(truth, family));
            world.parameters(truth).into_iter().chain(factors).collect()
        })
        .collect();
    let at = |p: f64| -> Option<Vec<f64>> {
        let column = |k: usize| stats::quantile(&rows.iter().map(|row| row[k]).collect::<Vec<_>>(), p);
        (0..rows[0].len()).map(column).collect()
    };
    let point = |row: &Vec<f64>| {
        let (parameters, factors) = row.split_at(scored.len());
        let valued: Vec<(&Scored<'_>, f64)> = scored.iter().zip(parameters.iter().copied()).collect();
        let sets = valued.chunk_by(|(a, _), (b, _)| (a.cause, a.kind) == (b.cause, b.kind));
        let acting = sets.map(|set| Acting {
            mechanism: name(set[0].0),
            parameters: set.iter().map(|(score, value)| (score.parameter.key, *value)).collect(),
            arms: set[0].0.kind.map(|kind| with_joints_of(world, kind, 0..world.study().arms.len())),
        });
        let acting = acting.collect();
        let joints = families.iter().zip(factors.chunks_exact(3));
        Point { acting, joints: joints.map(|(family, f)| (*family, [f[0], f[1], f[2]])).collect() }
    };
    let (median, low, high) = (at(0.5)?, at(INTERVAL[0])?, at(INTERVAL[1])?);
    let parameters = scored.iter().map(|score| {
        let key = format!("mechanism.{}.{}", name(score), score.parameter.key);
        let arms =
            score.kind.map_or(Vec::new(), |kind| with_joints_of(world, kind, families.iter().copied()));
        let below = arms.into_iter().map(|arm| format!("arm.{}.{key}", world.study().arms[arm].name));
        let keys: Vec<String> = if score.kind.is_none() { vec![key] } else { below.collect() };
        (keys, score.parameter.unit, 1.0)
    });
    let joints = families.iter().flat_map(|&family| {
        let arm = &world.study().arms[family];
        let stated = [
            ("kn_pa_per_m", "Pa/m", arm.kn_points[arm.middle_point()]),
            ("phi_deg", "deg", arm.joint.phi_deg.mean()),
            ("kn_over_ks", "1", arm.joint.kn_over_ks),
        ];
        stated.map(|(key, unit, stated)| (vec![format!("arm.{}.joint.{key}", arm.name)], unit, stated))
    });
    let known = parameters.chain(joints).enumerate().filter(|(k, _)| low[*k] < high[*k]);
    let known = known.flat_map(|(k, (keys, unit, stated))| {
        let known = Known {
            key: String::new(),
            unit,
            median: stated * median[k],
            interval: [stated * low[k], stated * high[k]],
        };
        keys.into_iter().map(move |key| Known { key, ..known.clone() })
    });
    let kept = truths.len().min(DRAWS);
    Some(Extension {
        known: known.collect(),
        draws: (0..kept).map(|k| point(&rows[k * truths.len() / kept])).collect(),
        median: point(&median),
    })
}

/// Those of some arms (by index) whose joints are of a kind.
fn with_joints_of(world: &World<'_>, kind: usize, arms: impl Iterator<Item = usize>) -> Vec<usize> {
    arms.filter(|arm| world.kind(*arm) == kind).collect()
}
