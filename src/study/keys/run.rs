//! Keys of what is done to a wall: load, restraint, solver.

use crate::study::angle::Angle;
use crate::study::keys::base_motion::RECORDS;
use crate::study::keys::{SIZE, real};
use crate::study::schema::Presence::{Default, Optional, Required, Unless};
use crate::study::schema::{Interval, Key, Kind, Section};

const LATERAL: &[&str] = &["lateral"];
const TILTING: &[&str] = &["tilting"];
const SHEAR: &[&str] = &["shear"];
const BASE_MOTION: &[&str] = &["base_motion"];
const RETAINING: &[&str] = &["retaining"];
const FALLS_IN_PARTS: &[&str] = &["tilting", "base_motion"];
/// More intensities than anybody needs for a curve.
const MOST_INTENSITIES: usize = 50;
const RUNS_AWAY: &[&str] = &["tilting", "shear", "retaining"];
const EXPLICIT: &[&str] = &["explicit"];
const IMPLICIT: &[&str] = &["implicit"];
const LIMIT: &[&str] = &["limit"];
const NONSMOOTH: &[&str] = &["nonsmooth"];
const RATIO_OF_FORCES: Kind = Kind::Real { unit: "1", within: Interval::open(0.0, 1.0) };
const AT_REST: &str = "At rest when the unbalanced force ratio falls below this.";

pub static LOAD: Section = Section {
    title: "[load]",
    doc: "Gravity, then a trapezoidal pressure on the back face in equal steps, a platform that tilts, a beam on the wall's \
          top that is pushed along the wall, a base that shakes, or fill or water that rises behind the wall.",
    chooser: Some("protocol"),
    keys: &[&[
        Key::new(
            "protocol",
            Kind::Choice(&["lateral", "tilting", "shear", "base_motion", "retaining"]),
            Required,
            "What is done to each wall: pressure on its back, a tilting table, shear in its plane under a constant load, a base that \
             shakes: every wall under every record at every intensity, or fill or water that rises behind it until it falls.",
        ),
        Key::new(
            "mean_pressure_pa",
            real("Pa", Interval::above(0.0, 1e7)),
            Required,
            "Mean horizontal pressure.",
        )
        .only(LATERAL),
        Key::new(
            "base_over_top",
            real("1", Interval::closed(0.01, 100.0)),
            Required,
            "Pressure at the base over pressure at the top.",
        )
        .only(LATERAL),
        Key::new(
            "steps",
            Kind::Whole { low: 1, high: 10_000 },
            Default("1"),
            "Equal load steps after gravity.",
        )
        .only(LATERAL),
        Key::new(
            "collapse_share",
            real("1", Interval::above(0.0, 10.0)),
            Default("0.5"),
            "The wall counts as collapsed when its top has moved by this share of its base thickness.",
        )
        .only(LATERAL),
        Key::new(
            "towards",
            Kind::Choice(&["x+", "x-", "y+", "y-"]),
            Default("\"y+\""),
            "The side of the platform that goes down; y+ is the wall's front.",
        )
        .only(TILTING),
        Key::new(
            "towards_deg",
            real("deg", Interval::closed(-360.0, 360.0)),
            Optional,
            "The same as an angle from x+, counter-clockwise seen from above (90 is y+), instead of towards.",
        )
        .only(TILTING)
        .angle(Angle::Direction),
        Key::new(
            "step_deg",
            real("deg", Interval::above(0.0, 10.0)),
            Default("0.5"),
            "Tilt from step to step.",
        )
        .only(TILTING),
        Key::new("end_deg", real("deg", Interval::above(0.0, 89.0)), Default("89"), "Largest tilt.")
            .only(TILTING)
            .angle(Angle::Tilt),
        Key::new(
            "bracket_deg",
            real("deg", Interval::above(1e-4, 10.0)),
            Default("0.01"),
            "The collapse angle is bracketed to this, by going back and halving the step.",
        )
        .only(TILTING),
        Key::new(
            "runaway_share",
            real("1", Interval::above(0.0, 1.0)),
            Default("0.1"),
            "A wall falls when any block has moved by this share of the base thickness since the last rest.",
        )
        .only(RUNS_AWAY),
        Key::new(
            "observes",
            Kind::Choice(&["collapse_angle", "displacement"]),
            Default("\"collapse_angle\""),
            "The tilt at which the wall falls; or how far its top has moved at end_deg.",
        )
        .only(TILTING),
        Key::new(
            "part_share",
            real("1", Interval::above(0.0, 1.0)),
            Optional,
            "A part of the wall has fallen when this share of its weight has; 0.1 where it is not given.",
        )
        .only(FALLS_IN_PARTS),
        Key::new(
            "most_share",
            real("1", Interval::above(0.0, 1.0)),
            Optional,
            "Most of the wall has fallen when this share of its weight has; 0.5 where it is not given.",
        )
        .only(FALLS_IN_PARTS),
        Key::new(
            "capacity",
            Kind::Choice(&["first_stone", "part", "most"]),
            Optional,
            "Whose fall is the wall's collapse: that of its first stone, of part_share of its weight, or of most_share. \
             The others are columns of the tables. \"most\" where it is not given.",
        )
        .only(FALLS_IN_PARTS),
        Key::new(
            "remainders",
            Kind::Flag,
            Default("false"),
            "After every full step the platform also goes back to the level: what is left of the displacements there, in \
             steps.parquet. The test goes on from the tilt as if it had not.",
        )
        .only(TILTING),
        Key::new(
            "turning",
            Kind::Table(&TURNING),
            Optional,
            "The platform turns steadily instead of stopping at every step.",
        )
        .only(TILTING),
        Key::new(
            "vertical_load_n",
            real("N", Interval::above(0.0, 1e9)),
            Required,
            "Weight of the rigid beam on the wall's top: a constant load at its middle. An arm may have its own.",
        )
        .only(SHEAR),
        Key::new(
            "force_height_m",
            real("m", SIZE),
            Required,
            "Height of the push, and of the beam's middle, above the wall's foot; more than the wall's own height.",
        )
        .only(SHEAR),
        Key::new(
            "head",
            Kind::Choice(&["turns", "level"]),
            Default("\"turns\""),
            "Whether the beam may turn, or stays level.",
        )
        .only(SHEAR),
        Key::new(
            "drift_percent",
            real("%", Interval::above(0.0, 20.0)),
            Default("2"),
            "Largest displacement of the beam along the wall over the height of the push.",
        )
        .only(SHEAR),
        Key::new(
            "cycles",
            Kind::Whole { low: 0, high: 100 },
            Default("0"),
            "Cycles there, back and as far the other way, each wider by the same amount; 0 for one push.",
        )
        .only(SHEAR),
        Key::new(
            "step_percent",
            real("%", Interval::above(0.0, 1.0)),
            Default("0.01"),
            "Drift from step to step.",
        )
        .only(SHEAR),
        Key::new(
            "pga_m_per_s2",
            intensities("m/s2", 50.0),
            Unless("pgv_m_per_s"),
            "Intensities: each record is scaled to each of these peak ground accelerations, its largest horizontal vector.",
        )
        .only(BASE_MOTION),
        Key::new(
            "pgv_m_per_s",
            intensities("m/s", 10.0),
            Optional,
            "The same as peak ground velocities, instead of pga_m_per_s2.",
        )
        .only(BASE_MOTION),
        Key::new("records", Kind::Table(&RECORDS), Required, "The records.").only(BASE_MOTION),
        Key::new(
            "towards",
            Kind::Choice(&["x+", "x-", "y+", "y-"]),
            Default("\"y+\""),
            "Where the y axis of a record points in plan, or its only component: y+ is out of plane, x+ along the wall.",
        )
        .only(BASE_MOTION),
        Key::new(
            "towards_deg",
            real("deg", Interval::closed(-360.0, 360.0)),
            Optional,
            "The same as an angle from x+, counter-clockwise seen from above (90 is y+), instead of towards.",
        )
        .only(BASE_MOTION)
        .angle(Angle::Direction),
        Key::new(
            "after_s",
            real("s", Interval::closed(0.0, 600.0)),
            Default("5"),
            "How long a wall is followed after a record has ended, if it does not come to rest before.",
        )
        .only(BASE_MOTION),
        Key::new(
            "twice",
            Kind::Flag,
            Default("true"),
            "Every run is done once more from a start that differs by 1e-9 m/s; where the two end otherwise the pair is undecided. It \
             doubles the time.",
        )
        .only(BASE_MOTION),
        Key::new("retained", Kind::Choice(&["fill", "water"]), Required, "What the wall holds back.")
            .only(RETAINING),
        Key::new(
            "fill_density_kg_per_m3",
            real("kg/m3", Interval::closed(100.0, 5000.0)),
            Optional,
            "Density of the fill, which a fill needs; of one that is not drained that of the soil with its pores full of water.",
        )
        .only(RETAINING),
        Key::new(
            "fill_phi_deg",
            real("deg", Interval::closed(1.0, 60.0)),
            Optional,
            "Friction angle of the fill, which a fill needs.",
        )
        .only(RETAINING)
        .angle(Angle::Friction),
        Key::new(
            "wall_friction_share",
            real("1", Interval::closed(0.0, 1.0)),
            Optional,
            "The share of its friction angle with which the fill rubs on the back of the wall; 0 where it is not given, the safe side.",
        )
        .only(RETAINING),
        Key::new(
            "fill_slope_deg",
            real("deg", Interval::closed(-45.0, 60.0)),
            Optional,
            "Slope of the surface of the fill, above 0 where it rises away from the wall; 0 where it is not given.",
        )
        .only(RETAINING)
        .angle(Angle::Tilt),
        Key::new(
            "surcharge_pa",
            real("Pa", Interval::closed(0.0, 1e6)),
            Optional,
            "Weight on the surface of the fill, per horizontal area; 0 where it is not given.",
        )
        .only(RETAINING),
        Key::new(
            "drained",
            Kind::Flag,
            Optional,
            "Whether water runs off. Else it stands in the fill up to its surface: it presses by itself, and the soil weighs so much less. true \
             where it is not given.",
        )
        .only(RETAINING),
        Key::new(
            "lifts",
            Kind::Whole { low: 1, high: 1000 },
            Default("10"),
            "Equal lifts from the foot of the back to its top, each of which is tried.",
        )
        .only(RETAINING),
        Key::new(
            "bracket_share",
            real("1", Interval::above(1e-6, 0.1)),
            Default("0.001"),
            "The height of the fall is bracketed to this share of the height of the back.",
        )
        .only(RETAINING),
        Key::new(
            "rayleigh_ratio",
            real("1", Interval::below(0.0, 1.0)),
            Optional,
            "Damping, as a share of critical, at both frequencies of rayleigh_hz; for the explicit solver. None without it.",
        )
        .only(BASE_MOTION),
        Key::new(
            "rayleigh_hz",
            Kind::Reals { unit: "Hz", within: Interval::above(0.0, 1e4), at_most: 2, ascending: true },
            Optional,
            "The two frequencies of rayleigh_ratio.",
        )
        .only(BASE_MOTION),
    ]],
};

const fn intensities(unit: &'static str, most: f64) -> Kind {
    Kind::Reals { unit, within: Interval::above(0.0, most), at_most: MOST_INTENSITIES, ascending: true }
}

static TURNING: Section = Section {
    title: "[load.turning]",
    doc: "A platform that turns steadily; the wall moves in true time by the explicit solver.",
    chooser: None,
    keys: &[&[
        Key::new("rate_deg_per_s", real("deg/s", Interval::closed(1e-3, 1e3)), Required, "Tilt rate."),
        Key::new(
            "damping",
            real("1", Interval::below(0.0, 1.0)),
            Default("0.05"),
            "Local damping coefficient.",
        ),
        Key::new(
            "step_safety",
            real("1", Interval::above(0.0, 1.0)),
            Default("0.5"),
            "Share of the critical step taken.",
        ),
    ]],
};

pub static RESTRAINT: Section = Section {
    title: "[restraint]",
    doc: "How base and ends are held.",
    chooser: Some("base"),
    keys: &[&[
        Key::new(
            "base",
            Kind::Choice(&["fixed", "strip"]),
            Required,
            "A fixed platform under the wall, with an ordinary joint; with a fixed strip at the foot's downhill side.",
        ),
        Key::new(
            "strip_height_m",
            real("m", Interval::above(0.0, 1.0)),
            Required,
            "Height of the strip; the wall's hinge is at its edge.",
        )
        .only(&["strip"]),
        Key::new(
            "platform_phi_deg",
            real("deg", Interval::closed(0.0, 85.0)),
            Optional,
            "Friction angle of the joint with platform and strip; without it that of the wall's joints.",
        )
        .angle(Angle::Friction),
        Key::new(
            "ends",
            Kind::Choice(&["free", "fixed_end_blocks", "out_of_plane", "joint_springs", "ropes"]),
            Required,
            "The ends: free; against fixed blocks by ordinary joints; held out of plane; by springs that do not open; \
             by ropes across the downhill face.",
        ),
        Key::new("rope", Kind::Table(&ROPE), Optional, "The ropes, where ends = \"ropes\"."),
    ]],
};

static ROPE: Section = Section {
    title: "[restraint.rope]",
    doc: "Ropes down the downhill face near both ends: each stone that one crosses is held by a tie of its own. Limit \
          analysis takes them as rigid.",
    chooser: None,
    keys: &[&[
        Key::new(
            "stiffness_n_per_m",
            real("N/m", Interval::above(0.0, 1e12)),
            Required,
            "Stiffness per course and end.",
        ),
        Key::new(
            "pretension_n",
            real("N", Interval::closed(0.0, 1e6)),
            Default("0"),
            "Force per course and end as built.",
        ),
        Key::new(
            "slack_m",
            real("m", Interval::closed(0.0, 1.0)),
            Default("0"),
            "Displacement of a stone before the rope resists.",
        ),
        Key::new("from_end_m", real("m", SIZE), Default("0.05"), "Distance from the wall's ends."),
        Key::new(
            "sides",
            Kind::Choice(&["pull", "both"]),
            Default("\"pull\""),
            "Whether they only pull, or push as well.",
        ),
    ]],
};

/// The solver, whose name decides which other keys there are.
pub static SOLVER: Section = Section {
    title: "[solver]",
    doc: "Which solver, with its settings.",
    chooser: Some("name"),
    keys: &[&[
        Key::new(
            "name",
            Kind::Choice(&["explicit", "implicit", "nonsmooth", "limit"]),
            Default("\"explicit\""),
            "Central differences with local damping; Newton's method from equilibrium to equilibrium; contact dynamics of rigid \
             blocks with Coulomb friction; or limit analysis of rigid blocks, which gives the collapse load and no displacements.",
        ),
        Key::new(
            "flow",
            Kind::Choice(&["associative", "non-associative"]),
            Default("\"associative\""),
            "Whether joints dilate when they slide: an upper bound on the capacity; or a state without dilatancy, neither a \
             bound nor unique.",
        )
        .only(LIMIT),
        Key::new(
            "agreement",
            Kind::Flag,
            Default("false"),
            "Limit analysis of every wall beside the solver: what rigid blocks on the same joints bear.",
        ),
        Key::new("unbalanced_ratio", RATIO_OF_FORCES, Default("1e-5"), AT_REST).only(EXPLICIT),
        Key::new("unbalanced_ratio", RATIO_OF_FORCES, Default("1e-7"), AT_REST).only(IMPLICIT),
        Key::new(
            "damping",
            real("1", Interval::below(0.0, 1.0)),
            Default("0.8"),
            "Local damping coefficient.",
        )
        .only(EXPLICIT),
        Key::new(
            "step_safety",
            real("1", Interval::above(0.0, 1.0)),
            Default("0.5"),
            "Share of the critical step taken.",
        )
        .only(EXPLICIT),
        Key::new(
            "max_steps",
            Kind::Whole { low: 1, high: 1_000_000_000 },
            Default("200000"),
            "Time steps per load step before a wall is called not converged.",
        )
        .only(EXPLICIT),
        Key::new(
            "scaled_inertia",
            Kind::Flag,
            Default("true"),
            "Inertia scaled per block so that all share one critical step; for quasi-static runs.",
        )
        .only(EXPLICIT),
        Key::new(
            "longest_step_s",
            real("s", Interval::above(0.0, 1.0)),
            Default("1e-3"),
            "Longest time step with true inertia, for blocks in free flight.",
        )
        .only(EXPLICIT),
        Key::new(
            "max_factorisations",
            Kind::Whole { low: 1, high: 10_000 },
            Default("30"),
            "Factorisations per load increment before it counts as failed.",
        )
        .only(IMPLICIT),
        Key::new(
            "max_halvings",
            Kind::Whole { low: 0, high: 30 },
            Default("1"),
            "Times that a load step of a service load that fails is halved; a tilting table halves its own steps.",
        )
        .only(IMPLICIT),
        Key::new(
            "stabilisation",
            real("1", Interval::closed(0.0, 1e-3)),
            Default("1e-8"),
            "Stiffness added to the diagonal, as a share of the largest there; in the matrix only, not in the balance.",
        )
        .only(IMPLICIT),
        Key::new(
            "time_step_s",
            real("s", Interval::closed(1e-6, 0.1)),
            Default("2e-3"),
            "Time step; while a wall comes to rest it grows up to ten times as long.",
        )
        .only(NONSMOOTH),
        Key::new(
            "normal",
            Kind::Choice(&["gap", "velocity", "compliant"]),
            Default("\"gap\""),
            "Joints that bear pressure where their gap closes within the step; where they touch, by velocities with a restitution; \
             or by the stiffness of the joints. The first two are rigid, and the joints' stiffness has no bearing on them.",
        )
        .only(NONSMOOTH),
        Key::new(
            "restitution",
            real("1", Interval::closed(0.0, 1.0)),
            Optional,
            "Share of the closing velocity with which a joint opens after an impact, where normal = \"velocity\"; 0 where it is not \
             given.",
        )
        .only(NONSMOOTH),
        Key::new(
            "step_solver",
            Kind::Choice(&["newton", "cone_program", "sweeps"]),
            Default("\"newton\""),
            "How a step is solved: Newton's method, and cone programs where it does not converge; a fixed point of cone programs; \
             or non-linear Gauss-Seidel.",
        )
        .only(NONSMOOTH),
        Key::new(
            "tolerance",
            RATIO_OF_FORCES,
            Default("1e-8"),
            "A step is solved when no impulse is off by more than this share of the impulse of all weights.",
        )
        .only(NONSMOOTH),
        Key::new(
            "max_steps",
            Kind::Whole { low: 1, high: 1_000_000_000 },
            Default("20000"),
            "Time steps per load step before a wall is called not converged.",
        )
        .only(NONSMOOTH),
    ]],
};
