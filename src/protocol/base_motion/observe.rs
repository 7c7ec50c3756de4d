//! What is observed of a wall that shakes.

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::EventShares;
use crate::protocol::base_motion::settled::Settled;
use crate::protocol::observe::movable;
use crate::solve::Assembly;
use crate::solve::bodies::{Bodies, Body};

/// How a wall came through.
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
    /// The stones that fell, in the order in which they did: block and time (s).
    pub fallen: Vec<(usize, f64)>,
    /// Largest displacement of a stone that did not fall until then (m).
    pub displacement: Extreme,
    /// Largest turn of a stone that did not fall until then (rad).
    pub rotation: Extreme,
    /// Largest opening of a joint between two that did not fall until then (m), by the joint's first block.
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

/// Faces within this share of the thickness touch, as far as slip is concerned.
const TOUCHES: f64 = 1e-4;

/// A stone that can fall.
struct Stone {
    block: usize,
    weight: f64,
    height: f64,
    from: Vec3,
    has_fallen: bool,
}

impl Stone {
    /// How far it has gone (m) and turned (rad) since the start.
    fn gone(&self, bodies: &Bodies, start: &[Body]) -> (Vec3, f64) {
        let carrier = bodies.carriers[self.block];
        (bodies.centroid(self.block) - self.from, bodies.all[carrier].turn_since(&start[carrier]).norm())
    }
}

/// A corner of a joint as it was at rest: the two blocks, where it lies in the axes of their bodies, and the normal in those of the second.
struct Corner {
    bodies: [usize; 2],
    places: [Vec3; 2],
    normal: Vec3,
}

/// The eye on a wall.
pub(super) struct Observer {
    stones: Vec<Stone>,
    corners: Vec<Corner>,
    start: Vec<Body>,
    weight: f64,
    fallen_weight: f64,
    limits: [f64; 2],
    thickness: f64,
    shares: EventShares,
    pub seen: Shaken,
}

impl Observer {
    /// Of a wall at rest whose thickness is `thickness` (m); `limits` as of [`Shaking`](super::Shaking): moved, down.
    pub fn new(
        wall: &Wall,
        at_rest: &Assembly<'_>,
        (thickness, limits): (f64, [f64; 2]),
        shares: EventShares,
    ) -> Observer {
        let bodies = &at_rest.bodies;
        let stones: Vec<Stone> = movable(wall)
            .map(|(block, stone)| Stone {
                block,
                weight: stone.density * stone.shape.volume(),
                height: stone.shape.width(&Vec3::z()),
                from: bodies.centroid(block),
                has_fallen: false,
            })
            .collect();
        let mut corners = Vec::new();
        for joint in &at_rest.joints.all {
            let both = [joint.incident as usize, joint.reference as usize];
            let (_, normal) = joint.place(&bodies.all);
            for (at, _) in joint.corners(&bodies.all) {
                let own = |body: usize| {
                    let body = &bodies.all[body];
                    body.rotation.tr_mul(&(at - body.position))
                };
                let normal = bodies.all[both[1]].rotation.tr_mul(&normal);
                corners.push(Corner { bodies: both, places: both.map(own), normal });
            }
        }
        let weight = stones.iter().map(|stone| stone.weight).sum();
        Observer {
            stones,
            corners,
            start: bodies.all.clone(),
            weight,
            fallen_weight: 0.0,
            limits,
            thickness,
            shares,
            seen: Shaken::nothing_yet(),
        }
    }

    /// Reads the wall at a time (s).
    pub fn read(&mut self, bodies: &Bodies, time: f64) {
        let mut fell = vec![false; bodies.all.len()];
        for stone in &mut self.stones {
            let carrier = bodies.carriers[stone.block];
            if !stone.has_fallen {
                let (moved, turn) = stone.gone(bodies, &self.start);
                self.seen.displacement.grow(moved.norm(), stone.block, time);
                self.seen.rotation.grow(turn, stone.block, time);
                let [far, down] = self.limits;
                if moved.norm() > far * self.thickness || -moved.z > down * stone.height {
                    stone.has_fallen = true;
                    self.fallen_weight += stone.weight;
                    self.seen.fallen.push((stone.block, time));
                }
            }
            fell[carrier] |= stone.has_fallen;
        }
        for corner in &self.corners {
            if corner.bodies.iter().any(|&body| fell[body]) {
                continue;
            }
            let place = |side: usize| {
                let body = &bodies.all[corner.bodies[side]];
                body.position + body.rotation * corner.places[side]
            };
            let normal = bodies.all[corner.bodies[1]].rotation * corner.normal;
            let apart = place(0) - place(1);
            let opening = apart.dot(&normal);
            self.seen.uplift.grow(opening, corner.bodies[0], time);
            if opening <= TOUCHES * self.thickness {
                self.seen.slip.grow((apart - normal * opening).norm(), corner.bodies[0], time);
            }
        }
        // A millionth for the rounding of sums of weights.
        let reached = |wanted: f64| self.fallen_weight >= wanted * self.weight * (1.0 - 1e-6);
        let fallen = !self.seen.fallen.is_empty();
        let note = |event: &mut Option<f64>, has: bool| {
            if has {
                event.get_or_insert(time);
            }
        };
        note(&mut self.seen.first_stone_s, fallen);
        note(&mut self.seen.part_s, fallen && reached(self.shares.part));
        note(&mut self.seen.most_s, fallen && reached(self.shares.most));
    }

    /// Whether most of the weight has fallen.
    pub fn is_over(&self) -> bool {
        self.seen.most_s.is_some()
    }

    /// What was seen, when all has ended.
    pub fn end(mut self, bodies: &Bodies) -> Shaken {
        self.seen.verdict = match (self.seen.first_stone_s, self.seen.most_s) {
            (_, Some(_)) => Verdict::Collapsed,
            (Some(_), None) => Verdict::Damaged,
            (None, None) => Verdict::Stands,
        };
        if self.seen.verdict != Verdict::Collapsed {
            let left = || self.stones.iter().filter(|stone| !stone.has_fallen);
            let gone = |stone: &Stone| stone.gone(bodies, &self.start);
            self.seen.residual_m = Some(left().map(|stone| gone(stone).0.norm()).fold(0.0, f64::max));
            self.seen.residual_rad = Some(left().map(|stone| gone(stone).1).fold(0.0, f64::max));
        }
        self.seen
    }
}

impl Extreme {
    fn grow(&mut self, value: f64, block: usize, at_s: f64) {
        if value > self.value {
            *self = Extreme { value, block, at_s };
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
