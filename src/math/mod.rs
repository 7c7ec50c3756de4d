//! Vectors, elementary functions on libm, angles at the border, and the invariant check that stays on in release;
//! monotone curves, disjoint sets, how far words are apart, numbers as people read them, and standard gravity.

mod curve;
mod elementary;
mod exponentials;
mod invariant;
mod monotone;
mod sets;
mod words;
mod written;

pub use curve::{Monotone, Share};
pub use elementary::*;
pub use exponentials::exp_all;
pub use monotone::monotone_slopes;
pub use sets::Sets;
pub use words::edit_distance;
pub use written::{compact, ends, significant, within};

/// Standard gravity (m/s^2).
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// A vector or a position in metres (or whatever unit the user of it states); x along the wall, y out of plane
/// (positive downhill), z up.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A 3 x 3 matrix; a rotation matrix maps body axes to world axes.
pub type Mat3 = nalgebra::Matrix3<f64>;
