//! What changes a wall between two states at rest: creep of its joints, wedges that are lost.

use crate::math::exp;
use crate::protocol::Settlement;
use crate::solve::Assembly;

/// What changes a wall on its way along a load path; nothing by default. It depends on the levels of the states at rest
/// alone, never on the steps that a solver takes between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Creep of the joints.
    pub creep: Option<Creep>,
    /// Blocks that are lost.
    pub loss: Option<Loss>,
    /// Supports that go down at level 0, on load paths that go by steps; a platform that turns steadily leaves them where they are.
    pub settlements: Vec<Settlement>,
}

/// Shear tractions that relax: by `exp(-rate dalpha)` on the way from rest to rest, and by a share of themselves at every
/// hold. What a sub-contact loses the wall takes up by moving on: on a block that sticks, `ks du = d tau + rate tau dalpha`.
/// Attachments by springs do not creep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Creep {
    /// Rate (1/rad of tilt, at least 0).
    pub rate: f64,
    /// Share of the shear traction that is lost at a hold, in [0, 1).
    pub hold_share: f64,
    /// The platform is held at every multiple of this tilt (rad, above 0), but not at 0.
    pub hold_every: f64,
}

/// Blocks that are crushed or fall out beyond a tilt: they and their joints are gone.
#[derive(Clone, Debug, PartialEq)]
pub struct Loss {
    /// Their ids.
    pub blocks: Vec<usize>,
    /// The last tilt (rad) at which they are there.
    pub beyond: f64,
}

impl Changes {
    /// Whether blocks are lost between two tilts (rad).
    pub(super) fn loses(&self, from: f64, to: f64) -> bool {
        self.loss.as_ref().is_some_and(|loss| from <= loss.beyond && to > loss.beyond)
    }

    /// Changes a wall that leaves a state at rest at one tilt (rad) for another one.
    pub(super) fn apply(&self, assembly: &mut Assembly<'_>, from: f64, to: f64) {
        if let Some(creep) = &self.creep
            && to > from
        {
            assembly.joints.relax(creep.kept(from, to));
        }
        if let Some(loss) = self.loss.as_ref().filter(|_| self.loses(from, to)) {
            loss.blocks.iter().for_each(|block| assembly.remove(*block));
        }
    }
}

impl Creep {
    /// The share of the shear traction that is kept on the way; a hold at the tilt it starts from is on it.
    fn kept(&self, from: f64, to: f64) -> f64 {
        // Multiples of the hold below a tilt; a part in 10^9 for the rounding of tilts that are one.
        let below = |tilt: f64| (tilt / self.hold_every - 1e-9).ceil().max(1.0);
        let mut kept = exp(-self.rate * (to - from));
        let mut holds = below(to) - below(from);
        while holds > 0.0 {
            kept *= 1.0 - self.hold_share;
            holds -= 1.0;
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn creep_from_rest_to_rest_does_not_depend_on_the_steps() {
        let creep = Creep { rate: 0.3, hold_share: 0.1, hold_every: 0.5 };
        let by_steps = |n: u32| {
            let at = |k: u32| 2.0 * f64::from(k) / f64::from(n);
            (0..n).map(|k| creep.kept(at(k), at(k + 1))).product::<f64>()
        };
        // Held at 0.5, 1 and 1.5, and not yet at 2.
        let exact = exp(-0.6) * 0.9 * 0.9 * 0.9;
        for n in [1, 3, 4, 7, 10, 1000] {
            assert_relative_eq!(by_steps(n), exact, max_relative = 1e-12);
        }
        assert_relative_eq!(creep.kept(2.0, 2.1), exp(-0.03) * 0.9, max_relative = 1e-12);
        assert_relative_eq!(creep.kept(0.0, 0.5), exp(-0.15), max_relative = 1e-12);
    }
}
