//! Convex outlines without the sides that are details alone.

use crate::face::line::Line;
use crate::shape::{Polygon, bounds};

/// Corners that lie within this share of a polygon's size of a straight side are on it: rounding.
const ROUNDING: f64 = 1e-9;
/// Sides with a smaller sine between them are parallel, and meet nowhere.
const PARALLEL: f64 = 1e-6;

/// A convex polygon around another one, with as few sides as leave no corner further than `grain` (m) outside of it. The steps of pixels along a
/// straight side are one side so.
pub fn simplified(polygon: &Polygon, grain: f64) -> Polygon {
    let mut corners = polygon.vertices.clone();
    straightened(&mut corners);
    while corners.len() > 4 {
        let n = corners.len();
        let without = (0..n).filter_map(|k| Some((k, sharpened(&corners, k, grain)?)));
        let least = without.min_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let Some((side, (corner, _))) = least else { break };
        // The side from `side` to the next corner goes; both are one corner now.
        corners[side] = corner;
        corners.remove((side + 1) % n);
    }
    Polygon { vertices: corners }
}

/// Leaves out corners that rounding makes on straight sides.
pub fn straightened(corners: &mut Vec<[f64; 2]>) {
    let [left, low, right, high] = bounds(&*corners);
    let rounding = ROUNDING * (right - left).max(high - low);
    let mut at = 0;
    while at < corners.len() && corners.len() > 3 {
        let n = corners.len();
        let chord = Line::side([corners[(at + n - 1) % n], corners[(at + 1) % n]]);
        if chord.is_none_or(|chord| chord.beyond(corners[at]) <= rounding) {
            corners.remove(at);
        } else {
            at += 1;
        }
    }
}

/// Where the neighbours of a side meet without it, and how far (m) that is outside of it; `None` beyond `grain`.
fn sharpened(corners: &[[f64; 2]], side: usize, grain: f64) -> Option<([f64; 2], f64)> {
    let n = corners.len();
    let at = |k: usize| corners[(side + n + k - 1) % n];
    let (before, own, after) =
        (Line::side([at(0), at(1)])?, Line::side([at(1), at(2)])?, Line::side([at(2), at(3)])?);
    let turn = before.normal[0] * after.normal[1] - before.normal[1] * after.normal[0];
    if turn <= PARALLEL {
        return None;
    }
    let corner = [
        (before.offset * after.normal[1] - after.offset * before.normal[1]) / turn,
        (after.offset * before.normal[0] - before.offset * after.normal[0]) / turn,
    ];
    let out = own.beyond(corner);
    (out <= grain).then_some((corner, out))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_pixels_are_one_side_and_true_corners_stay() {
        // A square with a corner cut by one, and bulges of 0.2 in the middle of two sides.
        let drawn =
            [[0.0, 0.0], [9.0, 0.0], [10.0, 1.0], [10.0, 10.0], [5.0, 10.2], [0.0, 10.0], [-0.2, 5.0]];
        let simple = simplified(&Polygon { vertices: drawn.to_vec() }, 0.5);
        assert_eq!(simple.vertices.len(), 5, "{simple:?}");
        assert!(simple.area() >= Polygon { vertices: drawn.to_vec() }.area());
        assert_eq!(simplified(&simple, 0.0), simple);
    }

    #[test]
    fn corners_that_rounding_makes_are_left_out() {
        let third = |k: f64| [k / 3.0, k / 3.0 * 0.1];
        let drawn = [third(0.0), third(1.0), third(2.0), third(3.0), [1.0, 1.0], [0.5, 1.0], [0.0, 1.0]];
        let simple = simplified(&Polygon { vertices: drawn.to_vec() }, 0.01);
        assert_eq!(simple.vertices.len(), 4, "{simple:?}");
        assert!(simple.vertices.iter().all(|v| (-1e-9..1.0 + 1e-9).contains(&v[0])), "{simple:?}");
    }
}
