//! What a fitted curve makes of the intensities of a campaign, for those who count what goes beyond it.

use super::campaign::Order;
use super::probit::{At, Probit};

/// The linear predictor and what follows from it, at each of the different intensities.
pub(super) struct Reached {
    pub eta: Vec<f64>,
    pub at: Vec<At>,
}

impl Reached {
    pub fn of(curve: &Probit, order: &Order) -> Reached {
        let eta: Vec<f64> =
            order.logs.iter().map(|place| curve.level + curve.slope * (place - curve.centre)).collect();
        Reached { at: eta.iter().map(|eta| At::new(*eta)).collect(), eta }
    }
}

/// Where a condition that holds below and not above changes, to rounding.
pub(super) fn bisected([mut low, mut high]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
