//! Random courses: heights, beds with one dip each, and stone lengths.

use crate::generate::Sizes;
use crate::generate::course::{Bed, Lengths, MAX_STONES, Neighbour, fill_at_random, slabs};
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

impl Coursed<'_> {
    /// How far apart (m) the head joints of two neighbouring courses must be: by a share of the shorter stones.
    pub(crate) fn clear(&self, lengths: [&Family; 2]) -> f64 {
        self.least_overlap * self.factor * lengths[0].mean().min(lengths[1].mean())
    }
}

/// Lays random courses from the base up.
pub(crate) fn lay(draft: &mut Draft, ask: &Coursed) -> Result<Vec<Stone>, Fault> {
    let source = Source::of(ask.sizes);
    let (heights, groups): (Vec<f64>, Vec<usize>) = courses(draft, ask, &source)?.into_iter().unzip();
    let beds = beds(draft, ask.dip, &heights)?;
    let slabs = slabs(&draft.layout.outline, &beds)?;
    let (mut stones, mut joints) = (Vec::new(), Vec::new());
    for (index, slab) in slabs.iter().enumerate() {
        let [own, below] =
            [groups[index], groups[index.saturating_sub(1)]].map(|group| source.lengths(group));
        let neighbour = Neighbour { joints, clear: ask.clear([own, below]), is_across: false };
        let lengths = Lengths { family: own, factor: ask.factor };
        let course = fill_at_random(draft, slab, index as u32, &lengths, &[neighbour])?;
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
pub(crate) enum Source<'a> {
    /// All from the same two distributions.
    Apart { length: &'a Family, height: &'a Family },
    /// Each from surveyed stones of like height.
    Together(Sorted),
}

impl<'a> Source<'a> {
    pub(crate) fn of(sizes: &'a Sizes) -> Source<'a> {
        match sizes {
            Sizes::Apart { length, height } => Source::Apart { length, height },
            Sizes::Together { stones } => Source::Together(Sorted::of(stones)),
        }
    }

    /// Height of a course (m) at `u` in (0, 1), and the group of its stones.
    pub(crate) fn course(&self, u: f64) -> (f64, usize) {
        match self {
            Source::Apart { height, .. } => (height.quantile(u), 0),
            Source::Together(sorted) => sorted.course(u),
        }
    }

    /// Lengths (m) of the stones of a group.
    pub(crate) fn lengths(&self, group: usize) -> &Family {
        match self {
            Source::Apart { length, .. } => length,
            Source::Together(sorted) => sorted.lengths(group),
        }
    }
}

/// Heights of courses that fill the wall, each with the group of its stones: drawn until their sum passes the wall's height, the
/// last one left out when the sum is nearer without it, then all scaled by the same factor.
fn courses(draft: &mut Draft, ask: &Coursed, source: &Source) -> Result<Vec<(f64, usize)>, Fault> {
    let goal = draft.layout.outline.height;
    let mut courses: Vec<(f64, usize)> = Vec::new();
    let mut sum = 0.0;
    while sum < goal {
        let course = draw_course(draft, ask, source, courses.len())?;
        courses.push(course);
        sum += course.0;
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

/// The height (m) of one course before it is fitted to the others, and the group of its stones. One below the smallest stone size
/// is redrawn.
pub(crate) fn draw_course(
    draft: &mut Draft,
    ask: &Coursed,
    source: &Source,
    index: usize,
) -> Result<(f64, usize), Fault> {
    let least = draft.layout.limits.min_size;
    let mut stream = draft.stream("course height", index);
    let mut group = 0;
    let [height] = draft.draw_several("course height", least, || {
        let (height, own) = source.course(stream.uniform());
        group = own;
        [ask.factor * height]
    })?;
    Ok((height, group))
}

/// One bed on top of every course but the last, each with its own dip.
fn beds(draft: &mut Draft, dip: &Family, heights: &[f64]) -> Result<Vec<Bed>, Fault> {
    let ceiling = [draft.layout.outline.height; 2];
    let (mut beds, mut below, mut level) = (Vec::with_capacity(heights.len()), [0.0; 2], 0.0);
    for (index, height) in heights[..heights.len() - 1].iter().enumerate() {
        level += height;
        let above = (index + 2 == heights.len()).then_some(ceiling);
        let bed = draw_bed(draft, dip, index, level, [Some(below), above])?;
        below = bed.corners(&draft.layout.outline);
        beds.push(bed);
    }
    Ok(beds)
}

/// One bed at a level, between the heights at the back and the front face (m) of what lies below and above it.
///
/// A dip is redrawn while the bed crosses one of them inside the section, or comes closer to it than the smallest stone size at
/// a face.
pub(crate) fn draw_bed(
    draft: &mut Draft,
    dip: &Family,
    index: usize,
    level: f64,
    [below, above]: [Option<[f64; 2]>; 2],
) -> Result<Bed, Fault> {
    let (least, draws) = (draft.layout.limits.min_size, draft.layout.limits.max_redraws + 1);
    let clears = |low: [f64; 2], high: [f64; 2]| (0..2).all(|face| high[face] - low[face] >= least);
    let mut stream = draft.stream("bed dip", index);
    for draw in 0..draws {
        let angle = dip.sample(&mut stream);
        if draw == 0 {
            draft.tally.first_dips.push(angle);
        }
        let bed = Bed { level, slope: tan(angle) };
        let corners = bed.corners(&draft.layout.outline);
        if below.is_none_or(|below| clears(below, corners))
            && above.is_none_or(|above| clears(corners, above))
        {
            draft.realised.dips.push(angle);
            return Ok(bed);
        }
        draft.tally.redraws += 1;
    }
    Err(Fault::BedsCross { bed: index + 1, limit: least, draws })
}
