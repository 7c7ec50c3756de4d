//! What a simulated wall shows of a measured quantity.

use crate::ensemble::{Observed, Quantity, Row, StepRow};
use crate::math::radians;
use crate::model::Outcome;
use crate::protocol::first_at;
use crate::study::MeasuredQuantity;

/// Two tilts that are nearer than this are one (deg): what the halving of steps and their sums leave.
const SAME_TILT_DEG: f64 = 1e-9;

/// What a simulated wall shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Simulated {
    /// The value (SI).
    Value(f64),
    /// It is above this (SI): the wall stood to the end of the load path.
    Above(f64),
    /// Nothing: the wall fell before the tilt of the reading.
    FellBefore,
    /// Nothing: the solver did not get there, or the wall could not be built.
    Nothing,
}

/// What a row shows of a quantity read at a tilt (rad, on the way up) or a drift (the first time along x+); `None` where the simulation has no such quantity:
/// joint properties go into it, single blocks are not weighed, and gauges are no part of it.
///
/// A displacement is that of the load step at the tilt, a remainder what is left after it; between two steps it is interpolated
/// linearly.
pub fn simulated(quantity: MeasuredQuantity, at: Option<f64>, row: &Row) -> Option<Simulated> {
    use MeasuredQuantity as Q;
    let found = match quantity {
        Q::CollapseAngle => match Quantity::CollapseAngle.observed(row) {
            Observed::Value(angle) => Simulated::Value(radians(angle)),
            Observed::Above(angle) => Simulated::Above(radians(angle)),
            Observed::Nothing => Simulated::Nothing,
        },
        Q::SpecimenWeight => row.built.weight_n.map_or(Simulated::Nothing, Simulated::Value),
        Q::DisplacementLeft
        | Q::DisplacementCentre
        | Q::DisplacementRight
        | Q::DisplacementMean
        | Q::DisplacementCentreMinusEnds
        | Q::RemainderLeft
        | Q::RemainderCentre
        | Q::RemainderRight
        | Q::RemainderMean
        | Q::RemainderCentreMinusEnds => displacement(quantity, at?, row),
        Q::ForceAtDrift => force(100.0 * at?, row),
        Q::JointKn
        | Q::JointPhi
        | Q::BlockWeight
        | Q::FixedTarget
        | Q::Outcome
        | Q::PeakDisplacement
        | Q::ResidualDisplacement => return None,
    };
    Some(found)
}

/// The push (N) when the wall first came to a drift (%), by straight lines between the steps.
fn force(drift_percent: f64, row: &Row) -> Simulated {
    if let Some(push) = first_at(row.pushes(), drift_percent) {
        return Simulated::Value(push);
    }
    match row.outcome {
        Outcome::Collapsed { .. } | Outcome::UnstableAtRest => Simulated::FellBefore,
        _ => Simulated::Nothing,
    }
}

fn displacement(quantity: MeasuredQuantity, tilt: f64, row: &Row) -> Simulated {
    let steps = at_rest(row);
    let tilt_deg = crate::math::degrees(tilt);
    if steps.last().is_none_or(|(last, _)| *last < tilt_deg - SAME_TILT_DEG) {
        return match row.outcome {
            Outcome::Collapsed { .. } | Outcome::UnstableAtRest => Simulated::FellBefore,
            _ => Simulated::Nothing,
        };
    }
    // Nothing is left of nothing, and no platform goes back from a step that was halved.
    let mut known = if quantity.is_remainder() { vec![(0.0, 0.0)] } else { Vec::new() };
    known.extend(steps.into_iter().filter_map(|(at, step)| Some((at, read(quantity, step)?))));
    let Some(above) = known.iter().position(|(at, _)| *at >= tilt_deg - SAME_TILT_DEG) else {
        return Simulated::Nothing;
    };
    let (upper_tilt, upper) = known[above];
    let value = if (upper_tilt - tilt_deg).abs() <= SAME_TILT_DEG {
        Some(upper)
    } else {
        above.checked_sub(1).map(|below| {
            let (lower_tilt, lower) = known[below];
            let share = (tilt_deg - lower_tilt) / (upper_tilt - lower_tilt);
            (1.0 - share) * lower + share * upper
        })
    };
    value.map_or(Simulated::Nothing, Simulated::Value)
}

/// The load steps at which the wall was at rest, tilts ascending; the step in which it fell is not among them.
pub fn at_rest(row: &Row) -> Vec<(f64, &StepRow)> {
    let reached = match row.outcome {
        Outcome::Collapsed { .. } => row.collapse_angle_deg(),
        _ => row.reading.tilting.largest_tilt_deg,
    };
    let mut steps: Vec<(f64, &StepRow)> = Vec::new();
    for step in &row.load_steps {
        let Some((tilt, reached)) = step.tilt_deg.zip(reached) else { continue };
        let rising = steps.last().is_none_or(|(last, _)| tilt > *last);
        if tilt > reached + SAME_TILT_DEG || !rising {
            break;
        }
        steps.push((tilt, step));
    }
    steps
}

/// The quantity at a step (m).
fn read(quantity: MeasuredQuantity, step: &StepRow) -> Option<f64> {
    let points = match quantity.is_remainder() {
        false => step.top.points(),
        true => step.top.remainders(),
    };
    of_points(quantity, [points[0]?, points[1]?, points[2]?])
}

/// A displacement (m), or what is left of it, from those of the left end, the centre and the right end; `None` where the quantity is
/// neither.
pub fn of_points(quantity: MeasuredQuantity, [left, centre, right]: [f64; 3]) -> Option<f64> {
    match quantity.remains_of().unwrap_or(quantity) {
        MeasuredQuantity::DisplacementLeft => Some(left),
        MeasuredQuantity::DisplacementCentre => Some(centre),
        MeasuredQuantity::DisplacementRight => Some(right),
        MeasuredQuantity::DisplacementMean => Some((left + centre + right) / 3.0),
        MeasuredQuantity::DisplacementCentreMinusEnds => Some(centre - 0.5 * (left + right)),
        _ => None,
    }
}
