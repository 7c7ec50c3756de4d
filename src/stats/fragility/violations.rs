//! The share of the variance that is the single trial's, from walls that stand above an intensity at which they collapse.

use super::campaign::{Campaign, Order};
use super::reached::{Reached, bisected};
use crate::math::{cos, exp, sin};
use crate::random::standard_normal::quantile;
use crate::stats::Estimate;
use crate::stats::reference::TAIL;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Pairs of trials of the same record and wall in which the lower intensity topples and the higher one does not.
pub(super) struct Violations {
    /// How many there are.
    pub seen: f64,
    /// How many are expected as the correlation falls from 1: the integral of `rates` over the angle from 0, whose cosine it is, at equal
    /// steps and half steps.
    rates: Vec<f64>,
}

/// Steps of the angle from 0 to pi.
const STEPS: usize = 64;

impl Violations {
    pub fn of(campaign: &Campaign, order: &Order, reached: &Reached, weights: &[f64]) -> Violations {
        let (stripes, walls) = (campaign.stripes(), campaign.walls());
        let mut seen = 0.0;
        // The weight of all pairs of trials at two different intensities.
        let places = order.logs.len();
        let mut weight_of = BTreeMap::<usize, f64>::new();
        for record in 0..campaign.records() {
            let weights = &weights[record * walls..][..walls];
            for a in record * stripes..(record + 1) * stripes {
                for b in record * stripes..(record + 1) * stripes {
                    let (low, high) = (order.places[a], order.places[b]);
                    if low >= high {
                        continue;
                    }
                    let [lower, higher] = [a, b].map(|cell| &campaign.outcomes()[cell * walls..][..walls]);
                    let mut compared = 0.0;
                    for (weight, (lower, higher)) in weights.iter().zip(lower.iter().zip(higher)) {
                        if let Some((lower, higher)) = lower.zip(*higher) {
                            seen += weight * lower.collapses() * (1.0 - higher.collapses());
                            compared += weight;
                        }
                    }
                    *weight_of.entry(low * places + high).or_default() += compared;
                }
            }
        }
        let rate = |angle: f64| -> f64 {
            let (sine, cosine) = (sin(angle), cos(angle));
            let own = |(key, weight): (&usize, &f64)| {
                let (h, k) = (reached.eta[key / places], reached.eta[key % places]);
                let squares = (h - k) * (h - k) + 2.0 * h * k * (1.0 - cosine);
                weight * exp(-0.5 * squares / (sine * sine)) / (2.0 * PI)
            };
            weight_of.iter().map(own).sum()
        };
        // At either end the density of two different values that are the same, or opposite, is 0.
        let inner = (1..2 * STEPS).map(|half| rate(half as f64 * PI / (2 * STEPS) as f64));
        Violations { seen, rates: std::iter::once(0.0).chain(inner).chain([0.0]).collect() }
    }

    /// One less the correlation at which so many are expected; `None` where there are no two trials to compare.
    pub fn rest(&self, count: f64) -> Option<f64> {
        let step = PI / STEPS as f64;
        let mut below = 0.0;
        for (first, rates) in self.rates.windows(3).step_by(2).enumerate() {
            let [a, b, c] = [rates[0], rates[1], rates[2]];
            let own = step * (a + 4.0 * b + c) / 6.0;
            if count <= below + own && own > 0.0 {
                // The integral of the parabola through the three.
                let part = |t: f64| {
                    step * t * (a + t * (0.5 * (4.0 * b - 3.0 * a - c) + t * 2.0 / 3.0 * (a - 2.0 * b + c)))
                };
                let t = bisected([0.0, 1.0], |t| below + part(t) < count);
                return Some(if count <= 0.0 { 0.0 } else { 1.0 - cos((first as f64 + t) * step) });
            }
            below += own;
        }
        (below > 0.0).then_some(2.0)
    }
}

/// The rest with the interval that follows from that of the number of violations.
pub(super) fn by_violations(campaign: &Campaign, order: &Order, reached: &Reached) -> Option<Estimate> {
    let crossed = campaign.crossed();
    let pairs = crossed.pairs() as f64;
    let violations = Violations::of(campaign, order, reached, &vec![1.0; crossed.pairs()]);
    let [rate] = crossed.estimates(|weights| {
        let all: f64 = weights.iter().sum();
        (all > 0.0).then(|| [Violations::of(campaign, order, reached, weights).seen / all])
    });
    let (rate, [low, high]) = rate.value.zip(rate.interval)?;
    let z = quantile(1.0 - TAIL);
    let half = 0.5 * (high - low) / z;
    let worth = if half > 0.0 { (rate / (half * half)).min(pairs) } else { pairs };
    let middle = rate + z * z / (2.0 * worth);
    let half = z * (rate / worth + z * z / (4.0 * worth * worth)).sqrt();
    let [value, low, high] = [rate, middle - half, middle + half].map(|own| violations.rest(own * pairs));
    Some(Estimate { value: Some(value?), interval: Some([low?, high?]) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::fragility::Outcome;
    use crate::stats::fragility::probit::At;

    /// By Sheppard's formula: at two medians P(both below) = 1/4 + asin(rho) / 2 pi, so that one falls and not the other with acos(rho) / 2 pi.
    #[test]
    fn the_rate_of_violations_is_that_of_a_bivariate_normal() {
        let violations = |h: f64, k: f64| {
            let reached = Reached { eta: vec![h, k], at: vec![At::new(h), At::new(k)] };
            let campaign = Campaign::of_stripes(
                &[1.0, 2.0],
                1,
                1,
                vec![Some(Outcome::Collapsed), Some(Outcome::Stands)],
            );
            Violations::of(&campaign, &campaign.order(), &reached, &[1.0])
        };
        // Thresholds that hardly differ: the rate is nearly even.
        let even = violations(-1e-9, 1e-9);
        for rho in [0.9_f64, 0.5, 0.0, -0.5] {
            let count = crate::math::acos(rho) / (2.0 * PI);
            // The steps miss the end that is 0 for different thresholds: a sixth of a step.
            assert!((even.rest(count).unwrap() - (1.0 - rho)).abs() < 0.02, "{rho}");
        }
        // Independent: Phi(h) (1 - Phi(k)) at a correlation of 0.
        let apart = violations(-0.3, 0.6);
        let count = crate::random::standard_normal::cdf(-0.3) * crate::random::standard_normal::cdf(-0.6);
        assert!((apart.rest(count).unwrap() - 1.0).abs() < 1e-5, "{:?}", apart.rest(count));
        assert_eq!(apart.rest(0.0), Some(0.0));
    }
}
