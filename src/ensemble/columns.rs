//! The columns of a run's tables: name, unit, meaning, and where each value comes from. Tables, their documentation and their schemas are
//! made from this one list.

use std::iter;

use crate::ensemble::added_columns::AddedColumns;
use crate::ensemble::reading::{self, BLOCKS, StepRow};
use crate::ensemble::record::Row;
use crate::ensemble::{built, limit_analysis};

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

pub(super) fn text<T: Table>(name: &str, meaning: &'static str, of: TextOf<T>) -> Column<T> {
    Column { name: name.to_owned(), unit: "", meaning, value: Value::Text(of) }
}

pub(super) fn count<T: Table>(
    name: &str,
    meaning: &'static str,
    of: for<'r> fn(T::Line<'r>) -> u64,
) -> Column<T> {
    Column { name: name.to_owned(), unit: "", meaning, value: Value::Count(of) }
}

pub(super) fn real<T: Table>(
    name: &str,
    unit: &'static str,
    meaning: &'static str,
    of: RealOf<T>,
) -> Column<T> {
    Column { name: name.to_owned(), unit, meaning, value: Value::Real(of) }
}

/// Columns that tables have only where some wall fills them.
pub struct Block {
    /// Its name, by which it is known which blocks the walls of a run fill together.
    pub name: &'static str,
    /// Whether a wall fills it.
    pub fills: fn(&Row) -> bool,
    /// Its columns in the table of members.
    pub members: fn() -> Vec<Column<Members>>,
    /// Its columns in the table of load steps.
    pub steps: fn() -> Vec<Column<Steps>>,
}

/// The columns of `members.parquet`.
pub fn of_members(added: &AddedColumns) -> Vec<Column<Members>> {
    members(added.blocks(), added.drawn.iter().map(String::as_str))
}

/// The columns of `steps.parquet`.
pub fn of_steps(added: &AddedColumns) -> Vec<Column<Steps>> {
    steps(added.blocks())
}

/// All columns that a table of members, and one of steps, may have.
pub fn documented() -> (Vec<Column<Members>>, Vec<Column<Steps>>) {
    (members(BLOCKS.iter(), iter::once(ANY_KEY)), steps(BLOCKS.iter()))
}

fn members<'k>(
    blocks: impl Iterator<Item = &'static Block>,
    drawn: impl Iterator<Item = &'k str>,
) -> Vec<Column<Members>> {
    let every = [which_member, reading::members, limit_analysis::members, mechanism, built::members, solved];
    let every = every.into_iter().flat_map(|columns| columns());
    every.chain(blocks.flat_map(|block| (block.members)())).chain(drawn.map(drawn_column)).collect()
}

fn steps(blocks: impl Iterator<Item = &'static Block>) -> Vec<Column<Steps>> {
    let every = [which_step, reading::steps, solved_step].into_iter().flat_map(|columns| columns());
    every.chain(blocks.flat_map(|block| (block.steps)())).collect()
}

fn drawn_column(key: &str) -> Column<Members> {
    type R<'r> = &'r Row;
    let value = Value::Drawn(|row: R, key: &str| row.drawn.get(key).copied(), key.to_owned());
    Column { name: format!("drawn {key}"), unit: "", meaning: DRAWN, value }
}

fn which_member() -> Vec<Column<Members>> {
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
    ]
}

fn mechanism() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
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
    ]
}

fn solved() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        count("solver_steps", "time steps or iterations of the solver, over all load steps", |r: R| {
            r.solver_steps
        }),
        real("unbalanced_ratio", "", "unbalanced force over the force in the joints at the end", |r: R| {
            r.unbalanced_ratio
        }),
    ]
}

fn which_step() -> Vec<Column<Steps>> {
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
    ]
}

fn solved_step() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        real(
            "unbalanced_ratio",
            "",
            "unbalanced force over the force in the joints that was reached",
            |s: S| s.step.unbalanced_ratio,
        ),
        count("solver_steps", "time steps or iterations of the solver", |s: S| s.step.solver_steps),
    ]
}
