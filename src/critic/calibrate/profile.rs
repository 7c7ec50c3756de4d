//! The likelihood of a simulated mean and scatter under measured values, with the specimens' own scatter profiled out.

use crate::critic::compare::log_likelihood;
use crate::math::{exp, ln};
use crate::study::Measurement;

/// Least standard deviation of a specimen's angle (rad): the collapse angle is bracketed to 0.01 deg, and specimens that
/// read the same must not make the likelihood infinite.
const FLOOR: f64 = 0.01 * std::f64::consts::PI / 180.0;
/// Half-width, in its standard deviations, of the range over which an error shared by all readings is integrated.
const REACH: f64 = 5.0;
/// Places at which the scatter is tried before the best is refined, and the steps of the refinement.
const TRIED: usize = 12;
const REFINED: usize = 16;

/// What the simulation says of a family at one stiffness (SI).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Said {
    /// Mean over the walls.
    pub mean: f64,
    /// Standard deviation between the walls.
    pub sigma: f64,
    /// Standard error of the mean.
    pub error: f64,
}

/// The largest log likelihood over the specimens' extra scatter, and that scatter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profiled {
    /// The log likelihood.
    pub log_likelihood: f64,
    /// Scatter between specimens beyond that of the simulated walls, one standard deviation.
    pub extra: f64,
}

/// Profiles the extra scatter out; with `free` false it is 0, for a single specimen cannot speak of it.
pub fn profiled(readings: &[&Measurement], said: Said, free: bool) -> Profiled {
    let at = |extra: f64| Profiled { log_likelihood: log_likelihood_of(readings, said, extra), extra };
    let mut best = at(0.0);
    if !free {
        return best;
    }
    let furthest =
        readings.iter().fold(0.0_f64, |most, m| most.max((m.value - said.mean).abs() + m.resolution));
    let (low, high) = (ln(FLOOR), ln(3.0 * furthest + 2.0 * FLOOR));
    let step = (high - low) / (TRIED - 1) as f64;
    let mut centre = low;
    for k in 0..TRIED {
        let x = low + step * k as f64;
        let tried = at(exp(x));
        if tried.log_likelihood > best.log_likelihood {
            (best, centre) = (tried, x);
        }
    }
    if best.extra == 0.0 {
        return best;
    }
    // The best lies within a step of the place found; golden section.
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut a, mut b) = (centre - step, centre + step);
    for _ in 0..REFINED {
        let (left, right) = (at(exp(b - GOLDEN * (b - a))), at(exp(a + GOLDEN * (b - a))));
        if left.log_likelihood > right.log_likelihood {
            b = a + GOLDEN * (b - a);
        } else {
            a = b - GOLDEN * (b - a);
        }
        for tried in [left, right] {
            if tried.log_likelihood > best.log_likelihood {
                best = tried;
            }
        }
    }
    best
}

/// Log likelihood of all readings. What they share, the common error and the error of the simulated mean, is integrated
/// over; where the common errors of the readings differ, the two are taken as one error.
fn log_likelihood_of(readings: &[&Measurement], said: Said, extra: f64) -> f64 {
    let own = |m: &Measurement| {
        (said.sigma * said.sigma + extra * extra + m.error * m.error + FLOOR * FLOOR).sqrt()
    };
    let shared = |m: &Measurement| (m.common_error * m.common_error + said.error * said.error).sqrt();
    let all = |z: f64| -> f64 {
        let terms = readings.iter().map(|m| log_likelihood(m, said.mean + z * shared(m), own(m)));
        terms.fold(0.0, |sum, term| sum + term)
    };
    let (narrowest, widest) = readings.iter().fold((f64::INFINITY, 0.0_f64), |(narrow, wide), m| {
        (narrow.min(own(m) + 0.5 * m.resolution), wide.max(shared(m)))
    });
    if widest == 0.0 || readings.is_empty() {
        return all(0.0);
    }
    // Trapezoidal sum: exact to many digits once a step is short against the normal curve and against the readings'.
    let step = 0.5_f64.min(0.5 * narrowest / widest);
    let half = (REACH / step).ceil() as i32;
    let terms: Vec<f64> = (-half..=half)
        .map(|k| {
            let z = step * f64::from(k);
            all(z) - 0.5 * z * z
        })
        .collect();
    let largest = terms.iter().fold(f64::NEG_INFINITY, |most, term| most.max(*term));
    if largest == f64::NEG_INFINITY {
        return largest;
    }
    let weight = ln(step / (2.0 * std::f64::consts::PI).sqrt());
    largest + weight + ln(terms.iter().fold(0.0, |sum, term| sum + exp(term - largest)))
}
