//! The path of equilibria beyond its limit point, down to where a wall that leans out bears nothing any more.

use crate::solve::bodies::Body;
use crate::solve::implicit::Equilibrium;
use crate::solve::implicit::follow::State;
use crate::solve::{Ahead, Equilibrate};

/// Longest step as a share of how far the path is traced: what lies between two states of it is nearly straight.
const LONGEST: f64 = 0.02;
/// First step as a share of the way to the level that the path is expected to reach.
const FIRST: f64 = 0.1;
/// Growth of a step after one that converged within so many iterations.
const GROWTH: f64 = 1.6;
const GOOD: u32 = 8;
/// A step that failed is tried so much longer, once.
const LEAP: f64 = 3.0;
/// Steps before the trace is given up.
const MOST_STEPS: u32 = 400;

/// A state of equilibrium, stable or not.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The level of the load.
    pub level: f64,
    /// The bodies.
    pub bodies: Vec<Body>,
}

/// Why a trace ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TraceEnd {
    /// The load has come down to nothing.
    Spent,
    /// A block has gone as far as the path was to be traced.
    Far,
    /// The solver lost the path, or its steps ran out.
    Lost,
}

impl<'a> Equilibrium<'a> {
    /// The equilibria from this state at rest on, through the limit point and down to level 0 or until a block has gone `ahead.far` (m).
    /// `ahead.to` is a level above the limit point.
    pub fn traced(&self, ahead: &Ahead<'_>) -> (Vec<Traced>, TraceEnd) {
        let Some(mut state) = State::at_rest(self, ahead) else { return (Vec::new(), TraceEnd::Lost) };
        let keep =
            |state: &State<'a>| Traced { level: state.level, bodies: state.at.assembly().bodies.all.clone() };
        let mut states = vec![keep(&state)];
        let longest = LONGEST * ahead.far;
        let mut length = (FIRST * (ahead.to - ahead.from) / state.slope).abs().min(longest);
        for _ in 0..MOST_STEPS {
            // A step that fails however short may leap over the corner at which it does.
            let next = state.next(ahead, length).or_else(|| state.next(ahead, LEAP * length));
            let Some(next) = next else { return (states, TraceEnd::Lost) };
            states.push(keep(&next));
            if next.level <= 0.0 {
                return (states, TraceEnd::Spent);
            }
            if next.at.moved_since(self) > ahead.far {
                return (states, TraceEnd::Far);
            }
            let growth = if next.iterations <= GOOD { GROWTH } else { 1.0 };
            length = (growth * next.length).min(longest);
            state = next;
        }
        (states, TraceEnd::Lost)
    }
}
