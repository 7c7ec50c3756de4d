//! What is done to a wall that holds back fill or water.

use crate::protocol::retaining::retained::Retained;

/// The back of a wall (-y) is filled up, and the fill pushes towards +y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Retaining {
    /// What is behind the wall.
    pub retained: Retained,
    /// How it rises.
    pub lifts: Lifts,
    /// A wall of elastic joints falls when the centroid of any block moves by this share of the wall's base thickness from one rest to the next;
    /// default 0.1.
    pub collapse_share: f64,
}

/// How the height behind a wall is searched for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lifts {
    /// Equal lifts from the foot of the back to its top, at least 1. Every one is tried, as a wall may bear more than a lift that it does not bear.
    pub count: u32,
    /// The height of the fall is bracketed to this share of the height of the back.
    pub bracket: f64,
}

impl Default for Lifts {
    /// Ten lifts. For rigid blocks a ten thousandth of the height costs a few programs more; see [`Lifts::COARSE`].
    fn default() -> Self {
        Lifts { count: 10, bracket: 1e-4 }
    }
}

impl Lifts {
    /// For solvers that go by steps, where each height takes a run of its own. A fifth of the hundredth within which answers of several solvers are one.
    pub const COARSE: Lifts = Lifts { count: 10, bracket: 0.002 };

    /// The heights (m) of the lifts on a back of this height.
    pub(super) fn heights(self, back: f64) -> impl Iterator<Item = f64> {
        (1..=self.count).map(move |lift| back * f64::from(lift) / f64::from(self.count))
    }
}
