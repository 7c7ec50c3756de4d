//! Which causes explain what is off: a ranking by how campaigns look, and the evidence of all readings.

mod density;
mod discrepant;
mod evidence;
mod likelihood;
mod network;
mod over_scopes;
mod ranking;
mod weighing;

pub use evidence::{Evidence, RUNS, evidence, evidence_again, outside_evidence, rough_evidence};
pub use network::softmax;
pub use over_scopes::OverScopes;
pub use ranking::{COVERED, Ranked, Ranking, inputs};
pub use weighing::{outside, reweighed, weighed};
