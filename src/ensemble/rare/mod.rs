//! Walls of rare values: the numbers that a wall is made of are moved or shifted until its value is rare. One run of each method, and
//! what the study's own walls say of which one pays.

mod batch;
mod once;
mod pilot;

use std::sync::Arc;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::ensemble::draws::Draws;
use crate::ensemble::{Observed, Quantity, Row, Task, evaluate};
use crate::random::Move;
use crate::random::standard_normal::quantile;
use crate::stats::subset::{Rare, Step};
use crate::study::{Study, WallParameter as Parameter};

pub use batch::{Batch, Batches};
pub use once::{Ended, First, importance, plain, stratified, subset};
pub use pilot::{Leaning, Pilot, Sorted, limit_study, pilot};

/// Members from here on are drawn for rare values alone: no ensemble has so many.
const FIRST_MEMBER: u64 = 1 << 40;
/// Members that moves take their numbers from.
const FIRST_MOVE: u64 = 1 << 48;
/// So far apart are the members of two runs.
const RUN: u64 = 1 << 32;

/// Walls that each thread evaluates before they are kept.
const PIECE: usize = 4;

/// A wall as it was drawn and moved. With the study, the arm and the kn point it gives the same wall again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Draw {
    /// The member that it was drawn as.
    pub member: u64,
    /// Its moves, the first one first: members that numbers were taken from, the share that was kept, and the share of all numbers that were
    /// moved.
    pub moves: Vec<(u64, f64, f64)>,
    /// What the standard normals of parameters, by their keys, are shifted by.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shift: Vec<(String, f64)>,
}

impl Draw {
    /// A member as it is drawn.
    pub fn of(member: u64) -> Draw {
        Draw { member, moves: Vec::new(), shift: Vec::new() }
    }

    /// The number of the run that it was drawn in.
    pub fn run(&self) -> u64 {
        self.member.saturating_sub(FIRST_MEMBER) / RUN
    }

    /// The study in which the member is this wall.
    pub fn study(&self, study: &Study) -> Study {
        let moves: Arc<[Move]> = self
            .moves
            .iter()
            .map(|&(member, keep, moved)| Move { from: [study.seed, member], keep, moved })
            .collect();
        let by = |(key, by): &(String, f64)| Some((Parameter::of(key)?.stream, *by));
        study.clone().with_moves(moves).with_shift(self.shift.iter().filter_map(by).collect())
    }

    /// The standard normals of parameters in this wall.
    pub fn normals(&self, study: &Study, parameters: &[&'static Parameter]) -> Vec<f64> {
        let streams = self.study(study).streams(self.member);
        parameters.iter().map(|own| quantile(streams.of(own.stream).uniform())).collect()
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
    /// Where walls are asked for that are not to be evaluated here.
    pub batches: Option<&'s Batches<'s>>,
}

/// What the event is a low value of; a wall that stood to the end of its load path lies beyond all levels.
fn signed_value(study: &Study, is_high: bool, row: &Row) -> Option<f64> {
    match Quantity::of(study).observed(row) {
        Observed::Value(value) => Some(if is_high { -value } else { value }),
        Observed::Above(_) => Some(f64::MAX),
        Observed::Nothing => None,
    }
}

impl RareWalls<'_> {
    /// What the event is a low value of.
    pub fn signed(&self, value: f64) -> f64 {
        if self.is_high { -value } else { value }
    }

    /// The signed value of a wall.
    fn value(&self, draw: &Draw) -> Option<f64> {
        let task = Task { arm: self.arm, point: self.point, member: draw.member };
        signed_value(self.study, self.is_high, &evaluate(&draw.study(self.study), task))
    }
}

impl Rare for RareWalls<'_> {
    type Point = Draw;

    fn drawn(&self, run: u64, k: u64) -> Draw {
        Draw::of(FIRST_MEMBER + run * RUN + k)
    }

    fn moved(&self, point: &Draw, Step { keep, moved }: Step, run: u64, number: u64) -> Draw {
        let mut draw = point.clone();
        draw.moves.push((FIRST_MOVE + run * RUN + number, keep, moved));
        draw
    }

    fn values(&self, points: &[Draw]) -> Vec<Option<f64>> {
        let known = |draw: &Draw| self.draws.evaluated(self.arm, self.point, draw);
        let mut open: Vec<&Draw> = Vec::new();
        for draw in points.iter().filter(|draw| known(draw).is_none()) {
            if !open.contains(&draw) {
                open.push(draw);
            }
        }
        if let Some(batches) = self.batches.filter(|_| !open.is_empty()) {
            batches.ask((self.arm, self.point, self.is_high), &open);
        }
        // In pieces: a run that is stopped has lost no more than one.
        for piece in open.chunks(rayon::current_num_threads().max(1) * PIECE) {
            let values: Vec<Option<f64>> = piece.par_iter().map(|draw| self.value(draw)).collect();
            self.draws.keep(self.arm, self.point, piece.iter().copied().zip(&values));
            (self.tell)(piece.len());
        }
        points.iter().map(|draw| known(draw).expect("each was evaluated").value).collect()
    }
}
