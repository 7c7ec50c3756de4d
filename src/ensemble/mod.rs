//! From a study to a table of members: plan, evaluate in parallel, record, resume.

mod design;
mod draws;
mod elements;
mod error;
mod evaluate;
mod files;
mod journal;
mod manifest;
mod progress;
mod quantity;
mod rare;
mod record;
mod run;
mod selection;
mod table;

/// What [`build`] gives.
pub use crate::generate::Generated;
pub use design::{Task, is_random, plan};
pub use draws::Draws;
pub use elements::{ElementRow, Timed, evaluate_element, run_elements};
pub use error::{MemberFault, RunError};
pub use evaluate::{build, evaluate, solve, weight};
pub use files::replace_file;
pub use manifest::Manifest;
pub use progress::{Progress, Silent};
pub use quantity::{Observed, Quantity};
pub use rare::{Draw, RareWalls};
pub use record::{LimitAnalysis, Mechanism, Row, ShearRow, StepRow};
pub use run::{Evaluations, Settings, run, run_with};
pub use selection::{Contest, Hopeless, Look};
pub(crate) use table::parquet;
