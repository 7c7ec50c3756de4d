//! What is said of a campaign, and what that rests on.

mod decide;
mod detection;
mod diagnosis;
mod examine;
mod excluded;
mod judge;
mod limits;
#[cfg(test)]
mod tests;

pub use diagnosis::{Diagnosis, Examined, Verdict};
pub use examine::Examination;
pub use excluded::Excluded;
pub use judge::{Effort, Finding, Judge};
pub use limits::{Limits, MOST_AMBIGUOUS, PairLimits};
