//! Courses: the slab between two beds, and the stones between its head joints.

use crate::generate::Outline;
use crate::generate::draft::{CUT_TOLERANCE, CourseFault, Draft, Extent, Fault, Stone};
use crate::generate::outline::StoneFault;
use crate::math::Vec3;
use crate::random::{Family, Stream};
use crate::shape::{Plane, Polyhedron};

/// After so many unusable draws of one length the course is begun anew: the stones laid so far may leave no room.
const STEP_BACK: u32 = 8;
/// More stones than this are a mistaken request (m-sized walls of mm-sized stones).
pub(crate) const MAX_STONES: usize = 20_000;

/// A bed: a plane parallel to the wall's long axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bed {
    /// Height at the middle of the section (m).
    pub(crate) level: f64,
    /// Rise towards the front per metre: tangent of the dip.
    pub(crate) slope: f64,
}

impl Bed {
    /// The heights at which the bed meets the back and the front face (m).
    pub(crate) fn corners(&self, outline: &Outline) -> [f64; 2] {
        let middle = outline.middle_at(self.level);
        let (low, high) = (outline.faces_at(0.0), outline.faces_at(outline.height));
        [0, 1].map(|face| {
            // The bed z = level + slope (y - middle) and the face y = low + lean z.
            let lean = (high[face] - low[face]) / outline.height;
            (self.level + self.slope * (low[face] - middle)) / (1.0 - self.slope * lean)
        })
    }

    /// The bed as a plane with its normal up.
    pub(crate) fn plane(&self, outline: &Outline) -> Plane {
        let point = Vec3::new(0.0, outline.middle_at(self.level), self.level);
        Plane::through(point, Vec3::new(0.0, -self.slope, 1.0))
    }
}

/// The slabs between the beds, from the base up.
pub(crate) fn slabs(outline: &Outline, beds: &[Bed]) -> Result<Vec<Polyhedron>, Fault> {
    let mut slabs = Vec::with_capacity(beds.len() + 1);
    let mut rest = outline.solid();
    for (bed, plane) in beds.iter().map(|b| b.plane(outline)).enumerate() {
        let (Some(below), Some(above)) = rest.cut(&plane, CUT_TOLERANCE) else {
            let fault = CourseFault::Stone(StoneFault::Vanished);
            return Err(Fault::Course { course: bed as u32, fault });
        };
        slabs.push(below);
        rest = above;
    }
    slabs.push(rest);
    Ok(slabs)
}

/// A course being filled from x = 0 to the end of the wall or cell.
pub(crate) struct Course<'s> {
    slab: &'s Polyhedron,
    index: u32,
    length: f64,
    extent: Extent,
    /// Head joints, as the middle of their slots, with both ends (m).
    joints: Vec<f64>,
    /// The stones between them, each whole or in its wythes, and whether it is a header.
    laid: Vec<(Vec<Stone>, bool)>,
}

impl<'s> Course<'s> {
    /// An empty course in its slab, which spans the length of the draft's outline.
    pub(crate) fn new(draft: &Draft, slab: &'s Polyhedron, index: u32) -> Self {
        let (length, extent) = (draft.layout.outline.length, draft.extent);
        Course { slab, index, length, extent, joints: vec![0.0], laid: Vec::new() }
    }

    fn end(&self) -> f64 {
        self.joints[self.joints.len() - 1]
    }

    /// Length still to be filled (m).
    pub(crate) fn rest(&self) -> f64 {
        self.length - self.end()
    }

    pub(crate) fn is_full(&self) -> bool {
        self.end() >= self.length
    }

    /// The stone from the last joint to `to`, less its half of the slots at its head joints.
    fn stone(&self, from: f64, to: f64, gap: f64) -> Option<Polyhedron> {
        let goes_on = self.extent == Extent::Cell;
        let left = if from > 0.0 || goes_on { from + 0.5 * gap } else { from };
        let right = if to < self.length || goes_on { to - 0.5 * gap } else { to };
        let (_, rest) = self.slab.cut(&Plane { normal: Vec3::x(), offset: left }, CUT_TOLERANCE);
        rest?.cut(&Plane { normal: Vec3::x(), offset: right }, CUT_TOLERANCE).0
    }

    /// Lays one stone of the given length; the one that reaches the end is cut to what is left there.
    pub(crate) fn lay(&mut self, draft: &Draft, length: f64, header: bool) -> Result<(), StoneFault> {
        let to = self.end() + length;
        let to = if to >= self.length - CUT_TOLERANCE { self.length } else { to };
        let shape = self.stone(self.end(), to, draft.layout.head_joint_gap).ok_or(StoneFault::Vanished)?;
        let stones = draft.dress(shape, header, self.index, self.laid.len() as u64)?;
        self.laid.push((stones, header));
        self.joints.push(to);
        Ok(())
    }

    /// Fills the rest of the course by making the last stone longer: a rest too short to be a stone is merged into
    /// its neighbour. No head cut is made between them, so the merged stone is convex.
    pub(crate) fn merge_rest(&mut self, draft: &mut Draft) -> Result<(), StoneFault> {
        let Some((_, header)) = self.laid.pop() else { return Err(StoneFault::Vanished) };
        self.joints.pop();
        self.lay(draft, self.rest(), header)?;
        draft.merges += 1;
        Ok(())
    }

    /// Closes the full course: its stones, and its head joints for the courses that follow. The ends of a wall are none; those of
    /// a cell are one, at its beginning.
    pub(crate) fn finish(self, draft: &mut Draft, height: f64) -> (Vec<Stone>, Vec<f64>) {
        let first = if self.extent == Extent::Cell { 0 } else { 1 };
        let joints = self.joints[first..self.joints.len() - 1].to_vec();
        // The slab is a prism along x, so that a slot has its section.
        draft.gaps += self.slab.volume() / self.length * draft.layout.head_joint_gap * joints.len() as f64;
        draft.realised.heights.push(height);
        draft.realised.lengths.extend(self.joints.windows(2).map(|pair| pair[1] - pair[0]));
        (self.laid.into_iter().flat_map(|(stones, _)| stones).collect(), joints)
    }
}

/// How the head joints of a random course are drawn.
pub(crate) struct Lengths<'a> {
    pub(crate) family: &'a Family,
    /// Factor on every length of this wall.
    pub(crate) factor: f64,
}

/// The head joints (m) of a course above or below, and how far from them (m) others must stay.
pub(crate) struct Neighbour {
    pub(crate) joints: Vec<f64>,
    pub(crate) clear: f64,
    /// Whether it is the first course of the next cell, which lies above, instead of the course below.
    pub(crate) is_across: bool,
}

impl Neighbour {
    /// A fault when a head joint at `x` (m) comes too close.
    pub(crate) fn keeps_clear(&self, x: f64) -> Result<(), CourseFault> {
        let clear = self.clear;
        if !self.joints.iter().any(|joint| (joint - x).abs() < clear) {
            return Ok(());
        }
        Err(if self.is_across {
            CourseFault::OverlapAcross { clear }
        } else {
            CourseFault::Overlap { clear }
        })
    }
}

/// Fills a course with random lengths, at most `max_redraws` unusable draws in all.
///
/// A draw is unusable when its stone breaks the limits or its head joint comes too close to one of a
/// neighbour. The stone that reaches the end takes what is left; a rest too short to be a stone is merged into its
/// neighbour.
pub(crate) fn fill_at_random<'s>(
    draft: &mut Draft,
    slab: &'s Polyhedron,
    index: u32,
    lengths: &Lengths,
    neighbours: &[Neighbour],
) -> Result<Course<'s>, Fault> {
    let mut stream = draft.stream("stone length", index);
    let mut headers = draft.stream("header", index);
    let mut course = Course::new(draft, slab, index);
    let (mut redraws, mut stuck, mut header) = (0, 0, draft.is_header(&mut headers));
    while !course.is_full() {
        match draw_stone(draft, &mut course, lengths, neighbours, header, &mut stream, redraws == 0) {
            Ok(()) => {
                stuck = 0;
                header = draft.is_header(&mut headers);
            }
            Err(fault) => {
                (redraws, stuck) = (redraws + 1, stuck + 1);
                draft.tally.redraws += 1;
                if redraws > draft.layout.limits.max_redraws {
                    return Err(Fault::Course { course: index, fault });
                }
                if stuck > STEP_BACK {
                    (course, stuck) = (Course::new(draft, slab, index), 0);
                }
            }
        }
        if course.laid.len() > MAX_STONES {
            return Err(Fault::TooMany { limit: MAX_STONES });
        }
    }
    Ok(course)
}

/// Draws one length and lays its stone.
fn draw_stone(
    draft: &mut Draft,
    course: &mut Course,
    lengths: &Lengths,
    neighbours: &[Neighbour],
    header: bool,
    stream: &mut Stream,
    first: bool,
) -> Result<(), CourseFault> {
    let drawn = lengths.factor * lengths.family.sample(stream);
    if first {
        draft.tally.first_lengths.push(drawn);
    }
    if drawn.is_nan() || drawn <= 0.0 {
        return Err(CourseFault::NotPositive);
    }
    let to = course.end() + drawn;
    if to >= course.length - CUT_TOLERANCE {
        return match course.lay(draft, drawn, header) {
            Ok(()) => Ok(()),
            Err(fault) if course.laid.is_empty() => Err(fault.into()),
            Err(_) => course.merge_rest(draft).map_err(CourseFault::from),
        };
    }
    neighbours.iter().try_for_each(|own| own.keeps_clear(to))?;
    course.lay(draft, drawn, header).map_err(CourseFault::from)
}
