//! One component of a record: acceleration at equal steps, and what it integrates to.

use crate::motion::BadParameter;

/// Acceleration (m/s^2) along one direction at equal steps of time, linear in between.
///
/// The first sample lies at the time 0. Before it and after the last one the acceleration is 0, so that the base then keeps its
/// velocity. Velocity and displacement begin at 0 and are the exact integrals: a parabola and a cubic inside each step. Nothing is
/// corrected: a record whose zero line is off drifts (see [`Measures`](crate::motion::Measures)).
#[derive(Clone, Debug, PartialEq)]
pub struct Accelerogram {
    step: f64,
    acceleration: Vec<f64>,
    velocity: Vec<f64>,
    displacement: Vec<f64>,
}

/// Acceleration (m/s^2), velocity (m/s) and displacement (m) of the base at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct State {
    pub(super) acceleration: f64,
    pub(super) velocity: f64,
    pub(super) displacement: f64,
}

impl State {
    /// After the shaking, `since` (s) from here: no acceleration.
    pub(super) fn coasting(self, since: f64) -> State {
        State {
            acceleration: 0.0,
            displacement: self.displacement + self.velocity * since,
            velocity: self.velocity,
        }
    }
}

impl Accelerogram {
    /// From samples (m/s^2), `step` (s) apart.
    ///
    /// # Errors
    /// A step that is not within 1e-6 to 10 s, fewer than two samples, or a sample that is no number.
    ///
    /// ```
    /// use pirca::motion::Accelerogram;
    /// let ramp = Accelerogram::new(0.5, vec![0.0, 1.0, 2.0]).unwrap();
    /// assert_eq!(ramp.acceleration(0.75), 1.5);
    /// assert!((ramp.velocity(0.75) - 0.75 * 0.75).abs() < 1e-15);
    /// assert!((ramp.displacement(0.75) - 0.75 * 0.75 * 0.75 / 3.0).abs() < 1e-15);
    /// ```
    pub fn new(step: f64, acceleration: Vec<f64>) -> Result<Accelerogram, BadParameter> {
        if !(1e-6..=10.0).contains(&step) {
            let allowed = "1e-6 to 10 s";
            return Err(BadParameter { parameter: "step (s)", found: step, allowed });
        }
        if acceleration.len() < 2 {
            let found = acceleration.len() as f64;
            return Err(BadParameter { parameter: "number of samples", found, allowed: "at least 2" });
        }
        if let Some(&found) = acceleration.iter().find(|a| !a.is_finite()) {
            return Err(BadParameter {
                parameter: "acceleration (m/s^2)",
                found,
                allowed: "a finite number",
            });
        }
        let (mut velocity, mut displacement) = (vec![0.0], vec![0.0]);
        let (mut v, mut d) = (0.0, 0.0);
        for pair in acceleration.windows(2) {
            d += step * (v + step * (2.0 * pair[0] + pair[1]) / 6.0);
            v += step * (pair[0] + pair[1]) / 2.0;
            velocity.push(v);
            displacement.push(d);
        }
        Ok(Accelerogram { step, acceleration, velocity, displacement })
    }

    /// Time between two samples (s).
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Time from the first sample to the last one (s).
    pub fn duration(&self) -> f64 {
        self.step * (self.acceleration.len() - 1) as f64
    }

    /// The samples of acceleration (m/s^2).
    pub fn samples(&self) -> &[f64] {
        &self.acceleration
    }

    /// Velocity (m/s) of the base at each sample, 0 at the first one.
    pub fn velocities(&self) -> &[f64] {
        &self.velocity
    }

    /// Displacement (m) of the base at each sample, 0 at the first one.
    pub fn displacements(&self) -> &[f64] {
        &self.displacement
    }

    /// Acceleration (m/s^2) at a time (s).
    pub fn acceleration(&self, time: f64) -> f64 {
        self.state(time).acceleration
    }

    /// Velocity (m/s) of the base at a time (s).
    pub fn velocity(&self, time: f64) -> f64 {
        self.state(time).velocity
    }

    /// Displacement (m) of the base at a time (s).
    pub fn displacement(&self, time: f64) -> f64 {
        self.state(time).displacement
    }

    pub(super) fn state(&self, time: f64) -> State {
        let last = self.acceleration.len() - 1;
        if time < 0.0 {
            return State::default();
        }
        if time > self.duration() {
            let end = State {
                acceleration: 0.0,
                velocity: self.velocity[last],
                displacement: self.displacement[last],
            };
            return end.coasting(time - self.duration());
        }
        let i = ((time / self.step) as usize).min(last - 1);
        self.inside(i, time - self.step * i as f64)
    }

    /// `s` (s) after sample `i`, inside the step that it begins.
    pub(super) fn inside(&self, i: usize, s: f64) -> State {
        let a = self.acceleration[i];
        let jerk = (self.acceleration[i + 1] - a) / self.step;
        let v = self.velocity[i];
        State {
            acceleration: a + jerk * s,
            velocity: v + s * (a + s * jerk / 2.0),
            displacement: self.displacement[i] + s * (v + s * (a / 2.0 + s * jerk / 6.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every integral against a fine sum of the acceleration alone, at times on and off the samples.
    #[test]
    fn velocity_and_displacement_are_the_integrals_of_the_acceleration() {
        let record = Accelerogram::new(0.1, vec![0.4, -1.3, 2.2, 0.7, -0.9]).expect("good samples");
        // Midpoint rule: within a step the acceleration is linear, so its sum is exact but for rounding where a step is not cut.
        let (n, mut v, mut d) = (4000, 0.0, 0.0);
        let h = record.duration() / f64::from(n);
        for k in 0..n {
            let t = h * f64::from(k);
            assert!((record.velocity(t) - v).abs() < 1e-12, "{t}: {} and {v}", record.velocity(t));
            // The midpoint rule of a parabola of curvature 35 m/s^3 errs by 35 h^2/24 of the time.
            assert!((record.displacement(t) - d).abs() < 2e-8, "{t}: {} and {d}", record.displacement(t));
            d += h * record.velocity(t + 0.5 * h);
            v += h * record.acceleration(t + 0.5 * h);
        }
    }

    #[test]
    fn the_base_coasts_after_the_last_sample_and_rests_before_the_first() {
        let record = Accelerogram::new(0.5, vec![2.0, 2.0, 2.0]).expect("good samples");
        assert_eq!(record.state(-1e-9), State::default());
        assert_eq!((record.acceleration(0.0), record.acceleration(1.0)), (2.0, 2.0));
        assert_eq!(record.acceleration(1.0 + 1e-9), 0.0);
        assert_eq!((record.velocity(3.0), record.displacement(3.0)), (2.0, 5.0));
    }

    #[test]
    fn what_makes_no_record_is_named() {
        let faults = [
            (0.0, vec![0.0, 1.0], "step (s) = 0: allowed is 1e-6 to 10 s"),
            (0.1, vec![0.0], "number of samples = 1: allowed is at least 2"),
            (0.1, vec![0.0, f64::NAN], "acceleration (m/s^2) = NaN: allowed is a finite number"),
        ];
        for (step, samples, said) in faults {
            assert_eq!(Accelerogram::new(step, samples).unwrap_err().to_string(), said);
        }
    }
}
