//! The acceleration of the base: up to several components, each a record or a pulse along a direction.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use crate::math::{Vec3, atan2, cos, sin};
use crate::motion::accelerogram::State;
use crate::motion::{Accelerogram, BadParameter, Measures, Pulse};

/// Largest difference between the steps of two records that are put together, as a share: what printing a step with few digits costs.
const SAME_STEP: f64 = 1e-6;
/// Motion of the base of a wall: the sum of components, each along a direction of its own; x along the wall, y out of plane, z up.
///
/// In the frame of the base every block of mass `m` feels the body force `-m a(t)`. Components are records, linear between their samples,
/// or pulses in closed form. They begin at rest at the time 0; before it and after its end the acceleration is 0.
///
/// ```
/// use pirca::math::Vec3;
/// use pirca::motion::{Motion, Pulse};
/// let pulse = Pulse::Sine { amplitude: 2.0, frequency: 1.0, cycles: 1 };
/// let out_of_plane = Motion::of_pulse(pulse).unwrap().along(&Vec3::y()).unwrap();
/// assert!((out_of_plane.scaled(1.5).acceleration(0.25) - Vec3::new(0.0, 3.0, 0.0)).norm() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Where it is from: a file, a kind of pulse, a generator with its seed.
    pub name: String,
    /// What was noticed on reading it, each a sentence for the user.
    pub notes: Vec<String>,
    components: Vec<Component>,
}

/// One component.
#[derive(Clone, Debug, PartialEq)]
struct Component {
    /// Its direction, times the factor by which it is scaled.
    along: Vec3,
    history: History,
}

/// What acts along the direction of a component.
#[derive(Clone, Debug, PartialEq)]
enum History {
    /// Shared, so that scaled and turned copies cost nothing.
    Recorded(Arc<Accelerogram>),
    Pulse(Pulse),
}

impl History {
    fn state(&self, time: f64) -> State {
        match self {
            History::Recorded(record) => record.state(time),
            History::Pulse(pulse) => pulse.state(time),
        }
    }

    fn duration(&self) -> f64 {
        match self {
            History::Recorded(record) => record.duration(),
            History::Pulse(pulse) => pulse.duration(),
        }
    }
}

impl Motion {
    /// A record along x.
    pub fn of_record(name: &str, record: Accelerogram) -> Motion {
        Motion::one(name, History::Recorded(Arc::new(record)))
    }

    /// A pulse along x.
    ///
    /// # Errors
    /// Every parameter that is wrong; see [`Pulse::checked`].
    pub fn of_pulse(pulse: Pulse) -> Result<Motion, Vec<BadParameter>> {
        let name = match pulse {
            Pulse::Rectangle { .. } => "rectangular pulse",
            Pulse::HalfSine { .. } => "half-sine pulse",
            Pulse::Sine { .. } => "sine pulse",
            Pulse::Cosine { .. } => "cosine pulse",
            Pulse::Ricker { .. } => "Ricker wavelet",
            Pulse::MavroeidisPapageorgiou { .. } => "pulse of Mavroeidis and Papageorgiou",
        };
        Ok(Motion::one(name, History::Pulse(pulse.checked()?)))
    }

    /// The same with notes for the user.
    pub(super) fn noted(self, notes: Vec<String>) -> Motion {
        Motion { notes, ..self }
    }

    fn one(name: &str, history: History) -> Motion {
        let components = vec![Component { along: Vec3::x(), history }];
        Motion { name: name.to_owned(), notes: Vec::new(), components }
    }

    /// The same component along another direction, of any length but 0; in plan at an angle `t` from the wall towards out of plane that is
    /// `(cos t, sin t, 0)`. The factor by which it is scaled stays.
    ///
    /// # Errors
    /// A motion of several components, whose directions [`Motion::turned`] turns together, or a direction that is none.
    pub fn along(&self, direction: &Vec3) -> Result<Motion, BadParameter> {
        let found = self.components.len() as f64;
        if self.components.len() != 1 {
            let allowed = "one, where a direction is given; several are turned together";
            return Err(BadParameter { parameter: "number of components", found, allowed });
        }
        let length = direction.norm();
        if !(length > 0.0 && length.is_finite()) {
            let allowed = "above 0 and finite";
            return Err(BadParameter { parameter: "length of the direction", found: length, allowed });
        }
        let factor = self.components[0].along.norm();
        Ok(self.with_directions(|_| direction * (factor / length)))
    }

    /// Under another name.
    pub fn named(mut self, name: &str) -> Motion {
        self.name = name.to_owned();
        self
    }

    /// With its y axis, or its only component, along a horizontal direction of any length but 0.
    ///
    /// # Errors
    /// A direction that is none.
    pub fn towards(&self, direction: &Vec3) -> Result<Motion, BadParameter> {
        match self.components() {
            1 => self.along(direction),
            _ => Ok(self.turned(atan2(direction.y, direction.x) - FRAC_PI_2)),
        }
    }

    /// Both together, as the components of one station.
    ///
    /// # Errors
    /// Records of different steps. They may differ in length: what has ended is at rest.
    pub fn with(&self, other: &Motion) -> Result<Motion, BadParameter> {
        if let (Some(own), Some(found)) = (self.step(), other.step())
            && (own - found).abs() > SAME_STEP * own
        {
            let allowed = "the step of the other record; nothing is resampled here";
            return Err(BadParameter { parameter: "step (s)", found, allowed });
        }
        let mut both = self.clone();
        if both.name != other.name {
            both.name = format!("{} with {}", self.name, other.name);
        }
        both.notes.extend(other.notes.iter().cloned());
        both.components.extend(other.components.iter().cloned());
        Ok(both)
    }

    /// Turned about the vertical by an angle (rad), positive from x (along the wall) to y (out of plane).
    pub fn turned(&self, angle: f64) -> Motion {
        crate::check!(angle.is_finite(), "a motion was turned by {angle}");
        let (c, s) = (cos(angle), sin(angle));
        self.with_directions(|a| Vec3::new(c * a.x - s * a.y, s * a.x + c * a.y, a.z))
    }

    /// Times a finite factor.
    pub fn scaled(&self, factor: f64) -> Motion {
        crate::check!(factor.is_finite(), "a motion was scaled by {factor}");
        self.with_directions(|along| along * factor)
    }

    /// Whether any component has a horizontal part.
    pub fn is_horizontal(&self) -> bool {
        self.components.iter().any(|own| own.along.x != 0.0 || own.along.y != 0.0)
    }

    fn with_directions(&self, direction: impl Fn(&Vec3) -> Vec3) -> Motion {
        let mut motion = self.clone();
        motion.components.iter_mut().for_each(|own| own.along = direction(&own.along));
        motion
    }

    /// Acceleration (m/s^2) of the base at a time (s).
    pub fn acceleration(&self, time: f64) -> Vec3 {
        self.sum(|history| history.state(time).acceleration)
    }

    /// Velocity (m/s) of the base at a time (s).
    pub fn velocity(&self, time: f64) -> Vec3 {
        self.sum(|history| history.state(time).velocity)
    }

    /// Displacement (m) of the base at a time (s).
    pub fn displacement(&self, time: f64) -> Vec3 {
        self.sum(|history| history.state(time).displacement)
    }

    fn sum(&self, what: impl Fn(&History) -> f64) -> Vec3 {
        self.components.iter().fold(Vec3::zeros(), |sum, own| sum + own.along * what(&own.history))
    }

    /// Number of components.
    pub fn components(&self) -> usize {
        self.components.len()
    }

    /// Time of the last sample, or of the end of the last pulse (s).
    pub fn duration(&self) -> f64 {
        self.components.iter().fold(0.0, |end, own| own.history.duration().max(end))
    }

    /// Time between two samples (s) of its records; `None` where all is in closed form.
    pub fn step(&self) -> Option<f64> {
        self.components.iter().find_map(|own| match &own.history {
            History::Recorded(record) => Some(record.step()),
            History::Pulse(_) => None,
        })
    }

    /// The part along a direction, of any length but 0, as samples.
    ///
    /// A record has its own samples. A pulse is sampled, with a thousand steps to its period, or at those of the record that it goes
    /// with: for measures and figures, never for a solver.
    pub fn accelerogram(&self, direction: &Vec3) -> Accelerogram {
        crate::check!(direction.norm() > 0.0, "a part was asked for along no direction");
        let unit = direction.normalize();
        let end = self.duration();
        let step = self.step().unwrap_or_else(|| {
            let steps = self.components.iter().map(|own| match &own.history {
                History::Pulse(pulse) => pulse.duration() / pulse.steps() as f64,
                History::Recorded(record) => record.step(),
            });
            // Whole steps up to the end.
            end / (end / steps.fold(f64::INFINITY, f64::min)).round()
        });
        let n = (end / step).round() as usize + 1;
        let mut samples = vec![0.0; n];
        for own in &self.components {
            let share = own.along.dot(&unit);
            match &own.history {
                History::Recorded(record) => {
                    let pairs = samples.iter_mut().zip(record.samples());
                    pairs.for_each(|(sum, a)| *sum += share * a);
                }
                History::Pulse(pulse) => {
                    let length = pulse.duration();
                    for (k, sum) in samples.iter_mut().enumerate() {
                        let time = step * k as f64;
                        // The last one by its name: a product may lie beside the end, where a pulse may jump.
                        let time = if (time - length).abs() < 1e-9 * step { length } else { time };
                        *sum += share * pulse.acceleration(time);
                    }
                }
            }
        }
        Accelerogram::new(step, samples).expect("sums of checked components at a checked step")
    }

    /// Intensity measures of the part along a direction, of any length but 0.
    pub fn measures(&self, direction: &Vec3) -> Measures {
        Measures::of(&self.accelerogram(direction))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    fn record() -> Motion {
        Motion::of_record("three", Accelerogram::new(0.5, vec![0.0, 1.0, -2.0]).expect("good samples"))
    }

    #[test]
    fn components_act_along_their_directions_and_turn_together() {
        let up = record().along(&Vec3::new(0.0, 0.0, 7.0)).expect("a direction");
        let both = record().with(&up).expect("one step").scaled(2.0);
        assert_eq!(both.acceleration(0.5), Vec3::new(2.0, 0.0, 2.0));
        let turned = both.turned(FRAC_PI_2);
        assert!((turned.acceleration(0.5) - Vec3::new(0.0, 2.0, 2.0)).norm() < 1e-15);
        // d = a t^2/6 on a ramp.
        assert!((turned.displacement(0.5) - Vec3::new(0.0, 1.0, 1.0) / 12.0).norm() < 1e-15);
        assert!((turned.velocity(0.5) - Vec3::new(0.0, 0.5, 0.5)).norm() < 1e-15);
        assert_eq!((both.components(), both.duration(), both.step()), (2, 1.0, Some(0.5)));
    }

    #[test]
    fn what_does_not_go_together_is_refused() {
        let other = Accelerogram::new(0.01, vec![0.0, 1.0]).expect("good samples");
        let said = record().with(&Motion::of_record("other", other)).unwrap_err().to_string();
        assert!(said.starts_with("step (s) = 0.01: allowed is the step of the other record"), "{said}");
        assert!(record().along(&Vec3::zeros()).is_err());
        assert!(record().with(&record()).expect("one step").along(&Vec3::x()).is_err());
    }

    #[test]
    fn a_pulse_is_exact_for_solvers_and_sampled_for_measures() {
        let pulse = Pulse::HalfSine { amplitude: 3.0, duration: 0.4 };
        let motion = Motion::of_pulse(pulse).expect("good parameters");
        assert_eq!(motion.acceleration(0.1).x, pulse.acceleration(0.1));
        assert_eq!((motion.step(), motion.duration()), (None, 0.4));
        // A thousand chords of a half sine lie below it by (pi/1000)^2/12 of the area.
        assert!((motion.pgv() / (2.0 * 3.0 * 0.4 / PI) - 1.0).abs() < 1e-6);
        assert!((motion.pga() - 3.0).abs() < 1e-5);
        // With a record it is taken at its samples, and the rest of the record is without it.
        let both = record().with(&motion).expect("one step is enough");
        assert_eq!(both.accelerogram(&Vec3::x()).samples(), record().accelerogram(&Vec3::x()).samples());
        assert!((both.acceleration(0.2).x - 3.4).abs() < 1e-14);
    }
}
