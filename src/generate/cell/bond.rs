//! Cells of stack bond and running bond, and what all courses of a cell share: their slabs and where they begin.

use crate::generate::course::{Bed, Course};
use crate::generate::draft::{CUT_TOLERANCE, Draft, Fault, Stone};
use crate::math::Vec3;
use crate::shape::Polyhedron;

/// Lays equal courses of equal stones, each shifted by its share of the stone length.
pub(crate) fn lay(
    draft: &mut Draft,
    [along, courses]: [u32; 2],
    length: f64,
    overlap: f64,
) -> Result<Vec<Stone>, Fault> {
    let height = draft.layout.outline.height / f64::from(courses);
    let bed = |index: u32| Bed { level: height * f64::from(index), slope: 0.0 };
    let mut stones = Vec::new();
    for index in 0..courses {
        let mut headers = draft.stream("header", index);
        let slab = slab(draft, [bed(index), bed(index + 1)]);
        let mut course = Course::new(draft, &slab, index);
        for _ in 0..along {
            let header = draft.is_header(&mut headers);
            course
                .lay(draft, length, header)
                .map_err(|fault| Fault::Course { course: index, fault: fault.into() })?;
        }
        let laid = course.finish(draft, height).0;
        stones.extend(begun_at(draft, laid, length * shift(overlap, index, courses)));
    }
    Ok(stones)
}

/// Where a course begins, as a share of the stone length in [0, 1); for the course `courses` the next cell.
///
/// An even number of courses shifts every other one, as a wall does. An odd number shifts each from the one below, as the only
/// course of a cell of one stone must.
pub(crate) fn shift(overlap: f64, course: u32, courses: u32) -> f64 {
    let steps = if courses.is_multiple_of(2) { course % 2 } else { course };
    (overlap * f64::from(steps)).fract()
}

/// The solid between two beds, as long as the cell.
pub(crate) fn slab(draft: &Draft, beds: [Bed; 2]) -> Polyhedron {
    let outline = &draft.layout.outline;
    let [back, front] = outline.faces_at(0.0);
    let [low, high] = beds.map(|bed| bed.corners(outline));
    let length = outline.length;
    Polyhedron::hexahedron([
        Vec3::new(0.0, back, low[0]),
        Vec3::new(length, back, low[0]),
        Vec3::new(length, front, low[1]),
        Vec3::new(0.0, front, low[1]),
        Vec3::new(0.0, back, high[0]),
        Vec3::new(length, back, high[0]),
        Vec3::new(length, front, high[1]),
        Vec3::new(0.0, front, high[1]),
    ])
}

/// The stones of a course that was laid from x = 0, moved to where it begins, in [0, length) of the cell (m). Those whose middle
/// would lie beyond the cell are taken from the cell to the left instead.
pub(crate) fn begun_at(draft: &Draft, stones: Vec<Stone>, begin: f64) -> impl Iterator<Item = Stone> + use<> {
    let length = draft.layout.outline.length;
    stones.into_iter().map(move |mut stone| {
        let (low, high) = stone.shape.bounds();
        let is_beyond = 0.5 * (low.x + high.x) + begin >= length - CUT_TOLERANCE;
        let by = if is_beyond { begin - length } else { begin };
        stone.shape = stone.shape.translated(&Vec3::new(by, 0.0, 0.0));
        stone
    })
}
