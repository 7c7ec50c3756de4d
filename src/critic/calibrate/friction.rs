//! How the stiffness found hangs on the friction angle, from arms that differ in nothing else.

use crate::critic::calibrate::calibration::{Calibration, calibrate};
use crate::critic::calibrate::points::{angles_of, points_of};
use crate::ensemble::Row;
use crate::study::{Arm, Joint, Study};

/// The calibration that the same measured angles give with the walls of another arm, of other friction.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherPhi {
    /// Name of that arm.
    pub arm: String,
    /// Mean of its friction angle (deg).
    pub phi_deg: f64,
    /// What comes out.
    pub calibration: Calibration,
}

/// Every arm that differs from this one in its friction angle alone (and in name, number of walls and points in kn), with
/// what the measured angles of this one's family give there.
pub fn other_friction(study: &Study, index: usize, rows: &[Row]) -> Vec<OtherPhi> {
    let Some(own) = study.arms.get(index) else { return Vec::new() };
    let readings = angles_of(study, &own.name);
    let others = study.arms.iter().enumerate().filter(|(_, arm)| differs_in_friction_alone(own, arm));
    others
        .filter_map(|(other, arm)| {
            let calibration = calibrate(&points_of(arm, other, rows).0, &readings)?;
            Some(OtherPhi { arm: arm.name.clone(), phi_deg: arm.joint.phi_deg.mean(), calibration })
        })
        .collect()
}

fn differs_in_friction_alone(own: &Arm, other: &Arm) -> bool {
    let otherwise_same = Arm {
        name: own.name.clone(),
        members: own.members,
        kn_points: own.kn_points.clone(),
        joint: Joint { phi_deg: own.joint.phi_deg.clone(), ..other.joint.clone() },
        ..other.clone()
    };
    own.joint.phi_deg != other.joint.phi_deg && otherwise_same == *own
}
