//! What the simulation gets wrong: measured campaigns beside those that the base model could have shown.

mod across;
mod alarm;
mod alike;
mod asked;
mod caught;
mod causes;
mod conflict;
mod design;
mod diagnosed;
mod discrepancy;
mod doubt;
mod doubts;
mod evidence;
mod excluded;
mod extension;
mod features;
mod fellows;
mod gain;
mod guard;
mod impossible;
mod judge;
mod likelihood;
mod limits;
mod nameless;
mod network;
mod next;
mod predicted;
mod ranking;
mod residual;
mod self_test;
#[cfg(test)]
pub(crate) mod tests;
mod units;
mod verdict;
mod world;
mod wrong;

pub use caught::{CAUGHT, Caught};
pub use causes::Causes;
pub use design::{Campaign, Design, Seen, Specimen, Unused};
pub use discrepancy::{Bent, Lacking};
pub use doubt::{Doubt, Told};
pub use doubts::{doubts, doubts_beside};
pub use evidence::{Evidence, evidence};
pub use excluded::Excluded;
pub use extension::{DRAWS, Extension, Known, extension};
pub use features::{Contrast, Feature, Scale, features};
pub use gain::{Choice, Folds, Gain, Gained, HeldOut, Interval, Measuring, Scores};
pub use guard::guarded;
pub use judge::{Effort, Judge, Seeming};
pub use limits::{Limits, MOST_AMBIGUOUS, PairLimits};
pub use next::{Offer, Offered, offers};
pub use ranking::{COVERED, Ranked, Ranking};
pub use residual::{
    Band, Baseline, Curve, Expected, FamilyCurves, Group, Parts, Residual, Residuals, Side, base_curves,
    cause_curves,
};
pub use self_test::{Counted, SelfTest, SelfTestRow};
pub use verdict::{Diagnosis, LookedAt, Verdict};
pub use world::{Truth, World, log_weight};
pub use wrong::{Reference, Wrong};
