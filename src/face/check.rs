//! Outlines that cannot be stones.

use crate::face::cell::near;
use crate::face::line::minus;
use crate::face::outline::Outline;
use crate::shape::{Polygon, bounds, encloses};

/// Two stones of which one covers this share of the other are one drawn twice, or one within the other.
const COVERED: f64 = 0.5;

/// What is wrong with an outline, by its place among all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trouble {
    /// Its sides cross, here.
    Crosses {
        /// The outline.
        outline: usize,
        /// Where.
        at: [f64; 2],
    },
    /// It surrounds nothing.
    Empty {
        /// The outline.
        outline: usize,
    },
    /// Another one covers this share of it.
    Covered {
        /// The outline, the smaller of both.
        outline: usize,
        /// The other.
        by: usize,
        /// Share of its area.
        share: f64,
    },
    /// Between its neighbours nothing is left of it.
    Vanishes {
        /// The outline.
        outline: usize,
    },
}

/// All that is wrong; `hulls` are those of the outlines. Those that follow pixels may touch themselves, and never cross.
pub fn troubles(outlines: &[Outline], hulls: &[Polygon], follow_pixels: bool) -> Vec<Trouble> {
    let mut found = Vec::new();
    for (outline, own) in outlines.iter().enumerate() {
        // A sliver of rounding: thinner than a millionth of its length.
        if hulls[outline].area() <= 1e-6 * own.perimeter() * own.perimeter() {
            found.push(Trouble::Empty { outline });
        } else if !follow_pixels && let Some(at) = crossing(&own.points) {
            found.push(Trouble::Crosses { outline, at });
        }
    }
    if !found.is_empty() {
        return found;
    }
    let bounds: Vec<[f64; 4]> = hulls.iter().map(|own| bounds(&own.vertices)).collect();
    for (a, b) in near(&bounds) {
        let (outline, by) = if hulls[a].area() <= hulls[b].area() { (a, b) } else { (b, a) };
        let both = hulls[a].intersection(&hulls[b]);
        let share = both.area() / hulls[outline].area();
        // The hull of a concave stone may cover one that lies in its notch, which its outline does not.
        let middle = both.moments().centroid();
        let is_in_both = [a, b].iter().all(|own| encloses(&outlines[*own].points, middle));
        if share > COVERED && is_in_both {
            found.push(Trouble::Covered { outline, by, share });
        }
    }
    found
}

/// Where two sides of a closed line cross or touch that do not follow each other.
fn crossing(corners: &[[f64; 2]]) -> Option<[f64; 2]> {
    let n = corners.len();
    let side = |k: usize| (corners[k], corners[(k + 1) % n]);
    let left = |k: usize| side(k).0[0].min(side(k).1[0]);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| left(*a).total_cmp(&left(*b)));
    for (place, &one) in order.iter().enumerate() {
        let (a, b) = side(one);
        let right = a[0].max(b[0]);
        for &other in order[place + 1..].iter().take_while(|other| left(**other) <= right) {
            let next = (one + 1) % n == other || (other + 1) % n == one;
            if !next && let Some(at) = meet((a, b), side(other)) {
                return Some(at);
            }
        }
    }
    None
}

/// Where two sides cross within both.
fn meet((a, b): ([f64; 2], [f64; 2]), (c, d): ([f64; 2], [f64; 2])) -> Option<[f64; 2]> {
    let (along, other, between) = (minus(b, a), minus(d, c), minus(c, a));
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let turn = cross(along, other);
    if turn == 0.0 {
        return None;
    }
    let (s, t) = (cross(between, other) / turn, cross(between, along) / turn);
    let within = 0.0..=1.0;
    (within.contains(&s) && within.contains(&t)).then(|| [a[0] + s * along[0], a[1] + s * along[1]])
}
