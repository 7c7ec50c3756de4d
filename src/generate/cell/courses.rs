//! Cells of random courses.

use crate::generate::cell::bond::{begun_at, slab};
use crate::generate::course::{Bed, Lengths, MAX_STONES, Neighbour, fill_at_random};
use crate::generate::coursed::{Coursed, Source, draw_bed, draw_course};
use crate::generate::draft::{Draft, Fault, Stone};
use crate::random::Family;

/// Lays so many random courses from below upwards.
pub(crate) fn lay(draft: &mut Draft, ask: &Coursed, count: u32) -> Result<Vec<Stone>, Fault> {
    let source = Source::of(ask.sizes);
    let (heights, groups): (Vec<f64>, Vec<usize>) = courses(draft, ask, &source, count)?.into_iter().unzip();
    let beds = beds(draft, ask.dip, &heights)?;
    let (mut stones, mut joints) = (Vec::new(), Vec::<Vec<f64>>::new());
    for index in 0..heights.len() {
        let own = source.lengths(groups[index]);
        let neighbours = laid_beside(index, heights.len()).map(|other| Neighbour {
            joints: joints[other].clone(),
            clear: ask.clear([own, source.lengths(groups[other])]),
            is_across: other + 1 != index,
        });
        let neighbours: Vec<Neighbour> = neighbours.collect();
        let begin = begin(draft, index as u32, &neighbours)?;
        let neighbours: Vec<Neighbour> =
            neighbours.iter().map(|other| seen_from(draft, other, begin)).collect();
        let (slab, lengths) =
            (slab(draft, [beds[index], beds[index + 1]]), Lengths { family: own, factor: ask.factor });
        let course = fill_at_random(draft, &slab, index as u32, &lengths, &neighbours)?;
        let (laid, own_joints) = course.finish(draft, heights[index]);
        stones.extend(begun_at(draft, laid, begin));
        joints.push(own_joints.into_iter().map(|joint| joint + begin).collect());
        if stones.len() > MAX_STONES {
            return Err(Fault::TooMany { limit: MAX_STONES });
        }
    }
    Ok(stones)
}

/// The courses next to a course that are laid before it: that below, and for the last one the first, which lies above it in the
/// next cell.
fn laid_beside(index: usize, count: usize) -> impl Iterator<Item = usize> {
    let above = (index + 1 == count && index > 1).then_some(0);
    index.checked_sub(1).into_iter().chain(above)
}

/// Heights of courses that fill the cell, each with the group of its stones: drawn, then all scaled by the same factor.
fn courses(
    draft: &mut Draft,
    ask: &Coursed,
    source: &Source,
    count: u32,
) -> Result<Vec<(f64, usize)>, Fault> {
    let mut courses = Vec::with_capacity(count as usize);
    for index in 0..count as usize {
        courses.push(draw_course(draft, ask, source, index)?);
    }
    draft.tally.first_heights.extend(courses.iter().map(|(height, _)| height));
    let sum: f64 = courses.iter().map(|(height, _)| height).sum();
    let goal = draft.layout.outline.height;
    courses.iter_mut().for_each(|(height, _)| *height *= goal / sum);
    Ok(courses)
}

/// A bed under every course, each with its own dip, and the first one again on top of the last course.
fn beds(draft: &mut Draft, dip: &Family, heights: &[f64]) -> Result<Vec<Bed>, Fault> {
    let (outline, mut level) = (draft.layout.outline, 0.0);
    let mut beds: Vec<Bed> = Vec::with_capacity(heights.len() + 1);
    let top = |first: &Bed| Bed { level: first.level + outline.height, ..*first };
    for (index, height) in heights.iter().enumerate() {
        let below = beds.last().map(|bed| bed.corners(&outline));
        let above =
            (index + 1 == heights.len()).then(|| beds.first().map(|first| top(first).corners(&outline)));
        beds.push(draw_bed(draft, dip, index, level, [below, above.flatten()])?);
        level += height;
    }
    beds.push(top(&beds[0]));
    Ok(beds)
}

/// Where a course begins, in [0, length) of the cell (m), drawn until the head joint there keeps clear of its neighbours.
fn begin(draft: &mut Draft, index: u32, neighbours: &[Neighbour]) -> Result<f64, Fault> {
    let length = draft.layout.outline.length;
    let mut stream = draft.stream("cell phase", index);
    let mut redraws = 0;
    loop {
        let begin = length * stream.uniform();
        let clear = neighbours.iter().try_for_each(|other| seen_from(draft, other, begin).keeps_clear(0.0));
        let Err(fault) = clear else { return Ok(begin) };
        draft.tally.redraws += 1;
        redraws += 1;
        if redraws > draft.layout.limits.max_redraws {
            return Err(Fault::Course { course: index, fault });
        }
    }
}

/// The head joints of a neighbour counted from where a course begins, with those of the cells on both sides.
fn seen_from(draft: &Draft, other: &Neighbour, begin: f64) -> Neighbour {
    let length = draft.layout.outline.length;
    let repeated = other.joints.iter().flat_map(|joint| {
        let from_begin = (joint - begin).rem_euclid(length);
        [from_begin - length, from_begin, from_begin + length]
    });
    Neighbour { joints: repeated.collect(), ..*other }
}
