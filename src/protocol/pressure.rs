//! The trapezoidal pressure on the back of a wall, as dead loads at the centres of pressure of its stones' faces.

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::Lateral;
use crate::shape::{Frame, Polygon};

/// A force (N) at a point (m) of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// The block.
    pub block: usize,
    /// Where it acts, on the block as built.
    pub point: Vec3,
    /// The force.
    pub force: Vec3,
}

/// The pressure on every face that looks backwards (-y) with no stone behind its middle, towards +y.
///
/// The pressure varies linearly with height and acts per vertical projection of the face; its resultant on a face and
/// its point of action come from the exact integrals over the face.
pub fn back_loads(wall: &Wall, lateral: &Lateral) -> Vec<Load> {
    let (low, high) = wall.bounds_of_stones();
    let at_top = 2.0 * lateral.mean_pressure / (lateral.base_over_top + 1.0);
    let slope = at_top * (1.0 - lateral.base_over_top) / (high.z - low.z);
    let at_base = at_top * lateral.base_over_top;
    let mut loads = Vec::new();
    for (block, stone) in wall.stones() {
        for face in 0..stone.shape.faces.len() {
            let plane = stone.shape.face_plane(face);
            let centre = stone.shape.face_vertices(face).sum::<Vec3>() / stone.shape.faces[face].len() as f64;
            // Steeper than 45 degrees: a bed that leans is no back.
            if plane.normal.y > -0.5f64.sqrt() || is_covered(wall, block, centre, -Vec3::y()) {
                continue;
            }
            let frame = Frame::on_plane(centre, plane.normal);
            let vertices = stone.shape.face_vertices(face).map(|v| frame.project(&v)).collect();
            let m = Polygon { vertices }.moments();
            // p = p0 + ps s + pt t on the face.
            let p0 = at_base + slope * (centre.z - low.z);
            let (ps, pt) = (slope * frame.s.z, slope * frame.t.z);
            let total = p0 * m.area + ps * m.s + pt * m.t;
            if total == 0.0 {
                continue;
            }
            let by_s = p0 * m.s + ps * m.ss + pt * m.st;
            let by_t = p0 * m.t + ps * m.st + pt * m.tt;
            loads.push(Load {
                block,
                point: frame.lift([by_s / total, by_t / total]),
                force: Vec3::y() * (total * -plane.normal.y),
            });
        }
    }
    loads
}

/// Whether a stone lies before a point, seen along a direction: a ray meets it.
pub(super) fn is_covered(wall: &Wall, own: usize, point: Vec3, direction: Vec3) -> bool {
    wall.stones().filter(|(id, _)| *id != own).any(|(_, other)| {
        let (mut from, mut to) = (0.0f64, f64::INFINITY);
        for face in 0..other.shape.faces.len() {
            let plane = other.shape.face_plane(face);
            let (distance, rate) = (plane.distance(&point), plane.normal.dot(&direction));
            if rate > 0.0 {
                to = to.min(-distance / rate);
            } else if rate < 0.0 {
                from = from.max(-distance / rate);
            } else if distance > 0.0 {
                return false;
            }
        }
        from < to
    })
}
