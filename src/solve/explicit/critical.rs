//! The critical time step, from a bound per block.
//!
//! A joint's energy `1/2 k (u_a - u_b)^2` is at most `k (u_a^2 + u_b^2)`: twice the stiffness that each block feels
//! against fixed neighbours. The largest frequency of the assembly is therefore bounded by
//! `omega^2 <= 2 max_block lambda_max(M^-1 K_block)`, with the 6 x 6 stiffness of a block against fixed neighbours,
//! and Gershgorin's row sums bound lambda_max. Central differences are stable for `dt <= 2 / omega`.

use crate::math::Vec3;
use crate::solve::Assembly;
use crate::solve::bodies::Body;
use crate::solve::gershgorin::RowSums;
use crate::solve::joints::Joint;

/// Bounds of `lambda_max(M^-1 K)` (1/s^2) per body, with its true mass and inertia; 0 for a body without joints and springs
/// of its own.
pub fn block_bounds(assembly: &Assembly<'_>) -> Vec<f64> {
    let Assembly { bodies, joints, .. } = assembly;
    let mut stiffness = vec![RowSums::default(); bodies.all.len()];
    for joint in &joints.all {
        for index in [joint.incident as usize, joint.reference as usize] {
            let body = &bodies.all[index];
            if body.moves() {
                add_joint(&mut stiffness[index], body, joint, &bodies.all);
            }
        }
    }
    for tie in assembly.ties() {
        let body = &bodies.all[tie.tie.body];
        if body.moves() {
            let (lever, axis) = tie.own(body);
            stiffness[tie.tie.body].add_spring(&lever, &axis, tie.tie.stiffness);
        }
    }
    if let Some(mounted) = assembly.mounted() {
        let (index, [.., settlement, rotation, _, _]) = (mounted.mount.body, mounted.stiffness());
        let body = &bodies.all[index];
        let (up, along) = (body.rotation.tr_mul(&Vec3::z()), body.rotation.tr_mul(&Vec3::x()));
        stiffness[index].add_row([up.x, up.y, up.z, 0.0, 0.0, 0.0], settlement);
        stiffness[index].add_row([0.0, 0.0, 0.0, along.x, along.y, along.z], rotation);
    }
    stiffness.iter().zip(&bodies.all).map(|(own, body)| own.bound(body)).collect()
}

/// Adds a joint in full contact to the stiffness of one of its bodies.
fn add_joint(k: &mut RowSums, body: &Body, joint: &Joint, all: &[Body]) {
    let (centroid, normal) = joint.place(all);
    let [(along_s, s), (along_t, t)] = joint.levers(all);
    let area = joint.area();
    let local = |v: Vec3| body.rotation.tr_mul(&v);
    let kn = joint.law.normal.largest_stiffness() * area / 4.0;
    let ks = joint.law.ks * area / 4.0;
    // Four points with a quarter of the area each have the second moments of the sub-contacts.
    for (i, j) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let lever = local(centroid + along_s * i + along_t * j - body.position);
        for (axis, stiffness) in [(normal, kn), (s, ks), (t, ks)] {
            k.add_spring(&lever, &local(axis), stiffness);
        }
    }
}
