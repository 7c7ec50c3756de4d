//! Intensity measures of one component of a ground motion.

use std::f64::consts::PI;

use crate::math::STANDARD_GRAVITY;
use crate::motion::Accelerogram;
use crate::motion::fourier::transform;

/// Longest interval of frequency (Hz) between two lines of the spectrum for the mean period (Rathje et al. 2004).
const FREQUENCY_INTERVAL: f64 = 0.05;
/// Frequencies (Hz) that the mean period counts (Rathje et al. 1998).
const FREQUENCIES: [f64; 2] = [0.25, 20.0];
/// Halvings that find a time inside a step to rounding.
const HALVINGS: usize = 60;

/// Intensity measures of a component, from the first sample to the last one. The acceleration is linear between samples, and every
/// integral and peak but the mean period is exact for that.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Measures {
    /// Time between two samples (s).
    pub step_s: f64,
    /// Time from the first sample to the last one (s).
    pub duration_s: f64,
    /// Peak ground acceleration: largest size of the acceleration (m/s^2).
    pub pga_m_per_s2: f64,
    /// Peak ground velocity: largest size of the velocity of the base (m/s).
    pub pgv_m_per_s: f64,
    /// Peak ground displacement: largest size of the displacement of the base (m). Of a record that was not corrected this is mostly drift.
    pub pgd_m: f64,
    /// Arias intensity `pi/(2 g)` times the integral of `a^2` (m/s; Arias 1970), with standard gravity.
    pub arias_m_per_s: f64,
    /// Time in which the Arias intensity grows from 5 to 95 % (s; Trifunac and Brady 1975); `None` of no acceleration.
    pub d5_95_s: Option<f64>,
    /// Cumulative absolute velocity: integral of `|a|` (m/s; EPRI 1988), without a threshold.
    pub cav_m_per_s: f64,
    /// Mean period (s): `sum C^2/f` over `sum C^2` with the Fourier amplitudes `C` at 0.25 to 20 Hz, lines at most 0.05 Hz apart (Rathje,
    /// Abrahamson and Bray 1998). `None` where nothing lies in that band.
    pub mean_period_s: Option<f64>,
    /// Mean of the acceleration (m/s^2): 0 where the base ends at rest.
    pub mean_acceleration_m_per_s2: f64,
    /// Velocity (m/s) of the base at the last sample: 0 of a zero line that is right.
    pub end_velocity_m_per_s: f64,
    /// Displacement (m) of the base at the last sample.
    pub end_displacement_m: f64,
}

impl Measures {
    /// Of a component.
    pub fn of(record: &Accelerogram) -> Measures {
        let last = record.samples().len() - 1;
        let integrals = Integrals::of(record);
        let end_velocity = record.velocities()[last];
        Measures {
            step_s: record.step(),
            duration_s: record.duration(),
            pga_m_per_s2: largest(record.samples()),
            pgv_m_per_s: integrals.pgv.max(largest(record.velocities())),
            pgd_m: integrals.pgd.max(largest(record.displacements())),
            arias_m_per_s: PI / (2.0 * STANDARD_GRAVITY) * integrals.husid[last],
            d5_95_s: significant_duration(record, &integrals.husid),
            cav_m_per_s: integrals.cav,
            mean_period_s: mean_period(record),
            mean_acceleration_m_per_s2: end_velocity / record.duration(),
            end_velocity_m_per_s: end_velocity,
            end_displacement_m: record.displacements()[last],
        }
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest: f64, v| largest.max(v.abs()))
}

/// What is summed over the steps.
struct Integrals {
    /// Integral of the squared acceleration up to each sample (m^2/s^3): Husid's curve.
    husid: Vec<f64>,
    /// Integral of the size of the acceleration (m/s).
    cav: f64,
    /// Largest velocity and displacement inside steps.
    pgv: f64,
    pgd: f64,
}

impl Integrals {
    fn of(record: &Accelerogram) -> Integrals {
        let h = record.step();
        let mut sums = Integrals { husid: vec![0.0], cav: 0.0, pgv: 0.0, pgd: 0.0 };
        let mut squares = 0.0;
        for (i, pair) in record.samples().windows(2).enumerate() {
            let (a, b) = (pair[0], pair[1]);
            squares += h * (a * a + a * b + b * b) / 3.0;
            sums.husid.push(squares);
            let crosses = (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0);
            sums.cav += if crosses {
                // Two triangles.
                0.5 * h * (a * a + b * b) / (a.abs() + b.abs())
            } else {
                0.5 * h * (a + b).abs()
            };
            if crosses {
                sums.pgv = sums.pgv.max(record.inside(i, h * a / (a - b)).velocity.abs());
            }
            for s in times_at_rest(record.velocities()[i], a, (b - a) / h, h) {
                sums.pgd = sums.pgd.max(record.inside(i, s).displacement.abs());
            }
        }
        sums
    }
}

/// Times inside a step of length `h` at which the velocity `v + a s + jerk s^2/2` is 0.
fn times_at_rest(v: f64, a: f64, jerk: f64, h: f64) -> impl Iterator<Item = f64> {
    let discriminant = a * a - 2.0 * jerk * v;
    let root = discriminant.max(0.0).sqrt();
    // The larger of both sums in size, so that neither root loses digits.
    let q = -(a + if a < 0.0 { -root } else { root });
    let times = if discriminant < 0.0 { [f64::NAN; 2] } else { [q / jerk, 2.0 * v / q] };
    times.into_iter().filter(move |s| *s > 0.0 && *s < h)
}

/// Time between 5 and 95 % of Husid's curve.
fn significant_duration(record: &Accelerogram, husid: &[f64]) -> Option<f64> {
    let total = *husid.last()?;
    let time_of = |share: f64| {
        let target = share * total;
        let i = husid.partition_point(|sum| *sum < target).clamp(1, husid.len() - 1) - 1;
        let (mut low, mut high) = (0.0, record.step());
        let a = record.samples()[i];
        for _ in 0..HALVINGS {
            let s = 0.5 * (low + high);
            let b = record.inside(i, s).acceleration;
            if husid[i] + s * (a * a + a * b + b * b) / 3.0 < target { low = s } else { high = s }
        }
        record.step() * i as f64 + low
    };
    (total > 0.0).then(|| time_of(0.95) - time_of(0.05))
}

/// Mean period of Rathje et al.: the record is followed by zeros up to a power of two of samples that brings the lines close enough.
fn mean_period(record: &Accelerogram) -> Option<f64> {
    let least = (1.0 / (FREQUENCY_INTERVAL * record.step())).ceil() as usize;
    let n = record.samples().len().max(least).next_power_of_two();
    let mut re = record.samples().to_vec();
    re.resize(n, 0.0);
    let mut im = vec![0.0; n];
    transform(&mut re, &mut im);
    let interval = 1.0 / (n as f64 * record.step());
    let (mut weighted, mut sum) = (0.0, 0.0);
    for k in 1..=n / 2 {
        let f = interval * k as f64;
        if (FREQUENCIES[0]..=FREQUENCIES[1]).contains(&f) {
            let square = re[k] * re[k] + im[k] * im[k];
            weighted += square / f;
            sum += square;
        }
    }
    (sum > 0.0).then(|| weighted / sum)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{E, TAU};

    use super::*;
    use crate::math::{Vec3, cbrt, sin};
    use crate::motion::{Motion, Pulse};

    fn of(step: f64, samples: &[f64]) -> Measures {
        Measures::of(&Accelerogram::new(step, samples.to_vec()).expect("good samples"))
    }

    /// Three steps of 1 s, all by hand: 0, 2, -1, -1.
    #[test]
    fn a_short_record_has_the_measures_of_paper_and_pencil() {
        let m = of(1.0, &[0.0, 2.0, -1.0, -1.0]);
        assert_eq!((m.pga_m_per_s2, m.duration_s, m.step_s), (2.0, 3.0, 1.0));
        // v: 0, 1, 1.5, 0.5; between, where a = 0 at 2/3 of the second step, 1 + (2/3)(2)/2.
        assert!((m.pgv_m_per_s - 5.0 / 3.0).abs() < 1e-15);
        // d: 0, 1/3, 1/3 + 1 + (4 - 1)/6, + 1.5 - 1/2, never turning back.
        assert!((m.pgd_m - (1.0 / 3.0 + 1.5 + 1.0)).abs() < 1e-14);
        // Integral of a^2: 4/3, (4 - 2 + 1)/3, 1.
        assert!((m.arias_m_per_s - PI / (2.0 * 9.80665) * (4.0 / 3.0 + 2.0)).abs() < 1e-15);
        // Triangles: 1, 2/3 + 1/6, 1.
        assert!((m.cav_m_per_s - (1.0 + 5.0 / 6.0 + 1.0)).abs() < 1e-15);
        assert!((m.end_velocity_m_per_s - 0.5).abs() < 1e-15);
        assert!((m.mean_acceleration_m_per_s2 - 0.5 / 3.0).abs() < 1e-15);
        assert!((m.end_displacement_m - m.pgd_m).abs() < 1e-14);
    }

    #[test]
    fn the_largest_displacement_is_found_inside_a_step() {
        let m = of(2.0, &[0.5, 0.0, -1.0]);
        // First step: v = 0.5, d = 2/3. Second: v = 0.5 - s^2/4, at rest at sqrt 2; d grows by sqrt 2 (1/2 - 1/6).
        assert!((m.pgd_m - (2.0 / 3.0 + 2.0_f64.sqrt() / 3.0)).abs() < 1e-14, "{}", m.pgd_m);
        assert_eq!(m.pgv_m_per_s, 0.5);
    }

    #[test]
    fn constant_and_linear_accelerations_have_closed_durations() {
        let constant = of(0.25, &[3.0; 41]);
        // The same energy everywhere: nine tenths of 10 s.
        assert!((constant.d5_95_s.expect("it shakes") - 9.0).abs() < 1e-12);
        let ramp: Vec<f64> = (0..=10).map(f64::from).collect();
        // The energy goes with the cube of the time.
        let expected = 10.0 * (cbrt(0.95) - cbrt(0.05));
        assert!((of(1.0, &ramp).d5_95_s.expect("it shakes") - expected).abs() < 1e-12);
    }

    /// Chords of 1/1000 of a period lie (2 pi/1000)^2/12 = 3e-6 inside a sine.
    #[test]
    fn a_sine_pulse_has_its_closed_forms() {
        let (a, f) = (3.0, 2.0);
        let pulse = Pulse::Sine { amplitude: a, frequency: f, cycles: 4 };
        let m = Motion::of_pulse(pulse).expect("good parameters").measures(&Vec3::x());
        let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-5;
        assert!(near(m.pga_m_per_s2, a) && near(m.pgv_m_per_s, a / (PI * f)), "{m:?}");
        assert!(near(m.pgd_m, 4.0 * a / (TAU * f * f)) && near(m.end_displacement_m, m.pgd_m), "{m:?}");
        assert!(near(m.arias_m_per_s, PI / (2.0 * 9.80665) * 0.5 * a * a * 2.0), "{m:?}");
        assert!(near(m.cav_m_per_s, 2.0 / PI * a * 2.0), "{m:?}");
        assert!(m.end_velocity_m_per_s.abs() < 1e-12 && m.mean_acceleration_m_per_s2.abs() < 1e-12);
    }

    #[test]
    fn the_mean_period_of_long_harmonics_is_that_of_their_squared_amplitudes() {
        // 1 Hz with amplitude 2, and 4 Hz with amplitude 1, of which 0.1 Hz counts neither: (4/1 + 1/4)/5. Lines of 80 s are 1/80 Hz wide.
        let wave = |t: f64| 2.0 * sin(TAU * t) + sin(TAU * 4.0 * t) + 5.0 * sin(TAU * 0.1 * t);
        let samples: Vec<f64> = (0..8000).map(|k| wave(0.01 * f64::from(k))).collect();
        let period = of(0.01, &samples).mean_period_s.expect("it shakes");
        // What leaks out of lines that do not lie at the frequencies: a share of the order of 1/80.
        assert!((period - 0.85).abs() < 0.01, "{period}");
    }

    /// The squared spectrum of a Ricker wavelet goes with `f^4 exp(-2 f^2/f0^2)`, so that the mean period is the integral of `f^3 exp(-2
    /// f^2/f0^2)`, which is `f0^4/8`, over that of `f^4 exp(-2 f^2/f0^2)`, which is `3 sqrt(pi) f0^5/(8 sqrt(32))`.
    #[test]
    fn the_mean_period_of_a_ricker_wavelet_is_the_closed_form() {
        let f0 = 3.0;
        let pulse = Pulse::Ricker { amplitude: 1.0, frequency: f0 };
        let m = Motion::of_pulse(pulse).expect("good parameters").measures(&Vec3::x());
        let expected = 32.0_f64.sqrt() / (3.0 * PI.sqrt() * f0);
        // What lies below 0.25 and above 20 Hz is 1e-5 of it.
        assert!((m.mean_period_s.expect("it shakes") / expected - 1.0).abs() < 1e-4, "{m:?}, {expected}");
        assert!((m.pgv_m_per_s - 1.0 / (PI * f0 * (2.0 * E).sqrt())).abs() < 1e-6);
        assert!(m.end_displacement_m.abs() < 1e-9);
    }

    #[test]
    fn no_acceleration_has_no_duration_and_no_period() {
        let m = of(0.01, &[0.0; 100]);
        assert_eq!((m.d5_95_s, m.mean_period_s, m.arias_m_per_s), (None, None, 0.0));
        let said = serde_json::to_string(&m).expect("numbers");
        assert!(said.contains("\"pga_m_per_s2\":0.0") && said.contains("\"d5_95_s\":null"), "{said}");
    }
}
