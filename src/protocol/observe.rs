//! What is read off a wall: the out-of-plane displacement of its top.

use crate::math::Vec3;
use crate::model::Wall;
use crate::solve::bodies::Bodies;

/// The corners of stones that make up the wall's top, as (block, position as built): all within a millionth of the
/// wall's height of its highest point.
pub fn top_points(wall: &Wall) -> Vec<(usize, Vec3)> {
    let (low, high) = wall.bounds();
    let lowest = high.z - 1e-6 * (high.z - low.z);
    wall.stones()
        .flat_map(|(id, block)| block.shape.vertices.iter().map(move |v| (id, *v)))
        .filter(|(_, v)| v.z >= lowest)
        .collect()
}

/// Displacement of material points (m) from where they were built.
pub fn displacements(assembly: &Wall, bodies: &Bodies, points: &[(usize, Vec3)]) -> Vec<Vec3> {
    // A body's attitude at rest is not the identity: its axes are the principal ones. The shape tells where a
    // corner is in them.
    points
        .iter()
        .map(|(id, built)| {
            let corner = assembly.blocks[*id].shape.vertices.iter().position(|v| v == built);
            let corner = corner.expect("top points are corners of their blocks");
            let body = &bodies.all[*id];
            body.position + body.rotation * bodies.shapes[*id].vertices[corner] - built
        })
        .collect()
}

/// Largest out-of-plane displacement towards +y since an earlier state (m), and the largest in either direction.
pub fn out_of_plane(now: &[Vec3], before: &[Vec3]) -> (f64, f64) {
    now.iter().zip(before).fold((f64::NEG_INFINITY, 0.0), |(forward, either), (n, b)| {
        let y = n.y - b.y;
        (forward.max(y), f64::max(either, y.abs()))
    })
}
