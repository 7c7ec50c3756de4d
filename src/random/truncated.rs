//! The truncated normal and lognormal families, accurate also when the interval lies far in a tail.

use super::family::Distribution;
use super::standard_normal::{between, cdf, density, quantile};
use crate::math::{exp, ln};

/// A normal variable known to lie in [low, high].
pub(super) struct TruncatedNormal {
    mean: f64,
    sd: f64,
    low: f64,
    high: f64,
    /// The bounds in standard deviations of the parent from its mean.
    a: f64,
    b: f64,
}

impl TruncatedNormal {
    pub(super) fn new(mean: f64, sd: f64, low: f64, high: f64) -> Self {
        TruncatedNormal { mean, sd, low, high, a: (low - mean) / sd, b: (high - mean) / sd }
    }

    /// The parent's probability of the interval.
    pub(super) fn mass(&self) -> f64 {
        between(self.a, self.b)
    }

    /// Mean and standard deviation in standard deviations of the parent: the mean as an offset from `mode`, the point
    /// of the interval where the density is largest.
    ///
    /// The closed forms in phi and Phi (Johnson, Kotz and Balakrishnan 1994, 13.134 and 13.135) subtract nearly equal
    /// numbers in a tail and in a narrow interval. The same integrals taken relative to the mode lose nothing:
    /// g(t) = exp(-t (t + 2 mode) / 2) is at most 1 and is left out where it falls below exp(-50).
    fn moments(&self) -> Moments {
        let mode = 0.0_f64.clamp(self.a, self.b);
        let reach = (mode * mode + 100.0).sqrt();
        let (start, end) = (self.a.max(-reach) - mode, self.b.min(reach) - mode);
        let g = |t: f64| exp(-0.5 * t * (t + 2.0 * mode));
        let mass = integral(start, end, g);
        let offset = integral(start, end, |t| t * g(t)) / mass;
        let variance = integral(start, end, |t| (t - offset) * (t - offset) * g(t)) / mass;
        Moments { mode, offset, sd: variance.sqrt() }
    }
}

struct Moments {
    mode: f64,
    offset: f64,
    sd: f64,
}

impl Distribution for TruncatedNormal {
    /// Works on the smaller of the two tails, where the normal CDF and its inverse keep their relative accuracy.
    fn quantile(&self, u: f64) -> f64 {
        let mass = self.mass();
        let below = cdf(self.a) + u * mass;
        let z = if below < 0.5 { quantile(below) } else { -quantile(cdf(-self.b) + (1.0 - u) * mass) };
        (self.mean + self.sd * z).clamp(self.low, self.high)
    }
    fn density(&self, x: f64) -> Option<f64> {
        let inside = self.low <= x && x <= self.high;
        let z = (x - self.mean) / self.sd;
        Some(if inside { density(z) / (self.sd * self.mass()) } else { 0.0 })
    }
    fn cdf(&self, x: f64) -> f64 {
        if x <= self.low {
            0.0
        } else if x >= self.high {
            1.0
        } else {
            (between(self.a, (x - self.mean) / self.sd) / self.mass()).min(1.0)
        }
    }
    fn mean(&self) -> f64 {
        let moments = self.moments();
        self.mean + self.sd * (moments.mode + moments.offset)
    }
    fn sd(&self) -> f64 {
        self.sd * self.moments().sd
    }
    fn support(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}

/// A lognormal variable known to lie in [low, high]: its logarithm is the truncated normal variable `log`.
pub(super) struct TruncatedLognormal {
    low: f64,
    high: f64,
    log: TruncatedNormal,
}

impl TruncatedLognormal {
    pub(super) fn new(median: f64, log_sd: f64, low: f64, high: f64) -> Self {
        TruncatedLognormal { low, high, log: TruncatedNormal::new(ln(median), log_sd, ln(low), ln(high)) }
    }

    /// Mean and variance in units of the most likely value of the parent within the interval, and that value. The integrals run
    /// over standard deviations of the logarithm.
    fn moments(&self) -> (f64, f64, f64) {
        let TruncatedNormal { a, b, sd, mean, .. } = self.log;
        let mode = 0.0_f64.clamp(a, b);
        // Squares of the variable weigh what lies 2 sd further up.
        let reach = (mode * mode + 100.0).sqrt();
        let (start, end) = (a.max(-reach), b.min(reach + 2.0 * sd));
        let g = |z: f64| exp(-0.5 * (z - mode) * (z + mode));
        let x = |z: f64| exp(sd * (z - mode));
        let mass = integral(start, end, g);
        let first = integral(start, end, |z| x(z) * g(z)) / mass;
        let variance = integral(start, end, |z| (x(z) - first) * (x(z) - first) * g(z)) / mass;
        (first, variance, exp(mean + sd * mode))
    }
}

impl Distribution for TruncatedLognormal {
    fn quantile(&self, u: f64) -> f64 {
        exp(self.log.quantile(u)).clamp(self.low, self.high)
    }
    fn density(&self, x: f64) -> Option<f64> {
        if x <= 0.0 {
            return Some(0.0);
        }
        self.log.density(ln(x)).map(|of_the_log| of_the_log / x)
    }
    fn cdf(&self, x: f64) -> f64 {
        if x <= 0.0 { 0.0 } else { self.log.cdf(ln(x)) }
    }
    fn mean(&self) -> f64 {
        let (mean, _, unit) = self.moments();
        mean * unit
    }
    fn sd(&self) -> f64 {
        let (_, variance, unit) = self.moments();
        variance.sqrt() * unit
    }
    fn support(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}

/// Integral over [start, end] by ten-point Gauss-Legendre on 32 equal panels. A panel spans at most 0.7 standard
/// deviations, or 1.6 e-foldings in a tail, where the rule is exact to the last digits of double precision.
fn integral(start: f64, end: f64, of: impl Fn(f64) -> f64) -> f64 {
    const PANELS: u32 = 32;
    const NODES: [(f64, f64); 5] = [
        (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
        (0.433_395_394_129_247_2, 0.269_266_719_309_996_3),
        (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
        (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
        (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
    ];
    let half = 0.5 * (end - start) / f64::from(PANELS);
    let mut sum = 0.0;
    for panel in 0..PANELS {
        let middle = start + half * f64::from(2 * panel + 1);
        for (node, weight) in NODES {
            sum += weight * (of(middle - half * node) + of(middle + half * node));
        }
    }
    sum * half
}
