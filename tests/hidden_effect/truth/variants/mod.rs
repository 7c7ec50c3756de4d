//! Mechanisms of the catalogue written another way, as another code would have them: what is named must not hang on our own
//! formulas.

mod joints;
mod others;

use pirca::math::radians;

use joints::{
    ClosureByDepth, CohesionOfSome, FrictionAngle, GradedEnds, LargePatches, SoftBed, UniformScatter,
};
use others::{Chamfer, CreepAtStops, DensityByStone, OffsetByPoint, ScaleByPoint, TurnedGravity};

use super::effect::Effect;

/// The mechanisms that have another code.
pub const WRITTEN_TWICE: [&str; 13] = [
    "contact_inset",
    "joint_closure",
    "contact_area",
    "friction",
    "cohesion",
    "lean",
    "base_compliance",
    "density",
    "gauge_offset",
    "gauge_scale",
    "creep",
    "specimen_scatter",
    "end_release",
];

/// A mechanism's other code; `value` gives its parameters by key.
pub fn other_code(mechanism: &str, value: &dyn Fn(&str) -> f64) -> Box<dyn Effect> {
    match mechanism {
        "contact_inset" => Box::new(Chamfer { leg: value("radius_m") }),
        "joint_closure" => {
            Box::new(ClosureByDepth { initial: value("initial_pa_per_m"), closure: value("closure_m") })
        }
        "contact_area" => Box::new(LargePatches { share: value("share") }),
        "friction" => Box::new(FrictionAngle {
            factor: value("factor"),
            residual: value("residual_share"),
            distance: value("slip_distance_m"),
        }),
        "cohesion" => Box::new(CohesionOfSome { mean: value("added_pa") }),
        "lean" => Box::new(TurnedGravity { angle: radians(value("angle_deg")) }),
        "base_compliance" => Box::new(SoftBed { rotation: value("rotation_n_m_per_rad") }),
        "density" => Box::new(DensityByStone { factor: value("factor") }),
        "gauge_offset" => Box::new(OffsetByPoint { mean: value("offset_m") }),
        "gauge_scale" => Box::new(ScaleByPoint { mean: value("factor") }),
        "creep" => Box::new(CreepAtStops {
            rate_per_deg: value("rate_per_deg"),
            hold_share: value("hold_share"),
            every_deg: value("hold_every_deg"),
        }),
        "specimen_scatter" => {
            Box::new(UniformScatter { kn: value("kn_cov"), friction: value("friction_cov") })
        }
        "end_release" => Box::new(GradedEnds {
            within: value("within_m"),
            friction: value("friction_share"),
            stiffness: value("stiffness_share"),
        }),
        other => panic!("{other} is written once"),
    }
}
