//! Sub-contacts: a joint's polygon divided into cells, each with its own shear history.

use crate::shape::{Moments, Polygon};

/// One sub-contact of a joint, in the joint's plane coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Integrals over the cell.
    pub moments: Moments,
    /// Its outline; empty for a point sub-contact, which is open or closed as a whole.
    pub outline: Polygon,
    /// How far (m) it lies behind the face: it touches where the gap of the faces is this far below zero.
    pub recess: f64,
}

impl Cell {
    /// All of an outline.
    pub fn within(outline: Polygon) -> Cell {
        Cell { moments: outline.moments(), outline, recess: 0.0 }
    }
}

/// Divides a polygon by lines of equal spacing into `counts` parts along its longer and its shorter extent; parts
/// outside the polygon vanish.
///
/// The cells fill the polygon exactly, so that the normal force does not depend on how many there are; only shear,
/// whose traction is constant in a cell, does.
pub fn divide(polygon: &Polygon, counts: [u32; 2]) -> Vec<Cell> {
    grid(polygon, counts, |_| true)
}

/// Those of a polygon's `along` by `along` cells, eight at most, whose bit is set: `along i + j` for the cell `i` along its
/// first and `j` along its second axis; the largest cell where the polygon has none of them.
pub fn patches(polygon: &Polygon, along: u32, mask: u64) -> Vec<Cell> {
    let counts = [along; 2];
    let kept = grid(polygon, counts, |[i, j]| mask >> (along * i + j) & 1 == 1);
    if !kept.is_empty() {
        return kept;
    }
    let all = grid(polygon, counts, |_| true);
    let largest = all.into_iter().reduce(|a, b| if b.moments.area > a.moments.area { b } else { a });
    largest.into_iter().collect()
}

/// The cells that are wanted, by their places along the first and the second axis.
fn grid(polygon: &Polygon, counts: [u32; 2], wanted: impl Fn([u32; 2]) -> bool) -> Vec<Cell> {
    let range = |k: usize| {
        polygon
            .vertices
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v[k]), high.max(v[k])))
    };
    let (s, t) = (range(0), range(1));
    let s_is_longer = s.1 - s.0 >= t.1 - t.0;
    let [along_s, along_t] = if s_is_longer { counts } else { [counts[1], counts[0]] };
    let at = |(low, high): (f64, f64), i: u32, n: u32| low + (high - low) * f64::from(i) / f64::from(n);
    let smallest = 1e-9 * polygon.area() / f64::from(along_s * along_t);
    let mut cells = Vec::with_capacity((along_s * along_t) as usize);
    for i in 0..along_s {
        let (left, right) = (at(s, i, along_s), at(s, i + 1, along_s));
        let mut strip = None;
        for j in (0..along_t).filter(|&j| wanted([i, j])) {
            let (low, high) = (at(t, j, along_t), at(t, j + 1, along_t));
            let whole = [[left, low], [right, low], [right, high], [left, high]];
            let outline = if whole.iter().all(|corner| contains(polygon, corner)) {
                Polygon { vertices: whole.to_vec() }
            } else {
                // The outermost cells are not cut from outside, so that no sliver is lost to rounding.
                let strip: &Polygon = strip.get_or_insert_with(|| {
                    let strip = if i > 0 { polygon.clip(left, -1.0, 0.0) } else { polygon.clone() };
                    if i + 1 < along_s { strip.clip(-right, 1.0, 0.0) } else { strip }
                });
                let cell = if j > 0 { strip.clip(low, 0.0, -1.0) } else { strip.clone() };
                if j + 1 < along_t { cell.clip(-high, 0.0, 1.0) } else { cell }
            };
            let cell = Cell::within(outline);
            if cell.moments.area > smallest {
                cells.push(cell);
            }
        }
    }
    cells
}

/// Whether a point lies in a counter-clockwise polygon.
pub fn contains(polygon: &Polygon, point: &[f64; 2]) -> bool {
    let corners = &polygon.vertices;
    (0..corners.len()).all(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
        (b[0] - a[0]) * (point[1] - a[1]) >= (b[1] - a[1]) * (point[0] - a[0])
    })
}

/// Point sub-contacts at the polygon's corners, each with an equal share of the area, as older block codes place them.
pub fn corners(polygon: &Polygon) -> Vec<Cell> {
    let area = polygon.area() / polygon.vertices.len() as f64;
    polygon
        .vertices
        .iter()
        .map(|&[s, t]| Cell {
            moments: Moments {
                area,
                s: area * s,
                t: area * t,
                ss: area * s * s,
                st: area * s * t,
                tt: area * t * t,
            },
            outline: Polygon::default(),
            recess: 0.0,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn hexagon() -> Polygon {
        Polygon { vertices: vec![[0.1, 0.0], [0.5, -0.05], [0.7, 0.2], [0.6, 0.4], [0.2, 0.45], [0.0, 0.2]] }
    }

    #[test]
    fn the_cells_fill_the_polygon() {
        let whole = hexagon().moments();
        for counts in [[1, 1], [2, 2], [3, 5], [1, 8]] {
            let cells = divide(&hexagon(), counts);
            let sum = |f: fn(&Moments) -> f64| cells.iter().map(|c| f(&c.moments)).sum::<f64>();
            // Round-off of a few dozen additions.
            assert_relative_eq!(sum(|m| m.area), whole.area, max_relative = 1e-12);
            assert_relative_eq!(sum(|m| m.st), whole.st, max_relative = 1e-12);
            assert_relative_eq!(sum(|m| m.tt), whole.tt, max_relative = 1e-12);
        }
    }

    #[test]
    fn patches_are_the_cells_of_their_bits() {
        let square = Polygon { vertices: vec![[0.0, 0.0], [0.8, 0.0], [0.8, 0.4], [0.0, 0.4]] };
        assert_eq!(patches(&square, 8, u64::MAX), divide(&square, [8, 8]));
        let two = patches(&square, 8, 1 << 1 | 1 << 58);
        let places: Vec<_> = two.iter().map(|cell| cell.moments.centroid()).collect();
        for (found, [s, t]) in places.iter().zip([[0.05, 0.075], [0.75, 0.125]]) {
            assert_relative_eq!(found[0], s, max_relative = 1e-12);
            assert_relative_eq!(found[1], t, max_relative = 1e-12);
        }
        // A corner of the grid where a triangle is not.
        let triangle = Polygon { vertices: vec![[0.0, 0.0], [0.8, 0.0], [0.0, 0.4]] };
        assert_eq!(patches(&triangle, 8, 1 << 63).len(), 1);
    }

    #[test]
    fn corner_sub_contacts_share_the_area() {
        let cells = corners(&hexagon());
        assert_eq!(cells.len(), 6);
        let area: f64 = cells.iter().map(|c| c.moments.area).sum();
        assert_relative_eq!(area, hexagon().area(), max_relative = 1e-14);
    }
}
