//! The axonometric view: which way the viewer looks, and where a point lies in the picture.

use crate::math::{Vec3, cos, radians, sin};

/// The viewer stands so far to the side of the wall's face (deg) and so far above the ground (deg).
const ASIDE_DEG: f64 = 32.0;
const ABOVE_DEG: f64 = 20.0;

/// The wall's axes.
const X: Vec3 = Vec3::new(1.0, 0.0, 0.0);
const Y: Vec3 = Vec3::new(0.0, 1.0, 0.0);
const Z: Vec3 = Vec3::new(0.0, 0.0, 1.0);

/// A view from far away: parallel lines stay parallel, and lengths across the line of sight stay true.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Unit vector to the right of the picture.
    pub right: Vec3,
    /// Unit vector up in the picture.
    pub up: Vec3,
    /// Unit vector from the wall to the viewer.
    pub viewer: Vec3,
}

impl View {
    /// Square on the face, towards +y: x to the right, z up.
    pub const FACE: View = View { right: X, up: Z, viewer: Vec3::new(0.0, -1.0, 0.0) };
    /// Square on the end, towards -x: y to the right, z up.
    pub const END: View = View { right: Y, up: Z, viewer: X };
    /// From above: x to the right, y up.
    pub const PLAN: View = View { right: X, up: Y, viewer: Z };

    /// From the front (+y) or the back of a wall; in both the viewer's left end of the wall is the nearer one.
    pub fn on(front: bool) -> View {
        let aside = radians(ASIDE_DEG) + if front { 0.0 } else { std::f64::consts::PI };
        View::from(aside, radians(ABOVE_DEG))
    }

    /// From a side `aside` (rad, from +y towards +x) and a height `above` the horizon (rad, below a right angle).
    pub fn from(aside: f64, above: f64) -> View {
        let [(sa, ca), (se, ce)] = [aside, above].map(|angle| (sin(angle), cos(angle)));
        View {
            right: Vec3::new(-ca, sa, 0.0),
            up: Vec3::new(-se * sa, -se * ca, ce),
            viewer: Vec3::new(ce * sa, ce * ca, se),
        }
    }

    /// Where a point lies: to the right and up (m).
    pub fn place(&self, point: &Vec3) -> [f64; 2] {
        [self.right.dot(point), self.up.dot(point)]
    }

    /// How near a point is to the viewer (m, from the plane of the picture through the origin).
    pub fn nearness(&self, point: &Vec3) -> f64 {
        self.viewer.dot(point)
    }

    /// Whether a face with this outward normal is seen.
    pub fn sees(&self, normal: &Vec3) -> bool {
        normal.dot(&self.viewer) > 0.0
    }

    /// Brightness, 0 to 1, of a face with this outward unit normal: light from the viewer's side and from above.
    pub fn brightness(&self, normal: &Vec3) -> f64 {
        let light = (0.7 * self.viewer + 0.3 * self.right + 0.6 * Vec3::z()).normalize();
        0.5 + 0.5 * normal.dot(&light).max(0.0)
    }
}
