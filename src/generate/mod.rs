//! From a layout to a wall: bond, sizes, dip, wedge stones. `cell` makes periodic cells of the same layouts, `canonical` holds
//! walls with known answers, `elements` assemblies of other elements than stones.

pub mod canonical;
mod cell;
mod course;
mod coursed;
mod cut;
mod draft;
pub mod elements;
mod layout;
mod outline;
mod regular;
mod sizes;
mod sorted;
#[cfg(test)]
mod tests;
mod unseen;
mod wall;
mod wedge;

pub use cell::{CellFault, GeneratedCell, check_cell, generate_cell};
pub use layout::*;
pub use sizes::Sizes;
pub use unseen::Unseen;
pub use wall::{Generated, InvalidGeometry, Realised, generate, mean_density};
