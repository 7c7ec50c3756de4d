//! What independent runs counted, put together to a small probability with its interval.
//!
//! Runs that are mostly 0 are no sample that Student's interval holds for. So what the points of all runs counted is pooled where they are
//! independent, by the design that they were drawn by, and only chains are compared run by run. No interval ends at 0: where nothing was
//! found, its upper end follows from how many points looked for it and how much each counts. The coverage of every interval is
//! measured in `tests/statistics/tally.rs`.

mod chained;
mod drawn;

use serde::Serialize;

use super::strata::STRATA;

/// Fewer events do not show how much one that went unseen may count.
const TELLING: usize = 10;

/// Points on the worse side of a level, and all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Those on the worse side.
    pub worse: u64,
    /// All.
    pub of: u64,
}

/// What a run counted.
#[derive(Clone, Debug, PartialEq)]
pub enum Tally {
    /// Points that count alike.
    Plain(Counts),
    /// Points that count by how likely they are without a shift.
    Weighted(Weighted),
    /// Points of strata.
    Strata(Strata),
    /// Points of strata within an event that chains led to.
    Within(Within),
    /// Chains that lead down to the level.
    Chains(Chains),
}

/// Points of a mixture, see [`importance`](super::importance).
#[derive(Clone, Debug, PartialEq)]
pub struct Weighted {
    /// What those on the worse side count.
    pub worse: Vec<f64>,
    /// All points.
    pub of: u64,
    /// The most that any point can count.
    pub largest: f64,
}

/// Points by stratum, see [`strata`](super::strata). The last stratum lies far beyond the level.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strata {
    /// Points that were sorted.
    pub sizes: [u64; STRATA],
    /// Points among them that were evaluated, and those of these on the worse side.
    pub counts: [Counts; STRATA],
}

/// Strata of points that chains found in an event.
#[derive(Clone, Debug, PartialEq)]
pub struct Within {
    /// The probability of the event.
    pub probability: f64,
    /// The points in it.
    pub strata: Strata,
    /// Points that were evaluated over those of them that differ: chains repeat some.
    pub repeated: f64,
    /// What is added to the probability, of points of which nothing is known.
    pub more: f64,
    /// Whether the chains hardly moved.
    pub stuck: bool,
}

/// A run of subset simulation, see [`subset`](super::subset).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chains {
    /// The probability that it found.
    pub probability: f64,
    /// Its points as they were drawn, before any was moved.
    pub first: Counts,
    /// Whether its chains hardly moved.
    pub stuck: bool,
}

/// A probability with its interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pooled {
    /// The probability; 0 where nothing was found.
    pub probability: f64,
    /// Its interval; `None` where the runs bound it by nothing.
    pub interval: Option<[f64; 2]>,
    /// Coefficient of variation of the probability; `None` where that is 0 or its error unknown.
    pub cov: Option<f64>,
    /// An upper end that rests on nothing but how points were drawn, where the interval rests on more: on a failure that was not seen counting
    /// no more than those that were, or on none lying in the last stratum. `None` where the interval has that end itself.
    pub at_most: Option<f64>,
}

impl Pooled {
    /// Runs of the same method put together; the interval misses with probability `miss`.
    pub fn of(tallies: &[Tally], miss: f64) -> Pooled {
        macro_rules! all {
            ($kind:ident) => {
                &tallies
                    .iter()
                    .filter_map(|own| if let Tally::$kind(own) = own { Some(own) } else { None })
                    .collect::<Vec<_>>()
            };
        }
        match tallies {
            [Tally::Weighted(_), ..] => drawn::weighted(all!(Weighted), miss),
            [Tally::Strata(_), ..] => drawn::strata(all!(Strata), miss),
            [Tally::Within(_), ..] => chained::within(all!(Within), miss),
            [Tally::Chains(_), ..] => chained::chains(all!(Chains), miss),
            _ => drawn::plain(all!(Plain), miss),
        }
    }
}

impl Strata {
    /// What an evaluated point of each stratum counts, of points of which so many were sorted in all.
    fn weights(&self) -> [f64; STRATA] {
        let all: u64 = self.sizes.iter().sum();
        std::array::from_fn(|at| match self.counts[at].of {
            0 => 0.0,
            of => self.sizes[at] as f64 / all as f64 / of as f64,
        })
    }

    /// The share on the worse side.
    fn share(&self) -> f64 {
        self.weights().iter().zip(&self.counts).map(|(weight, own)| weight * own.worse as f64).sum()
    }

    /// How many were found on the worse side.
    fn worse(&self) -> usize {
        self.counts.iter().map(|own| own.worse as usize).sum()
    }

    /// The largest weight of the strata that hold something on the worse side.
    fn largest_seen(&self) -> f64 {
        let seen = self.weights().into_iter().zip(&self.counts).filter(|(_, own)| own.worse > 0);
        seen.map(|(weight, _)| weight).fold(0.0, f64::max)
    }

    /// The largest weight of all strata but the last one, which counts where it holds something on the worse side, or where nothing else was
    /// evaluated.
    fn largest_near(&self) -> f64 {
        let weights = self.weights();
        let near = weights[..STRATA - 1].iter().copied().fold(0.0, f64::max);
        let far = weights[STRATA - 1];
        if self.counts[STRATA - 1].worse > 0 || near == 0.0 { near.max(far) } else { near }
    }
}

/// The weight of a failure that may have gone unseen: that of those seen once they are many, else the largest possible one.
fn unseen(seen: usize, largest_seen: f64, largest: f64) -> f64 {
    if seen < TELLING { largest } else { largest_seen }
}

/// An interval of a probability.
fn probability([low, high]: [f64; 2]) -> [f64; 2] {
    [low.min(1.0), high.min(1.0)]
}
