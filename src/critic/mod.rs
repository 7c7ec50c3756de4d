//! Measured beside simulated: how far they are apart, which joint stiffness the measurements speak for, which mechanisms they
//! could see, and which cause explains what the base model does not.
//!
//! Every stage is a folder, and imports from earlier ones alone. [`diagnose`] is the method from the first stage to the last.

mod advise;
mod calibrate;
mod causes;
mod check;
mod compare;
mod conflict;
mod detectability;
mod discrepancy;
mod extend;
#[cfg(test)]
mod fixture;
mod gain;
mod joint_law;
mod method;
mod screening;
#[cfg(test)]
mod shaken;
#[cfg(test)]
mod sheared;
mod simulate;
#[cfg(test)]
pub(crate) mod tests;
mod verdict;

pub use advise::{Counted, DETECTION_POWER, DetectionLimit, Offer, Offered, SelfTest, SelfTestRow, offers};
pub use calibrate::{
    AnglePoint, Calibration, CurvePoint, End, LEAST_POINTS, LeftOut, OtherPhi, angles_of, calibrate,
    calibrate_family, other_friction, points_of,
};
pub use causes::{COVERED, Evidence, OverScopes, Ranked, Ranking, evidence};
pub use check::Relation;
pub use compare::{Beside, Difference, Measured, Ours, Simulated, Walls, compare, log_likelihood, simulated};
pub use conflict::PriorPredictive;
pub use detectability::{
    Cell, Change, Detectability, DetectabilitySettings, Effect, NoDetectability, Observable, SEEN, Sight,
    detectability,
};
pub use discrepancy::{
    Band, Baseline, Component, ComponentEstimate, Contrast, Discrepancy, Expected, Feature, Group, Parts,
    Reference, Residual, Residuals, Scale, Side, features,
};
pub use extend::{
    Curve, DRAWS, Extension, FamilyCurves, Known, base_curves, best_curves, cause_curves, extension,
    fitted_curves,
};
#[cfg(test)]
pub(crate) use fixture::{Made, made};
pub use gain::{Between, Choice, Folds, Gain, Gained, HeldOut, Interval, Measuring, Scores};
pub use joint_law::{Bend, KnownLaw, LawGain, LearntLaw, NamedForm, Nearness, NotLearnt, learnt_law};
pub use method::{Analysis, SEEDS, Step, Steps, Task, diagnose};
pub use screening::{DataNote, Extent, data_notes, data_notes_by_simulation};
pub use simulate::{
    BANK, Bank, Campaign, Causes, Design, Emulator, Held, MOST_SOUGHT, NotThisBank, PRIOR_WIDENING, Path,
    Place, Plan, Scope, Scored, Seen, Specimen, Test, Truth, Unused, World, stand_in,
};
pub use verdict::{
    Diagnosis, Effort, Examination, Examined, Excluded, Finding, Judge, Limits, MOST_AMBIGUOUS, PairLimits,
    Verdict,
};
