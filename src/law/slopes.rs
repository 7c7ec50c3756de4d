//! Derivatives of Coulomb's law at a sub-contact, for solvers that need a tangent.

use crate::law::coulomb::{Coulomb, Motion, Pressed, SubContact};
use crate::law::weakening::Slipping;

/// Number of quantities that a joint's forces depend on: the gap `g0, gs, gt` and the [`Motion`]'s
/// `base, by_s, by_t`, two components each.
pub const INPUTS: usize = 9;

/// Derivatives of what presses on a sub-contact with respect to the gap `g0, gs, gt`.
#[derive(Clone, Copy, Debug, Default)]
pub struct PressedSlopes {
    /// Of the area in contact and of its first moments in s and t.
    pub area: [[f64; 3]; 3],
    /// Of the normal force.
    pub force: [f64; 3],
}

/// Derivatives of a [`crate::law::ShearSum`]: rows are its force, by_s and by_t, two components each.
pub type ShearSlopes = [[f64; INPUTS]; 6];

/// One quantity with its derivatives.
#[derive(Clone, Copy)]
struct Dual {
    value: f64,
    slope: [f64; INPUTS],
}

impl Dual {
    fn constant(value: f64) -> Dual {
        Dual { value, slope: [0.0; INPUTS] }
    }

    fn input(value: f64, index: usize) -> Dual {
        let mut slope = [0.0; INPUTS];
        slope[index] = 1.0;
        Dual { value, slope }
    }

    fn of_gap(value: f64, by_gap: [f64; 3]) -> Dual {
        let mut slope = [0.0; INPUTS];
        slope[..3].copy_from_slice(&by_gap);
        Dual { value, slope }
    }

    /// `value` with `a` times the slopes of `self` plus `b` times those of `other`.
    fn combined(&self, a: f64, other: &Dual, b: f64, value: f64) -> Dual {
        let mut slope = [0.0; INPUTS];
        for (k, s) in slope.iter_mut().enumerate() {
            *s = a * self.slope[k] + b * other.slope[k];
        }
        Dual { value, slope }
    }

    fn plus(&self, other: &Dual) -> Dual {
        self.combined(1.0, other, 1.0, self.value + other.value)
    }

    fn times(&self, other: &Dual) -> Dual {
        self.combined(other.value, other, self.value, self.value * other.value)
    }

    fn over(&self, other: &Dual) -> Dual {
        let quotient = self.value / other.value;
        self.combined(1.0 / other.value, other, -quotient / other.value, quotient)
    }

    fn scaled(&self, factor: f64) -> Dual {
        self.combined(factor, self, 0.0, factor * self.value)
    }
}

impl Coulomb {
    /// Adds the derivatives of one sub-contact's share of [`Coulomb::shear`] to `sum`, at the same arguments:
    /// `state` is what it remembered before. Says whether it slips.
    ///
    /// Where nothing presses yet the strength is zero and the law has a corner; a pressure up to `least` (Pa) counts as
    /// sticking, so that an assembly without load has a stiffness to start from.
    pub fn add_shear_slopes(
        &self,
        state: &SubContact,
        pressed: &Pressed,
        slopes: &PressedSlopes,
        motion: &Motion,
        least: f64,
        sum: &mut ShearSlopes,
    ) -> bool {
        if pressed.area <= 0.0 {
            return false;
        }
        let area = Dual::of_gap(pressed.area, slopes.area[0]);
        let first = |k: usize| Dual::of_gap(pressed.at[k] * pressed.area, slopes.area[k + 1]);
        let at = [first(0).over(&area), first(1).over(&area)];
        let kept = match pressed.area > state.area {
            true => Dual::constant(state.area).over(&area),
            false => Dual::constant(1.0),
        };
        let elastic = |k: usize| {
            let [base, by_s, by_t] = [
                Dual::input(motion.base[k], 3 + k),
                Dual::input(motion.by_s[k], 5 + k),
                Dual::input(motion.by_t[k], 7 + k),
            ];
            let increment = base.plus(&at[0].times(&by_s)).plus(&at[1].times(&by_t));
            kept.scaled(state.tau[k]).plus(&increment.scaled(-self.ks))
        };
        let mut tau = [elastic(0), elastic(1)];
        let slips = !self.bonded && pressed.force > least * pressed.area && {
            let stress = Dual::of_gap(pressed.force, slopes.force).over(&area);
            let tan_phi = self.tan_phi_after(state.slip);
            let strength = self.cohesion_of(state) + stress.value * tan_phi;
            let limit = if strength > 0.0 {
                stress.combined(tan_phi, &stress, 0.0, strength)
            } else {
                Dual::constant(0.0)
            };
            let size2 = tau[0].value * tau[0].value + tau[1].value * tau[1].value;
            let slips = size2 > limit.value * limit.value;
            if slips {
                let size = size2.sqrt();
                let size = tau[0].combined(tau[0].value / size, &tau[1], tau[1].value / size, size);
                let limit = self.limit_after_slip(state, &stress, &limit, &size);
                let back = limit.over(&size);
                tau = [tau[0].times(&back), tau[1].times(&back)];
            }
            slips
        };
        for (k, tau) in tau.iter().enumerate() {
            let force = tau.times(&area);
            for (row, moment) in [(k, force), (2 + k, force.times(&at[0])), (4 + k, force.times(&at[1]))] {
                for (total, slope) in sum[row].iter_mut().zip(moment.slope) {
                    *total += slope;
                }
            }
        }
        slips
    }

    /// The strength onto which an elastic traction goes back, from that before: see [`Coulomb::weakened`].
    fn limit_after_slip(&self, state: &SubContact, stress: &Dual, before: &Dual, size: &Dual) -> Dual {
        let Some(weakening) = &self.weakening else { return *before };
        let at = Slipping { cohesion: self.cohesion_of(state), stress: stress.value, slip: state.slip };
        let [limit, _] = self.weakened(weakening, &at, size.value);
        if limit == 0.0 {
            return Dual::constant(0.0);
        }
        match self.softening(weakening, &at, size.value) {
            Some(h) => {
                let rate = self.tan_phi * (1.0 - weakening.residual) / weakening.distance;
                let h = stress.combined(rate, stress, 0.0, h);
                let unloads = h.combined(-1.0, &h, 0.0, self.ks - h.value);
                let slip = size.plus(&before.scaled(-1.0)).over(&unloads);
                before.plus(&h.times(&slip).scaled(-1.0))
            }
            None => {
                let residual = self.tan_phi * weakening.residual;
                stress.combined(residual, stress, 0.0, limit)
            }
        }
    }
}
