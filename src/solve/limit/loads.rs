//! Dead and live loads, and what they are as forces and moments on the blocks.

use crate::math::Vec3;
use crate::solve::STANDARD_GRAVITY;

/// Whether a load is there from the start or grows with the multiplier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// There from the start.
    Dead,
    /// Times the multiplier.
    Live,
}

/// A force at a point of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLoad {
    /// The block it acts on.
    pub block: usize,
    /// Where (m, world axes).
    pub point: Vec3,
    /// The force (N, world axes).
    pub force: Vec3,
    /// Dead or live.
    pub when: When,
}

/// The loads of a limit analysis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loads {
    /// Dead acceleration (m/s^2) on the mass of every block.
    pub dead: Vec3,
    /// Live acceleration (m/s^2) on the mass of every block at multiplier 1.
    pub live: Vec3,
    /// Forces at points.
    pub points: Vec<PointLoad>,
}

impl Loads {
    /// Self weight along -z, nothing live.
    pub fn weight() -> Self {
        Loads { dead: Vec3::new(0.0, 0.0, -STANDARD_GRAVITY), ..Loads::default() }
    }

    /// Self weight along -z, and lambda times the weight along `direction` (any length but zero).
    pub fn lateral(direction: Vec3) -> Self {
        Loads { live: direction.normalize() * STANDARD_GRAVITY, ..Loads::weight() }
    }

    /// The same with a vertical share: lambda times the weight along `direction`, and `vertical` lambda times the weight upwards.
    pub fn seismic(direction: Vec3, vertical: f64) -> Self {
        let lateral = Loads::lateral(direction);
        Loads { live: lateral.live + Vec3::z() * (vertical * STANDARD_GRAVITY), ..lateral }
    }

    /// The direction in which the live loads push on the whole; zero when nothing is live.
    pub(crate) fn push(&self) -> Vec3 {
        let points = self.points.iter().filter(|p| p.when == When::Live);
        if self.live.norm() > 0.0 { self.live } else { points.map(|p| p.force).sum() }
    }
}

/// A force and a moment about a block's centroid, or a velocity and a spin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Wrench {
    pub force: Vec3,
    pub moment: Vec3,
}

impl Wrench {
    /// Adds `force` with lever `lever` from the centroid.
    pub fn add(&mut self, lever: Vec3, force: Vec3) {
        self.force += force;
        self.moment += lever.cross(&force);
    }

    /// Both together.
    pub fn plus(&self, other: &Wrench) -> Wrench {
        Wrench { force: self.force + other.force, moment: self.moment + other.moment }
    }
}
