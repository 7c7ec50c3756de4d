//! What a study's protocol measures of each wall.

use crate::ensemble::Row;
use crate::model::{Level, Outcome};
use crate::protocol::{Observes, Protocol};
use crate::solve::Solver;
use crate::study::{Measure, Study};

/// The quantity that a study is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The largest out-of-plane displacement at the wall's top under the full load or tilt (m), of walls in equilibrium.
    TopDisplacement,
    /// The tilt at which the wall falls, the last one borne (deg), of walls that collapse.
    CollapseAngle,
    /// The largest push that a wall bears along itself under a constant vertical load (N).
    ShearCapacity,
    /// The factor on the load at which rigid blocks fall, by limit analysis, which knows no displacement: 1 is the full load.
    LoadFactor,
    /// The lowest intensity at which some record brings the wall down, in this measure.
    CollapseIntensity(Measure),
}

/// What a wall says about the quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Observed {
    /// Its value.
    Value(f64),
    /// It is above this: the wall stood to the end of the load path.
    Above(f64),
    /// Nothing: it failed in another way.
    Nothing,
}

impl Quantity {
    /// That of a study.
    pub fn of(study: &Study) -> Quantity {
        match &study.protocol {
            Protocol::Lateral(_) if matches!(study.solver, Solver::Limit(_)) => Quantity::LoadFactor,
            Protocol::Lateral(_) => Quantity::TopDisplacement,
            Protocol::Tilting(tilting) => match tilting.observes {
                Observes::CollapseAngle => Quantity::CollapseAngle,
                Observes::Displacement => Quantity::TopDisplacement,
            },
            Protocol::Shear(_) => Quantity::ShearCapacity,
            Protocol::BaseMotion(_) => {
                let earthquakes = study.earthquakes.as_ref();
                Quantity::CollapseIntensity(earthquakes.map_or(Measure::Pga, |own| own.measure))
            }
        }
    }

    /// A value with the sign by which larger is stronger: of a displacement the other one.
    pub fn strength(self, value: f64) -> f64 {
        match self {
            Quantity::TopDisplacement => -value,
            Quantity::CollapseAngle
            | Quantity::ShearCapacity
            | Quantity::LoadFactor
            | Quantity::CollapseIntensity(_) => value,
        }
    }

    /// Whether a wall that ended so has a value of it, if that is finite.
    pub fn counts(self, outcome: &Outcome) -> bool {
        match outcome {
            Outcome::Equilibrium => !matches!(self, Quantity::CollapseAngle | Quantity::CollapseIntensity(_)),
            Outcome::Collapsed { .. } => self != Quantity::TopDisplacement,
            _ => false,
        }
    }

    /// What a row says about it.
    pub fn observed(self, row: &Row) -> Observed {
        let value = |x: Option<f64>| x.filter(|x| x.is_finite()).map_or(Observed::Nothing, Observed::Value);
        match (self, &row.outcome) {
            (Quantity::TopDisplacement, Outcome::Equilibrium) => value(row.top_displacement_m),
            (Quantity::CollapseAngle, Outcome::Collapsed { .. }) => value(row.collapse_angle_deg),
            (Quantity::CollapseAngle, Outcome::Equilibrium) => {
                row.largest_tilt_deg.map_or(Observed::Nothing, Observed::Above)
            }
            (Quantity::ShearCapacity, Outcome::Collapsed { .. } | Outcome::Equilibrium) => {
                value(row.shear.and_then(|shear| shear.capacity_n))
            }
            (Quantity::LoadFactor, Outcome::Collapsed { .. } | Outcome::Equilibrium) => {
                value(row.limit.and_then(|limit| limit.multiplier.or(limit.non_associative_multiplier)))
            }
            // It bears the full load at the least.
            (Quantity::LoadFactor, Outcome::Unbounded) => Observed::Above(1.0),
            (
                Quantity::CollapseIntensity(_),
                Outcome::Collapsed { at: Level::Acceleration(x) | Level::Velocity(x) },
            ) => Observed::Value(*x),
            (Quantity::CollapseIntensity(measure), Outcome::Equilibrium) => {
                let strongest = row.runs().map(|run| run.peak(measure)).reduce(f64::max);
                strongest.map_or(Observed::Nothing, Observed::Above)
            }
            _ => Observed::Nothing,
        }
    }
}
