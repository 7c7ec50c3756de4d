//! The points at which rigid blocks touch: the corners of a joint's polygon, with their shares of its area.

use crate::shape::Polygon;

/// The middle line of the strip along an edge, which begins at the frame's origin; or the origin, about which the
/// square of a point contact is centred.
pub fn middle_line(polygon: &Polygon) -> Polygon {
    let low = polygon.vertices.iter().map(|v| v[0]).fold(f64::INFINITY, f64::min);
    let high = polygon.vertices.iter().map(|v| v[0]).fold(f64::NEG_INFINITY, f64::max);
    Polygon { vertices: if low < 0.0 { vec![[0.0, 0.0]] } else { vec![[low, 0.0], [high, 0.0]] } }
}

/// Neighbouring vertices that are the same point but for rounding, once.
pub fn distinct(vertices: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let extent = vertices.iter().flatten().fold(0.0, |e: f64, x| e.max(x.abs()));
    let same = |p: &[f64; 2], q: &[f64; 2]| (p[0] - q[0]).abs().max((p[1] - q[1]).abs()) <= 1e-12 * extent;
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(vertices.len());
    for v in vertices {
        if kept.last().is_none_or(|last| !same(last, &v)) {
            kept.push(v);
        }
    }
    while kept.len() > 1 && same(&kept[0], &kept[kept.len() - 1]) {
        kept.pop();
    }
    kept
}

/// Half of the two triangles that each vertex spans with its neighbours and the centroid: the shares sum up to the area,
/// and their first moment is that of the area.
pub fn area_shares(vertices: &[[f64; 2]]) -> Vec<f64> {
    let n = vertices.len();
    let c = Polygon { vertices: vertices.to_vec() }.moments().centroid();
    let triangle = |i: usize| {
        let (p, q) = (vertices[i], vertices[(i + 1) % n]);
        0.5 * ((p[0] - c[0]) * (q[1] - c[1]) - (p[1] - c[1]) * (q[0] - c[0]))
    };
    (0..n).map(|i| if n < 3 { 0.0 } else { 0.5 * (triangle(i) + triangle((i + n - 1) % n)) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn shares_of_the_area_keep_its_sum_and_its_centroid() {
        let polygon = [[0.1, 0.0], [0.9, 0.1], [1.0, 0.5], [0.3, 1.1], [-0.2, 0.6]];
        let (shares, whole) = (area_shares(&polygon), Polygon { vertices: polygon.to_vec() }.moments());
        let moment = |k: usize| shares.iter().zip(&polygon).map(|(a, v)| a * v[k]).sum::<f64>();
        // Sums of five products: rounding alone.
        assert_relative_eq!(shares.iter().sum::<f64>(), whole.area, max_relative = 1e-14);
        assert_relative_eq!(moment(0), whole.s, max_relative = 1e-14);
        assert_relative_eq!(moment(1), whole.t, max_relative = 1e-14);
    }

    #[test]
    fn a_rectangle_is_shared_equally() {
        let shares = area_shares(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]);
        assert!(shares.iter().all(|a| (a - 0.5).abs() < 1e-15), "{shares:?}");
    }

    #[test]
    fn points_that_differ_by_rounding_are_one() {
        let polygon = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1e-17], [1.0, 1.0], [0.0, 1.0], [1e-17, 0.0]];
        assert_eq!(distinct(polygon), vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    }
}
