//! Which blocks touch and where: broad phase, separating axes, patches, sub-contacts. Takes shapes and poses only;
//! no solver, no random numbers.

mod broad;
mod cells;
mod patch;
mod periodic;
mod seats;
mod separation;
mod survey;
#[cfg(test)]
mod tests;
mod vertices;

pub use broad::{candidate_pairs, candidate_pairs_up_to};
pub use cells::{Cell, corners, divide};
use cells::{contains, patches};
pub use patch::{FACE_COSINE, Feature, Patch, Settings, facing, find_patch};
pub use periodic::{PeriodicJoint, periodic_joints};
use seats::seated;
pub use separation::{EdgeAxis, FaceAxis, best_edge_axis, best_face_axis};
pub use survey::{MOST_NEAR, Pair, Survey, survey};
pub use vertices::{area_shares, distinct, middle_line};
