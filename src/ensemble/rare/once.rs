//! One independent run of each method.

use crate::ensemble::rare::pilot::{Leaning, Sorted};
use crate::ensemble::rare::{Draw, RareWalls};
use crate::random::Streams;
use crate::stats::importance::{is_shifted, weight};
use crate::stats::strata::{self, STRATA, allocated, chosen, stratum};
use crate::stats::subset::{Rare, Run, Settings, run};

/// Levels below the one asked for that the figure shows of a run.
const SHOWN: usize = 10;
/// The stratum of walls that limit analysis finds nothing of: they may be on either side.
const UNKNOWN: usize = STRATA / 2;

/// What came out of one run.
#[derive(Default)]
pub struct Ended {
    pub probability: f64,
    /// The same if all walls without a value had been on the worse side.
    pub if_failed: f64,
    /// Walls that were taken to the study's solver, and analyses of limits.
    pub walls: usize,
    pub limits: usize,
    /// Walls without a value.
    pub failed: usize,
    pub lowest: Option<(Draw, f64)>,
    /// Levels with their probabilities.
    pub ladder: Vec<[f64; 2]>,
    /// Walls that were solved although limit analysis expects them far beyond the level, and how many were on the worse side.
    pub far: [usize; 2],
}

/// Walls as they are drawn, all counting alike.
pub fn plain(walls: &RareWalls<'_>, level: f64, count: usize, number: u64) -> Ended {
    let draws: Vec<Draw> = (0..count as u64).map(|k| walls.drawn(number, k)).collect();
    let values = walls.values(&draws);
    counted(&draws, &values, &|_| 1.0 / count as f64, level)
}

/// Walls with shifted parameters.
pub fn importance(
    walls: &RareWalls<'_>,
    (leaning, far): (&Leaning, f64),
    level: f64,
    count: usize,
    number: u64,
) -> Ended {
    let shift: Vec<f64> = leaning.direction.iter().map(|own| far * own).collect();
    let by = || leaning.parameters.iter().zip(&shift).map(|(own, by)| (own.key.to_owned(), *by)).collect();
    let drawn = |k: u64| {
        let draw = walls.drawn(number, k);
        if is_shifted(k) { Draw { shift: by(), ..draw } } else { draw }
    };
    let draws: Vec<Draw> = (0..count as u64).map(drawn).collect();
    let values = walls.values(&draws);
    let counts =
        |at: usize| weight(&draws[at].normals(walls.study, &leaning.parameters), &shift) / count as f64;
    counted(&draws, &values, &counts, level)
}

/// Subset simulation with the study's own solver.
pub fn subset(walls: &RareWalls<'_>, level: f64, settings: &Settings, number: u64) -> Ended {
    let found = run(walls, level, settings, number);
    Ended {
        probability: found.probability,
        if_failed: (found.probability + found.lost as f64 / settings.points as f64).min(1.0),
        walls: found.values,
        failed: found.failed,
        ladder: ladder(&found, level, settings.share),
        lowest: found.lowest,
        ..Ended::default()
    }
}

/// How a run of stratified sampling gets its walls.
#[derive(Clone, Copy)]
pub enum First {
    /// So many as they are drawn.
    Drawn(usize),
    /// By subset simulation with limit analysis down to its bound.
    Down,
}

/// Walls that are sorted by limit analysis.
pub fn stratified(
    walls: &RareWalls<'_>,
    (screen, sorted, first): (&RareWalls<'_>, Sorted, First),
    level: f64,
    count: usize,
    number: u64,
) -> Ended {
    let (within, draws, limits, lost) = match first {
        First::Drawn(all) => (1.0, (0..all as u64).map(|k| walls.drawn(number, k)).collect(), all, 0),
        First::Down => {
            let found = run(screen, sorted.bound(), &Settings::default(), number);
            (found.probability, found.within, found.values, found.lost)
        }
    };
    let lost_share = lost as f64 / Settings::default().points as f64;
    if draws.is_empty() {
        return Ended { limits, failed: lost, if_failed: lost_share, ..Ended::default() };
    }
    let found = screen.values(&draws);
    let mut strata: [Vec<usize>; STRATA] = Default::default();
    for (at, limit) in found.iter().enumerate() {
        strata[limit.map_or(UNKNOWN, |limit| stratum(sorted.above(limit)))].push(at);
    }
    let sizes = strata.each_ref().map(Vec::len);
    let taken = allocated(&sizes, count);
    let mut start = Streams::new(walls.study.seed, draws[0].member).of("start within a stratum");
    let places: Vec<(usize, usize)> = (0..STRATA)
        .flat_map(|of| {
            let start = start.uniform();
            chosen(&strata[of], taken[of], start).into_iter().map(move |at| (of, at)).collect::<Vec<_>>()
        })
        .collect();
    let solved: Vec<Draw> = places.iter().map(|(_, at)| draws[*at].clone()).collect();
    let values = walls.values(&solved);
    let counts = |at: usize| within * strata::counts(&sizes, &taken, places[at].0);
    let far = places.iter().zip(&values).filter(|((of, _), _)| *of == STRATA - 1);
    let far_worse = far.clone().filter(|(_, value)| value.is_some_and(|value| value <= level)).count();
    let own = counted(&solved, &values, &counts, level);
    Ended {
        limits,
        far: [far.count(), far_worse],
        failed: own.failed + lost,
        if_failed: (own.if_failed + lost_share).min(1.0),
        ..own
    }
}

/// What walls that count so much each come to.
fn counted(draws: &[Draw], values: &[Option<f64>], counts: &dyn Fn(usize) -> f64, level: f64) -> Ended {
    let mut worse: Vec<(f64, f64)> = values
        .iter()
        .enumerate()
        .filter_map(|(at, value)| Some((value.filter(|value| *value <= level)?, counts(at))))
        .collect();
    worse.sort_by(|a, b| a.0.total_cmp(&b.0));
    let lost: f64 =
        values.iter().enumerate().filter(|(_, value)| value.is_none()).map(|(at, _)| counts(at)).sum();
    let mut reached = 0.0;
    let steps: Vec<[f64; 2]> = worse
        .iter()
        .map(|(value, counts)| {
            reached += counts;
            [*value, reached]
        })
        .collect();
    let stride = steps.len().div_ceil(SHOWN).max(1);
    let mut ladder: Vec<[f64; 2]> = steps.iter().rev().skip(stride).step_by(stride).copied().collect();
    if reached > 0.0 {
        ladder.insert(0, [level, reached]);
    }
    ladder.reverse();
    let lowest = draws
        .iter()
        .zip(values)
        .filter_map(|(draw, value)| Some((draw, (*value)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1));
    Ended {
        probability: reached.min(1.0),
        if_failed: (reached + lost).min(1.0),
        walls: draws.len(),
        failed: values.iter().filter(|value| value.is_none()).count(),
        lowest: lowest.map(|(draw, value)| (draw.clone(), value)),
        ladder,
        ..Ended::default()
    }
}

/// The levels of a run with their probabilities; the level asked for is the last one, if it was reached.
fn ladder(run: &Run<Draw>, level: f64, share: f64) -> Vec<[f64; 2]> {
    let mut reached = 1.0;
    let bounds = run.bounds.iter().map(|bound| {
        reached *= share;
        [*bound, reached]
    });
    let mut ladder: Vec<[f64; 2]> = bounds.filter(|[bound, _]| *bound < 0.1 * f64::MAX).collect();
    ladder.extend((run.probability > 0.0).then_some([level, run.probability]));
    ladder
}
