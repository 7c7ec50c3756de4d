//! Notes the states of a wall while it is loaded, and lets it fall further where its test ends, for a [`Replay`].

use std::cell::RefCell;

use crate::math::Vec3;
use crate::model::{BuiltJoint, JointReading, Level, Movement, Replay, ReplayState, Support};
use crate::protocol::observe::extent;
use crate::protocol::task::{displacements, turns};
use crate::protocol::watch::Watch;
use crate::protocol::{Confirmation, Task};
use crate::solve::bodies::Bodies;
use crate::solve::explicit::{self, Simulation};
use crate::solve::joints::Joint;
use crate::solve::{Assembly, Equilibrate};

/// Most states of a fall, and how far a block's centroid has gone at the last one, as a share of the wall's height.
const FALLING: usize = 40;
const FALLEN: f64 = 0.3;
/// Time steps between two looks at a wall that falls.
const STEPS_BETWEEN_LOOKS: u64 = 10;
/// A wall that does not fall hangs back: in this time (s) it moves no further than by this factor, and its load grows by a step.
const HANGS: f64 = 0.25;
const GROWS: f64 = 1.5;
/// Time steps of a block that a fall may take: of a wall of 72 stones a hundred thousand steps.
const MOST_WORK: u64 = 8_000_000;
/// A fall happens in time, with true masses. Local damping is that of a table that turns steadily: it slows a free fall by a
/// twentieth.
const FALL: explicit::Settings = explicit::Settings {
    unbalanced_ratio: 1e-5,
    damping: 0.05,
    step_safety: 0.9,
    max_steps: 200_000,
    scaled_inertia: false,
    longest_step: 1e-3,
};

/// Notes the states at rest and those of the fall. What it is told changes nothing of what is computed.
pub struct Recorder {
    most: usize,
    noted: RefCell<Noted>,
}

#[derive(Default)]
struct Noted {
    /// The bodies as built; `None` before a test has begun.
    built: Option<Bodies>,
    centroids: Vec<Vec3>,
    joints: Vec<BuiltJoint>,
    /// Blocks that are out of the wall since an earlier part of it fell.
    gone: Vec<u32>,
    /// How the joints' middles had moved when the wall first came to rest.
    rested: Option<Vec<Vec3>>,
    /// Levels up to here are known from before an earlier part fell.
    known: f64,
    /// Every `stride`-th state at rest, and the last one where it is none of them.
    borne: Vec<ReplayState>,
    last: Option<ReplayState>,
    stride: usize,
    seen: usize,
    falling: Vec<ReplayState>,
    is_mechanism: bool,
}

impl Recorder {
    /// One that keeps at most so many states, and all of a fall.
    pub fn new(most: usize) -> Recorder {
        let noted = Noted { known: f64::NEG_INFINITY, stride: 1, ..Noted::default() };
        Recorder { most: most.max(FALLING + 2), noted: RefCell::new(noted) }
    }

    /// What was noted of the first `blocks` blocks, which are those of the wall itself.
    pub fn replay(self, blocks: usize) -> Replay {
        let Noted { joints, mut borne, last, falling, is_mechanism, .. } = self.noted.into_inner();
        borne.extend(last);
        let mut states = thinned(borne, self.most - falling.len());
        states.extend(falling);
        for state in &mut states {
            state.poses.truncate(blocks);
            state.gone.retain(|id| (*id as usize) < blocks);
        }
        Replay { joints, states, is_mechanism }
    }

    /// A test begins on a wall as built. Where a part of it fell before, what was borne until then stays.
    pub(super) fn begins(&self, task: &Task<'_>, built: &Assembly<'_>) {
        let noted = &mut *self.noted.borrow_mut();
        let absent = task.wall.blocks.iter().map(|block| block.support == Support::Absent);
        noted.gone = absent.enumerate().filter(|(_, gone)| *gone).map(|(id, _)| id as u32).collect();
        noted.rested = None;
        noted.falling.clear();
        let last = noted.last.as_ref().or(noted.borne.last());
        noted.known = last.map_or(f64::NEG_INFINITY, |state| state.level.value());
        if noted.built.is_none() {
            let bodies = &built.bodies;
            noted.centroids =
                (0..bodies.all.len()).map(|block| bodies.centroid(block) + bodies.origin).collect();
            noted.joints = built.joints.all.iter().map(|joint| as_built(joint, bodies)).collect();
            noted.built = Some(bodies.clone());
        }
    }

    /// The wall is at rest at a level.
    pub(super) fn rests(&self, level: Level, assembly: &Assembly<'_>) {
        let noted = &mut *self.noted.borrow_mut();
        let Some(poses) = noted.poses(&assembly.bodies) else { return };
        if noted.rested.is_none() {
            let middle = |joint: &BuiltJoint| joint.apart(&noted.centroids, &poses, &joint.middle);
            noted.rested = Some(noted.joints.iter().map(middle).collect());
        }
        if level.value() > noted.known {
            let state = noted.state(level, true, poses, assembly);
            noted.bears(state, self.most);
        }
    }

    /// The wall is on the move, followed in time.
    pub(super) fn moves(&self, level: Level, assembly: &Assembly<'_>) {
        let noted = &mut *self.noted.borrow_mut();
        let Some(poses) = noted.poses(&assembly.bodies) else { return };
        let state = noted.state(level, false, poses, assembly);
        noted.bears(state, self.most);
    }

    /// The wall does not stand at a level, coming from the last state at rest at another one, `since`: the explicit solver goes on from
    /// there.
    pub(super) fn falls<'a>(
        &self,
        task: &Task<'a>,
        at_rest: &Assembly<'a>,
        (since, level): (f64, f64),
        watch: &Watch,
    ) {
        let mut assembly = at_rest.clone();
        assembly.bodies.all.iter_mut().for_each(|body| body.rescale(1.0));
        assembly.bodies.stop();
        task.changes.apply(&mut assembly, since, level);
        let mut simulation = Simulation::of(assembly, FALL);
        let (gravity, factor) = task.path.loads(level);
        simulation.set_loads(gravity, factor);
        self.follows(task, simulation, level, watch);
    }

    /// Goes on with a wall that falls. A state is noted whenever its furthest block has gone a part of its way that grows with the
    /// square of their number, as things fall. What hangs back, because the load is hardly more than the wall bears, gets more load.
    pub(super) fn follows(&self, task: &Task<'_>, mut simulation: Simulation<'_>, level: f64, watch: &Watch) {
        let Confirmation { limit, .. } = task.confirmation;
        let (low, high) = extent(task.wall);
        let far = FALLEN * (high.z - low.z);
        let from = simulation.assembly.bodies.clone();
        let (mut level, mut before, mut time, mut noted) = (level, 0.0, 0.0, 0);
        let most = MOST_WORK / from.all.len().max(1) as u64;
        for step in 1..=most {
            simulation.step();
            time += simulation.dt;
            if !step.is_multiple_of(STEPS_BETWEEN_LOOKS) {
                continue;
            }
            if !simulation.assembly.is_finite() {
                return;
            }
            let moved = watch.strayed_between(&from, &simulation.assembly.bodies);
            let reached = (FALLING as f64 * (moved / far).sqrt()) as usize;
            if reached > noted {
                noted = reached;
                self.notes_fall(task.path.level(level), &simulation.assembly);
            }
            if noted >= FALLING {
                return;
            }
            if time > HANGS {
                if moved < limit && moved < GROWS * before {
                    level += task.path.higher(0.0, 1);
                    let (gravity, factor) = task.path.loads(level);
                    simulation.set_loads(gravity, factor);
                }
                (time, before) = (0.0, moved);
            }
        }
    }

    fn notes_fall(&self, level: Level, assembly: &Assembly<'_>) {
        let noted = &mut *self.noted.borrow_mut();
        let Some(poses) = noted.poses(&assembly.bodies) else { return };
        let state = noted.state(level, false, poses, assembly);
        noted.falling.push(state);
    }

    /// Takes a replay as it is instead.
    pub fn takes(&self, replay: Replay) {
        let noted = &mut *self.noted.borrow_mut();
        noted.is_mechanism = replay.is_mechanism;
        noted.joints = replay.joints;
        (noted.borne, noted.falling) = replay.states.into_iter().partition(|state| state.is_equilibrium);
        noted.last = None;
    }
}

impl Noted {
    /// How the blocks have moved since they were built; `None` before a test has begun.
    fn poses(&self, now: &Bodies) -> Option<Vec<Movement>> {
        let built = self.built.as_ref()?;
        let shifts = displacements(&now.all, &built.all, built);
        let turns = turns(&now.all, &built.all, built);
        Some(shifts.into_iter().zip(turns).map(|(shift, turn)| Movement { shift, turn }).collect())
    }

    fn state(
        &self,
        level: Level,
        is_equilibrium: bool,
        poses: Vec<Movement>,
        assembly: &Assembly<'_>,
    ) -> ReplayState {
        let gone = self.gone(&assembly.bodies);
        let reading = |(at, joint): (usize, &BuiltJoint)| {
            if joint.blocks.iter().any(|id| gone.binary_search(id).is_ok()) {
                return JointReading::default();
            }
            let before = self.rested.as_ref().map_or_else(Vec3::zeros, |rested| rested[at]);
            let [opening, slip] = joint.parted(&self.centroids, &poses, &before);
            let [normal_stress, shear_stress] = stresses(assembly, joint.blocks);
            JointReading { opening, slip, normal_stress, shear_stress }
        };
        let joints = self.joints.iter().enumerate().map(reading).collect();
        ReplayState { level, is_equilibrium, poses, joints, gone }
    }

    /// The blocks that are not there any more: those of parts that fell before, and those that are lost on the way.
    fn gone(&self, now: &Bodies) -> Vec<u32> {
        let mut gone = self.gone.clone();
        if let Some(built) = &self.built {
            let is_lost = |&id: &u32| built.carrier(id as usize).moves() && !now.carrier(id as usize).moves();
            gone.extend((0..now.all.len() as u32).filter(is_lost));
            gone.sort_unstable();
            gone.dedup();
        }
        gone
    }

    /// Keeps every so-many-th state at rest, twice `most` of them at most.
    fn bears(&mut self, state: ReplayState, most: usize) {
        self.last = None;
        if self.seen.is_multiple_of(self.stride) {
            self.borne.push(state);
        } else {
            self.last = Some(state);
        }
        self.seen += 1;
        if self.borne.len() > 2 * most {
            let mut at = 0;
            self.borne.retain(|_| {
                at += 1;
                at % 2 == 1
            });
            self.stride *= 2;
        }
    }
}

/// At most so many of the states, evenly, with the first and the last one among them.
fn thinned(states: Vec<ReplayState>, most: usize) -> Vec<ReplayState> {
    let all = states.len();
    if all <= most {
        return states;
    }
    let kept = |at: usize| (0..most).any(|k| (k * (all - 1)) / (most - 1) == at);
    states.into_iter().enumerate().filter(|(at, _)| kept(*at)).map(|(_, state)| state).collect()
}

fn as_built(joint: &Joint, bodies: &Bodies) -> BuiltJoint {
    let (lower, upper) = joint.pair();
    let (middle, push) = joint.place(&bodies.all);
    let (corners, gaps): (Vec<Vec3>, Vec<f64>) = joint.corners(&bodies.all).into_iter().unzip();
    // The push is on the incident block.
    let from_first = bodies.carriers[upper as usize] as u32 == joint.incident;
    BuiltJoint {
        blocks: [lower, upper],
        polygon: corners.into_iter().map(|corner| corner + bodies.origin).collect(),
        gaps,
        normal: if from_first { push } else { -push },
        middle: middle + bodies.origin,
        area: joint.area(),
    }
}

/// Pressure and shear (Pa) of the joint between two blocks; none where they have no joint any more.
fn stresses(assembly: &Assembly<'_>, blocks: [u32; 2]) -> [f64; 2] {
    let all = &assembly.joints.all;
    // Joints are in the order of their pairs.
    let Ok(at) = all.binary_search_by_key(&blocks, |joint| joint.pair().into()) else { return [0.0; 2] };
    let (joint, bodies) = (&all[at], &assembly.bodies.all);
    let (force, (_, normal)) = (joint.carried(bodies), joint.place(bodies));
    let across = force.dot(&normal);
    [across / joint.area(), (force - normal * across).norm() / joint.area()]
}
