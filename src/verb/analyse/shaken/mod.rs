//! A wall from elsewhere on ground that moves as records say.

mod asked;
mod files;
mod many;
mod one;

pub(crate) use asked::refused;

use std::path::Path;
use std::time::Instant;

use rayon::prelude::*;

use crate::exchange::WallFile;
use crate::law::Coulomb;
use crate::math::degrees;
use crate::model::Replay;
use crate::motion::Motion;
use crate::protocol::{Recorder, Rested, Shaken, Shaking, Witness};
use crate::study::Fit;
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::verb::analyse::ask::Analyse;
use crate::verb::analyse::solve::task;
use crate::verb::wall::one_wall::MOST_STATES;

/// A wall under one record at one scale.
struct Ran {
    /// The record, turned and scaled.
    motion: Motion,
    scale: f64,
    seen: Shaken,
    /// The run from a start that differs by next to nothing, if it was asked for.
    twin: Option<Shaken>,
    /// The states that it went through; none where nothing is written.
    replay: Replay,
}

/// What all runs have in common.
struct Common<'c> {
    asked: &'c Analyse,
    file: &'c WallFile,
    fit: &'c Fit,
}

impl Common<'_> {
    fn name(&self, block: usize) -> &str {
        self.file.names.get(block).map_or("", String::as_str)
    }
}

/// Shakes a wall from a file.
pub(crate) fn shaken(
    asked: &Analyse,
    file: &WallFile,
    (law, fit): (&Coulomb, &Fit),
    mut warnings: Vec<String>,
    begun: Instant,
) -> Result<Answer, Failure> {
    let mut motions = Vec::new();
    for record in &asked.records {
        let motion = asked::motion(asked, record)?;
        warnings.extend(motion.notes.iter().cloned());
        let scales = if asked.scales.is_empty() { &[1.0][..] } else { &asked.scales };
        motions.extend(scales.iter().map(|scale| (motion.scaled(*scale), *scale)));
    }
    let task = task(asked, (&file.wall, &[]), law, fit);
    let is_seen = asked.out.is_some() || asked.report;
    let runs = doing(&what(asked, file, &motions), |doing| {
        let rested = Rested::of(&task, asked::lean(asked), asked::solver(asked, &task));
        let one = motions.len() == 1;
        let run = |(motion, scale): (Motion, f64)| {
            let recorder = is_seen.then(|| Recorder::new(MOST_STATES));
            let witness = Witness {
                tell: &|level| {
                    if one {
                        doing.at(level)
                    }
                },
                recorder: recorder.as_ref(),
            };
            let shaking = Shaking::new(motion);
            let (seen, twin) = match asked.once {
                true => (rested.shaken_seen_by(&shaking, witness), None),
                false => {
                    let [seen, twin] = rested.shaken_twice_seen_by(&shaking, witness);
                    (seen, Some(twin))
                }
            };
            let replay = recorder.map(|own| own.replay(file.wall.blocks.len())).unwrap_or_default();
            Ran { motion: shaking.motion, scale, seen, twin, replay }
        };
        motions.into_par_iter().with_max_len(1).map(run).collect::<Vec<Ran>>()
    });
    let unsolved = runs.iter().map(|run| run.seen.unsolved_steps).sum::<u64>();
    if unsolved > 0 {
        let steps = runs.iter().map(|run| run.seen.steps).sum::<u64>();
        warnings.push(format!(
            "{unsolved} of {steps} steps were not solved to the tolerance: a shorter --time-step may be"
        ));
    }
    // It begins at the same rest under every motion.
    if let Some(settled) = runs.first().and_then(|run| run.seen.settled) {
        warnings.push(format!(
            "not in balance as built: until it rests {} turns by {:.2} deg and goes {:.1} mm; the wall is shaken from there",
            file.names.get(settled.block).map_or("", String::as_str),
            degrees(settled.rotation_rad),
            1000.0 * settled.displacement_m
        ));
    }
    let of = Common { asked, file, fit };
    let seconds = begun.elapsed().as_secs_f64();
    let (mut text, object) = match &runs[..] {
        [run] => (one::text(&of, run, seconds), one::object(&of, run, &warnings, seconds)),
        runs => (many::text(&of, runs, seconds), many::object(&of, runs, &warnings, seconds)),
    };
    let page = asked.page_alone();
    if let Some(folder) = &asked.out {
        match &runs[..] {
            [run] => files::write(folder, &of, run, (&object, &text), &warnings)?,
            runs => many::write(folder, &of, runs, (&object, seconds), &warnings)?,
        }
    } else if let (Some(page), [run]) = (&page, &runs[..]) {
        files::write_page(page, &of, run, &text, &warnings)?;
    }
    let Some(place) = asked.out.as_deref().or(page.as_deref()) else {
        return Ok(Answer::of(text, &object)?.with_warnings(warnings));
    };
    text += &format!("written to {}\n", Path::display(place));
    Ok(Answer::of(text, &object)?.in_place(place).with_warnings(warnings))
}

/// What is being done, for whoever waits.
fn what(asked: &Analyse, file: &WallFile, motions: &[(Motion, f64)]) -> String {
    let blocks = file.wall.blocks.len();
    let times = if asked.once { "once" } else { "twice" };
    match motions {
        [(motion, _)] => format!("shaking {blocks} blocks for {:.1} s, {times}", motion.duration()),
        _ => format!("shaking {blocks} blocks {} times, each {times}", motions.len()),
    }
}
