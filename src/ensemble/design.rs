//! The design of an ensemble: which walls are evaluated at which stiffness, in the order of the results.

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

/// Every evaluation that a study asks for: arm by arm, point by point, member by member. Of an arm that may have enough walls before,
/// all that it may come to.
pub fn plan(study: &Study) -> Vec<Task> {
    let all: Vec<u64> = study.arms.iter().map(|arm| arm.members).collect();
    plan_of(study, &all)
}

/// The same with so many walls in each arm.
pub(super) fn plan_of(study: &Study, members: &[u64]) -> Vec<Task> {
    let mut tasks = Vec::new();
    for ((arm, &members), index) in study.arms.iter().zip(members).zip(0u32..) {
        for point in 0..arm.kn_points.len() as u32 {
            tasks.extend((0..members).map(|member| Task { arm: index, point, member }));
        }
    }
    tasks
}

/// Whether the walls of an arm differ from member to member, see [`Arm::is_random`].
pub fn is_random(arm: &Arm) -> bool {
    arm.is_random()
}
