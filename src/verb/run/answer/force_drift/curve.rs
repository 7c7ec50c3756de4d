//! The walls of an arm on a common grid of drifts, before anything is written or drawn.

use crate::critic::{Simulated, simulated};
use crate::ensemble::{Row, is_random};
use crate::stats;
use crate::stats::{Estimate, Sample};
use crate::study::{Arm, MeasuredQuantity, Study};

/// One more wall lies below and above the band with this probability each.
const BELOW: f64 = 0.05;
/// One arm at one kn.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceCurve {
    /// Name of the arm.
    pub arm: String,
    /// Normal stiffness of the joints as it is stated (Pa/m).
    pub kn: f64,
    /// Whether its walls differ.
    pub random: bool,
    /// By growing drift.
    pub points: Vec<ForcePoint>,
}

/// Its walls at one drift. Forces in N, those that walls bear when they first come there along x+.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForcePoint {
    /// Drift (%).
    pub drift_percent: f64,
    /// Walls that still stand there. Only these are in the numbers.
    pub walls: usize,
    /// Walls that fell before.
    pub fallen: usize,
    /// Walls that could not be built, or whose solver did not get there.
    pub lost: usize,
    /// Mean of those that stand, with its 95 % interval.
    pub mean: Estimate,
    /// Where one more wall that stands lies below with a probability of 5 %, by the walls alone; with the 95 % interval of the
    /// population's 5 % quantile.
    pub low: Estimate,
    /// The same for 95 %.
    pub high: Estimate,
}

/// The curves of a study's rows, arms in its order, kn ascending; empty where nothing was pushed from drift to drift.
pub fn force_curves(study: &Study, rows: &[Row]) -> Vec<ForceCurve> {
    if rows.iter().flat_map(|row| &row.load_steps).all(|step| step.jack.drift_percent.is_none()) {
        // Limit analysis knows no drift.
        return Vec::new();
    }
    let drifts = study.drifts();
    let curve = |(index, arm): (usize, &Arm), (point, kn): (usize, f64)| {
        let own = rows.iter().filter(|row| row.arm_index as usize == index && row.point as usize == point);
        let own: Vec<&Row> = own.collect();
        ForceCurve {
            arm: arm.name.clone(),
            kn,
            random: is_random(arm),
            points: drifts.iter().map(|drift| ForcePoint::of(*drift, &own, study.randomisations())).collect(),
        }
    };
    let arms = study.arms.iter().enumerate();
    let each = arms.flat_map(|arm| arm.1.kn_points.iter().copied().enumerate().map(move |kn| (arm, kn)));
    each.map(|(arm, kn)| curve(arm, kn)).collect()
}

impl ForcePoint {
    /// Of walls at a drift.
    fn of(drift: f64, rows: &[&Row], randomisations: u64) -> ForcePoint {
        let (mut forces, mut fallen) = (Vec::new(), 0);
        for row in rows {
            match simulated(MeasuredQuantity::ForceAtDrift, Some(drift), row) {
                Some(Simulated::Value(force)) => forces.push((row.member, force)),
                Some(Simulated::FellBefore) => fallen += 1,
                Some(Simulated::Above(_) | Simulated::Nothing) | None => {}
            }
        }
        let values: Vec<f64> = forces.iter().map(|(_, force)| *force).collect();
        let sample = Sample::of(forces, randomisations);
        let quantile = |p: f64| {
            let value = stats::predictive_quantile(&values, p);
            Estimate { value, interval: value.and_then(|_| sample.quantile(p).interval) }
        };
        ForcePoint {
            drift_percent: tidy(100.0 * drift),
            walls: values.len(),
            fallen,
            lost: rows.len() - values.len() - fallen,
            mean: sample.summary().mean,
            low: quantile(BELOW),
            high: quantile(1.0 - BELOW),
        }
    }
}

/// Without what the unit leaves in the last digits.
fn tidy(percent: f64) -> f64 {
    (percent * 1e9).round() / 1e9
}
