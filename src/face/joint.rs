//! The line that each joint follows, and one line for joints that continue each other.

use std::collections::{BTreeMap, BTreeSet};

use crate::face::border::Meeting;
use crate::face::line::{Fit, Line, dot, followed, minus};
use crate::math::Sets;
use crate::shape::Polygon;

/// A joint is at least this many spacings of its points long, and this many times as long as wide. What is shorter are corners that meet: they
/// show no direction, and the joints beside them part them.
const SHORTEST: f64 = 3.0;
const SLENDER: f64 = 2.0;
/// Points of a joint scatter about its line by at most this share of its length.
const SCATTER: f64 = 0.25;
/// Joints that continue each other differ in direction by less than that of this cosine (10 degrees).
const SAME_WAY: f64 = 0.985;

/// Where two stones meet along a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The stones, by their outlines.
    pub stones: (usize, usize),
    /// The line between them; the second one is beyond it.
    pub line: Line,
    /// Its ends on the line that its own points follow.
    pub ends: [[f64; 2]; 2],
    fit: Fit,
}

/// The joints of meetings of outlines with these hulls. Joints of one line may be `tolerance` (m) off it, or up to `widest` (m) where they would part a
/// stone from its neighbour otherwise.
pub fn joints(
    (hulls, fixed): (&[Polygon], &[bool]),
    meetings: &BTreeMap<(usize, usize), Meeting>,
    (spacing, tolerance, widest): (&[f64], f64, f64),
) -> Vec<Joint> {
    let mut found: Vec<Joint> = meetings
        .iter()
        .filter_map(|(&(a, b), meeting)| {
            let spacing = spacing[a].max(spacing[b]);
            joint((a, b), meeting, ([&hulls[a], &hulls[b]], [fixed[a], fixed[b]]), spacing)
        })
        .collect();
    straighten(&mut found, meetings, (tolerance, widest, hulls.len()));
    found
}

/// The joint along the points midway, or along the side that parts the hulls best where those points turn a corner.
fn joint(
    stones: (usize, usize),
    meeting: &Meeting,
    ([a, b], fixed): ([&Polygon; 2], [bool; 2]),
    spacing: f64,
) -> Option<Joint> {
    if fixed == [true, true] {
        return None;
    }
    let (line, points) = followed(&meeting.midway)?;
    let line = line.towards(minus(b.moments().centroid(), a.moments().centroid()));
    let extent = |line: &Line| {
        let along = [-line.normal[1], line.normal[0]];
        let places = points.iter().map(|point| dot(along, *point));
        let (low, high) =
            places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)));
        let at = |s: f64| [0, 1].map(|k| s * along[k] + line.offset * line.normal[k]);
        ([at(low), at(high)], high - low)
    };
    let (ends, length) = extent(&line);
    let scatter = points.iter().map(|point| line.beyond(*point).abs()).fold(0.0, f64::max);
    let widest = meeting.widths.last().copied().unwrap_or(0.0);
    let usual = meeting.widths.get(meeting.widths.len() / 2).copied().unwrap_or(0.0);
    let shortest = (SHORTEST * spacing).max(SLENDER * usual);
    if length < shortest {
        return None;
    }
    let parting = parting([a, b], fixed)?;
    // What the line may cut off the hulls besides what the best one does: a strip as wide as the joint.
    let strip = length * (0.5 * widest + spacing);
    let is_free = !fixed.contains(&true);
    if is_free && scatter <= SCATTER * length && cut(&line, a, b) <= cut(&parting, a, b) + strip {
        return Some(Joint { stones, line, ends, fit: Fit::of(&points) });
    }
    let (ends, length) = extent(&parting);
    let fit = Fit::of(&ends);
    (length >= shortest).then_some(Joint { stones, line: parting, ends, fit })
}

/// The line along a side of one of two polygons, in the middle of what is between them, that parts them most, or cuts least deep. Where one is
/// fixed, it is that one's side.
fn parting([a, b]: [&Polygon; 2], fixed: [bool; 2]) -> Option<Line> {
    let share = if fixed.contains(&true) { 0.0 } else { 0.5 };
    let best = |from: &Polygon, to: &Polygon| {
        let lines = from.sides().filter_map(Line::side).map(|side| {
            let gap = to.vertices.iter().map(|corner| side.beyond(*corner)).fold(f64::INFINITY, f64::min);
            (gap, Line { offset: side.offset + share * gap, ..side })
        });
        lines.max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let (of_a, of_b) = (best(a, b)?, best(b, a)?);
    if fixed.contains(&true) {
        return Some(if fixed[0] { of_a.1 } else { of_b.1.flipped() });
    }
    Some(if of_a.0 >= of_b.0 { of_a.1 } else { of_b.1.flipped() })
}

/// The area (m^2) that a line cuts off two polygons, one on each side of it.
fn cut(line: &Line, a: &Polygon, b: &Polygon) -> f64 {
    let beyond =
        |polygon: &Polygon, line: &Line| polygon.clip(line.offset, -line.normal[0], -line.normal[1]).area();
    beyond(a, line) + beyond(b, &line.flipped())
}

/// Gives joints that continue each other one line: stones bear on all that is below them only where that is one plane. Joints that are one line
/// within `tolerance` (m) become one first. Then those do of which one would cut a stone off the other, within `widest` (m): a stone that
/// follows a ridge in the drawing would stand on the ridge alone, as it is convex here.
fn straighten(
    joints: &mut [Joint],
    meetings: &BTreeMap<(usize, usize), Meeting>,
    (tolerance, widest, stones): (f64, f64, usize),
) {
    let mut of_stone = vec![Vec::new(); stones];
    for (at, joint) in joints.iter().enumerate() {
        of_stone[joint.stones.0].push(at);
        of_stone[joint.stones.1].push(at);
    }
    let mut sets = Sets::new(joints.len());
    let beside = neighbours(joints, &of_stone);
    let across = beyond_corners(joints, &of_stone, meetings);
    let pairs = beside.iter().map(|(_, pair)| *pair).chain(across);
    unite(&mut sets, joints, pairs, tolerance);
    let parted = beside.iter().filter(|(stone, (one, other))| {
        let cuts = |a: usize, b: usize| {
            let middle = [0, 1].map(|k| 0.5 * (joints[b].ends[0][k] + joints[b].ends[1][k]));
            outward(&joints[a], *stone).beyond(middle) > 0.0
        };
        cuts(*one, *other) || cuts(*other, *one)
    });
    let parted: Vec<(usize, usize)> = parted.map(|(_, pair)| *pair).collect();
    unite(&mut sets, joints, parted.into_iter(), widest);
}

/// Pairs of joints along the same side of a stone, with the stone.
fn neighbours(joints: &[Joint], of_stone: &[Vec<usize>]) -> Vec<(usize, (usize, usize))> {
    let mut found = Vec::new();
    for (stone, own) in of_stone.iter().enumerate() {
        for (k, &one) in own.iter().enumerate() {
            let line = outward(&joints[one], stone);
            let same = |other: &&usize| dot(line.normal, outward(&joints[**other], stone).normal) > SAME_WAY;
            found.extend(own[k + 1..].iter().filter(same).map(|other| (stone, (one, *other))));
        }
    }
    found
}

/// Pairs of joints across a corner at which two stones meet: the joint goes on below one of them and above the other.
fn beyond_corners(
    joints: &[Joint],
    of_stone: &[Vec<usize>],
    meetings: &BTreeMap<(usize, usize), Meeting>,
) -> Vec<(usize, usize)> {
    let is_joint: BTreeSet<(usize, usize)> = joints.iter().map(|own| own.stones).collect();
    let mut found = Vec::new();
    for &(a, b) in meetings.keys().filter(|pair| !is_joint.contains(pair)) {
        for &one in &of_stone[a] {
            let line = outward(&joints[one], a);
            let goes_on = |other: &&usize| dot(line.normal, outward(&joints[**other], b).normal) < -SAME_WAY;
            found.extend(of_stone[b].iter().filter(goes_on).map(|other| (one, *other)));
        }
    }
    found
}

/// Puts the sets of pairs together whose ends all lie within `tolerance` (m) of one line, those first that are least off it, and gives all joints
/// the lines of their sets.
fn unite(sets: &mut Sets, joints: &mut [Joint], pairs: impl Iterator<Item = (usize, usize)>, tolerance: f64) {
    let off =
        |pair: (usize, usize)| Some((off_one_line(&[&joints[pair.0], &joints[pair.1]], tolerance)?, pair));
    let mut pairs: Vec<(f64, (usize, usize))> = pairs.filter_map(off).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for (_, pair) in pairs {
        let [one, other] = [pair.0, pair.1].map(|at| sets.members(sets.root(at)));
        let all: Vec<&Joint> = one.iter().chain(other).map(|at| &joints[*at]).collect();
        if sets.root(pair.0) != sets.root(pair.1) && off_one_line(&all, tolerance).is_some() {
            sets.join(pair);
        }
    }
    for together in sets.shared() {
        let fit = together.iter().map(|at| joints[*at].fit).reduce(|a, b| a.with(&b));
        if let Some(line) = fit.and_then(|fit| fit.line()) {
            together.iter().for_each(|at| joints[*at].line = line.towards(joints[*at].line.normal));
        }
    }
}

/// The line of a joint as one of its stones sees it, which lies on its near side.
pub fn outward(joint: &Joint, stone: usize) -> Line {
    if joint.stones.0 == stone { joint.line } else { joint.line.flipped() }
}

/// How far (m) the ends of joints are off the one line of all at most; `None` above the tolerance.
fn off_one_line(joints: &[&Joint], tolerance: f64) -> Option<f64> {
    let line = joints.iter().map(|own| own.fit).reduce(|a, b| a.with(&b))?.line()?;
    let ends = joints.iter().flat_map(|own| own.ends);
    let off = ends.map(|end| line.beyond(end).abs()).fold(0.0, f64::max);
    (off <= tolerance).then_some(off)
}
