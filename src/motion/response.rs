//! Response spectra: how far a damped oscillator goes that stands on a base.

use std::f64::consts::PI;

use crate::math::{cos, exp, sin};
use crate::motion::Accelerogram;

/// Steps in a period at least: the peak between two of them is missed by less than 1 - cos(pi / 40), 0.3 %.
const FINE: f64 = 40.0;

/// What the state of an oscillator becomes in a step under an acceleration that is linear in it.
struct Step {
    /// Of displacement and velocity.
    own: [[f64; 2]; 2],
    /// Of the acceleration at the two ends of the step.
    load: [[f64; 2]; 2],
}

impl Accelerogram {
    /// The largest displacement (m) relative to the base of an oscillator with a period (s) and a share of critical damping below 1, from rest, while the base
    /// shakes and one period longer. Exact for a record that is linear between its samples (N. C. Nigam and P. C. Jennings, 1969).
    pub fn response(&self, period: f64, damping: f64) -> f64 {
        let samples = self.samples();
        // A step is divided where it is long beside the period.
        let parts = (FINE * self.step() / period).ceil().max(1.0);
        let step = self.step() / parts;
        let transition = Step::of(2.0 * PI / period, damping, step);
        let ends = samples.windows(2).flat_map(|pair| {
            let between = move |k: u32| pair[0] + (pair[1] - pair[0]) * f64::from(k) / parts;
            (1..=parts as u32).map(between)
        });
        let after = (0..(period / step).ceil() as u32).map(|_| 0.0);
        let mut state = [0.0; 2];
        let (mut before, mut largest) = (samples.first().copied().unwrap_or(0.0), 0.0);
        for now in ends.chain(after) {
            state = transition.after(state, [before, now]);
            largest = f64::max(largest, state[0].abs());
            before = now;
        }
        largest
    }
}

impl Step {
    /// Of an oscillator of angular frequency `w` (rad/s), over a step (s).
    fn of(w: f64, damping: f64, step: f64) -> Step {
        let root = (1.0 - damping * damping).sqrt();
        let wd = w * root;
        let decay = exp(-damping * w * step);
        let (s, c) = (decay * sin(wd * step), decay * cos(wd * step));
        let (k, lag) = (w * w, 2.0 * damping / (w * step));
        Step {
            own: [[damping / root * s + c, s / wd], [-w / root * s, c - damping / root * s]],
            load: [
                [
                    (lag + ((1.0 - 2.0 * damping * damping) / (wd * step) - damping / root) * s
                        - (1.0 + lag) * c)
                        / k,
                    (1.0 - lag + (2.0 * damping * damping - 1.0) / (wd * step) * s + lag * c) / k,
                ],
                [
                    (-1.0 / step + (w / root + damping / (step * root)) * s + c / step) / k,
                    (1.0 - damping / root * s - c) / (k * step),
                ],
            ],
        }
    }

    /// The state after a step, from displacement and velocity, and the acceleration of the base at its ends.
    fn after(&self, [u, v]: [f64; 2], [from, to]: [f64; 2]) -> [f64; 2] {
        let row = |k: usize| {
            self.own[k][0] * u + self.own[k][1] * v - self.load[k][0] * from - self.load[k][1] * to
        };
        [row(0), row(1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A base that begins to accelerate at once, and goes on: an undamped oscillator goes twice as far as it would rest.
    #[test]
    fn a_sudden_acceleration_is_felt_twice() {
        let record = Accelerogram::new(0.01, vec![1.0; 1000]).expect("a record");
        let w = 2.0 * PI / 0.8;
        let found = record.response(0.8, 0.0);
        assert!((found * w * w - 2.0).abs() < 0.01, "{found}");
    }

    /// In resonance with a harmonic a damped oscillator comes to 1 / (2 damping) of what it would rest at.
    #[test]
    fn resonance_is_bounded_by_damping() {
        let w = 2.0 * PI / 0.5;
        let record: Vec<f64> = (0..8000).map(|k| sin(w * 0.005 * f64::from(k))).collect();
        let record = Accelerogram::new(0.005, record).expect("a record");
        let found = record.response(0.5, 0.05) * w * w;
        assert!((found - 10.0).abs() < 0.02, "{found}");
    }

    /// A stiff oscillator goes with the base, a soft one stays where it is while the base goes.
    #[test]
    fn the_ends_of_a_spectrum_are_the_base() {
        let record: Vec<f64> = (0..400).map(|k| sin(2.0 * PI * 0.01 * f64::from(k))).collect();
        let record = Accelerogram::new(0.01, record).expect("a record");
        let stiff = record.response(0.02, 0.05) * (2.0 * PI / 0.02) * (2.0 * PI / 0.02);
        assert!((stiff - 1.0).abs() < 0.01, "{stiff}");
        let travel = (0..400).map(|k| record.displacement(0.01 * f64::from(k)).abs()).fold(0.0, f64::max);
        let soft = record.response(400.0, 0.05);
        assert!((soft / travel - 1.0).abs() < 0.05, "{soft} {travel}");
    }
}
