//! Rare probabilities by subset simulation (Au and Beck 2001): a rare event is reached through events that are each likely given the one
//! before.
//!
//! Samples of an event come from Markov chains that start at samples of it and move by conditional sampling (Papaioannou, Betz, Zwirglmaier
//! and Straub 2015): a proposal keeps a share of the old point in every standard normal and stays if its value still belongs to the event.
//! The share adapts so that 44 in 100 proposals stay. What a point is made of is the caller's business, and so is how values are
//! computed: nothing here knows of walls. A run is a pure function of the problem, its settings and its number; its error is seen in
//! independent runs alone, as chains of one run are not independent.

/// What probabilities are asked of.
pub trait Rare {
    /// A point: what a value is computed from.
    type Point: Clone;

    /// The k-th point of a run as it is drawn at first.
    fn drawn(&self, run: u64, k: u64) -> Self::Point;

    /// The point after a move that keeps this share of each standard normal (0 to 1), and takes the rest from draws of its own,
    /// named by the run and the number of the move.
    fn moved(&self, point: &Self::Point, keep: f64, run: u64, number: u64) -> Self::Point;

    /// The values of points, in their order; the event is a low one. `None` where none could be computed.
    fn values(&self, points: &[Self::Point]) -> Vec<Option<f64>>;
}

/// How a run goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Points of each level. Few of them find too much in the mean: behind a plane 100 points find 12 % too much of a probability
    /// of 1e-3 and 23 % of 1e-4, 1000 points 2 and 3 %.
    pub points: usize,
    /// Share of them that makes the next level; its inverse is the length of the chains.
    pub share: f64,
    /// At most so many levels beyond the first.
    pub levels: usize,
    /// The share of a standard normal that the first moves keep.
    pub keep: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { points: 1000, share: 0.1, levels: 12, keep: 0.8 }
    }
}

/// What a run found.
#[derive(Clone, Debug, PartialEq)]
pub struct Run<P> {
    /// Probability of a value at or below the level asked for; 0 where the last level did not come near it.
    pub probability: f64,
    /// The values that bound each level, descending.
    pub bounds: Vec<f64>,
    /// Values that were computed.
    pub values: usize,
    /// Values that could not be. A point without a value is in no event.
    pub failed: usize,
    /// How many of these were of points as they were drawn at first.
    pub lost: usize,
    /// The point of the lowest value, with it.
    pub lowest: Option<(P, f64)>,
    /// The points of the last level with a value at or below the level asked for, by their values; none where it was not reached.
    pub within: Vec<P>,
}

/// Share of proposals that should stay.
const STAYING: f64 = 0.44;

/// One run of subset simulation for a level.
pub fn run<R: Rare>(problem: &R, level: f64, settings: &Settings, number: u64) -> Run<R::Point> {
    let drawn: Vec<R::Point> = (0..settings.points as u64).map(|k| problem.drawn(number, k)).collect();
    let seeds = ((settings.points as f64 * settings.share).round() as usize).max(1);
    let steps = settings.points / seeds;
    crate::check!(steps > 0 && settings.share > 0.0 && settings.share < 1.0, "{settings:?}");
    let mut moves = 0;
    let mut spread = (1.0 - settings.keep * settings.keep).sqrt();
    let mut found = Run {
        probability: 1.0,
        bounds: Vec::new(),
        values: 0,
        failed: 0,
        lost: 0,
        lowest: None,
        within: Vec::new(),
    };
    let mut level_points = found.take(problem, drawn);
    found.lost = found.failed;
    for _ in 0..=settings.levels {
        level_points.sort_by(|a, b| a.1.total_cmp(&b.1));
        let all = settings.points as f64;
        let within = level_points.iter().filter(|(_, value)| *value <= level).count();
        let bound = level_points.get(seeds - 1).map(|(_, value)| *value);
        // Halfway to the next value: no point lies on the bound.
        let bound = bound.zip(level_points.get(seeds).map(|(_, value)| *value)).map(|(a, b)| 0.5 * (a + b));
        let Some(bound) = bound.filter(|bound| *bound > level) else {
            found.probability *= within as f64 / all;
            found.within = level_points.into_iter().take(within).map(|(point, _)| point).collect();
            return found;
        };
        found.probability *= seeds as f64 / all;
        found.bounds.push(bound);
        let mut chains: Vec<(R::Point, f64)> = level_points.into_iter().take(seeds).collect();
        level_points = chains.clone();
        for step in 1..steps {
            let keep = (1.0 - spread * spread).max(0.0).sqrt();
            let proposed: Vec<R::Point> = chains
                .iter()
                .enumerate()
                .map(|(k, (point, _))| problem.moved(point, keep, number, moves + k as u64))
                .collect();
            moves += seeds as u64;
            let mut stayed = 0;
            for (chain, own) in chains.iter_mut().zip(found.computed(problem, proposed)) {
                if let Some(own) = own.filter(|(_, value)| *value <= bound) {
                    *chain = own;
                    stayed += 1;
                }
            }
            let off = stayed as f64 / seeds as f64 - STAYING;
            spread = (spread * crate::math::exp(off / (step as f64).sqrt())).min(1.0);
            level_points.extend(chains.iter().cloned());
        }
    }
    found.probability = 0.0;
    found
}

impl<P: Clone> Run<P> {
    /// Points with their values.
    fn computed<R: Rare<Point = P>>(&mut self, problem: &R, points: Vec<P>) -> Vec<Option<(P, f64)>> {
        let values = problem.values(&points);
        crate::check!(values.len() == points.len(), "{} values of {} points", values.len(), points.len());
        self.values += points.len();
        let all: Vec<Option<(P, f64)>> =
            points.into_iter().zip(values).map(|(point, value)| Some((point, value?))).collect();
        self.failed += all.iter().filter(|own| own.is_none()).count();
        for own in all.iter().flatten() {
            if self.lowest.as_ref().is_none_or(|(_, lowest)| own.1 < *lowest) {
                self.lowest = Some(own.clone());
            }
        }
        all
    }

    /// Those that have a value.
    fn take<R: Rare<Point = P>>(&mut self, problem: &R, points: Vec<P>) -> Vec<(P, f64)> {
        self.computed(problem, points).into_iter().flatten().collect()
    }
}
