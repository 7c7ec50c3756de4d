//! Two-phase stratified sampling (Neyman 1938): a cheap value sorts all points of a sample into strata, and of each stratum some points
//! are evaluated. The share of each stratum on the worse side counts by the stratum's share of all points, so that the estimate is
//! unbiased whatever the strata are; only its error depends on them.

use crate::random::standard_normal::cdf;

/// So many standard deviations above the level, values are expected far beyond it.
pub const FAR: f64 = 4.0;
/// Edges of strata: how many standard deviations the value that is expected lies above the level.
const EDGES: [f64; 6] = [-2.0, -1.0, 0.0, 1.0, 2.0, FAR];
/// A point in the middle of each stratum.
const MIDDLES: [f64; 7] = [-2.5, -1.5, -0.5, 0.5, 1.5, 2.5, 5.0];
/// How many strata there are; the last one holds what is expected far beyond the level.
pub const STRATA: usize = MIDDLES.len();
/// A share of what is evaluated looks for what nobody expects, in the last stratum.
const FAR_SHARE: f64 = 0.1;

/// The stratum of a point by how many standard deviations its expected value lies above the level.
pub fn stratum(above: f64) -> usize {
    EDGES.iter().filter(|edge| above > **edge).count()
}

/// How many points of each stratum are evaluated, of so many in all: in proportion to its size and to the standard deviation of being
/// on the worse side, at least two where there are two, and never more than there are.
pub fn allocated(sizes: &[usize; STRATA], all: usize) -> [usize; STRATA] {
    let far = STRATA - 1;
    let near = if sizes[far] == 0 { all as f64 } else { all as f64 * (1.0 - FAR_SHARE) };
    let chance = |at: usize| cdf(-MIDDLES[at]);
    let wanted = |at: usize| sizes[at] as f64 * (chance(at) * (1.0 - chance(at))).sqrt();
    let sum: f64 = (0..far).map(wanted).sum();
    let mut taken = [0; STRATA];
    for (at, taken) in taken.iter_mut().enumerate() {
        let share =
            if at == far { all as f64 * FAR_SHARE } else { near * wanted(at) / sum.max(f64::MIN_POSITIVE) };
        *taken = (share.round() as usize).max(2).min(sizes[at]);
    }
    taken
}

/// Which of a stratum's points are evaluated: so many, evenly over their order from a random start in (0, 1), so that each is taken
/// with the same probability (systematic sampling).
pub fn chosen(stratum: &[usize], count: usize, start: f64) -> Vec<usize> {
    let at = |k: usize| ((k as f64 + start) * stratum.len() as f64 / count as f64) as usize;
    (0..count).map(|k| stratum[at(k).min(stratum.len() - 1)]).collect()
}

/// What an evaluated point of a stratum counts: the stratum's share of all points over how many of it are evaluated.
pub fn counts(sizes: &[usize; STRATA], taken: &[usize; STRATA], stratum: usize) -> f64 {
    let all: usize = sizes.iter().sum();
    sizes[stratum] as f64 / all as f64 / taken[stratum] as f64
}
