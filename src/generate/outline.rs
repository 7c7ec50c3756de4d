//! The solid that stones are cut from, and what a stone of it must at least be.

use crate::generate::{BatteredFace, Limits, Outline};
use crate::math::Vec3;
use crate::shape::Polyhedron;

impl Outline {
    /// The y of the back and of the front face at height `z` (m).
    pub fn faces_at(&self, z: f64) -> [f64; 2] {
        let lean = (self.base_thickness - self.top_thickness) * (z / self.height);
        let (back, front) = match self.battered_face {
            BatteredFace::Front => (0.0, 1.0),
            BatteredFace::Back => (1.0, 0.0),
            BatteredFace::Both => (0.5, 0.5),
        };
        [-0.5 * self.base_thickness + back * lean, 0.5 * self.base_thickness - front * lean]
    }

    /// The y of the middle between the two faces at height `z` (m).
    pub fn middle_at(&self, z: f64) -> f64 {
        let [back, front] = self.faces_at(z);
        0.5 * (back + front)
    }

    /// The whole wall as one solid.
    pub fn solid(&self) -> Polyhedron {
        let ([b0, f0], [b1, f1]) = (self.faces_at(0.0), self.faces_at(self.height));
        let (l, h) = (self.length, self.height);
        Polyhedron::hexahedron([
            Vec3::new(0.0, b0, 0.0),
            Vec3::new(l, b0, 0.0),
            Vec3::new(l, f0, 0.0),
            Vec3::new(0.0, f0, 0.0),
            Vec3::new(0.0, b1, h),
            Vec3::new(l, b1, h),
            Vec3::new(l, f1, h),
            Vec3::new(0.0, f1, h),
        ])
    }

    /// Area of the section (m^2).
    pub fn section_area(&self) -> f64 {
        0.5 * (self.base_thickness + self.top_thickness) * self.height
    }

    /// Volume (m^3).
    pub fn volume(&self) -> f64 {
        self.section_area() * self.length
    }

    /// Whether all four measures are finite and positive.
    pub(crate) fn has_volume(&self) -> bool {
        [self.length, self.height, self.base_thickness, self.top_thickness]
            .iter()
            .all(|measure| measure.is_finite() && *measure > 0.0)
    }
}

/// Why a piece is no stone.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(crate) enum StoneFault {
    #[error("a stone is {width:.4} m thin, the limit is {limit} m")]
    Thin { width: f64, limit: f64 },
    #[error("a stone has aspect {aspect:.2}, the limit is {limit}")]
    Slender { aspect: f64, limit: f64 },
    #[error("nothing is left of a stone between its head joints")]
    Vanished,
}

impl Limits {
    /// Checks an ordinary stone: smallest width and aspect. Wedge stones have a sharp edge by nature and are judged
    /// by their volume instead.
    pub(crate) fn check(&self, stone: &Polyhedron) -> Result<(), StoneFault> {
        let width = stone.smallest_width();
        if width < self.min_size {
            return Err(StoneFault::Thin { width, limit: self.min_size });
        }
        let aspect = stone.diameter() / width;
        if aspect > self.max_aspect {
            return Err(StoneFault::Slender { aspect, limit: self.max_aspect });
        }
        Ok(())
    }
}
