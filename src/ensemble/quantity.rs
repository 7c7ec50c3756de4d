//! What a study's protocol measures of each wall.

use crate::ensemble::Row;
use crate::model::{Level, Outcome};
use crate::protocol::{Observes, Protocol};
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
            Quantity::CollapseAngle | Quantity::ShearCapacity | Quantity::CollapseIntensity(_) => value,
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
