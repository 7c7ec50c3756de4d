//! Frames: rectangles around everything else.

use crate::face::Part;
use crate::shape::bounds;

/// How near a corner is to the drawing's corner, in parts of the drawing's size.
const NEAR: f64 = 1e-6;
/// Frames around frames that are looked for.
const MOST_FRAMES: usize = 8;

/// The rectangle around points with sides along the axes: least and largest x and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub low: [f64; 2],
    pub high: [f64; 2],
}

impl Extent {
    /// Of points; turned inside out where there are none.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a [f64; 2]>) -> Extent {
        let [left, low, right, high] = bounds(points);
        Extent { low: [left, low], high: [right, high] }
    }

    /// Around two.
    pub fn with(&self, other: &Extent) -> Extent {
        Extent {
            low: [0, 1].map(|k| self.low[k].min(other.low[k])),
            high: [0, 1].map(|k| self.high[k].max(other.high[k])),
        }
    }

    /// From corner to corner; 0 where there are no points.
    pub fn size(&self) -> f64 {
        let [x, z] = [0, 1].map(|k| (self.high[k] - self.low[k]).max(0.0));
        (x * x + z * z).sqrt()
    }
}

/// Which of the closed lines are frames: rectangles with sides along the axes that contain all others, at least two. No stone is around
/// all stones.
pub(super) fn frames(lines: &[(Part, &[[f64; 2]])]) -> Vec<usize> {
    let extents: Vec<Extent> = lines.iter().map(|(_, points)| Extent::of(*points)).collect();
    let mut frames = Vec::new();
    while frames.len() < MOST_FRAMES {
        let left = || (0..lines.len()).filter(|i| !frames.contains(i));
        let whole = left().fold(Extent::of([]), |all, i| all.with(&extents[i]));
        let near = NEAR * whole.size();
        let at_corner = |p: &[f64; 2]| {
            (0..2).all(|k| (p[k] - whole.low[k]).abs() <= near || (p[k] - whole.high[k]).abs() <= near)
        };
        let is_whole = |i: &usize| {
            let (part, points) = lines[*i];
            let same = |a: [f64; 2], b: [f64; 2]| (0..2).all(|k| (a[k] - b[k]).abs() <= near);
            let reaches = same(extents[*i].low, whole.low) && same(extents[*i].high, whole.high);
            part == Part::Stone && points.len() == 4 && reaches && points.iter().all(at_corner)
        };
        // The same outline three times is no frame.
        let smaller = left().filter(|i| extents[*i].size() < 0.999 * whole.size()).count();
        match left().find(is_whole).filter(|_| smaller >= 2) {
            Some(frame) => frames.push(frame),
            None => break,
        }
    }
    frames
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(x: f64, z: f64, length: f64, height: f64) -> Vec<[f64; 2]> {
        vec![[x, z], [x + length, z], [x + length, z + height], [x, z + height]]
    }

    #[test]
    fn only_what_is_around_all_others_is_a_frame() {
        let stones = [rectangle(0.0, 0.0, 1.0, 1.0), rectangle(1.0, 0.0, 1.0, 1.0)];
        let around = [rectangle(-1.0, -1.0, 4.0, 3.0), rectangle(-2.0, -2.0, 6.0, 5.0)];
        let all: Vec<(Part, &[[f64; 2]])> =
            around.iter().chain(&stones).map(|points| (Part::Stone, points.as_slice())).collect();
        assert_eq!(frames(&all), [1, 0]);
        assert_eq!(frames(&all[2..]), [0; 0]);
        // A frame and one stone may be a stone and another one in front of it.
        assert_eq!(frames(&all[1..3]), [0; 0]);
        assert_eq!(frames(&[all[2], all[2], all[2]]), [0; 0]);
    }
}
