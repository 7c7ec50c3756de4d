//! Limit analysis of a rectangular wall as a thin plate, whose sections bear what is within a convex polyhedron of six stress
//! resultants: the wall that homogenisation makes of its stones.
//!
//! With velocities (u, v, w) along the wall (x), up (z) and out of plane (y), and y out of the middle plane, a point moves in the plane
//! by (u, v) - y grad w. The power of stresses per area is `N : E + M : chi`:
//!
//! ```text
//! E11 = u,x    E22 = v,z    2 E12 = u,z + v,x    chi11 = w,xx    chi22 = w,zz    2 chi12 = 2 w,xz
//! N_ij = integral of sigma_ij dy (N/m, tension positive)         M_ij = integral of -y sigma_ij dy (N)
//! ```
//!
//! **Mechanism.** On triangles ([`Mechanism`]) w is quadratic and continuous, with folds along the edges; (u, v) is linear, with jumps.
//! So a triangle has one strain and one curvature, and an edge of normal n has `E = sym([u] (x) n)` and `chi = [dw/dn] n (x) n` per
//! length, which are linear along it. Lines that yield under deflections linear in every triangle are a special case (Munro and
//! da Fonseca 1978); without curvature inside triangles a surface under which bending along the wall needs its beds to open (E22, which
//! no upright line has) would hardly bend at all. Quadratic deflections with folds: Bleyer and de Buhan (2013).
//!
//! **Upper bound.** A rate `sum mu_k n_k`, `mu_k >= 0`, of the facets' normals takes the power `sum mu_k b_k`, as no stress within them has
//! more. At both ends of an edge that holds, so it does between them. The multiplier is the least for which live and dead load have
//! that power together; where the live load has none, any multiplier is borne. Its dual has stresses within the facets at those
//! places, in balance with the loads against every motion of the mesh.
//!
//! **Not in it.** A thin plate does not shear across its thickness, so that sliding out of plane is only checked for the whole wall
//! ([`Collapse::sliding`]). Flow is associated: what slides along a bed also opens it. Displacements are small.

mod collapse;
mod cuts;
mod facet;
mod interior;
mod mesh;
mod motion;
mod program;
#[cfg(test)]
mod tests;
mod wall;

pub use collapse::{Collapse, Mechanism, Section};
pub use cuts::{Cuts, Ending, Refined};
pub use facet::Facet;
pub use wall::{Edge, Edges, Plate, PlateFault};
