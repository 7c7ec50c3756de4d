//! What is done to the walls of a bank, and with it which numbers tell their way.

use std::ops::Range;

use crate::critic::simulate::bank::path::{HALF_WAY, KINDS, NUMBERS, NUMBERS_UP, PLACES, Path, TILTED};
use crate::critic::simulate::bank::pushes::{PUSHED, SHARES};
use crate::ensemble::Row;
use crate::protocol::Protocol;
use crate::study::{Arm, Earthquakes, Study};

/// Numbers that have a shape in common. On the tilting table: when a wall falls and how far it moves; in which form; what is left on
/// the way back. Stones decide of one and joints of another, and creep acts on the last alone.
static OF_TILTED: [Range<usize>; 3] = [0..1 + PLACES.len(), 1 + PLACES.len()..NUMBERS_UP, NUMBERS_UP..TILTED];
/// In shear: the push, and how far it goes.
static OF_SHEARED: [Range<usize>; 2] = [1..PUSHED, 0..1];
/// Under motions of the base: what stones are made of decides alike of all that they do.
static OF_SHAKEN: [Range<usize>; 2] = [1..NUMBERS, 0..1];

/// What is done to the walls of a bank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Test {
    /// They are tilted until they fall.
    Tilting,
    /// They are pushed along themselves.
    Shear {
        /// The widest drift.
        widest: f64,
    },
    /// Their base moves.
    Shaking,
}

impl Test {
    /// Of a study of either kind.
    pub fn of(study: &Study) -> Test {
        match study.protocol {
            Protocol::Shear(shear) => Test::Shear { widest: shear.history.widest() },
            Protocol::BaseMotion(_) => Test::Shaking,
            Protocol::Tilting(_) | Protocol::Lateral(_) | Protocol::Retaining(_) => Test::Tilting,
        }
    }

    /// The path of a wall of a bank's study; `None` for one that has none.
    pub fn path(self, study: &Study, row: &Row) -> Option<Path> {
        match self {
            Test::Shaking => Path::shaken(row, study.earthquakes.as_ref()?),
            Test::Tilting => Path::of(row),
            Test::Shear { widest } => Path::pushed(row, widest),
        }
    }

    /// Names of the numbers of a path of a bank's study; those that follow are 0.
    pub fn names(self, study: &Study) -> Vec<String> {
        match self {
            Test::Shaking => {
                let of = |shaken: &Earthquakes| -> Vec<String> {
                    shaken.sought.iter().map(|own| own.name(&shaken.records)).collect()
                };
                let sought = study.earthquakes.as_ref().map_or_else(Vec::new, of);
                std::iter::once("nothing".to_string()).chain(sought).collect()
            }
            Test::Tilting => (0..TILTED)
                .map(|number| match number.checked_sub(1) {
                    None => "ln_collapse_rad".to_string(),
                    Some(k) => format!("{}_{}", KINDS[k / PLACES.len()], k % PLACES.len()),
                })
                .collect(),
            Test::Shear { .. } => {
                let pushes = (0..SHARES.len()).map(|place| format!("ln_push_n_{place}"));
                std::iter::once("ln_reach_over_widest".to_string()).chain(pushes).collect()
            }
        }
    }

    /// Two numbers that tell how much is known of walls beforehand, in words.
    pub fn telling(self) -> [(usize, &'static str); 2] {
        match self {
            Test::Shaking => [(1, "first record"), (2, "second record")],
            Test::Tilting => [(0, "collapse angle"), (HALF_WAY, "displacement half way up")],
            Test::Shear { .. } => {
                [(3, "push at a twentieth of the widest drift"), (PUSHED - 1, "push at the widest drift")]
            }
        }
    }

    /// Numbers that are emulated together; walls are near each other as the first of these see them.
    pub(super) fn groups(self) -> &'static [Range<usize>] {
        match self {
            Test::Tilting => &OF_TILTED,
            Test::Shaking => &OF_SHAKEN,
            Test::Shear { .. } => &OF_SHEARED,
        }
    }

    /// An emulator takes twice as many walls as a polynomial of this degree has terms. Stones of walls on a tilting table make a
    /// scatter that a quadratic must not follow; the curve of a sheared wall hangs on its joints alone for the most part, and what a wall
    /// does under a motion on the width that it stands on.
    pub(super) fn least_degree(self) -> usize {
        match self {
            Test::Tilting => 2,
            Test::Shear { .. } | Test::Shaking => 1,
        }
    }
}

/// The family whose walls stand for those of another (indices of arms). Walls on a tilting table are their family's own; to push one
/// takes a hundred times as long, to shake one a thousand times, and families that differ in their names alone, as walls pushed once and
/// walls pushed to and fro, share the walls of the first of them.
pub fn stand_in(study: &Study, family: usize) -> usize {
    let alike = |arm: &Arm| {
        let own = &study.arms[family];
        *arm == Arm { name: arm.name.clone(), members: arm.members, curve: arm.curve.clone(), ..own.clone() }
    };
    match study.protocol {
        Protocol::Shear(_) | Protocol::BaseMotion(_) => study.arms.iter().position(alike).unwrap_or(family),
        Protocol::Tilting(_) | Protocol::Lateral(_) | Protocol::Retaining(_) => family,
    }
}
