//! One member: its wall, its joints, its protocol, its row. A pure function of study, seed and task.

use crate::ensemble::shaken::shaken;
use crate::ensemble::{LimitAnalysis, Mechanism, Row, ShearRow, StepRow, Task, UndecidedRow};
use crate::generate::{Generated, InvalidGeometry, generate};
use crate::interrupt;
use crate::math::degrees;
use crate::model::{Level, Outcome, Wall};
use crate::protocol::{self, Agreement, Bounds, Protocol, Witness};
use crate::solve::limit::Flow;
use crate::solve::{STANDARD_GRAVITY, Solver};
use crate::stats;
use crate::study::{Arm, AsDrawn, DrawnJoints, Study};

/// The wall of a member, the same one at every kn: only the arm as drawn, the seed and the member enter.
///
/// # Errors
/// [`InvalidGeometry`] when the generator found no valid wall within its attempts.
pub fn build(study: &Study, arm: u32, member: u64) -> Result<Generated, InvalidGeometry> {
    let AsDrawn { arm, protocol, .. } = study.as_drawn(arm, member);
    let generated = generate(&arm.layout, &study.streams(member))?;
    let wall = arm.mechanisms.built(generated.wall, &protocol);
    let wall = if arm.turned { wall.turned(arm.layout.outline.length) } else { wall };
    Ok(Generated { wall, ..generated })
}

/// Evaluates one member at one kn: builds its wall, draws its joints, takes it through the study's protocol. A wall
/// that cannot be built, falls or does not come to rest gives a row whose outcome says so.
///
/// Every point builds its wall anew: that costs little beside solving it, and no task waits for another.
pub fn evaluate(study: &Study, task: Task) -> Row {
    interrupt::look();
    match build(study, task.arm, task.member) {
        Ok(generated) => match &study.earthquakes {
            Some(earthquakes) => shaken(study, earthquakes, task, &generated),
            None => solved(study, task, &generated),
        },
        Err(fault) => Row {
            attempts: fault.attempts,
            redraws: fault.redraws,
            ..unsolved(study, task, Outcome::InvalidGeometry { reason: fault.to_string() })
        },
    }
}

/// Draws the joints of a member's wall and takes it through the study's protocol, seen by a witness.
pub fn solve(study: &Study, task: Task, wall: &Wall, witness: Witness<'_>) -> protocol::Run {
    let drawn = study.as_drawn(task.arm, task.member);
    let AsDrawn { arm, protocol, .. } = &drawn;
    let laws = laws(study, task, arm, wall);
    let contacts = arm.contacts();
    let changes = arm.mechanisms.changes(wall, &study.streams(task.member));
    let way = protocol::Way { changes: &changes, witness };
    protocol::run_seen_by(wall, &laws, protocol, &arm.restraint, contacts, way, &study.solver)
}

/// The laws of the joints of a task's member, from its arm as drawn.
pub(super) fn laws<'a>(study: &Study, task: Task, arm: &'a Arm, wall: &Wall) -> DrawnJoints<'a> {
    let kn = arm.kn_points[task.point as usize];
    DrawnJoints::new(&arm.joint, kn, study.streams(task.member)).altered(&arm.mechanisms, wall)
}

fn solved(study: &Study, task: Task, generated: &Generated) -> Row {
    let wall = &generated.wall;
    let run = solve(study, task, wall, Witness::NOBODY);
    let last = run.steps.last();
    let gauge = &study.arms[task.arm as usize].mechanisms;
    // The first reading is the zero reading.
    let read = |step: usize, x: f64| if step == 0 { finite(x) } else { finite(gauge.reading(x)) };
    let at_rest = run.outcome == Outcome::Equilibrium;
    let load_steps = run.steps.iter().enumerate().map(|(number, step)| StepRow {
        load_factor: matches!(step.level, Level::Factor(_)).then(|| step.level.value()),
        tilt_deg: tilt(step.level),
        drift_percent: drift(step.level).and_then(finite),
        force_n: step.push.and_then(finite),
        top_displacement_m: read(number, step.top_displacement),
        left_m: step.points.and_then(|[left, ..]| read(number, left)),
        centre_m: step.points.and_then(|[_, centre, _]| read(number, centre)),
        right_m: step.points.and_then(|[.., right]| read(number, right)),
        left_remainder_m: step.remainders.and_then(|[left, ..]| read(number, left)),
        centre_remainder_m: step.remainders.and_then(|[_, centre, _]| read(number, centre)),
        right_remainder_m: step.remainders.and_then(|[.., right]| read(number, right)),
        unbalanced_ratio: finite(step.unbalanced_ratio),
        solver_steps: step.solver_steps,
        shaken: None,
    });
    Row {
        top_displacement_m: last
            .filter(|_| at_rest)
            .and_then(|step| read(run.steps.len() - 1, step.top_displacement)),
        collapse_angle_deg: match run.outcome {
            Outcome::Collapsed { at } => tilt(at),
            _ => None,
        },
        fails_at_deg: run
            .bracket
            .filter(|_| last.is_some_and(|s| tilt(s.level).is_some()))
            .map(|[_, at]| degrees(at)),
        first_stone_deg: run.events.first_stone.and_then(tilt),
        part_deg: run.events.part.and_then(tilt),
        most_deg: run.events.most.and_then(tilt),
        largest_tilt_deg: match run.outcome {
            Outcome::Equilibrium => last.and_then(|step| tilt(step.level)),
            _ => run.steps.iter().rev().nth(1).and_then(|step| tilt(step.level)),
        },
        limit: match study.solver {
            Solver::Limit(settings) => {
                let protocol = study.as_drawn(task.arm, task.member).protocol;
                by_itself(&run, push_over_load(&protocol, &run), settings.flow)
            }
            _ => study.agreement.then(|| limit(study, task, wall, &run)),
        },
        mechanism: run.failure.as_ref().map(|failure| Mechanism {
            mode: failure.mode,
            moving: failure.moving.len() as u32,
            weight_share: failure.weight_share,
            hinge_height_m: failure.hinge_height,
            turning_share: failure.turning_share,
            length_share: failure.length_share,
            place: failure.place,
        }),
        shear: run.shear.map(|shear| ShearRow {
            capacity_n: finite(shear.capacity),
            drift_at_capacity_percent: shear.mode.and_then(|_| finite(100.0 * shear.drift_at_capacity)),
            plateau_n: shear.plateau.and_then(finite),
            stiffness_n_per_m: shear.stiffness.and_then(finite),
            mode: shear.mode,
            opening_m: shear.opening.and_then(finite),
        }),
        undecided: undecided(study, task, &run),
        joints: run.joints as u32,
        solver_steps: run.steps.iter().map(|step| step.solver_steps).sum(),
        unbalanced_ratio: last.and_then(|step| finite(step.unbalanced_ratio)),
        load_steps: load_steps.collect(),
        ..built(study, task, generated, run.outcome)
    }
}

/// A row that says what was built and how it ended, with nothing observed.
pub(super) fn built(study: &Study, task: Task, generated: &Generated, outcome: Outcome) -> Row {
    let realised = &generated.realised;
    Row {
        stones: generated.wall.stones().count() as u32,
        wedges: realised.wedges,
        headers: realised.headers,
        attempts: generated.attempts,
        redraws: generated.redraws,
        merges: generated.merges,
        dip_mean_deg: stats::mean(&realised.dips).map(degrees),
        dip_sd_deg: stats::sigma(&realised.dips).map(degrees),
        first_dip_sd_deg: stats::sigma(&realised.first_dips).map(degrees),
        length_mean_m: stats::mean(&realised.lengths),
        height_mean_m: stats::mean(&realised.heights),
        weight_n: Some(weight(&generated.wall)),
        ..unsolved(study, task, outcome)
    }
}

/// A row that says which member it is and how it ended, with nothing observed.
fn unsolved(study: &Study, task: Task, outcome: Outcome) -> Row {
    let arm = &study.arms[task.arm as usize];
    Row {
        arm_index: task.arm,
        arm: arm.name.clone(),
        point: task.point,
        kn_pa_per_m: arm.kn_points[task.point as usize],
        member: task.member,
        drawn: study.as_drawn(task.arm, task.member).values,
        outcome,
        top_displacement_m: None,
        collapse_angle_deg: None,
        fails_at_deg: None,
        first_stone_deg: None,
        part_deg: None,
        most_deg: None,
        largest_tilt_deg: None,
        limit: None,
        mechanism: None,
        undecided: None,
        shear: None,
        stones: 0,
        joints: 0,
        wedges: 0,
        headers: 0,
        attempts: 0,
        redraws: 0,
        merges: 0,
        dip_mean_deg: None,
        dip_sd_deg: None,
        first_dip_sd_deg: None,
        length_mean_m: None,
        height_mean_m: None,
        weight_n: None,
        solver_steps: 0,
        unbalanced_ratio: None,
        load_steps: Vec::new(),
    }
}

/// What rigid blocks leave open of a wall's value, in its unit.
fn undecided(study: &Study, task: Task, run: &protocol::Run) -> Option<UndecidedRow> {
    let own = run.undecided.as_ref()?;
    let vertical = match study.as_drawn(task.arm, task.member).protocol {
        Protocol::Shear(shear) => Some(shear.vertical_load),
        _ => None,
    };
    let tilts = run.steps.first().is_some_and(|step| tilt(step.level).is_some());
    Some(UndecidedRow {
        stiff_angle_deg: tilts.then(|| degrees(own.lower)),
        stiff_multiplier: (!tilts).then_some(own.lower),
        stiff_capacity_n: vertical.map(|load| own.lower * load),
        thrust_needed_n: own.needed,
        thrust_at_rest_n: own.at_rest,
        why: own.reason(),
    })
}

/// Weight of the stones (N), added in the order of their ids.
pub fn weight(wall: &Wall) -> f64 {
    wall.stones().map(|(_, stone)| stone.density * stone.shape.volume()).fold(0.0, |sum, mass| sum + mass)
        * STANDARD_GRAVITY
}

/// Limit analysis of a member's wall, with the same joints.
fn limit(study: &Study, task: Task, wall: &Wall, run: &protocol::Run) -> LimitAnalysis {
    let drawn = study.as_drawn(task.arm, task.member);
    let AsDrawn { arm, protocol, .. } = &drawn;
    let laws = laws(study, task, arm, wall);
    let contacts = arm.contacts();
    let bounds = Bounds::of(wall, &laws, protocol, &arm.restraint, contacts);
    let pushed = push_over_load(protocol, run);
    let borne = match run.outcome {
        _ if pushed.is_some() => pushed,
        Outcome::Collapsed { at } => Some(at.value()),
        _ => run.steps.last().map(|step| step.level.value()),
    };
    let tolerance = run.bracket.map_or(0.0, |[low, high]| high - low);
    let agreement = bounds.agreement(&run.outcome, borne, tolerance);
    let tilts = run.steps.first().is_some_and(|step| tilt(step.level).is_some());
    let angle = |x: Option<f64>| x.filter(|_| tilts).map(degrees);
    let factor = |x: Option<f64>| x.filter(|_| !tilts);
    let collapsed = pushed.is_some() || matches!(run.outcome, Outcome::Collapsed { .. });
    LimitAnalysis {
        angle_deg: angle(bounds.associative),
        non_associative_angle_deg: angle(bounds.non_associative),
        multiplier: factor(bounds.associative),
        non_associative_multiplier: factor(bounds.non_associative),
        agreement,
        ratio: borne.filter(|_| collapsed).zip(bounds.associative).map(|(borne, bound)| borne / bound),
    }
}

/// The largest push on a sheared wall over its vertical load; `None` of others.
fn push_over_load(protocol: &Protocol, run: &protocol::Run) -> Option<f64> {
    let Protocol::Shear(shear) = protocol else { return None };
    run.shear.map(|read| read.capacity / shear.vertical_load)
}

/// What limit analysis found as a study's own solver, in its own columns: a factor above 1 stands nowhere else. A wall that is
/// sheared bears its push as a factor on the vertical load.
fn by_itself(run: &protocol::Run, pushed: Option<f64>, flow: Flow) -> Option<LimitAnalysis> {
    let borne = run.steps.get(1)?.level;
    let found = match run.outcome {
        Outcome::Collapsed { .. } => true,
        // More than the full load is a capacity; the end of a tilt is not.
        Outcome::Equilibrium => matches!(borne, Level::Factor(factor) if factor > 1.0),
        _ => false,
    };
    let of = |own: Flow, x: Option<f64>| x.filter(|_| found && own == flow);
    let factor = pushed.or_else(|| matches!(borne, Level::Factor(_)).then(|| borne.value()));
    Some(LimitAnalysis {
        angle_deg: of(Flow::Associative, tilt(borne)),
        non_associative_angle_deg: of(Flow::NonAssociative, tilt(borne)),
        multiplier: of(Flow::Associative, factor),
        non_associative_multiplier: of(Flow::NonAssociative, factor),
        agreement: Agreement::WithinBound,
        ratio: None,
    })
}

/// A tilt (deg), if the level is one.
fn tilt(level: Level) -> Option<f64> {
    if let Level::Tilt(tilt) = level { Some(degrees(tilt)) } else { None }
}

/// A drift (%), if the level is one.
fn drift(level: Level) -> Option<f64> {
    if let Level::Drift(drift) = level { Some(100.0 * drift) } else { None }
}

/// A value that a table can hold: NaN and infinity are "not observed".
pub(super) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
