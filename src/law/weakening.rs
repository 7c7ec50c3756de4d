//! Friction that weakens with slip (Ida 1972), on the way back of a traction onto Coulomb's envelope.

use crate::law::Coulomb;

/// Friction that weakens with slip: tan(phi) falls in a straight line to a residual value over a slip distance.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Weakening {
    /// Residual share of tan(phi), in [0, 1].
    pub residual: f64,
    /// Slip (m) over which it falls, above 0.
    pub distance: f64,
}

/// What presses on a sub-contact that is about to slip, and what it has slipped before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slipping {
    /// Cohesion (Pa).
    pub cohesion: f64,
    /// Normal stress (Pa), compression positive.
    pub stress: f64,
    /// Slip so far (m).
    pub slip: f64,
}

impl Coulomb {
    /// tan(phi) after so much slip (m).
    pub(super) fn tan_phi_after(&self, slip: f64) -> f64 {
        match &self.weakening {
            Some(Weakening { residual, distance }) => {
                self.tan_phi * (residual + (1.0 - residual) * (1.0 - slip / distance).max(0.0))
            }
            None => self.tan_phi,
        }
    }

    /// How fast the strength falls with slip (Pa/m) while an elastic traction of this size (Pa) goes back onto the
    /// envelope; `None` where it falls to the residual strength at once: at the end of the slip distance, or where it falls
    /// faster than the joint's own stiffness unloads.
    pub(super) fn softening(&self, weakening: &Weakening, at: &Slipping, size: f64) -> Option<f64> {
        let h = at.stress * self.tan_phi * (1.0 - weakening.residual) / weakening.distance;
        let peak = at.cohesion + at.stress * self.tan_phi_after(at.slip);
        let falls = at.slip < weakening.distance && h < self.ks;
        (falls && at.slip + (size - peak) / (self.ks - h) <= weakening.distance).then_some(h)
    }

    /// The strength (Pa) onto which an elastic traction of this size (Pa) goes back, and the slip (m) that it takes: what the
    /// traction loses over `ks` is slip, and the strength falls with it.
    pub(super) fn weakened(&self, weakening: &Weakening, at: &Slipping, size: f64) -> [f64; 2] {
        match self.softening(weakening, at, size) {
            Some(h) => {
                let peak = at.cohesion + at.stress * self.tan_phi_after(at.slip);
                let slip = (size - peak) / (self.ks - h);
                [(peak - h * slip).max(0.0), slip]
            }
            None => {
                let rest = (at.cohesion + at.stress * self.tan_phi * weakening.residual).max(0.0);
                [rest, (size - rest) / self.ks]
            }
        }
    }
}
