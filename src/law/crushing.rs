//! Crushing: a joint bears no more than its compressive strength.

use crate::law::Coulomb;

/// Where the stress of a joint stays as it closes on.
///
/// The stress is that of the normal law up to the strength, and the strength beyond. The joint does not remember that it was
/// crushed: as long as it closes, which is how a wall is pushed over, this is the elastic-perfectly-plastic joint; a toe that is
/// let go springs back, where a real one would stay dented. What it takes to crush it counts as stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crushing {
    /// The strength (Pa).
    pub strength: f64,
    /// The closure (m) at which it is reached.
    pub closure: f64,
}

impl Coulomb {
    /// Where it is crushed; `None` for a joint that bears any pressure, and for an attachment by springs.
    pub fn crushing(&self) -> Option<Crushing> {
        let strength = self.compressive_strength.filter(|_| !self.bonded)?;
        Some(Crushing { strength, closure: self.normal.closure(strength) })
    }
}
