//! Families whose probability sits in points.

use super::family::Distribution;

/// All probability in one point.
pub(super) struct Constant {
    pub(super) value: f64,
}

impl Distribution for Constant {
    fn quantile(&self, _: f64) -> f64 {
        self.value
    }
    fn density(&self, _: f64) -> Option<f64> {
        None
    }
    fn cdf(&self, x: f64) -> f64 {
        if x >= self.value { 1.0 } else { 0.0 }
    }
    fn mean(&self) -> f64 {
        self.value
    }
    fn sd(&self) -> f64 {
        0.0
    }
    fn support(&self) -> (f64, f64) {
        (self.value, self.value)
    }
}

/// Equal probability in every entry of a list in ascending order.
pub(super) struct Empirical<'a> {
    pub(super) values: &'a [f64],
}

impl Empirical<'_> {
    fn average(&self, of: impl Fn(f64) -> f64) -> f64 {
        self.values.iter().map(|&v| of(v)).sum::<f64>() / self.values.len() as f64
    }
}

impl Distribution for Empirical<'_> {
    fn quantile(&self, u: f64) -> f64 {
        // Entry k (from 1) is the answer for u in ((k - 1)/n, k/n].
        let n = self.values.len();
        let entry = (u * n as f64).ceil() as usize;
        self.values[entry.clamp(1, n) - 1]
    }
    fn density(&self, _: f64) -> Option<f64> {
        None
    }
    fn cdf(&self, x: f64) -> f64 {
        self.average(|v| if v <= x { 1.0 } else { 0.0 })
    }
    fn mean(&self) -> f64 {
        self.average(|v| v)
    }
    fn sd(&self) -> f64 {
        let mean = self.mean();
        self.average(|v| (v - mean) * (v - mean)).sqrt()
    }
    fn support(&self) -> (f64, f64) {
        (self.values[0], self.values[self.values.len() - 1])
    }
}
