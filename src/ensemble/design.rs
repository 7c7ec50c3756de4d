//! The design of an ensemble: which walls are evaluated at which stiffness, in the order of the results.

use crate::generate::{Arrangement, Layout};
use crate::random::Family;
use crate::study::{Arm, Joint, Study};

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
    let points = study.kn_points.len() as u32;
    let arms = study.arms.iter().zip(0u32..);
    arms.flat_map(|(arm, index)| {
        (0..points)
            .flat_map(move |point| (0..arm.members).map(move |member| Task { arm: index, point, member }))
    })
    .collect()
}

/// Whether the walls of an arm differ from member to member, in their stones or in their joints.
pub fn is_random(arm: &Arm, joint: &Joint) -> bool {
    layout_is_random(&arm.layout)
        || [&joint.kn_factor, &joint.phi_deg, &joint.cohesion].into_iter().any(varies)
}

fn layout_is_random(layout: &Layout) -> bool {
    let arrangement = match layout.arrangement {
        Arrangement::Continuous { .. } | Arrangement::Discontinuous { .. } => false,
        Arrangement::Coursed { .. } | Arrangement::Cut { .. } => true,
    };
    let wedges = layout
        .wedges
        .as_ref()
        .is_some_and(|w| w.share > 0.0 && (w.share < 1.0 || varies(&w.height) || varies(&w.depth)));
    let share = layout.wythes.header_share;
    let headers = layout.wythes.count > 1 && share > 0.0 && share < 1.0;
    arrangement || wedges || headers || varies(&layout.density)
}

fn varies(family: &Family) -> bool {
    !matches!(family, Family::Constant { .. })
}
