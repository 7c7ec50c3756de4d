//! The loop over random cells: what masonry of an arm's kind is as a plate, cell by cell.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::ensemble::ledger::Ledger;
use crate::ensemble::shard::Share;
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{Manifest, RunError, is_random};
use crate::generate::{self, CellFault, generate_cell};
use crate::homogenise::{AskedOfCell, CellAnswer};
use crate::math::STANDARD_GRAVITY;
use crate::model::{Cell, JointLaws, Wall};
use crate::random::Design;
use crate::study::{Arm, AsDrawn, DrawnJoints, Study};

/// Cells are members of their own: from here on their numbers are no walls'.
const FIRST_CELL: u64 = 1 << 62;

/// What is asked of cells.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedOfCells {
    /// Stones along the wall and courses of the cells, from small to large.
    pub sizes: Vec<[u32; 2]>,
    /// Cells of each size of an arm in which anything is drawn; of another arm one is all.
    pub cells: u64,
    /// The arms, by their places in the study, each at this kn point.
    pub arms: Vec<u32>,
    /// Number of the kn point.
    pub point: u32,
    /// What is asked of each cell.
    pub of: AskedOfCell,
    /// Vertical stress (Pa, pressure positive); that of the stones' weight at half the wall's height where none is given.
    pub pressure: Option<f64>,
}

/// One cell to evaluate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellTask {
    /// Its arm, by its place in the study.
    pub arm: u32,
    /// Which of the sizes.
    pub size: usize,
    /// Number of the cell among those of its arm and size.
    pub cell: u64,
}

/// What became of a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CellRow {
    /// Which one it is.
    pub task: CellTask,
    /// What was found; else why there is no such cell.
    pub found: Result<CellAnswer, String>,
}

/// Whether an arm can have cells of a size at all, before any is built.
///
/// # Errors
/// [`CellFault`] names what is in the way and how to mend it.
pub fn check_cell(arm: &Arm, stones: [u32; 2]) -> Result<(), CellFault> {
    generate::check_cell(&arm.layout, stones)
}

/// Name of the ledger of cells in the output folder.
const CELLS: &str = "cells";

/// What decides what a cell comes to.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
struct CellKey {
    /// Hash of what decides how the stones and joints are drawn, see [`WallKeys`].
    wall: String,
    /// Stones along the wall and courses.
    stones: [u32; 2],
    /// What is asked of it.
    asked: String,
}

/// Evaluates all cells, in the order of arms, sizes and cells, with those that `folder` holds already; of a shard those that are its own,
/// and of others what the folder holds. `finished` is told, from the worker threads, how many of how many are done.
///
/// # Errors
/// The first fault of the disk.
pub fn run_cells(
    study: &Study,
    asked: &AskedOfCells,
    (folder, share): (&Path, Option<Share>),
    finished: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<CellRow>, RunError> {
    let mut tasks = Vec::new();
    for &arm in &asked.arms {
        let cells = if is_random(&study.arms[arm as usize]) { asked.cells } else { 1 };
        for size in 0..asked.sizes.len() {
            tasks.extend((0..cells).map(|cell| CellTask { arm, size, cell }));
        }
    }
    let keys = WallKeys::of(&Manifest::of(study));
    let what = format!("{:?} at {:?} Pa", asked.of, asked.pressure);
    let key = |task: &CellTask| CellKey {
        wall: cell_key(study, &keys, asked.point, *task),
        stones: asked.sizes[task.size],
        asked: what.clone(),
    };
    let ledger: Ledger<CellKey, Result<CellAnswer, String>> = Ledger::open(folder, CELLS, share)?;
    let rows = ledger.rows(&tasks, key, finished, |task| evaluate_cell(study, asked, *task).found)?;
    let known =
        tasks.iter().zip(rows).filter_map(|(task, found)| Some(CellRow { task: *task, found: found? }));
    Ok(known.collect())
}

/// The hash of what decides how a cell is drawn.
pub(super) fn cell_key(study: &Study, keys: &WallKeys, point: u32, task: CellTask) -> String {
    let arm = &study.arms[task.arm as usize];
    let key = keys.key(&arm.name, arm.kn_points[point as usize], member(task));
    key.expect("the arm is of the study")
}

/// The number by which a cell's random numbers are drawn.
fn member(task: CellTask) -> u64 {
    FIRST_CELL + ((task.size as u64) << 32) + task.cell
}

/// One cell: a pure function of the study, what is asked and the task.
pub fn evaluate_cell(study: &Study, asked: &AskedOfCells, task: CellTask) -> CellRow {
    let found = with_cell(study, asked, task, |Built { drawn, cell, wall, laws }| {
        let layout = &drawn.arm.layout;
        let weight = layout.density.mean() * STANDARD_GRAVITY * 0.5 * layout.outline.height;
        let contact = drawn.arm.contacts().of_wall(wall);
        asked.of.answer(cell, laws, contact, asked.pressure.unwrap_or(weight))
    });
    CellRow { task, found: found.map_err(|fault| fault.to_string()) }
}

/// A cell with its joints, and the arm and load that go with it.
pub(super) struct Built<'a> {
    pub drawn: &'a AsDrawn<'a>,
    pub cell: &'a Cell,
    /// Its stones alone.
    pub wall: &'a Wall,
    pub laws: &'a dyn JointLaws,
}

/// Builds a cell, draws its joints and asks it something.
pub(super) fn with_cell<R>(
    study: &Study,
    asked: &AskedOfCells,
    task: CellTask,
    ask: impl FnOnce(Built<'_>) -> R,
) -> Result<R, CellFault> {
    // Cells are drawn one by one: a design shares out the walls of the study.
    let study = Study { design: Design::Plain, ..study.clone() };
    let member = member(task);
    let drawn = study.as_drawn(task.arm, member);
    let streams = study.streams(member);
    let made = generate_cell(&drawn.arm.layout, asked.sizes[task.size], &streams)?;
    let wall = Wall { blocks: made.cell.blocks.clone() };
    let kn = drawn.arm.kn_points[asked.point as usize];
    let laws = DrawnJoints::new(&drawn.arm.joint, kn, streams).altered(&drawn.arm.mechanisms, &wall);
    Ok(ask(Built { drawn: &drawn, cell: &made.cell, wall: &wall, laws: &laws }))
}
