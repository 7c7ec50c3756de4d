//! Pulses and wavelets in closed form.
//!
//! They stay formulas, and are not sampled: a solver asks for the acceleration at steps of 1e-3 to 1e-5 s, a jump of a rectangle lies at a
//! time and not between two samples, and reference answers (overturning by a half sine, sliding under a rectangle) hold to all digits.

#[cfg(test)]
mod tests;

use std::f64::consts::{PI, TAU};

use crate::math::{cos, exp, sin};
use crate::motion::BadParameter;
use crate::motion::accelerogram::State;
use crate::motion::fault::Faults;

/// A pulse of the base along one direction; it begins at the time 0. Amplitudes are signed.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(tag = "pulse", rename_all = "snake_case")]
pub enum Pulse {
    /// Constant acceleration for a time. The base keeps the velocity `A T` afterwards.
    Rectangle {
        /// Acceleration `A` (m/s^2).
        amplitude: f64,
        /// How long, `T` (s).
        duration: f64,
    },
    /// `a = A sin(pi t/T)` for one half of a cycle (Housner 1963). The base keeps the velocity `2 A T/pi` afterwards.
    HalfSine {
        /// Peak acceleration `A` (m/s^2).
        amplitude: f64,
        /// How long, `T` (s): half of the period.
        duration: f64,
    },
    /// `a = A sin(2 pi f t)` for whole cycles. The base ends at rest, displaced by `n A/(2 pi f^2)`; one cycle is the forward pulse (type
    /// A) of Makris and Roussos (2000).
    Sine {
        /// Peak acceleration `A` (m/s^2).
        amplitude: f64,
        /// Frequency `f` (Hz).
        frequency: f64,
        /// Number of cycles `n`.
        cycles: u32,
    },
    /// `a = A cos(2 pi f t)` for whole cycles, with a jump at both ends. The base ends at rest where it began; one cycle is the
    /// forward-and-back pulse (type B) of Makris and Roussos (2000).
    Cosine {
        /// Peak acceleration `A` (m/s^2).
        amplitude: f64,
        /// Frequency `f` (Hz).
        frequency: f64,
        /// Number of cycles `n`.
        cycles: u32,
    },
    /// `a = A (1 - 2 x) exp(-x)` with `x = (pi f s)^2` and `s` from the peak (Ricker 1953). The base ends at rest where it began.
    ///
    /// It lasts 4/f, the peak in the middle. What lies outside is less than 1e-15 of the peak.
    Ricker {
        /// Peak acceleration `A` (m/s^2).
        amplitude: f64,
        /// Frequency `f` (Hz) at which its spectrum is largest.
        frequency: f64,
    },
    /// Near-fault pulse of Mavroeidis and Papageorgiou (2003), given by its velocity
    /// `v = A/2 (1 + cos(2 pi fp s/gamma)) cos(2 pi fp s + nu)` for `|s| <= gamma/(2 fp)`, `s` from its middle.
    ///
    /// The base ends at rest, displaced by `-A cos(nu) sin(pi gamma)/(2 pi fp (gamma^2 - 1))`: nothing for a whole `gamma` from 2 on or for
    /// `nu` = 90 deg, else not. See [`Pulse::net_displacement`].
    MavroeidisPapageorgiou {
        /// Amplitude `A` of the velocity (m/s).
        velocity_amplitude: f64,
        /// Prevailing frequency `fp` (Hz).
        frequency: f64,
        /// Number of oscillations `gamma`, above 1.
        gamma: f64,
        /// Phase `nu` (rad).
        phase: f64,
    },
}

/// Half of the length of a Ricker wavelet, in periods.
const RICKER_HALF: f64 = 2.0;
/// Samples of a period, where a pulse has to be sampled. The peak between two of them is missed by 5e-6 of it at most.
const SAMPLES_PER_PERIOD: f64 = 1000.0;

impl Pulse {
    /// Accepts the parameters, or names every one that is wrong.
    ///
    /// # Errors
    /// Amplitudes that are 0 or too large (above 1000 m/s^2 or m/s), durations and frequencies outside 1e-4 to 1e3, no cycle or more than
    /// 1000 of them, `gamma` outside 1 to 100.
    pub fn checked(self) -> Result<Pulse, Vec<BadParameter>> {
        let mut faults = Faults::default();
        let mut size = |name, value: f64| {
            let good = value != 0.0 && value.abs() <= 1000.0;
            faults.require(good, name, value, "not 0 and at most 1000 in size");
        };
        let (name, value) = match self {
            Pulse::Rectangle { amplitude, duration } | Pulse::HalfSine { amplitude, duration } => {
                size("amplitude (m/s^2)", amplitude);
                ("duration (s)", duration)
            }
            Pulse::Sine { amplitude, frequency, .. }
            | Pulse::Cosine { amplitude, frequency, .. }
            | Pulse::Ricker { amplitude, frequency } => {
                size("amplitude (m/s^2)", amplitude);
                ("frequency (Hz)", frequency)
            }
            Pulse::MavroeidisPapageorgiou { velocity_amplitude, frequency, .. } => {
                size("velocity_amplitude (m/s)", velocity_amplitude);
                ("frequency (Hz)", frequency)
            }
        };
        faults.require((1e-4..=1e3).contains(&value), name, value, "1e-4 to 1000");
        match self {
            Pulse::Sine { cycles, .. } | Pulse::Cosine { cycles, .. } => {
                faults.require((1..=1000).contains(&cycles), "cycles", f64::from(cycles), "1 to 1000");
            }
            Pulse::MavroeidisPapageorgiou { gamma, phase, .. } => {
                faults.require(gamma > 1.0 && gamma <= 100.0, "gamma", gamma, "above 1 and at most 100");
                faults.require(phase.abs() <= 100.0, "phase (rad)", phase, "within -100 to 100 rad");
            }
            _ => {}
        }
        faults.none_or(|| self)
    }

    /// How long it lasts (s).
    pub fn duration(&self) -> f64 {
        match *self {
            Pulse::Rectangle { duration, .. } | Pulse::HalfSine { duration, .. } => duration,
            Pulse::Sine { frequency, cycles, .. } | Pulse::Cosine { frequency, cycles, .. } => {
                f64::from(cycles) / frequency
            }
            Pulse::Ricker { frequency, .. } => 2.0 * RICKER_HALF / frequency,
            Pulse::MavroeidisPapageorgiou { frequency, gamma, .. } => gamma / frequency,
        }
    }

    /// Velocity (m/s) that the base keeps at the end.
    pub fn end_velocity(&self) -> f64 {
        match *self {
            Pulse::Rectangle { amplitude, duration } => amplitude * duration,
            Pulse::HalfSine { amplitude, duration } => 2.0 * amplitude * duration / PI,
            _ => 0.0,
        }
    }

    /// Displacement (m) of the base at the end of the pulse.
    ///
    /// ```
    /// use pirca::motion::Pulse;
    /// let pulse =
    ///     Pulse::MavroeidisPapageorgiou { velocity_amplitude: 1.0, frequency: 1.0, gamma: 1.5, phase: 0.0 };
    /// assert!((pulse.net_displacement() - 0.1273).abs() < 5e-5);
    /// ```
    pub fn net_displacement(&self) -> f64 {
        match *self {
            Pulse::Rectangle { amplitude, duration } => 0.5 * amplitude * duration * duration,
            Pulse::HalfSine { amplitude, duration } => amplitude * duration * duration / PI,
            Pulse::Sine { amplitude, frequency, cycles } => {
                f64::from(cycles) * amplitude / (TAU * frequency * frequency)
            }
            Pulse::Cosine { .. } | Pulse::Ricker { .. } => 0.0,
            Pulse::MavroeidisPapageorgiou { velocity_amplitude, frequency, gamma, phase } => {
                // sin(pi gamma) by what gamma is above 1, so that no digits are lost close to it.
                let above = gamma - 1.0;
                velocity_amplitude * cos(phase) * sin(PI * above) / (TAU * frequency * above * (gamma + 1.0))
            }
        }
    }

    /// Acceleration (m/s^2) at a time (s); at both ends that of the pulse.
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

    /// The number of equal steps in which it is sampled, a thousand of them per period, where a measure needs samples.
    pub(super) fn steps(&self) -> usize {
        let periods = match *self {
            Pulse::Rectangle { .. } | Pulse::HalfSine { .. } => 1.0,
            Pulse::Sine { cycles, .. } | Pulse::Cosine { cycles, .. } => f64::from(cycles),
            Pulse::Ricker { .. } => 2.0 * RICKER_HALF,
            Pulse::MavroeidisPapageorgiou { gamma, .. } => gamma,
        };
        (SAMPLES_PER_PERIOD * periods).ceil() as usize
    }

    pub(super) fn state(&self, time: f64) -> State {
        if time < 0.0 {
            return State::default();
        }
        if time > self.duration() {
            let end = State {
                acceleration: 0.0,
                velocity: self.end_velocity(),
                displacement: self.net_displacement(),
            };
            return end.coasting(time - self.duration());
        }
        self.shaking(time)
    }

    fn shaking(&self, t: f64) -> State {
        match *self {
            Pulse::Rectangle { amplitude: a, .. } => {
                State { acceleration: a, velocity: a * t, displacement: 0.5 * a * t * t }
            }
            Pulse::HalfSine { amplitude, duration } => sine(amplitude, PI / duration, t),
            Pulse::Sine { amplitude, frequency, .. } => sine(amplitude, TAU * frequency, t),
            Pulse::Cosine { amplitude: a, frequency, .. } => {
                let omega = TAU * frequency;
                // 1 - cos without cancellation.
                let half = sin(0.5 * omega * t);
                State {
                    acceleration: a * cos(omega * t),
                    velocity: a * sin(omega * t) / omega,
                    displacement: 2.0 * a * half * half / (omega * omega),
                }
            }
            Pulse::Ricker { amplitude: a, frequency } => {
                let s = t - RICKER_HALF / frequency;
                let k = PI * PI * frequency * frequency;
                let x = k * s * s;
                let bell = exp(-x);
                State {
                    acceleration: a * (1.0 - 2.0 * x) * bell,
                    velocity: a * s * bell,
                    displacement: -a / (2.0 * k) * bell,
                }
            }
            Pulse::MavroeidisPapageorgiou { velocity_amplitude, frequency, gamma, phase } => {
                near_fault(velocity_amplitude, TAU * frequency, gamma, phase, t)
            }
        }
    }
}

/// `A sin(omega t)` from rest.
fn sine(a: f64, omega: f64, t: f64) -> State {
    let half = sin(0.5 * omega * t);
    State {
        acceleration: a * sin(omega * t),
        velocity: 2.0 * a * half * half / omega,
        displacement: a * (omega * t - sin(omega * t)) / (omega * omega),
    }
}

/// The pulse of Mavroeidis and Papageorgiou at `t` from its beginning, by its three harmonics: of `omega` with half of the amplitude, and
/// of `omega (1 +- 1/gamma)` with a quarter each.
fn near_fault(a: f64, omega: f64, gamma: f64, nu: f64, t: f64) -> State {
    let begin = -PI * gamma / omega;
    let s = t + begin;
    let parts = [(0.5, omega), (0.25, omega * (1.0 + 1.0 / gamma)), (0.25, omega * (1.0 - 1.0 / gamma))];
    let mut state = State::default();
    for (share, k) in parts {
        let share = a * share;
        state.acceleration -= share * k * sin(k * s + nu);
        state.velocity += share * cos(k * s + nu);
        // Integral of cos(k s + nu) from the beginning, in the form that holds for small k.
        state.displacement += share * 2.0 * cos(0.5 * k * (s + begin) + nu) * sin(0.5 * k * t) / k;
    }
    state
}
