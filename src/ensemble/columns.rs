//! The columns of a run's tables: name, unit, meaning, and where each value comes from. Tables, their documentation and their schemas are
//! made from this one list.

mod shaken;

use crate::ensemble::{AddedColumns, Row, StepRow};

/// A table, by what a line of it is.
pub trait Table {
    /// A line, for as long as its row is there.
    type Line<'r>: Copy;

    /// Lines that are written at a time, in a row group of the file. So many are some 40 MB in memory, and what the file's end says of
    /// each group, which is kept until then, is little beside its lines.
    const GROUP: usize;
}

/// The table with a line per wall and stiffness.
pub enum Members {}

impl Table for Members {
    type Line<'r> = &'r Row;

    const GROUP: usize = 65_536;
}

/// The table with a line per load step of each.
pub enum Steps {}

impl Table for Steps {
    type Line<'r> = Step<'r>;

    const GROUP: usize = 262_144;
}

/// A column of a table.
pub struct Column<T: Table> {
    /// Its name.
    pub name: String,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// What it holds.
    pub meaning: &'static str,
    /// The value of a line.
    pub value: Value<T>,
}

/// Where a value comes from.
pub enum Value<T: Table> {
    /// A text, or nothing.
    Text(TextOf<T>),
    /// A count.
    Count(for<'r> fn(T::Line<'r>) -> u64),
    /// A number, or nothing.
    Real(RealOf<T>),
    /// What a wall drew of the parameter of this name, or nothing.
    Drawn(for<'r> fn(T::Line<'r>, &str) -> Option<f64>, String),
}

type TextOf<T> = for<'r> fn(<T as Table>::Line<'r>) -> Option<String>;
type RealOf<T> = for<'r> fn(<T as Table>::Line<'r>) -> Option<f64>;

/// A load step of a member with its number.
#[derive(Clone, Copy)]
pub struct Step<'r> {
    pub row: &'r Row,
    pub number: u64,
    pub step: &'r StepRow,
}

/// What stands for the name of a parameter in the documentation of columns.
const ANY_KEY: &str = "KEY";
const DRAWN: &str =
    "what was drawn for this wall in the place of the number of that name in study.toml, in its unit";

fn text<T: Table>(name: &str, meaning: &'static str, of: TextOf<T>) -> Column<T> {
    Column { name: name.to_owned(), unit: "", meaning, value: Value::Text(of) }
}

fn count<T: Table>(name: &str, meaning: &'static str, of: for<'r> fn(T::Line<'r>) -> u64) -> Column<T> {
    Column { name: name.to_owned(), unit: "", meaning, value: Value::Count(of) }
}

fn real<T: Table>(name: &str, unit: &'static str, meaning: &'static str, of: RealOf<T>) -> Column<T> {
    Column { name: name.to_owned(), unit, meaning, value: Value::Real(of) }
}

/// The columns of `members.parquet`.
pub fn of_members(added: &AddedColumns) -> Vec<Column<Members>> {
    let mut columns = every_member();
    if added.sheared {
        columns.extend(sheared_members());
    }
    if added.undecided {
        columns.extend(undecided_members());
    }
    if added.shaken {
        columns.extend(shaken::members());
    }
    columns.extend(added.drawn.iter().map(|key| drawn_column(key)));
    columns
}

/// The columns of `steps.parquet`.
pub fn of_steps(added: &AddedColumns) -> Vec<Column<Steps>> {
    let mut columns = every_step();
    if added.pushed {
        columns.extend(sheared_steps());
    }
    if added.shaken {
        columns.extend(shaken::steps());
    }
    columns
}

/// All columns that a table of members, and one of steps, may have.
pub fn documented() -> (Vec<Column<Members>>, Vec<Column<Steps>>) {
    let (mut members, mut steps) = (every_member(), every_step());
    members.extend(sheared_members());
    members.extend(undecided_members());
    members.extend(shaken::members());
    members.push(drawn_column(ANY_KEY));
    steps.extend(sheared_steps());
    steps.extend(shaken::steps());
    (members, steps)
}

fn drawn_column(key: &str) -> Column<Members> {
    type R<'r> = &'r Row;
    let value = Value::Drawn(|row: R, key: &str| row.drawn.get(key).copied(), key.to_owned());
    Column { name: format!("drawn {key}"), unit: "", meaning: DRAWN, value }
}

fn every_member() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        text("arm", "name of the arm", |r: R| Some(r.arm.clone())),
        count("point", "number of the stiffness of its joints, from 0", |r: R| r.point.into()),
        real("kn_pa_per_m", "Pa/m", "normal stiffness of its joints, as stated", |r: R| Some(r.kn_pa_per_m)),
        count("member", "number of the wall in its arm, from 0; the same wall at every stiffness", |r: R| {
            r.member
        }),
        text(
            "outcome",
            "how it ended: equilibrium, collapsed, unstable_at_rest, unbounded, not_converged, non_finite, invalid_geometry",
            |r: R| Some(r.outcome.name().to_owned()),
        ),
        text("reason", "why, in words; none of a wall that stands to the end", |r: R| {
            Some(r.outcome.reason()).filter(|reason| !reason.is_empty())
        }),
        real(
            "top_displacement_m",
            "m",
            "largest displacement at the wall's top along the load, at its end, since gravity alone; of walls in equilibrium",
            |r: R| r.top_displacement_m,
        ),
        real(
            "collapse_angle_deg",
            "deg",
            "the largest tilt that it bore before the event that is its capacity",
            |r: R| r.collapse_angle_deg,
        ),
        real("fails_at_deg", "deg", "the lowest tilt at which it is known to fall", |r: R| r.fails_at_deg),
        real("first_stone_deg", "deg", "tilt at which its first stone fell", |r: R| r.first_stone_deg),
        real("part_deg", "deg", "tilt at which part_share of its weight had fallen", |r: R| r.part_deg),
        real("most_deg", "deg", "tilt at which most_share of its weight had fallen", |r: R| r.most_deg),
        real("largest_tilt_deg", "deg", "the largest tilt at which it came to rest", |r: R| {
            r.largest_tilt_deg
        }),
        real(
            "limit_angle_deg",
            "deg",
            "tilt of collapse by limit analysis with associative flow, an upper bound",
            |r: R| r.limit.and_then(|l| l.angle_deg),
        ),
        real(
            "limit_angle_non_associative_deg",
            "deg",
            "the same without dilatancy, neither a bound nor unique",
            |r: R| r.limit.and_then(|l| l.non_associative_angle_deg),
        ),
        real(
            "limit_multiplier",
            "",
            "factor on the load at collapse by limit analysis with associative flow; in shear the push over the vertical load",
            |r: R| r.limit.and_then(|l| l.multiplier),
        ),
        real("limit_multiplier_non_associative", "", "the same without dilatancy", |r: R| {
            r.limit.and_then(|l| l.non_associative_multiplier)
        }),
        text(
            "agreement",
            "how the solver's answer goes with limit analysis: within_bound, above_bound, one_stands, no_answer",
            |r: R| r.limit.map(|l| l.agreement.name().to_owned()),
        ),
        real("capacity_over_limit", "", "the solver's capacity over the bound of limit analysis", |r: R| {
            r.limit.and_then(|l| l.ratio)
        }),
        text("failure_mode", "how the moving part moves as it falls: sliding, rocking, bulging", |r: R| {
            r.mechanism.map(|m| m.mode.name().to_owned())
        }),
        real("moving_stones", "", "number of stones that take part in the mechanism", |r: R| {
            r.mechanism.map(|m| m.moving.into())
        }),
        real("moving_weight_share", "", "their share of the weight of all stones", |r: R| {
            r.mechanism.map(|m| m.weight_share)
        }),
        real(
            "moving_length_share",
            "",
            "share of the wall's length that moves by half of the largest movement or more",
            |r: R| r.mechanism.map(|m| m.length_share),
        ),
        real(
            "moving_place",
            "",
            "middle of the movement along the wall, as a share of its length from x = 0",
            |r: R| r.mechanism.map(|m| m.place),
        ),
        real(
            "hinge_height_m",
            "m",
            "height of the hinge or of the plane of sliding above the wall's foot",
            |r: R| r.mechanism.map(|m| m.hinge_height_m),
        ),
        real(
            "turning_share",
            "",
            "turning over turning and slipping in the moving joints: 1 rocks, 0 slides",
            |r: R| r.mechanism.map(|m| m.turning_share),
        ),
        count("stones", "number of stones, headers and wedges among them", |r: R| r.stones.into()),
        count("joints", "number of joints as built", |r: R| r.joints.into()),
        count("wedges", "number of wedges", |r: R| r.wedges.into()),
        count("headers", "number of headers", |r: R| r.headers.into()),
        count("attempts", "fresh starts of the generator", |r: R| r.attempts.into()),
        count("redraws", "single redraws of the generator", |r: R| r.redraws.into()),
        count("merges", "slivers merged into a neighbour", |r: R| r.merges.into()),
        real("dip_mean_deg", "deg", "mean of the dips of its beds as built", |r: R| r.dip_mean_deg),
        real("dip_sd_deg", "deg", "their standard deviation", |r: R| r.dip_sd_deg),
        real(
            "first_dip_sd_deg",
            "deg",
            "standard deviation of the dips as first drawn, before any was rejected",
            |r: R| r.first_dip_sd_deg,
        ),
        real("length_mean_m", "m", "mean length of its stones as built", |r: R| r.length_mean_m),
        real("height_mean_m", "m", "mean height of its stones as built", |r: R| r.height_mean_m),
        real("weight_n", "N", "weight of its stones", |r: R| r.weight_n),
        count("solver_steps", "time steps or iterations of the solver, over all load steps", |r: R| {
            r.solver_steps
        }),
        real("unbalanced_ratio", "", "unbalanced force over the force in the joints at the end", |r: R| {
            r.unbalanced_ratio
        }),
    ]
}

fn undecided_members() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        real(
            "stiff_angle_deg",
            "deg",
            "tilt at which it falls with stiff joints, where rigid blocks leave the value open",
            |r: R| r.undecided.as_ref().and_then(|own| own.stiff_angle_deg),
        ),
        real("stiff_multiplier", "", "factor on the load with stiff joints, the same", |r: R| {
            r.undecided.as_ref().and_then(|own| own.stiff_multiplier)
        }),
        real("stiff_capacity_n", "N", "the largest push with stiff joints, the same", |r: R| {
            r.undecided.as_ref().and_then(|own| own.stiff_capacity_n)
        }),
        real("thrust_needed_n", "N", "thrust in upright joints that the value needs", |r: R| {
            r.undecided.as_ref().and_then(|own| own.thrust_needed_n)
        }),
        real("thrust_at_rest_n", "N", "thrust in upright joints under the weight alone", |r: R| {
            r.undecided.as_ref().and_then(|own| own.thrust_at_rest_n)
        }),
        text("left_open", "why rigid blocks leave the value open", |r: R| {
            r.undecided.as_ref().map(|own| own.why.clone())
        }),
    ]
}

fn sheared_members() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        real("capacity_n", "N", "the largest push that the wall bore", |r: R| {
            r.shear.and_then(|s| s.capacity_n)
        }),
        real("drift_at_capacity_percent", "%", "the drift at which it was reached", |r: R| {
            r.shear.and_then(|s| s.drift_at_capacity_percent)
        }),
        real(
            "plateau_n",
            "N",
            "push at which a wall of the same stiffness that gives way at once does as much work",
            |r: R| r.shear.and_then(|s| s.plateau_n),
        ),
        real(
            "stiffness_n_per_m",
            "N/m",
            "secant of push over displacement at a third of the plateau",
            |r: R| r.shear.and_then(|s| s.stiffness_n_per_m),
        ),
        text("shear_mode", "how the wall gives way in its plane: rocking, sliding, toe", |r: R| {
            r.shear.and_then(|s| s.mode).map(|mode| mode.name().to_owned())
        }),
        real("opening_m", "m", "widest opening of a joint at the end", |r: R| {
            r.shear.and_then(|s| s.opening_m)
        }),
    ]
}

fn every_step() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        text("arm", "name of the arm", |s: S| Some(s.row.arm.clone())),
        count("point", "number of the stiffness of its joints, from 0", |s: S| s.row.point.into()),
        real("kn_pa_per_m", "Pa/m", "normal stiffness of its joints, as stated", |s: S| {
            Some(s.row.kn_pa_per_m)
        }),
        count("member", "number of the wall in its arm, from 0", |s: S| s.row.member),
        count(
            "load_step",
            "number of the load step; 0 is gravity alone; of walls that are shaken the number of the run",
            |s: S| s.number,
        ),
        real("load_factor", "", "share of the full load; none on a tilting table", |s: S| s.step.load_factor),
        real("tilt_deg", "deg", "tilt of the platform", |s: S| s.step.tilt_deg),
        real(
            "top_displacement_m",
            "m",
            "largest displacement at the wall's top along the load, since gravity alone",
            |s: S| s.step.top_displacement_m,
        ),
        real(
            "left_m",
            "m",
            "displacement of the left point of the top along y, since gravity alone",
            |s: S| s.step.left_m,
        ),
        real("centre_m", "m", "the same of the centre point", |s: S| s.step.centre_m),
        real("right_m", "m", "the same of the right point", |s: S| s.step.right_m),
        real(
            "left_remainder_m",
            "m",
            "what is left of left_m when the platform goes back to the level from here (load.remainders = true)",
            |s: S| s.step.left_remainder_m,
        ),
        real("centre_remainder_m", "m", "the same of the centre point", |s: S| s.step.centre_remainder_m),
        real("right_remainder_m", "m", "the same of the right point", |s: S| s.step.right_remainder_m),
        real(
            "unbalanced_ratio",
            "",
            "unbalanced force over the force in the joints that was reached",
            |s: S| s.step.unbalanced_ratio,
        ),
        count("solver_steps", "time steps or iterations of the solver", |s: S| s.step.solver_steps),
    ]
}

fn sheared_steps() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        real(
            "drift_percent",
            "%",
            "displacement of the beam on the wall over the height of the jack",
            |s: S| s.step.drift_percent,
        ),
        real("force_n", "N", "force of the jack along the wall", |s: S| s.step.force_n),
    ]
}
