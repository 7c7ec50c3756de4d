//! Rayleigh damping `C = alpha M + beta K`.

use crate::math::radians;
use crate::solve::Assembly;

/// Damping ratio of a stone that swings in the shear of its joints.
const OF_JOINTS: f64 = 0.5;

/// Rayleigh damping. The part in proportion to mass acts on velocities against the base, and slows toppling as well; that in proportion to stiffness
/// acts in the joints where they touch and do not slide.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Rayleigh {
    /// `alpha` (1/s); default 0, right for what rocks.
    pub mass: f64,
    /// `beta` (s); default 0.
    pub stiffness: f64,
}

impl Rayleigh {
    /// With a damping ratio (share of critical, in [0, 1)) at two frequencies (Hz), the lower first: `xi(w) = alpha / (2 w) + beta w / 2` is less in between,
    /// least at the root of their product, and more outside.
    pub fn of(ratio: f64, [low, high]: [f64; 2]) -> Rayleigh {
        let (low, high) = (radians(360.0) * low, radians(360.0) * high);
        Rayleigh { mass: 2.0 * ratio * low * high / (low + high), stiffness: 2.0 * ratio / (low + high) }
    }

    /// In proportion to stiffness alone: half of critical where a stone swings in the shear of its joints while all others stay, of the stone that
    /// does so slowest. What slides is not damped, and what rocks or sways as a wall hardly is. Without damping a stone that has slid goes on
    /// ringing in its joints, and slides back too early.
    pub fn of_joints(assembly: &Assembly<'_>) -> Rayleigh {
        let mut stiffness = vec![0.0; assembly.bodies.all.len()];
        for joint in &assembly.joints.all {
            let shear = joint.law.ks * joint.area();
            stiffness[joint.incident as usize] += shear;
            stiffness[joint.reference as usize] += shear;
        }
        let bodies = assembly.bodies.all.iter().zip(&stiffness);
        let moving = bodies.filter(|(body, stiffness)| body.moves() && **stiffness > 0.0);
        let slowest = moving.map(|(body, stiffness)| stiffness / body.mass).fold(f64::INFINITY, f64::min);
        Rayleigh { mass: 0.0, stiffness: if slowest > 0.0 { 2.0 * OF_JOINTS / slowest.sqrt() } else { 0.0 } }
    }

    /// The damping ratio at a frequency (Hz).
    pub fn ratio(&self, frequency: f64) -> f64 {
        let w = radians(360.0) * frequency;
        0.5 * (self.mass / w + self.stiffness * w)
    }

    /// By what the critical step is multiplied: the Maxwell branch makes joints twice as stiff for what is fast.
    pub(super) fn step_factor(&self) -> f64 {
        if self.stiffness > 0.0 { std::f64::consts::FRAC_1_SQRT_2 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_percent_at_1_and_10_hz() {
        let rayleigh = Rayleigh::of(0.05, [1.0, 10.0]);
        // The digits of the reference numbers.
        assert!((rayleigh.mass - 0.5712).abs() < 5e-5 && (rayleigh.stiffness - 1.4469e-3).abs() < 5e-8);
        assert!((rayleigh.ratio(1.0) - 0.05).abs() < 1e-15 && (rayleigh.ratio(10.0) - 0.05).abs() < 1e-15);
        assert!((rayleigh.ratio(10f64.sqrt()) - 0.02875).abs() < 5e-6);
    }
}
