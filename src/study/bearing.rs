//! Stones that bear on few points of their beds: what a study states of it, and where each joint bears.

use crate::law::{MOST_SEATS, Seat, Seating};
use crate::random::{Stream, Streams};
use crate::study::reader::Reader;

/// Bearing as a study states it: each bed joint carries on patches about a few points in place of its whole face.
///
/// Points are drawn uniformly over the face, until they hold its middle: a mason turns or shims a stone until it does not rock. Two lie on
/// opposite sides of the middle, more have it within them. So a joint that is loaded in its middle stands.
///
/// Points differ in height. A rigid stone rests on three of them, those that hold its middle highest: these touch as it is laid, and every other
/// one has the gap that is left below the plane through the three. Up to three points all touch, whatever their heights.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Bearing {
    /// Points of a joint, 1 to 16; between two whole numbers joints have the one or the other, so that this is their mean.
    pub points: f64,
    /// Largest difference (m) of the heights of a joint's points, which are drawn uniformly.
    #[serde(rename = "relief_m")]
    pub relief: f64,
    /// Share of the face that all patches of a joint have together, above 0 and up to 1.
    pub share: f64,
}

/// The middle of a face.
const MIDDLE: [f64; 2] = [0.5; 2];

impl Bearing {
    /// Reads the table.
    pub(super) fn read(t: &mut Reader<'_>) -> Option<Bearing> {
        let [points, relief, share] = t.reals(["points", "relief_m", "share"])?;
        Some(Bearing { points, relief, share })
    }

    /// Where the joint of two blocks bears. Each quantity has a stream of its own: another relief leaves the points where they are.
    pub fn seating(&self, streams: &Streams, a: u32, b: u32) -> Seating {
        let (a, b) = (a.min(b), a.max(b));
        let stream = |quantity: &str| streams.of(&format!("joint bearing {quantity} {a}-{b}"));
        let count = ((self.points + stream("count").uniform()) as usize).clamp(1, MOST_SEATS);
        let places = steady(count, &mut stream("place"));
        let mut heights = stream("height");
        let heights: Vec<f64> = places.iter().map(|_| self.relief * heights.uniform()).collect();
        let recesses = recesses(&places, &heights);
        let seats: Vec<Seat> = places.iter().zip(recesses).map(|(&at, recess)| Seat { at, recess }).collect();
        Seating::new(self.share, &seats)
    }
}

/// Uniform points that hold the middle.
fn steady(count: usize, stream: &mut Stream) -> Vec<[f64; 2]> {
    loop {
        let places: Vec<[f64; 2]> = (0..count).map(|_| [stream.uniform(), stream.uniform()]).collect();
        let from_middle = |k: usize| [places[k][0] - MIDDLE[0], places[k][1] - MIDDLE[1]];
        let holds = match count {
            0 | 1 => true,
            2 => {
                let [p, q] = [from_middle(0), from_middle(1)];
                p[0] * q[0] + p[1] * q[1] < 0.0
            }
            _ => highest(&places, &vec![0.0; count]).is_some(),
        };
        if holds {
            return places;
        }
    }
}

/// How far points of these heights (m) lie below the plane of the three that bear; nothing where all bear.
fn recesses(places: &[[f64; 2]], heights: &[f64]) -> Vec<f64> {
    let flush = vec![0.0; places.len()];
    let Some(bearing) = highest(places, heights).filter(|_| places.len() > 3) else { return flush };
    let below = |k: usize| {
        let weights = weights(bearing.map(|own| places[own]), places[k]);
        // Round-off may put a point above the plane.
        weights.map_or(0.0, |weights| (plane(weights, bearing, heights) - heights[k]).max(0.0))
    };
    (0..places.len()).map(|k| if bearing.contains(&k) { 0.0 } else { below(k) }).collect()
}

/// The three points that hold the middle highest: no other lies above their plane. `None` where no three have it within them.
fn highest(places: &[[f64; 2]], heights: &[f64]) -> Option<[usize; 3]> {
    let n = places.len();
    let triples = (0..n).flat_map(|a| (0..a).flat_map(move |b| (0..b).map(move |c| [a, b, c])));
    let held = triples.filter_map(|triple| {
        let weights = weights(triple.map(|own| places[own]), MIDDLE)?;
        weights.iter().all(|weight| *weight >= 0.0).then(|| (plane(weights, triple, heights), triple))
    });
    held.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, triple)| triple)
}

/// The height of the plane through three points, where they have these weights.
fn plane(weights: [f64; 3], triple: [usize; 3], heights: &[f64]) -> f64 {
    weights.into_iter().zip(triple).map(|(weight, own)| weight * heights[own]).sum()
}

/// The weights of three points, with the sum 1, whose mean is a fourth one; `None` where they lie in a line.
fn weights([a, b, c]: [[f64; 2]; 3], p: [f64; 2]) -> Option<[f64; 3]> {
    let twice =
        |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let whole = twice(a, b, c);
    (whole != 0.0).then(|| [twice(p, b, c), twice(a, p, c), twice(a, b, p)].map(|part| part / whole))
}
