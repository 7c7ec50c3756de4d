//! Walls that are pushed out of plane: how far their top moves. It is read of all walls on a load path, tilted and sheared ones as well.

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Column, Members, Step, Steps, real};
use crate::ensemble::quantity::{Observed, Quantity, value};
use crate::ensemble::reading::finite;
use crate::ensemble::record::Row;
use crate::model::Outcome;
use crate::protocol::{LoadStep, Run};
use crate::solve::Solver;
use crate::study::{Mechanisms, Study};

/// How far the top of a wall has moved at a load step, since the end of gravity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TopStep {
    /// Largest displacement at the top in the direction of the load (m); `None` when it is not finite, as of all that follows.
    pub top_displacement_m: Option<f64>,
    /// Displacement of the left point of the top along +y (m).
    pub left_m: Option<f64>,
    /// The same at the centre (m).
    pub centre_m: Option<f64>,
    /// The same at the right end (m).
    pub right_m: Option<f64>,
    /// What is left of `left_m` when the platform goes back to the level from here (m); `None` unless the study asks for it and the
    /// wall comes to rest on the way.
    pub left_remainder_m: Option<f64>,
    /// The same at the centre (m).
    pub centre_remainder_m: Option<f64>,
    /// The same at the right end (m).
    pub right_remainder_m: Option<f64>,
}

impl TopStep {
    /// Off a load step of this number.
    pub(super) fn of(number: usize, step: &LoadStep, gauge: &Mechanisms) -> TopStep {
        let each = |points: Option<[f64; 3]>| match points {
            Some(points) => points.map(|x| read(gauge, number, x)),
            None => [None; 3],
        };
        let [left_m, centre_m, right_m] = each(step.points);
        let [left_remainder_m, centre_remainder_m, right_remainder_m] = each(step.remainders);
        TopStep {
            top_displacement_m: read(gauge, number, step.top_displacement),
            left_m,
            centre_m,
            right_m,
            left_remainder_m,
            centre_remainder_m,
            right_remainder_m,
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

/// Of the table of members.
pub(super) fn members() -> Vec<Column<Members>> {
    vec![real(
        "top_displacement_m",
        "m",
        "largest displacement at the wall's top along the load, at its end, since gravity alone; of walls in equilibrium",
        |r: &Row| r.reading.top_displacement_m,
    )]
}

/// How far along the load path.
pub(super) fn load_factor() -> Column<Steps> {
    real("load_factor", "", "share of the full load; none on a tilting table", |s: Step<'_>| {
        s.step.load_factor
    })
}

/// Of the table of load steps.
pub(super) fn top() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        real(
            "top_displacement_m",
            "m",
            "largest displacement at the wall's top along the load, since gravity alone",
            |s: S| s.step.top.top_displacement_m,
        ),
        real(
            "left_m",
            "m",
            "displacement of the left point of the top along y, since gravity alone",
            |s: S| s.step.top.left_m,
        ),
        real("centre_m", "m", "the same of the centre point", |s: S| s.step.top.centre_m),
        real("right_m", "m", "the same of the right point", |s: S| s.step.top.right_m),
        real(
            "left_remainder_m",
            "m",
            "what is left of left_m when the platform goes back to the level from here (load.remainders = true)",
            |s: S| s.step.top.left_remainder_m,
        ),
        real("centre_remainder_m", "m", "the same of the centre point", |s: S| s.step.top.centre_remainder_m),
        real("right_remainder_m", "m", "the same of the right point", |s: S| s.step.top.right_remainder_m),
    ]
}
