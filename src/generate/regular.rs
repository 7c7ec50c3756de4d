//! Stack bond and running bond: equal courses of equal stones.

use crate::generate::course::{Bed, Course, MAX_STONES, slabs};
use crate::generate::draft::{CUT_TOLERANCE, CourseFault, Draft, Fault, Stone};
use crate::random::Stream;

/// Lays equal courses of equal stones; every odd course (counted from 0 at the base) begins with a stone of the
/// share `overlap` of the length, none when it is 0.
///
/// The number of courses is rounded so that they fill the height. A stone at an end of the wall that is too short
/// for the limits is merged into its neighbour.
pub(crate) fn lay(draft: &mut Draft, length: f64, height: f64, overlap: f64) -> Result<Vec<Stone>, Fault> {
    let outline = &draft.layout.outline;
    let count = (outline.height / height).round().max(1.0);
    let per_course = outline.length / length;
    let stones = count * per_course;
    if stones.is_nan() || stones > MAX_STONES as f64 {
        return Err(Fault::TooMany { limit: MAX_STONES });
    }
    let level = |i: f64| outline.height * (i / count);
    let beds: Vec<Bed> = (1..count as u32).map(|i| Bed { level: level(f64::from(i)), slope: 0.0 }).collect();
    let slabs = slabs(outline, &beds)?;
    let mut stones = Vec::new();
    for (index, slab) in slabs.iter().enumerate() {
        let index = index as u32;
        let mut headers = draft.stream("header", index);
        let mut course = Course::new(draft, slab, index);
        let first = if index % 2 == 1 && overlap > 0.0 { overlap * length } else { length };
        fill(draft, &mut course, first, length, &mut headers)
            .map_err(|fault| Fault::Course { course: index, fault })?;
        stones.extend(course.finish(draft, outline.height / count).0);
    }
    Ok(stones)
}

/// Fills a course with stones of `length` after a first one of length `first`.
fn fill(
    draft: &mut Draft,
    course: &mut Course,
    first: f64,
    length: f64,
    headers: &mut Stream,
) -> Result<(), CourseFault> {
    let header = draft.is_header(headers);
    match course.lay(draft, first, header) {
        Err(_) if first < length => {
            course.lay(draft, first + length, header)?;
            draft.merges += 1;
        }
        laid => laid?,
    }
    while !course.is_full() {
        let header = draft.is_header(headers);
        let is_last = course.rest() <= length + CUT_TOLERANCE;
        match course.lay(draft, length, header) {
            Err(_) if is_last => course.merge_rest(draft)?,
            laid => laid?,
        }
    }
    Ok(())
}
