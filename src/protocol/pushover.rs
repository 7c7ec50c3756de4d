//! A wall pushed over: what it bears against how far it leans, through the most that it bears and down to nothing.

use crate::math::{STANDARD_GRAVITY, Vec3};
use crate::model::{Block, Outcome, Wall};
use crate::protocol::Task;
use crate::solve::bodies::Body;
use crate::solve::implicit::{self, Equilibrium, TraceEnd, Traced};
use crate::solve::limit::{self, Analysis, Loads};
use crate::solve::nonsmooth::{self, Simulation};
use crate::solve::{Ahead, Assembly, Equilibrate, Status};

/// Width to which the limit point is bracketed along the path, as a share of its level: what the elastic solver's own climb takes.
const BRACKET: f64 = 0.01;
/// Blocks that are let go have gone back, or on, when the control point has moved by this share of the way that the path led it: more than they move
/// as they come clear of what elastic joints let them overlap.
const GONE: f64 = 0.01;
/// Seconds for which blocks are watched that are let go: a stone of 1 m that leans 0.2 % of the way off its balance has gone after 0.7.
const WATCHED: f64 = 2.0;
/// Where blocks turn back is bracketed to this share of the way.
const NEAR: f64 = 0.005;

/// A wall pushed over.
pub struct Pushover<'t> {
    /// The block whose centroid is followed.
    pub control: usize,
    /// How far that has moved along the load since the wall stood under its weight alone (m), and the level that holds it there.
    pub points: Vec<[f64; 2]>,
    /// Why the path ends.
    pub end: TraceEnd,
    built: Assembly<'t>,
    states: Vec<Traced>,
    towards: Vec3,
}

impl<'t> Pushover<'t> {
    /// Pushes a wall with elastic joints whose limit is near a level, until it bears nothing or a block has gone `far` (m); `None` where it does
    /// not come to rest under its own weight.
    pub fn of(task: &Task<'t>, control: usize, limit: f64, far: f64) -> Option<Pushover<'t>> {
        let built = task.assembled();
        let mut rest = Equilibrium::of(built.clone(), implicit::Settings::default());
        let (gravity, factor) = task.path.loads(0.0);
        rest.set_loads(gravity, factor);
        if rest.settle(&mut |_| false).status != Status::Equilibrium {
            return None;
        }
        let loads = |level: f64| task.path.loads(level);
        let ahead = Ahead { loads: &loads, from: 0.0, to: limit, far, bracket: BRACKET * limit };
        let (states, end) = rest.traced(&ahead);
        let towards = task.path.direction().unit();
        let body = built.bodies.carriers[control];
        let at = |state: &Traced| state.bodies[body].position.dot(&towards);
        let first = at(states.first()?);
        let points = states.iter().map(|state| [at(state) - first, state.level]).collect();
        Some(Pushover { control, points, end, built, states, towards })
    }

    /// How far the control point moves at first (m) for each unit of the level.
    pub fn gives(&self) -> f64 {
        match self.points.first_chunk() {
            Some([[start, none], [moved, level]]) => (moved - start) / (level - none),
            None => 0.0,
        }
    }

    /// How far the control point has gone (m) when rigid blocks bear nothing any more, by limit analysis of the wall as it leans in the two states of the
    /// path about its end; `None` where the path does not lead there, or rigid blocks do not hang in the balance in these states.
    pub fn rigid_end(&self, task: &Task<'_>) -> Option<f64> {
        let at =
            (1..self.points.len()).find(|k| self.points[*k][1] <= 0.0 && self.points[*k - 1][1] > 0.0)?;
        let [from, to] = [at - 1, at].map(|k| self.points[k][0]);
        let [before, after] = [at - 1, at].map(|k| self.rigid(task, k));
        let (before, after) = (before?, after?);
        Some(from + (to - from) * before / (before - after))
    }

    /// The multiplier that rigid blocks bear in a state: from the level that elastic joints bear there up.
    fn rigid(&self, task: &Task<'_>, state: usize) -> Option<f64> {
        let level = self.points[state][1];
        let leaning = self.leaning(task.wall, state);
        let analysis = Analysis::new(&leaning, task.laws, task.contact, limit::Settings::default());
        let (gravity, _) = task.path.loads(level);
        let live = self.towards * STANDARD_GRAVITY;
        let found = analysis.multiplier(&Loads { dead: gravity, live, points: Vec::new() });
        matches!(found.outcome, Outcome::Collapsed { .. }).then(|| level + found.multiplier)
    }

    /// The wall as it leans in a state.
    fn leaning(&self, wall: &Wall, state: usize) -> Wall {
        let (built, now) = (&self.built.bodies, &self.states[state].bodies);
        let block = |(id, block): (usize, &Block)| {
            let [from, to] = [&built.all, now].map(|bodies| &bodies[built.carriers[id]]);
            let turn = to.rotation * from.rotation.transpose();
            let shift = built.origin + to.position - turn * (built.origin + from.position);
            block.moved(&turn, &shift)
        };
        Wall { blocks: wall.blocks.iter().enumerate().map(block).collect() }
    }

    /// Between which displacements of the control point (m) rigid blocks without dilatancy turn from going back to going on, by contact
    /// dynamics, when they are let go at rest under these loads in states of the path past its highest one. `None` where they do neither.
    pub fn let_go(&self, loads: (Vec3, f64)) -> Option<[f64; 2]> {
        let top = (0..self.points.len()).max_by(|a, b| self.points[*a][1].total_cmp(&self.points[*b][1]))?;
        // Places along the path: a state, and a share of the way to the next one.
        let (mut back, mut on) = (top as f64, (self.points.len() - 1) as f64);
        if !self.goes_on(on, loads)? || self.goes_on(back, loads)? {
            return None;
        }
        while self.moved(on) - self.moved(back) > NEAR * self.moved(on) {
            // By states first, then between two of them.
            let middle = if on - back > 1.0 { (0.5 * (back + on)).round() } else { 0.5 * (back + on) };
            if self.goes_on(middle, loads)? { on = middle } else { back = middle }
        }
        Some([self.moved(back), self.moved(on)])
    }

    /// How far the control point has moved (m) at a place along the path.
    fn moved(&self, place: f64) -> f64 {
        let (state, share) = self.place(place);
        let [from, to] = [state, state + 1].map(|k| self.points[k.min(self.points.len() - 1)][0]);
        from + share * (to - from)
    }

    /// The state before a place along the path, and the share of the way to the next one.
    fn place(&self, place: f64) -> (usize, f64) {
        let state = place.floor();
        (state as usize, place - state)
    }

    /// Whether rigid blocks that are let go at a place along the path go on; `None` where they stay.
    fn goes_on(&self, place: f64, (gravity, factor): (Vec3, f64)) -> Option<bool> {
        let (state, share) = self.place(place);
        let mut assembly = self.built.clone();
        assembly.bodies.all.clone_from(&self.states[state].bodies);
        if let Some(next) = self.states.get(state + 1) {
            // Two states of the path are so near that each body goes straight from one to the other.
            for (body, after) in assembly.bodies.all.iter_mut().zip(&next.bodies) {
                let (here, turn) = (body.clone(), after.turn_since(body));
                body.place(&here, &((after.position - here.position) * share), &(turn * share));
            }
        }
        assembly.bodies.stop();
        (assembly.gravity, assembly.load_factor) = (gravity, factor);
        assembly.refresh();
        let body = assembly.bodies.carriers[self.control];
        let at = |bodies: &[Body]| bodies[body].position.dot(&self.towards);
        let start = at(&assembly.bodies.all);
        let gone = GONE * self.moved(place);
        let settings = nonsmooth::Settings::default();
        let mut simulation = Simulation::of(assembly, settings);
        for _ in 0..(WATCHED / settings.time_step) as u32 {
            simulation.step_once();
            let moved = at(&simulation.assembly.bodies.all) - start;
            if moved.abs() > gone {
                return Some(moved > 0.0);
            }
        }
        None
    }
}
