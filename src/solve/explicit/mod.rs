//! The explicit solver (3DEC- and YADE-like): central differences, local damping, automatic critical step.

mod critical;
mod rayleigh;
mod step;

pub use rayleigh::Rayleigh;
pub use step::Simulation;

/// Settings of the explicit solver.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Settings {
    /// Stop when the unbalanced force ratio falls below this; default 1e-5.
    pub unbalanced_ratio: f64,
    /// Local damping coefficient, in [0, 1); default 0.8 (source paper Table 5).
    pub damping: f64,
    /// Share of the critical step taken, in (0, 1]; default 0.5. The bound on the critical step is safe for
    /// linear joints; slip and opening only soften them.
    pub step_safety: f64,
    /// Time steps per load step before the run is called not converged; default 200 000.
    pub max_steps: u64,
    /// Whether inertia is scaled per block so that all share one critical step; default true. Right for a rest state,
    /// wrong for anything that happens in time.
    pub scaled_inertia: bool,
    /// Longest time step (s) with true inertia, for blocks in free flight, which have no critical step; default 1e-3.
    pub longest_step: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            unbalanced_ratio: 1e-5,
            damping: 0.8,
            step_safety: 0.5,
            max_steps: 200_000,
            scaled_inertia: true,
            longest_step: 1e-3,
        }
    }
}
