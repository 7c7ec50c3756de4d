//! Damping laws of the explicit solver.

use crate::math::Vec3;

/// Cundall's local damping (3DEC, YADE's `NewtonIntegrator`) in vector form: a force `-alpha |force| v / |v|`
/// against the motion, zero at rest.
///
/// The codes it comes from damp each component by itself, which makes the answer depend on the direction of the
/// axes; the vector form takes as much energy and is the same in every frame.
///
/// Speeds below 1e-100 count as rest: their squares would leave the range of numbers.
pub fn local_damping(alpha: f64, force: &Vec3, velocity: &Vec3) -> Vec3 {
    let v2 = velocity.norm_squared();
    if v2 > 1e-200 { velocity * (-alpha * (force.norm_squared() / v2).sqrt()) } else { Vec3::zeros() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_opposes_the_motion_by_a_share_of_the_force() {
        let damping = local_damping(0.8, &Vec3::new(0.0, 3.0, 4.0), &Vec3::new(2.0, 0.0, 0.0));
        assert_eq!(damping, Vec3::new(-4.0, 0.0, 0.0));
    }

    #[test]
    fn a_body_all_but_at_rest_is_not_damped_to_infinity() {
        for speed in [0.0, 1e-300, 1e-160, 1e-120, 1e-90] {
            let damping = local_damping(0.8, &Vec3::new(1e4, 0.0, 0.0), &Vec3::new(0.0, speed, 0.0));
            assert!(damping.norm() <= 0.8e4 * (1.0 + 1e-14), "{speed:e}: {damping}");
        }
    }
}
