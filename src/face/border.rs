//! Where outlines face each other: points midway between them.

use std::collections::{BTreeMap, HashMap};

use crate::face::outline::Outline;
use crate::shape::{distance, sides};

/// Most points along one outline.
const MOST_POINTS: f64 = 1000.0;
/// Points this many spacings, and this share of the joint's width, from where they would be met again still face each other.
const AGAIN_SPACINGS: f64 = 1.5;
const AGAIN_SHARE: f64 = 0.25;

/// Points along the outlines, as close as their details matter.
pub struct Border {
    /// The points by outline.
    pub points: Vec<Vec<[f64; 2]>>,
    /// How far apart (m) they are at most, by outline.
    pub spacing: Vec<f64>,
}

/// What two outlines have between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meeting {
    /// Points midway between them.
    pub midway: Vec<[f64; 2]>,
    /// The points of each that face the other.
    pub own: [Vec<[f64; 2]>; 2],
    /// How far apart (m) they are there, in order of size.
    pub widths: Vec<f64>,
}

impl Border {
    /// Along outlines, with points `fine` (m) apart or as close as may be.
    pub fn along(outlines: &[Outline], fine: f64) -> Border {
        let spacing: Vec<f64> = outlines.iter().map(|own| fine.max(own.perimeter() / MOST_POINTS)).collect();
        let points = outlines.iter().zip(&spacing).map(|(own, spacing)| sampled(&own.points, *spacing));
        Border { points: points.collect(), spacing }
    }

    /// The pairs of outlines that face each other across at most `widest` (m). Points face each other where each is the nearest to the other,
    /// nearly: around corners they are not.
    pub fn meetings(&self, widest: f64) -> BTreeMap<(usize, usize), Meeting> {
        let nearest = self.nearest(widest);
        let mut found = BTreeMap::<(usize, usize), Meeting>::new();
        for (&(stone, at, other), &to) in &nearest {
            let Some(&back) = nearest.get(&(other, to, stone)) else { continue };
            let (from, there) = (self.points[stone][at], self.points[other][to]);
            let width = distance(from, there);
            let again = distance(from, self.points[stone][back]);
            let spacing = self.spacing[stone].max(self.spacing[other]);
            if again > AGAIN_SPACINGS * spacing + AGAIN_SHARE * width {
                continue;
            }
            let pair = (stone.min(other), stone.max(other));
            let meeting = found.entry(pair).or_default();
            meeting.midway.push([0.5 * (from[0] + there[0]), 0.5 * (from[1] + there[1])]);
            meeting.own[usize::from(stone > other)].push(from);
            meeting.widths.push(width);
        }
        found.values_mut().for_each(|own| own.widths.sort_by(f64::total_cmp));
        found
    }

    /// How far (m) the nearest other outline is from one; `None` where there is no other.
    pub fn gap(&self, stone: usize) -> Option<f64> {
        let others = self.points.iter().enumerate().filter(|(other, _)| *other != stone);
        let gaps = others.flat_map(|(_, points)| {
            points.iter().flat_map(|to| self.points[stone].iter().map(|from| distance(*from, *to)))
        });
        gaps.min_by(f64::total_cmp)
    }

    /// The nearest point of every other outline to each point, where it is at most `widest` (m) away: `(outline, point, other outline)` to the
    /// other's point.
    fn nearest(&self, widest: f64) -> BTreeMap<(usize, usize, usize), usize> {
        let cell = |point: [f64; 2]| point.map(|c| (c / widest).floor() as i64);
        let mut grid = HashMap::<[i64; 2], Vec<(usize, usize)>>::new();
        for (stone, points) in self.points.iter().enumerate() {
            for (at, point) in points.iter().enumerate() {
                grid.entry(cell(*point)).or_default().push((stone, at));
            }
        }
        let mut found = BTreeMap::new();
        for (stone, points) in self.points.iter().enumerate() {
            for (at, point) in points.iter().enumerate() {
                let [column, row] = cell(*point);
                let mut best = BTreeMap::<usize, (f64, usize)>::new();
                let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dz| [column + dx, row + dz]));
                for (other, to) in around.filter_map(|cell| grid.get(&cell)).flatten() {
                    if *other == stone {
                        continue;
                    }
                    let apart = distance(*point, self.points[*other][*to]);
                    let known = best.get(other).map_or((widest, usize::MAX), |own| *own);
                    if apart < known.0 || (apart == known.0 && *to < known.1) {
                        best.insert(*other, (apart, *to));
                    }
                }
                found.extend(best.into_iter().map(|(other, (_, to))| ((stone, at, other), to)));
            }
        }
        found
    }
}

/// Points in the middle of equal parts of the sides of a closed line: corners belong to no side.
fn sampled(corners: &[[f64; 2]], spacing: f64) -> Vec<[f64; 2]> {
    sides(corners)
        .flat_map(|[from, to]| {
            let parts = (distance(from, to) / spacing).ceil().max(1.0) as usize;
            (0..parts).map(move |part| {
                let share = (part as f64 + 0.5) / parts as f64;
                [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]
            })
        })
        .collect()
}
