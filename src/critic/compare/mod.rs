//! Measured beside simulated: what walls show of every reading, and how far the two are apart.

mod beside;
mod likelihood;
mod simulated;

pub use beside::{
    Beside, Difference, Group, Measured, Ours, Walls, compare, error_of_mean, groups, is_rising, known,
    measured, order_of_tilt, reading_variance, scatter,
};
pub use likelihood::log_likelihood;
pub use simulated::{Simulated, at_rest, of_points, simulated};
