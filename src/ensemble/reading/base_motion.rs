//! Walls whose base shakes: every record at every intensity, and what came of each.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::ensemble::built::Built;
use crate::ensemble::columns::{Block, Column, Members, column, of_optional};
use crate::ensemble::design::Task;
use crate::ensemble::evaluate::laws;
use crate::ensemble::field::record;
use crate::ensemble::limit_analysis::LimitAnalysis;
use crate::ensemble::quantity::{Observed, Quantity};
use crate::ensemble::reading::sought::sought;
use crate::ensemble::reading::{StepRow, finite};
use crate::ensemble::record::Row;
use crate::generate::Generated;
use crate::model::{Level, Outcome};
use crate::protocol::{BaseMotion, Bounds, Contacts, Event, Shaken, Verdict, shake_wall};
use crate::solve::{Solver, nonsmooth};
use crate::stats::fragility::Outcome as CollapseUnder;
use crate::study::{Arm, AsDrawn, DrawnJoints, Earthquakes, Measure, Meeting, Study};

record! {
    /// A wall under a record at an intensity; see [`Shaken`]. Displacements are against the base, since rest.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    ShakenRow {
        record: u32 = "record", "", "number of the record, from 0";
        /// Index of the intensity, or of what is looked for.
        stripe: u32;
        pga_m_per_s2: f64 = "pga_m_per_s2", "m/s2", "peak ground acceleration";
        pgv_m_per_s: f64 = "pgv_m_per_s", "m/s", "peak ground velocity";
        collapse: Option<CollapseUnder> = "collapse", "", "collapsed, stands or undecided (load.capacity)";
        verdict: Verdict = "verdict", "",
            "how the wall came through: stands, damaged, collapsed, undecided, unstable_at_rest, not_solved";
        twin: Verdict = "twin_verdict", "", "the same from a start 1e-9 m/s off rest (load.twice)";
        first_stone_s: Option<f64> = "first_stone_s", "s", "when the first stone fell";
        part_s: Option<f64> = "part_s", "s", "when part_share of the weight had fallen";
        most_s: Option<f64> = "most_s", "s", "when most_share of it had fallen; the run ends there";
        fallen: u32 = "fallen", "", "number of stones that fell";
        displacement_m: f64 = "displacement_m", "m",
            "largest displacement against the base of a stone that had not fallen";
        rotation_rad: f64 = "rotation_rad", "rad", "largest rotation of one";
        uplift_m: f64 = "uplift_m", "m", "widest opening of a joint";
        slip_m: f64 = "slip_m", "m", "largest slip in a joint";
        residual_m: Option<f64> = "residual_m", "m",
            "largest displacement left at the end; none of a wall that collapsed";
        residual_rad: Option<f64> = "residual_rad", "rad", "largest rotation left at the end";
        time_s: f64 = "time_s", "s", "how long the wall was followed";
        unsolved_steps: u64 =
            "unsolved_steps", "", "time steps that were not solved to the tolerance";
    }
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
    let base = study.base_motion().expect("records come with a base that shakes");
    let wall = &generated.wall;
    let laws = laws(study, task, arm, wall);
    let table = Table { study, earthquakes, arm, base, generated, laws: &laws };
    let (steps, joints) = match earthquakes.sought.is_empty() {
        true => table.stripes(),
        false => sought(&table),
    };
    let bounds = || Bounds::of(wall, &laws, protocol, &arm.restraint, arm.contacts());
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

/// A wall on the base that shakes it.
pub(super) struct Table<'t> {
    study: &'t Study,
    pub(super) earthquakes: &'t Earthquakes,
    arm: &'t Arm,
    base: BaseMotion,
    generated: &'t Generated,
    laws: &'t DrawnJoints<'t>,
}

/// Shakes the wall by a record (its index) at an intensity, as what is numbered so.
pub(super) type Shake<'s> = &'s (dyn Fn(usize, f64, usize) -> StepRow + Sync);

impl Table<'_> {
    /// Every record at every intensity.
    fn stripes(&self) -> (Vec<StepRow>, usize) {
        let Earthquakes { intensities, records, .. } = self.earthquakes;
        let places: Vec<u32> = (0..records.len() as u32).collect();
        self.each_from_rest(&places, |record, shake| {
            let stripes = (0..intensities.len()).into_par_iter().with_max_len(1);
            stripes.map(|stripe| shake(record, intensities[stripe], stripe)).collect()
        })
    }

    /// Does some work for each motion, by their places in the sequence that the wall meets: from one rest, unless the wall is another one by
    /// the time that it meets the next. Gives the runs in that order, and the number of joints.
    pub(super) fn each_from_rest(
        &self,
        places: &[u32],
        work: impl Fn(usize, Shake<'_>) -> Vec<StepRow> + Sync,
    ) -> (Vec<StepRow>, usize) {
        let meetings: Vec<Meeting> = places.iter().map(|nth| self.arm.mechanisms.meeting(*nth)).collect();
        let is_alike = meetings.iter().all(|meeting| *meeting == meetings[0]);
        let all: Vec<usize> = (0..meetings.len()).collect();
        let of = |numbers: &[usize]| {
            self.bring_to_rest(&meetings[numbers[0]], |shake| {
                let each = numbers.par_iter().with_max_len(1).map(|number| work(*number, shake));
                each.collect::<Vec<_>>().concat()
            })
        };
        let sets = all.par_chunks(if is_alike { all.len().max(1) } else { 1 }).with_max_len(1);
        let done: Vec<(Vec<StepRow>, usize)> = sets.map(of).collect();
        let joints = done.first().map_or(0, |(_, joints)| *joints);
        (done.into_iter().flat_map(|(steps, _)| steps).collect(), joints)
    }

    /// Brings the wall to rest as it meets a motion, and lets `each` shake it. Gives what that does, and the number of joints.
    fn bring_to_rest<R>(&self, meeting: &Meeting, each: impl FnOnce(Shake<'_>) -> R) -> (R, usize) {
        let Table { study, earthquakes, arm, base, generated, laws } = self;
        let contacts = arm.contacts();
        let contacts = Contacts { inset: contacts.inset + meeting.inset, ..contacts };
        let solver = bouncing(&study.solver, meeting.restitution);
        let shaken = shake_wall(&generated.wall, *laws, base, &arm.restraint, contacts, &solver, |shake| {
            each(&|record: usize, intensity: f64, number: usize| {
                let [seen, twin] = shake(earthquakes.records[record].met(intensity, meeting));
                let collapse = collapse(base.shares.capacity, &seen, &twin);
                step(earthquakes, (record, intensity, number), collapse, &seen, &twin)
            })
        });
        shaken.expect("a study is read with a solver that knows time")
    }
}

/// A solver whose impacts give back a part of the speed.
fn bouncing(solver: &Solver, restitution: Option<f64>) -> Solver {
    match (*solver, restitution) {
        (Solver::Nonsmooth(settings), Some(restitution)) => Solver::Nonsmooth(nonsmooth::Settings {
            normal: nonsmooth::Normal::Velocity { restitution },
            ..settings
        }),
        (solver, _) => solver,
    }
}

/// One run.
fn step(
    earthquakes: &Earthquakes,
    (record, intensity, stripe): (usize, f64, usize),
    collapse: Option<CollapseUnder>,
    seen: &Shaken,
    twin: &Shaken,
) -> StepRow {
    let peak = |measure| earthquakes.records[record].peak(measure, intensity);
    let shaken = ShakenRow {
        record: record as u32,
        stripe: stripe as u32,
        pga_m_per_s2: peak(Measure::Pga),
        pgv_m_per_s: peak(Measure::Pgv),
        collapse,
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
    if !earthquakes.sought.is_empty() {
        // Walls are shaken until they fall, whatever the intensity.
        return match runs().all(|run| run.verdict == Verdict::UnstableAtRest) {
            true => Outcome::UnstableAtRest,
            false => Outcome::Equilibrium,
        };
    }
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
pub(super) const SHAKEN: Block = Block {
    name: "shaken",
    fills: |row| row.runs().next().is_some(),
    members,
    steps: || of_optional(|step: &StepRow| step.shaken.as_ref()),
};

fn members() -> Vec<Column<Members>> {
    fn runs(row: &Row, ended: Option<CollapseUnder>) -> u64 {
        row.runs().filter(|run| run.collapse == ended).count() as u64
    }
    type R<'r> = &'r Row;
    vec![
        column("runs", "", "records times intensities that the wall met", |r: R| r.runs().count() as u64),
        column("runs_collapsed", "", "those under which it collapsed (load.capacity)", |r: R| {
            runs(r, Some(CollapseUnder::Collapsed))
        }),
        column("runs_undecided", "", "those that a start 1e-9 m/s off rest decides otherwise", |r: R| {
            runs(r, Some(CollapseUnder::Undecided))
        }),
        column("runs_without_verdict", "", "those that the solver did not follow to an end", |r: R| {
            runs(r, None)
        }),
    ]
}
