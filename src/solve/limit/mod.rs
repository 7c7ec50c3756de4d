//! Limit analysis: the load at which an assembly of rigid blocks with dry joints becomes a mechanism.
//!
//! # The program
//!
//! Contact forces act at the vertices `i` of every joint polygon, the same polygons that the other solvers use: `n_i`
//! along the joint's normal (compression positive) and `t_i` in its plane. With the dead loads `d` and the live loads
//! `l` as forces and moments about the centroids of the blocks that move, and `B` the equilibrium matrix,
//!
//! ```text
//! maximise lambda   subject to   B f + d + lambda l = 0
//!                                |t_i| <= c A_i + n_i tan(phi),   n_i >= -T A_i
//! ```
//!
//! (Livesley 1978). `A_i` is the vertex's share of the joint's area: half of the two triangles
//! that it spans with its neighbours and the centroid, so that a uniform traction keeps its resultant. Tension is
//! limited by the tensile strength `T` and by the envelope's apex `c / tan(phi)`, whichever is less. A bonded joint
//! carries anything.
//!
//! An interior-point method made for this program solves it (`interior`); clarabel solves what that one does not: pyramids,
//! forces without a cone, and a state that does not exist.
//!
//! The cone is kept as it is (a second-order cone), or replaced by the pyramid **inscribed** in it, whose first edge lies
//! along the load's projection on the joint: a statically admissible state of the pyramid is one of the cone, so its
//! multiplier is never larger, and it is equal where the shear runs along an edge, as in a wall loaded in its plane.
//!
//! # What the multiplier is
//!
//! The dual variables of equilibrium are the velocities of the collapse mechanism. With relative velocity `u` at a contact
//! (incident block against reference block, opening positive) they satisfy `u_n >= |u_t| tan(phi)`: sliding dilates
//! (associative flow), and the mechanism's own multiplier is
//!
//! ```text
//! lambda_kinematic = (D(u) - d . v) / (l . v),     D = sum of c A_i |u_t| + min(T A_i, c A_i / tan(phi)) (u_n - |u_t| tan(phi))
//! ```
//!
//! It is recomputed here from the velocities, as the equilibrium residual is from the forces: gap and residual do not rest
//! on a solver's word, whichever it was. Real joints dilate less, so **the associative multiplier is an upper bound on what a wall
//! with Coulomb joints can bear** under any flow rule (Radenkovic 1961), and so is `atan(lambda)` on the angle.
//! [`Flow::NonAssociative`] looks for a state with zero dilatancy, see `flow`; its multiplier is **neither a bound nor
//! unique**, but never above the associative one.
//!
//! # Tilting
//!
//! Where strength is proportional to compression (no cohesion, no tensile strength, no other loads) only the direction of
//! gravity counts, and the wall tilts to `atan(lambda)`. Else the angle is bracketed, see `tilt`.

mod analysis;
mod audit;
mod collapse;
mod flow;
mod interfaces;
mod interior;
mod loads;
mod periodic;
mod program;
mod self_stress;
mod settings;
mod sides;
mod strength;
mod tilt;

pub use analysis::{Analysis, Standing};
pub use collapse::{Accuracy, BlockMotion, FixedPoint, Limit, Thrust};
pub use loads::{Loads, PointLoad, When};
pub use periodic::Bearing;
pub use settings::{Cone, Flow, Settings};
pub(crate) use sides::is_upright;

use crate::solve::Demand;

/// What it does not have, with the reason.
pub(super) fn refuses(demand: Demand) -> Option<&'static str> {
    match demand {
        Demand::Closure | Demand::StressStiffening | Demand::ClosureTable => {
            Some("rigid blocks have joints without closure")
        }
        Demand::CompressiveStrength => Some("limit analysis takes joints to bear any pressure"),
        Demand::BaseCompliance => Some("rigid blocks stand on rigid ground"),
        Demand::WedgeLoss => Some("limit analysis sees the wall as built, with all its wedges"),
        Demand::Creep => Some("limit analysis knows no history"),
        Demand::Turning | Demand::BaseMotion => Some("limit analysis knows no time"),
        Demand::Displacements | Demand::Remainders => Some("rigid blocks do not move before they fall"),
        Demand::Restitution => Some("limit analysis knows no time"),
        Demand::Agreement => Some("it would be compared with itself"),
        Demand::ContactArea | Demand::Weakening | Demand::ServiceDisplacement | Demand::RayleighDamping => {
            None
        }
    }
}
