//! Periodic cells: stones of a layout that tile a plate without end, for homogenisation.

mod bond;
mod build;
mod courses;
mod fault;

pub use build::{GeneratedCell, generate_cell};
pub use fault::{CellFault, check_cell};
