//! A joint that bears on a few seats: what of its polygon is nearest to each, shrunk about it.

use crate::contact::Cell;
use crate::shape::Polygon;

/// Parts of the polygon's area below which a patch is none.
const SLIVER: f64 = 1e-9;

/// The patches of a convex polygon on which it bears, with `share` of its area: the points that lie nearest to each seat, shrunk about it. A seat
/// is where it lies ([`place`]) and how far behind the face (m).
pub fn seated(polygon: &Polygon, share: f64, seats: impl Iterator<Item = ([f64; 2], f64)>) -> Vec<Cell> {
    let seats: Vec<([f64; 2], f64)> = seats.map(|(at, recess)| (place(polygon, at), recess)).collect();
    let least = SLIVER * share * polygon.area();
    let shrink = share.sqrt();
    let cell = |(index, &(seat, recess)): (usize, &([f64; 2], f64))| {
        let others = seats.iter().enumerate().filter(|(other, _)| *other != index);
        let part = others.fold(polygon.clone(), |part, (_, (other, _))| nearer(&part, &seat, other));
        let shrunk = |v: &[f64; 2]| [0, 1].map(|k| seat[k] + shrink * (v[k] - seat[k]));
        Cell { recess, ..Cell::within(Polygon { vertices: part.vertices.iter().map(shrunk).collect() }) }
    };
    seats.iter().enumerate().map(cell).filter(|cell| cell.moments.area > least).collect()
}

/// What of a polygon lies nearer to one point than to another.
fn nearer(polygon: &Polygon, to: &[f64; 2], than: &[f64; 2]) -> Polygon {
    let square = |v: &[f64; 2]| v[0] * v[0] + v[1] * v[1];
    polygon.clip(square(to) - square(than), 2.0 * (than[0] - to[0]), 2.0 * (than[1] - to[1]))
}

/// The point of a convex polygon with a share of its area below it along the first axis, and so far along its chord there: uniform numbers are
/// uniform points (Rosenblatt 1952).
fn place(polygon: &Polygon, [below, along]: [f64; 2]) -> [f64; 2] {
    let mut stations: Vec<f64> = polygon.vertices.iter().map(|v| v[0]).collect();
    stations.sort_by(f64::total_cmp);
    let mut left = below * polygon.area();
    let mut at = stations.first().copied().unwrap_or(0.0);
    for pair in stations.windows(2) {
        let length = pair[1] - pair[0];
        let [w, v] = [pair[0], pair[1]].map(|s| width(chord(polygon, s, 0.5 * (pair[0] + pair[1]))));
        let strip = 0.5 * (w + v) * length;
        if left < strip {
            // w x + (v - w) x^2 / 2 length = left.
            at = pair[0] + 2.0 * left / (w + (w * w + 2.0 * left * (v - w) / length).max(0.0).sqrt());
            break;
        }
        left -= strip;
        at = pair[1];
    }
    let [low, high] = chord(polygon, at, at);
    [at, low + along * (high - low)]
}

fn width([low, high]: [f64; 2]) -> f64 {
    high - low
}

/// Where the edges that reach over `within` along the first axis lie at `s`, lowest and highest along the second.
fn chord(polygon: &Polygon, s: f64, within: f64) -> [f64; 2] {
    let corners = &polygon.vertices;
    let edges = (0..corners.len()).map(|k| (corners[k], corners[(k + 1) % corners.len()]));
    let over = edges.filter(|(a, b)| a[0].min(b[0]) <= within && within <= a[0].max(b[0]) && a[0] != b[0]);
    let at = over.map(|(a, b)| a[1] + (b[1] - a[1]) * (s - a[0]) / (b[0] - a[0]));
    at.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| [low.min(t), high.max(t)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Moments;
    use approx::assert_relative_eq;

    fn shapes() -> [Polygon; 3] {
        let rectangle = vec![[0.1, 0.0], [0.5, 0.0], [0.5, 0.3], [0.1, 0.3]];
        let triangle = vec![[0.0, 0.0], [0.4, 0.1], [0.1, 0.5]];
        let hexagon = vec![[0.1, 0.0], [0.5, -0.05], [0.7, 0.2], [0.6, 0.4], [0.2, 0.45], [0.0, 0.2]];
        [rectangle, triangle, hexagon].map(|vertices| Polygon { vertices })
    }

    #[test]
    fn uniform_numbers_are_uniform_points() {
        for polygon in shapes() {
            let whole = polygon.moments();
            // The midpoints of a fine grid: their moments are the polygon's to the square of its step.
            let n = 200;
            let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
            let places = (0..n * n).map(|k| place(&polygon, [middle(k / n), middle(k % n)]));
            let weight = whole.area / f64::from(n * n);
            let sums = places.fold([0.0; 4], |[s, t, st, tt], p| {
                [s + weight * p[0], t + weight * p[1], st + weight * p[0] * p[1], tt + weight * p[1] * p[1]]
            });
            for (found, exact) in sums.into_iter().zip([whole.s, whole.t, whole.st, whole.tt]) {
                assert_relative_eq!(found, exact, max_relative = 1e-4);
            }
        }
    }

    #[test]
    fn patches_have_their_share_lie_in_the_face_and_do_not_overlap() {
        // Multiples of two irrational numbers are spread evenly, and no two alike.
        let number = |k: usize, root: f64| (k as f64 * root).fract();
        for polygon in shapes() {
            for count in [1, 2, 3, 6, 16] {
                for share in [1e-3, 0.2, 0.7, 1.0] {
                    let at = |k: usize| [number(k, 2f64.sqrt()), number(k, 3f64.sqrt())];
                    let seats: Vec<_> = (1..=count).map(|k| (at(k), 1e-3 * k as f64)).collect();
                    let cells = seated(&polygon, share, seats.iter().copied());
                    assert_eq!(cells.len(), seats.len());
                    let sum = |of: fn(&Moments) -> f64| cells.iter().map(|c| of(&c.moments)).sum::<f64>();
                    assert_relative_eq!(sum(|m| m.area), share * polygon.area(), max_relative = 1e-9);
                    for (a, cell) in cells.iter().enumerate() {
                        assert_eq!(cell.recess, seats[a].1);
                        let inside = cell.outline.intersection(&polygon).area();
                        assert_relative_eq!(inside, cell.moments.area, max_relative = 1e-9);
                        for other in &cells[..a] {
                            assert!(cell.outline.intersection(&other.outline).area() < 1e-12);
                        }
                    }
                }
            }
        }
    }
}
