//! Peaks of the horizontal motion, and scaling to them.

use crate::math::Vec3;
use crate::motion::{Accelerogram, BadParameter, Motion};

/// Halvings that find a time inside a step to rounding.
const HALVINGS: usize = 60;
/// Pieces of a step in which a peak is looked for: the base may turn back and be faster again at its end.
const PIECES: usize = 8;

impl Motion {
    /// Peak ground acceleration (m/s^2): the largest length of the horizontal acceleration, whatever its direction in plan; of the vertical
    /// acceleration where nothing moves horizontally.
    pub fn pga(&self) -> f64 {
        peak(&self.peaking(), Accelerogram::samples, |_, _, _| 0.0)
    }

    /// Peak ground velocity (m/s), defined like [`Motion::pga`]; found inside the steps as well.
    pub fn pgv(&self) -> f64 {
        peak(&self.peaking(), Accelerogram::velocities, peak_inside)
    }

    /// The components that peaks are taken of.
    fn peaking(&self) -> Vec<Accelerogram> {
        let horizontal = self.is_horizontal();
        let axes = if horizontal { vec![Vec3::x(), Vec3::y()] } else { vec![Vec3::z()] };
        axes.iter().map(|axis| self.accelerogram(axis)).collect()
    }

    /// Scaled as a whole so that its peak ground acceleration becomes `pga` (m/s^2); see [`Motion::pga`].
    ///
    /// # Errors
    /// A target that is not above 0 and finite, or a motion without acceleration.
    pub fn scaled_to_pga(&self, pga: f64) -> Result<Motion, BadParameter> {
        self.scaled_to("pga (m/s^2)", pga, self.pga())
    }

    /// Scaled as a whole so that its peak ground velocity becomes `pgv` (m/s); see [`Motion::pgv`].
    ///
    /// # Errors
    /// A target that is not above 0 and finite, or a motion without velocity.
    pub fn scaled_to_pgv(&self, pgv: f64) -> Result<Motion, BadParameter> {
        self.scaled_to("pgv (m/s)", pgv, self.pgv())
    }

    fn scaled_to(&self, parameter: &'static str, target: f64, own: f64) -> Result<Motion, BadParameter> {
        let factor = target / own;
        if !(target > 0.0 && factor.is_finite()) {
            let allowed = "above 0 and finite, of a motion that is not 0 throughout";
            return Err(BadParameter { parameter, found: target, allowed });
        }
        Ok(self.scaled(factor))
    }
}

/// Largest length of the vector whose components are given at samples, or of what is found inside a step.
fn peak(
    parts: &[Accelerogram],
    values: impl Fn(&Accelerogram) -> &[f64],
    inside: impl Fn(&[Accelerogram], usize, f64) -> f64,
) -> f64 {
    let n = parts[0].samples().len();
    let length = |k: usize| parts.iter().map(|part| values(part)[k]).map(|v| v * v).sum::<f64>().sqrt();
    (0..n).fold(0.0, |largest: f64, k| {
        let step = if k + 1 < n { parts[0].step() } else { 0.0 };
        largest.max(length(k)).max(if step > 0.0 { inside(parts, k, step) } else { 0.0 })
    })
}

/// Largest speed inside a step: where the acceleration along the velocity goes from faster to slower. 0 where it does not.
fn peak_inside(parts: &[Accelerogram], k: usize, step: f64) -> f64 {
    let at = |s: f64| parts.iter().map(move |part| part.inside(k, s));
    let gain = |s: f64| at(s).map(|state| state.velocity * state.acceleration).sum::<f64>();
    let piece = step / PIECES as f64;
    (0..PIECES).fold(0.0, |largest: f64, which| {
        let (mut low, mut high) = (piece * which as f64, piece * (which + 1) as f64);
        if !(gain(low) > 0.0 && gain(high) <= 0.0) {
            return largest;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if gain(middle) > 0.0 { low = middle } else { high = middle }
        }
        largest.max(at(low).map(|state| state.velocity * state.velocity).sum::<f64>().sqrt())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Motion {
        Motion::of_record("three", Accelerogram::new(0.5, vec![0.0, 1.0, -2.0]).expect("good samples"))
    }

    #[test]
    fn a_peak_is_found_where_the_base_turns_back_within_a_step() {
        // From 1/4 m/s up to where the acceleration is 0 after 1/6 s; then back through rest, to -3/4 m/s at the end.
        let back = Accelerogram::new(0.5, vec![0.0, 1.0, -5.0, -5.0]).expect("good samples");
        let whole = Motion::of_record("back", back.clone());
        assert!((whole.pgv() - 3.25).abs() < 1e-15);
        // The slower peak within the second step: 1/4 + (1/2)(1/12) s.
        let found = peak_inside(&[back], 1, 0.5);
        assert!((found - (0.25 + 1.0 / 24.0)).abs() < 1e-15, "{found}");
    }

    #[test]
    fn peaks_are_those_of_the_horizontal_vector() {
        let out = record().along(&Vec3::y()).expect("a direction");
        let both = record().with(&out).expect("one step");
        assert!((both.pga() - 8.0_f64.sqrt()).abs() < 1e-15);
        assert!((both.turned(0.3).pga() - both.pga()).abs() < 1e-14);
        // The acceleration passes 0 a third of the second step after its beginning: v = 1/4 + (1/2)(1/6).
        assert!((record().pgv() - 1.0 / 3.0).abs() < 1e-15);
        assert!((both.turned(1.0).pgv() - 2.0_f64.sqrt() / 3.0).abs() < 1e-14);
        let up = record().along(&Vec3::z()).expect("a direction");
        assert_eq!((up.pga(), up.with(&record().scaled(0.5)).expect("one step").pga()), (2.0, 1.0));
    }

    #[test]
    fn targets_are_met_and_impossible_ones_refused() {
        let scaled = record().scaled_to_pga(3.0).expect("a target");
        assert!((scaled.pga() - 3.0).abs() < 1e-15);
        assert!((record().scaled_to_pgv(0.2).expect("a target").pgv() - 0.2).abs() < 1e-15);
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(record().scaled_to_pga(bad).is_err(), "{bad}");
        }
        assert!(record().scaled(0.0).scaled_to_pgv(1.0).is_err());
    }
}
