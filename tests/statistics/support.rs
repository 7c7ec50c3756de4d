//! What several of the tests need.

use pirca::random::{Family, Streams};

/// Panics unless `found` is within `relative` of `expected`.
pub fn close(found: f64, expected: f64, relative: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= relative * expected.abs(), "{what}: {found} instead of {expected}, off by {error:e}");
}

/// A sample of a family from its own stream.
pub fn sample(family: &Family, n: usize, member: u64, name: &str) -> Vec<f64> {
    let mut stream = Streams::new(2026, member).of(name);
    (0..n).map(|_| family.sample(&mut stream)).collect()
}

/// Share of `repeats` for which `holds` is true, given the number of the repeat.
pub fn share(repeats: u64, holds: impl Fn(u64) -> bool) -> f64 {
    (0..repeats).filter(|&k| holds(k)).count() as f64 / repeats as f64
}

/// Panics unless an observed share of `repeats` is within four standard errors of `nominal`, or within `bias` more
/// where the interval is only approximate.
pub fn near_share(found: f64, nominal: f64, repeats: u64, bias: f64, what: &str) {
    let error = (nominal * (1.0 - nominal) / repeats as f64).sqrt();
    assert!((found - nominal).abs() <= 4.0 * error + bias, "{what}: {found} instead of {nominal}");
}

/// Integral by Simpson's rule on `panels` double panels.
pub fn simpson(low: f64, high: f64, panels: u32, of: impl Fn(f64) -> f64) -> f64 {
    let h = (high - low) / f64::from(2 * panels);
    let at = |k: u32| of(low + h * f64::from(k));
    let inner: f64 = (1..2 * panels).map(|k| if k % 2 == 1 { 4.0 * at(k) } else { 2.0 * at(k) }).sum();
    (at(0) + inner + at(2 * panels)) * h / 3.0
}
