//! The design of an ensemble: which walls are evaluated at which stiffness, in the order of the results.

use crate::random::Family;
use crate::study::{Arm, Study};

/// One evaluation: a wall of an arm at one joint stiffness. The order of tasks is that of the result files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Task {
    /// Index of the arm in the study.
    pub arm: u32,
    /// Index of the kn point.
    pub point: u32,
    /// Index of the member: the same wall at every point, the same random numbers in every arm.
    pub member: u64,
}

/// Every evaluation that a study asks for: arm by arm, point by point, member by member.
pub fn plan(study: &Study) -> Vec<Task> {
    let mut tasks = Vec::new();
    for (arm, index) in study.arms.iter().zip(0u32..) {
        for point in 0..arm.kn_points.len() as u32 {
            tasks.extend((0..arm.members).map(|member| Task { arm: index, point, member }));
        }
    }
    tasks
}

/// Whether the walls of an arm differ from member to member: in their stones, in their joints, as a whole, or by a
/// mechanism that draws.
pub fn is_random(arm: &Arm) -> bool {
    let drawn = |family: &Family| !matches!(family, Family::Constant { .. });
    let joint = &arm.joint;
    let drawn_joints = [&joint.kn_factor, &joint.phi_deg, &joint.cohesion].into_iter().any(drawn);
    !arm.layout.is_fixed() || drawn_joints || arm.mechanisms.draws() || !arm.uncertain.is_empty()
}
