//! What estimates of a small probability cost, so that the cheapest one can be chosen before anything is evaluated.
//!
//! A value is taken to be normal, by the reliability index b of the level: the probability is cdf(-b). The effort of a method is how
//! many values a coefficient of variation of 1 takes; one of c takes so many over c squared. The normal model decides what is
//! chosen and nothing else: no estimate rests on it.

use crate::math::{exp, ln};
use crate::random::standard_normal::{cdf, density};
use crate::stats::strata;

/// Share of points that each level of subset simulation keeps.
const KEPT: f64 = 0.1;
/// By this factor the chains of a level say less than independent points (Au and Beck 2001 found factors of 3 to 5).
const CHAINS: f64 = 4.0;
/// Integrals over a standard normal run from minus to plus so much, in so many steps.
const FAR: f64 = 9.0;
const STEPS: usize = 2000;

/// Independent values that count alike: (1 - p) / p.
pub fn plain(index: f64) -> f64 {
    let p = cdf(-index);
    (1.0 - p) / p
}

/// Subset simulation: with n points a level, each of the L levels adds a squared coefficient of variation of
/// (1 - 0.1) / 0.1 times 4 over n, and evaluates nine tenths of n points anew (Au and Beck 2001, eq. 29, 32).
pub fn subset(index: f64) -> f64 {
    (1.0 - KEPT) / KEPT * CHAINS * levels(index) * subset_run(index)
}

/// Values that a run of subset simulation takes for each point of a level.
pub fn subset_run(index: f64) -> f64 {
    1.0 + (1.0 - KEPT) * (levels(index) - 1.0)
}

fn levels(index: f64) -> f64 {
    (ln(cdf(-index)) / ln(KEPT)).max(1.0)
}

/// Values that are sorted by a cheaper one which costs the share `cost` of them and has the correlation `rho` with them: all of a
/// sample have the cheaper value, and of those with a chance g to lie on the worse side a share in proportion to sqrt(g (1 - g))
/// has the dear one (Neyman 1938). The two variances are var g and (mean of sqrt(g (1 - g)))^2 over the two sizes, and the sizes that
/// go with the least cost make the effort (sqrt(second) + sqrt(cost first))^2.
pub fn stratified(index: f64, rho: f64, cost: f64) -> f64 {
    let (p, [first, second]) = (cdf(-index), variances(index, rho));
    let root = second.sqrt() + (cost * first).sqrt();
    root * root / (p * p)
}

/// How many cheaper values go with a dear one at the least cost, see [`stratified`].
pub fn cheap_per_dear(index: f64, rho: f64, cost: f64) -> f64 {
    let [first, second] = variances(index, rho);
    (first / (cost * second)).sqrt()
}

/// The same where subset simulation by the cheaper value goes down to an event first, which holds those with a value at the level
/// but for some 4 standard deviations of what the cheaper value leaves open.
pub fn stratified_subset(index: f64, rho: f64, cost: f64) -> f64 {
    let (p, [_, second]) = (cdf(-index), variances(index, rho));
    let edge = rho * index - strata::FAR * (1.0 - rho * rho).sqrt();
    let root = second.sqrt() / p + (cost * subset(edge)).sqrt();
    root * root
}

/// What a cheaper value says of the chance g at x of it, and what it leaves open: variance of g, and (mean of sqrt(g (1 - g)))^2.
fn variances(index: f64, rho: f64) -> [f64; 2] {
    let left = (1.0 - rho * rho).max(1e-12).sqrt();
    let chance = |x: f64| cdf((-index - rho * x) / left);
    let square = over_normal(&|x| chance(x) * chance(x));
    let open = over_normal(&|x| (chance(x) * (1.0 - chance(x))).sqrt());
    let p = cdf(-index);
    [(square - p * p).max(0.0), open * open]
}

/// Importance sampling with normal quantities shifted in the direction in which they lower the value, where they make the share
/// `explained` of its variance and the rest is left as it is: the least over all shifts of
/// exp(s^2) cdf(-(b + r s)) / p^2 - 1 with r^2 the share explained, and the shift s where it is.
pub fn importance(index: f64, explained: f64) -> (f64, f64) {
    let (p, r) = (cdf(-index), explained.clamp(0.0, 1.0).sqrt());
    let effort = |shift: f64| exp(shift * shift) * cdf(-(index + r * shift)) / (p * p) - 1.0;
    let shifts = (0..=120).map(|k| f64::from(k) * 0.05);
    shifts
        .map(|shift| (effort(shift), shift))
        .fold((f64::INFINITY, 0.0), |best, one| if one.0 < best.0 { one } else { best })
}

/// The mean of a function of a standard normal, by the trapezoidal rule.
fn over_normal(of: &dyn Fn(f64) -> f64) -> f64 {
    let step = 2.0 * FAR / STEPS as f64;
    let at = |k: usize| -FAR + step * k as f64;
    (0..=STEPS).map(|k| density(at(k)) * of(at(k))).sum::<f64>() * step
}
