//! Planes and the in-plane frames that joints live in.

use crate::math::Vec3;

/// The plane `normal . x = offset`, with a unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal.
    pub normal: Vec3,
    /// Distance of the plane from the origin along the normal (m).
    pub offset: f64,
}

impl Plane {
    /// The plane through `point` with the direction `normal` (any length but zero).
    pub fn through(point: Vec3, normal: Vec3) -> Self {
        let normal = normal.normalize();
        Plane { normal, offset: normal.dot(&point) }
    }

    /// Signed distance of `point` (m), positive on the side the normal points to.
    pub fn distance(&self, point: &Vec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// The same plane seen from the other side.
    pub fn flipped(&self) -> Self {
        Plane { normal: -self.normal, offset: -self.offset }
    }
}

/// A right-handed frame on a plane: `s` and `t` span it, `normal = s x t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Origin of the plane coordinates.
    pub origin: Vec3,
    /// First in-plane axis.
    pub s: Vec3,
    /// Second in-plane axis.
    pub t: Vec3,
    /// Unit normal.
    pub normal: Vec3,
}

impl Frame {
    /// A frame at `origin` on the plane with unit `normal`; `s` is the world axis least aligned with the normal
    /// projected on the plane, so the choice is the same for the same input on every machine.
    pub fn on_plane(origin: Vec3, normal: Vec3) -> Self {
        let n = normal.abs();
        let axis = if n.x <= n.y && n.x <= n.z {
            Vec3::x()
        } else if n.y <= n.z {
            Vec3::y()
        } else {
            Vec3::z()
        };
        let s = (axis - normal * axis.dot(&normal)).normalize();
        Frame { origin, s, t: normal.cross(&s), normal }
    }

    /// Plane coordinates (s, t) of the foot of `point` on the plane.
    pub fn project(&self, point: &Vec3) -> [f64; 2] {
        let d = point - self.origin;
        [d.dot(&self.s), d.dot(&self.t)]
    }

    /// The world position of plane coordinates (s, t).
    pub fn lift(&self, st: [f64; 2]) -> Vec3 {
        self.origin + self.s * st[0] + self.t * st[1]
    }
}
