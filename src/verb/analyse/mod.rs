//! `pirca analyse`: a wall that somebody else made, with one command.

mod answer;
mod as_study;
pub(crate) mod ask;
mod closed;
mod demand;
mod drawn;
mod fall;
mod fclib;
mod files;
mod held;
mod joints;
mod known;
mod loads;
mod mended;
mod numbers;
mod open;
mod opinions;
mod page;
mod shaken;
mod solve;
mod state;
pub(crate) mod uncertainty;
mod unsure;
mod upright;
mod verb;
mod verify;
mod views;
mod worst;

pub(crate) use ask::Analyse;
pub use uncertainty::{
    Answered, AskedOfWall, Ended, UncertaintySummary, uncertainty_text, write_uncertainty,
};
pub(crate) use verb::analyse;
