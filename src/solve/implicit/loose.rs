//! Blocks that nothing carries yet, and blocks that nothing holds.

use crate::math::Vec3;
use crate::solve::Assembly;
use crate::solve::bodies::{Body, Freedom};
use crate::solve::system::DOF;

/// A pivot below this share of the diagonal counts as none.
const SINGULAR: f64 = 1e-6;
/// Furthest fall, in reaches of the contact search: four sizes of a typical stone.
const LONGEST_FALL: u32 = 800;

/// Lets every block that touches nothing down along its load, by half the reach of the contact search at a time, until
/// it does. Newton's method has no use for a block in the air: its balance does not depend on where it is. Says whether
/// all have landed.
pub fn land(assembly: &mut Assembly<'_>) -> bool {
    for _ in 0..2 * LONGEST_FALL {
        assembly.apply_loads();
        let falling = in_the_air(assembly);
        if falling.is_empty() {
            return true;
        }
        let step = 0.5 * assembly.contact.reach;
        for block in falling {
            let body = &mut assembly.bodies.all[block];
            body.position += pull(body).normalize() * step;
        }
        assembly.refresh();
    }
    false
}

/// The blocks that move, touch nothing and are pulled somewhere.
fn in_the_air(assembly: &Assembly<'_>) -> Vec<usize> {
    let bodies = &assembly.bodies.all;
    let mut touches = vec![false; bodies.len()];
    for joint in assembly.joints.all.iter().filter(|joint| joint.touches(bodies)) {
        touches[joint.incident as usize] = true;
        touches[joint.reference as usize] = true;
    }
    (0..bodies.len())
        .filter(|&b| bodies[b].moves() && !touches[b] && pull(&bodies[b]) != Vec3::zeros())
        .collect()
}

/// The load on a body in the directions in which it can move.
fn pull(body: &Body) -> Vec3 {
    match body.freedom {
        Freedom::InPlane | Freedom::Upright => Vec3::new(body.force.x, 0.0, body.force.z),
        Freedom::Led => Vec3::new(0.0, 0.0, body.force.z),
        // Its springs hold it.
        Freedom::Mounted => Vec3::zeros(),
        Freedom::Free | Freedom::Fixed => body.force,
    }
}

/// Whether a stiffness (force and moment by shift and turn) leaves some motion free: elimination in the given order
/// finds a pivot that is next to nothing beside its diagonal.
pub fn is_singular(stiffness: &[[f64; DOF]; DOF], unknowns: impl Fn(usize) -> bool) -> bool {
    let kept: Vec<usize> = (0..DOF).filter(|&k| unknowns(k)).collect();
    let mut rows: Vec<Vec<f64>> = kept
        .iter()
        .map(|&r| kept.iter().map(|&c| 0.5 * (stiffness[r][c] + stiffness[c][r])).collect())
        .collect();
    for k in 0..kept.len() {
        let whole = stiffness[kept[k]][kept[k]];
        let pivot = rows[k][k];
        if pivot <= SINGULAR * whole {
            return true;
        }
        let top = rows[k].clone();
        for row in rows.iter_mut().skip(k + 1) {
            let factor = row[k] / pivot;
            row.iter_mut().zip(&top).for_each(|(x, t)| *x -= factor * t);
        }
    }
    false
}
