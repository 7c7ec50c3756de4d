//! One independent run of each method.

use crate::ensemble::rare::pilot::{Leaning, Sorted};
use crate::ensemble::rare::{Draw, RareWalls};
use crate::random::Streams;
use crate::stats::importance::{defended, is_shifted, weight};
use crate::stats::strata::{self, STRATA, allocated, chosen, stratum};
use crate::stats::subset::{Rare, Run, Settings, is_stuck, run};
use crate::stats::tally::{Chains, Counts, Strata, Tally, Weighted, Within};

/// Levels below the one asked for that the figure shows of a run.
const SHOWN: usize = 10;
/// The stratum of walls that limit analysis finds nothing of: they may be on either side.
const UNKNOWN: usize = STRATA / 2;

/// What came out of one run.
pub struct Ended {
    pub probability: f64,
    /// What it counted, walls without a value as on the better side; and the same if all of them had been on the worse one.
    pub tally: Tally,
    pub if_failed: Tally,
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
    /// What chains kept of a wall's numbers at most, where there were any.
    pub kept: Option<f64>,
}

impl Ended {
    /// Whether its chains hardly moved.
    pub fn is_stuck(&self) -> bool {
        self.kept.is_some_and(is_stuck)
    }
}

/// Walls as they are drawn, all counting alike.
pub fn plain(walls: &RareWalls<'_>, level: f64, count: usize, number: u64) -> Ended {
    let draws: Vec<Draw> = (0..count as u64).map(|k| walls.drawn(number, k)).collect();
    let values = walls.values(&draws);
    let tally = |worse: &[bool]| Tally::Plain(counts(worse));
    counted(&draws, &values, (|_| 1.0 / count as f64, tally), level)
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
    let defended = defended(count);
    let weight = |at: usize| weight(&draws[at].normals(walls.study, &leaning.parameters), &shift, defended);
    let tally = |worse: &[bool]| {
        Tally::Weighted(Weighted {
            worse: (0..count).filter(|at| worse[*at]).map(weight).collect(),
            of: count as u64,
            largest: 1.0 / defended,
        })
    };
    counted(&draws, &values, (|at| weight(at) / count as f64, tally), level)
}

/// Subset simulation with the study's own solver.
pub fn subset(walls: &RareWalls<'_>, level: f64, settings: &Settings, number: u64) -> Ended {
    let found = run(walls, level, settings, number);
    let (first, all, lost) = (found.first as u64, settings.points as u64, found.lost as u64);
    let of = |probability: f64, worse: u64| {
        Tally::Chains(Chains { probability, first: Counts { worse, of: all }, stuck: is_stuck(found.kept()) })
    };
    Ended {
        probability: found.probability,
        tally: of(found.probability, first),
        if_failed: of((found.probability + lost as f64 / all as f64).min(1.0), first + lost),
        walls: found.values,
        limits: 0,
        failed: found.failed,
        ladder: ladder(&found, level),
        far: [0; 2],
        kept: Some(found.kept()),
        lowest: found.lowest,
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
    let (within, draws, limits, lost, kept) = match first {
        First::Drawn(all) => (None, (0..all as u64).map(|k| walls.drawn(number, k)).collect(), all, 0, None),
        First::Down => {
            let found = run(screen, sorted.bound(), &Settings::default(), number);
            let kept = found.kept();
            (Some(found.probability), found.within, found.values, found.lost, Some(kept))
        }
    };
    let lost_share = lost as f64 / Settings::default().points as f64;
    let found = screen.values(&draws);
    let mut strata: [Vec<usize>; STRATA] = Default::default();
    for (at, limit) in found.iter().enumerate() {
        strata[limit.map_or(UNKNOWN, |limit| stratum(sorted.above(limit)))].push(at);
    }
    let sizes = strata.each_ref().map(Vec::len);
    let taken = allocated(&sizes, count);
    let member = draws.first().map_or(0, |draw| draw.member);
    let mut start = Streams::new(walls.study.seed, member).of("start within a stratum");
    let places: Vec<(usize, usize)> = (0..STRATA)
        .flat_map(|of| {
            let start = start.uniform();
            chosen(&strata[of], taken[of], start).into_iter().map(move |at| (of, at)).collect::<Vec<_>>()
        })
        .collect();
    let solved: Vec<Draw> = places.iter().map(|(_, at)| draws[*at].clone()).collect();
    let values = walls.values(&solved);
    let repeated = solved.len() as f64 / distinct(&solved).max(1) as f64;
    let tally = |worse: &[bool]| {
        let of = |of: usize| {
            let own = places.iter().zip(worse).filter(|((stratum, _), _)| *stratum == of);
            counts(&own.map(|(_, worse)| *worse).collect::<Vec<_>>())
        };
        let strata = Strata { sizes: sizes.map(|size| size as u64), counts: std::array::from_fn(of) };
        match within {
            None => Tally::Strata(strata),
            Some(probability) => {
                let stuck = kept.is_some_and(is_stuck);
                Tally::Within(Within { probability, strata, repeated, more: 0.0, stuck })
            }
        }
    };
    let share = |at: usize| within.unwrap_or(1.0) * strata::counts(&sizes, &taken, places[at].0);
    let far = places.iter().zip(&values).filter(|((of, _), _)| *of == STRATA - 1);
    let far_worse = far.clone().filter(|(_, value)| value.is_some_and(|value| value <= level)).count();
    let far = [far.count(), far_worse];
    let mut own = counted(&solved, &values, (share, tally), level);
    if let Tally::Within(within) = &mut own.if_failed {
        within.more = lost_share;
    }
    Ended { limits, far, kept, failed: own.failed + lost, ..own }
}

/// How many walls differ.
fn distinct(draws: &[Draw]) -> usize {
    draws.iter().enumerate().filter(|(at, draw)| !draws[..*at].contains(draw)).count()
}

fn counts(worse: &[bool]) -> Counts {
    Counts { worse: worse.iter().filter(|worse| **worse).count() as u64, of: worse.len() as u64 }
}

/// What walls that count so much each come to; `tally` is given which of them are on the worse side.
fn counted(
    draws: &[Draw],
    values: &[Option<f64>],
    (share, tally): (impl Fn(usize) -> f64, impl Fn(&[bool]) -> Tally),
    level: f64,
) -> Ended {
    let is_worse = |if_lost: bool| -> Vec<bool> {
        values.iter().map(|value| value.map_or(if_lost, |value| value <= level)).collect()
    };
    let mut worse: Vec<(f64, f64)> = values
        .iter()
        .enumerate()
        .filter_map(|(at, value)| Some((value.filter(|value| *value <= level)?, share(at))))
        .collect();
    worse.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut reached = 0.0;
    let steps: Vec<[f64; 2]> = worse
        .iter()
        .map(|(value, share)| {
            reached += share;
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
        tally: tally(&is_worse(false)),
        if_failed: tally(&is_worse(true)),
        walls: draws.len(),
        limits: 0,
        failed: values.iter().filter(|value| value.is_none()).count(),
        lowest: lowest.map(|(draw, value)| (draw.clone(), value)),
        ladder,
        far: [0; 2],
        kept: None,
    }
}

/// The levels of a run with their probabilities; the level asked for is the last one, if it was reached.
fn ladder(run: &Run<Draw>, level: f64) -> Vec<[f64; 2]> {
    let bounds = run.levels.iter().map(|own| [own.bound, own.probability]);
    let mut ladder: Vec<[f64; 2]> = bounds.filter(|[bound, _]| *bound < 0.1 * f64::MAX).collect();
    ladder.extend((run.probability > 0.0).then_some([level, run.probability]));
    ladder
}
