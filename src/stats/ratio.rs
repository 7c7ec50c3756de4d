//! Ratio of two means with Fieller's interval.

use super::Estimate;
use super::moments::{check_values, comoment, covariance, mean};
use super::reference::student;

/// Mean of `a` over mean of `b`, two independent samples, with Fieller's 95 % interval (Fieller 1954).
///
/// The two variances may differ: Student's t takes Satterthwaite's degrees of freedom at the ratio found (Satterthwaite
/// 1946; Tamhane and Logan 2004). **A side with a single value counts as one deterministic wall, known without
/// scatter** (a regular arm); hand in one wall of a random arm only if that is what you mean.
///
/// No value where a side is empty or the mean of `b` is 0. No interval where both sides have a single value (nothing is
/// known of any scatter), and where the mean of `b` does not differ from 0 at the 5 % level: the set of ratios
/// compatible with the data is then unbounded.
pub fn ratio_of_means(a: &[f64], b: &[f64]) -> Estimate {
    check_values(a);
    check_values(b);
    let Some([mean_a, mean_b]) = means(a, b) else { return Estimate::UNDEFINED };
    let ratio = mean_a / mean_b;
    if a.len() == 1 && b.len() == 1 {
        return Estimate { value: Some(ratio), interval: None };
    }
    let squared_a = squared_error(a, mean_a);
    let squared_b = squared_error(b, mean_b);
    // Of mean(a) - ratio mean(b), whose two parts are independent.
    let parts = [squared_a, ratio * ratio * squared_b];
    let residual = Scatter {
        residual: parts[0] + parts[1],
        shared: -ratio * squared_b,
        denominator: squared_b,
        freedom: satterthwaite(parts, [a.len(), b.len()]),
    };
    fieller(ratio, mean_b, residual)
}

/// Mean of `a` over mean of `b` for paired members (the same index means the same random numbers), with Fieller's
/// 95 % interval (Fieller 1954), which is exact for normal pairs.
///
/// Both must have the same length. No value where they are empty or the mean of `b` is 0; no interval for one pair and
/// where the mean of `b` does not differ from 0 at the 5 % level (unbounded).
pub fn paired_ratio_of_means(a: &[f64], b: &[f64]) -> Estimate {
    check_values(a);
    check_values(b);
    crate::check!(a.len() == b.len(), "{} values cannot be paired with {}", a.len(), b.len());
    let Some([mean_a, mean_b]) = means(a, b) else { return Estimate::UNDEFINED };
    let ratio = mean_a / mean_b;
    let n = a.len();
    if n == 1 {
        return Estimate { value: Some(ratio), interval: None };
    }
    let centre = mean_a - ratio * mean_b;
    let residuals = || a.iter().zip(b).map(|(x, y)| x - ratio * y - centre);
    let count = n as f64;
    let scatter = Scatter {
        residual: covariance(residuals().map(|residual| (residual, residual)), n) / count,
        shared: covariance(residuals().zip(b).map(|(residual, y)| (residual, y - mean_b)), n) / count,
        denominator: comoment(b, mean_b, b, mean_b) / count,
        freedom: count - 1.0,
    };
    fieller(ratio, mean_b, scatter)
}

/// Both means, if there are values and the ratio of the means is a number.
fn means(a: &[f64], b: &[f64]) -> Option<[f64; 2]> {
    let (mean_a, mean_b) = mean(a).zip(mean(b))?;
    (mean_a / mean_b).is_finite().then_some([mean_a, mean_b])
}

/// Squared standard error of the mean; 0 for a single value.
fn squared_error(values: &[f64], mean: f64) -> f64 {
    if values.len() == 1 {
        return 0.0;
    }
    comoment(values, mean, values, mean) / values.len() as f64
}

/// Degrees of freedom of the sum of two estimated variances; those of the larger sample where both are 0, when they no
/// longer matter.
fn satterthwaite(parts: [f64; 2], counts: [usize; 2]) -> f64 {
    let total = parts[0] + parts[1];
    if total <= 0.0 {
        return (counts[0].max(counts[1]) - 1) as f64;
    }
    let mut inverse = 0.0;
    for (part, count) in parts.into_iter().zip(counts) {
        if part > 0.0 {
            inverse += (part / total) * (part / total) / (count - 1) as f64;
        }
    }
    inverse.recip()
}

/// Estimated variances of two means: of the residual d = a - ratio b, of b, and their covariance.
struct Scatter {
    residual: f64,
    shared: f64,
    denominator: f64,
    freedom: f64,
}

/// All rho with (a - rho b)^2 <= t^2 var(a - rho b), written in e = rho - ratio:
/// (b^2 - t^2 v_bb) e^2 + 2 t^2 v_db e - t^2 v_dd <= 0. In e nothing large cancels, and the roots have opposite signs.
fn fieller(ratio: f64, mean_b: f64, scatter: Scatter) -> Estimate {
    let t = student(scatter.freedom);
    let squared = t * t;
    let leading = mean_b * mean_b - squared * scatter.denominator;
    let interval = (leading > 0.0).then(|| {
        let middle = -squared * scatter.shared;
        let half = (middle * middle + leading * squared * scatter.residual).sqrt();
        [ratio + (middle - half) / leading, ratio + (middle + half) / leading]
    });
    Estimate { value: Some(ratio), interval }
}
