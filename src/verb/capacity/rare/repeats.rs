//! Independent runs of a method, whose differences are the error of their mean.

use crate::ensemble::rare::{Ended, First, Pilot, importance, plain, stratified, subset};
use crate::ensemble::{Draw, RareWalls};
use crate::stats::subset::{Rare, Settings};
use crate::stats::tally::{Pooled, Tally};
use crate::stats::{Looks, effort};
use crate::terminal::output;
use crate::verb::capacity::answer::{Repeats, Screen};
use crate::verb::capacity::rare::method::{Expected, Method};
use crate::verb::capacity::rare::{Aim, FEWEST};

/// Independent runs whose differences are the error.
const REPEATS: u64 = 10;
/// Points of a level of subset simulation, fewest and most. Ten runs of 100 points hold a probability of 1e-5 in 88 of 100 cases only.
const POINTS: [usize; 2] = [200, 1000];
/// Walls of a run of another method, fewest and most.
const WALLS: [usize; 2] = [20, 100_000];
/// Where runs are added until the answer is known well enough, the first ten take this share of the budget at most.
const FIRST_SHARE: f64 = 0.5;
/// Limit analyses for each wall that is solved, fewest and most.
const CHEAP: [f64; 2] = [2.0, 50.0];

/// What a group's walls are evaluated for, and by what.
pub(crate) struct Way<'w, 's> {
    pub walls: &'w RareWalls<'s>,
    pub screen: Option<&'w RareWalls<'s>>,
    pub pilot: &'w Pilot,
    pub expected: Expected,
    pub level: f64,
}

impl Way<'_, '_> {
    /// One run of so many walls: points of a level, in subset simulation.
    fn once(&self, count: usize, number: u64) -> Ended {
        let (walls, level) = (self.walls, self.level);
        match (self.expected.method, self.screen.zip(self.pilot.limit), &self.pilot.parameters) {
            (Method::Stratified, Some((screen, sorted)), _) => {
                let cheap = effort::cheap_per_dear(self.pilot.index, sorted.rho, sorted.cost);
                let all = (count as f64 * cheap.clamp(CHEAP[0], CHEAP[1])) as usize;
                let first = if self.expected.goes_down { First::Down } else { First::Drawn(all) };
                stratified(walls, (screen, sorted, first), level, count, number)
            }
            (Method::Importance, _, Some(leaning)) => {
                let (_, far) = effort::importance(self.pilot.index, leaning.explained);
                importance(walls, (leaning, far), level, count, number)
            }
            (Method::Subset, ..) => {
                let settings = Settings { points: count, ..Settings::default() };
                subset(walls, level, &settings, number)
            }
            _ => plain(walls, level, count, number),
        }
    }

    /// The run of this number. Where its walls are evaluated elsewhere it asks for them, `None`, and so do the runs up to another number
    /// that will be done whatever this one finds; those of subset simulation ask level by level.
    fn begun(&self, count: usize, number: u64, end: u64) -> Option<Ended> {
        let Some(batches) = self.walls.batches else { return Some(self.once(count, number)) };
        let run = batches.deferred(|| self.once(count, number));
        if run.is_none() && self.expected.method != Method::Subset {
            for later in number + 1..end {
                // What it asks for is what counts; it is done again when that is known.
                let _ = batches.deferred(|| self.once(count, later));
            }
        }
        run
    }

    /// Walls of a run: a tenth of what is expected to be enough, and of what the first ten may take.
    fn count(&self, aim: Aim) -> usize {
        let [budget, enough] = match aim.cov {
            Some(cov) => [FIRST_SHARE * aim.budget as f64, self.expected.effort / (cov * cov)],
            None => [aim.budget as f64; 2],
        };
        let own = budget.min(enough) / REPEATS as f64;
        if self.expected.method == Method::Subset {
            let points = own / effort::subset_run(self.pilot.index);
            return (points as usize / 10 * 10).clamp(POINTS[0], POINTS[1]);
        }
        (own.ceil() as usize).clamp(WALLS[0], WALLS[1])
    }
}

/// Independent runs: as many as the budget has room for up to ten, or until the answer is known well enough. `None` where they wait for
/// walls that are evaluated elsewhere.
pub(crate) fn repeated(way: &Way<'_, '_>, aim: Aim, name: &str) -> Option<Repeats> {
    let (budget, count) = (aim.budget as usize, way.count(aim));
    // No run takes fewer walls than its points: there are no more runs than this.
    let most = aim.cov.map_or(REPEATS, |_| (aim.budget / count as u64).max(REPEATS));
    let looks = Looks::between(REPEATS, most);
    // A budget that ends between two looks is one look more.
    let miss = aim.cov.map_or(0.05, |_| 0.05 / (looks.sizes().len() + 1) as f64);
    let mut runs: Vec<Ended> = Vec::new();
    let used = |runs: &[Ended]| runs.iter().map(|run| run.walls).sum::<usize>();
    while (runs.len() as u64) < most {
        let next = runs.iter().map(|run| run.walls).max().unwrap_or(count);
        if used(&runs) + next > budget {
            break;
        }
        let number = runs.len() as u64;
        let room = ((budget - used(&runs)) / next) as u64;
        let look = looks.sizes().iter().copied().find(|size| *size > number).unwrap_or(most);
        runs.push(way.begun(count, number, look.min(number + room))?);
        tell_answer(&runs, miss, used(&runs), name);
        let is_look = looks.sizes().contains(&(runs.len() as u64));
        if is_look
            && aim
                .cov
                .is_some_and(|cov| come_to(&runs, |run| &run.tally, miss).cov.is_some_and(|own| own <= cov))
        {
            break;
        }
    }
    Some(summed_up(way, &runs, miss))
}

fn summed_up(way: &Way<'_, '_>, runs: &[Ended], miss: f64) -> Repeats {
    let Way { walls, level, .. } = way;
    let all = walls.draws.all(walls.arm, walls.point);
    let is_worse = |value: Option<f64>| value.is_some_and(|value| value <= *level);
    let lowest = runs.iter().filter_map(|run| run.lowest.clone()).min_by(|a, b| a.1.total_cmp(&b.1));
    let is_sorted = way.expected.method == Method::Stratified;
    let total = |of: &dyn Fn(&Ended) -> usize| runs.iter().map(of).sum::<usize>();
    let found = come_to(runs, |run| &run.tally, miss);
    let kept = runs.iter().filter_map(|run| run.kept).reduce(f64::max);
    Repeats {
        method: way.expected.method.name(),
        cov: found.cov,
        at_most: found.at_most,
        stuck: kept.map(|_| runs.iter().filter(|run| run.is_stuck()).count()),
        miss,
        found,
        evaluations: total(&|run| run.walls),
        limit_evaluations: total(&|run| run.limits),
        screen: way.screen.zip(way.pilot.limit).filter(|_| is_sorted).map(|(screen, sorted)| {
            let worse: Vec<Draw> =
                all.iter().filter(|own| is_worse(own.value)).map(|own| own.draw.clone()).collect();
            let limits = screen.values(&worse).into_iter().flatten();
            Screen {
                rho: sorted.rho,
                pilot_walls: sorted.walls,
                bound: sorted.bound(),
                goes_down: way.expected.goes_down,
                beyond: [0, 1].map(|k| total(&|run| run.far[k])),
                largest_on_worse_side: limits.max_by(f64::total_cmp),
            }
        }),
        explained: way
            .pilot
            .parameters
            .as_ref()
            .filter(|_| way.expected.method == Method::Importance)
            .map(|own| own.explained),
        kept,
        failed: total(&|run| run.failed),
        if_failed: come_to(runs, |run| &run.if_failed, miss),
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

/// What the tallies of runs come to.
fn come_to(runs: &[Ended], of: impl Fn(&Ended) -> &Tally, miss: f64) -> Pooled {
    Pooled::of(&runs.iter().map(|run| of(run).clone()).collect::<Vec<Tally>>(), miss)
}

/// The answer as it stands after a run.
fn tell_answer(runs: &[Ended], miss: f64, walls: usize, name: &str) {
    let own = come_to(runs, |run| &run.tally, miss);
    let interval = own
        .interval
        .filter(|_| runs.len() >= FEWEST)
        .map(|[low, high]| format!(" [{low:.2e}, {high:.2e}]"))
        .unwrap_or_default();
    output::note(&format!(
        "{name}: run {}, {walls} walls: probability {:.2e}{interval}",
        runs.len(),
        own.probability
    ));
}
