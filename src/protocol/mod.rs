//! What is done to a wall and what is observed: load path, stop rule, restraint.

mod settings;

pub use settings::{Ends, Lateral, Protocol};
