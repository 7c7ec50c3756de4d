//! What the face of a wall does not show: how deep its stones are, and how its beds dip through it. The face stays as it is.

use std::collections::BTreeMap;

use crate::generate::wall::InvalidGeometry;
use crate::math::{Vec3, tan};
use crate::model::{Block, Tag, Wall};
use crate::random::{Family, Streams};
use crate::shape::{Plane, Polyhedron};

/// Share of a stone's size within which corners lie on a plane: rounding.
const ROUNDING: f64 = 1e-9;
/// Ends the name of the concave stone behind another.
const BEHIND: &str = " behind";

/// What is drawn of each wall behind a face that a file shows. The face is the plane with the least y.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Unseen {
    /// Share of the stones that go through the wall, drawn once per wall, in [0, 1]; which ones is drawn per stone.
    pub through_share: Family,
    /// Depth of the other stones as a share of what the core leaves of the wall's thickness, drawn per stone, within (0, 1). Behind each lies
    /// one with the rest.
    pub depth_share: Family,
    /// Thickness of the core as a share of the wall's, drawn once per wall, in [0, 1). It lies between the stones that do not go through, and
    /// counts as empty: a loose core bears nothing.
    pub core_share: Family,
    /// Dip of all beds through the wall (rad), drawn once per wall: above 0 they rise away from the face.
    #[serde(rename = "dip_rad")]
    pub dip: Family,
}

impl Unseen {
    /// Whether every wall is the same.
    pub fn is_fixed(&self) -> bool {
        let shared = [&self.core_share, &self.dip];
        !self.draws_throughs() && !self.draws_depths() && shared.into_iter().all(|own| own.sd() == 0.0)
    }

    /// Whether it is drawn which stones go through.
    pub fn draws_throughs(&self) -> bool {
        let mean = self.through_share.mean();
        self.through_share.sd() > 0.0 || (mean > 0.0 && mean < 1.0)
    }

    /// Whether stones have depths of their own. Where all go through, no depth is seen.
    pub fn draws_depths(&self) -> bool {
        self.through_share.mean() < 1.0 && self.depth_share.sd() > 0.0
    }

    /// How far beds rise at most through the wall, as a share of its thickness; at least 0.
    pub fn most_rise(&self) -> f64 {
        tan(self.dip.support().1).max(0.0)
    }

    /// One wall behind a face: stones of `wall` through the whole thickness, and what it stands on behind them. Stones at the back follow those
    /// at the face. Headers of `wall` go through in every case. What stands on the plane z = 0 stays level there.
    ///
    /// # Errors
    /// A stone of which nothing is left.
    pub fn drawn(&self, wall: &Wall, streams: &Streams) -> Result<Wall, InvalidGeometry> {
        let (low, high) = wall.bounds_of_stones();
        let thickness = high.y - low.y;
        let dip = self.dip.sample(&mut streams.of("unseen dip"));
        let through = self.through_share.sample(&mut streams.of("unseen through share"));
        let core = self.core_share.sample(&mut streams.of("unseen core share")) * thickness;
        let (mut which, mut depths) = (streams.of("unseen through stones"), streams.of("unseen depths"));
        let leads = wall.leads();
        let mut draws = BTreeMap::new();
        let stones = wall.before_base();
        let (mut front, mut back) = (Vec::new(), Vec::new());
        for (number, stone) in wall.blocks[..stones].iter().enumerate() {
            let shape = sheared(&stone.shape, tan(dip), low).ok_or_else(|| gone(number))?;
            // The parts of a concave stone share what is drawn. Headers draw as well, so that marking one changes no other stone.
            let (is_drawn_through, share) = *draws
                .entry(leads[number])
                .or_insert_with(|| (which.uniform() < through, self.depth_share.sample(&mut depths)));
            if is_drawn_through || stone.tag == Tag::Header {
                front.push(Block { shape, tag: Tag::Header, ..stone.clone() });
                continue;
            }
            let cut = |depth: f64| {
                let plane = Plane::through(Vec3::new(0.0, depth, 0.0), Vec3::y());
                shape.cut(&plane, ROUNDING * shape.diameter())
            };
            let depth = low.y + share * (thickness - core);
            let (near, far) = (cut(depth).0, cut(depth + core).1);
            let (near, far) = near.zip(far).ok_or_else(|| gone(number))?;
            front.push(Block { shape: near, ..stone.clone() });
            let group = stone.group.as_ref().map(|group| format!("{group}{BEHIND}"));
            back.push(Block { shape: far, group, ..stone.clone() });
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

    /// No core, level beds, stones that do not go through 0.2 m deep.
    fn unseen(through: f64) -> Unseen {
        Unseen {
            through_share: constant(through),
            depth_share: constant(0.4),
            core_share: constant(0.0),
            dip: constant(0.0),
        }
    }

    fn drawn(unseen: &Unseen, wall: &Wall) -> Wall {
        unseen.drawn(wall, &Streams::new(1, 0)).unwrap()
    }

    fn volumes(wall: &Wall) -> Vec<f64> {
        wall.blocks.iter().map(Block::volume).collect()
    }

    fn assert_close(found: &[f64], wanted: &[f64]) {
        assert_eq!(found.len(), wanted.len(), "{found:?}");
        assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
    }

    #[test]
    fn stones_go_through_or_are_divided_at_their_depth() {
        assert_eq!(drawn(&unseen(1.0), &wall()).blocks.len(), 4);
        let two = drawn(&unseen(0.0), &wall());
        assert_close(&volumes(&two), &[0.02, 0.02, 0.02, 0.02, 0.03, 0.03, 0.03, 0.03]);
        let counts: Vec<usize> = (0..200)
            .map(|member| unseen(0.25).drawn(&wall(), &Streams::new(1, member)).unwrap().blocks.len())
            .collect();
        let through = counts.iter().map(|count| 8 - count).sum::<usize>() as f64 / 800.0;
        assert!((through - 0.25).abs() < 0.05, "{through}");
        assert!(unseen(0.0).is_fixed() && unseen(1.0).is_fixed() && !unseen(0.25).is_fixed());
    }

    #[test]
    fn a_core_lies_empty_between_both_faces_and_headers_bridge_it() {
        let cored = Unseen { core_share: constant(0.3), ..unseen(0.0) };
        // 0.35 m are left of 0.5 m: 0.14 m in front, 0.21 m behind.
        let mut marked = wall();
        marked.blocks[2].tag = Tag::Header;
        let made = drawn(&cored, &marked);
        assert_close(&volumes(&made), &[0.014, 0.014, 0.05, 0.014, 0.021, 0.021, 0.021]);
        assert_eq!(made.blocks[2].tag, Tag::Header);
        let ends: Vec<[f64; 2]> =
            made.blocks.iter().map(|own| own.shape.bounds()).map(|(low, high)| [low.y, high.y]).collect();
        assert_close(&ends.concat()[..4], &[0.0, 0.14, 0.0, 0.14]);
        assert_close(&ends[4], &[0.29, 0.5]);
        let spread = Unseen { core_share: Family::Uniform { low: 0.0, high: 0.3 }, ..unseen(0.0) };
        assert!(cored.is_fixed() && !spread.is_fixed());
    }

    #[test]
    fn marking_a_header_changes_no_other_stone() {
        let scattered = Unseen { depth_share: Family::Uniform { low: 0.3, high: 0.7 }, ..unseen(0.4) };
        for member in 0..20 {
            let made = |wall: &Wall| scattered.drawn(wall, &Streams::new(1, member)).unwrap();
            let mut marked = wall();
            marked.blocks[1].tag = Tag::Header;
            let (plain, marked) = (made(&wall()), made(&marked));
            for stone in [0, 2, 3] {
                assert_eq!(plain.blocks[stone], marked.blocks[stone], "member {member}");
            }
        }
    }

    #[test]
    fn the_parts_of_a_concave_stone_stay_together_in_front_and_behind() {
        let mut concave = wall();
        for part in [0, 2] {
            concave.blocks[part].group = Some("bracket".to_owned());
        }
        let scattered = Unseen { depth_share: Family::Uniform { low: 0.3, high: 0.7 }, ..unseen(0.0) };
        let made = drawn(&scattered, &concave);
        let depth = |at: usize| made.blocks[at].shape.bounds().1.y;
        assert_eq!(depth(0), depth(2), "one depth for both parts");
        assert_ne!(depth(0), depth(1));
        let groups: Vec<Option<&str>> = made.blocks.iter().map(|own| own.group.as_deref()).collect();
        let (front, behind) = (Some("bracket"), Some("bracket behind"));
        assert_eq!(groups, [front, None, front, None, behind, None, behind, None]);
    }

    #[test]
    fn beds_that_dip_leave_the_ground_level_and_the_volume_above_it() {
        let dipping = drawn(&Unseen { dip: constant(radians(5.0)), ..unseen(1.0) }, &wall());
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
