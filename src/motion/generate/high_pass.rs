//! High-pass: what a seismometer's mass keeps of the motion of its frame.

use nalgebra::{Matrix4, Vector4};

use crate::math::ln;

/// Terms of the series of the exponential; more change no digit up to one radian per step.
const TERMS: usize = 24;
/// How much of a motion of the high-pass is left at the end of a record.
const LEFT: f64 = 1e-4;

/// The second derivative of `x` in `x'' + 2 zeta omega x' + omega^2 x = z`: the second filter of Clough and Penzien, and with `zeta` = 1
/// that of Rezaeian and Der Kiureghian (2010). Its gain is `omega_z^2/|omega^2 - omega_z^2 + 2 i zeta omega omega_z|` at the frequency `omega_z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HighPass {
    /// Corner (rad/s).
    pub(super) omega: f64,
    /// Damping ratio; 1 is critical.
    pub(super) zeta: f64,
}

impl HighPass {
    /// How long (s) it moves on after its input has ended, until the envelope of its free motion has fallen to 1e-4.
    pub(super) fn rest(&self) -> f64 {
        -ln(LEFT) / (self.zeta * self.omega)
    }

    /// What it keeps of an input (m/s^2) at equal steps (s), linear in between, from rest; exact for such an input. The output goes on
    /// after the input, which is 0 there, for the time of [`HighPass::rest`].
    pub(super) fn applied(&self, input: &[f64], step: f64) -> Vec<f64> {
        let after = (self.rest() / step).ceil() as usize;
        let (k, c) = (self.omega * self.omega, 2.0 * self.zeta * self.omega);
        #[rustfmt::skip]
        let rates = Matrix4::new(
            0.0, 1.0, 0.0, 0.0,
            -k,  -c,  1.0, 0.0,
            0.0, 0.0, 0.0, 1.0,
            0.0, 0.0, 0.0, 0.0,
        );
        let over_a_step = exponential(&(rates * step));
        let at = |i: usize| input.get(i).copied().unwrap_or(0.0);
        let mut state = Vector4::zeros();
        let mut output = Vec::with_capacity(input.len() + after);
        for i in 0..input.len() + after {
            state[2] = at(i);
            state[3] = (at(i + 1) - at(i)) / step;
            output.push(at(i) - c * state[1] - k * state[0]);
            state = over_a_step * state;
        }
        output
    }
}

/// Exponential of a matrix of norm up to about one, by its series.
fn exponential(matrix: &Matrix4<f64>) -> Matrix4<f64> {
    let mut sum = Matrix4::identity();
    let mut term = Matrix4::identity();
    for k in 1..=TERMS {
        term = term * matrix / k as f64;
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::math::{cos, exp, sin};
    use crate::motion::Accelerogram;

    /// A constant input from rest, critically damped: `x'' = z (1 - omega t) exp(-omega t)`.
    #[test]
    fn a_step_is_answered_by_the_closed_form() {
        let (omega, step) = (1.3, 0.01);
        let output = HighPass { omega, zeta: 1.0 }.applied(&[2.0; 500], step);
        for (i, found) in output[..499].iter().enumerate() {
            let t = step * i as f64;
            let expected = 2.0 * (1.0 - omega * t) * exp(-omega * t);
            assert!((found - expected).abs() < 1e-12, "{t}: {found} and {expected}");
        }
    }

    #[test]
    fn a_harmonic_is_passed_with_the_stated_gain() {
        let pass = HighPass { omega: 2.0, zeta: 0.6 };
        for w in [0.5, 2.0, 6.0] {
            let step = 0.005;
            let n = (20.0 * TAU / w / step) as usize;
            let input: Vec<f64> = (0..n).map(|i| sin(w * step * i as f64)).collect();
            let output = pass.applied(&input, step);
            // Fit over the last five periods, when the free motion is gone.
            let (mut a, mut b, from) = (0.0, 0.0, n - (5.0 * TAU / w / step) as usize);
            for (i, y) in output.iter().enumerate().take(n).skip(from) {
                a += y * sin(w * step * i as f64) * 2.0 / (n - from) as f64;
                b += y * cos(w * step * i as f64) * 2.0 / (n - from) as f64;
            }
            let (re, im) = (pass.omega * pass.omega - w * w, 2.0 * pass.zeta * pass.omega * w);
            let expected = w * w / (re * re + im * im).sqrt();
            // Sums over periods that do not begin and end at samples.
            assert!(((a * a + b * b).sqrt() / expected - 1.0).abs() < 5e-3, "{w}: {a} {b} {expected}");
        }
    }

    #[test]
    fn the_base_comes_to_rest_where_the_input_would_have_drifted() {
        let input = vec![1.0; 300];
        let pass = HighPass { omega: TAU * 0.2, zeta: 1.0 };
        let record = Accelerogram::new(0.01, pass.applied(&input, 0.01)).expect("good samples");
        let last = record.samples().len() - 1;
        // Unfiltered 3 m/s and several metres; 1e-4 of its motion is left, times 1 + omega t = 10 of a critical damper.
        let (v, d) = (record.velocities()[last], record.displacements()[last]);
        assert!(v.abs() < 3e-3 && d.abs() < 3e-3, "{v} {d}");
    }
}
