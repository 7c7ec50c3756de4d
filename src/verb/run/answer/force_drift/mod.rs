//! The push over the drift of walls that are sheared: arm by arm the mean, and the band in which one more wall would lie.

mod csv;
mod curve;
mod plot;

pub use csv::force_drift_csv;
pub use curve::force_curves;
pub use plot::force_drift;
