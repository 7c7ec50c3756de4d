//! Where a plate stands for a wall of stones, and how far the two are apart there.
//!
//! A thin plate folds. In a wall of stones courses also slide across the thickness, and stones are not small. The plate's solution shows the
//! first: its multiplier over that at which nothing but friction holds the wall. Near 1 a course at the top, which nothing presses
//! on, slides out before the wall folds. The ratio of stones to plate was measured on walls of random shapes below that
//! (`studies/homogenisation`, "Range of plates"):
//!
//! ```text
//! stones / plate = 0.95 + 0.13 tan(phi) +- 0.15 between led ends,     0.95 +- 0.15 between ropes
//! ```

use serde::{Deserialize, Serialize};

use crate::generate::Arrangement;
use crate::homogenise::plate::{Edge, Plate};
use crate::math::{radians, tan};
use crate::study::Arm;

/// Largest shear ratio of the measured walls.
const LARGEST_SHEAR: f64 = 0.9;
/// Least stones along the measured walls, and least courses.
const LEAST_STONES: [f64; 2] = [7.0, 3.0];
/// Least shift of the head joints of neighbouring courses in the measured walls, as a share of a stone.
const LEAST_OVERLAP: f64 = 0.2;
/// Least and greatest tangent of the friction angle of the measured walls: 20 and 45 deg.
const FRICTION: [f64; 2] = [0.36, 1.0];
/// Mean ratio of stones to plate, what led ends add by the tangent of the friction angle, and half the width of the interval that holds
/// one more wall with a probability of 95 %.
const MEAN: f64 = 0.95;
const LED: f64 = 0.13;
const HALF: f64 = 0.15;
/// The same of a wall that is free at its ends: it overturns about its foot, or slides on it, as its plate does.
const FREE: f64 = 0.02;
/// What rounding adds to a ratio of stones.
const ROUNDING: f64 = 1e-6;

/// How a plate that falls stands for its stones.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Validity {
    /// The plate's multiplier over that at which friction alone holds the wall on its joints: how near to sliding across its thickness it
    /// is.
    pub shear_ratio: f64,
    /// Least and greatest ratio of what a wall of stones bears to what the plate bears, at a probability of 95 %.
    pub stones_over_plate: [f64; 2],
}

/// Why a plate does not stand for its stones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
pub enum OutOfRange {
    /// Courses slide before the plate folds.
    #[error(
        "the plate bears {multiplier:.3}, {ratio:.2} times what friction across its thickness does, and plates hold up to {most}: \
         courses slide out before the wall folds; judge such walls by their stones",
        most = LARGEST_SHEAR
    )]
    Sheared {
        /// Multiplier of the plate.
        multiplier: f64,
        /// Its shear ratio.
        ratio: f64,
    },
    /// A stone is not small beside the wall.
    #[error(
        "the wall has {along:.1} stones along it and {courses:.1} courses, and plates hold from {first} and {second} on; judge such walls by their stones",
        first = LEAST_STONES[0],
        second = LEAST_STONES[1]
    )]
    FewStones {
        /// Mean number of stones along the wall.
        along: f64,
        /// Mean number of courses.
        courses: f64,
    },
    /// No wall of such joints was measured.
    #[error(
        "the tangent of the friction angle is {tan_phi:.3}, and plates were compared with stones from {low} to {high}; judge such walls by \
         their stones",
        low = FRICTION[0],
        high = FRICTION[1]
    )]
    Friction {
        /// Tangent of the friction angle.
        tan_phi: f64,
    },
    /// Head joints run through courses.
    #[error(
        "head joints of neighbouring courses may come as near as {overlap} of a stone, and plates hold from {least} on: piles of stones slide \
         past one another; judge such walls by their stones",
        least = LEAST_OVERLAP
    )]
    ThroughJoints {
        /// Least shift as a share of a stone.
        overlap: f64,
    },
    /// The joint between leaves slides.
    #[error(
        "the wall has {0} wythes: stones slide on one another between them, across the thickness; judge such walls by their stones"
    )]
    Wythes(u32),
    /// No wall between such ends was measured.
    #[error("plates between end blocks were not compared with stones; judge such walls by their stones")]
    EndBlocks,
}

/// What a wall of stones is made of.
pub(super) struct Masonry {
    /// Tangent of the friction angle.
    tan_phi: f64,
    /// Mean number of stones along the wall, and of courses.
    stones: [f64; 2],
    /// Least shift of the head joints of neighbouring courses, as a share of a stone.
    overlap: f64,
    /// Stones through the thickness.
    wythes: u32,
}

/// What keeps a plate from overturning.
enum Held {
    Nowhere,
    ByRopes,
    ByLedEnds,
    ByEndBlocks,
}

impl Held {
    fn of(plate: &Plate) -> Held {
        match (plate.edges.left, plate.ropes.is_empty()) {
            (Edge::Held, _) => Held::ByEndBlocks,
            (Edge::Guided | Edge::Propped, _) => Held::ByLedEnds,
            (Edge::Free, false) => Held::ByRopes,
            (Edge::Free, true) => Held::Nowhere,
        }
    }
}

impl Masonry {
    /// Of an arm, with stones of this mean length and height (m).
    pub fn of(arm: &Arm, stone: [f64; 2]) -> Masonry {
        let layout = &arm.layout;
        Masonry {
            tan_phi: tan(radians(arm.joint.phi_deg.mean())),
            stones: [layout.outline.length / stone[0], layout.outline.height / stone[1]],
            overlap: match layout.arrangement {
                // Cuts run through until another one stops them; of a file nothing is known.
                Arrangement::Continuous { .. } | Arrangement::Cut { .. } | Arrangement::File { .. } => 0.0,
                Arrangement::Discontinuous { overlap, .. } => overlap.min(1.0 - overlap),
                Arrangement::Coursed { least_overlap, .. } => least_overlap,
            },
            wythes: layout.wythes.count,
        }
    }

    /// Whether walls of such stones were measured, before anything is solved.
    ///
    /// # Errors
    /// [`OutOfRange`] names what was not.
    pub fn check(&self, plate: &Plate) -> Result<(), OutOfRange> {
        let Masonry { tan_phi, stones: [along, courses], overlap, wythes } = *self;
        if wythes > 1 {
            return Err(OutOfRange::Wythes(wythes));
        }
        if matches!(Held::of(plate), Held::Nowhere | Held::ByEndBlocks) {
            return Ok(());
        }
        let below = |found: f64, least: f64| found < least * (1.0 - ROUNDING);
        if below(overlap, LEAST_OVERLAP) {
            return Err(OutOfRange::ThroughJoints { overlap });
        }
        if below(along, LEAST_STONES[0]) || below(courses, LEAST_STONES[1]) {
            return Err(OutOfRange::FewStones { along, courses });
        }
        if below(tan_phi, FRICTION[0]) || below(FRICTION[1], tan_phi) {
            return Err(OutOfRange::Friction { tan_phi });
        }
        Ok(())
    }

    /// How a plate that falls at a multiplier stands for a wall of such stones.
    ///
    /// # Errors
    /// [`OutOfRange`]: no wall was measured that falls so.
    pub fn validity(&self, plate: &Plate, multiplier: f64) -> Result<Validity, OutOfRange> {
        let ratio = multiplier * plate.live[1].abs() / (self.tan_phi * plate.weight);
        let (mean, half) = match Held::of(plate) {
            Held::Nowhere => (1.0, FREE),
            Held::ByEndBlocks => return Err(OutOfRange::EndBlocks),
            Held::ByRopes | Held::ByLedEnds if ratio > LARGEST_SHEAR => {
                return Err(OutOfRange::Sheared { multiplier, ratio });
            }
            Held::ByRopes => (MEAN, HALF),
            Held::ByLedEnds => (MEAN + LED * self.tan_phi, HALF),
        };
        Ok(Validity { shear_ratio: ratio, stones_over_plate: [mean - half, mean + half] })
    }
}
