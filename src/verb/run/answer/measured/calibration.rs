//! What measured collapse angles say of an arm's joint stiffness, in the units of files.

use crate::critic::{Calibration, End, LeftOut, OtherPhi, angles_of};
use crate::study::{Arm, Study};
use crate::verb::run::answer::measured::comparison::tidy_degrees;
use crate::verb::run::answer::measured::panel::{Angle, Panel};

/// The calibration of one arm. Ends that lie beyond the points simulated are null.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct CalibrationEntry {
    /// The arm.
    pub arm: String,
    /// Specimens with a measured angle.
    pub specimens: u64,
    /// The most likely kn (Pa/m); null where the likelihood still rises at an end of the points simulated.
    pub kn_pa_per_m: Option<f64>,
    /// The 68 % interval (likelihood ratio).
    pub kn_68_pa_per_m: [Option<f64>; 2],
    /// The 95 % interval.
    pub kn_95_pa_per_m: [Option<f64>; 2],
    /// Deviances at which the two intervals end; a large sample would have 0.99 and 3.84.
    pub deviance_limits: [f64; 2],
    /// Scatter between specimens beyond that of our walls, at the most likely kn, one standard deviation.
    pub extra_scatter_deg: f64,
    /// Friction angle of the joints, held (its mean where it is drawn).
    pub phi_deg: f64,
    /// The same angles against arms that differ in friction alone.
    pub other_friction: Vec<OtherFriction>,
    /// Points in kn used (Pa/m).
    pub points_pa_per_m: Vec<f64>,
    /// Points in kn that could not be used.
    pub left_out: Vec<LeftOutPoint>,
    /// The most by which the curve through the points misses one that it is drawn without.
    pub interpolation_error_deg: f64,
    /// What the intervals do not hold.
    pub note: &'static str,
    /// For the figure and its table.
    #[serde(skip)]
    pub panel: Panel,
}

/// What comes out with another friction angle.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct OtherFriction {
    /// The arm that has it.
    pub arm: String,
    /// The friction angle.
    pub phi_deg: f64,
    /// The most likely kn (Pa/m), null as above.
    pub kn_pa_per_m: Option<f64>,
    /// The 95 % interval.
    pub kn_95_pa_per_m: [Option<f64>; 2],
}

/// A point in kn that could not be used.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct LeftOutPoint {
    /// The point (Pa/m).
    pub kn_pa_per_m: f64,
    /// Why.
    pub why: String,
}

/// Said with every calibration.
const CONFOUNDED: &str = "kn is found with friction, restraint, section and irregularity held as the arm states them; \
    irregular stones, a contact inset and softer joints all lower the angle, so that angles alone cannot tell them apart";

impl CalibrationEntry {
    /// From a calibration of an arm.
    pub fn of(
        study: &Study,
        arm: &Arm,
        found: &Calibration,
        unusable: &[LeftOut],
        others: &[OtherPhi],
    ) -> Self {
        let friction = |other: &OtherPhi| OtherFriction {
            arm: other.arm.clone(),
            phi_deg: other.phi_deg,
            kn_pa_per_m: number(other.calibration.best),
            kn_95_pa_per_m: other.calibration.within_95.map(number),
        };
        let left_out = |point: &LeftOut| LeftOutPoint { kn_pa_per_m: point.kn, why: point.why.clone() };
        CalibrationEntry {
            arm: arm.name.clone(),
            specimens: found.specimens as u64,
            kn_pa_per_m: number(found.best),
            kn_68_pa_per_m: found.within_68.map(number),
            kn_95_pa_per_m: found.within_95.map(number),
            deviance_limits: found.thresholds,
            extra_scatter_deg: tidy_degrees(found.extra_scatter),
            phi_deg: arm.joint.phi_deg.mean(),
            other_friction: others.iter().map(friction).collect(),
            points_pa_per_m: found.points.iter().map(|point| point.kn).collect(),
            left_out: unusable.iter().map(left_out).collect(),
            interpolation_error_deg: tidy_degrees(found.interpolation_error),
            note: CONFOUNDED,
            panel: Panel::of(
                &arm.name,
                found,
                angles_of(study, &arm.name).into_iter().map(Angle::of).collect(),
            ),
        }
    }

    /// Towards which end the likelihood still rises, in words; `None` where the most likely kn is inside.
    pub fn beyond(&self) -> Option<&'static str> {
        match self.panel.best {
            End::At(_) => None,
            End::BelowGrid => Some("at or below the lowest kn simulated"),
            End::AboveGrid => Some("at or above the largest kn simulated"),
        }
    }
}

/// An end that is not open.
fn number(end: End) -> Option<f64> {
    match end {
        End::At(kn) => Some(kn),
        End::BelowGrid | End::AboveGrid => None,
    }
}
