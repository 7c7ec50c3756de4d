//! How much of a joint is still in touch, and where: a joint that has opened to an edge is a hinge.

use crate::math::Vec3;

/// Corners whose gaps differ by less than this share of the largest difference lie on the same edge.
const SAME_EDGE: f64 = 0.1;

/// What is left of a joint's contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    /// How far over the joint its blocks touch, from the edge that is closest to the one that gapes most, as a share of that way: 1
    /// where it is closed throughout, 0 where it touches along an edge at most.
    pub share: f64,
    /// The ends of the edge, or twice the corner, that is closest (m).
    pub edge: [Vec3; 2],
}

impl Closing {
    /// From the corners of a joint with their gaps, negative where they are pressed; gaps no larger than `nothing` are none.
    pub fn of(corners: &[(Vec3, f64)], nothing: f64) -> Closing {
        let gaps = || corners.iter().map(|(_, gap)| *gap);
        let least = gaps().fold(f64::INFINITY, f64::min);
        let largest = gaps().fold(f64::NEG_INFINITY, f64::max);
        let share = if largest <= nothing { 1.0 } else { (-least / (largest - least)).clamp(0.0, 1.0) };
        let on_edge = |gap: f64| gap - least <= SAME_EDGE * (largest - least);
        let near: Vec<Vec3> = corners.iter().filter(|(_, gap)| on_edge(*gap)).map(|(at, _)| *at).collect();
        let pairs = near.iter().flat_map(|a| near.iter().map(move |b| [*a, *b]));
        let longest = |best: [Vec3; 2], next: [Vec3; 2]| {
            if (next[1] - next[0]).norm() > (best[1] - best[0]).norm() { next } else { best }
        };
        let edge = pairs.fold([near.first().copied().unwrap_or_default(); 2], longest);
        Closing { share, edge }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A joint of 1 m x 2 m with a gap that grows linearly along x.
    fn leaning(from: f64, to: f64) -> Closing {
        let at = |x: f64, y: f64| (Vec3::new(x, y, 0.0), from + (to - from) * x);
        Closing::of(&[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 2.0), at(0.0, 2.0)], 1e-9)
    }

    #[test]
    fn a_joint_that_leans_open_touches_up_to_where_its_gap_begins() {
        assert_eq!(leaning(-1e-3, -1e-4).share, 1.0);
        // 1 mm deep on one side and 3 mm open on the other: a quarter of the way.
        let quarter = leaning(-1e-3, 3e-3);
        assert!((quarter.share - 0.25).abs() < 1e-12);
        assert_eq!(quarter.edge.map(|end| end.x), [0.0, 0.0]);
        assert_eq!((quarter.edge[1] - quarter.edge[0]).norm(), 2.0);
        assert_eq!(leaning(0.0, 1.0).share, 0.0);
        assert_eq!(leaning(1e-3, 2e-3).share, 0.0);
    }
}
