//! Where most of some simulated numbers lie.

use crate::stats;

/// Median, and the bands that hold half and nine in ten of some numbers, from quantile to quantile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Median.
    pub median: f64,
    /// 25 and 75 % quantile.
    pub half: [f64; 2],
    /// 5 and 95 % quantile.
    pub most: [f64; 2],
}

impl Band {
    /// Of a sample; `None` of an empty one.
    pub fn of(values: &[f64]) -> Option<Band> {
        let at = |p: f64| stats::quantile(values, p);
        Some(Band { median: at(0.5)?, half: [at(0.25)?, at(0.75)?], most: [at(0.05)?, at(0.95)?] })
    }

    /// With every number changed by a function that keeps their order.
    pub fn map(&self, of: impl Fn(f64) -> f64) -> Band {
        Band { median: of(self.median), half: self.half.map(&of), most: self.most.map(&of) }
    }
}
