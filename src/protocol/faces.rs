//! The back of a wall: faces of its stones with nothing behind them, and pressures over them that grow with the depth.

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::observe::movable;
use crate::shape::{Frame, Moments, Polygon};

/// A face of a stone, or the part of it below some height.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Face {
    /// The stone.
    pub block: usize,
    /// Its plane; the origin is the mean of the face's corners, the normal points out of the stone.
    pub frame: Frame,
    outline: Polygon,
}

/// The faces of stones that can move which look against a direction, with no stone behind their middle: the back of a wall that is pushed there. Within 45 degrees: a bed that
/// leans is no back.
pub(super) fn faces_against(wall: &Wall, towards: Vec3) -> Vec<Face> {
    let mut faces = Vec::new();
    for (block, stone) in movable(wall) {
        for face in 0..stone.shape.faces.len() {
            let plane = stone.shape.face_plane(face);
            let centre = stone.shape.face_vertices(face).sum::<Vec3>() / stone.shape.faces[face].len() as f64;
            if plane.normal.dot(&towards) > -0.5f64.sqrt() || is_covered(wall, block, centre, -towards) {
                continue;
            }
            let frame = Frame::on_plane(centre, plane.normal);
            let vertices = stone.shape.face_vertices(face).map(|v| frame.project(&v)).collect();
            faces.push(Face { block, frame, outline: Polygon { vertices } });
        }
    }
    faces
}

impl Face {
    /// Its part below a height (m); `None` where there is none.
    pub fn below(&self, height: f64) -> Option<Face> {
        let Frame { origin, s, t, .. } = self.frame;
        let outline = self.outline.clip(origin.z - height, s.z, t.z);
        (outline.vertices.len() > 2).then(|| Face { outline, ..self.clone() })
    }

    /// The integral (N) over the face of a pressure that is `middle` (Pa) at the height of the frame's origin and grows upwards by `upwards` (Pa/m), and the
    /// point at which it acts; exact for a polygon. `None` where nothing presses.
    pub fn pressed(&self, middle: f64, upwards: f64) -> Option<(f64, Vec3)> {
        let m = self.moments();
        // p = middle + ps s + pt t on the face.
        let (ps, pt) = (upwards * self.frame.s.z, upwards * self.frame.t.z);
        let total = middle * m.area + ps * m.s + pt * m.t;
        if total == 0.0 {
            return None;
        }
        let by_s = middle * m.s + ps * m.ss + pt * m.st;
        let by_t = middle * m.t + ps * m.st + pt * m.tt;
        Some((total, self.frame.lift([by_s / total, by_t / total])))
    }

    /// The middle of its area.
    pub fn middle(&self) -> Vec3 {
        self.frame.lift(self.moments().centroid())
    }

    /// Area and moments in its plane.
    pub fn moments(&self) -> Moments {
        self.outline.moments()
    }

    /// Its lowest and its highest corner (m).
    pub fn heights(&self) -> [f64; 2] {
        let heights = self.outline.vertices.iter().map(|&st| self.frame.lift(st).z);
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
    }
}

/// Whether a stone lies before a point, seen along a direction: a ray meets it.
pub(super) fn is_covered(wall: &Wall, own: usize, point: Vec3, direction: Vec3) -> bool {
    wall.stones().filter(|(id, _)| *id != own).any(|(_, other)| {
        let (mut from, mut to) = (0.0f64, f64::INFINITY);
        for face in 0..other.shape.faces.len() {
            let plane = other.shape.face_plane(face);
            let (distance, rate) = (plane.distance(&point), plane.normal.dot(&direction));
            if rate > 0.0 {
                to = to.min(-distance / rate);
            } else if rate < 0.0 {
                from = from.max(-distance / rate);
            } else if distance > 0.0 {
                return false;
            }
        }
        from < to
    })
}
