//! Rigid bodies made of spheres in time: central differences, local damping, springs of Cundall and Strack (1979) between
//! spheres, fixed planes.
//!
//! A body has the mass of its spheres, or that of a solid whose outline they are ([`crate::model::Filling`]).
//!
//! The laws are YADE's for its `FrictMat`: see [`crate::law::Frictional`] for the springs and for what its kn in N/m means
//! beside a joint's kn in Pa/m. Where we depart from YADE: local damping works on the vector of the force, not on each
//! component, and slip is measured where the force acts, so that forces do the work that the springs store and pairs keep
//! their angular momentum (YADE measures it at the undeformed radii by default, against ratcheting under cyclic load).
//!
//! Spheres lie in arrays of their own; candidate pairs come from a cell grid and stay good until some body has moved by
//! half the skin; they are sorted, so results do not depend on how they were found.

mod contacts;
mod critical;
mod heap;
mod neighbours;
mod step;

pub use heap::Grains;
pub use step::Simulation;

/// Settings of the solver of grains.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Settings {
    /// Local damping coefficient, in [0, 1); default 0.8 (source paper Table 5).
    pub damping: f64,
    /// Share of the critical step taken, in (0, 1]; default 0.5. See [`Simulation::dt`].
    pub step_safety: f64,
    /// How far beyond touching pairs are listed, as a share of the smallest radius; default 0.2. Larger means fewer
    /// searches and longer lists; it has no effect on results beyond the time step, whose bound counts listed pairs.
    pub skin_share: f64,
    /// Time steps per call of [`Simulation::settle`] before the run is called not converged; default 5 000 000.
    pub max_steps: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { damping: 0.8, step_safety: 0.5, skin_share: 0.2, max_steps: 5_000_000 }
    }
}
