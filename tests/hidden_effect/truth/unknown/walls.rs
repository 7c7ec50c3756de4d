//! Effects outside the catalogue that act on walls.

use pirca::law::Coulomb;
use pirca::math::{Vec3, cos, exp, radians, sin};
use pirca::model::Wall;
use pirca::protocol::{Ends, Restraint};
use pirca::random::Streams;
use pirca::random::standard_normal::quantile;
use pirca::study::Study;

use crate::truth::effect::{Effect, Place};

/// A course is about so high (m).
const COURSE: f64 = 0.05;

/// The law with another stiffness, in shear as well.
fn scaled(law: Coulomb, factor: f64) -> Coulomb {
    Coulomb { normal: law.normal.scaled(factor), ks: factor * law.ks, ..law }
}

pub struct SoftCourse {
    pub height: f64,
    pub share: f64,
}

impl Effect for SoftCourse {
    fn law(&self, law: Coulomb, place: &Place, _: &Streams) -> Coulomb {
        let above = place.middle().z - place.wall[0].z - self.height;
        if (0.0..COURSE).contains(&above) { scaled(law, self.share) } else { law }
    }
}

pub struct SoftLeft {
    pub share: f64,
}

impl Effect for SoftLeft {
    fn law(&self, law: Coulomb, place: &Place, _: &Streams) -> Coulomb {
        let [low, high] = place.wall;
        let along = (place.middle().x - low.x) / (high.x - low.x);
        if along < 1.0 / 3.0 { scaled(law, self.share) } else { law }
    }
}

pub struct SkewAxis {
    pub angle_deg: f64,
}

impl Effect for SkewAxis {
    fn wall(&self, mut wall: Wall, _: &Streams) -> Wall {
        let (low, high) = wall.bounds();
        let middle = 0.5 * (low.x + high.x);
        let (c, s) = (cos(radians(self.angle_deg)), sin(radians(self.angle_deg)));
        for v in wall.blocks.iter_mut().flat_map(|block| &mut block.shape.vertices) {
            let x = v.x - middle;
            *v = Vec3::new(middle + c * x - s * v.y, s * x + c * v.y, v.z);
        }
        wall
    }
}

pub struct HeavyTailedJoints {
    pub ln_sd: f64,
}

impl Effect for HeavyTailedJoints {
    fn law(&self, law: Coulomb, place: &Place, streams: &Streams) -> Coulomb {
        let score = quantile(place.uniform(streams, "heavy tail"));
        scaled(law, exp(self.ln_sd * score - 0.5 * self.ln_sd * self.ln_sd))
    }

    fn differs(&self) -> bool {
        true
    }
}

pub struct LightTop {
    pub share: f64,
}

impl Effect for LightTop {
    fn wall(&self, mut wall: Wall, _: &Streams) -> Wall {
        let (low, high) = wall.bounds();
        let middle = 0.5 * (low.z + high.z);
        for block in &mut wall.blocks {
            let (from, to) = block.shape.bounds();
            if 0.5 * (from.z + to.z) > middle {
                block.density *= self.share;
            }
        }
        wall
    }
}

pub struct TautRopes {
    pub pretension: f64,
}

impl Effect for TautRopes {
    fn restraint(&self, mut restraint: Restraint) -> Restraint {
        if let Ends::Ropes(rope) = &mut restraint.ends {
            rope.pretension += self.pretension;
        }
        restraint
    }
}

pub struct ThinWall {
    pub share: f64,
}

impl Effect for ThinWall {
    fn study(&self, mut study: Study) -> Study {
        for outline in study.arms.iter_mut().map(|arm| &mut arm.layout.outline) {
            outline.base_thickness *= self.share;
            outline.top_thickness *= self.share;
        }
        study
    }
}
