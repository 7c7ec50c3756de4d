//! What the simulation gets wrong: measured campaigns beside those that the base model could have shown.

mod design;
mod features;
mod guard;
mod network;
mod ranking;
mod residual;
mod self_test;
#[cfg(test)]
pub(crate) mod tests;
mod verdict;
mod world;
mod wrong;

pub use design::{Campaign, Design, Seen, Specimen};
pub use features::{Contrast, Feature, Scale, features};
pub use guard::{Guarded, guarded};
pub use ranking::{COVERED, Ranked, Ranking};
pub use residual::{
    Band, Baseline, Curve, Expected, FamilyCurves, Group, Parts, Residual, Residuals, Side, base_curves,
    cause_curves,
};
pub use self_test::{SelfTest, SelfTestRow};
pub use verdict::{Diagnosis, Limits, MOST_AMBIGUOUS, Verdict, diagnosed};
pub use world::{Truth, World};
pub use wrong::{Reference, Wrong};
