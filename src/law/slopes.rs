//! Derivatives of Coulomb's law at a point of a sub-contact, for solvers that need a tangent.

use crate::law::coulomb::{Coulomb, Motion, Pressed, SubContact};
use crate::law::weakening::Slipping;

/// Number of quantities that a joint's forces depend on: the gap `g0, gs, gt` and the [`Motion`]'s
/// `base, by_s, by_t`, two components each.
pub const INPUTS: usize = 9;

/// Derivatives of a [`Pressed`] with respect to the gap `g0, gs, gt`.
#[derive(Clone, Copy, Debug, Default)]
pub struct PressedSlopes {
    /// Of the place, by its two coordinates.
    pub at: [[f64; 3]; 2],
    /// Of the area in contact.
    pub area: [f64; 3],
    /// Of the normal force.
    pub force: [f64; 3],
}

/// Derivatives of a [`crate::law::ShearSum`]: rows are its force, by_s and by_t, two components each.
pub type ShearSlopes = [[f64; INPUTS]; 6];

/// The strength that a traction goes back onto, and how it changes with the stress and with the traction's size.
struct Limit {
    value: f64,
    by_stress: f64,
    by_size: f64,
}

impl Coulomb {
    /// Adds the derivatives of one point's share of [`Coulomb::shear`] to `sum`, at the same arguments:
    /// `state` is what it remembered before. Says whether it slips.
    ///
    /// Where nothing presses yet the strength is zero and the law has a corner; what is `unloaded` counts as sticking, so
    /// that an assembly without load has a stiffness to start from.
    pub fn add_shear_slopes(
        &self,
        state: &SubContact,
        pressed: &Pressed,
        slopes: &PressedSlopes,
        motion: &Motion,
        unloaded: bool,
        sum: &mut ShearSlopes,
    ) -> bool {
        let Pressed { at, area, force } = *pressed;
        if area <= 0.0 {
            return false;
        }
        let grows = area > state.area;
        let mut tau = self.elastic(state, pressed, motion);
        // By the gap, which moves the point and changes the area; by the motion, the traction of a point changes by -ks (1, s, t)
        // times `by_motion`.
        let mut by_gap = [0, 1].map(|k| {
            std::array::from_fn::<f64, 3, _>(|g| {
                let lost = if grows { -(state.area / area) / area * slopes.area[g] } else { 0.0 };
                let moved = slopes.at[0][g] * motion.by_s[k] + slopes.at[1][g] * motion.by_t[k];
                state.tau[k] * lost - self.ks * moved
            })
        });
        let mut by_motion = [[1.0, 0.0], [0.0, 1.0]];
        let size = (tau[0] * tau[0] + tau[1] * tau[1]).sqrt();
        let stress = force / area;
        let slips = !self.bonded && !unloaded && {
            let limit = self.limit(state, stress, size);
            let slips = size > self.strength(state, pressed);
            if slips {
                let (n, back) = (tau.map(|x| x / size), limit.value / size);
                by_motion = [0, 1].map(|a| {
                    [0, 1].map(|b| {
                        let across = if a == b { 1.0 } else { 0.0 } - n[a] * n[b];
                        back * across + limit.by_size * n[a] * n[b]
                    })
                });
                by_gap = [0, 1].map(|a| {
                    std::array::from_fn(|g| {
                        let d_stress = (slopes.force[g] - stress * slopes.area[g]) / area;
                        by_motion[a][0] * by_gap[0][g]
                            + by_motion[a][1] * by_gap[1][g]
                            + n[a] * limit.by_stress * d_stress
                    })
                });
                tau = tau.map(|x| x * back);
            }
            slips
        };
        let of = [1.0, at[0], at[1]];
        let d_of = [[0.0; 3], slopes.at[0], slopes.at[1]];
        for k in 0..2 {
            for (moment, (arm, d_arm)) in of.iter().zip(d_of).enumerate() {
                let row = &mut sum[2 * moment + k];
                for g in 0..3 {
                    let d_force = by_gap[k][g] * area + tau[k] * slopes.area[g];
                    row[g] += arm * d_force + d_arm[g] * tau[k] * area;
                }
                for (j, by) in by_motion[k].iter().enumerate() {
                    for (m, x) in of.iter().enumerate() {
                        row[3 + 2 * m + j] -= self.ks * area * by * arm * x;
                    }
                }
            }
        }
        slips
    }

    /// The strength at a point whose elastic traction has this size; see [`Coulomb::weakened`].
    fn limit(&self, state: &SubContact, stress: f64, size: f64) -> Limit {
        let cohesion = self.cohesion_of(state);
        let tan_phi = self.tan_phi_after(state.slip);
        let peak = cohesion + stress * tan_phi;
        let Some(weakening) = &self.weakening else {
            let carries = peak > 0.0;
            return Limit {
                value: peak.max(0.0),
                by_stress: if carries { tan_phi } else { 0.0 },
                by_size: 0.0,
            };
        };
        let at = Slipping { cohesion, stress, slip: state.slip };
        let [value, slip] = self.weakened(weakening, &at, size);
        if value == 0.0 {
            return Limit { value, by_stress: 0.0, by_size: 0.0 };
        }
        match self.softening(weakening, &at, size) {
            // peak - h slip with slip = (size - peak) / (ks - h), where h grows with the stress at a rate.
            Some(h) => {
                let rate = self.tan_phi * (1.0 - weakening.residual) / weakening.distance;
                let unloads = self.ks - h;
                let by_stress = tan_phi - rate * slip - h * (slip * rate - tan_phi) / unloads;
                Limit { value, by_stress, by_size: -h / unloads }
            }
            None => Limit { value, by_stress: self.tan_phi * weakening.residual, by_size: 0.0 },
        }
    }
}
