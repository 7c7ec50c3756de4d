//! What is done to a wall and what is observed: load path, stop rule, restraint.

mod drive;
mod settings;

pub use drive::{LoadStep, Run, run};
pub use settings::{Ends, Lateral, Protocol};
