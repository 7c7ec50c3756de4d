//! The columns of a run's tables: name, unit, meaning, and where each value comes from. Tables, their documentation and their schemas are
//! made from this one list.

use std::iter;

use crate::ensemble::added_columns::AddedColumns;
use crate::ensemble::field::{Cell, Entry, Field, Kind, Record};
use crate::ensemble::reading::{self, BLOCKS, StepRow};
use crate::ensemble::record::Row;

/// A table, by what a line of it is.
pub trait Table: 'static {
    /// A line, for as long as its row is there.
    type Line<'r>: Copy;
    /// What a line is made from.
    type Base: 'static;

    /// That of a line.
    fn base<'l>(line: &'l Self::Line<'_>) -> &'l Self::Base;

    /// Lines that are written at a time, in a row group of the file. So many are some 40 MB in memory, and what the file's end says of
    /// each group, which is kept until then, is little beside its lines.
    const GROUP: usize;
}

/// The table with a line per wall and stiffness.
pub enum Members {}

impl Table for Members {
    type Line<'r> = &'r Row;
    type Base = Row;

    fn base<'l>(row: &'l &Row) -> &'l Row {
        row
    }

    const GROUP: usize = 65_536;
}

/// The table with a line per load step of each.
pub enum Steps {}

impl Table for Steps {
    type Line<'r> = Step<'r>;
    type Base = StepRow;

    fn base<'l>(line: &'l Step<'_>) -> &'l StepRow {
        line.step
    }

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
    /// Of which kind.
    pub kind: Kind,
    /// The value of a line.
    pub cell: Box<CellOf<T>>,
}

type CellOf<T> = dyn for<'r> Fn(<T as Table>::Line<'r>) -> Cell + Send + Sync;

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

/// A column of its own.
pub(super) fn column<T: Table, F: Field + 'static>(
    name: &str,
    unit: &'static str,
    meaning: &'static str,
    field: for<'r> fn(T::Line<'r>) -> F,
) -> Column<T> {
    let cell = Box::new(move |line: T::Line<'_>| field(line).cell());
    Column { name: name.to_owned(), unit, meaning, kind: F::KIND, cell }
}

/// The columns of a record that every line has.
pub(super) fn of_record<T: Table, R: Record>(record: fn(&T::Base) -> &R) -> Vec<Column<T>> {
    let column = |entry: &'static Entry<R>| {
        let &Entry { name, unit, meaning, kind, cell } = entry;
        let cell = Box::new(move |line: T::Line<'_>| cell(record(T::base(&line))));
        Column { name: name.to_owned(), unit, meaning, kind, cell }
    };
    R::COLUMNS.iter().map(column).collect()
}

/// The columns of a record that a line may have.
pub(super) fn of_optional<T: Table, R: Record>(record: fn(&T::Base) -> Option<&R>) -> Vec<Column<T>> {
    let column = |entry: &'static Entry<R>| {
        let &Entry { name, unit, meaning, kind, cell } = entry;
        let cell = Box::new(move |line: T::Line<'_>| Cell::optional(record(T::base(&line)).map(cell), kind));
        Column { name: name.to_owned(), unit, meaning, kind: kind.optional(), cell }
    };
    R::COLUMNS.iter().map(column).collect()
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
    let every = [which_member, reading::members, analysed, solved].into_iter().flat_map(|columns| columns());
    every.chain(blocks.flat_map(|block| (block.members)())).chain(drawn.map(drawn_column)).collect()
}

fn steps(blocks: impl Iterator<Item = &'static Block>) -> Vec<Column<Steps>> {
    let every = [which_step, reading::steps, solved_step].into_iter().flat_map(|columns| columns());
    every.chain(blocks.flat_map(|block| (block.steps)())).collect()
}

fn drawn_column(key: &str) -> Column<Members> {
    let drawn = key.to_owned();
    let cell = Box::new(move |row: &Row| row.drawn.get(&drawn).copied().cell());
    Column { name: format!("drawn {key}"), unit: "", meaning: DRAWN, kind: Kind::Real, cell }
}

fn which_member() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        column("arm", "", "name of the arm", |r: R| r.arm.clone()),
        column("point", "", "number of the stiffness of its joints, from 0", |r: R| r.point),
        column("kn_pa_per_m", "Pa/m", "normal stiffness of its joints, as stated", |r: R| r.kn_pa_per_m),
        column(
            "member",
            "",
            "number of the wall in its arm, from 0; the same wall at every stiffness",
            |r: R| r.member,
        ),
        column(
            "outcome",
            "",
            "how it ended: equilibrium, collapsed, unstable_at_rest, unbounded, not_converged, non_finite, invalid_geometry",
            |r: R| r.outcome.name(),
        ),
        column("reason", "", "why, in words; none of a wall that stands to the end", |r: R| {
            Some(r.outcome.reason()).filter(|reason| !reason.is_empty())
        }),
    ]
}

fn analysed() -> Vec<Column<Members>> {
    let limit = of_optional(|row: &Row| row.limit.as_ref());
    let mechanism = of_optional(|row: &Row| row.mechanism.as_ref());
    limit.into_iter().chain(mechanism).chain(of_record(|row: &Row| &row.built)).collect()
}

fn solved() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        column("solver_steps", "", "time steps or iterations of the solver, over all load steps", |r: R| {
            r.solver_steps
        }),
        column("unbalanced_ratio", "", "unbalanced force over the force in the joints at the end", |r: R| {
            r.unbalanced_ratio
        }),
    ]
}

fn which_step() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        column("arm", "", "name of the arm", |s: S| s.row.arm.clone()),
        column("point", "", "number of the stiffness of its joints, from 0", |s: S| s.row.point),
        column("kn_pa_per_m", "Pa/m", "normal stiffness of its joints, as stated", |s: S| s.row.kn_pa_per_m),
        column("member", "", "number of the wall in its arm, from 0", |s: S| s.row.member),
        column(
            "load_step",
            "",
            "number of the load step; 0 is gravity alone; of walls that are shaken the number of the run",
            |s: S| s.number,
        ),
    ]
}

fn solved_step() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        column(
            "unbalanced_ratio",
            "",
            "unbalanced force over the force in the joints that was reached",
            |s: S| s.step.unbalanced_ratio,
        ),
        column("solver_steps", "", "time steps or iterations of the solver", |s: S| s.step.solver_steps),
    ]
}
