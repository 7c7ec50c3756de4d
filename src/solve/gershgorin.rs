//! A bound on the highest frequency of a body held by springs, for explicit time steps.

use crate::math::Vec3;
use crate::solve::bodies::Body;

/// The 6 x 6 stiffness of a body against fixed neighbours, in its principal axes, so that the bound is the same in every
/// frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct RowSums([[f64; 6]; 6]);

impl RowSums {
    /// Adds a spring of a stiffness (N/m) along a unit `axis`, `lever` from the body's centroid; both in the body's axes.
    pub fn add_spring(&mut self, lever: &Vec3, axis: &Vec3, stiffness: f64) {
        let moment = lever.cross(axis);
        self.add_row([axis.x, axis.y, axis.z, moment.x, moment.y, moment.z], stiffness);
    }

    /// Adds a spring that is stretched by `row` times displacement and turn, both in the body's axes.
    pub fn add_row(&mut self, row: [f64; 6], stiffness: f64) {
        for (ka, a) in self.0.iter_mut().zip(row) {
            for (kab, b) in ka.iter_mut().zip(row) {
                *kab += stiffness * a * b;
            }
        }
    }

    /// Gershgorin's (1931) bound on the largest eigenvalue (1/s^2) with the body's true mass and inertia: the largest sum of
    /// a row's sizes.
    pub fn bound(&self, body: &Body) -> f64 {
        let roots: [f64; 6] =
            std::array::from_fn(|n| if n < 3 { body.mass.sqrt() } else { body.inertia[n - 3].sqrt() });
        let sum = |row: &[f64; 6]| row.iter().zip(roots).fold(0.0, |sum, (x, root)| sum + x.abs() / root);
        self.0.iter().zip(roots).map(|(row, root)| sum(row) / root).fold(0.0, f64::max)
    }
}
