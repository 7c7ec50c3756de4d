//! Loads on the crest of a wall.

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::Direction;
use crate::protocol::faces::{Face, faces_against};
use crate::protocol::observe::{extent, movable};
use crate::protocol::pressure::Load;

/// The crest is what looks up in this share of the height from the top.
const CREST: f64 = 0.1;

/// What stands or pushes on a crest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OnCrest {
    /// A force (N) in the middle of the top of one stone, so far (m) along the wall from its left end, seen from behind; the middle of
    /// the wall where that is `None`.
    Point(Vec3, Option<f64>),
    /// A force per length (N/m), spread evenly over all of it.
    Line(Vec3),
}

/// The loads of a force on the crest of a wall that it pushes towards a direction; none where nothing looks up.
pub fn crest_loads(wall: &Wall, towards: Direction, on: OnCrest) -> Vec<Load> {
    let up = faces_against(wall, -Vec3::z());
    let heights = || up.iter().map(|face| face.frame.origin.z);
    let top = heights().fold(f64::NEG_INFINITY, f64::max);
    let foot = extent(wall).0.z;
    let crest: Vec<&Face> =
        up.iter().filter(|face| face.frame.origin.z >= top - CREST * (top - foot)).collect();
    let across = towards.unit();
    let along = Vec3::new(across.y, -across.x, 0.0);
    let stones = movable(wall).flat_map(|(_, stone)| &stone.shape.vertices).map(|v| v.dot(&along));
    let [left, right] = stones.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, r], x| [l.min(x), r.max(x)]);
    match on {
        OnCrest::Point(force, at) => {
            let at = left + at.unwrap_or(0.5 * (right - left));
            let off = |face: &Face| (face.frame.origin.dot(&along) - at).abs();
            let nearest = crest.into_iter().min_by(|a, b| off(a).total_cmp(&off(b)));
            nearest.map(|face| Load { block: face.block, point: face.middle(), force }).into_iter().collect()
        }
        OnCrest::Line(per_length) => {
            let all: f64 = crest.iter().map(|face| face.moments().area).sum();
            let of = |face: &Face| Load {
                block: face.block,
                point: face.middle(),
                force: per_length * ((right - left) * face.moments().area / all),
            };
            crest.into_iter().map(of).collect()
        }
    }
}
