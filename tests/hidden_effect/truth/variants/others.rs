//! Mechanisms that act on stones, platform, time and gauges, written another way.

use pirca::math::{Vec3, exp};
use pirca::model::{Tag, Wall};
use pirca::random::Streams;
use pirca::shape::{Plane, Polyhedron};
use pirca::study::Study;

use crate::truth::effect::{Effect, Specimen, normal};
use crate::truth::readings::Series;

/// Vertices nearer than this to a cut lie on it (m).
const ON_PLANE: f64 = 1e-9;
/// Deviation from stone to stone of a density (COV).
const DENSITY_COV: f64 = 0.1;

/// Arrises that are cut off the stones, instead of joints that end before the edge. Stones keep their weight.
pub struct Chamfer {
    pub leg: f64,
}

impl Effect for Chamfer {
    fn wall(&self, mut wall: Wall, _: &Streams) -> Wall {
        for block in wall.blocks.iter_mut().filter(|block| block.tag != Tag::Wedge) {
            let before = block.shape.volume();
            block.shape = chamfered(&block.shape, self.leg);
            block.density *= before / block.shape.volume();
        }
        wall
    }
}

/// A stone less a prism with legs of this length (m) along each edge.
fn chamfered(stone: &Polyhedron, leg: f64) -> Polyhedron {
    let mut cuts = Vec::new();
    for (first, corners) in stone.faces.iter().enumerate() {
        for (k, &from) in corners.iter().enumerate() {
            let to = corners[(k + 1) % corners.len()];
            let shares = |face: &Vec<u32>| face.contains(&from) && face.contains(&to);
            let Some(second) = (first + 1..stone.faces.len()).find(|&face| shares(&stone.faces[face])) else {
                continue;
            };
            let [a, b] = [first, second].map(|face| stone.face_plane(face).normal);
            // A leg along a face goes so deep behind the edge, seen along the bisector.
            let depth = leg * (0.5 * (1.0 - a.dot(&b))).max(0.0).sqrt();
            let edge: Vec3 = stone.vertices[from as usize];
            let normal = (a + b).normalize();
            cuts.push(Plane { normal, offset: normal.dot(&edge) - depth });
        }
    }
    let cut = |stone: Polyhedron, plane: &Plane| stone.cut(plane, ON_PLANE).0.unwrap_or(stone);
    cuts.iter().fold(stone.clone(), cut)
}

/// Stones whose densities differ, with the factor as their mean.
pub struct DensityByStone {
    pub factor: f64,
}

impl Effect for DensityByStone {
    fn wall(&self, mut wall: Wall, streams: &Streams) -> Wall {
        for (id, block) in wall.blocks.iter_mut().enumerate() {
            let score = normal(&mut streams.of(&format!("hidden density {id}")));
            block.density *= self.factor * (1.0 + DENSITY_COV * score.clamp(-3.0, 3.0));
        }
        wall
    }

    fn differs(&self) -> bool {
        true
    }
}

/// A platform that is out of level from the start, instead of a wall that is out of plumb.
pub struct TurnedGravity {
    pub angle: f64,
}

impl Effect for TurnedGravity {
    fn tilt(&self, shown: f64) -> f64 {
        shown + self.angle
    }

    fn shown(&self, tilt: f64) -> f64 {
        tilt - self.angle
    }
}

/// Shear tractions that relax at the stops alone, by all that they would have lost on the way.
pub struct CreepAtStops {
    pub rate_per_deg: f64,
    pub hold_share: f64,
    pub every_deg: f64,
}

impl Effect for CreepAtStops {
    fn study(&self, study: Study) -> Study {
        let share = 1.0 - (1.0 - self.hold_share) * exp(-self.rate_per_deg * self.every_deg);
        let values =
            [("rate_per_deg", 0.0), ("hold_share", share.min(0.99)), ("hold_every_deg", self.every_deg)];
        study.with_mechanism("creep", &values).unwrap_or_else(|faults| panic!("{faults}")).study
    }
}

/// Every point of every specimen has a shift of its own, half as different as they are large.
pub struct OffsetByPoint {
    pub mean: f64,
}

impl Effect for OffsetByPoint {
    fn read(&self, series: &mut Series, specimen: &Specimen) {
        let mut stream = specimen.streams.of("hidden offset");
        let own: [f64; 3] = std::array::from_fn(|_| self.mean * (1.0 + 0.5 * normal(&mut stream)));
        series.points.iter_mut().skip(1).for_each(|points| (0..3).for_each(|k| points[k] += own[k]));
    }
}

/// Every point of every specimen has a gauge of its own, whose factors differ half as much as they are off.
pub struct ScaleByPoint {
    pub mean: f64,
}

impl Effect for ScaleByPoint {
    fn read(&self, series: &mut Series, specimen: &Specimen) {
        let mut stream = specimen.streams.of("hidden scale");
        let off = self.mean - 1.0;
        let own: [f64; 3] = std::array::from_fn(|_| 1.0 + off * (1.0 + 0.5 * normal(&mut stream)));
        series.points.iter_mut().for_each(|points| (0..3).for_each(|k| points[k] *= own[k]));
    }
}
