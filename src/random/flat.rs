//! Families between two bounds with a piecewise linear density.

use super::family::Distribution;

/// Constant density.
pub(super) struct Uniform {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Distribution for Uniform {
    fn quantile(&self, u: f64) -> f64 {
        // Rounding may carry the sum past the bound.
        (self.low + u * (self.high - self.low)).min(self.high)
    }
    fn density(&self, x: f64) -> Option<f64> {
        let inside = self.low <= x && x <= self.high;
        Some(if inside { 1.0 / (self.high - self.low) } else { 0.0 })
    }
    fn cdf(&self, x: f64) -> f64 {
        ((x - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }
    fn mean(&self) -> f64 {
        0.5 * (self.low + self.high)
    }
    fn sd(&self) -> f64 {
        (self.high - self.low) / 12.0_f64.sqrt()
    }
    fn support(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}

/// Density rising to the mode and falling from it. With d the width, r the rise and f the fall, the CDF is
/// t^2 / (d r) at the distance t above the lower bound and 1 - t^2 / (d f) at the distance t below the upper one.
pub(super) struct Triangular {
    pub(super) low: f64,
    pub(super) mode: f64,
    pub(super) high: f64,
}

impl Triangular {
    fn width(&self) -> f64 {
        self.high - self.low
    }
    fn rise(&self) -> f64 {
        self.mode - self.low
    }
    fn fall(&self) -> f64 {
        self.high - self.mode
    }
}

impl Distribution for Triangular {
    fn quantile(&self, u: f64) -> f64 {
        let x = if u * self.width() < self.rise() {
            self.low + (u * self.width()).sqrt() * self.rise().sqrt()
        } else {
            self.high - ((1.0 - u) * self.width()).sqrt() * self.fall().sqrt()
        };
        x.clamp(self.low, self.high)
    }
    fn density(&self, x: f64) -> Option<f64> {
        let peak = 2.0 / self.width();
        Some(if x < self.low || x > self.high {
            0.0
        } else if x < self.mode {
            peak * (x - self.low) / self.rise()
        } else if x > self.mode {
            peak * (self.high - x) / self.fall()
        } else {
            peak
        })
    }
    fn cdf(&self, x: f64) -> f64 {
        if x <= self.low {
            0.0
        } else if x >= self.high {
            1.0
        } else if x < self.mode {
            let t = x - self.low;
            t / self.width() * (t / self.rise())
        } else {
            let t = self.high - x;
            1.0 - t / self.width() * (t / self.fall())
        }
    }
    fn mean(&self) -> f64 {
        // Offsets from the lower bound keep the digits of a narrow triangle far from zero.
        self.low + (self.rise() + self.width()) / 3.0
    }
    fn sd(&self) -> f64 {
        ((self.width() * self.width() - self.rise() * self.fall()) / 18.0).sqrt()
    }
    fn support(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}
