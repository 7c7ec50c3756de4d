//! A member whose base shakes: every record at every intensity.

use rayon::prelude::*;

use crate::ensemble::evaluate::{built, finite, laws};
use crate::ensemble::{LimitAnalysis, Row, ShakenRow, StepRow, Task};
use crate::generate::Generated;
use crate::math::degrees;
use crate::model::{Level, Outcome};
use crate::protocol::{Agreement, BaseMotion, Bounds, Event, Shaken, Verdict, shake_wall};
use crate::stats::fragility::Outcome as CollapseUnder;
use crate::study::{AsDrawn, Earthquakes, Measure, Study};

/// The row of a wall that meets all records. They are shared out over the threads like walls, as a study may have few of those.
pub(super) fn shaken(study: &Study, earthquakes: &Earthquakes, task: Task, generated: &Generated) -> Row {
    let drawn = study.as_drawn(task.arm, task.member);
    let AsDrawn { arm, protocol, .. } = &drawn;
    let base = &study.base_motion().expect("records come with a base that shakes");
    let wall = &generated.wall;
    let laws = laws(study, task, arm, wall);
    let contacts = arm.contacts();
    let stripes = earthquakes.intensities.len();
    let runs = earthquakes.records.len() * stripes;
    let steps = shake_wall(wall, &laws, base, &arm.restraint, contacts, &study.solver, |shake| {
        let of = |run: usize| {
            let (record, stripe) = (run / stripes, run % stripes);
            let motion = earthquakes.records[record].at(earthquakes.intensities[stripe]);
            let [seen, twin] = shake(motion);
            step(earthquakes, base, [record, stripe], &seen, &twin)
        };
        (0..runs).into_par_iter().with_max_len(1).map(of).collect::<Vec<StepRow>>()
    });
    let (steps, joints) = steps.expect("a study is read with a solver that knows time");
    let limit = study.agreement.then(|| {
        let bounds = Bounds::of(wall, &laws, protocol, &arm.restraint, contacts);
        LimitAnalysis {
            angle_deg: bounds.associative.map(degrees),
            non_associative_angle_deg: bounds.non_associative.map(degrees),
            multiplier: None,
            non_associative_multiplier: None,
            agreement: Agreement::NoAnswer,
            ratio: None,
        }
    });
    let outcome = outcome(earthquakes, &steps);
    Row {
        limit,
        joints: joints as u32,
        solver_steps: steps.iter().map(|step| step.solver_steps).sum(),
        load_steps: steps,
        ..built(study, task, generated, outcome)
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
    let came = |run: &Shaken| {
        let at = match event {
            Event::FirstStone => run.first_stone_s,
            Event::Part => run.part_s,
            Event::Most => run.most_s,
        };
        at.is_some()
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
