//! The implicit quasi-static solver: equilibrium of rigid blocks with deformable joints by Newton's method.
//!
//! Unknown are the displacement and the finite turn of every block; loads act on the displaced blocks. With the same
//! joints and laws as the explicit solver, a rest state is where forces and moments of every block vanish:
//!
//! ```text
//! r(x) = loads(x) + joints(x, what they remember)        K = -dr/dx        K dx = r        x <- x + s dx
//! ```
//!
//! `s` comes from a line search on `r . dx`. Elimination costs a hundred times what the forces cost, so a factorised
//! K serves for as many steps as bring the residual down well.

mod arc;
mod equilibrium;
mod follow;
mod loose;
mod newton;
mod stiffening;
mod trace;

pub use equilibrium::Equilibrium;
pub use newton::Effort;
pub use trace::{TraceEnd, Traced};

use crate::solve::Demand;

/// What it does not have, with the reason.
pub(super) fn refuses(demand: Demand) -> Option<&'static str> {
    matches!(demand, Demand::BaseMotion | Demand::Restitution)
        .then_some("Newton's method goes from rest to rest")
}

/// Settings of the implicit solver.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Settings {
    /// At rest when the unbalanced force ratio is below this; default 1e-7.
    pub unbalanced_ratio: f64,
    /// Factorisations per load increment before it counts as failed; default 30. One that does not come closer fails earlier.
    pub max_factorisations: u32,
    /// A load increment that fails is halved at most this many times; default 1. Load paths that bracket a collapse halve
    /// their steps themselves and do without.
    pub max_halvings: u32,
    /// Stiffness added to each block's diagonal, as a share of the largest there; default 1e-8. It makes the matrix of a
    /// block that rattles regular. It is in the matrix only, never in the balance: what has converged is free of it.
    pub stabilisation: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { unbalanced_ratio: 1e-7, max_factorisations: 30, max_halvings: 1, stabilisation: 1e-8 }
    }
}
