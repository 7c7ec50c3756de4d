//! Walls of rare values, for [`subset`](crate::stats::subset): the numbers that a wall is made of are moved until its value is rare.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::ensemble::draws::Draws;
use crate::ensemble::{Observed, Quantity, Task, evaluate};
use crate::random::Move;
use crate::stats::subset::Rare;
use crate::study::Study;

/// Members from here on are drawn for rare values alone: no ensemble has so many.
const FIRST_MEMBER: u64 = 1 << 40;
/// Members that moves take their numbers from.
const FIRST_MOVE: u64 = 1 << 48;
/// So far apart are the members of two runs.
const RUN: u64 = 1 << 32;
/// Share of a wall's numbers that a move changes: a few stones, as a stone of another length shifts all that come after it.
const MOVED: f64 = 0.2;

/// Walls that each thread evaluates before they are kept.
const PIECE: usize = 4;

/// A wall as it was drawn and moved. With the study, the arm and the kn point it gives the same wall again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Draw {
    /// The member that it was drawn as.
    pub member: u64,
    /// Its moves, the first one first: members that numbers were taken from, and the share that was kept.
    pub moves: Vec<(u64, f64)>,
}

impl Draw {
    /// The number of the run that it was drawn in.
    pub fn run(&self) -> u64 {
        self.member.saturating_sub(FIRST_MEMBER) / RUN
    }

    /// The study in which the member is this wall.
    pub fn study(&self, study: &Study) -> Study {
        let moves: Arc<[Move]> = self
            .moves
            .iter()
            .map(|&(member, keep)| Move { from: [study.seed, member], keep, moved: MOVED })
            .collect();
        study.clone().with_moves(moves)
    }
}

/// The walls of an arm at a kn point; the event is a low value, or a high one.
pub struct RareWalls<'s> {
    /// The study.
    pub study: &'s Study,
    /// Index of the arm.
    pub arm: u32,
    /// Index of the kn point.
    pub point: u32,
    /// Whether the event is a high value.
    pub is_high: bool,
    /// The values that were computed before, and are kept.
    pub draws: &'s Draws<'s>,
    /// Told how many more were computed.
    pub tell: &'s (dyn Fn(usize) + Sync),
}

impl RareWalls<'_> {
    /// What the event is a low value of.
    pub fn signed(&self, value: f64) -> f64 {
        if self.is_high { -value } else { value }
    }

    /// The signed value of a wall; one that stood to the end of its load path lies beyond all levels.
    fn value(&self, draw: &Draw) -> Option<f64> {
        let task = Task { arm: self.arm, point: self.point, member: draw.member };
        let row = evaluate(&draw.study(self.study), task);
        match Quantity::of(&self.study.protocol).observed(&row) {
            Observed::Value(value) => Some(self.signed(value)),
            Observed::Above(_) => Some(f64::MAX),
            Observed::Nothing => None,
        }
    }
}

impl Rare for RareWalls<'_> {
    type Point = Draw;

    fn drawn(&self, run: u64, k: u64) -> Draw {
        Draw { member: FIRST_MEMBER + run * RUN + k, moves: Vec::new() }
    }

    fn moved(&self, point: &Draw, keep: f64, run: u64, number: u64) -> Draw {
        let mut moves = point.moves.clone();
        moves.push((FIRST_MOVE + run * RUN + number, keep));
        Draw { moves, ..*point }
    }

    fn values(&self, points: &[Draw]) -> Vec<Option<f64>> {
        let known: Vec<Option<Option<f64>>> =
            points.iter().map(|draw| Some(self.draws.evaluated(self.arm, self.point, draw)?.value)).collect();
        let open: Vec<Draw> = points
            .iter()
            .zip(&known)
            .filter(|(_, known)| known.is_none())
            .map(|(draw, _)| draw.clone())
            .collect();
        // In pieces: a run that is stopped has lost no more than one.
        let mut found = Vec::with_capacity(open.len());
        for piece in open.chunks(rayon::current_num_threads().max(1) * PIECE) {
            let values: Vec<Option<f64>> = piece.par_iter().map(|draw| self.value(draw)).collect();
            self.draws.keep(self.arm, self.point, piece.iter().zip(&values));
            (self.tell)(piece.len());
            found.extend(values);
        }
        let mut found = found.into_iter();
        known.into_iter().map(|known| known.unwrap_or_else(|| found.next().expect("one for each"))).collect()
    }
}

/// Walls whose limit analysis lies at or below a bound, for subset simulation that goes on from there: only these are taken to the
/// study's own solver (delayed acceptance, Christen and Fox 2005).
pub struct ScreenedWalls<'w, 's> {
    /// The walls, by the study's own solver.
    pub walls: &'w RareWalls<'s>,
    /// The same walls by limit analysis.
    pub screen: &'w RareWalls<'s>,
    /// The bound.
    pub bound: f64,
    /// How many were taken there.
    pub taken: AtomicUsize,
}

impl Rare for ScreenedWalls<'_, '_> {
    type Point = Draw;

    fn drawn(&self, run: u64, k: u64) -> Draw {
        self.walls.drawn(run, k)
    }

    fn moved(&self, point: &Draw, keep: f64, run: u64, number: u64) -> Draw {
        self.walls.moved(point, keep, run, number)
    }

    /// A wall beyond the bound has a value above all levels; one that limit analysis finds nothing of has none.
    fn values(&self, points: &[Draw]) -> Vec<Option<f64>> {
        let screened = self.screen.values(points);
        let passes = |value: &Option<f64>| value.is_some_and(|value| value <= self.bound);
        let passed: Vec<Draw> = points
            .iter()
            .zip(&screened)
            .filter(|(_, value)| passes(value))
            .map(|(point, _)| point.clone())
            .collect();
        self.taken.fetch_add(passed.len(), Ordering::Relaxed);
        let mut found = self.walls.values(&passed).into_iter();
        let own = |value: &Option<f64>| match value {
            Some(_) if passes(value) => found.next().expect("one for each that passed"),
            Some(_) => Some(f64::MAX),
            None => None,
        };
        screened.iter().map(own).collect()
    }
}
