//! The loop over types of elements: fill the cube, shove it, note what happened and, apart from that, how long it took.

use std::fs;
use std::num::NonZero;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::ensemble::ledger::Ledger;
use crate::ensemble::{RunError, Settings, replace_file};
use crate::generate::elements::Shapes;
use crate::model::{Block, Heap, Wall};
use crate::protocol::{Phase, Shoved, Stand, shove_heap, shove_wall};
use crate::random::Streams;
use crate::study::{ElementArm, ElementStudy};

/// Name of the file that keeps what is evaluated, without ending.
const LEDGER: &str = "elements";
/// Name of the table of a run of element types.
pub const ELEMENTS_CSV: &str = "elements.csv";

/// One assembly of one type of element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ElementRow {
    /// Name of the arm.
    pub arm: String,
    /// Index of the assembly within its arm.
    pub member: u64,
    /// Number of elements.
    pub elements: usize,
    /// Number of spheres that they are made of; `None` for polyhedra.
    pub spheres: Option<usize>,
    /// What became of it; `None` where no assembly came out.
    pub stand: Option<Stand>,
    /// Why no assembly came out.
    pub no_room: Option<String>,
    /// Time step at the end of gravity (s).
    pub time_step_s: Option<f64>,
    /// Cycles under both loads.
    pub cycles: u64,
    /// Joints or contacts that carry at the end.
    pub contacts: usize,
    /// What happened under gravity.
    pub gravity: Option<Phase>,
    /// What happened under the horizontal acceleration, if it came to that.
    pub sideways: Option<Phase>,
}

impl ElementRow {
    /// How it ended, as in files.
    pub fn ending(&self) -> &'static str {
        self.stand.map_or("no_room", Stand::name)
    }

    /// Cycles to the coarse ratio under gravity and under the horizontal acceleration.
    pub fn to_coarse(&self) -> [Option<u64>; 2] {
        [self.gravity, self.sideways].map(|phase| phase?.to_coarse)
    }

    /// The same to the fine ratio.
    pub fn to_fine(&self) -> [Option<u64>; 2] {
        [self.gravity, self.sideways].map(|phase| phase?.to_fine)
    }
}

/// A row, and what it took to compute, which depends on the machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timed {
    /// What came out.
    pub row: ElementRow,
    /// Time on the clock (s).
    pub seconds: f64,
    /// Worker threads of the run that computed it.
    pub threads: usize,
}

/// Evaluates every type of element and writes `elements.csv`, which is the same in every run, and `timing.csv`. Assemblies that an
/// earlier run of the study ended in the folder are not evaluated again, so that a run goes on where it was stopped and may grow.
/// `finished` is told, from the worker threads, how many of how many assemblies are done.
///
/// # Errors
/// [`RunError`] when the folder or a file cannot be written, or holds assemblies of another study.
pub fn run_elements(
    study: &ElementStudy,
    settings: &Settings,
    finished: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Timed>, RunError> {
    let out = &settings.out;
    fs::create_dir_all(out).map_err(|e| RunError::file("create the folder", out, e))?;
    let threads =
        settings.threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZero::get);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let tasks: Vec<(&ElementArm, u64)> =
        study.arms.iter().flat_map(|arm| (0..arm.members).map(move |member| (arm, member))).collect();
    let timed = |&(arm, member): &(&ElementArm, u64)| {
        let begun = Instant::now();
        let row = evaluate_element(study, arm, member);
        Timed { row, seconds: begun.elapsed().as_secs_f64(), threads }
    };
    let ledger = Ledger::of_study(out, LEDGER, &study.assemblies_hash, None)?;
    let key = |(arm, member): &(&ElementArm, u64)| (arm.name.clone(), *member);
    let rows = pool.install(|| ledger.rows(&tasks, key, finished, timed))?;
    let rows: Vec<Timed> =
        rows.into_iter().map(|row| row.expect("no task is left to another shard")).collect();
    replace_file(&out.join(ELEMENTS_CSV), csv(&rows).as_bytes())?;
    replace_file(&out.join("timing.csv"), timing(&rows).as_bytes())?;
    Ok(rows)
}

/// One assembly: a pure function of the study, the arm and the member.
pub fn evaluate_element(study: &ElementStudy, arm: &ElementArm, member: u64) -> ElementRow {
    let shapes = arm.elements.fill(study.side, &Streams::new(study.seed, member));
    let empty = ElementRow {
        arm: arm.name.clone(),
        member,
        elements: shapes.as_ref().map_or(0, Shapes::len),
        spheres: None,
        stand: None,
        no_room: None,
        time_step_s: None,
        cycles: 0,
        contacts: 0,
        gravity: None,
        sideways: None,
    };
    match shapes {
        Ok(Shapes::Balls(clumps)) => {
            let spheres = Some(clumps.iter().map(Vec::len).sum());
            let heap = Heap::on_ground(clumps, study.sphere_density, study.spheres);
            filled(ElementRow { spheres, ..empty }, shove_heap(&heap, study.grains, &study.shove))
        }
        Ok(Shapes::Polyhedra(solids)) => {
            let density = study.polyhedron_density;
            let block = |shape| Block::stone(shape, density);
            let wall = Wall { blocks: solids.into_iter().map(block).collect() }.with_base();
            filled(empty, shove_wall(&wall, &study.joint, study.sub_contacts, study.explicit, &study.shove))
        }
        Err(fault) => ElementRow { no_room: Some(fault.to_string()), ..empty },
    }
}

fn filled(row: ElementRow, shoved: Shoved) -> ElementRow {
    ElementRow {
        stand: Some(shoved.stand),
        time_step_s: Some(shoved.time_step),
        cycles: shoved.phases.iter().map(|phase| phase.cycles).sum(),
        contacts: shoved.contacts,
        gravity: shoved.phases.first().copied(),
        sideways: shoved.phases.get(1).copied(),
        ..row
    }
}

/// One line per assembly; empty where there is nothing to say.
fn csv(rows: &[Timed]) -> String {
    let mut text = String::from("element,member,elements,spheres,stand,time_step_s,cycles,contacts");
    for load in ["gravity", "sideways"] {
        for column in ["cycles_to_coarse", "cycles_to_fine", "cycles", "moved_m", "unbalanced_ratio"] {
            text.push_str(&format!(",{load}_{column}"));
        }
    }
    text.push('\n');
    let or_empty = |value: Option<String>| value.unwrap_or_default();
    for Timed { row, .. } in rows {
        let mut cells = vec![
            row.arm.clone(),
            row.member.to_string(),
            row.elements.to_string(),
            or_empty(row.spheres.map(|n| n.to_string())),
            row.ending().to_owned(),
            or_empty(row.time_step_s.map(|dt| dt.to_string())),
            row.cycles.to_string(),
            row.contacts.to_string(),
        ];
        for phase in [row.gravity, row.sideways] {
            let of = |value: fn(&Phase) -> Option<String>| or_empty(phase.as_ref().and_then(value));
            cells.push(of(|p| p.to_coarse.map(|n| n.to_string())));
            cells.push(of(|p| p.to_fine.map(|n| n.to_string())));
            cells.push(of(|p| Some(p.cycles.to_string())));
            cells.push(of(|p| Some(p.moved.to_string())));
            cells.push(of(|p| p.unbalanced_ratio.map(|ratio| ratio.to_string())));
        }
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

/// What each assembly took: kept apart from what came out, which must not depend on it.
fn timing(rows: &[Timed]) -> String {
    let mut text = String::from("element,member,seconds,cycles_per_second,threads\n");
    for Timed { row, seconds, threads } in rows {
        let rate = row.cycles as f64 / seconds;
        text.push_str(&format!("{},{},{seconds:.6},{rate:.0},{threads}\n", row.arm, row.member));
    }
    text
}
