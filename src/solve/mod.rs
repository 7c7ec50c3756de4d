//! Solvers: assembly into arrays, joints, status; `explicit` is the DEM of blocks, `nonsmooth` contact dynamics of rigid blocks, `grains` the DEM of
//! bodies made of spheres, `limit` rigid limit analysis.

pub mod assembly;
pub mod bodies;
pub(crate) mod conic;
mod demand;
pub mod explicit;
mod gershgorin;
pub mod grains;
pub mod implicit;
pub mod joints;
pub mod limit;
mod mount;
pub mod nonsmooth;
mod status;
pub mod system;
mod ties;

pub use crate::math::STANDARD_GRAVITY;
pub use assembly::Assembly;
pub use demand::Demand;
pub use mount::{Mount, Mounted};
pub use status::{Ahead, Equilibrate, Followed, Settled, Status, Way};
pub use ties::{Held, Tie};

/// Of the laws and the solvers: raised by whoever changes what they answer by more than rounding. It is among the values that
/// decide a study's results, so that what an earlier state computed is not taken for this one's. 2: shear at four points of every
/// sub-contact. 3: limit analysis is asked of every state at rest on the way up. Gaps that carry nothing and the rule of fallen blocks
/// came later and left it at 3: of 450 walls of the published bank of `tilting-table` that were computed again, 449 came out to the last
/// digit (a stone slips out of one).
pub const REVISION: u32 = 3;

/// Which solver, with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// Central differences with local damping: 3DEC- and YADE-like.
    Explicit(explicit::Settings),
    /// Newton's method from equilibrium to equilibrium; what it cannot find is confirmed by the explicit solver.
    Implicit(implicit::Settings),
    /// Contact dynamics of rigid blocks with Coulomb friction: LMGC90-like.
    Nonsmooth(nonsmooth::Settings),
    /// Limit analysis: the load at which rigid blocks fall, without steps and without displacements.
    Limit(limit::Settings),
}

impl Solver {
    /// Its name in files.
    pub fn name(&self) -> &'static str {
        match self {
            Solver::Explicit(_) => "explicit",
            Solver::Implicit(_) => "implicit",
            Solver::Nonsmooth(_) => "nonsmooth",
            Solver::Limit(_) => "limit",
        }
    }
    /// Why it refuses a demand; `None` where it has that.
    pub fn refuses(&self, demand: Demand) -> Option<&'static str> {
        match self {
            Solver::Explicit(_) => {
                (demand == Demand::Restitution).then_some("elastic joints have no impacts")
            }
            Solver::Implicit(_) => implicit::refuses(demand),
            Solver::Nonsmooth(settings) => settings.refuses(demand),
            Solver::Limit(_) => limit::refuses(demand),
        }
    }
}
