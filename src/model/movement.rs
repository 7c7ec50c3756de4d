//! The movement of a rigid block.

use crate::math::{Mat3, Vec3, cos, sin};

/// A movement of a rigid block: it turns about its centroid, which shifts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement {
    /// Displacement of the centroid (m).
    pub shift: Vec3,
    /// Rotation vector about the centroid (rad, world axes).
    pub turn: Vec3,
}

impl Movement {
    /// None.
    pub const NONE: Movement = Movement { shift: Vec3::new(0.0, 0.0, 0.0), turn: Vec3::new(0.0, 0.0, 0.0) };

    /// The same movement `factor` times as large.
    pub fn times(&self, factor: f64) -> Movement {
        Movement { shift: self.shift * factor, turn: self.turn * factor }
    }

    /// Where it takes points of a block with a centroid (m).
    pub fn taking(&self, centroid: Vec3, points: &[Vec3]) -> Vec<Vec3> {
        let turn = self.rotation();
        points.iter().map(|point| centroid + self.shift + turn * (point - centroid)).collect()
    }

    /// By how much it displaces points of a block with a centroid (m); exactly the shift where nothing turns.
    pub fn displacing(&self, centroid: Vec3, points: &[Vec3]) -> Vec<Vec3> {
        let turn = self.rotation();
        let of = |point: &Vec3| {
            let arm = point - centroid;
            self.shift + (turn * arm - arm)
        };
        points.iter().map(of).collect()
    }

    /// The rotation: Rodrigues' formula.
    pub fn rotation(&self) -> Mat3 {
        let angle = self.turn.norm();
        if angle == 0.0 {
            return Mat3::identity();
        }
        let cross = (self.turn / angle).cross_matrix();
        Mat3::identity() + cross * sin(angle) + cross * cross * (1.0 - cos(angle))
    }
}
