//! The joint stiffness that measured collapse angles speak for.

mod calibration;
mod friction;
mod points;
mod profile;

pub use calibration::{Calibration, CurvePoint, End, LEAST_POINTS, calibrate, calibrate_family};
pub use friction::{OtherPhi, other_friction};
pub use points::{AnglePoint, LeftOut, angles_of, points_of};
