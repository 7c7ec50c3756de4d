//! Random courses: heights, beds with one dip each, and stone lengths.

use crate::generate::Sizes;
use crate::generate::course::{Bed, Lengths, MAX_STONES, fill_at_random, slabs};
use crate::generate::draft::{Draft, Fault, Stone};
use crate::generate::sorted::Sorted;
use crate::math::tan;
use crate::random::Family;

/// What a coursed wall asks for: see [`crate::generate::Arrangement::Coursed`].
pub(crate) struct Coursed<'a> {
    pub(crate) sizes: &'a Sizes,
    pub(crate) factor: f64,
    pub(crate) dip: &'a Family,
    pub(crate) least_overlap: f64,
}

/// Lays random courses from the base up.
pub(crate) fn lay(draft: &mut Draft, ask: &Coursed) -> Result<Vec<Stone>, Fault> {
    let source = Source::of(ask.sizes);
    let (heights, groups): (Vec<f64>, Vec<usize>) = courses(draft, ask, &source)?.into_iter().unzip();
    let beds = beds(draft, ask.dip, &heights)?;
    let slabs = slabs(&draft.layout.outline, &beds)?;
    let clear = ask.least_overlap * ask.factor * ask.sizes.means()[0];
    let (mut stones, mut joints) = (Vec::new(), Vec::new());
    for (index, slab) in slabs.iter().enumerate() {
        let lengths = Lengths { family: source.lengths(groups[index]), factor: ask.factor, clear };
        let course = fill_at_random(draft, slab, index as u32, &lengths, &joints)?;
        let laid;
        (laid, joints) = course.finish(draft, heights[index]);
        stones.extend(laid);
        if stones.len() > MAX_STONES {
            return Err(Fault::TooMany { limit: MAX_STONES });
        }
    }
    Ok(stones)
}

/// Where courses take their heights and the lengths of their stones from.
enum Source<'a> {
    /// All from the same two distributions.
    Apart { length: &'a Family, height: &'a Family },
    /// Each from surveyed stones of like height.
    Together(Sorted),
}

impl<'a> Source<'a> {
    fn of(sizes: &'a Sizes) -> Source<'a> {
        match sizes {
            Sizes::Apart { length, height } => Source::Apart { length, height },
            Sizes::Together { stones } => Source::Together(Sorted::of(stones)),
        }
    }

    /// Height of a course (m) at `u` in (0, 1), and the group of its stones.
    fn course(&self, u: f64) -> (f64, usize) {
        match self {
            Source::Apart { height, .. } => (height.quantile(u), 0),
            Source::Together(sorted) => sorted.course(u),
        }
    }

    /// Lengths (m) of the stones of a group.
    fn lengths(&self, group: usize) -> &Family {
        match self {
            Source::Apart { length, .. } => length,
            Source::Together(sorted) => sorted.lengths(group),
        }
    }
}

/// Heights of courses that fill the wall, each with the group of its stones: drawn until their sum passes the wall's height, the
/// last one left out when the sum is nearer without it, then all scaled by the same factor.
///
/// A height below the smallest stone size is redrawn.
fn courses(draft: &mut Draft, ask: &Coursed, source: &Source) -> Result<Vec<(f64, usize)>, Fault> {
    let goal = draft.layout.outline.height;
    let least = draft.layout.limits.min_size;
    let mut courses: Vec<(f64, usize)> = Vec::new();
    let mut sum = 0.0;
    while sum < goal {
        let mut stream = draft.stream("course height", courses.len());
        let mut group = 0;
        let [height] = draft.draw_several("course height", least, || {
            let (height, own) = source.course(stream.uniform());
            group = own;
            [ask.factor * height]
        })?;
        courses.push((height, group));
        sum += height;
        if courses.len() > MAX_STONES {
            return Err(Fault::TooMany { limit: MAX_STONES });
        }
    }
    draft.tally.first_heights.extend(courses.iter().map(|(height, _)| height));
    if let [.., (last, _)] = courses[..]
        && courses.len() > 1
        && sum - goal > goal - (sum - last)
    {
        courses.pop();
        sum -= last;
    }
    courses.iter_mut().for_each(|(height, _)| *height *= goal / sum);
    Ok(courses)
}

/// One bed on top of every course but the last, each with its own dip.
///
/// A dip is redrawn while the bed crosses the one below (or the top of the wall) inside the section, or comes
/// closer to it than the smallest stone size at a face.
fn beds(draft: &mut Draft, dip: &Family, heights: &[f64]) -> Result<Vec<Bed>, Fault> {
    let outline = &draft.layout.outline;
    let (least, draws) = (draft.layout.limits.min_size, draft.layout.limits.max_redraws + 1);
    let ceiling = [outline.height; 2];
    let clears = |low: [f64; 2], high: [f64; 2]| (0..2).all(|face| high[face] - low[face] >= least);
    let (mut beds, mut below, mut level) = (Vec::with_capacity(heights.len()), [0.0; 2], 0.0);
    for (index, height) in heights[..heights.len() - 1].iter().enumerate() {
        level += height;
        let is_last = index + 2 == heights.len();
        let mut stream = draft.stream("bed dip", index);
        let mut found = None;
        for draw in 0..draws {
            let angle = dip.sample(&mut stream);
            if draw == 0 {
                draft.tally.first_dips.push(angle);
            }
            let bed = Bed { level, slope: tan(angle) };
            let corners = bed.corners(outline);
            if clears(below, corners) && (!is_last || clears(corners, ceiling)) {
                found = Some((bed, angle, corners));
                break;
            }
            draft.tally.redraws += 1;
        }
        let Some((bed, angle, corners)) = found else {
            return Err(Fault::BedsCross { bed: index + 1, limit: least, draws });
        };
        draft.realised.dips.push(angle);
        below = corners;
        beds.push(bed);
    }
    Ok(beds)
}
