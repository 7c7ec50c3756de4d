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
    all_in_order(study).collect()
}

/// The same one after the other, of runs whose tasks do not fit into memory.
pub(super) fn all_in_order(study: &Study) -> impl Iterator<Item = Task> {
    in_order(study, study.arms.iter().map(|arm| arm.members))
}

/// How many a study asks for.
pub fn evaluations(study: &Study) -> u64 {
    study.arms.iter().map(|arm| arm.members * arm.kn_points.len() as u64).sum()
}

/// The same with so many walls in each arm.
pub(super) fn plan_of(study: &Study, members: &[u64]) -> Vec<Task> {
    in_order(study, members.iter().copied()).collect()
}

fn in_order(study: &Study, members: impl Iterator<Item = u64>) -> impl Iterator<Item = Task> {
    let points = study.arms.iter().zip(members).zip(0u32..).flat_map(|((arm, members), index)| {
        (0..arm.kn_points.len() as u32).map(move |point| (index, point, members))
    });
    points.flat_map(|(arm, point, members)| (0..members).map(move |member| Task { arm, point, member }))
}

/// Whether the walls of an arm differ from member to member, see [`Arm::is_random`].
pub fn is_random(arm: &Arm) -> bool {
    arm.is_random()
}
