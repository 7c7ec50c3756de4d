//! What is asked of a wall on ground that moves: the records, the solver, and what is asked in vain.

use std::path::Path;

use crate::math::radians;
use crate::motion::Motion;
use crate::protocol::{InTime, Lean, Task};
use crate::solve::explicit::Rayleigh;
use crate::solve::nonsmooth::Normal;
use crate::solve::{explicit, nonsmooth};
use crate::terminal::failure::Failure;
use crate::verb::analyse::ask::{Analyse, LoadName};
use crate::verb::analyse::unsure::asked;
use crate::verb::arguments::SolverName;

/// What is asked in vain of a record, or of a base motion.
pub(crate) fn refused(asked_for: &Analyse) -> Result<(), Failure> {
    let usage = |words: &str| Err(Failure::Usage(words.to_owned()));
    if asked_for.load != LoadName::BaseMotion {
        return match asked_for.records.is_empty() {
            false => usage("--record is for --load base-motion: ask for that load, or leave --record out"),
            true => Ok(()),
        };
    }
    if asked_for.records.is_empty() {
        return usage(
            "--load base-motion needs --record FILE: PEER .AT2, ESM, ITACA or K-NET ASCII, COSMOS or CSMIP V2, or CSV with units in its heads",
        );
    }
    if asked_for.demanded.demand.is_some() {
        return usage(
            "--demand is for a tilt or a push: a record is a demand by itself; ask for it at a --scale, or leave --demand out",
        );
    }
    match asked_for.solver() {
        SolverName::Limit | SolverName::Implicit => {
            return usage(
                "--load base-motion is for solvers that know time: ask --solver nonsmooth, or --solver explicit --kn PA_PER_M",
            );
        }
        SolverName::Nonsmooth if asked_for.rayleigh.is_some() => {
            return usage(
                "--rayleigh is for --solver explicit: in contact dynamics impacts and friction take the energy; leave it out",
            );
        }
        SolverName::Explicit if asked_for.time_step.is_some() => {
            return usage(
                "--time-step is for --solver nonsmooth: the explicit solver finds its own; leave it out",
            );
        }
        SolverName::Explicit if asked_for.restitution.is_some() => {
            return usage(
                "--restitution is for --solver nonsmooth: elastic joints give back what --rayleigh does not take; leave it out",
            );
        }
        SolverName::Nonsmooth | SolverName::Explicit => {}
    }
    let in_vain = [
        ("--worst-direction", asked_for.worst_direction),
        ("--vertical", asked_for.vertical.is_some()),
        ("--settle", !asked_for.settlements.is_empty()),
        ("--flow", asked_for.flow.is_some()),
        ("--step-deg", asked_for.step_deg.is_some()),
        ("--fclib", asked_for.fclib.is_some()),
    ];
    if let Some((name, _)) = in_vain.iter().find(|(_, is_asked)| *is_asked) {
        return usage(&format!("{name} is not for --load base-motion; leave it out"));
    }
    if let Some(range) = asked(asked_for).first() {
        return usage(&format!(
            "{} takes one number with --load base-motion, no range and no distribution",
            range.word
        ));
    }
    if asked_for.report
        && asked_for.out.is_none()
        && asked_for.records.len() * asked_for.scales.len().max(1) > 1
    {
        return usage(
            "--report is for one record at one scale: ask --out DIR, which has a folder with its page for each, or leave it out",
        );
    }
    Ok(())
}

/// A record as asked for: its y axis, or its only component, towards the direction.
pub(crate) fn motion(asked: &Analyse, path: &Path) -> Result<Motion, Failure> {
    let read = Motion::read(path).map_err(|fault| Failure::Input(fault.to_string()))?;
    if !read.is_horizontal() {
        return Err(Failure::Input(format!(
            "{}: moves the ground up and down alone; allowed is a record with a horizontal component; take one of those, or all in one CSV file",
            path.display()
        )));
    }
    read.towards(&asked.direction.unit()).map_err(|fault| Failure::Input(fault.to_string()))
}

/// The solver as asked for.
pub(crate) fn solver(asked: &Analyse, task: &Task<'_>) -> InTime {
    if asked.solver() == SolverName::Explicit {
        let rayleigh = asked.rayleigh.unwrap_or_else(|| Rayleigh::of_joints(&task.assembled()));
        return InTime::Explicit(explicit::Settings::default(), rayleigh);
    }
    let usual = nonsmooth::Settings::default();
    let time_step = asked.time_step.unwrap_or(usual.time_step);
    let parts = |restitution| Normal::Velocity { restitution };
    let normal = asked.restitution.filter(|own| *own > 0.0).map_or(usual.normal, parts);
    InTime::Nonsmooth(nonsmooth::Settings { time_step, normal, ..usual })
}

/// The lean of the ground as asked for.
pub(crate) fn lean(asked: &Analyse) -> Lean {
    let towards = asked.lean_direction.unwrap_or(asked.direction);
    asked.lean_deg.map_or(Lean::NONE, |deg| Lean { towards, angle: radians(deg) })
}
