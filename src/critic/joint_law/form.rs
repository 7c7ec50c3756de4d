//! A law of closure by its compliance at knots.

use crate::math::{exp, ln};

/// Knots of a law: stresses that are even in their logarithm.
#[derive(Clone, Debug, PartialEq)]
pub struct Knots {
    stresses: Vec<f64>,
}

impl Knots {
    /// So many, two at least, from one stress (Pa) to another.
    pub fn between(low: f64, high: f64, count: usize) -> Knots {
        let step = ln(high / low) / (count - 1) as f64;
        Knots { stresses: (0..count).map(|k| low * exp(step * k as f64)).collect() }
    }

    /// At these stresses (Pa), ascending.
    pub fn at(stresses: Vec<f64>) -> Knots {
        Knots { stresses }
    }

    /// The stresses (Pa), ascending.
    pub fn stresses(&self) -> &[f64] {
        &self.stresses
    }

    /// The closures (m) at the knots of a law with these logarithms of the compliance (m/Pa) there, a straight line of the
    /// logarithm of the stress between two knots, and constant below the first.
    pub fn closures(&self, ln_compliance: &[f64]) -> Vec<f64> {
        let mut closure = exp(ln_compliance[0]) * self.stresses[0];
        let mut all = vec![closure];
        for (stress, own) in self.stresses.windows(2).zip(ln_compliance.windows(2)) {
            closure += grown([stress[0], stress[1]], [own[0], own[1]]);
            all.push(closure);
        }
        all
    }

    /// What a law closes by (m) from the last knot to a stress (Pa) beyond it, from this logarithm of its compliance on, while its
    /// stiffness grows with this exponent of the stress.
    pub fn beyond(&self, ln_compliance: f64, exponent: f64, stress: f64) -> f64 {
        let from = self.stresses[self.stresses.len() - 1];
        grown([from, stress], [ln_compliance, ln_compliance - exponent * ln(stress / from)])
    }
}

/// The closure (m) from one stress to another: the integral of a compliance that is a power of the stress.
fn grown([from, to]: [f64; 2], [own, next]: [f64; 2]) -> f64 {
    let more = ln(to / from);
    // c s = c0 s0 exp((p + 1) x) over x = ln(s / s0).
    let rate = (next - own) / more + 1.0;
    let by = rate * more;
    let whole = if by.abs() < 1e-9 { 1.0 + 0.5 * by } else { (exp(by) - 1.0) / by };
    exp(own) * from * more * whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn closures_are_the_integral_of_a_power_and_of_a_constant() {
        let knots = Knots::between(100.0, 1e5, 7);
        assert_relative_eq!(knots.stresses()[2], 1e3, max_relative = 1e-12);
        let even = knots.closures(&[ln(2e-8); 7]);
        for (stress, closure) in knots.stresses().iter().zip(&even) {
            assert_relative_eq!(*closure, 2e-8 * stress, max_relative = 1e-12);
        }
        for power in [0.5, 1.0, 1.5] {
            let own: Vec<f64> = knots.stresses().iter().map(|s| ln(1e-7) - power * ln(s / 100.0)).collect();
            let closures = knots.closures(&own);
            for (stress, closure) in knots.stresses().iter().zip(&closures) {
                let over: f64 = stress / 100.0;
                let rest = 1.0 - power;
                let more = if rest == 0.0 { ln(over) } else { (exp(rest * ln(over)) - 1.0) / rest };
                assert_relative_eq!(*closure, 1e-5 * (1.0 + more), max_relative = 1e-9);
            }
            // It goes on as the power, or softer than that where the stiffness stays.
            let [stays, on] = [0.0, power].map(|power| knots.beyond(own[6], power, 2e5));
            assert_relative_eq!(stays, 1e5 * exp(own[6]), max_relative = 1e-9);
            assert!(stays > on && on > 0.0);
        }
    }
}
