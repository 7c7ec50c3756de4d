//! Convex hulls of points in the plane.

use crate::shape::polygon::sides;

/// A convex hull: its corners counter-clockwise, without points on its sides; of points on one line its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    /// The corners.
    pub corners: Vec<[f64; 2]>,
}

impl Hull {
    /// Of points (Andrew 1979, monotone chains).
    pub fn of(mut points: Vec<[f64; 2]>) -> Hull {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        points.dedup();
        if points.len() < 3 {
            return Hull { corners: points };
        }
        let mut corners = chain(points.iter());
        corners.extend(chain(points.iter().rev()));
        Hull { corners }
    }

    /// Distance (m) of a point inside from the nearest side. Below 0 outside, and of a hull without area.
    pub fn depth(&self, point: [f64; 2]) -> f64 {
        if self.corners.len() < 3 {
            return f64::NEG_INFINITY;
        }
        sides(&self.corners).map(|side| beyond(side, point)).fold(f64::INFINITY, f64::min)
    }

    /// The least width (m) of all directions, which is across one of its sides; 0 without area.
    pub fn width(&self) -> f64 {
        if self.corners.len() < 3 {
            return 0.0;
        }
        let across = |side| self.corners.iter().map(|corner| beyond(side, *corner)).fold(0.0, f64::max);
        sides(&self.corners).map(across).fold(f64::INFINITY, f64::min)
    }
}

/// How far (m) a point is to the left of a side.
fn beyond([from, to]: [[f64; 2]; 2], point: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    turn(from, to, point) / (along[0] * along[0] + along[1] * along[1]).sqrt()
}

/// Twice the area of a triangle, positive where it goes to the left.
pub(super) fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// One side of the hull of points in their order, without its last corner.
fn chain<'p>(points: impl Iterator<Item = &'p [f64; 2]>) -> Vec<[f64; 2]> {
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for point in points {
        while let [.., a, b] = corners[..]
            && turn(a, b, *point) <= 0.0
        {
            corners.pop();
        }
        corners.push(*point);
    }
    corners.pop();
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_knows_how_deep_a_point_lies_and_how_wide_it_is() {
        // A rectangle of 4 x 2 m turned by atan(3 / 4), with points inside and on a side.
        let turned = |x: f64, y: f64| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y];
        let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0), (2.0, 1.0), (2.0, 0.0), (4.0, 2.0)];
        let hull = Hull::of(points.map(|(x, y)| turned(x, y)).to_vec());
        assert!((hull.width() - 2.0).abs() < 1e-12, "{hull:?}");
        assert!((hull.depth(turned(1.0, 0.5)) - 0.5).abs() < 1e-12, "{hull:?}");
        assert!((hull.depth(turned(5.0, 1.0)) + 1.0).abs() < 1e-12, "{hull:?}");
    }

    #[test]
    fn points_on_a_line_have_no_inside() {
        let line = Hull::of(vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]);
        assert_eq!((line.width(), line.depth([1.0, 1.0])), (0.0, f64::NEG_INFINITY));
        assert_eq!(Hull::of(Vec::new()).width(), 0.0);
    }
}
