//! How the quantity of a study is called, scaled and shown.

use crate::ensemble::Quantity;
use crate::study::Measure;

impl Quantity {
    /// Name in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "top_displacement",
            Quantity::CollapseAngle => "collapse_angle",
            Quantity::ShearCapacity => "shear_capacity",
            Quantity::LoadFactor => "load_factor",
            Quantity::RetainedHeight => "retained_height",
            Quantity::CollapseIntensity(Measure::Pga) => "collapse_acceleration",
            Quantity::CollapseIntensity(Measure::Pgv) => "collapse_velocity",
        }
    }

    /// Unit in `summary.json`.
    pub fn unit(self) -> &'static str {
        match self {
            Quantity::TopDisplacement | Quantity::RetainedHeight => "m",
            Quantity::CollapseAngle => "deg",
            Quantity::ShearCapacity => "N",
            Quantity::LoadFactor => "1",
            Quantity::CollapseIntensity(measure) => measure.unit(),
        }
    }

    /// Unit in tables and figures.
    pub fn shown_unit(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "mm",
            Quantity::RetainedHeight => "m",
            Quantity::CollapseAngle => "deg",
            Quantity::ShearCapacity => "kN",
            Quantity::LoadFactor => "full loads",
            Quantity::CollapseIntensity(measure) => measure.unit(),
        }
    }

    /// A number in the unit of tables and figures.
    pub fn shown(self, x: f64) -> f64 {
        match self {
            Quantity::TopDisplacement => x * 1e3,
            Quantity::CollapseAngle => x,
            Quantity::ShearCapacity => x * 1e-3,
            Quantity::LoadFactor => x,
            Quantity::RetainedHeight => x,
            Quantity::CollapseIntensity(_) => x,
        }
    }

    /// The vertical axis of the figure.
    pub fn axis(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "out-of-plane displacement at the top (mm)",
            Quantity::CollapseAngle => "collapse angle (deg)",
            Quantity::ShearCapacity => "largest push along the wall (kN)",
            Quantity::LoadFactor => "load at collapse over the full load",
            Quantity::RetainedHeight => "height behind the wall at its fall (m)",
            Quantity::CollapseIntensity(Measure::Pga) => "lowest PGA of a collapse (m/s2)",
            Quantity::CollapseIntensity(Measure::Pgv) => "lowest PGV of a collapse (m/s)",
        }
    }

    /// File name, without ending, of the figure over kn.
    pub fn figure(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "figure-10",
            Quantity::CollapseAngle => "capacity",
            Quantity::ShearCapacity => "shear",
            Quantity::LoadFactor => "load-factor",
            Quantity::RetainedHeight => "retained-height",
            Quantity::CollapseIntensity(_) => "fragility",
        }
    }

    /// In a sentence.
    pub fn words(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => {
                "the largest out-of-plane displacement at the wall's top under the full load"
            }
            Quantity::CollapseAngle => {
                "the tilt at which the wall falls: the last one at which it came to rest"
            }
            Quantity::ShearCapacity => {
                "the largest push along the wall that it bears under its constant vertical load"
            }
            Quantity::RetainedHeight => {
                "the height of what is behind the wall, above the foot of its back, at which it falls: the highest one borne"
            }
            Quantity::LoadFactor => {
                "the factor on the full load at which rigid blocks fall, by limit analysis: a wall bears its load from 1 on"
            }
            Quantity::CollapseIntensity(Measure::Pga) => {
                "the lowest peak ground acceleration at which some record brings the wall down"
            }
            Quantity::CollapseIntensity(Measure::Pgv) => {
                "the lowest peak ground velocity at which some record brings the wall down"
            }
        }
    }

    /// Which walls bring no value.
    pub fn failed_words(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "collapsed, not converged, non-finite, invalid geometry",
            Quantity::CollapseAngle => "not standing at rest, not converged, non-finite, invalid geometry",
            Quantity::ShearCapacity => "not standing at rest, not converged, non-finite, invalid geometry",
            Quantity::RetainedHeight => "not standing at rest, not converged, non-finite, invalid geometry",
            Quantity::LoadFactor => "not standing at rest, not converged, non-finite, invalid geometry",
            Quantity::CollapseIntensity(_) => {
                "not standing at rest, undecided, without a verdict, invalid geometry"
            }
        }
    }
}
