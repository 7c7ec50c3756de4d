//! Walls of rare values, for [`subset`](crate::stats::subset): the numbers that a wall is made of are moved until its value is rare.

use std::sync::Arc;

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

/// Name of the file in the output folder that keeps their values.
pub const DRAWS: &str = "draws.jsonl";

/// The values that are kept.
pub type RareDraws = Draws<Draw, Option<f64>>;

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
    pub draws: &'s RareDraws,
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
            points.iter().map(|draw| self.draws.value(self.arm, self.point, draw)).collect();
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
