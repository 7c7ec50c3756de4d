//! `pirca analyse`: a wall that somebody else made, with one command.

mod answer;
mod arguments;
mod fall;
mod fclib;
mod files;
mod joints;
mod known;
mod loads;
mod meetings;
mod numbers;
mod open;
mod page;
mod shaken;
mod solve;
mod state;
mod unsure;
mod upright;
mod verb;
mod worst;

pub(crate) use arguments::Analyse;
pub(crate) use verb::analyse;
