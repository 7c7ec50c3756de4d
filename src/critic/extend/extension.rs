//! What a cause leaves open, as values of the study's keys: medians and draws of its parameters and of the joints.

use crate::critic::simulate::{Truth, World};
use crate::stats;
use crate::study::{Acting, Described, Point};

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
    let causes = truths.first()?.causes.each();
    let mechanisms: Vec<&Described> = causes.map(|cause| &world.mechanisms()[cause]).collect();
    let each =
        || mechanisms.iter().flat_map(|mechanism| mechanism.parameters.iter().map(move |p| (mechanism, p)));
    if mechanisms.is_empty() {
        return None;
    }
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
        let (mut parameters, factors) = row.split_at(each().count());
        let acting = mechanisms.iter().map(|mechanism| {
            let (own, others) = parameters.split_at(mechanism.parameters.len());
            parameters = others;
            let parameters = mechanism.parameters.iter().map(|p| p.key).zip(own.iter().copied());
            Acting { mechanism: mechanism.name, parameters: parameters.collect() }
        });
        let acting = acting.collect();
        let joints = families.iter().zip(factors.chunks_exact(3));
        Point { acting, joints: joints.map(|(family, f)| (*family, [f[0], f[1], f[2]])).collect() }
    };
    let (median, low, high) = (at(0.5)?, at(INTERVAL[0])?, at(INTERVAL[1])?);
    let parameters =
        each().map(|(mechanism, p)| (format!("mechanism.{}.{}", mechanism.name, p.key), p.unit, 1.0));
    let joints = families.iter().flat_map(|&family| {
        let arm = &world.study().arms[family];
        let stated = [
            ("kn_pa_per_m", "Pa/m", arm.kn_points[arm.middle_point()]),
            ("phi_deg", "deg", arm.joint.phi_deg.mean()),
            ("kn_over_ks", "1", arm.joint.kn_over_ks),
        ];
        stated.map(|(key, unit, stated)| (format!("arm.{}.joint.{key}", arm.name), unit, stated))
    });
    let known = parameters.chain(joints).enumerate().filter(|(k, _)| low[*k] < high[*k]);
    let known = known.map(|(k, (key, unit, stated))| Known {
        key,
        unit,
        median: stated * median[k],
        interval: [stated * low[k], stated * high[k]],
    });
    let kept = truths.len().min(DRAWS);
    Some(Extension {
        known: known.collect(),
        draws: (0..kept).map(|k| point(&rows[k * truths.len() / kept])).collect(),
        median: point(&median),
    })
}
