//! How the quantity of a study is called, scaled and shown.

use crate::ensemble::Quantity;

impl Quantity {
    /// The outcome of a wall that brings a value.
    pub fn wanted_outcome(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "equilibrium",
            Quantity::CollapseAngle => "collapsed",
            Quantity::ShearCapacity => "equilibrium",
            Quantity::CollapseAcceleration | Quantity::CollapseVelocity => "collapsed",
        }
    }

    /// Name in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "top_displacement",
            Quantity::CollapseAngle => "collapse_angle",
            Quantity::ShearCapacity => "shear_capacity",
            Quantity::CollapseAcceleration => "collapse_acceleration",
            Quantity::CollapseVelocity => "collapse_velocity",
        }
    }

    /// Unit in `summary.json`.
    pub fn unit(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "m",
            Quantity::CollapseAngle => "deg",
            Quantity::ShearCapacity => "N",
            Quantity::CollapseAcceleration => "m/s2",
            Quantity::CollapseVelocity => "m/s",
        }
    }

    /// Unit in tables and figures.
    pub fn shown_unit(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "mm",
            Quantity::CollapseAngle => "deg",
            Quantity::ShearCapacity => "kN",
            Quantity::CollapseAcceleration => "m/s2",
            Quantity::CollapseVelocity => "m/s",
        }
    }

    /// A number in the unit of tables and figures.
    pub fn shown(self, x: f64) -> f64 {
        match self {
            Quantity::TopDisplacement => x * 1e3,
            Quantity::CollapseAngle => x,
            Quantity::ShearCapacity => x * 1e-3,
            Quantity::CollapseAcceleration | Quantity::CollapseVelocity => x,
        }
    }

    /// The vertical axis of the figure.
    pub fn axis(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "out-of-plane displacement at the top (mm)",
            Quantity::CollapseAngle => "collapse angle (deg)",
            Quantity::ShearCapacity => "largest push along the wall (kN)",
            Quantity::CollapseAcceleration => "lowest PGA of a collapse (m/s2)",
            Quantity::CollapseVelocity => "lowest PGV of a collapse (m/s)",
        }
    }

    /// File name, without ending, of the figure over kn.
    pub fn figure(self) -> &'static str {
        match self {
            Quantity::TopDisplacement => "figure-10",
            Quantity::CollapseAngle => "capacity",
            Quantity::ShearCapacity => "shear",
            Quantity::CollapseAcceleration | Quantity::CollapseVelocity => "fragility",
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
            Quantity::CollapseAcceleration => {
                "the lowest peak ground acceleration at which some record brings the wall down"
            }
            Quantity::CollapseVelocity => {
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
            Quantity::CollapseAcceleration | Quantity::CollapseVelocity => {
                "not standing at rest, undecided, without a verdict, invalid geometry"
            }
        }
    }
}
