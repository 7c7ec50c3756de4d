//! What a study's protocol measures of each wall.

use crate::ensemble::reading::{base_motion, lateral, retaining, shear, tilting};
use crate::ensemble::record::Row;
use crate::model::Outcome;
use crate::protocol::Protocol;
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
    /// The height (m) of fill or water behind a wall at which it falls, the highest one borne, of walls that collapse.
    RetainedHeight,
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
            Protocol::Lateral(_) => lateral::quantity(study),
            Protocol::Tilting(tilting) => tilting::quantity(tilting),
            Protocol::Shear(_) => Quantity::ShearCapacity,
            Protocol::BaseMotion(_) => base_motion::quantity(study),
            Protocol::Retaining(_) => Quantity::RetainedHeight,
        }
    }

    /// A value with the sign by which larger is stronger: of a displacement the other one.
    pub fn strength(self, value: f64) -> f64 {
        match self {
            Quantity::TopDisplacement => -value,
            Quantity::CollapseAngle
            | Quantity::ShearCapacity
            | Quantity::LoadFactor
            | Quantity::CollapseIntensity(_)
            | Quantity::RetainedHeight => value,
        }
    }

    /// Whether a wall that ended so has a value of it, if that is finite.
    pub fn counts(self, outcome: &Outcome) -> bool {
        match outcome {
            Outcome::Equilibrium => !matches!(
                self,
                Quantity::CollapseAngle | Quantity::CollapseIntensity(_) | Quantity::RetainedHeight
            ),
            Outcome::Collapsed { .. } => self != Quantity::TopDisplacement,
            _ => false,
        }
    }

    /// What a row says about it.
    pub fn observed(self, row: &Row) -> Observed {
        match self {
            Quantity::TopDisplacement => lateral::displaced(row),
            Quantity::LoadFactor => lateral::borne(row),
            Quantity::CollapseAngle => tilting::fell(row),
            Quantity::ShearCapacity => shear::capacity(row),
            Quantity::CollapseIntensity(measure) => base_motion::collapses(row, measure),
            Quantity::RetainedHeight => retaining::fell(row),
        }
    }
}

/// A number that a wall has, if it is one.
pub(super) fn value(x: Option<f64>) -> Observed {
    x.filter(|x| x.is_finite()).map_or(Observed::Nothing, Observed::Value)
}
