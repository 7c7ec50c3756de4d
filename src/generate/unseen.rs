//! What the face of a wall does not show: how deep its stones are, and how its beds dip through it. The face stays as it is.

use crate::generate::wall::InvalidGeometry;
use crate::math::{Vec3, tan};
use crate::model::{Block, Tag, Wall};
use crate::random::{Family, Streams};
use crate::shape::{Plane, Polyhedron};

/// Share of a stone's size within which corners lie on a plane: rounding.
const ROUNDING: f64 = 1e-9;

/// What is drawn of each wall behind a face that a file shows. The face is the plane with the least y.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Unseen {
    /// Share of the stones that go through the wall, drawn once per wall, in [0, 1]; which ones is drawn per stone.
    pub through_share: Family,
    /// Depth of the other stones as a share of the wall's thickness, drawn per stone, within (0, 1). Behind each lies one with the rest.
    pub depth_share: Family,
    /// Dip of all beds through the wall (rad), drawn once per wall: above 0 they rise away from the face.
    #[serde(rename = "dip_rad")]
    pub dip: Family,
}

impl Unseen {
    /// Whether every wall is the same.
    pub fn is_fixed(&self) -> bool {
        let is_constant = |family: &Family| matches!(family, Family::Constant { .. });
        let through = self.through_share.mean();
        // Where all stones go through, no depth is drawn.
        let depths = through >= 1.0 || (through <= 0.0 && is_constant(&self.depth_share));
        is_constant(&self.through_share) && depths && is_constant(&self.dip)
    }

    /// How far beds rise at most through the wall, as a share of its thickness; at least 0.
    pub fn most_rise(&self) -> f64 {
        tan(self.dip.support().1).max(0.0)
    }

    /// One wall behind a face: stones of `wall` through the whole thickness, and what it stands on behind them. Stones at the back follow those
    /// at the face. What stands on the plane z = 0 stays level there.
    ///
    /// # Errors
    /// A stone of which nothing is left.
    pub fn drawn(&self, wall: &Wall, streams: &Streams) -> Result<Wall, InvalidGeometry> {
        let (low, high) = wall.bounds_of_stones();
        let thickness = high.y - low.y;
        let dip = self.dip.sample(&mut streams.of("unseen dip"));
        let through = self.through_share.sample(&mut streams.of("unseen through share"));
        let (mut which, mut depths) = (streams.of("unseen through stones"), streams.of("unseen depths"));
        let stones = wall.before_base();
        let (mut front, mut back) = (Vec::new(), Vec::new());
        for (number, stone) in wall.blocks[..stones].iter().enumerate() {
            let shape = sheared(&stone.shape, tan(dip), low).ok_or_else(|| gone(number))?;
            let is_through = which.uniform() < through;
            let depth = low.y + self.depth_share.sample(&mut depths) * thickness;
            if is_through {
                front.push(Block { shape, tag: Tag::Header, ..stone.clone() });
                continue;
            }
            let plane = Plane::through(Vec3::new(0.0, depth, 0.0), Vec3::y());
            let (near, far) = shape.cut(&plane, ROUNDING * shape.diameter());
            let (near, far) = near.zip(far).ok_or_else(|| gone(number))?;
            front.push(Block { shape: near, ..stone.clone() });
            back.push(Block { shape: far, ..stone.clone() });
        }
        let blocks = front.into_iter().chain(back).chain(wall.blocks[stones..].iter().cloned()).collect();
        Ok(Wall { blocks })
    }
}

fn gone(stone: usize) -> InvalidGeometry {
    let reason = format!("nothing is left of stone {stone} in front or behind");
    InvalidGeometry { reason, attempts: 1, redraws: 0 }
}

/// A solid whose planes rise by `slope` along y, about the face at `low`, but for those that lie level on the ground there.
fn sheared(shape: &Polyhedron, slope: f64, low: Vec3) -> Option<Polyhedron> {
    if slope == 0.0 {
        return Some(shape.clone());
    }
    let moved = |v: &Vec3| Vec3::new(v.x, v.y, v.z + slope * (v.y - low.y));
    let size = shape.diameter();
    let stands = |face: &usize| {
        let level = shape.face_vertices(*face).all(|v| (v.z - low.z).abs() <= ROUNDING * size);
        level && shape.face_plane(*face).normal.z < 0.0
    };
    let faces = 0..shape.faces.len();
    if !faces.clone().any(|face| stands(&face)) {
        let vertices = shape.vertices.iter().map(moved).collect();
        return Some(Polyhedron { vertices, faces: shape.faces.clone() });
    }
    let planes: Vec<Plane> = faces
        .map(|face| {
            let plane = shape.face_plane(face);
            if stands(&face) {
                return plane;
            }
            let normal = plane.normal - Vec3::y() * (slope * plane.normal.z);
            let point = shape.face_vertices(face).next().unwrap_or_default();
            Plane::through(moved(&point), normal.normalize())
        })
        .collect();
    Polyhedron::behind(&planes, &shape.vertices, size, ROUNDING * size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{atan, radians};

    /// Two courses of two stones, 0.5 m deep.
    fn wall() -> Wall {
        let stone = |x: f64, z: f64| {
            let shape = Polyhedron::cuboid(Vec3::new(x, 0.0, z), Vec3::new(x + 0.5, 0.5, z + 0.2));
            Block::stone(shape, 2400.0)
        };
        Wall { blocks: vec![stone(0.0, 0.0), stone(0.5, 0.0), stone(0.0, 0.2), stone(0.5, 0.2)] }
    }

    fn constant(value: f64) -> Family {
        Family::Constant { value }
    }

    #[test]
    fn stones_go_through_or_are_divided_at_their_depth() {
        let unseen = |through: f64| Unseen {
            through_share: constant(through),
            depth_share: constant(0.4),
            dip: constant(0.0),
        };
        assert_eq!(unseen(1.0).drawn(&wall(), &Streams::new(1, 0)).unwrap().blocks.len(), 4);
        let two = unseen(0.0).drawn(&wall(), &Streams::new(1, 0)).unwrap();
        let volumes: Vec<f64> = two.blocks.iter().map(|block| block.volume()).collect();
        let wanted = [0.02, 0.02, 0.02, 0.02, 0.03, 0.03, 0.03, 0.03];
        assert!(volumes.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{volumes:?}");
        let counts: Vec<usize> = (0..200)
            .map(|member| unseen(0.25).drawn(&wall(), &Streams::new(1, member)).unwrap().blocks.len())
            .collect();
        let through = counts.iter().map(|count| 8 - count).sum::<usize>() as f64 / 800.0;
        assert!((through - 0.25).abs() < 0.05, "{through}");
        assert!(unseen(0.0).is_fixed() && unseen(1.0).is_fixed() && !unseen(0.25).is_fixed());
    }

    #[test]
    fn beds_that_dip_leave_the_ground_level_and_the_volume_above_it() {
        let unseen =
            Unseen { through_share: constant(1.0), depth_share: constant(0.5), dip: constant(radians(5.0)) };
        let dipping = unseen.drawn(&wall(), &Streams::new(1, 0)).unwrap();
        let lower = &dipping.blocks[0].shape;
        let normal = |shape: &Polyhedron, up: f64| {
            let planes = (0..shape.faces.len()).map(|face| shape.face_plane(face).normal);
            planes.max_by(|a, b| (up * a.z).total_cmp(&(up * b.z))).unwrap()
        };
        assert!((normal(lower, -1.0).z + 1.0).abs() < 1e-12);
        let top = normal(lower, 1.0);
        assert!((atan(-top.y / top.z) - radians(5.0)).abs() < 1e-12, "{top:?}");
        let bed = normal(&dipping.blocks[2].shape, -1.0);
        assert!((bed + top).norm() < 1e-12, "one plane for both");
        assert!((dipping.blocks[2].volume() - 0.05).abs() < 1e-12);
    }
}
