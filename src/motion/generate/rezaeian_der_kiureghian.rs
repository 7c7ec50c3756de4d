//! Noise whose intensity and frequency change over the shaking.

use std::f64::consts::TAU;

use crate::math::{cos, exp, ln, sin};
use crate::motion::fault::Faults;
use crate::motion::generate::high_pass::HighPass;
use crate::motion::generate::modulation::{LARGEST_RATIO, Modulation, SMALLEST_RATIO};
use crate::motion::generate::require_length;
use crate::motion::{Accelerogram, BadParameter, Motion};
use crate::random::{Streams, standard_normal};

/// Name of the stream of a record.
const STREAM: &str = "ground motion of Rezaeian and Der Kiureghian";
/// Lowest frequency of the filter (rad/s), 0.3 Hz: a line that falls over time would reach 0.
const LOWEST: f64 = TAU * 0.3;
/// What is left of an answer of the filter when it is no longer followed.
const LEFT: f64 = 1e-9;
/// Share of the Arias intensity that must be expected within the duration.
const WITHIN: f64 = 0.99;

/// Modulated filtered white noise with changing frequency (Rezaeian and Der Kiureghian 2010).
///
/// The answer of an oscillator of frequency `w(t)` and damping `zeta` to white noise is divided by its own standard deviation and
/// multiplied by a gamma modulation, which has the intensity, the duration and the middle that are asked for. Means over records are meant.
///
/// The high-pass comes afterwards, as in the paper, and takes with it of the Arias intensity about the share `3 zeta wc/wm`, where `wc` is
/// the corner, and `wm` is `w(t)` about the middle; below that the noise of an oscillator is white. The record is linear between samples,
/// which takes another `(w step)^2/6`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct RezaeianDerKiureghian {
    /// Expected Arias intensity (m/s), before the high-pass.
    pub arias: f64,
    /// Time (s) from 5 to 95 % of it.
    pub d5_95: f64,
    /// Middle of the strong shaking (s): when 45 % of it are reached.
    pub t_mid: f64,
    /// Frequency of the filter at the middle (rad/s): `2 pi` times the rate at which the acceleration rises through 0 there.
    pub omega_mid: f64,
    /// Change of it over time (rad/s^2). The frequency is not let below `2 pi` 0.3 rad/s.
    pub omega_rate: f64,
    /// Damping ratio of the filter, below 1: how broad the spectrum is.
    pub zeta: f64,
    /// Corner of the high-pass (Hz), critically damped. Long periods, and with them rocking, hang on it (Su, Dabaghi and Broccardo 2024).
    pub corner_hz: f64,
    /// How long it shakes (s). The record is longer by the rest of the high-pass, `1.47/corner_hz`.
    pub duration: f64,
    /// Time between two samples (s).
    pub step: f64,
}

impl RezaeianDerKiureghian {
    /// Frequency of the filter (rad/s) at a time (s).
    pub fn omega(&self, time: f64) -> f64 {
        (self.omega_mid + self.omega_rate * (time - self.t_mid)).max(LOWEST)
    }

    /// How long (s) it has to shake for 99 % of the intensity, which a process asks of its duration.
    pub fn lasting(&self) -> f64 {
        Modulation::of(self.arias, self.d5_95, self.t_mid).time_of(WITHIN)
    }

    /// The process, ready to draw records of.
    ///
    /// # Errors
    /// Every parameter that is wrong: an intensity or times that are not above 0, a duration of the strong shaking that is not within 0.011
    /// to 4.92 times its middle, a frequency of which a period has fewer than 12 samples at any time, a damping ratio outside 0.02 to 0.95, a
    /// corner outside 0.01 to 2 Hz, a duration within which less than 99 % of the intensity is expected.
    pub fn process(&self) -> Result<RezaeianDerKiureghianProcess, Vec<BadParameter>> {
        let mut faults = Faults::default();
        let mut times = faults.require(
            self.arias > 0.0 && self.arias <= 1e3,
            "arias (m/s)",
            self.arias,
            "above 0 and at most 1000 m/s",
        );
        times &= faults.require(
            self.t_mid > 0.0 && self.t_mid <= 1e3,
            "t_mid (s)",
            self.t_mid,
            "above 0 and at most 1000 s",
        );
        let ratio = (SMALLEST_RATIO..=LARGEST_RATIO).contains(&(self.d5_95 / self.t_mid));
        times &= faults.require(ratio, "d5_95 (s)", self.d5_95, "0.011 to 4.92 times t_mid");
        faults.require((0.02..=0.95).contains(&self.zeta), "zeta", self.zeta, "0.02 to 0.95");
        let corner = (0.01..=2.0).contains(&self.corner_hz);
        faults.require(corner, "corner_hz (Hz)", self.corner_hz, "0.01 to 2 Hz");
        if require_length(&mut faults, self.step, self.duration) {
            let highest = self.omega(0.0).max(self.omega(self.duration));
            let fine = self.omega_mid > 0.0 && highest * self.step <= TAU / 12.0;
            let allowed = "above 0, and a period of at least 12 steps at any time of the shaking";
            faults.require(fine, "omega_mid (rad/s)", self.omega_mid, allowed);
            // NaN is lost in the larger of two.
            faults.require(
                self.omega_rate.is_finite(),
                "omega_rate (rad/s^2)",
                self.omega_rate,
                "a finite number",
            );
            if times {
                let modulation = Modulation::of(self.arias, self.d5_95, self.t_mid);
                let long = self.duration >= modulation.time_of(WITHIN);
                faults.require(
                    long,
                    "duration (s)",
                    self.duration,
                    "so long that 99 % of the intensity is expected within",
                );
            }
        }
        faults.none_or(|| RezaeianDerKiureghianProcess::of(self))
    }
}

/// A process of Rezaeian and Der Kiureghian with checked parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct RezaeianDerKiureghianProcess {
    parameters: RezaeianDerKiureghian,
    /// Modulation over the standard deviation of the filtered noise, at each sample (m/s^2).
    factors: Vec<f64>,
}

impl RezaeianDerKiureghianProcess {
    fn of(parameters: &RezaeianDerKiureghian) -> RezaeianDerKiureghianProcess {
        let samples = (parameters.duration / parameters.step).round() as usize + 1;
        let modulation = Modulation::of(parameters.arias, parameters.d5_95, parameters.t_mid);
        let mut variance = vec![0.0; samples];
        for i in 0..samples {
            answer(parameters, i, samples, |k, h| variance[k] += h * h);
        }
        let factor = |(k, variance): (usize, &f64)| {
            // Nothing has answered yet at the first sample.
            if *variance > 0.0 { modulation.at(parameters.step * k as f64) / variance.sqrt() } else { 0.0 }
        };
        let factors = variance.iter().enumerate().map(factor).collect();
        RezaeianDerKiureghianProcess { parameters: *parameters, factors }
    }

    /// The shaking (m/s^2) before the high-pass, in discrete time.
    fn modulated(&self, streams: &Streams) -> Vec<f64> {
        let n = self.factors.len();
        let mut stream = streams.of(STREAM);
        let mut sum = vec![0.0; n];
        for i in 0..n {
            let pulse = standard_normal::quantile(stream.uniform());
            answer(&self.parameters, i, n, |k, h| sum[k] += pulse * h);
        }
        sum.iter().zip(&self.factors).map(|(sum, factor)| sum * factor).collect()
    }

    /// The record of a seed and an index (`Streams::new(seed, index)`), along x.
    ///
    /// ```
    /// use pirca::math::Vec3;
    /// use pirca::motion::RezaeianDerKiureghian;
    /// use pirca::random::Streams;
    /// let strong = RezaeianDerKiureghian {
    ///     arias: 1.0,
    ///     d5_95: 10.0,
    ///     t_mid: 6.0,
    ///     omega_mid: 30.0,
    ///     omega_rate: -0.5,
    ///     zeta: 0.3,
    ///     corner_hz: 0.15,
    ///     duration: 25.0,
    ///     step: 0.01,
    /// };
    /// let motion = strong.process().unwrap().record(&Streams::new(7, 3));
    /// let measures = motion.measures(&Vec3::x());
    /// assert!(measures.arias_m_per_s > 0.3 && measures.arias_m_per_s < 3.0);
    /// ```
    pub fn record(&self, streams: &Streams) -> Motion {
        let RezaeianDerKiureghian { step, corner_hz, .. } = self.parameters;
        let shaking = self.modulated(streams);
        let filtered = HighPass { omega: TAU * corner_hz, zeta: 1.0 }.applied(&shaking, step);
        let record = Accelerogram::new(step, filtered).expect("finite samples at a checked step");
        let name = format!("Rezaeian and Der Kiureghian, seed {}, record {}", streams.seed, streams.member);
        Motion::of_record(&name, record)
    }
}

/// Answer of the filter, as it is at sample `i`, to a pulse then, at each later sample: `w/sqrt(1 - zeta^2) exp(-zeta w t) sin(w
/// sqrt(1 - zeta^2) t)`. It is followed until it has died away.
fn answer(parameters: &RezaeianDerKiureghian, i: usize, samples: usize, mut add: impl FnMut(usize, f64)) {
    let (step, zeta) = (parameters.step, parameters.zeta);
    let omega = parameters.omega(step * i as f64);
    let root = (1.0 - zeta * zeta).sqrt();
    let end = samples.min(i + 1 + (-ln(LEFT) / (zeta * omega * step)).ceil() as usize);
    // One turn and decay per step.
    let decay = exp(-zeta * omega * step);
    let (c, s) = (decay * cos(omega * root * step), decay * sin(omega * root * step));
    let (mut x, mut y) = (omega / root, 0.0);
    for k in i + 1..end {
        (x, y) = (c * x - s * y, s * x + c * y);
        add(k, y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Vec3, acos};

    fn strong() -> RezaeianDerKiureghian {
        RezaeianDerKiureghian {
            arias: 1.2,
            d5_95: 12.0,
            t_mid: 7.0,
            omega_mid: 30.0,
            omega_rate: -0.6,
            zeta: 0.3,
            corner_hz: 0.1,
            duration: 30.0,
            step: 0.005,
        }
    }

    /// Mean and its standard error.
    fn mean(values: &[f64]) -> [f64; 2] {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
        [mean, (squares / (n - 1.0) / n).sqrt()]
    }

    /// Of 500 records: means of Arias intensity and rate of rising through 0 within 3.5 standard errors of what was asked for, after what
    /// the documentation says that high-pass and step take. Durations of single records scatter about that of the mean intensity, and their
    /// mean is a little shorter (noise reaches 5 % later and 95 % earlier in one record than on average): 1 % is allowed for that.
    #[test]
    fn means_over_records_are_what_was_asked_for() {
        let own = strong();
        let process = own.process().expect("good parameters");
        let (mut arias, mut duration, mut middle, mut rate) = (vec![], vec![], vec![], vec![]);
        // A window about the middle in which the frequency changes evenly.
        let window = [1000, 1800];
        for index in 0..500 {
            let motion = process.record(&Streams::new(5, index));
            let record = motion.accelerogram(&Vec3::x());
            let m = motion.measures(&Vec3::x());
            arias.push(m.arias_m_per_s);
            duration.push(m.d5_95_s.expect("it shakes"));
            let squares: Vec<f64> = record.samples().iter().map(|a| a * a).collect();
            let half = 0.45 * squares.iter().sum::<f64>();
            let reached = squares.iter().scan(0.0, |sum, a| {
                *sum += a;
                Some(*sum)
            });
            middle.push(own.step * reached.take_while(|sum| *sum < half).count() as f64);
            let pairs = record.samples()[window[0]..=window[1]].windows(2);
            let rises = pairs.filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count();
            rate.push(rises as f64 / (own.step * (window[1] - window[0]) as f64));
        }
        let [found, error] = mean(&arias);
        let taken = 3.0 * own.zeta * TAU * own.corner_hz / own.omega_mid
            + (own.omega_mid * own.step) * (own.omega_mid * own.step) / 6.0;
        eprintln!("arias {found} +- {error}, asked {} less {taken}", own.arias);
        assert!((found - own.arias * (1.0 - taken)).abs() < 3.5 * error, "{found} +- {error}");
        let [found, error] = mean(&duration);
        eprintln!("d5_95 {found} +- {error}, asked {}", own.d5_95);
        assert!((found - own.d5_95).abs() < 3.5 * error + 0.01 * own.d5_95, "{found} +- {error}");
        let [found, error] = mean(&middle);
        eprintln!("t_mid {found} +- {error}, asked {}", own.t_mid);
        assert!((found - own.t_mid).abs() < 3.5 * error + 0.01 * own.t_mid, "{found} +- {error}");
        // The window lies about the middle: its mean frequency is that of the middle. Rises of sampled noise: acos of the correlation of
        // neighbours over 2 pi steps.
        let [found, error] = mean(&rate);
        let root = (1.0 - own.zeta * own.zeta).sqrt();
        let x = own.omega_mid * own.step;
        let neighbours = exp(-own.zeta * x) * (cos(root * x) + own.zeta / root * sin(root * x));
        let expected = acos(neighbours) / (TAU * own.step);
        eprintln!(
            "rate {found} +- {error}, of sampled noise {expected}, of the filter {}",
            own.omega_mid / TAU
        );
        assert!((found - expected).abs() < 3.5 * error + 0.01 * expected, "{found} +- {error}, {expected}");
        assert!((expected / (own.omega_mid / TAU) - 1.0).abs() < 0.03);
    }

    #[test]
    fn the_share_that_the_high_pass_takes_is_the_stated_one() {
        let own = RezaeianDerKiureghian { omega_rate: 0.0, corner_hz: 0.2, ..strong() };
        let process = own.process().expect("good parameters");
        let share: Vec<f64> = (0..200)
            .map(|index| {
                let streams = Streams::new(6, index);
                let before = Accelerogram::new(own.step, process.modulated(&streams)).expect("good samples");
                let before = Motion::of_record("before", before).measures(&Vec3::x()).arias_m_per_s;
                1.0 - process.record(&streams).measures(&Vec3::x()).arias_m_per_s / before
            })
            .collect();
        let [found, error] = mean(&share);
        let expected = 3.0 * own.zeta * TAU * own.corner_hz / own.omega_mid;
        assert!((found - expected).abs() < 0.1 * expected + 3.5 * error, "{found} +- {error}, {expected}");
    }

    #[test]
    fn records_end_at_rest_and_differ_by_seed_and_index_alone() {
        let process = strong().process().expect("good parameters");
        let one = process.record(&Streams::new(3, 5));
        assert_eq!(one, process.record(&Streams::new(3, 5)));
        assert!(one != process.record(&Streams::new(3, 6)) && one != process.record(&Streams::new(4, 5)));
        let m = one.measures(&Vec3::x());
        assert!(m.end_velocity_m_per_s.abs() < 1e-2 * m.pgv_m_per_s, "{m:?}");
        assert!(m.end_displacement_m.abs() < 1e-2 * m.pgd_m, "{m:?}");
    }

    #[test]
    fn the_frequency_falls_and_is_held_above_its_floor() {
        let own = RezaeianDerKiureghian { omega_rate: -2.0, ..strong() };
        assert_eq!((own.omega(7.0), own.omega(9.0), own.omega(30.0)), (30.0, 26.0, LOWEST));
    }

    #[test]
    fn every_bad_parameter_is_named() {
        let names = |bad: RezaeianDerKiureghian| -> Vec<&str> {
            bad.process().unwrap_err().iter().map(|fault| fault.parameter).collect()
        };
        let bad = RezaeianDerKiureghian { arias: 0.0, d5_95: 40.0, zeta: 1.0, corner_hz: 0.0, ..strong() };
        assert_eq!(names(bad), ["arias (m/s)", "d5_95 (s)", "zeta", "corner_hz (Hz)"]);
        assert_eq!(names(RezaeianDerKiureghian { omega_mid: 200.0, ..strong() }), ["omega_mid (rad/s)"]);
        assert_eq!(
            names(RezaeianDerKiureghian { omega_rate: f64::NAN, ..strong() }),
            ["omega_rate (rad/s^2)"]
        );
        assert_eq!(names(RezaeianDerKiureghian { duration: 12.0, ..strong() }), ["duration (s)"]);
    }
}
