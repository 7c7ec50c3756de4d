//! How strongly a process shakes over time, by intensity, significant duration and middle of the strong motion.

use std::f64::consts::PI;

use crate::math::{STANDARD_GRAVITY, exp, ln, ln_gamma};
use crate::motion::generate::gamma::quantile;

/// The share of the Arias intensity at which the strong motion has its middle (Rezaeian and Der Kiureghian 2010).
const MIDDLE: f64 = 0.45;
/// Shapes of the gamma density that are searched; the lower end is an exponential, which begins with its largest value.
const SHAPES: [f64; 2] = [1.0, 1e5];
/// Halvings that find the shape to rounding.
const HALVINGS: usize = 100;

/// Largest duration over middle that the modulation can have: that of the exponential, 4.925.
pub(super) const LARGEST_RATIO: f64 = 4.92;
/// Smallest one: that of the largest shape is 0.0104.
pub(super) const SMALLEST_RATIO: f64 = 0.011;

/// Gamma modulation `q(t) = alpha1 t^(alpha2 - 1) exp(-alpha3 t)` (Rezaeian and Der Kiureghian 2010, beginning at 0): the standard
/// deviation of the acceleration. Its square is a gamma density of shape `2 alpha2 - 1` and rate `2 alpha3`, times `2 g/pi` Arias
/// intensities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Modulation {
    /// Shape of the gamma density.
    shape: f64,
    /// Rate of it (1/s).
    rate: f64,
    /// Logarithm of the integral of `q^2` (m^2/s^3).
    ln_energy: f64,
}

impl Modulation {
    /// With an expected Arias intensity (m/s), the time (s) from 5 to 95 % of it, and the time (s) at which 45 % are reached. The ratio of
    /// the two times lies between [`SMALLEST_RATIO`] and [`LARGEST_RATIO`].
    pub(super) fn of(arias: f64, d5_95: f64, t_mid: f64) -> Modulation {
        let ratio = |shape: f64| (quantile(shape, 0.95) - quantile(shape, 0.05)) / quantile(shape, MIDDLE);
        let (mut low, mut high) = (SHAPES[0], SHAPES[1]);
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            // The larger the shape, the narrower.
            if ratio(middle) > d5_95 / t_mid { low = middle } else { high = middle }
        }
        let rate = quantile(low, MIDDLE) / t_mid;
        Modulation { shape: low, rate, ln_energy: ln(arias * 2.0 * STANDARD_GRAVITY / PI) }
    }

    /// Standard deviation of the acceleration (m/s^2) at a time (s).
    pub(super) fn at(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return 0.0;
        }
        let x = self.rate * time;
        exp(0.5 * (self.ln_energy + ln(self.rate) + (self.shape - 1.0) * ln(x) - x - ln_gamma(self.shape)))
    }

    /// The time (s) by which a share of the Arias intensity is expected.
    pub(super) fn time_of(&self, share: f64) -> f64 {
        quantile(self.shape, share) / self.rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_the_intensity_the_duration_and_the_middle_that_were_asked_for() {
        for (arias, d5_95, t_mid) in [(1.5, 12.0, 7.0), (0.02, 20.0, 4.2), (4.0, 1.0, 50.0)] {
            let q = Modulation::of(arias, d5_95, t_mid);
            assert!((q.time_of(0.95) - q.time_of(0.05) - d5_95).abs() < 1e-9 * d5_95);
            assert!((q.time_of(0.45) - t_mid).abs() < 1e-9 * t_mid);
            // The integral by itself: midpoints of q^2 up to where nothing is left.
            let (n, end) = (200_000, q.time_of(1.0 - 1e-12));
            let h = end / f64::from(n);
            let mut sum = 0.0;
            let mut at_middle = 0.0;
            for k in 0..n {
                let t = h * (f64::from(k) + 0.5);
                let share = h * q.at(t) * q.at(t) * PI / (2.0 * STANDARD_GRAVITY);
                sum += share;
                at_middle += if t < t_mid { share } else { 0.0 };
            }
            // A step beside the middle is 1e-5 of it; a shape near 1 begins with a root, which midpoints miss by h^1.5.
            assert!((sum / arias - 1.0).abs() < 1e-5, "{sum} of {arias}");
            assert!((at_middle / arias - 0.45).abs() < 2e-4, "{at_middle} of {arias}");
        }
    }
}
