//! How an attempt to bring an assembly to rest ended, and what a solver must do to be driven by a protocol.

use crate::math::Vec3;
use crate::solve::assembly::Assembly;
use crate::solve::bodies::Bodies;

/// How an attempt to bring an assembly to rest ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// At rest: the unbalanced force ratio is below its limit.
    Equilibrium,
    /// The caller's criterion stopped it.
    Stopped,
    /// The steps ran out.
    StepsSpent,
    /// No equilibrium was found near the state it started from: a limit point, or a solver that lost its way. Who
    /// asks must tell the two apart by another solver.
    NoEquilibrium,
    /// A position became NaN or infinite.
    NonFinite,
}

/// What came of an attempt to bring an assembly to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settled {
    /// How it ended.
    pub status: Status,
    /// Unbalanced force ratio reached.
    pub unbalanced_ratio: f64,
    /// Steps or iterations taken.
    pub steps: u64,
}

/// The path of equilibria ahead of a state at rest, for a solver that can follow it through a limit point.
pub struct Ahead<'l> {
    /// Gravity (m/s^2) and the factor on the dead loads at a level.
    pub loads: &'l dyn Fn(f64) -> (Vec3, f64),
    /// The level of the state at rest.
    pub from: f64,
    /// The level above it at which no equilibrium was found.
    pub to: f64,
    /// A wall falls when, past the limit point, a block has gone so far (m) without the path rising again above it.
    pub far: f64,
    /// The limit point is bracketed to this.
    pub bracket: f64,
}

/// What was found along a path of equilibria.
pub struct Followed<S> {
    /// The highest state at rest.
    pub rest: S,
    /// Its level.
    pub level: f64,
    /// Its unbalanced force ratio.
    pub ratio: f64,
    /// Steps of the solver that led to the end of what was seen.
    pub steps: u64,
    /// How the path goes on from there.
    pub way: Way,
}

/// How a path goes on from its highest state.
pub enum Way {
    /// It has reached the level that was asked for.
    Stands,
    /// It turns there and leads down.
    Falls {
        /// Upper bound of the level of the limit point, where the path turns once.
        above: f64,
        /// The level of a state far down the path, which stands there and nowhere above.
        at: f64,
        /// That state.
        bodies: Box<Bodies>,
        /// Its unbalanced force ratio.
        ratio: f64,
    },
}

/// A solver that brings an assembly to rest under its loads. Loads are changed on the assembly between two calls; a
/// clone is a state to come back to.
pub trait Equilibrate<'a>: Clone {
    /// Bodies, joints and loads as they stand.
    fn assembly(&self) -> &Assembly<'a>;

    /// The same, to change loads or positions by hand.
    fn assembly_mut(&mut self) -> &mut Assembly<'a>;

    /// The gravity (m/s^2) and the factor on the dead loads from now on.
    fn set_loads(&mut self, gravity: Vec3, load_factor: f64) {
        let assembly = self.assembly_mut();
        assembly.gravity = gravity;
        assembly.load_factor = load_factor;
    }

    /// Follows the path of equilibria from this state, which is at rest; `None` where the solver cannot, or loses it.
    fn follow(&self, _ahead: &Ahead<'_>) -> Option<Followed<Self>> {
        None
    }

    /// Lets fixed bodies down by so much (m) each, and goes on as [`settle`](Equilibrate::settle) does.
    fn lower(&mut self, down: &[(usize, f64)], stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        self.assembly_mut().lower(down);
        self.assembly_mut().refresh();
        self.settle(stop)
    }

    /// Whether a wall that runs away is best followed by this solver itself, in time; else the explicit solver does it.
    fn follows_falls(&self) -> bool {
        false
    }

    /// Goes on until the assembly is at rest, `stop` says so, or it cannot be brought to rest.
    fn settle(&mut self, stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled;
}
