//! How far a law is from those that have a name.

use nalgebra::{DMatrix, DVector};

use crate::math::{exp, ln, pow};

/// Rounds of the search for a named law's parameters, and its first step (logarithms).
const ROUNDS: usize = 400;
const FIRST_STEP: f64 = 1.0;

/// A law with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Constant stiffness.
    Linear,
    /// The hyperbola of `joint_closure` in series with a stiffness.
    JointClosure,
    /// The power of `stress_stiffening`.
    StressStiffening,
}

/// How near a law with a name comes.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Nearness {
    /// Its name.
    pub form: Form,
    /// What it loses of what the readings know of the law, at its best parameters (nats): half the squared distance in standard
    /// deviations.
    pub lost_nats: f64,
    /// Its parameters by name and unit, in SI units.
    pub parameters: Vec<(&'static str, f64)>,
}

impl Form {
    /// All of them, the simplest first.
    pub const ALL: [Form; 3] = [Form::Linear, Form::JointClosure, Form::StressStiffening];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Form::Linear => "constant stiffness",
            Form::JointClosure => "joint_closure",
            Form::StressStiffening => "stress_stiffening",
        }
    }

    fn names(self) -> &'static [&'static str] {
        match self {
            Form::Linear => &["kn_pa_per_m"],
            Form::JointClosure => &["kn_pa_per_m", "initial_pa_per_m", "closure_m"],
            Form::StressStiffening => &["at_1_mpa_pa_per_m", "exponent"],
        }
    }

    /// The logarithm of the compliance (m/Pa) at a stress (Pa).
    fn ln_compliance(self, parameters: &[f64], stress: f64) -> f64 {
        match (self, parameters) {
            (Form::JointClosure, [kn, initial, closure]) => {
                let knee = initial * closure;
                ln(1.0 / kn + closure * knee / ((knee + stress) * (knee + stress)))
            }
            (Form::StressStiffening, [at_1_mpa, exponent]) => -ln(at_1_mpa * pow(stress / 1e6, *exponent)),
            _ => -ln(parameters[0]),
        }
    }

    /// Where its search begins, for a law of this stiffness (Pa/m) at this stress (Pa).
    fn start(self, stiffness: f64, stress: f64) -> Vec<f64> {
        match self {
            Form::Linear => vec![stiffness],
            Form::JointClosure => vec![2.0 * stiffness, 0.5 * stiffness, stress / stiffness],
            Form::StressStiffening => vec![stiffness * pow(1e6 / stress, 0.5), 0.5],
        }
    }

    /// How near it comes to a law that is known at these stresses with this information.
    pub fn near(self, stresses: &[f64], ln_compliance: &[f64], information: &DMatrix<f64>) -> Nearness {
        let lost = |logs: &[f64]| {
            let parameters: Vec<f64> = logs.iter().map(|x| exp(*x)).collect();
            let apart = stresses.iter().zip(ln_compliance);
            let apart = DVector::from_iterator(
                stresses.len(),
                apart.map(|(stress, own)| own - self.ln_compliance(&parameters, *stress)),
            );
            0.5 * apart.dot(&(information * &apart))
        };
        let middle = stresses.len() / 2;
        let mut best: Vec<f64> =
            self.start(exp(-ln_compliance[middle]), stresses[middle]).iter().map(|x| ln(*x)).collect();
        let mut least = lost(&best);
        let mut steps = vec![FIRST_STEP; best.len()];
        // Each parameter in turn, further where that helps and back by less where it does not.
        for round in 0..ROUNDS {
            let k = round % best.len();
            let mut own = best.clone();
            own[k] += steps[k];
            let value = lost(&own);
            if value < least {
                (best, least) = (own, value);
                steps[k] *= 1.6;
            } else {
                steps[k] *= -0.6;
            }
        }
        let parameters = self.names().iter().copied().zip(best.into_iter().map(exp)).collect();
        Nearness { form: self, lost_nats: least, parameters }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_law_is_nearest_to_itself() {
        let stresses: Vec<f64> = (0..7).map(|k| 200.0 * pow(2.5, f64::from(k))).collect();
        // A tenth is known of every knot.
        let information = DMatrix::identity(7, 7) * 100.0;
        for (form, parameters) in [
            (Form::Linear, vec![5e7]),
            (Form::JointClosure, vec![5e7, 6e6, 3e-4]),
            (Form::StressStiffening, vec![7e8, 0.5]),
        ] {
            let law: Vec<f64> = stresses.iter().map(|s| form.ln_compliance(&parameters, *s)).collect();
            let own = form.near(&stresses, &law, &information);
            assert!(own.lost_nats < 0.05, "{form:?} {own:?}");
            if form != Form::Linear {
                let linear = Form::Linear.near(&stresses, &law, &information);
                assert!(linear.lost_nats > 10.0, "{form:?} {linear:?}");
            }
        }
    }
}
