//! Files for ParaView and whatever else reads VTK's XML formats: a wall, and the series of its states over a load path.

mod joints;
mod series;
mod wall;
mod xml;

pub use series::{SERIES, write_series};
pub use wall::write_vtu;
