//! What a calibration starts from: the collapse angles of an arm's walls at each kn, and those measured.

use crate::critic::compare::{Simulated, simulated};
use crate::ensemble::{Row, is_random};
use crate::stats;
use crate::study::{Arm, MeasuredQuantity, Measurement, Study};

/// Largest share of the walls of a point that may bring no angle.
const LOST: f64 = 0.05;

/// Collapse angles of the walls of an arm at one kn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnglePoint {
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Mean (rad).
    pub mean: f64,
    /// Standard deviation between walls (rad); 0 where nothing is drawn.
    pub sigma: f64,
    /// Walls; 0 where nothing is drawn, so that the mean has no sampling error.
    pub walls: u64,
}

/// A point in kn that cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Why.
    pub why: String,
}

/// The points of an arm in kn that can be used, and the others with the reason.
pub fn points_of(arm: &Arm, index: usize, rows: &[Row]) -> (Vec<AnglePoint>, Vec<LeftOut>) {
    let (mut points, mut left_out) = (Vec::new(), Vec::new());
    for (point, &kn) in arm.kn_points.iter().enumerate() {
        let own = rows.iter().filter(|row| row.arm_index as usize == index && row.point as usize == point);
        let shown: Vec<Simulated> =
            own.filter_map(|row| simulated(MeasuredQuantity::CollapseAngle, None, row)).collect();
        let angles: Vec<f64> =
            shown.iter().filter_map(|s| if let Simulated::Value(x) = s { Some(*x) } else { None }).collect();
        let stood = shown.iter().filter(|s| matches!(s, Simulated::Above(_))).count();
        let random = is_random(arm);
        let why = if stood > 0 {
            Some(format!("{stood} of {} walls stood to the end of the load path", arm.members))
        } else if angles.is_empty() || (arm.members as f64 - angles.len() as f64) > LOST * arm.members as f64
        {
            Some(format!("{} of {} walls bring no angle", arm.members - angles.len() as u64, arm.members))
        } else if random && angles.len() < 2 {
            Some("one wall does not show how walls scatter".to_string())
        } else {
            None
        };
        match (why, stats::mean(&angles)) {
            (None, Some(mean)) => points.push(AnglePoint {
                kn,
                mean,
                sigma: if random { stats::sigma(&angles).unwrap_or(0.0) } else { 0.0 },
                walls: if random { angles.len() as u64 } else { 0 },
            }),
            (why, _) => left_out.push(LeftOut { kn, why: why.unwrap_or_default() }),
        }
    }
    (points, left_out)
}

/// Measured collapse angles of a family.
pub fn angles_of<'s>(study: &'s Study, family: &str) -> Vec<&'s Measurement> {
    let of = |m: &&Measurement| m.family == family && m.quantity == MeasuredQuantity::CollapseAngle;
    study.measured.iter().filter(of).collect()
}
