//! Where things of a DXF drawing lie: systems of axes of their own, blocks that are inserted, and the plane of the wall's face.

use crate::math::{cos, sin};

/// How much an axis across the face may vary, in parts of the shorter extent in the face.
const FLAT: f64 = 0.25;
/// What is as good as no extent, in parts of the drawing's size.
const NOTHING: f64 = 1e-9;

/// An affine map: where the axes go, and where the origin goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placing {
    axes: [[f64; 3]; 3],
    origin: [f64; 3],
}

impl Placing {
    /// The system of axes of a flat entity with this normal: x lies along the ground of the world (the file format's arbitrary axis rule).
    pub fn facing(normal: [f64; 3]) -> Placing {
        let n = unit(normal).unwrap_or([0.0, 0.0, 1.0]);
        let near_z = n[0].abs() < 1.0 / 64.0 && n[1].abs() < 1.0 / 64.0;
        let x = cross(if near_z { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] }, n);
        let x = unit(x).unwrap_or([1.0, 0.0, 0.0]);
        Placing { axes: [x, cross(n, x), n], origin: [0.0; 3] }
    }

    /// A block whose base point comes to `place`, scaled and turned about z (radians).
    pub fn inserted(base: [f64; 3], place: [f64; 3], scale: [f64; 3], turn: f64) -> Placing {
        let (s, c) = (sin(turn), cos(turn));
        let axes =
            [[c * scale[0], s * scale[0], 0.0], [-s * scale[1], c * scale[1], 0.0], [0.0, 0.0, scale[2]]];
        let turned = Placing { axes, origin: place };
        Placing { origin: turned.of(base.map(|x| -x)), ..turned }
    }

    /// This map after another one.
    pub fn after(&self, first: &Placing) -> Placing {
        let origin = self.of(first.origin);
        let direction = |axis: [f64; 3]| [0, 1, 2].map(|k| (0..3).map(|j| self.axes[j][k] * axis[j]).sum());
        Placing { axes: first.axes.map(direction), origin }
    }

    /// Where a point goes.
    pub fn of(&self, point: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| {
            self.origin[k]
                + (self.axes[0][k] * point[0] + self.axes[1][k] * point[1] + self.axes[2][k] * point[2])
        })
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|x| x / length))
}

/// The two axes of the face, the upright one last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub axes: [usize; 2],
    /// How far the drawing reaches along the axes of the face and across it.
    pub extents: [f64; 3],
}

impl Plane {
    /// Of a drawing with these points: the axis along which it reaches least goes across the face, z rather than another one.
    pub fn of<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> Plane {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for point in points.filter(|point| point.iter().all(|x| x.is_finite())) {
            low = [0, 1, 2].map(|k| low[k].min(point[k]));
            high = [0, 1, 2].map(|k| high[k].max(point[k]));
        }
        let extent = [0, 1, 2].map(|k| (high[k] - low[k]).max(0.0));
        let size = extent.iter().copied().fold(0.0, f64::max);
        let axes = if extent[2] <= NOTHING * size || (extent[2] <= extent[1] && extent[2] <= extent[0]) {
            [0, 1]
        } else if extent[1] <= extent[0] {
            [0, 2]
        } else {
            [1, 2]
        };
        let across = 3 - axes[0] - axes[1];
        Plane { axes, extents: [extent[axes[0]], extent[axes[1]], extent[across]] }
    }

    /// A point in the face.
    pub fn point(&self, point: &[f64; 3]) -> [f64; 2] {
        self.axes.map(|axis| point[axis])
    }

    /// Whether points lie beside the plane at all.
    pub fn is_rough(&self) -> bool {
        let [along, up, across] = self.extents;
        across > NOTHING * along.max(up)
    }

    /// Whether the drawing is no face but a body.
    pub fn is_body(&self) -> bool {
        let [along, up, across] = self.extents;
        across > FLAT * along.min(up)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_entity_that_faces_the_viewer_has_z_upwards() {
        let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-12);
        assert!(near(Placing::facing([0.0, -1.0, 0.0]).of([2.0, 3.0, 0.5]), [2.0, -0.5, 3.0]));
        assert!(near(Placing::facing([0.0, 0.0, -1.0]).of([2.0, 3.0, 0.0]), [-2.0, 3.0, 0.0]));
        assert_eq!(Placing::facing([0.0; 3]).of([2.0, 3.0, 4.0]), [2.0, 3.0, 4.0]);
        let quarter = std::f64::consts::FRAC_PI_2;
        let block = Placing::inserted([1.0, 0.0, 0.0], [5.0, 5.0, 0.0], [2.0, 2.0, 1.0], quarter);
        assert!(near(block.of([2.0, 0.0, 0.0]), [5.0, 7.0, 0.0]));
        assert!(near(block.after(&block).of([2.0, 0.0, 0.0]), [-9.0, 13.0, 0.0]));
    }

    #[test]
    fn the_axis_with_the_least_extent_goes_across() {
        let plane = |points: &[[f64; 3]]| Plane::of(points.iter());
        assert_eq!(plane(&[[0.0, 0.0, 7.0], [3.0, 2.0, 7.0]]).axes, [0, 1]);
        assert_eq!(plane(&[[0.0, 5.0, 0.0], [3.0, 5.0, 2.0]]).axes, [0, 2]);
        assert_eq!(plane(&[[1.0, 5.0, 0.0], [1.0, 9.0, 2.0]]).axes, [1, 2]);
        assert!(!plane(&[[0.0, 5.0, 0.0], [3.0, 5.0, 2.0]]).is_rough());
        assert!(plane(&[[0.0; 3], [3.0, 2.0, 0.9]]).is_body());
        assert_eq!(plane(&[]).extents, [0.0; 3]);
    }
}
