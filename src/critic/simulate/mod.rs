//! Campaigns as they could have been measured: a bank of simulated walls, emulators between its points, and what is read of the
//! walls of a design.

pub mod bank;
mod by_cause;
mod causes;
mod design;
mod queries;
mod truth;
mod unmodelled;
mod world;

#[cfg(test)]
pub use bank::NUMBERS;
pub use bank::{
    BANK, Bank, Emulator, Held, MOST_SOUGHT, NotThisBank, PRIOR_WIDENING, Path, Place, Plan, Test, stand_in,
};
pub(in crate::critic) use by_cause::ByCause;
pub use causes::{Causes, Scope};
pub use design::{Campaign, Design, Seen, Specimen, Unused};
pub(in crate::critic) use design::{Side, motions};
pub use queries::Queries;
pub use truth::Truth;
pub(in crate::critic) use world::{MayShow, standing};
pub use world::{Scored, World};
