//! The points of single lines: which can be read, which are one, and whether they close.

use crate::exchange::drawing::frame::Extent;
use crate::exchange::drawing::gather::{Unread, cut, shown_number};
use crate::shape::distance;

/// Largest coordinate, in any unit.
const FARTHEST: f64 = 1e12;
/// Points no farther apart are one, in parts of the drawing's size.
const ONE_POINT: f64 = 1e-9;
/// Ends of an open line no farther apart were meant to meet, in parts of the line's own size.
pub(super) const NEARLY_MEETING: f64 = 0.02;
/// Points of its beginning along which the end of a closed line may run once more.
const MOST_RUN_AGAIN: usize = 3;

/// Whether one can reckon with a point.
pub(super) fn is_readable(point: &[f64; 2]) -> bool {
    point.iter().all(|x| x.abs() <= FARTHEST)
}

/// The points, if all of them are finite and near enough to reckon with.
pub(super) fn readable(points: Vec<[f64; 2]>, line: usize) -> Result<Vec<[f64; 2]>, Unread> {
    let Some([x, z]) = points.iter().find(|p| !is_readable(p)) else { return Ok(points) };
    let found = format!("a point lies at ({x}, {z})");
    Err(Unread { line, found, allowed: "finite numbers up to 1e12", fix: "correct it, or remove the line" })
}

/// The points without those that repeat the one before, the first one also being after the last one.
pub(super) fn apart(points: Vec<[f64; 2]>, size: f64) -> Vec<[f64; 2]> {
    let same = |a: &[f64; 2], b: &[f64; 2]| distance(*a, *b) <= ONE_POINT * size;
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for point in points {
        if kept.last().is_none_or(|last| !same(last, &point)) {
            kept.push(point);
        }
    }
    while kept.len() > 1 && same(&kept[0], &kept[kept.len() - 1]) {
        kept.pop();
    }
    kept
}

/// Whether an open line of four points or more ends where it begins.
pub(super) fn meets(points: &[[f64; 2]], tolerance: f64) -> bool {
    points.len() > 3 && distance(points[0], points[points.len() - 1]) <= tolerance
}

/// How many points to keep of an open line that was meant to be closed: its end nearly meets its beginning, or runs along it once more.
pub(super) fn nearly_closed(points: &[[f64; 2]]) -> Option<usize> {
    let near = NEARLY_MEETING * Extent::of(points).size();
    let runs_again = |kept: &usize| points[*kept..].iter().zip(points).all(|(a, b)| distance(*a, *b) <= near);
    (3..points.len()).rev().take(MOST_RUN_AGAIN).find(runs_again)
}

/// What is found of a line that stays open.
pub(super) fn stays_open(points: &[[f64; 2]], layer: &str) -> String {
    let [first, last] = [points[0], points[points.len() - 1]];
    let [x, z, x_last, z_last, gap] =
        [first[0], first[1], last[0], last[1], distance(first, last)].map(shown_number);
    format!("a line of layer \"{}\" is open from ({x}, {z}) to ({x_last}, {z_last}), {gap} apart", cut(layer))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_near_the_beginning_or_along_it_closes_a_line() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let with = |more: &[[f64; 2]]| [&square, more].concat();
        assert_eq!(nearly_closed(&square), None);
        assert_eq!(nearly_closed(&with(&[[0.0, 0.02]])), Some(4));
        assert_eq!(nearly_closed(&with(&[[0.0, 0.0], [1.0, 0.01]])), Some(4));
        assert_eq!(nearly_closed(&with(&[[0.0, 0.1]])), None);
        assert_eq!(nearly_closed(&square[..2]), None);
        assert!(meets(&with(&[[0.0, 0.0]]), 0.0) && !meets(&[[0.0; 2]; 3], 0.0));
    }

    #[test]
    fn points_are_told_apart_and_judged() {
        assert_eq!(
            apart(vec![[0.0, 0.0], [0.0, 1e-12], [1.0, 0.0], [0.0, 0.0]], 1.0),
            [[0.0, 0.0], [1.0, 0.0]]
        );
        assert!(readable(vec![[0.0, f64::INFINITY]], 3).is_err_and(|unread| unread.line == 3));
        assert!(readable(vec![[0.0, 1e12]], 3).is_ok());
        assert_eq!(
            stays_open(&[[0.0, 0.0], [3.0, 4.0]], "A"),
            "a line of layer \"A\" is open from (0, 0) to (3, 4), 5 apart"
        );
    }
}
