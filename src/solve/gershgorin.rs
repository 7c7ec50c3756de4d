//! A bound on the highest frequency of a body held by springs, for explicit time steps.

use crate::math::Vec3;
use crate::solve::bodies::Body;

/// The 6 x 6 stiffness of a body against fixed neighbours, over its true mass and inertia and in its principal axes, so
/// that the bound is the same in every frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct RowSums([[f64; 6]; 6]);

impl RowSums {
    /// Adds a spring of a stiffness (N/m) along a unit `axis`, `lever` from the body's centroid; both in the body's axes.
    pub fn add_spring(&mut self, body: &Body, lever: &Vec3, axis: &Vec3, stiffness: f64) {
        let moment = lever.cross(axis);
        self.add_row(body, [axis.x, axis.y, axis.z, moment.x, moment.y, moment.z], stiffness);
    }

    /// Adds a spring that is stretched by `row` times displacement and turn, both in the body's axes.
    pub fn add_row(&mut self, body: &Body, row: [f64; 6], stiffness: f64) {
        let root = |n: usize| if n < 3 { body.mass.sqrt() } else { body.inertia[n - 3].sqrt() };
        for (a, ka) in self.0.iter_mut().enumerate() {
            for (b, kab) in ka.iter_mut().enumerate() {
                *kab += stiffness * row[a] * row[b] / (root(a) * root(b));
            }
        }
    }

    /// Gershgorin's (1931) bound on the largest eigenvalue (1/s^2): the largest sum of a row's sizes.
    pub fn bound(&self) -> f64 {
        self.0.iter().map(|row| row.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
    }
}
