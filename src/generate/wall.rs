//! A member's wall from its layout and its streams (skeleton).

use crate::generate::Layout;
use crate::model::Wall;
use crate::random::Streams;

/// A wall and what it took to make it.
#[derive(Clone, Debug, PartialEq)]
pub struct Generated {
    /// Stones only, ids from the base up; the base is the plane z = 0 and is added by the protocol, as are the ends.
    pub wall: Wall,
    /// Fresh starts needed, 1 when the first one was valid.
    pub attempts: u32,
    /// Slivers merged into a neighbour.
    pub merges: u32,
    /// Single redraws (bed, length, cut, wedge) over all attempts.
    pub redraws: u32,
    /// What was realised, beside what was asked for.
    pub realised: Realised,
}

/// Realised values, in the order of drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Realised {
    /// Dips of beds or cuts (rad).
    pub dips: Vec<f64>,
    /// Dips as first drawn, before any rejection (rad).
    pub first_dips: Vec<f64>,
    /// Stone lengths along x (m).
    pub lengths: Vec<f64>,
    /// Stone (course) heights (m).
    pub heights: Vec<f64>,
    /// Number of wedge stones.
    pub wedges: u32,
    /// Number of header stones.
    pub headers: u32,
    /// Volume of the outline less the stated gaps (m^3).
    pub volume: f64,
}

/// Why no valid wall came out within the attempts.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason} (in each of {attempts} attempts)")]
pub struct InvalidGeometry {
    /// The fault of the last attempt, in words.
    pub reason: String,
    /// Attempts made.
    pub attempts: u32,
    /// Single redraws made over all attempts.
    pub redraws: u32,
}

/// Builds the wall of one member.
///
/// # Errors
/// [`InvalidGeometry`] when the attempts ran out; never a substitute.
pub fn generate(_layout: &Layout, _streams: &Streams) -> Result<Generated, InvalidGeometry> {
    unimplemented!()
}
