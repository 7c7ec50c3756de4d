//! Rare probabilities for `pirca capacity`: subset simulation where a study's walls are too few to tell.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::cli::failure::Failure;
use crate::cli::output;
use crate::ensemble::{DRAWS, Draw, RareDraws, RareWalls};
use crate::report::{CapacityGroup, CapacitySummary, Question, Repeats};
use crate::stats::subset::{Run, Settings, run};
use crate::stats::{mean, sigma};
use crate::study::Study;

/// So many walls on the worse side of a level tell its probability by themselves.
const TELLING: f64 = 10.0;
/// Independent runs whose differences are the error.
const REPEATS: usize = 10;
/// Fewer say nothing of it.
const FEWEST: usize = 3;
/// Points of a level, fewest and most.
const POINTS: [usize; 2] = [100, 1000];
/// A run of three further levels evaluates so many times its points: nine tenths of each level are new.
const LEVELS: f64 = 1.0 + 3.0 * 0.9;

/// Answers by subset simulation what the walls of a random arm do not tell, with no more than `budget` walls in each.
pub(super) fn ask(
    study: &Study,
    summary: &mut CapacitySummary,
    budget: u64,
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
    let draws = RareDraws::open(out, DRAWS, &study.hash)?;
    for ((arm, point), group) in places.zip(&mut summary.groups) {
        if !group.random || tells(group) {
            continue;
        }
        let done = AtomicUsize::new(0);
        let tell = |more: usize| {
            let before = done.fetch_add(more, Ordering::Relaxed);
            if (before + more) / 500 > before / 500 {
                output::note(&format!("{}: {} walls evaluated for rare values", group.name, before + more));
            }
        };
        let walls = RareWalls { study, arm, point, is_high, draws: &draws, tell: &tell };
        let repeats = repeated(&walls, walls.signed(level), budget as usize);
        if let Some(fault) = draws.fault() {
            return Err(fault.into());
        }
        if repeats.probabilities.len() >= FEWEST {
            group.by_subset(repeats, is_high);
        } else {
            output::note(&format!(
                "{}: {budget} walls do not suffice for {FEWEST} runs; what they began is kept, give --walls more",
                group.name
            ));
        }
    }
    Ok(())
}

/// Whether enough walls are on the worse side.
fn tells(group: &CapacityGroup) -> bool {
    let told = group.walls - group.failed.values().sum::<u64>();
    group.answer.is_some_and(|share| share * told as f64 >= TELLING)
}

/// Independent runs, as many as the budget has room for.
fn repeated(walls: &RareWalls<'_>, level: f64, budget: usize) -> Repeats {
    let points = (budget as f64 / (REPEATS as f64 * LEVELS)) as usize / 10 * 10;
    let settings = Settings { points: points.clamp(POINTS[0], POINTS[1]), ..Settings::default() };
    let mut runs: Vec<Run<Draw>> = Vec::new();
    let used = |runs: &[Run<Draw>]| runs.iter().map(|run| run.values).sum::<usize>();
    while runs.len() < REPEATS {
        let next = runs.iter().map(|run| run.values).max().unwrap_or(settings.points);
        if used(&runs) + next > budget {
            break;
        }
        runs.push(run(walls, level, &settings, runs.len() as u64));
    }
    let probabilities: Vec<f64> = runs.iter().map(|run| run.probability).collect();
    let cov = mean(&probabilities).zip(sigma(&probabilities)).filter(|(mean, _)| *mean > 0.0);
    let lowest = runs.iter().filter_map(|run| run.lowest.clone());
    Repeats {
        cov: cov.map(|(mean, sigma)| sigma / mean / (runs.len() as f64).sqrt()),
        evaluations: used(&runs),
        failed: runs.iter().map(|run| run.failed).sum(),
        weakest: lowest.min_by(|a, b| a.1.total_cmp(&b.1)),
        probabilities,
    }
}
