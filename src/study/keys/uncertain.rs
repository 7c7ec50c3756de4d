//! Keys of `[uncertain]`: paths of numbers that are drawn once per wall.

use crate::study::angle::Angle;
use crate::study::keys::POSITIVE;
use crate::study::schema::Presence::Optional;
use crate::study::schema::{Interval, Key, Kind, Section};

const fn drawn(name: &'static str, unit: &'static str, within: Interval, doc: &'static str) -> Key {
    Key::new(name, Kind::Distribution { unit, within }, Optional, doc)
}

const NOT_NEGATIVE: Interval = Interval::below(0.0, f64::INFINITY);

/// What is drawn once per wall.
pub static UNCERTAIN: Section = Section {
    title: "[uncertain]",
    doc: "What nobody knows exactly of a wall as a whole: paths of keys, in quotes, with distributions. Each is drawn once per wall \
          in the place of the number that the study states, and is the same in all its joints and stones. What scatters within a wall stays where it is: the distributions of \
          [block], [joint] and [[arm]], and wall_size_factor for the mean size of a wall's stones.",
    chooser: None,
    keys: &[&[
        drawn(
            "joint.kn_pa_per_m",
            "Pa/m",
            POSITIVE,
            "Normal stiffness; joint.kn_pa_per_m then has one entry.",
        )
        .usual(Interval::closed(1e6, 1e12)),
        drawn("joint.kn_over_ks", "1", POSITIVE, "Normal over shear stiffness."),
        drawn("joint.phi_deg", "deg", Interval::closed(0.0, 85.0), "Friction angle.").angle(Angle::Friction),
        drawn("joint.cohesion_pa", "Pa", NOT_NEGATIVE, "Cohesion."),
        drawn("joint.tension_pa", "Pa", NOT_NEGATIVE, "Tensile strength."),
        drawn("joint.compressive_strength_pa", "Pa", POSITIVE, "Stress at which joints are crushed.")
            .usual(Interval::closed(1e4, 1e9)),
        drawn("block.density_kg_per_m3", "kg/m3", POSITIVE, "Density of all stones of a wall.")
            .usual(Interval::closed(500.0, 8000.0)),
        drawn("load.mean_pressure_pa", "Pa", POSITIVE, "Mean pressure of load.protocol = \"lateral\"."),
        drawn("load.vertical_load_n", "N", POSITIVE, "Vertical load of load.protocol = \"shear\"."),
        drawn(
            "load.fill_density_kg_per_m3",
            "kg/m3",
            Interval::closed(100.0, 5000.0),
            "Density of the fill of load.protocol = \"retaining\".",
        ),
        drawn("load.fill_phi_deg", "deg", Interval::closed(1.0, 60.0), "Friction angle of that fill.")
            .angle(Angle::Friction),
        drawn(
            "load.wall_friction_share",
            "1",
            Interval::closed(0.0, 1.0),
            "The share of that angle on the back of the wall.",
        ),
        drawn("restraint.rope.stiffness_n_per_m", "N/m", POSITIVE, "Stiffness of the ropes."),
        drawn(
            "mechanism.contact_inset.radius_m",
            "m",
            Interval::above(0.0, 0.5),
            "Width of the arrises that do not touch.",
        ),
        drawn("mechanism.friction.factor", "1", POSITIVE, "Factor on tan(phi)."),
        drawn("mechanism.lean.angle_deg", "deg", Interval::closed(-20.0, 20.0), "Lean of the wall."),
        drawn(
            "mechanism.joint_closure.initial_pa_per_m",
            "Pa/m",
            POSITIVE,
            "Initial stiffness of the hyperbola.",
        ),
        drawn(
            "mechanism.joint_closure.closure_m",
            "m",
            Interval::closed(0.0, 0.1),
            "Maximum closure of the hyperbola.",
        ),
    ]],
};
