//! The columns of walls that are shaken.

use super::{Column, Members, Step, Steps, count, real, text};
use crate::ensemble::{Row, ShakenRow};
use crate::stats::fragility::Outcome;

/// Runs of a wall that ended so.
fn runs(row: &Row, ended: Option<Outcome>) -> u64 {
    row.runs().filter(|run| run.collapse == ended).count() as u64
}

/// Of the table of members.
pub(super) fn members() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        count("runs", "records times intensities that the wall met", |r: R| r.runs().count() as u64),
        count("runs_collapsed", "those under which it collapsed (load.capacity)", |r: R| {
            runs(r, Some(Outcome::Collapsed))
        }),
        count("runs_undecided", "those that a start 1e-9 m/s off rest decides otherwise", |r: R| {
            runs(r, Some(Outcome::Undecided))
        }),
        count("runs_without_verdict", "those that the solver did not follow to an end", |r: R| runs(r, None)),
    ]
}

/// Of the table of load steps.
pub(super) fn steps() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        real("record", "", "number of the record, from 0", |s: S| of(s, |run| run.record.into())),
        real("pga_m_per_s2", "m/s2", "peak ground acceleration", |s: S| of(s, |run| run.pga_m_per_s2)),
        real("pgv_m_per_s", "m/s", "peak ground velocity", |s: S| of(s, |run| run.pgv_m_per_s)),
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
        real("fallen", "", "number of stones that fell", |s: S| of(s, |run| run.fallen.into())),
        real(
            "displacement_m",
            "m",
            "largest displacement against the base of a stone that had not fallen",
            |s: S| of(s, |run| run.displacement_m),
        ),
        real("rotation_rad", "rad", "largest rotation of one", |s: S| of(s, |run| run.rotation_rad)),
        real("uplift_m", "m", "widest opening of a joint", |s: S| of(s, |run| run.uplift_m)),
        real("slip_m", "m", "largest slip in a joint", |s: S| of(s, |run| run.slip_m)),
        real(
            "residual_m",
            "m",
            "largest displacement left at the end; none of a wall that collapsed",
            |s: S| maybe(s, |run| run.residual_m),
        ),
        real("residual_rad", "rad", "largest rotation left at the end", |s: S| {
            maybe(s, |run| run.residual_rad)
        }),
        real("time_s", "s", "how long the wall was followed", |s: S| of(s, |run| run.time_s)),
        real("unsolved_steps", "", "time steps that were not solved to the tolerance", |s: S| {
            of(s, |run| run.unsolved_steps as f64)
        }),
    ]
}

fn of(step: Step<'_>, value: impl Fn(&ShakenRow) -> f64) -> Option<f64> {
    step.step.shaken.as_ref().map(value)
}

fn maybe(step: Step<'_>, value: impl Fn(&ShakenRow) -> Option<f64>) -> Option<f64> {
    step.step.shaken.as_ref().and_then(value)
}

/// The name of a variant, as files have it.
fn word(value: &impl serde::Serialize) -> Option<String> {
    serde_json::to_value(value).ok()?.as_str().map(str::to_owned)
}
