//! A platform on springs: it settles and turns about its centre line, and carries with it what is fixed to it.

use crate::math::{Mat3, Vec3, atan2};
use crate::solve::bodies::Body;

/// The springs of a platform that moves up and down and turns about x, both about its centroid; its own weight does not act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mount {
    /// The platform.
    pub body: usize,
    /// Stiffness against settling (N/m).
    pub settlement: f64,
    /// Stiffness against turning about x (N m/rad).
    pub rotation: f64,
}

/// A platform on its springs.
#[derive(Clone, Debug)]
pub struct Mounted {
    /// The springs.
    pub mount: Mount,
    /// Height of its centroid (m) and its attitude where the springs are without force.
    height: f64,
    built: Mat3,
}

impl Mounted {
    /// Without force where the body is now.
    pub fn new(mount: Mount, body: &Body) -> Mounted {
        Mounted { mount, height: body.position.z, built: body.rotation }
    }

    /// Adds force and moment of the springs to the platform.
    pub fn apply(&self, body: &mut Body) {
        let turned = body.rotation * self.built.transpose();
        let angle = atan2(turned[(2, 1)], turned[(1, 1)]);
        body.force.z -= self.mount.settlement * (body.position.z - self.height);
        body.torque += Vec3::x() * (-self.mount.rotation * angle);
    }

    /// Their stiffness by displacement and turn: the diagonal alone.
    pub fn stiffness(&self) -> [f64; 6] {
        [0.0, 0.0, self.mount.settlement, self.mount.rotation, 0.0, 0.0]
    }
}
