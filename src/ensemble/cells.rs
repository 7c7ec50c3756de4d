//! The loop over random cells: what masonry of an arm's kind is as a plate, cell by cell.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::ensemble::is_random;
use crate::generate::{self, CellFault, generate_cell};
use crate::homogenise::{AskedOfCell, CellAnswer};
use crate::interrupt;
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
    pub found: Result<CellAnswer, CellFault>,
}

/// Whether an arm can have cells of a size at all, before any is built.
///
/// # Errors
/// [`CellFault`] names what is in the way and how to mend it.
pub fn check_cell(arm: &Arm, stones: [u32; 2]) -> Result<(), CellFault> {
    generate::check_cell(&arm.layout, stones)
}

/// Evaluates all cells, in the order of arms, sizes and cells. `finished` is told, from the worker threads, how many of how many are
/// done.
pub fn run_cells(
    study: &Study,
    asked: &AskedOfCells,
    finished: &(dyn Fn(usize, usize) + Sync),
) -> Vec<CellRow> {
    let mut tasks = Vec::new();
    for &arm in &asked.arms {
        let cells = if is_random(&study.arms[arm as usize]) { asked.cells } else { 1 };
        for size in 0..asked.sizes.len() {
            tasks.extend((0..cells).map(|cell| CellTask { arm, size, cell }));
        }
    }
    counted(&tasks, finished, |task| evaluate_cell(study, asked, *task))
}

/// Evaluates tasks on all threads, in their order. `finished` is told, from these threads, how many of how many are done.
pub(super) fn counted<T: Sync, R: Send>(
    tasks: &[T],
    finished: &(dyn Fn(usize, usize) + Sync),
    evaluate: impl Fn(&T) -> R + Sync,
) -> Vec<R> {
    let done = AtomicUsize::new(0);
    let evaluated = |task: &T| {
        let row = evaluate(task);
        finished(done.fetch_add(1, Ordering::Relaxed) + 1, tasks.len());
        row
    };
    tasks.par_iter().with_max_len(1).map(evaluated).collect()
}

/// One cell: a pure function of the study, what is asked and the task.
pub fn evaluate_cell(study: &Study, asked: &AskedOfCells, task: CellTask) -> CellRow {
    interrupt::look();
    let found = with_cell(study, asked, task, |Built { drawn, cell, wall, laws }| {
        let layout = &drawn.arm.layout;
        let weight = layout.density.mean() * STANDARD_GRAVITY * 0.5 * layout.outline.height;
        let contact = drawn.arm.contacts().of_wall(wall);
        asked.of.answer(cell, laws, contact, asked.pressure.unwrap_or(weight))
    });
    CellRow { task, found }
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
    let member = FIRST_CELL + ((task.size as u64) << 32) + task.cell;
    let drawn = study.as_drawn(task.arm, member);
    let streams = study.streams(member);
    let made = generate_cell(&drawn.arm.layout, asked.sizes[task.size], &streams)?;
    let wall = Wall { blocks: made.cell.blocks.clone() };
    let kn = drawn.arm.kn_points[asked.point as usize];
    let laws = DrawnJoints::new(&drawn.arm.joint, kn, streams).altered(&drawn.arm.mechanisms, &wall);
    Ok(ask(Built { drawn: &drawn, cell: &made.cell, wall: &wall, laws: &laws }))
}
