//! Polygons of any shape as triangles.

use crate::shape::hull::turn;

/// The triangles of a simple polygon, counter-clockwise, as numbers of its corners: ears are cut off one by one (Meisters 1975). Corners on a straight line are no
/// fault. `None` of a polygon that crosses itself, or runs clockwise.
///
/// ```
/// // An L: three corners of it may not be one triangle.
/// let l = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
/// assert_eq!(pirca::shape::triangles(&l).unwrap().len(), 4);
/// ```
pub fn triangles(corners: &[[f64; 2]]) -> Option<Vec<[usize; 3]>> {
    let mut left: Vec<usize> = (0..corners.len()).collect();
    let mut found = Vec::new();
    while left.len() > 3 {
        let n = left.len();
        let at = |k: usize| [left[(k + n - 1) % n], left[k], left[(k + 1) % n]];
        let is_straight = |[a, b, c]: [usize; 3]| area(corners, [a, b, c]) == 0.0;
        let is_ear = |ear: [usize; 3]| {
            area(corners, ear) > 0.0
                && left.iter().filter(|own| !ear.contains(own)).all(|own| !is_inside(corners, ear, *own))
        };
        // The best ear is the one with the widest corner; slivers come last.
        let best = (0..n)
            .filter(|k| is_ear(at(*k)))
            .max_by(|a, b| width(corners, at(*a)).total_cmp(&width(corners, at(*b))));
        match best {
            Some(k) => {
                found.push(at(k));
                left.remove(k);
            }
            None => {
                let k = (0..n).find(|k| is_straight(at(*k)))?;
                left.remove(k);
            }
        }
    }
    if let [a, b, c] = left[..] {
        let twice = area(corners, [a, b, c]);
        if twice < 0.0 {
            return None;
        }
        if twice > 0.0 {
            found.push([a, b, c]);
        }
    }
    (!found.is_empty()).then_some(found)
}

/// Twice the area of a triangle, positive where it runs counter-clockwise.
fn area(corners: &[[f64; 2]], [a, b, c]: [usize; 3]) -> f64 {
    turn(corners[a], corners[b], corners[c])
}

/// Its area over its longest side.
fn width(corners: &[[f64; 2]], ear: [usize; 3]) -> f64 {
    let [p, q, r] = ear.map(|k| corners[k]);
    let length =
        |a: [f64; 2], b: [f64; 2]| ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])).sqrt();
    area(corners, ear) / length(p, q).max(length(q, r)).max(length(r, p))
}

/// Whether a corner lies in a triangle or on its rim, and is none of its corners.
fn is_inside(corners: &[[f64; 2]], [a, b, c]: [usize; 3], own: usize) -> bool {
    let is_corner = [a, b, c].iter().any(|k| corners[*k] == corners[own]);
    !is_corner && [[a, b], [b, c], [c, a]].iter().all(|[from, to]| area(corners, [*from, *to, own]) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(corners: &[[f64; 2]]) -> f64 {
        triangles(corners).unwrap().iter().map(|own| 0.5 * area(corners, *own)).sum()
    }

    #[test]
    fn triangles_cover_a_polygon_once() {
        let comb = [
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 2.0],
            [4.0, 2.0],
            [4.0, 1.0],
            [3.0, 1.0],
            [3.0, 2.0],
            [2.0, 2.0],
            [2.0, 1.0],
            [0.0, 1.0],
        ];
        assert_eq!(covered(&comb), 7.0);
        // Corners on its sides.
        let square = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]];
        assert_eq!(covered(&square), 4.0);
        assert_eq!(covered(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 0.5);
    }

    #[test]
    fn what_runs_clockwise_or_has_no_area_has_none() {
        assert_eq!(triangles(&[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]), None);
        assert_eq!(triangles(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]), None);
    }
}
