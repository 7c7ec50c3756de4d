//! What is observed of a wall that shakes.

use std::collections::BTreeMap;

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::EventShares;
use crate::protocol::base_motion::seam::{Seam, Tracked, largest};
use crate::protocol::base_motion::settled::Settled;
use crate::protocol::fallen::{Bearings, Fate};
use crate::protocol::observe::movable;
use crate::solve::Assembly;
use crate::solve::bodies::{Bodies, Body};

/// How a wall came through. A stone has fallen when it has toppled or left its bearing and did not come back, see `protocol/fallen.rs`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No stone has fallen.
    Stands,
    /// Stones have fallen, but less than most of the weight.
    Damaged,
    /// Most of the weight has fallen.
    Collapsed,
    /// A start that differs by next to nothing leads to another verdict: only a probability can be told.
    Undecided,
    /// It does not stand under gravity.
    UnstableAtRest,
    /// The solver could not go on, or what its steps left over may be what holds the wall up.
    NotSolved,
}

/// A largest value, where and when.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Extreme {
    /// The value (m or rad).
    pub value: f64,
    /// The block.
    pub block: usize,
    /// The time (s).
    pub at_s: f64,
}

/// Where the energy came from and went (J).
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Energy {
    /// Work that the moving base did on the blocks: of the forces `-m a`.
    pub base_work_j: f64,
    /// What gravity has given: weight times way down.
    pub gravity_work_j: f64,
    /// Of motion, at the end.
    pub kinetic_j: f64,
    /// All else: friction, impacts, damping, and what joints store.
    pub lost_j: f64,
    /// Of it, what sliding joints took; `None` where the solver does not count it.
    pub friction_j: Option<f64>,
}

/// What came of shaking a wall. Displacements are against the base, from rest under gravity.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Shaken {
    /// How it came through.
    pub verdict: Verdict,
    /// How far it went before it was shaken, where it was not in balance as built.
    pub settled: Option<Settled>,
    /// When the first stone fell (s from the beginning of the motion).
    pub first_stone_s: Option<f64>,
    /// When a part of the weight had fallen (s).
    pub part_s: Option<f64>,
    /// When most of it had fallen (s).
    pub most_s: Option<f64>,
    /// The stones that fell, in the order in which they did: block, of several parts the first one, and the time (s) from which on it did.
    pub fallen: Vec<(usize, f64)>,
    /// Largest displacement of a stone (m), of one that fell before it did.
    pub displacement: Extreme,
    /// Largest turn of a stone (rad), of one that fell before it did.
    pub rotation: Extreme,
    /// Largest opening of a joint (m) before one of its two stones fell, by the joint's first block.
    pub uplift: Extreme,
    /// Largest way by which the faces of such a joint slid along one another while they touched (m).
    pub slip: Extreme,
    /// Largest displacement of a stone that has not fallen (m) when all had come to rest, or the time was over; `None` of a wall that collapsed.
    pub residual_m: Option<f64>,
    /// The same of turns (rad).
    pub residual_rad: Option<f64>,
    /// Energy by source.
    pub energy: Energy,
    /// The time followed (s).
    pub time_s: f64,
    /// Time steps.
    pub steps: u64,
    /// Steps whose contact problem was not solved to the tolerance.
    pub unsolved_steps: u64,
    /// Largest natural map of a step, see [`Residual`](crate::solve::nonsmooth::Residual); 0 of a solver that has none.
    pub largest_residual: f64,
    /// What those steps left over: the speed (m/s) that it gives a stone of the mean mass, all blows in one direction. A wall that does not collapse
    /// has an answer only where this is little beside the speed of the base.
    pub left_over_m_per_s: f64,
}

/// A stone that can fall, with all its parts.
struct Stone {
    /// Its body, which is its first part.
    body: usize,
    weight: f64,
    /// Since when it has been on its way down (s).
    since: Option<f64>,
    /// Whether it has fallen for good.
    lies: bool,
    displacement: Tracked,
    rotation: Tracked,
}

impl Stone {
    /// How far it has gone (m) and turned (rad) since the start.
    fn gone(&self, bodies: &Bodies, start: &[Body]) -> [f64; 2] {
        let (now, then) = (&bodies.all[self.body], &start[self.body]);
        [(now.position - then.position).norm(), now.turn_since(then).norm()]
    }
}

/// The eye on a wall.
pub(super) struct Observer {
    bearings: Bearings,
    stones: Vec<Stone>,
    seams: Vec<Seam>,
    start: Vec<Body>,
    weight: f64,
    shares: EventShares,
}

impl Observer {
    /// Of a wall at rest; `up` is the direction against gravity.
    pub fn new(wall: &Wall, at_rest: &Assembly<'_>, up: Vec3, shares: EventShares) -> Observer {
        let bodies = &at_rest.bodies;
        let mut weights: BTreeMap<usize, f64> = BTreeMap::new();
        for (block, stone) in movable(wall) {
            *weights.entry(bodies.carriers[block]).or_default() += stone.mass();
        }
        let stone = |(body, weight): (&usize, &f64)| Stone {
            body: *body,
            weight: *weight,
            since: None,
            lies: false,
            displacement: Tracked::default(),
            rotation: Tracked::default(),
        };
        Observer {
            bearings: Bearings::of(wall, at_rest, up),
            stones: weights.iter().map(stone).collect(),
            seams: at_rest.joints.all.iter().map(|joint| Seam::of(joint, bodies)).collect(),
            start: bodies.all.clone(),
            weight: weights.values().sum(),
            shares,
        }
    }

    /// Reads the wall at a time (s).
    pub fn read(&mut self, wall: &Assembly<'_>, time: f64) {
        let (fates, bodies) = (self.bearings.fates(wall), &wall.bodies);
        let mut falls = vec![false; bodies.all.len()];
        for stone in &mut self.stones {
            let [moved, turned] = stone.gone(bodies, &self.start);
            stone.displacement.grow(moved, stone.body, time);
            stone.rotation.grow(turned, stone.body, time);
            stone.lies |= fates[stone.body] == Fate::Lies;
            if stone.lies || fates[stone.body] != Fate::Carried {
                stone.since.get_or_insert(time);
                falls[stone.body] = true;
            } else {
                stone.since = None;
                stone.displacement.is_carried();
                stone.rotation.is_carried();
            }
        }
        for seam in &mut self.seams {
            seam.read(bodies, time);
            if !seam.bodies.iter().any(|body| falls[*body]) {
                seam.uplift.is_carried();
                seam.slip.is_carried();
            }
        }
    }

    /// Whether most of the weight has fallen for good.
    pub fn is_over(&self) -> bool {
        let lying = self.stones.iter().filter(|stone| stone.lies).map(|stone| stone.weight);
        self.reached(lying.sum(), self.shares.most)
    }

    /// Whether a weight is a share of all; a millionth for the rounding of sums.
    fn reached(&self, weight: f64, share: f64) -> bool {
        weight > 0.0 && weight >= share * self.weight * (1.0 - 1e-6)
    }

    /// What was seen, when all has ended. Where most has fallen for good the rest was not followed: what only seemed to fall does not count.
    pub fn end(self, bodies: &Bodies) -> Shaken {
        let is_over = self.is_over();
        let has_fallen = |stone: &&Stone| stone.since.is_some() && (stone.lies || !is_over);
        let mut fallen: Vec<(&Stone, f64)> = self
            .stones
            .iter()
            .filter(has_fallen)
            .map(|stone| (stone, stone.since.unwrap_or_default()))
            .collect();
        fallen.sort_by(|a, b| a.1.total_cmp(&b.1));
        let when = |share: f64| {
            let mut weight = 0.0;
            let passes = |(stone, _): &&(&Stone, f64)| {
                weight += stone.weight;
                self.reached(weight, share)
            };
            fallen.iter().find(passes).map(|(_, at)| *at)
        };
        let most = when(self.shares.most);
        let verdict = match (fallen.is_empty(), most) {
            (_, Some(_)) => Verdict::Collapsed,
            (false, None) => Verdict::Damaged,
            (true, None) => Verdict::Stands,
        };
        let standing = || self.stones.iter().filter(|stone| !has_fallen(stone));
        let residual = |which: usize| {
            let left = standing().map(|stone| stone.gone(bodies, &self.start)[which]).fold(0.0, f64::max);
            (verdict != Verdict::Collapsed).then_some(left)
        };
        let stones = |of: fn(&Stone) -> &Tracked| largest(self.stones.iter().map(of));
        let seams = |of: fn(&Seam) -> &Tracked| largest(self.seams.iter().map(of));
        Shaken {
            verdict,
            first_stone_s: fallen.first().map(|(_, at)| *at),
            part_s: when(self.shares.part),
            most_s: most,
            fallen: fallen.iter().map(|(stone, at)| (stone.body, *at)).collect(),
            displacement: stones(|stone| &stone.displacement),
            rotation: stones(|stone| &stone.rotation),
            uplift: seams(|seam| &seam.uplift),
            slip: seams(|seam| &seam.slip),
            residual_m: residual(0),
            residual_rad: residual(1),
            ..Shaken::nothing_yet()
        }
    }
}

impl Shaken {
    /// Before anything has moved.
    pub(super) fn nothing_yet() -> Shaken {
        Shaken {
            verdict: Verdict::Stands,
            settled: None,
            first_stone_s: None,
            part_s: None,
            most_s: None,
            fallen: Vec::new(),
            displacement: Extreme::default(),
            rotation: Extreme::default(),
            uplift: Extreme::default(),
            slip: Extreme::default(),
            residual_m: None,
            residual_rad: None,
            energy: Energy::default(),
            time_s: 0.0,
            steps: 0,
            unsolved_steps: 0,
            largest_residual: 0.0,
            left_over_m_per_s: 0.0,
        }
    }
}
