//! Limit analysis of a member: beside a solver's answer, or by itself.

use serde::{Deserialize, Serialize};

use crate::ensemble::design::Task;
use crate::ensemble::evaluate::laws;
use crate::ensemble::field::record;
use crate::ensemble::reading::tilting::tilt;
use crate::math::degrees;
use crate::model::{Level, Outcome, Wall};
use crate::protocol::{self, Agreement, Bounds, Protocol};
use crate::solve::Solver;
use crate::solve::limit::Flow;
use crate::study::{AsDrawn, Study};

record! {
    /// What limit analysis says of a member, and how that goes with the solver's answer; see [`Bounds`]. Angles are those of a tilting
    /// table, multipliers those of other loads.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
    LimitAnalysis {
        angle_deg: Option<f64> =
            "limit_angle_deg", "deg", "tilt of collapse by limit analysis with associative flow, an upper bound";
        non_associative_angle_deg: Option<f64> =
            "limit_angle_non_associative_deg", "deg", "the same without dilatancy, neither a bound nor unique";
        multiplier: Option<f64> = "limit_multiplier", "",
            "factor on the load at collapse by limit analysis with associative flow; in shear the push over the vertical load, of what a wall holds back its height (m)";
        non_associative_multiplier: Option<f64> =
            "limit_multiplier_non_associative", "", "the same without dilatancy";
        agreement: Agreement = "agreement", "",
            "how the solver's answer goes with limit analysis: within_bound, above_bound, one_stands, no_answer";
        ratio: Option<f64> =
            "capacity_over_limit", "", "the solver's capacity over the bound of limit analysis";
    }
}

impl LimitAnalysis {
    /// Of a wall whose base shakes: no answer of a solver is a tilt that it bears.
    pub(super) fn alone(bounds: &Bounds) -> LimitAnalysis {
        LimitAnalysis {
            angle_deg: bounds.associative.map(degrees),
            non_associative_angle_deg: bounds.non_associative.map(degrees),
            multiplier: None,
            non_associative_multiplier: None,
            agreement: Agreement::NoAnswer,
            ratio: None,
        }
    }
}

/// What a row says of it, of a wall that a run was made of.
pub(super) fn limit_analysis(
    study: &Study,
    task: Task,
    wall: &Wall,
    run: &protocol::Run,
) -> Option<LimitAnalysis> {
    match study.solver {
        Solver::Limit(settings) => {
            let protocol = study.as_drawn(task.arm, task.member).protocol;
            by_itself(run, push_over_load(&protocol, run), settings.flow)
        }
        _ => study.agreement.then(|| beside(study, task, wall, run)),
    }
}

/// Limit analysis of a member's wall, with the same joints.
fn beside(study: &Study, task: Task, wall: &Wall, run: &protocol::Run) -> LimitAnalysis {
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
    if matches!(borne, Level::Height(_)) {
        // That has columns of its own.
        return None;
    }
    let falls = match run.outcome {
        Outcome::Collapsed { .. } => true,
        // More than the full load is a capacity; the end of a tilt is not.
        Outcome::Equilibrium => matches!(borne, Level::Factor(factor) if factor > 1.0),
        _ => false,
    };
    let by = |other: Flow, x: Option<f64>| x.filter(|_| falls && other == flow);
    let factor = pushed.or_else(|| matches!(borne, Level::Factor(_)).then(|| borne.value()));
    Some(LimitAnalysis {
        angle_deg: by(Flow::Associative, tilt(borne)),
        non_associative_angle_deg: by(Flow::NonAssociative, tilt(borne)),
        multiplier: by(Flow::Associative, factor),
        non_associative_multiplier: by(Flow::NonAssociative, factor),
        agreement: Agreement::WithinBound,
        ratio: None,
    })
}
