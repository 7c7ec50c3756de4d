//! From a layout to a wall: bond, sizes, dip, wedge stones. `canonical` holds walls with known answers.

pub mod canonical;
mod layout;
mod wall;

pub use layout::*;
pub use wall::{Generated, InvalidGeometry, Realised, generate};
