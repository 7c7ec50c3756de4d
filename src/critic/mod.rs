//! Measured beside simulated: how far apart they are, which joint stiffness the measurements speak for, and which mechanisms
//! they could see.

mod bank;
mod calibrate;
mod compare;
mod diagnose;
mod joint_law;
mod likelihood;
mod monotone;
mod neighbours;
mod observable;
mod points;
mod profile;
mod sensitivity;
mod simulated;
#[cfg(test)]
pub(crate) mod tests;

pub use bank::{BANK, Bank, DOUBT, Emulator, Held, NotThisBank, Path, Place, Plan};
pub use calibrate::{Calibration, CurvePoint, End, LEAST_POINTS, calibrate, calibrate_family};
pub use compare::{Beside, Difference, Measured, Ours, Walls, compare};
#[cfg(test)]
pub(crate) use diagnose::tests::{Made, made};
pub use diagnose::{
    Band, Baseline, Bent, CAUGHT, COVERED, Campaign, Caught, Causes, Choice, Contrast, Counted, Curve, DRAWS,
    Design, Diagnosis, Doubt, Effort, Evidence, Excluded, Expected, Extension, FamilyCurves, Feature, Folds,
    Gain, Gained, Group, HeldOut, Interval, Judge, Known, Lacking, Limits, LookedAt, MOST_AMBIGUOUS,
    Measuring, Offer, Offered, PairLimits, Parts, Ranked, Ranking, Reference, Residual, Residuals, Scale,
    Scores, Seeming, Seen, SelfTest, SelfTestRow, Side, Specimen, Told, Truth, Unused, Verdict, World, Wrong,
    base_curves, cause_curves, doubts, doubts_beside, evidence, extension, features, guarded, log_weight,
    offers,
};
pub use joint_law::{Bend, KnownLaw, LawGain, LearntLaw, NamedForm, Nearness, NotLearnt, learnt_law};
pub use likelihood::log_likelihood;
pub use monotone::Monotone;
pub use neighbours::{OtherPhi, other_friction};
pub use observable::Observable;
pub use points::{AnglePoint, LeftOut, angles_of, points_of};
pub use sensitivity::{
    Cell, Change, Effect, NoSensitivity, SEEN, Sensitivity, SensitivitySettings, Sight, sensitivity,
};
pub use simulated::{Simulated, simulated};
