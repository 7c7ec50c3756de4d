//! A bank of simulated walls: every cause at many strengths, with joints that are known as badly as they are. It is computed
//! once for a design, and serves all diagnoses of it.

mod emulator;
mod path;
mod plan;
mod store;
#[cfg(test)]
pub mod tests;

pub use emulator::{Emulated, Emulator};
pub use path::{Curves, HALF_WAY, NUMBERS, PLACES, Path};
pub use plan::{PRIOR_WIDENING, Place, Plan};
pub use store::{BANK, Bank, Held, NotThisBank};
