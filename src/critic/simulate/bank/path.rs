//! The way of a wall up to its collapse, in numbers that hang smoothly on what it is made of.
//!
//! A wall that nears its collapse angle `a_c` moves faster and faster: displacement over tilt has a parabola's corner there, whatever
//! the wall. Over `q = sqrt(1 - a/a_c)` it has none: the path is a smooth function from `q = 1` (upright) to 0 (falling), and the
//! same few places tell it for all walls.

use crate::critic::compare::at_rest;
use crate::ensemble::Row;
use crate::math::{Monotone, Share, exp, exp_all, ln, radians};
use crate::model::Outcome;

/// Places `q` at which a path is given: at tilts of 98, 91, 75, 51, 28 and 0 % of the collapse angle.
pub const PLACES: [f64; 6] = [0.15, 0.3, 0.5, 0.7, 0.85, 1.0];
/// What is given at every place: three of the displacement, three of what is left of it at the level.
pub const KINDS: [&str; 6] =
    ["ln_mean_m_per_rad", "bow", "twist", "mean_remainder", "bow_remainder", "twist_remainder"];
/// Numbers of the path of a wall that is tilted: the collapse angle, and one of every kind at every place.
pub const TILTED: usize = 1 + KINDS.len() * PLACES.len();
/// Most numbers of a path: a wall that is shaken has one for each motion that specimens met.
pub const NUMBERS: usize = 144;
/// The one that tells how far it has moved when half of the collapse angle is reached (51 %).
pub const HALF_WAY: usize = 1 + 3;
/// Those of the way up come first.
pub const NUMBERS_UP: usize = 1 + 3 * PLACES.len();

/// Displacements are computed at so many tilts at once.
const AT_ONCE: usize = 32;

/// No wall that stands falls before this tilt (rad): the least that a bank's collapses are told apart by, some 0.06 deg.
const LEAST: f64 = 1e-3;

/// The path of a wall. What follows is said of one on the tilting table; for one that is sheared see
/// `Pushes`.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Logarithm of the collapse angle (rad); at each place, the logarithm of the mean of the three points' displacements over
    /// the tilt (m/rad); at each place the centre less the mean of the ends, over that mean; at each place the left end less the
    /// right one, over that mean; then, of what is left when the platform goes back to the level from the place, the mean, the
    /// centre less the ends and the left end less the right one, all over the mean at the place.
    pub numbers: [f64; NUMBERS],
}

impl Path {
    /// The path of a wall that fell; `None` where it did not, or leans uphill, or fell before it could be read twice.
    pub fn of(row: &Row) -> Option<Path> {
        let Outcome::Collapsed { .. } = row.outcome else { return None };
        let collapse = row.collapse_angle_deg().filter(|angle| *angle > 0.0)?;
        let (mut read, mut back) = (Vec::new(), Vec::new());
        for (tilt, step) in at_rest(row).into_iter().filter(|(tilt, _)| *tilt > 0.0) {
            let [left, centre, right] = step.top.points();
            let points = [left?, centre?, right?];
            let mean = (points[0] + points[1] + points[2]) / 3.0;
            if mean <= 0.0 {
                return None;
            }
            let q = (1.0 - tilt / collapse).max(0.0).sqrt();
            let shape = |points: [f64; 3]| {
                let [left, centre, right] = points.map(|x| x / mean);
                [(left + centre + right) / 3.0, centre - 0.5 * (left + right), left - right]
            };
            let [_, bow, twist] = shape(points);
            read.push((q, [ln(mean / radians(tilt)), bow, twist]));
            if let [Some(left), Some(centre), Some(right)] = step.top.remainders() {
                back.push((q, shape([left, centre, right])));
            }
        }
        // Ascending in q; the last tilt comes first.
        for read in [&mut read, &mut back] {
            read.reverse();
            read.dedup_by(|later, earlier| later.0 <= earlier.0);
        }
        if read.len() < 2 {
            return None;
        }
        if back.is_empty() {
            // It fell before the first tilt from which the platform goes back.
            back.push((1.0, [0.0; 3]));
        }
        // Upright, where the wall answers in proportion to the tilt: on from the two lowest tilts.
        let [next, first] = [read[read.len() - 2], read[read.len() - 1]];
        let further = (1.0 - first.0) / (first.0 - next.0);
        read.push((1.0, [0, 1, 2].map(|kind| first.1[kind] + further * (first.1[kind] - next.1[kind]))));
        let mut numbers = [0.0; NUMBERS];
        numbers[0] = ln(radians(collapse));
        for kind in 0..KINDS.len() {
            // Beyond the tilts from which it was taken back, as from the nearest.
            let read = if kind < 3 { &read } else { &back };
            let q: Vec<f64> = read.iter().map(|(q, _)| *q).collect();
            let values: Vec<f64> = read.iter().map(|(_, values)| values[kind % 3]).collect();
            let curve = Monotone::through(q, values);
            for (place, &q) in PLACES.iter().enumerate() {
                numbers[1 + kind * PLACES.len() + place] = curve.at(q);
            }
        }
        Some(Path { numbers })
    }

    /// What of it adds up when several things act: the collapse angle itself (rad), as lost width and lean subtract from it, and a
    /// wall that barely stands has no logarithm of it worth the name; all other numbers as they are.
    pub fn adding(&self) -> [f64; NUMBERS] {
        let mut adding = self.numbers;
        adding[0] = exp(adding[0]);
        adding
    }
}

/// A path between its places.
#[derive(Clone, Debug)]
pub struct Curves {
    /// The collapse angle (rad).
    collapse: f64,
    /// Over `q`, in the order of [`Path::numbers`].
    kinds: [Monotone<[f64; PLACES.len()]>; 3],
    /// The rest of the numbers: few ask for what is left at the level.
    back: [f64; TILTED - NUMBERS_UP],
}

impl Curves {
    /// The way of the wall that has these [adding](Path::adding) numbers; one that should not stand at all falls right after its
    /// zero reading.
    pub fn of(adding: &[f64; NUMBERS]) -> Curves {
        let own = |kind: usize| std::array::from_fn(|place| adding[1 + kind * PLACES.len() + place]);
        let curve = |kind: usize| Monotone::through(PLACES, own(kind));
        let back = std::array::from_fn(|number| adding[NUMBERS_UP + number]);
        Curves { collapse: adding[0].max(LEAST), kinds: [curve(0), curve(1), curve(2)], back }
    }

    /// The collapse angle (rad).
    pub fn collapse(&self) -> f64 {
        self.collapse
    }

    /// Displacements (m) of the left end, the centre and the right end at a tilt (rad); `None` where the wall has fallen.
    pub fn displacements(&self, tilt: f64) -> Option<[f64; 3]> {
        if tilt > self.collapse {
            return None;
        }
        let mut displacements = [[0.0; 3]];
        self.write_displacements(&[tilt], &mut displacements);
        Some(displacements[0])
    }

    /// Displacements (m) of the left end, the centre and the right end at tilts (rad); where the wall has fallen, those at the fall.
    pub fn last_displacements(&self, tilts: &[f64]) -> Vec<[f64; 3]> {
        let mut displacements = vec![[0.0; 3]; tilts.len()];
        let chunks = tilts.chunks(AT_ONCE).zip(displacements.chunks_mut(AT_ONCE));
        chunks.for_each(|(tilts, displacements)| self.write_displacements(tilts, displacements));
        displacements
    }

    /// No more than [`AT_ONCE`].
    fn write_displacements(&self, tilts: &[f64], displacements: &mut [[f64; 3]]) {
        let mut over_tilt = [0.0; AT_ONCE];
        let over_tilt = &mut over_tilt[..tilts.len()];
        for ((tilt, over_tilt), displacements) in tilts.iter().zip(&mut *over_tilt).zip(&mut *displacements) {
            let share = Share::of(&PLACES, self.place(*tilt));
            let [ln_mean, bow, twist] = [0, 1, 2].map(|kind| self.kinds[kind].by(&share));
            (*over_tilt, *displacements) = (ln_mean, points(1.0, bow, twist));
        }
        exp_all(over_tilt);
        for ((tilt, over_tilt), displacements) in tilts.iter().zip(over_tilt).zip(displacements) {
            let mean = *over_tilt * tilt.min(self.collapse);
            *displacements = displacements.map(|x| x * mean);
        }
    }

    /// What is left of the displacements (m) of the left end, the centre and the right end when the platform goes back to the level
    /// from a tilt (rad); `None` where the wall has fallen.
    pub fn remainders(&self, tilt: f64) -> Option<[f64; 3]> {
        if tilt > self.collapse {
            return None;
        }
        let q = self.place(tilt);
        let of = |kind: usize| {
            let own: [f64; PLACES.len()] =
                std::array::from_fn(|place| self.back[kind * PLACES.len() + place]);
            Monotone::through(PLACES, own).at(q)
        };
        let mean = exp(self.kinds[0].at(q)) * tilt;
        Some(points(of(0), of(1), of(2)).map(|x| x * mean))
    }

    fn place(&self, tilt: f64) -> f64 {
        (1.0 - tilt / self.collapse).max(0.0).sqrt()
    }
}

/// Left end, centre and right end by their mean, the centre less the mean of the ends, and the left end less the right one.
fn points(mean: f64, bow: f64, twist: f64) -> [f64; 3] {
    let ends = mean - bow / 3.0;
    [ends + 0.5 * twist, ends + bow, ends - 0.5 * twist]
}
