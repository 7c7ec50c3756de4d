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

    /// Goes on until the assembly is at rest, `stop` says so, or it cannot be brought to rest.
    fn settle(&mut self, stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled;
}
