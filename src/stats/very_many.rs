//! Quantiles for more than a million values. There statrs loses its way: Student's t comes out 7 % low at 1e7 degrees of freedom, chi-square
//! takes forever at 1e8, and the search for a quantile of a beta distribution, which begins no nearer to 0 than 1e-4, never ends where
//! that quantile is much smaller. Up to a million they are used: their values are certified, and results keep their bits.

use statrs::distribution::{Beta, Continuous, ContinuousCDF};

use crate::math::exp;
use crate::random::standard_normal;

/// More than so many values, or degrees of freedom, are very many.
pub(super) const VERY_MANY: f64 = 1e6;
/// Steps of a search whose beginning is right to some digits: far more than it takes.
const MOST_STEPS: usize = 50;
/// A step that is smaller, as a share of where it leads, is the last.
const LAST_STEP: f64 = 1e-12;

/// Quantile of Student's t: the expansion of Fisher and Cornish (1960) about the normal one, whose next term is below 1e-17.
pub(super) fn student(probability: f64, freedom: f64) -> f64 {
    let z = standard_normal::quantile(probability);
    let square = z * z;
    z + z * (square + 1.0) / (4.0 * freedom)
        + z * ((5.0 * square + 16.0) * square + 3.0) / (96.0 * freedom * freedom)
}

/// Quantile of chi-square, by the same; its next term is below 1e-12 of it.
pub(super) fn chi_square(probability: f64, freedom: f64) -> f64 {
    let z = standard_normal::quantile(probability);
    let (square, root) = (z * z, (2.0 * freedom).sqrt());
    freedom + z * root + 2.0 / 3.0 * (square - 1.0) + z * (square - 7.0) / (9.0 * root)
}

/// Quantile, in one of its tails, of a beta distribution of two parameters from 1 on: Newton's method from Carter's approximation (1947).
/// Its error is some 1e-8 of it, which comes from the logarithms of factorials of so large numbers.
pub(super) fn beta(a: f64, b: f64, probability: f64) -> f64 {
    let beta = Beta::new(a, b);
    crate::check!(beta.is_ok() && a >= 1.0 && b >= 1.0, "there is no beta distribution of {a} and {b}");
    let Ok(beta) = beta else { return f64::NAN };
    if a > b {
        // What is next to 1 is 1 to statrs.
        return 1.0 - self::beta(b, a, 1.0 - probability);
    }
    let mut x = near(a, b, probability);
    let [mut low, mut high] = [0.0, 1.0];
    for _ in 0..MOST_STEPS {
        let over = beta.cdf(x) - probability;
        if over > 0.0 {
            high = x
        } else {
            low = x
        }
        let newton = x - over / beta.pdf(x);
        let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
        let is_last = (next - x).abs() <= LAST_STEP * next;
        x = next;
        if is_last {
            break;
        }
    }
    x
}

/// Half the logarithm of a ratio of variances is nearly normal: Fisher's z with Carter's corrections.
fn near(a: f64, b: f64, probability: f64) -> f64 {
    let z = standard_normal::quantile(probability);
    let [s, t] = [a, b].map(|parameter| 1.0 / (2.0 * parameter - 1.0));
    let (h, r) = (2.0 / (s + t), (z * z - 3.0) / 6.0);
    let w = -z * (h + r).sqrt() / h - (t - s) * (r + 5.0 / 6.0 - 2.0 / (3.0 * h));
    a / (a + b * exp(2.0 * w))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::{clopper_pearson, sigma_factors, student_quantile};

    fn close(found: f64, known: f64, digits: f64) {
        assert!((found - known).abs() <= digits * known.abs(), "{found} for {known}");
    }

    /// By quadrature in forty digits (mpmath).
    #[test]
    fn quantiles_at_very_many_degrees_of_freedom_are_those_of_an_integration() {
        close(student(0.975, 2e6), 1.959_965_170_676_375, 1e-14);
        close(student(0.9999, 1e7), 3.719_017_864_382_25, 1e-14);
        for (probability, freedom, known) in [
            (0.025, 2e6, 1_996_081.966_680_587_8),
            (0.975, 2e6, 2_003_921.821_930_900_7),
            (0.025, 1e8, 99_972_283.817_867_52),
            (0.975, 1e8, 100_027_719.970_744_23),
        ] {
            close(chi_square(probability, freedom), known, 1e-13);
        }
    }

    /// Sums of binomial probabilities, and a quadrature, in forty digits (mpmath).
    #[test]
    fn quantiles_of_a_beta_distribution_are_found_however_small_they_are() {
        for (a, b, probability, known) in [
            (1.0, 1e7, 0.025, 2.531_780_795_224_030_5e-9),
            (2.0, 9_999_999.0, 0.975, 5.571_642_117_360_731e-7),
            (3.0, 1_999_998.0, 0.975, 3.612_339_115_522_989_9e-6),
            (1e3, 99_999_001.0, 0.025, 9.389_733_002_270_437e-6),
            (1_001.0, 99_999_000.0, 0.975, 1.063_951_795_805_474_3e-5),
            (5e7, 50_000_001.0, 0.025, 0.499_901_996_801_957_76),
        ] {
            close(beta(a, b, probability), known, 1e-7);
            // The other way round.
            close(1.0 - beta(b, a, 1.0 - probability), known, 1e-6);
        }
    }

    #[test]
    fn what_is_used_of_a_million_and_one_goes_on_from_a_million() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 2e-4 * b.abs(), "{a} and {b}");
        near(student_quantile(0.975, 1e6 + 1.0), student_quantile(0.975, 1e6));
        let [more, fewer] = [1_000_002, 1_000_001].map(|n| sigma_factors(n).map(|factor| factor - 1.0));
        (0..2).for_each(|end| near(more[end], fewer[end]));
        for hits in [3_000, 400_000, 999_000] {
            let [more, fewer] = [1_000_001, 1_000_000].map(|n| clopper_pearson(hits, n));
            (0..2).for_each(|end| near(more[end], fewer[end]));
        }
        assert_eq!(clopper_pearson(0, 20_000_000)[0], 0.0);
        assert_eq!(clopper_pearson(20_000_000, 20_000_000)[1], 1.0);
    }
}
