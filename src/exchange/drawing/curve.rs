//! Points on arcs and on Bézier curves.

use std::f64::consts::TAU;

use crate::math::{acos, atan, cos, sin};

/// How far a chord may be from its arc, in parts of the arc's chord or radius, whichever is less.
const SAGITTA: f64 = 1.0 / 200.0;
/// Most pieces of a Bézier curve.
const MOST_PIECES: f64 = 200.0;

/// Points on a circular arc, its ends included; angles in radians, `sweep` counter-clockwise and at most a full turn.
pub(super) fn arc(centre: [f64; 2], radius: f64, from: f64, sweep: f64) -> Vec<[f64; 2]> {
    let pieces = pieces(sweep);
    let at = |angle: f64| [centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)];
    (0..=pieces).map(|i| at(from + sweep * i as f64 / pieces as f64)).collect()
}

/// Corners on a circle; the first one does not come again.
pub(super) fn circle(centre: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let mut points = arc(centre, radius, 0.0, TAU);
    points.pop();
    points
}

/// Pieces of an arc that turns by an angle (radians).
fn pieces(sweep: f64) -> usize {
    let sweep = sweep.abs().min(TAU);
    // The chord over the radius; beyond a half circle it shrinks again.
    let chord = 2.0 * sin(0.5 * sweep.min(TAU / 6.0));
    let step = 2.0 * acos(1.0 - SAGITTA * chord);
    // The step of a tiny angle is lost in the last bits.
    if step > 1e-6 { ((sweep / step).ceil() as usize).clamp(1, 200) } else { 1 }
}

/// Points strictly between two corners whose edge bulges: `bulge` is the tangent of a quarter of the arc's angle, above 0 where the arc
/// goes counter-clockwise.
pub(super) fn bulged(from: [f64; 2], to: [f64; 2], bulge: f64) -> Vec<[f64; 2]> {
    let sweep = 4.0 * atan(bulge);
    let pieces = pieces(sweep);
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    // From the middle of the chord to the left, in parts of the chord.
    let beside = (1.0 - bulge * bulge) / (4.0 * bulge);
    let centre = [0.5 * (from[0] + to[0]) - beside * dy, 0.5 * (from[1] + to[1]) + beside * dx];
    let arm = [from[0] - centre[0], from[1] - centre[1]];
    (1..pieces)
        .map(|i| {
            let angle = sweep * i as f64 / pieces as f64;
            let (s, c) = (sin(angle), cos(angle));
            [centre[0] + c * arm[0] - s * arm[1], centre[1] + s * arm[0] + c * arm[1]]
        })
        .collect()
}

/// Points on a cubic Bézier curve after its beginning, its end included, no farther from it than `tolerance`.
pub(super) fn cubic(corners: [[f64; 2]; 4], tolerance: f64) -> impl Iterator<Item = [f64; 2]> {
    let bend = |i: usize| {
        let second = |k: usize| corners[i][k] - 2.0 * corners[i + 1][k] + corners[i + 2][k];
        (second(0) * second(0) + second(1) * second(1)).sqrt()
    };
    // Wang's bound on how far a cubic leaves its chords.
    let wanted = (0.75 * bend(0).max(bend(1)) / tolerance).sqrt().ceil();
    // A bound that is no number is that of a curve without size.
    let pieces = if wanted >= 1.0 { wanted.min(MOST_PIECES) as usize } else { 1 };
    (1..=pieces).map(move |i| {
        let t = i as f64 / pieces as f64;
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        [0, 1].map(|k| (0..4).map(|j| weights[j] * corners[j][k]).sum())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::distance;

    #[test]
    fn a_bulge_of_one_is_a_half_circle_on_the_right() {
        let points = bulged([0.0, 0.0], [2.0, 0.0], 1.0);
        assert!(points.len() >= 10, "{points:?}");
        assert!(points.iter().all(|p| (distance(*p, [1.0, 0.0]) - 1.0).abs() < 1e-12 && p[1] < 0.0));
        assert!(bulged([0.0, 0.0], [2.0, 0.0], -1.0).iter().all(|p| p[1] > 0.0));
        assert!(bulged([0.0, 0.0], [2.0, 0.0], 1e-9).is_empty());
    }

    #[test]
    fn chords_are_near_their_arc() {
        for sweep in [0.2, 1.0, 3.0, 6.0] {
            let points = arc([0.0, 0.0], 1.0, 0.3, sweep);
            let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let chord = distance(points[0], points[points.len() - 1]).max(0.2);
            for pair in points.windows(2) {
                let sagitta = 1.0 - distance(middle(pair[0], pair[1]), [0.0, 0.0]);
                assert!(sagitta <= chord / 199.0 || sagitta <= 1.0 / 199.0, "{sweep}: {sagitta}");
            }
        }
        assert_eq!(circle([0.0, 0.0], 1.0).len(), 32);
    }

    #[test]
    fn a_cubic_ends_where_it_ends() {
        let corners = [[0.0, 0.0], [1.0, 2.0], [2.0, 2.0], [3.0, 0.0]];
        let points: Vec<[f64; 2]> = cubic(corners, 0.01).collect();
        assert_eq!(points.last(), Some(&[3.0, 0.0]));
        assert!(points.len() > 8 && points.len() < 20, "{}", points.len());
        assert_eq!(cubic([[1.0, 1.0]; 4], 0.0).count(), 1);
    }
}
