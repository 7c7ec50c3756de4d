//! What the simulation gets wrong: measured campaigns beside those that the base model could have shown.

mod design;
mod doubt;
mod doubts;
mod extension;
mod features;
mod guard;
mod network;
mod ranking;
mod self_test;
#[cfg(test)]
mod tests;
mod verdict;
mod world;
mod wrong;

pub use design::{Campaign, Design, Seen, Specimen};
pub use doubt::Doubt;
pub use doubts::{doubts, doubts_beside};
pub use extension::{DRAWS, Extension, Known, extension};
pub use features::{Contrast, Feature, Scale, features};
pub use guard::{Guarded, guarded};
pub use ranking::{COVERED, Ranked, Ranking};
pub use self_test::{SelfTest, SelfTestRow};
pub use verdict::{Diagnosis, Limits, MOST_AMBIGUOUS, Verdict, diagnosed};
pub use world::{Truth, World};
pub use wrong::{Reference, Wrong};
