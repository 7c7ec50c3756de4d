//! A wall from elsewhere on ground that moves as a record says.

use std::path::Path;
use std::time::Instant;

use serde_json::{Value, json};

use crate::cli::analyse::arguments::{Analyse, LoadName, MethodName};
use crate::cli::analyse::meetings::Fit;
use crate::cli::analyse::solve::task;
use crate::cli::analyse::unsure::asked;
use crate::cli::answer::Answer;
use crate::cli::doing::doing;
use crate::cli::failure::Failure;
use crate::exchange::WallFile;
use crate::law::Coulomb;
use crate::math::degrees;
use crate::motion::Motion;
use crate::protocol::{Extreme, InTime, Shaken, Shaking, Verdict, shake_twice};
use crate::solve::explicit::{self, Rayleigh};
use crate::solve::nonsmooth;

/// So many blocks that fell are named in words.
const NAMED: usize = 10;

/// What is asked in vain of a record, or of a base motion.
pub(crate) fn refused(asked_for: &Analyse) -> Result<(), Failure> {
    let usage = |words: &str| Err(Failure::Usage(words.to_owned()));
    if asked_for.load != LoadName::BaseMotion {
        return match asked_for.record {
            Some(_) => usage("--record is for --load base-motion: ask for that load, or leave --record out"),
            None => Ok(()),
        };
    }
    if asked_for.record.is_none() {
        return usage(
            "--load base-motion needs --record FILE: PEER .AT2, ESM, ITACA or K-NET ASCII, COSMOS or CSMIP V2, or CSV with units in its heads",
        );
    }
    match asked_for.solver {
        MethodName::Limit | MethodName::Implicit => {
            return usage(
                "--load base-motion is for solvers that know time: ask --solver nonsmooth, or --solver explicit --kn PA_PER_M",
            );
        }
        MethodName::Nonsmooth if asked_for.rayleigh.is_some() => {
            return usage(
                "--rayleigh is for --solver explicit: in contact dynamics impacts and friction take the energy; leave it out",
            );
        }
        MethodName::Explicit if asked_for.time_step.is_some() => {
            return usage(
                "--time-step is for --solver nonsmooth: the explicit solver finds its own; leave it out",
            );
        }
        MethodName::Nonsmooth | MethodName::Explicit => {}
    }
    let in_vain = [
        ("--worst-direction", asked_for.worst_direction),
        ("--vertical", asked_for.vertical.is_some()),
        ("--settle", !asked_for.settlements.is_empty()),
        ("--flow", asked_for.flow.is_some()),
        ("--step-deg", asked_for.step_deg.is_some()),
        ("--fclib", asked_for.fclib.is_some()),
        ("--out", asked_for.out.is_some()),
        ("--report", asked_for.report),
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
    Ok(())
}

/// The record as asked for: its y axis, or its only component, towards the direction.
fn motion(asked: &Analyse, path: &Path) -> Result<Motion, Failure> {
    let read = Motion::read(path).map_err(|fault| Failure::Input(fault.to_string()))?;
    if !read.is_horizontal() {
        return Err(Failure::Input(format!(
            "{}: moves the ground up and down alone; allowed is a record with a horizontal component; take one of those, or all in one CSV file",
            path.display()
        )));
    }
    let turned = read.towards(&asked.direction.unit()).map_err(|fault| Failure::Input(fault.to_string()))?;
    Ok(turned.scaled(asked.scale.unwrap_or(1.0)))
}

/// Shakes a wall from a file.
pub(crate) fn shaken(
    asked: &Analyse,
    record: &Path,
    file: &WallFile,
    (law, fit): (&Coulomb, &Fit),
    mut warnings: Vec<String>,
    begun: Instant,
) -> Result<Answer, Failure> {
    let motion = motion(asked, record)?;
    warnings.extend(motion.notes.iter().cloned());
    let task = task(asked, (&file.wall, &[]), law, fit);
    let solver = match asked.solver {
        MethodName::Explicit => {
            let rayleigh = asked.rayleigh.unwrap_or_else(|| Rayleigh::of_joints(&task.assembled()));
            InTime::Explicit(explicit::Settings::default(), rayleigh)
        }
        _ => {
            let usual = nonsmooth::Settings::default();
            let time_step = asked.time_step.unwrap_or(usual.time_step);
            InTime::Nonsmooth(nonsmooth::Settings { time_step, ..usual })
        }
    };
    let shaking = Shaking::new(motion, solver);
    let what =
        format!("shaking {} blocks for {:.1} s, twice", file.wall.blocks.len(), shaking.motion.duration());
    let [seen, twin] = doing(&what, |_| shake_twice(&task, &shaking));
    let seconds = begun.elapsed().as_secs_f64();
    if seen.unsolved_steps > 0 {
        warnings.push(format!(
            "{} of {} steps were not solved to the tolerance: a shorter --time-step may be",
            seen.unsolved_steps, seen.steps
        ));
    }
    if let Some(settled) = seen.settled {
        warnings.push(format!(
            "not in balance as built: until it rests {} turns by {:.2} deg and goes {:.1} mm; the wall is shaken from there",
            file.names.get(settled.block).map_or("", String::as_str),
            degrees(settled.rotation_rad),
            1000.0 * settled.displacement_m
        ));
    }
    let told = Told { asked, file, fit, motion: &shaking.motion, seen: &seen, twin: &twin };
    Ok(Answer::of(told.text(seconds), &told.object(&warnings, seconds))?.with_warnings(warnings))
}

/// What is told of a wall that was shaken.
struct Told<'t> {
    asked: &'t Analyse,
    file: &'t WallFile,
    fit: &'t Fit,
    motion: &'t Motion,
    seen: &'t Shaken,
    twin: &'t Shaken,
}

impl Told<'_> {
    fn name(&self, block: usize) -> &str {
        self.file.names.get(block).map_or("", String::as_str)
    }

    fn object(&self, warnings: &[String], seconds: f64) -> Value {
        let Told { asked, file, fit, motion, seen, twin } = self;
        let extreme =
            |own: &Extreme| json!({ "value": own.value, "block": self.name(own.block), "at_s": own.at_s });
        let fallen: Vec<Value> =
            seen.fallen.iter().map(|(block, at)| json!({ "block": self.name(*block), "at_s": at })).collect();
        json!({
            "outcome": seen.verdict,
            "twin_outcome": twin.verdict,
            "settled": seen.settled.map(|settled| json!({
                "rotation_rad": settled.rotation_rad,
                "block": self.name(settled.block),
                "displacement_m": settled.displacement_m,
            })),
            "solver": asked.solver.name(),
            "load": asked.load.name(),
            "record": {
                "name": motion.name,
                "scale": asked.scale.unwrap_or(1.0),
                "components": motion.components(),
                "duration_s": motion.duration(),
                "pga_m_per_s2": motion.pga(),
                "pgv_m_per_s": motion.pgv(),
            },
            "direction_deg": asked.direction.angle_deg(),
            "first_stone_s": seen.first_stone_s,
            "tenth_weight_s": seen.part_s,
            "half_weight_s": seen.most_s,
            "fallen": fallen,
            "largest_displacement_m": seen.displacement.value,
            "largest_rotation_rad": seen.rotation.value,
            "largest_uplift_m": seen.uplift.value,
            "largest_slip_m": seen.slip.value,
            "residual_m": seen.residual_m,
            "residual_rad": seen.residual_rad,
            "extremes": {
                "displacement": extreme(&seen.displacement),
                "rotation": extreme(&seen.rotation),
                "uplift": extreme(&seen.uplift),
                "slip": extreme(&seen.slip),
            },
            "energy": seen.energy,
            "time_s": seen.time_s,
            "steps": seen.steps,
            "unsolved_steps": seen.unsolved_steps,
            "left_over_m_per_s": seen.left_over_m_per_s,
            "blocks": file.wall.blocks.len(),
            "joints": fit.joints,
            "seconds": seconds,
            "warnings": warnings,
        })
    }

    fn text(&self, seconds: f64) -> String {
        let Told { asked, file, fit, motion, seen, twin } = self;
        let headline = match seen.verdict {
            Verdict::Stands => "The wall stands: no block falls.".to_owned(),
            Verdict::Damaged => format!("The wall stands damaged: {} blocks fall.", seen.fallen.len()),
            Verdict::Collapsed => format!(
                "The wall falls: half of its weight has fallen after {:.2} s.",
                seen.most_s.unwrap_or_default()
            ),
            Verdict::Undecided => {
                format!("Undecided: the same wall, started 1e-9 m/s off rest, ends {}.", words(twin.verdict))
            }
            Verdict::UnstableAtRest => "The wall does not stand under its own weight.".to_owned(),
            Verdict::NotSolved => "The solver lost the wall on its way; this is no answer.".to_owned(),
        };
        let mut text = format!("{headline}\n  {} solver; record {}", asked.solver.name(), motion.name);
        text += &format!(
            ", PGA {:.2} m/s2, PGV {:.3} m/s, towards {} deg from x+\n",
            motion.pga(),
            motion.pgv(),
            asked.direction.angle_deg()
        );
        if let Some(first) = seen.first_stone_s {
            let names: Vec<&str> =
                seen.fallen.iter().take(NAMED).map(|(block, _)| self.name(*block)).collect();
            let dots = if seen.fallen.len() > NAMED { ", ..." } else { "" };
            text += &format!(
                "  the first block falls after {first:.2} s; in order: {}{dots}\n",
                names.join(", ")
            );
        }
        for (what, own, unit) in [
            ("displacement", &seen.displacement, "m"),
            ("turn", &seen.rotation, "rad"),
            ("opening of a joint", &seen.uplift, "m"),
            ("slip of a joint", &seen.slip, "m"),
        ] {
            if own.value > 0.0 {
                text += &format!(
                    "  largest {what} {:.3e} {unit} ({}, {:.2} s)\n",
                    own.value,
                    self.name(own.block),
                    own.at_s
                );
            }
        }
        if let Some(residual) = seen.residual_m {
            text += &format!(
                "  residual displacement {residual:.3e} m, residual rotation {:.3e} rad\n",
                seen.residual_rad.unwrap_or(0.0)
            );
        }
        text += &format!("  {} blocks, {} joints; {seconds:.1} s\n", file.wall.blocks.len(), fit.joints);
        text
    }
}

/// A verdict in the middle of a sentence.
fn words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stands => "standing",
        Verdict::Damaged => "damaged",
        Verdict::Collapsed => "fallen",
        Verdict::Undecided => "undecided",
        Verdict::UnstableAtRest => "unstable at rest",
        Verdict::NotSolved => "unsolved",
    }
}
