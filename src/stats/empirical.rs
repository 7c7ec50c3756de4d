//! The empirical distribution of a capacity, P(collapse | load), with pointwise and simultaneous bands.

use super::moments::check_values;
use super::order::Sorted;
use super::reference::TAIL;
use super::very_many::{self, VERY_MANY};
use crate::math::ln;
use statrs::distribution::{Beta, ContinuousCDF};

/// Most steps of an empirical distribution: what a figure or a reader can tell apart. Its bands alone would take hours at millions of steps.
const MOST_STEPS: usize = 10_000;

/// One step of an empirical distribution: at this value the probability jumps to what is stated.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct EmpiricalStep {
    /// The value (a capacity, in the sample's unit).
    pub value: f64,
    /// Number of values up to and including this one.
    pub count: u64,
    /// Share of the sample up to and including this one.
    pub probability: f64,
    /// Its 95 % interval by Clopper and Pearson (1934): holds at this value alone.
    pub pointwise: [f64; 2],
    /// The 95 % band of Dvoretzky, Kiefer and Wolfowitz (1956) with Massart's constant (1990): holds everywhere at once.
    pub simultaneous: [f64; 2],
}

/// The empirical distribution of a sample, one step per different value, ascending; empty for an empty sample.
///
/// `censored` gives for each member that was still standing how far it was loaded (its capacity lies above). The steps end
/// at the lowest of these: up to there every member counts, beyond it nothing is known of some.
///
/// Of more than 10,000 steps so many are kept, evenly by number and with the first and the last. What is said at each of them
/// is that of the whole sample; between two of them the distribution rises by what lies between their probabilities.
pub fn empirical(values: &[f64], censored: &[f64]) -> Vec<EmpiricalStep> {
    empirical_of(&Sorted::of(values.to_vec()), censored)
}

/// The same of a sample in ascending order.
pub fn empirical_of(sorted: &Sorted, censored: &[f64]) -> Vec<EmpiricalStep> {
    check_values(censored);
    let n = sorted.values().len() + censored.len();
    let end = censored.iter().fold(f64::INFINITY, |low, c| low.min(*c));
    let known = &sorted.values()[..sorted.values().partition_point(|value| *value <= end)];
    let half = if n > 0 { dkw_half_width(n) } else { 0.0 };
    // How many values lie up to each different one, itself included.
    let counts = || (1..=known.len()).filter(|count| known.get(*count) != Some(&known[count - 1]));
    let steps = counts().count();
    let is_kept = |step: usize| steps <= MOST_STEPS || is_spread(step, steps);
    let kept = counts().enumerate().filter(|(step, _)| is_kept(*step));
    kept.map(|(_, count)| {
        let probability = count as f64 / n as f64;
        EmpiricalStep {
            value: known[count - 1],
            count: count as u64,
            probability,
            pointwise: clopper_pearson(count, n),
            simultaneous: [(probability - half).max(0.0), (probability + half).min(1.0)],
        }
    })
    .collect()
}

/// Whether a step is one of [`MOST_STEPS`] that are spread evenly over more, the first and the last among them.
fn is_spread(step: usize, steps: usize) -> bool {
    let place = |step: usize| step * (MOST_STEPS - 1) / (steps - 1);
    step == 0 || place(step) > place(step - 1)
}

/// 95 % interval of a probability from `k` hits in `n` trials (Clopper and Pearson 1934): exact, coverage at least 95 %. As hits are
/// whole it is more: from 1 to 99 % at least 97.6 % with three and five trials, 96.2 with ten, 95.4 with thirty.
pub fn clopper_pearson(k: usize, n: usize) -> [f64; 2] {
    clopper_pearson_at(k, n, 1.0 - 2.0 * TAIL)
}

/// The same at another confidence level, between 0 and 1.
pub fn clopper_pearson_at(k: usize, n: usize, level: f64) -> [f64; 2] {
    let tail = 0.5 * (1.0 - level);
    crate::check!(k <= n && n > 0, "{k} hits in {n} trials");
    let quantile = |a: usize, b: usize, p: f64| {
        if n as f64 > VERY_MANY {
            return very_many::beta(a as f64, b as f64, p);
        }
        let beta = Beta::new(a as f64, b as f64);
        crate::check!(beta.is_ok(), "there is no beta distribution of {a} and {b}");
        beta.map_or(f64::NAN, |beta| beta.inverse_cdf(p))
    };
    let low = if k == 0 { 0.0 } else { quantile(k, n - k + 1, tail) };
    let high = if k == n { 1.0 } else { quantile(k + 1, n - k, 1.0 - tail) };
    [low, high]
}

/// Half width of the simultaneous 95 % band around the empirical distribution of `n` values: sqrt(ln(2/0.05) / (2 n))
/// (Massart 1990).
pub fn dkw_half_width(n: usize) -> f64 {
    (ln(1.0 / TAIL) / (2.0 * n as f64)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::pow;
    use crate::random::{Family, Streams};

    #[test]
    fn clopper_and_pearson_have_their_closed_forms_and_known_values() {
        // No hit, and all: 1 - (alpha/2)^(1/n), and its mirror image.
        for n in [1, 5, 10, 30, 300] {
            let edge = 1.0 - pow(0.025, 1.0 / n as f64);
            let [low, high] = clopper_pearson(0, n);
            // The quantile is found by iteration, to some 1e-10.
            assert!(low == 0.0 && (high - edge).abs() < 1e-8, "{n}: {high} against {edge}");
            let [low, high] = clopper_pearson(n, n);
            assert!(high == 1.0 && (low - (1.0 - edge)).abs() < 1e-8);
        }
        // R: binom.test(7, 20), binom.test(5, 10), printed to seven digits.
        for (k, n, known) in [(7, 20, [0.153_909_2, 0.592_188_5]), (5, 10, [0.187_086_0, 0.812_914_0])] {
            let found = clopper_pearson(k, n);
            assert!((found[0] - known[0]).abs() < 1e-7 && (found[1] - known[1]).abs() < 1e-7, "{found:?}");
        }
    }

    #[test]
    fn the_simultaneous_band_covers_the_whole_distribution_in_95_of_100_samples() {
        let uniform = Family::Uniform { low: 0.0, high: 1.0 };
        let mut stream = Streams::new(7, 0).of("coverage of the band");
        let (samples, n) = (2000, 20);
        let mut covered = 0;
        for _ in 0..samples {
            let values: Vec<f64> = (0..n).map(|_| uniform.sample(&mut stream)).collect();
            let half = dkw_half_width(n);
            let mut sorted = values;
            sorted.sort_by(f64::total_cmp);
            covered += usize::from(crate::stats::ks_statistic(&sorted, |x| x) <= half);
        }
        // The band is conservative for small n; 0.95 less three standard errors of 2000 samples.
        assert!(covered as f64 / samples as f64 > 0.95 - 0.015, "{covered} of {samples}");
        assert!((dkw_half_width(100) - 0.135_810).abs() < 1e-6);
    }

    #[test]
    fn ties_are_one_step_and_members_that_stand_count_below_their_end() {
        let steps = empirical(&[3.0, 1.0, 3.0, 2.0], &[]);
        let seen: Vec<(f64, u64, f64)> = steps.iter().map(|s| (s.value, s.count, s.probability)).collect();
        assert_eq!(seen, [(1.0, 1, 0.25), (2.0, 2, 0.5), (3.0, 4, 1.0)]);
        assert_eq!(steps[1].pointwise, clopper_pearson(2, 4));
        // One that stood to 2.5 counts below; what fell later is beyond what is known of it.
        let steps = empirical(&[3.0, 1.0, 3.0, 2.0], &[2.5]);
        let seen: Vec<(f64, f64)> = steps.iter().map(|s| (s.value, s.probability)).collect();
        assert_eq!(seen, [(1.0, 0.2), (2.0, 0.4)]);
        assert!(empirical(&[], &[]).is_empty() && empirical(&[], &[5.0]).is_empty());
    }

    #[test]
    fn of_very_many_steps_ten_thousand_are_kept_evenly_and_each_as_it_was() {
        let values: Vec<f64> = (0..25_001).map(|k| f64::from(k * 7919 % 25_001)).collect();
        let steps = empirical(&values, &[30_000.0]);
        assert_eq!(steps.len(), 10_000);
        assert_eq!((steps[0].value, steps[0].count), (0.0, 1));
        assert_eq!((steps[9_999].value, steps[9_999].count), (25_000.0, 25_001));
        assert!(steps.windows(2).all(|pair| [2, 3].contains(&(pair[1].count - pair[0].count))));
        for step in steps.iter().step_by(999) {
            assert_eq!(step.count, step.value as u64 + 1);
            assert_eq!(step.probability, step.count as f64 / 25_002.0);
            assert_eq!(step.pointwise, clopper_pearson(step.count as usize, 25_002));
        }
        // So many and no more are given one by one.
        assert_eq!(empirical(&values[..9_999], &[]).len(), 9_999);
        assert_eq!(empirical(&values[..10_000], &[]).len(), 10_000);
        assert_eq!(empirical(&values[..10_001], &[]).len(), 10_000);
    }
}
