//! Rare probabilities for `pirca capacity`, where a study's walls are too few to tell: subset simulation, from limit analysis of the same
//! walls where that says enough of them.

mod repeats;
mod screen;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::cli::failure::Failure;
use crate::cli::output;
use crate::cli::rare::repeats::repeated;
use crate::cli::rare::screen::{Pilot, limit_study, pilot};
use crate::ensemble::{Draws, RareWalls, Row, replace_file};
use crate::report::{CapacityGroup, CapacitySummary, Question};
use crate::study::Study;

/// Name of the table of all walls that were drawn for rare values.
const EVALUATIONS: &str = "evaluations.parquet";
/// So many walls on the worse side of a level tell its probability by themselves.
const TELLING: f64 = 10.0;
/// Fewer independent runs say nothing of the error.
const FEWEST: usize = 3;

/// How much may be spent on each arm, and what for.
#[derive(Clone, Copy)]
pub(super) struct Aim {
    /// Most walls that are taken to the study's solver.
    pub budget: u64,
    /// The coefficient of variation at which the probability is known well enough; without one all is spent on ten runs.
    pub cov: Option<f64>,
}

/// Answers by subset simulation what the walls of a random arm do not tell; the rows are those of these walls.
pub(super) fn ask(
    study: &Study,
    rows: &[Row],
    summary: &mut CapacitySummary,
    aim: Aim,
    out: &Path,
) -> Result<(), Failure> {
    let (level, is_high) = match summary.question {
        Question::Below(level) => (level, false),
        Question::Above(level) => (level, true),
        Question::Quantile(_) => return Ok(()),
    };
    let places = study
        .arms
        .iter()
        .enumerate()
        .flat_map(|(arm, own)| (0..own.kn_points.len()).map(move |point| (arm as u32, point as u32)));
    let draws = Draws::open(out, study)?;
    let by_limit = limit_study(study);
    let limit_draws = by_limit.as_ref().map(|limit| Draws::of_limit_analysis(out, limit)).transpose()?;
    for ((arm, point), group) in places.zip(&mut summary.groups) {
        if !group.random {
            continue;
        }
        if !tells(group, aim) {
            let done = AtomicUsize::new(0);
            let tell = |more: usize| {
                let before = done.fetch_add(more, Ordering::Relaxed);
                if (before + more) / 500 > before / 500 {
                    output::note(&format!(
                        "{}: {} walls evaluated for rare values",
                        group.name,
                        before + more
                    ));
                }
            };
            let walls = RareWalls { study, arm, point, is_high, draws: &draws, tell: &tell };
            let level = walls.signed(level);
            let quietly = |_: usize| {};
            let screen = by_limit.as_ref().zip(limit_draws.as_ref()).map(|(study, draws)| RareWalls {
                study,
                draws,
                tell: &quietly,
                ..walls
            });
            let pilot = screen.as_ref().and_then(|screen| pilot(screen, rows, level));
            if let Some(Pilot { rho, walls, pays, .. }) = pilot {
                let verdict = if pays { "runs begin with it" } else { "it says too little to begin with" };
                output::note(&format!(
                    "{}: limit analysis of {walls} walls has a correlation of {rho:.2} with their values: {verdict}",
                    group.name
                ));
            }
            let screened = screen.as_ref().zip(pilot.filter(|pilot| pilot.pays));
            let repeats = repeated(&walls, screened, level, aim, &group.name);
            if let Some(fault) = draws.fault().or_else(|| limit_draws.as_ref()?.fault()) {
                return Err(fault.into());
            }
            if repeats.probabilities.len() >= FEWEST {
                group.by_subset(repeats, study.solver.name(), is_high);
            } else {
                output::note(&format!(
                    "{}: {} walls do not suffice for {FEWEST} runs; what they began is kept, give --walls more",
                    group.name, aim.budget
                ));
            }
        }
        if let Some(cov) = aim.cov {
            group.aim(cov);
        }
    }
    replace_file(&out.join(EVALUATIONS), &draws.table(is_high)?)?;
    Ok(())
}

/// Whether enough walls are on the worse side.
fn tells(group: &CapacityGroup, aim: Aim) -> bool {
    let told = group.walls - group.failed.walls;
    let many = group.answer.value().is_some_and(|share| share * told as f64 >= TELLING);
    many && aim.cov.is_none_or(|cov| group.cov.is_some_and(|own| own <= cov))
}
