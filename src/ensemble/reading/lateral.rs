//! Walls that are pushed out of plane: how far their top moves. It is read of all walls on a load path, tilted and sheared ones as well.

use serde::{Deserialize, Serialize};

use crate::ensemble::field::record;
use crate::ensemble::quantity::{Observed, Quantity, value};
use crate::ensemble::reading::finite;
use crate::ensemble::record::Row;
use crate::model::Outcome;
use crate::protocol::{LoadStep, Run};
use crate::solve::Solver;
use crate::study::{Mechanisms, Study};

record! {
    /// How far the top of a wall has moved at a load step (m); `None` where that is not finite. What is left is `None` as well unless the
    /// study asks for it and the wall comes to rest on the way back.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
    TopStep {
        top_displacement_m: Option<f64> = "top_displacement_m", "m",
            "largest displacement at the wall's top along the load, since gravity alone";
        left_m: Option<f64> =
            "left_m", "m", "displacement of the left point of the top along y, since gravity alone";
        centre_m: Option<f64> = "centre_m", "m", "the same of the centre point";
        right_m: Option<f64> = "right_m", "m", "the same of the right point";
        left_remainder_m: Option<f64> = "left_remainder_m", "m",
            "what is left of left_m when the platform goes back to the level from here (load.remainders = true)";
        centre_remainder_m: Option<f64> = "centre_remainder_m", "m", "the same of the centre point";
        right_remainder_m: Option<f64> = "right_remainder_m", "m", "the same of the right point";
    }
}

impl TopStep {
    /// Off a load step of this number.
    pub(super) fn of(number: usize, step: &LoadStep, gauge: &Mechanisms) -> TopStep {
        let at =
            |points: Option<[f64; 3]>, point: usize| points.and_then(|all| read(gauge, number, all[point]));
        TopStep {
            top_displacement_m: read(gauge, number, step.top_displacement),
            left_m: at(step.points, 0),
            centre_m: at(step.points, 1),
            right_m: at(step.points, 2),
            left_remainder_m: at(step.remainders, 0),
            centre_remainder_m: at(step.remainders, 1),
            right_remainder_m: at(step.remainders, 2),
        }
    }

    /// Displacements of the left point, the centre and the right point (m).
    pub fn points(&self) -> [Option<f64>; 3] {
        [self.left_m, self.centre_m, self.right_m]
    }

    /// What is left of them (m).
    pub fn remainders(&self) -> [Option<f64>; 3] {
        [self.left_remainder_m, self.centre_remainder_m, self.right_remainder_m]
    }
}

/// Where the top of a wall in equilibrium came to at the end (m).
pub(super) fn top_displacement(run: &Run, gauge: &Mechanisms) -> Option<f64> {
    let last = run.steps.last().filter(|_| run.outcome == Outcome::Equilibrium)?;
    read(gauge, run.steps.len() - 1, last.top_displacement)
}

/// What a gauge says of a displacement; the first reading is the zero reading.
fn read(gauge: &Mechanisms, number: usize, x: f64) -> Option<f64> {
    finite(if number == 0 { x } else { gauge.reading(x) })
}

/// The quantity of a study: limit analysis knows no displacement.
pub fn quantity(study: &Study) -> Quantity {
    match study.solver {
        Solver::Limit(_) => Quantity::LoadFactor,
        _ => Quantity::TopDisplacement,
    }
}

/// What a wall says of [`Quantity::TopDisplacement`].
pub fn displaced(row: &Row) -> Observed {
    match row.outcome {
        Outcome::Equilibrium => value(row.reading.top_displacement_m),
        _ => Observed::Nothing,
    }
}

/// What a wall says of [`Quantity::LoadFactor`].
pub fn borne(row: &Row) -> Observed {
    match row.outcome {
        Outcome::Collapsed { .. } | Outcome::Equilibrium => {
            value(row.limit.and_then(|limit| limit.multiplier.or(limit.non_associative_multiplier)))
        }
        // It bears the full load at the least.
        Outcome::Unbounded => Observed::Above(1.0),
        _ => Observed::Nothing,
    }
}
