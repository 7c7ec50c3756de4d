//! What is read off a wall: the displacement of its top, of three points there, and of every block.

use crate::math::Vec3;
use crate::model::{Block, Support, Wall};
use crate::protocol::Direction;
use crate::solve::bodies::Bodies;

/// The stones that can move: neither base nor ends, nor a block that is fixed for other reasons or has fallen out.
pub fn movable(wall: &Wall) -> impl Iterator<Item = (usize, &Block)> {
    wall.stones().filter(|(_, block)| !matches!(block.support, Support::Fixed | Support::Absent))
}

/// Lowest and highest corner of the box around the stones that can move (m).
pub fn extent(wall: &Wall) -> (Vec3, Vec3) {
    movable(wall).fold(
        (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)),
        |(low, high), (_, b)| {
            let (from, to) = b.shape.bounds();
            (low.inf(&from), high.sup(&to))
        },
    )
}

/// A point fixed to a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The block.
    pub block: usize,
    /// Where it was built (m).
    pub built: Vec3,
    /// The same in the axes of the block's body, from its centroid (m).
    own: Vec3,
}

impl Point {
    /// A point of a block that has not moved yet.
    fn new(block: usize, built: Vec3, bodies: &Bodies) -> Point {
        let body = bodies.carrier(block);
        Point { block, built, own: body.rotation.tr_mul(&(built - bodies.origin - body.position)) }
    }

    /// A corner of a block, whose coordinates in the axes of its body need no rounding.
    fn corner(block: usize, corner: usize, built: Vec3, bodies: &Bodies) -> Point {
        Point { block, built, own: bodies.shapes[block].vertices[corner] }
    }

    /// Displacement (m) from where it was built.
    pub fn displacement(&self, bodies: &Bodies) -> Vec3 {
        let body = bodies.carrier(self.block);
        body.position + body.rotation * self.own - (self.built - bodies.origin)
    }
}

/// The corners of stones that make up the wall's top: all within a millionth of the wall's height of its highest point.
pub fn top_points(wall: &Wall, bodies: &Bodies) -> Vec<Point> {
    let (low, high) = extent(wall);
    let lowest = high.z - 1e-6 * (high.z - low.z);
    movable(wall)
        .flat_map(|(id, block)| block.shape.vertices.iter().enumerate().map(move |(k, v)| (id, k, *v)))
        .filter(|(.., v)| v.z >= lowest)
        .map(|(id, k, v)| Point::corner(id, k, v, bodies))
        .collect()
}

/// The three points that the source paper's test reads: left, centre and right of the wall's top (x = 0, the middle and
/// the length), on the front edge of the foremost stone there; of the nearest stone where a joint is open.
pub fn three_points(wall: &Wall, top: &[Point], bodies: &Bodies) -> Option<[Point; 3]> {
    let (low, high) = extent(wall);
    let at = |x: f64| {
        let mut best: Option<(f64, f64, usize)> = None;
        for (index, point) in top.iter().enumerate() {
            let (from, to) = wall.blocks[point.block].shape.bounds();
            let beside = (from.x - x).max(x - to.x).max(0.0);
            let front = point.built.y;
            if best.is_none_or(|(b, f, _)| beside < b || (beside == b && front > f)) {
                best = Some((beside, front, index));
            }
        }
        best.map(|(_, _, index)| {
            let corner = top[index];
            let (from, to) = wall.blocks[corner.block].shape.bounds();
            let built = Vec3::new(x.clamp(from.x, to.x), corner.built.y, corner.built.z);
            Point::new(corner.block, built, bodies)
        })
    };
    Some([at(low.x)?, at(0.5 * (low.x + high.x))?, at(high.x)?])
}

/// Displacements of points (m) from where they were built.
pub fn displacements(points: &[Point], bodies: &Bodies) -> Vec<Vec3> {
    points.iter().map(|point| point.displacement(bodies)).collect()
}

/// Largest displacement towards a side since an earlier state (m), and the largest that way or the other.
pub fn furthest(now: &[Vec3], before: &[Vec3], towards: Direction) -> (f64, f64) {
    let unit = towards.unit();
    now.iter().zip(before).fold((f64::NEG_INFINITY, 0.0), |(forward, either), (n, b)| {
        let along = (n - b).dot(&unit);
        (forward.max(along), f64::max(either, along.abs()))
    })
}
