//! Walls whose base shakes: every record at every intensity, and what came of each.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::ensemble::built::Built;
use crate::ensemble::columns::{Block, Column, Members, Step, Steps, count, real, text};
use crate::ensemble::design::Task;
use crate::ensemble::evaluate::laws;
use crate::ensemble::limit_analysis::LimitAnalysis;
use crate::ensemble::quantity::{Observed, Quantity};
use crate::ensemble::reading::{StepRow, finite};
use crate::ensemble::record::Row;
use crate::generate::Generated;
use crate::model::{Level, Outcome};
use crate::protocol::{BaseMotion, Bounds, Event, Shaken, Verdict, shake_wall};
use crate::stats::fragility::Outcome as CollapseUnder;
use crate::study::{AsDrawn, Earthquakes, Measure, Study};

/// A wall under a record at an intensity; see [`Shaken`]. Displacements are against the base, since rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShakenRow {
    /// Index of the record in the study.
    pub record: u32,
    /// Index of the intensity.
    pub stripe: u32,
    /// Peak ground acceleration (m/s^2).
    pub pga_m_per_s2: f64,
    /// Peak ground velocity (m/s).
    pub pgv_m_per_s: f64,
    /// Whether what counts as the wall's collapse came about; `None` where the run and its twin do not tell.
    pub collapse: Option<CollapseUnder>,
    /// How the wall came through.
    pub verdict: Verdict,
    /// How it came through from the start that differs by next to nothing; the same where there was none.
    pub twin: Verdict,
    /// When the first stone fell (s from the beginning of the record).
    pub first_stone_s: Option<f64>,
    /// When `part_share` of the weight had fallen (s).
    pub part_s: Option<f64>,
    /// When `most_share` of it had fallen (s); the run ends there.
    pub most_s: Option<f64>,
    /// Stones that fell.
    pub fallen: u32,
    /// Largest displacement of a stone that had not fallen (m).
    pub displacement_m: f64,
    /// Largest rotation of one (rad).
    pub rotation_rad: f64,
    /// Widest opening of a joint (m).
    pub uplift_m: f64,
    /// Largest slip in a joint (m).
    pub slip_m: f64,
    /// Largest displacement left at the end (m).
    pub residual_m: Option<f64>,
    /// Largest rotation left at the end (rad).
    pub residual_rad: Option<f64>,
    /// Time followed (s).
    pub time_s: f64,
    /// Steps that were not solved to the tolerance.
    pub unsolved_steps: u64,
}

impl ShakenRow {
    /// How strong the record was, in a measure.
    pub fn peak(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Pga => self.pga_m_per_s2,
            Measure::Pgv => self.pgv_m_per_s,
        }
    }
}

impl Row {
    /// What came of each record at each intensity, of a wall that is shaken.
    pub fn runs(&self) -> impl Iterator<Item = &ShakenRow> {
        self.load_steps.iter().filter_map(|step| step.shaken.as_ref())
    }
}

/// The row of a wall that meets all records. They are shared out over the threads like walls, as a study may have few of those.
pub fn shaken(study: &Study, earthquakes: &Earthquakes, task: Task, generated: &Generated) -> Row {
    let drawn = study.as_drawn(task.arm, task.member);
    let AsDrawn { arm, protocol, .. } = &drawn;
    let base = &study.base_motion().expect("records come with a base that shakes");
    let wall = &generated.wall;
    let laws = laws(study, task, arm, wall);
    let contacts = arm.contacts();
    let stripes = earthquakes.intensities.len();
    let runs = earthquakes.records.len() * stripes;
    let steps = shake_wall(wall, &laws, base, &arm.restraint, contacts, &study.solver, |shake| {
        let one = |run: usize| {
            let (record, stripe) = (run / stripes, run % stripes);
            let motion = earthquakes.records[record].at(earthquakes.intensities[stripe]);
            let [seen, twin] = shake(motion);
            step(earthquakes, base, [record, stripe], &seen, &twin)
        };
        (0..runs).into_par_iter().with_max_len(1).map(one).collect::<Vec<StepRow>>()
    });
    let (steps, joints) = steps.expect("a study is read with a solver that knows time");
    let bounds = || Bounds::of(wall, &laws, protocol, &arm.restraint, contacts);
    let limit = study.agreement.then(|| LimitAnalysis::alone(&bounds()));
    let outcome = outcome(earthquakes, &steps);
    Row {
        limit,
        built: Built { joints: joints as u32, ..Built::of(generated) },
        solver_steps: steps.iter().map(|step| step.solver_steps).sum(),
        load_steps: steps,
        ..Row::of(study, task, outcome)
    }
}

/// One run.
fn step(
    earthquakes: &Earthquakes,
    base: &BaseMotion,
    [record, stripe]: [usize; 2],
    seen: &Shaken,
    twin: &Shaken,
) -> StepRow {
    let intensity = earthquakes.intensities[stripe];
    let peak = |measure| earthquakes.records[record].peak(measure, intensity);
    let shaken = ShakenRow {
        record: record as u32,
        stripe: stripe as u32,
        pga_m_per_s2: peak(Measure::Pga),
        pgv_m_per_s: peak(Measure::Pgv),
        collapse: collapse(base.shares.capacity, seen, twin),
        verdict: seen.verdict,
        twin: twin.verdict,
        first_stone_s: seen.first_stone_s,
        part_s: seen.part_s,
        most_s: seen.most_s,
        fallen: seen.fallen.len() as u32,
        displacement_m: seen.displacement.value,
        rotation_rad: seen.rotation.value,
        uplift_m: seen.uplift.value,
        slip_m: seen.slip.value,
        residual_m: seen.residual_m.and_then(finite),
        residual_rad: seen.residual_rad.and_then(finite),
        time_s: seen.time_s,
        unsolved_steps: seen.unsolved_steps,
    };
    StepRow { solver_steps: seen.steps, shaken: Some(shaken), ..StepRow::default() }
}

/// Whether an event came about in a run and in its twin.
fn collapse(event: Event, seen: &Shaken, twin: &Shaken) -> Option<CollapseUnder> {
    let solved = |run: &Shaken| !matches!(run.verdict, Verdict::UnstableAtRest | Verdict::NotSolved);
    if !solved(seen) || !solved(twin) {
        return None;
    }
    let came = |run: &Shaken| match event {
        Event::FirstStone => run.first_stone_s.is_some(),
        Event::Part => run.part_s.is_some(),
        Event::Most => run.most_s.is_some(),
    };
    Some(match (came(seen), came(twin)) {
        (true, true) => CollapseUnder::Collapsed,
        (false, false) => CollapseUnder::Stands,
        _ => CollapseUnder::Undecided,
    })
}

/// How a wall ended over all its runs: at rest after each; collapsed, at the lowest intensity at which it did; or without an answer,
/// where none of them collapsed and one has no verdict, or chance decides it.
fn outcome(earthquakes: &Earthquakes, steps: &[StepRow]) -> Outcome {
    let level = |shaken: &ShakenRow| {
        let intensity = earthquakes.intensities[shaken.stripe as usize];
        match earthquakes.measure {
            Measure::Pga => Level::Acceleration(intensity),
            Measure::Pgv => Level::Velocity(intensity),
        }
    };
    let runs = || steps.iter().filter_map(|step| step.shaken.as_ref());
    let lowest = |wanted: Option<CollapseUnder>| {
        runs().filter(|run| run.collapse == wanted).min_by_key(|run| run.stripe)
    };
    if runs().all(|run| run.verdict == Verdict::UnstableAtRest) {
        return Outcome::UnstableAtRest;
    }
    if let Some(run) = lowest(Some(CollapseUnder::Collapsed)) {
        return Outcome::Collapsed { at: level(run) };
    }
    let without = |run: &ShakenRow, why: &str| Outcome::NotConverged {
        at: level(run),
        unbalanced_ratio: 0.0,
        why: format!("{} {why}", earthquakes.records[run.record as usize].name()),
    };
    if let Some(run) = lowest(None) {
        return without(run, "has no verdict: the solver lost the wall on its way");
    }
    match lowest(Some(CollapseUnder::Undecided)) {
        Some(run) => without(run, "is undecided: a start that differs by 1e-9 m/s ends otherwise"),
        None => Outcome::Equilibrium,
    }
}

/// The quantity of a study.
pub fn quantity(study: &Study) -> Quantity {
    Quantity::CollapseIntensity(study.earthquakes.as_ref().map_or(Measure::Pga, |records| records.measure))
}

/// What a wall says of [`Quantity::CollapseIntensity`].
pub fn collapses(row: &Row, measure: Measure) -> Observed {
    match row.outcome {
        Outcome::Collapsed { at: Level::Acceleration(x) | Level::Velocity(x) } => Observed::Value(x),
        Outcome::Equilibrium => {
            let strongest = row.runs().map(|run| run.peak(measure)).reduce(f64::max);
            strongest.map_or(Observed::Nothing, Observed::Above)
        }
        _ => Observed::Nothing,
    }
}

/// Columns of what came of each record.
pub(super) const SHAKEN: Block =
    Block { name: "shaken", fills: |row| row.runs().next().is_some(), members, steps };

/// Runs of a wall that ended so.
fn runs(row: &Row, ended: Option<CollapseUnder>) -> u64 {
    row.runs().filter(|run| run.collapse == ended).count() as u64
}

/// Of the table of members.
fn members() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        count("runs", "records times intensities that the wall met", |r: R| r.runs().count() as u64),
        count("runs_collapsed", "those under which it collapsed (load.capacity)", |r: R| {
            runs(r, Some(CollapseUnder::Collapsed))
        }),
        count("runs_undecided", "those that a start 1e-9 m/s off rest decides otherwise", |r: R| {
            runs(r, Some(CollapseUnder::Undecided))
        }),
        count("runs_without_verdict", "those that the solver did not follow to an end", |r: R| runs(r, None)),
    ]
}

/// Of the table of load steps.
fn steps() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        real("record", "", "number of the record, from 0", |s: S| each(s, |run| run.record.into())),
        real("pga_m_per_s2", "m/s2", "peak ground acceleration", |s: S| each(s, |run| run.pga_m_per_s2)),
        real("pgv_m_per_s", "m/s", "peak ground velocity", |s: S| each(s, |run| run.pgv_m_per_s)),
        text("collapse", "collapsed, stands or undecided (load.capacity)", |s: S| {
            word(s.step.shaken.as_ref()?.collapse.as_ref()?)
        }),
        text(
            "verdict",
            "how the wall came through: stands, damaged, collapsed, undecided, unstable_at_rest, not_solved",
            |s: S| word(&s.step.shaken.as_ref()?.verdict),
        ),
        text("twin_verdict", "the same from a start 1e-9 m/s off rest (load.twice)", |s: S| {
            word(&s.step.shaken.as_ref()?.twin)
        }),
        real("first_stone_s", "s", "when the first stone fell", |s: S| maybe(s, |run| run.first_stone_s)),
        real("part_s", "s", "when part_share of the weight had fallen", |s: S| maybe(s, |run| run.part_s)),
        real("most_s", "s", "when most_share of it had fallen; the run ends there", |s: S| {
            maybe(s, |run| run.most_s)
        }),
        real("fallen", "", "number of stones that fell", |s: S| each(s, |run| run.fallen.into())),
        real(
            "displacement_m",
            "m",
            "largest displacement against the base of a stone that had not fallen",
            |s: S| each(s, |run| run.displacement_m),
        ),
        real("rotation_rad", "rad", "largest rotation of one", |s: S| each(s, |run| run.rotation_rad)),
        real("uplift_m", "m", "widest opening of a joint", |s: S| each(s, |run| run.uplift_m)),
        real("slip_m", "m", "largest slip in a joint", |s: S| each(s, |run| run.slip_m)),
        real(
            "residual_m",
            "m",
            "largest displacement left at the end; none of a wall that collapsed",
            |s: S| maybe(s, |run| run.residual_m),
        ),
        real("residual_rad", "rad", "largest rotation left at the end", |s: S| {
            maybe(s, |run| run.residual_rad)
        }),
        real("time_s", "s", "how long the wall was followed", |s: S| each(s, |run| run.time_s)),
        real("unsolved_steps", "", "time steps that were not solved to the tolerance", |s: S| {
            each(s, |run| run.unsolved_steps as f64)
        }),
    ]
}

fn each(step: Step<'_>, value: impl Fn(&ShakenRow) -> f64) -> Option<f64> {
    step.step.shaken.as_ref().map(value)
}

fn maybe(step: Step<'_>, value: impl Fn(&ShakenRow) -> Option<f64>) -> Option<f64> {
    step.step.shaken.as_ref().and_then(value)
}

/// The name of a variant, as files have it.
fn word(value: &impl serde::Serialize) -> Option<String> {
    serde_json::to_value(value).ok()?.as_str().map(str::to_owned)
}
