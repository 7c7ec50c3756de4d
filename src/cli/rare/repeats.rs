//! Independent runs of subset simulation, whose differences are the error of their mean.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::cli::output;
use crate::cli::rare::screen::Pilot;
use crate::cli::rare::{Aim, FEWEST};
use crate::ensemble::{Draw, RareWalls, ScreenedWalls};
use crate::report::{Repeats, Screen};
use crate::stats::subset::{Rare, Run, Settings, run, run_from};
use crate::stats::{Looks, Statistic, above_zero, mean, sigma};

/// Independent runs whose differences are the error.
const REPEATS: u64 = 10;
/// Points of a level, fewest and most.
const POINTS: [usize; 2] = [100, 1000];
/// The same where a run begins with limit analysis: it has fewer levels to go down.
const SCREENED_POINTS: [usize; 2] = [50, 500];
/// A run of three further levels evaluates so many times its points: nine tenths of each level are new.
const LEVELS: f64 = 1.0 + 3.0 * 0.9;
/// The same of one further level.
const SCREENED_LEVELS: f64 = 1.0 + 0.9;
/// Where runs are added until the answer is known well enough, the first ten take this share of the budget.
const FIRST_SHARE: f64 = 0.3;
/// What is added to the number of a run for its second part, so that the two draw other numbers.
const SECOND: u64 = 1 << 12;

/// What came out of one run.
struct Ended {
    probability: f64,
    /// Walls that were taken to the study's solver, and analyses of limits.
    walls: usize,
    limits: usize,
    /// Without a value, all and of those that were drawn at first.
    failed: usize,
    lost: usize,
    lowest: Option<(Draw, f64)>,
    /// Levels with their probabilities.
    ladder: Vec<[f64; 2]>,
}

/// Independent runs: as many as the budget has room for up to ten, or until the answer is known well enough.
pub(super) fn repeated(
    walls: &RareWalls<'_>,
    screened: Option<(&RareWalls<'_>, Pilot)>,
    level: f64,
    aim: Aim,
    name: &str,
) -> Repeats {
    let (budget, is_screened) = (aim.budget as usize, screened.is_some());
    let (levels, [fewest, largest]) =
        if is_screened { (SCREENED_LEVELS, SCREENED_POINTS) } else { (LEVELS, POINTS) };
    let first = aim.cov.map_or(1.0, |_| FIRST_SHARE) * aim.budget as f64;
    let points = (first / (REPEATS as f64 * levels)) as usize / 10 * 10;
    let settings = Settings { points: points.clamp(fewest, largest), ..Settings::default() };
    // No run takes fewer walls than its points: there are no more runs than this.
    let most = aim.cov.map_or(REPEATS, |_| (aim.budget / settings.points as u64).max(REPEATS));
    let looks = Looks::between(REPEATS, most);
    // A budget that ends between two looks is one look more.
    let miss = aim.cov.map_or(0.05, |_| 0.05 / (looks.sizes().len() + 1) as f64);
    let mut runs: Vec<Ended> = Vec::new();
    let used = |runs: &[Ended]| runs.iter().map(|run| run.walls).sum::<usize>();
    while (runs.len() as u64) < most {
        let next = runs.iter().map(|run| run.walls).max().unwrap_or(settings.points);
        if used(&runs) + next > budget {
            break;
        }
        let number = runs.len() as u64;
        runs.push(match screened {
            Some((screen, pilot)) => from_limit(walls, screen, pilot, level, &settings, number),
            None => alone(walls, level, &settings, number),
        });
        tell_answer(&runs, miss, used(&runs), name);
        let is_look = looks.sizes().contains(&(runs.len() as u64));
        if is_look && aim.cov.is_some_and(|cov| cov_of_mean(&runs).is_some_and(|own| own <= cov)) {
            break;
        }
    }
    let all = walls.draws.all(walls.arm, walls.point);
    let lowest = runs.iter().filter_map(|run| run.lowest.clone()).min_by(|a, b| a.1.total_cmp(&b.1));
    let is_worse = |value: Option<f64>| value.is_some_and(|value| value <= level);
    let drawn = if is_screened { Settings::default().points } else { settings.points };
    Repeats {
        cov: cov_of_mean(&runs),
        miss,
        evaluations: used(&runs),
        limit_evaluations: runs.iter().map(|run| run.limits).sum(),
        screen: screened.map(|(screen, pilot)| {
            let worse: Vec<Draw> =
                all.iter().filter(|own| is_worse(own.value)).map(|own| own.draw.clone()).collect();
            let limits = screen.values(&worse).into_iter().flatten();
            Screen {
                rho: pilot.rho,
                pilot_walls: pilot.walls,
                bound: pilot.bound,
                largest_on_worse_side: limits.max_by(f64::total_cmp),
            }
        }),
        failed: runs.iter().map(|run| run.failed).sum(),
        lost_of_drawn: [runs.iter().map(|run| run.lost).sum(), runs.len() * drawn].map(|n| n as u64),
        weakest_draw: lowest
            .as_ref()
            .and_then(|(draw, _)| all.iter().find(|own| own.draw == *draw))
            .map(|own| own.number),
        first_failed_draw: all.iter().find(|own| is_worse(own.value)).map(|own| own.number),
        weakest: lowest,
        ladders: runs.iter().map(|run| run.ladder.clone()).collect(),
        probabilities: runs.iter().map(|run| run.probability).collect(),
    }
}

/// A run with the study's own solver alone.
fn alone(walls: &RareWalls<'_>, level: f64, settings: &Settings, number: u64) -> Ended {
    let found = run(walls, level, settings, number);
    Ended {
        probability: found.probability,
        walls: found.values,
        limits: 0,
        failed: found.failed,
        lost: found.lost,
        ladder: ladder(&found, level, settings.share, 1.0),
        lowest: found.lowest,
    }
}

/// A run that goes down to the bound by limit analysis, and takes walls from there to the study's own solver. It finds the walls
/// beyond the level that have a limit within the bound.
fn from_limit(
    walls: &RareWalls<'_>,
    screen: &RareWalls<'_>,
    pilot: Pilot,
    level: f64,
    settings: &Settings,
    number: u64,
) -> Ended {
    let first = run(screen, pilot.bound, &Settings::default(), number);
    let mut ended = Ended {
        probability: 0.0,
        walls: 0,
        limits: first.values,
        failed: first.failed,
        lost: first.lost,
        lowest: None,
        ladder: Vec::new(),
    };
    // Points in tens, so that each chain has ten; a stride takes them from all over the event.
    let points = settings.points.min(first.within.len() / 10 * 10);
    if points == 0 {
        return ended;
    }
    let start = (0..points).map(|k| first.within[k * first.within.len() / points].clone()).collect();
    let screened = ScreenedWalls { walls, screen, bound: pilot.bound, taken: AtomicUsize::new(0) };
    let settings = Settings { points, ..*settings };
    let second = run_from(&screened, start, level, &settings, SECOND + number);
    ended.probability = first.probability * second.probability;
    ended.walls = screened.taken.load(Ordering::Relaxed);
    ended.limits += second.values;
    ended.failed += second.failed;
    ended.ladder = ladder(&second, level, settings.share, first.probability);
    ended.lowest = second.lowest.filter(|(_, value)| *value < f64::MAX);
    ended
}

/// The levels of a run with their probabilities, from that of the event that it began in; the level asked for is the last one, if it was
/// reached.
fn ladder(run: &Run<Draw>, level: f64, share: f64, from: f64) -> Vec<[f64; 2]> {
    let mut reached = from;
    let bounds = run.bounds.iter().map(|bound| {
        reached *= share;
        [*bound, reached]
    });
    let mut ladder: Vec<[f64; 2]> = bounds.filter(|[bound, _]| *bound < 0.1 * f64::MAX).collect();
    ladder.extend((run.probability > 0.0).then_some([level, from * run.probability]));
    ladder
}

/// Coefficient of variation of the runs' mean.
fn cov_of_mean(runs: &[Ended]) -> Option<f64> {
    let probabilities: Vec<f64> = runs.iter().map(|run| run.probability).collect();
    let (mean, sigma) = mean(&probabilities).zip(sigma(&probabilities)).filter(|(mean, _)| *mean > 0.0)?;
    Some(sigma / mean / (runs.len() as f64).sqrt())
}

/// The answer as it stands after a run.
fn tell_answer(runs: &[Ended], miss: f64, walls: usize, name: &str) {
    let probabilities: Vec<f64> = runs.iter().map(|run| run.probability).collect();
    let own = above_zero(Statistic::Mean.of(&probabilities, miss));
    let interval =
        own.interval.filter(|_| runs.len() >= FEWEST).map(|[low, high]| format!(" [{low:.2e}, {high:.2e}]"));
    output::note(&format!(
        "{name}: run {}, {walls} walls: probability {:.2e}{}",
        runs.len(),
        own.value.unwrap_or(0.0),
        interval.unwrap_or_default()
    ));
}
