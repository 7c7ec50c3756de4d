//! Rare probabilities by subset simulation (Au and Beck 2001): a rare event is reached through events that are each likely given the one
//! before.
//!
//! Samples of an event come from Markov chains that start at samples of it and move by conditional sampling (Papaioannou, Betz, Zwirglmaier
//! and Straub 2015): a proposal keeps a share of the old point in every standard normal that it moves and stays if its value still belongs
//! to the event. The share adapts so that 44 in 100 proposals stay. Those that leave the value as it was to the bit say nothing of that: a
//! move that misses what decides always stays, and would make the next ones ever larger. What a point is made of is the caller's business,
//! and so is how values are computed: nothing here knows of walls. A run is a pure function of the problem, its settings and its number; its
//! error is seen in independent runs alone, as chains of one run are not independent.
//!
//! Independent runs that are all stuck agree on what is wrong. So a run says whether its chains moved, see [`Level`].

use crate::math::{exp, pow};

/// What probabilities are asked of.
pub trait Rare {
    /// A point: what a value is computed from.
    type Point: Clone;

    /// The k-th point of a run as it is drawn at first.
    fn drawn(&self, run: u64, k: u64) -> Self::Point;

    /// The point after a step, which takes from draws of its own, named by the run and the number of the move, what it does not keep.
    fn moved(&self, point: &Self::Point, step: Step, run: u64, number: u64) -> Self::Point;

    /// The values of points, in their order; the event is a low one. `None` where none could be computed.
    fn values(&self, points: &[Self::Point]) -> Vec<Option<f64>>;
}

/// How a point is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The share that is kept of each standard normal that is moved, 0 to 1.
    pub keep: f64,
    /// The share of all standard normals that are moved, 0 to 1.
    pub moved: f64,
}

/// How a run goes.
#[derive(Clone, Debug, PartialEq)]
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
    /// Kinds of moves by the share of standard normals that each moves. Chains take them in turn, and each adapts by itself.
    pub kinds: Vec<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { points: 1000, share: 0.1, levels: 12, keep: 0.8, kinds: vec![1.0] }
    }
}

/// What a run found.
#[derive(Clone, Debug, PartialEq)]
pub struct Run<P> {
    /// Probability of a value at or below the level asked for; 0 where the last level did not come near it.
    pub probability: f64,
    /// The levels that it went down by, descending.
    pub levels: Vec<Level>,
    /// Values that were computed.
    pub values: usize,
    /// Values that could not be. A point without a value is in no event.
    pub failed: usize,
    /// How many of these were of points as they were drawn at first.
    pub lost: usize,
    /// Points as they were drawn at first with a value at or below the level asked for.
    pub first: usize,
    /// The point of the lowest value, with it.
    pub lowest: Option<(P, f64)>,
    /// The points of the last level with a value at or below the level asked for, by their values; none where it was not reached.
    pub within: Vec<P>,
}

/// An event on the way down, and how its chains moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// The value that bounds it.
    pub bound: f64,
    /// Its probability.
    pub probability: f64,
    /// Share of proposals that changed the value and stayed.
    pub accepted: f64,
    /// What a chain keeps of a standard normal from its first point to its last, in the mean: its autocorrelation over the chain. Moves that left the
    /// value as it was count as none.
    pub kept: f64,
}

/// Chains that keep more than this from their first point to their last are stuck: what their seeds have in common, all have.
const STUCK: f64 = 0.9;
/// Share of proposals that should stay.
const STAYING: f64 = 0.44;

impl<P> Run<P> {
    /// The largest share that the chains of a level kept, 0 where there was none.
    pub fn kept(&self) -> f64 {
        self.levels.iter().map(|level| level.kept).fold(0.0, f64::max)
    }
}

/// Whether chains that kept so much of their numbers hardly moved.
pub fn is_stuck(kept: f64) -> bool {
    kept > STUCK
}

/// One run of subset simulation for a level.
pub fn run<R: Rare>(problem: &R, level: f64, settings: &Settings, number: u64) -> Run<R::Point> {
    let drawn: Vec<R::Point> = (0..settings.points as u64).map(|k| problem.drawn(number, k)).collect();
    let seeds = ((settings.points as f64 * settings.share).round() as usize).max(1);
    crate::check!(
        seeds < settings.points && settings.share > 0.0 && settings.share < 1.0 && !settings.kinds.is_empty(),
        "{settings:?}"
    );
    let mut moves = Moves { settings, run: number, made: 0, spreads: Vec::new() };
    let spread = (1.0 - settings.keep * settings.keep).sqrt();
    moves.spreads.resize(settings.kinds.len(), spread);
    let mut found = Run {
        probability: 1.0,
        levels: Vec::new(),
        values: 0,
        failed: 0,
        lost: 0,
        first: 0,
        lowest: None,
        within: Vec::new(),
    };
    let mut points = found.take(problem, drawn);
    found.lost = found.failed;
    found.first = points.iter().filter(|(_, value)| *value <= level).count();
    for _ in 0..=settings.levels {
        points.sort_by(|a, b| a.1.total_cmp(&b.1));
        let all = settings.points as f64;
        let within = points.iter().filter(|(_, value)| *value <= level).count();
        let next = next_level(&points, seeds).filter(|(count, _)| within < seeds && within < *count);
        let Some((count, bound)) = next else {
            found.probability *= within as f64 / all;
            found.within = points.into_iter().take(within).map(|(point, _)| point).collect();
            return found;
        };
        found.probability *= count as f64 / all;
        points.truncate(count);
        let probability = found.probability;
        let [accepted, kept] = moves.fill(problem, &mut found, &mut points, bound);
        found.levels.push(Level { bound, probability, accepted, kept });
    }
    found.probability = 0.0;
    found
}

/// How many of points in ascending order the next level holds, and its bound: halfway to the next value, so that no point lies on it. Equal
/// values belong together; about so many points as are asked for are taken, and never all. `None` where all values are equal, or one is missing.
fn next_level<P>(points: &[(P, f64)], seeds: usize) -> Option<(usize, f64)> {
    let edge = points.get(seeds)?.1;
    let below = points.partition_point(|(_, value)| *value < edge);
    let up_to = points.partition_point(|(_, value)| *value <= edge);
    let few = below > 0 && (2 * below >= seeds || 2 * up_to > points.len());
    let count = if few { below } else { up_to };
    let next = points.get(count)?.1;
    Some((count, 0.5 * points[count - 1].1 + 0.5 * next))
}

/// The moves of a run.
struct Moves<'s> {
    settings: &'s Settings,
    run: u64,
    made: u64,
    /// What each kind changes in a standard normal, as the root of one less the square of what it keeps.
    spreads: Vec<f64>,
}

impl Moves<'_> {
    /// Fills a level up from its seeds, and gives the share of proposals that changed the value and stayed, and what chains kept.
    fn fill<R: Rare>(
        &mut self,
        problem: &R,
        found: &mut Run<R::Point>,
        points: &mut Vec<(R::Point, f64)>,
        bound: f64,
    ) -> [f64; 2] {
        let mut chains = points.clone();
        let mut kept = vec![1.0; chains.len()];
        let [mut proposals, mut moved] = [0.0, 0.0];
        for turn in 1.. {
            let open = self.settings.points - points.len();
            if open == 0 {
                break;
            }
            // The last turn may have too few places for all: they go to chains evenly over the order of their seeds.
            let going = open.min(chains.len());
            let chosen: Vec<usize> = (0..going).map(|k| k * chains.len() / going).collect();
            let kinds = self.settings.kinds.len();
            let steps: Vec<(usize, Step)> =
                (0..going).map(|k| (k + turn) % kinds).map(|kind| (kind, self.step(kind))).collect();
            let proposed = chosen.iter().zip(&steps).enumerate().map(|(k, (at, (_, step)))| {
                problem.moved(&chains[*at].0, *step, self.run, self.made + k as u64)
            });
            let proposed: Vec<R::Point> = proposed.collect();
            self.made += going as u64;
            // By kind: those that changed the value, and those of them that stayed.
            let mut changed = vec![[0.0, 0.0]; kinds];
            for ((at, (kind, step)), own) in chosen.iter().zip(&steps).zip(found.computed(problem, proposed))
            {
                let chain = &mut chains[*at];
                let is_new = own.as_ref().is_none_or(|(_, value)| *value != chain.1);
                changed[*kind][0] += f64::from(u8::from(is_new));
                if let Some(own) = own.filter(|(_, value)| *value <= bound) {
                    *chain = own;
                    if is_new {
                        changed[*kind][1] += 1.0;
                        kept[*at] *= 1.0 - step.moved * (1.0 - step.keep);
                    }
                }
            }
            proposals += going as f64;
            moved += changed.iter().map(|[_, stayed]| stayed).sum::<f64>();
            for (spread, [changed, stayed]) in self.spreads.iter_mut().zip(changed) {
                if changed > 0.0 {
                    let off = stayed / changed - STAYING;
                    *spread = (*spread * exp(off / (turn as f64).sqrt())).min(1.0);
                }
            }
            points.extend(chosen.iter().map(|at| chains[*at].clone()));
        }
        // Chains that are shorter than they are meant to be are judged as if they went on.
        let (own, meant) = (proposals / chains.len() as f64, 1.0 / self.settings.share - 1.0);
        let kept = kept.iter().sum::<f64>() / kept.len() as f64;
        [
            moved / f64::max(proposals, 1.0),
            if own > 0.0 { pow(kept, f64::max(meant / own, 1.0)) } else { 0.0 },
        ]
    }

    fn step(&self, kind: usize) -> Step {
        let spread = self.spreads[kind];
        Step { keep: (1.0 - spread * spread).max(0.0).sqrt(), moved: self.settings.kinds[kind] }
    }
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
