//! What is told of a wall under one record at one scale.

use serde_json::{Value, json};

use crate::protocol::{Extreme, Shaken, Verdict};
use crate::verb::analyse::ask::Analyse;
use crate::verb::analyse::shaken::{Common, Ran};
use crate::verb::arguments::SolverName;

/// So many blocks that fell are named in words.
const NAMED: usize = 10;

/// The answer in a sentence.
pub(crate) fn headline(run: &Ran) -> String {
    let seen = &run.seen;
    match seen.verdict {
        Verdict::Stands => "The wall stands: no block falls.".to_owned(),
        Verdict::Damaged => format!("The wall stands damaged: {}.", fallen(seen)),
        Verdict::Collapsed => format!(
            "The wall falls: half of its weight has fallen after {:.2} s.",
            seen.most_s.unwrap_or_default()
        ),
        Verdict::Undecided => {
            format!(
                "Undecided: the same wall, started 1e-9 m/s off rest, ends {}.",
                run.twin.as_ref().map_or("otherwise", |twin| words(twin.verdict))
            )
        }
        Verdict::UnstableAtRest => "The wall does not stand under its own weight.".to_owned(),
        Verdict::NotSolved => "The solver lost the wall on its way; this is no answer.".to_owned(),
    }
}

/// How many blocks fall.
fn fallen(seen: &Shaken) -> String {
    match seen.fallen.len() {
        1 => "1 block falls".to_owned(),
        many => format!("{many} blocks fall"),
    }
}

/// What is special of the ground and of its joints, as a line.
pub(crate) fn ground(asked: &Analyse) -> String {
    let lean = asked.lean_deg.map(|deg| {
        let towards = asked.lean_direction.unwrap_or(asked.direction).angle_deg();
        format!("the ground leans by {deg} deg towards {towards} deg from x+")
    });
    let restitution = asked.restitution.map(|own| format!("restitution {own}"));
    let said: Vec<String> = lean.into_iter().chain(restitution).collect();
    if said.is_empty() { String::new() } else { format!("  {}\n", said.join("; ")) }
}

pub(crate) fn object(of: &Common<'_>, run: &Ran, warnings: &[String], seconds: f64) -> Value {
    let (Common { asked, file, fit }, Ran { motion, seen, twin, .. }) = (of, run);
    let extreme =
        |own: &Extreme| json!({ "value": own.value, "block": of.name(own.block), "at_s": own.at_s });
    let fallen: Vec<Value> =
        seen.fallen.iter().map(|(block, at)| json!({ "block": of.name(*block), "at_s": at })).collect();
    json!({
        "outcome": seen.verdict,
        "twin_outcome": twin.as_ref().map(|twin| twin.verdict),
        "settled": seen.settled.map(|settled| json!({
            "rotation_rad": settled.rotation_rad,
            "block": of.name(settled.block),
            "displacement_m": settled.displacement_m,
        })),
        "solver": asked.solver().name(),
        "load": asked.load.name(),
        "record": {
            "name": motion.name,
            "scale": run.scale,
            "components": motion.components(),
            "duration_s": motion.duration(),
            "pga_m_per_s2": motion.pga(),
            "pgv_m_per_s": motion.pgv(),
        },
        "direction_deg": asked.direction.angle_deg(),
        "lean_deg": asked.lean_deg.unwrap_or(0.0),
        "lean_direction_deg": asked.lean_deg.map(|_| asked.lean_direction.unwrap_or(asked.direction).angle_deg()),
        "restitution": (asked.solver() == SolverName::Nonsmooth).then(|| asked.restitution.unwrap_or(0.0)),
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

pub(crate) fn text(of: &Common<'_>, run: &Ran, seconds: f64) -> String {
    let (Common { asked, file, fit }, Ran { motion, seen, .. }) = (of, run);
    let mut text = format!("{}\n  {} solver; record {}", headline(run), asked.solver().name(), motion.name);
    text += &format!(
        ", PGA {:.2} m/s2, PGV {:.3} m/s, towards {} deg from x+\n",
        motion.pga(),
        motion.pgv(),
        asked.direction.angle_deg()
    );
    text += &ground(asked);
    if let Some(first) = seen.first_stone_s {
        let names: Vec<&str> = seen.fallen.iter().take(NAMED).map(|(block, _)| of.name(*block)).collect();
        let dots = if seen.fallen.len() > NAMED { ", ..." } else { "" };
        text +=
            &format!("  the first block falls after {first:.2} s; in order: {}{dots}\n", names.join(", "));
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
                of.name(own.block),
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

/// A verdict in the middle of a sentence.
pub(crate) fn words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stands => "standing",
        Verdict::Damaged => "damaged",
        Verdict::Collapsed => "fallen",
        Verdict::Undecided => "undecided",
        Verdict::UnstableAtRest => "unstable at rest",
        Verdict::NotSolved => "unsolved",
    }
}
