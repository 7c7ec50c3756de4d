//! Damping laws of the explicit solver.

use crate::math::Vec3;

/// Cundall's local damping (3DEC, YADE's `NewtonIntegrator`) in vector form: a force `-alpha |force| v / |v|`
/// against the motion, zero at rest.
///
/// The codes it comes from damp each component by itself, which makes the answer depend on the direction of the
/// axes; the vector form takes as much energy and is the same in every frame.
pub fn local_damping(alpha: f64, force: &Vec3, velocity: &Vec3) -> Vec3 {
    let v2 = velocity.norm_squared();
    if v2 > 0.0 { velocity * (-alpha * (force.norm_squared() / v2).sqrt()) } else { Vec3::zeros() }
}
