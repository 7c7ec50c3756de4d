//! Effects that are in no catalogue. None of them may be given a name, unless it is another word for the same thing.

mod readings;
mod walls;

use readings::{Backlash, Crosstalk, Drift, Knock, Saturation, StickSlip, TiltScale};
use walls::{HeavyTailedJoints, LightTop, SkewAxis, SoftCourse, SoftLeft, TautRopes, ThinWall};

use super::effect::Effect;

/// An effect outside the catalogue.
pub struct Unknown {
    pub name: &'static str,
    /// Mechanisms of the catalogue that are the same thing in other words.
    pub aliases: &'static [&'static str],
    /// Its parameters, each uniform between two values.
    pub parameters: &'static [(&'static str, f64, f64)],
    /// It, with the values of its parameters.
    pub effect: fn(&[f64]) -> Box<dyn Effect>,
}

/// All of them; those that act on walls come first.
pub const UNKNOWN: [Unknown; 14] = [
    // One course in softer joints.
    Unknown {
        name: "soft_course",
        aliases: &[],
        parameters: &[("height_m", 0.0, 0.3), ("kn_share", 0.05, 0.3)],
        effect: |p| Box::new(SoftCourse { height: p[0], share: p[1] }),
    },
    // The left third in softer joints.
    Unknown {
        name: "soft_left",
        aliases: &[],
        parameters: &[("kn_share", 0.1, 0.5)],
        effect: |p| Box::new(SoftLeft { share: p[0] }),
    },
    // A wall that stands askew on the platform.
    Unknown {
        name: "skew_axis",
        aliases: &[],
        parameters: &[("angle_deg", 4.0, 12.0)],
        effect: |p| Box::new(SkewAxis { angle_deg: p[0] }),
    },
    // Stiffnesses of joints that differ by powers of ten, and are as stiff on average.
    Unknown {
        name: "heavy_tailed_joints",
        aliases: &[],
        parameters: &[("ln_sd", 0.7, 1.4)],
        effect: |p| Box::new(HeavyTailedJoints { ln_sd: p[0] }),
    },
    // Lighter stones in the upper half.
    Unknown {
        name: "light_top",
        aliases: &[],
        parameters: &[("density_share", 0.6, 0.9)],
        effect: |p| Box::new(LightTop { share: p[0] }),
    },
    // Ropes that press on the wall from the start.
    Unknown {
        name: "taut_ropes",
        aliases: &[],
        parameters: &[("pretension_n", 30.0, 150.0)],
        effect: |p| Box::new(TautRopes { pretension: p[0] }),
    },
    // A wall that is thinner than it is said to be: the same as joints that begin behind its faces, but for its weight, which
    // their stiffness hides.
    Unknown {
        name: "thin_wall",
        aliases: &["contact_inset"],
        parameters: &[("thickness_share", 0.9, 0.98)],
        effect: |p| Box::new(ThinWall { share: p[0] }),
    },
    // A reading that stays until the point has moved by so much.
    Unknown {
        name: "stick_slip",
        aliases: &[],
        parameters: &[("threshold_m", 0.5e-3, 3e-3)],
        effect: |p| Box::new(StickSlip { threshold: p[0] }),
    },
    // A zero that moves from test to test.
    Unknown {
        name: "drift",
        aliases: &[],
        parameters: &[("per_test_m", -1e-3, 1e-3)],
        effect: |p| Box::new(Drift { per_test: p[0] }),
    },
    // A gauge that ends before the wall does.
    Unknown {
        name: "saturation",
        aliases: &[],
        parameters: &[("largest_m", 1e-3, 5e-3)],
        effect: |p| Box::new(Saturation { largest: p[0] }),
    },
    // A platform that shows so many times the tilt.
    Unknown {
        name: "tilt_scale",
        aliases: &[],
        parameters: &[("factor", 0.9, 1.1)],
        effect: |p| Box::new(TiltScale { factor: p[0] }),
    },
    // A platform that lags: the same as a wall that leans uphill, but for the zero reading.
    Unknown {
        name: "backlash",
        aliases: &["lean"],
        parameters: &[("lag_deg", 0.3, 2.0)],
        effect: |p| Box::new(Backlash { lag_deg: p[0] }),
    },
    // A knock against the gauges' frame.
    Unknown {
        name: "knock",
        aliases: &[],
        parameters: &[("at_deg", 6.0, 12.0), ("jump_m", 1e-3, 5e-3)],
        effect: |p| Box::new(Knock { at_deg: p[0], jump: p[1] }),
    },
    // Gauges at the ends that show a share of each other and of the centre.
    Unknown {
        name: "crosstalk",
        aliases: &[],
        parameters: &[("share", 0.1, 0.4)],
        effect: |p| Box::new(Crosstalk { share: p[0] }),
    },
];
