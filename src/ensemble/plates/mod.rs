//! Walls beside their plates: what random walls of an arm bear by limit analysis of all their stones, and what plates with the
//! strength of random cells of the same arm say that they bear.
//!
//! Both are samples of one law of walls: a wall is drawn as the study draws its members, a plate as a cell of those that
//! [`run_cells`](crate::ensemble::run_cells) evaluates.

mod made;
mod validity;

use std::path::Path;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::ensemble::cells::{CellTask, cell_key, with_cell};
use crate::ensemble::evaluate::laws;
use crate::ensemble::ledger::Ledger;
use crate::ensemble::shard::Share;
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{AskedOfCells, Manifest, RunError, Task, build, is_random};
use crate::homogenise::plate::{Cuts, Ending, PlateFault, Refined};
use crate::homogenise::plate_collapse;
use crate::math::tan;
use crate::model::{Level, Outcome};
use crate::protocol::limit_of;
use crate::solve::limit::Flow;
use crate::study::{AsDrawn, Study};

use made::plate_of;
pub use made::{NoPlate, check_plate};
use validity::Masonry;
pub use validity::{OutOfRange, Validity};

/// What is asked of walls.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedOfWalls {
    /// Walls of an arm in which anything is drawn; of another arm one is all.
    pub walls: u64,
    /// Plates of such an arm: the first so many of its largest cells.
    pub plates: u64,
    /// Whether walls are asked for a state without dilatancy, too.
    pub non_associative: bool,
}

/// One wall or plate to evaluate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WallTask {
    /// Its arm, by its place in the study.
    pub arm: u32,
    /// Which one.
    pub subject: Subject,
}

/// A plate or a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The plate with the strength of the cell of this number.
    Plate(u64),
    /// The stones of the member of this number.
    Stones(u64),
}

/// What a wall bears.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Judged {
    /// So many times the load: the tangent of the tilt, or a factor on the lateral load.
    Falls(f64),
    /// Any number of times, as far as rigid stones go.
    BearsAny,
    /// Not even its own weight.
    FallsAtRest,
    /// A plate that does not stand for a wall of stones.
    OutOfRange(OutOfRange),
    /// The solver found no answer that can be believed.
    NotSolved(String),
    /// There is no such wall or cell.
    Invalid(String),
}

/// What became of a wall or a plate.
#[derive(Clone, Debug, PartialEq)]
pub struct WallRow {
    /// Which one it is.
    pub task: WallTask,
    /// What it bears with associative flow.
    pub found: Judged,
    /// How it stands for a wall of stones, of a plate that falls.
    pub validity: Option<Validity>,
    /// What its stones bear without dilatancy, where that was asked and they bear a finite load with it.
    pub non_associative: Option<Judged>,
    /// How long it took with associative flow, then without dilatancy (s).
    pub seconds: [f64; 2],
}

/// Name of the ledger of walls and plates in the output folder.
const WALLS: &str = "walls";

/// What decides what a wall or a plate comes to.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
struct WallKey {
    /// Hash of what decides how the stones and joints are drawn, see [`WallKeys`].
    wall: String,
    /// Stones along the wall and courses of a plate's cell; `None` of a wall of stones.
    stones: Option<[u32; 2]>,
    /// Whether a state without dilatancy is asked for, too.
    non_associative: bool,
}

/// What a wall or a plate came to, as [`WallRow`] has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Borne {
    found: Judged,
    validity: Option<Validity>,
    non_associative: Option<Judged>,
    seconds: [f64; 2],
}

/// Evaluates all walls and plates, in the order of arms, plates before walls, with those that `folder` holds already; of a shard those that
/// are its own, and of others what the folder holds. `finished` is told, from the worker threads, how many of how many are done.
///
/// # Errors
/// The first fault of the disk.
pub fn run_walls(
    study: &Study,
    (cells, asked): (&AskedOfCells, &AskedOfWalls),
    (folder, share): (&Path, Option<Share>),
    finished: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<WallRow>, RunError> {
    let mut tasks = Vec::new();
    for &arm in &cells.arms {
        let [plates, walls] = match is_random(&study.arms[arm as usize]) {
            true => [asked.plates, asked.walls],
            false => [1, 1],
        };
        tasks.extend((0..plates).map(|cell| WallTask { arm, subject: Subject::Plate(cell) }));
        tasks.extend((0..walls).map(|member| WallTask { arm, subject: Subject::Stones(member) }));
    }
    let keys = WallKeys::of(&Manifest::of(study));
    let ledger: Ledger<WallKey, Borne> = Ledger::open(folder, WALLS, share)?;
    let key = |task: &WallTask| key(study, &keys, (cells, asked), *task);
    let borne = |task: &WallTask| {
        let WallRow { found, validity, non_associative, seconds, .. } =
            evaluate_wall(study, cells, asked, *task);
        Borne { found, validity, non_associative, seconds }
    };
    let rows = ledger.rows(&tasks, key, finished, borne)?;
    let row = |(task, borne): (&WallTask, Option<Borne>)| {
        let Borne { found, validity, non_associative, seconds } = borne?;
        Some(WallRow { task: *task, found, validity, non_associative, seconds })
    };
    Ok(tasks.iter().zip(rows).filter_map(row).collect())
}

fn key(
    study: &Study,
    keys: &WallKeys,
    (cells, asked): (&AskedOfCells, &AskedOfWalls),
    task: WallTask,
) -> WallKey {
    let arm = &study.arms[task.arm as usize];
    let non_associative = asked.non_associative;
    match task.subject {
        Subject::Plate(cell) => {
            let size = cells.sizes.len() - 1;
            let wall = cell_key(study, keys, cells.point, CellTask { arm: task.arm, size, cell });
            // Plates are asked for the one flow alone.
            WallKey { wall, stones: Some(cells.sizes[size]), non_associative: false }
        }
        Subject::Stones(member) => {
            let wall = keys.key(&arm.name, arm.kn_points[cells.point as usize], member);
            WallKey { wall: wall.expect("the arm is of the study"), stones: None, non_associative }
        }
    }
}

/// One wall or plate: but for the time it takes a pure function of the study, what is asked and the task.
pub fn evaluate_wall(study: &Study, cells: &AskedOfCells, asked: &AskedOfWalls, task: WallTask) -> WallRow {
    match task.subject {
        Subject::Plate(cell) => {
            let begun = Instant::now();
            let (found, validity) = as_plate(study, cells, task.arm, cell);
            let seconds = [begun.elapsed().as_secs_f64(), 0.0];
            WallRow { task, found, validity, non_associative: None, seconds }
        }
        Subject::Stones(member) => by_stones(study, cells.point, asked.non_associative, task, member),
    }
}

/// What a plate bears, and of one that falls how it stands for its stones.
fn as_plate(study: &Study, asked: &AskedOfCells, arm: u32, cell: u64) -> (Judged, Option<Validity>) {
    let size = asked.sizes.len() - 1;
    let stones = asked.sizes[size];
    let judged = with_cell(study, asked, CellTask { arm, size, cell }, |cell| {
        let arm = &cell.drawn.arm;
        let plate = plate_of(arm, &cell.drawn.protocol, cell.cell, stones)
            .map_err(|fault| Judged::Invalid(fault.to_string()))?;
        let stone = [0, 1].map(|axis| cell.cell.lattice[axis][axis] / f64::from(stones[axis]));
        let masonry = Masonry::of(arm, stone);
        masonry.check(&plate).map_err(Judged::OutOfRange)?;
        let contact = arm.contacts().of_wall(cell.wall);
        let refined = plate_collapse(cell.cell, cell.laws, contact, &plate, &Cuts::default());
        let Refined { collapse, ending, .. } = refined.map_err(|fault| match fault {
            PlateFault::Unbounded => Judged::BearsAny,
            PlateFault::FallsAtRest => Judged::FallsAtRest,
            other => Judged::NotSolved(other.to_string()),
        })?;
        if ending == Ending::RoundsSpent {
            // Too high by an unknown amount: nothing to judge a wall by.
            let why = "planes of its surface were still found when the rounds were spent";
            return Err(Judged::NotSolved(why.to_owned()));
        }
        let multiplier = collapse.multiplier.min(collapse.sliding.unwrap_or(f64::INFINITY));
        let validity = masonry.validity(&plate, multiplier).map_err(Judged::OutOfRange)?;
        Ok((Judged::Falls(multiplier), Some(validity)))
    });
    match judged {
        Ok(Ok(falls)) => falls,
        Ok(Err(judged)) => (judged, None),
        Err(fault) => (Judged::Invalid(fault.to_string()), None),
    }
}

fn by_stones(study: &Study, point: u32, non_associative: bool, task: WallTask, member: u64) -> WallRow {
    let begun = Instant::now();
    let generated = match build(study, task.arm, member) {
        Ok(generated) => generated,
        Err(fault) => {
            let seconds = [begun.elapsed().as_secs_f64(), 0.0];
            let found = Judged::Invalid(fault.to_string());
            return WallRow { task, found, validity: None, non_associative: None, seconds };
        }
    };
    let AsDrawn { arm, protocol, .. } = study.as_drawn(task.arm, member);
    let wall = &generated.wall;
    let laws = laws(study, Task { arm: task.arm, point, member }, &arm, wall);
    let contacts = arm.contacts();
    let asked = |flow| {
        let begun = Instant::now();
        let limit = limit_of(wall, &laws, (&protocol, &arm.restraint, contacts), flow);
        (judged(limit.outcome), begun.elapsed().as_secs_f64())
    };
    let (found, first) = asked(Flow::Associative);
    let second = (non_associative && matches!(found, Judged::Falls(_))).then(|| asked(Flow::NonAssociative));
    let seconds = [first, second.as_ref().map_or(0.0, |(_, seconds)| *seconds)];
    let non_associative = second.map(|(judged, _)| judged);
    WallRow { task, found, validity: None, non_associative, seconds }
}

/// What limit analysis found.
fn judged(outcome: Outcome) -> Judged {
    match outcome {
        Outcome::Collapsed { at: Level::Tilt(tilt) } => Judged::Falls(tan(tilt)),
        Outcome::Collapsed { at } => Judged::Falls(at.value()),
        Outcome::Equilibrium | Outcome::Unbounded => Judged::BearsAny,
        Outcome::UnstableAtRest => Judged::FallsAtRest,
        other => Judged::NotSolved(other.reason()),
    }
}
