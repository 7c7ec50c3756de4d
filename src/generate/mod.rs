//! From a layout to a wall: bond, sizes, dip, wedge stones. `canonical` holds walls with known answers.

mod layout;

pub use layout::*;
