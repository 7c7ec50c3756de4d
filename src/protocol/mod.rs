//! What is done to a wall and what is observed: load path, stop rule, restraint.

mod drive;
mod observe;
mod pressure;
mod restraint;
mod settings;

pub use drive::{LoadStep, Run, run};
pub use pressure::{Load, back_loads};
pub use settings::{Ends, Lateral, Protocol};
