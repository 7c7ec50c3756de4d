//! The face of a wall: outlines of stones become convex polygons that share the lines of their joints.
//!
//! A drawing shows joints as gaps, a picture as rows of pixels. Both halves of a gap are given to the stones at it, up to a width that is asked
//! for: the joint is the line midway between them. Joints that continue each other get one line, as stones bear on what is one plane only.

mod border;
mod cell;
mod check;
mod joint;
mod line;
mod outline;
mod simple;
#[cfg(test)]
mod tests;

pub use check::Trouble;
pub use outline::{Outline, Part};

use crate::face::border::{Border, Meeting};
use crate::face::cell::cells;
use crate::face::check::troubles;
use crate::face::joint::{Joint, joints};
use crate::face::line::Line;
use crate::face::simple::simplified;
use crate::shape::{Polygon, distance};

/// Points along outlines are this share of the widest joint apart.
const FINE: f64 = 0.1;
/// Joints of one line may be off it by this share of the widest joint.
const STRAIGHT: f64 = 0.25;
/// A stone stands on the ground with so many points near it.
const STANDING: usize = 3;

/// How outlines become stones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    /// Width (m) up to which joints are closed.
    pub widest: f64,
    /// Size (m) below which details of an outline mean nothing, as a pixel; 0 of a drawing.
    pub grain: f64,
}

/// A joint that was closed: the gap between two outlines, of which each has half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closed {
    /// The outlines.
    pub stones: (usize, usize),
    /// Width (m) of the gap: its mean along the joint, and the greatest.
    pub widths: [f64; 2],
    /// Length (m) along which the outlines face each other.
    pub length: f64,
}

/// The stones of a face, with their joints closed.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// What each outline fills, in their order.
    pub polygons: Vec<Polygon>,
    /// Area gained by each, as a share of what its outline surrounds; negative where it lost.
    pub gained: Vec<f64>,
    /// The joints, by their outlines.
    pub joints: Vec<Closed>,
    /// Widths (m) that were closed: the median one and the greatest.
    pub widths: [f64; 2],
    /// Outlines that stand on the lowest level, where there is no outline of a ground.
    pub standing: Vec<usize>,
    /// Outlines that meet nothing, and how far (m) their nearest neighbours are.
    pub alone: Vec<(usize, Option<f64>)>,
}

impl Face {
    /// The stones within outlines, of which none is an opening.
    ///
    /// # Errors
    /// Outlines that cannot be stones.
    pub fn of(outlines: &[Outline], closing: &Closing) -> Result<Face, Vec<Trouble>> {
        let hulls: Vec<Polygon> = outlines.iter().map(|own| simplified(&own.hull(), closing.grain)).collect();
        let found = troubles(outlines, &hulls, closing.grain > 0.0);
        if !found.is_empty() {
            return Err(found);
        }
        let fixed: Vec<bool> = outlines.iter().map(|own| own.part == Part::Ground).collect();
        let border = Border::along(outlines, closing.grain.max(FINE * closing.widest));
        // Points are in the middle of what they stand for.
        let coarse = border.spacing.iter().copied().fold(closing.grain, f64::max);
        let meetings = border.meetings(closing.widest + coarse);
        let tolerance = closing.grain.max(STRAIGHT * closing.widest);
        let joints = joints((&hulls, &fixed), &meetings, (&border.spacing, tolerance, closing.widest));
        let level = level(outlines, &fixed);
        let grounds: Vec<Option<Line>> = border
            .points
            .iter()
            .zip(&fixed)
            .map(|(points, fixed)| {
                let near = |level: &f64| {
                    let low = points.iter().filter(|point| point[1] - level <= closing.widest + coarse);
                    !fixed && low.count() >= STANDING
                };
                level.filter(near).map(|level| Line { normal: [0.0, -1.0], offset: -level })
            })
            .collect();
        let polygons = cells((&hulls, &fixed), &joints, &meetings, (&grounds, closing.widest));
        let vanished = |(outline, own): (usize, &Polygon)| {
            (own.vertices.len() < 3 || own.area() <= 0.0).then_some(Trouble::Vanishes { outline })
        };
        let vanished: Vec<Trouble> = polygons.iter().enumerate().filter_map(vanished).collect();
        if !vanished.is_empty() {
            return Err(vanished);
        }
        let gained =
            polygons.iter().zip(outlines).map(|(own, outline)| own.area() / outline.area() - 1.0).collect();
        let mut widths: Vec<f64> = joints
            .iter()
            .filter_map(|joint| meetings.get(&joint.stones))
            .filter_map(|own| own.widths.get(own.widths.len() / 2).copied())
            .collect();
        widths.sort_by(f64::total_cmp);
        let widest = widths.last().copied().unwrap_or(0.0);
        let meets = |stone: usize| joints.iter().any(|own| own.stones.0 == stone || own.stones.1 == stone);
        let is_alone = |stone: &usize| !fixed[*stone] && grounds[*stone].is_none() && !meets(*stone);
        let alone = (0..outlines.len()).filter(is_alone).map(|stone| (stone, border.gap(stone)));
        Ok(Face {
            alone: alone.collect(),
            polygons,
            gained,
            joints: joints.iter().filter_map(|own| closed(own, meetings.get(&own.stones)?)).collect(),
            widths: [widths.get(widths.len() / 2).copied().unwrap_or(0.0), widest],
            standing: (0..outlines.len()).filter(|stone| grounds[*stone].is_some()).collect(),
        })
    }
}

/// A joint with the widths of its gap, which are in order of size.
fn closed(joint: &Joint, meeting: &Meeting) -> Option<Closed> {
    let widths = &meeting.widths;
    let mean = widths.iter().sum::<f64>() / widths.len() as f64;
    let [from, to] = joint.ends;
    Some(Closed { stones: joint.stones, widths: [mean, *widths.last()?], length: distance(from, to) })
}

/// The lowest level of the stones, on which they stand where no ground is drawn.
fn level(outlines: &[Outline], fixed: &[bool]) -> Option<f64> {
    let lowest =
        outlines.iter().flat_map(|own| &own.points).map(|point| point[1]).fold(f64::INFINITY, f64::min);
    (!fixed.contains(&true) && lowest.is_finite()).then_some(lowest)
}
