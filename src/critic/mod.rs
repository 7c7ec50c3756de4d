//! Measured beside simulated: how far apart they are, and which joint stiffness the measurements speak for.

mod calibrate;
mod compare;
mod likelihood;
mod monotone;
mod neighbours;
mod points;
mod profile;
mod simulated;
#[cfg(test)]
pub(crate) mod tests;

pub use calibrate::{Calibration, CurvePoint, End, LEAST_POINTS, calibrate, calibrate_family};
pub use compare::{Beside, Difference, Measured, Ours, Walls, compare};
pub use likelihood::log_likelihood;
pub use monotone::Monotone;
pub use neighbours::{OtherPhi, other_friction};
pub use points::{AnglePoint, LeftOut, angles_of, points_of};
pub use simulated::{Simulated, simulated};
