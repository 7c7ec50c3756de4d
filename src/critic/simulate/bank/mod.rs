//! A bank of simulated walls: every cause at many strengths, with joints that are known as badly as they are. It is computed
//! once for a design, and serves all diagnoses of it.

mod emulator;
mod outcomes;
mod path;
mod plan;
mod pushes;
mod store;
mod test;
#[cfg(test)]
pub mod tests;

pub use emulator::{Emulated, Emulator};
pub use outcomes::MOST_SOUGHT;
pub use path::{Curves, NUMBERS, PLACES, Path};
pub use plan::{PRIOR_WIDENING, Place, Plan};
pub use pushes::{Pushes, SHARES};
pub use store::{BANK, Bank, Held, NotThisBank};
pub use test::{Test, stand_in};
