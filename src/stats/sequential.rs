//! Sampling that stops by itself once a statistic is known well enough, with an interval that keeps its coverage.
//!
//! Who looks at an interval after every value and stops when it is narrow stops too often when it is narrow by chance. Here looks are
//! few and planned, and the 5 % that an interval may miss are spread over them in equal parts (alpha spending, Lan and DeMets
//! 1983, with the union bound in the place of the looks' correlation). All looks together then miss with at most 5 %, so that the
//! last one does so too, whatever the rule that stopped.

use super::Estimate;
use super::moments::{mean, sigma, sum};
use super::order::{order_interval, quantile};
use super::reference::student_quantile;
use crate::math::{exp, ln};
use crate::random::standard_normal;

/// What all looks together may miss.
const MISS: f64 = 0.05;
/// Values at the first look: fewer say too little of a spread.
const FIRST: u64 = 20;
/// From look to look the sample grows by this factor: more looks need wider intervals, fewer stop later than need be.
const GROWTH: f64 = 1.5;

/// What a sample is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Statistic {
    /// Its mean.
    Mean,
    /// Its standard deviation.
    Sigma,
    /// The value that this share of all values lie below.
    Quantile(f64),
}

impl Statistic {
    /// By its name: `mean`, `sigma`, or `quantile-0.05` with any share between 0 and 1.
    pub fn named(name: &str) -> Option<Statistic> {
        match name {
            "mean" => Some(Statistic::Mean),
            "sigma" => Some(Statistic::Sigma),
            _ => {
                let share: f64 = name.strip_prefix("quantile-")?.parse().ok()?;
                (share > 0.0 && share < 1.0).then_some(Statistic::Quantile(share))
            }
        }
    }

    /// Its name.
    pub fn name(self) -> String {
        match self {
            Statistic::Mean => "mean".to_owned(),
            Statistic::Sigma => "sigma".to_owned(),
            Statistic::Quantile(share) => format!("quantile-{share}"),
        }
    }

    /// The statistic of a sample, with an interval that misses it with probability `miss` at most: of a mean Student's, of a standard
    /// deviation that of Bonett (2006), which does not take the values for normal, of a quantile that between two order statistics.
    pub fn of(self, values: &[f64], miss: f64) -> Estimate {
        match self {
            Statistic::Mean => {
                let (n, value, spread) = (values.len() as f64, mean(values), sigma(values));
                let half = |s: f64| student_quantile(1.0 - 0.5 * miss, n - 1.0) * s / n.sqrt();
                let interval = value.zip(spread).map(|(m, s)| [m - half(s), m + half(s)]);
                Estimate { value, interval }
            }
            Statistic::Sigma => Estimate { value: sigma(values), interval: sigma_interval(values, miss) },
            Statistic::Quantile(share) => Estimate {
                value: quantile(values, share),
                interval: order_interval(values, share, 0.5 * miss),
            },
        }
    }
}

/// The numbers of values at which a sample is looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Looks(Vec<u64>);

impl Looks {
    /// Those of a sample of at most so many values, at least one: 20, then half as many more each time.
    ///
    /// ```
    /// use pirca::stats::Looks;
    /// assert_eq!(Looks::up_to(100).sizes(), [20, 30, 45, 68, 100]);
    /// assert_eq!(Looks::up_to(7).sizes(), [7]);
    /// ```
    pub fn up_to(at_most: u64) -> Looks {
        Looks::between(FIRST, at_most)
    }

    /// The same with so many values at the first look, at least two.
    pub fn between(first: u64, at_most: u64) -> Looks {
        crate::check!(first > 1 && at_most > 0, "no looks at {first} to {at_most} values");
        let mut sizes = Vec::new();
        let mut size = first;
        while size < at_most {
            sizes.push(size);
            size = (size as f64 * GROWTH).round() as u64;
        }
        sizes.push(at_most);
        Looks(sizes)
    }

    /// The numbers, ascending.
    pub fn sizes(&self) -> &[u64] {
        &self.0
    }

    /// What the interval of each look may miss.
    pub fn miss(&self) -> f64 {
        MISS / self.0.len() as f64
    }
}

/// Half the width of an interval over the magnitude of the statistic; `None` where one of them is not defined, or the statistic is 0.
pub fn relative_half_width(estimate: Estimate) -> Option<f64> {
    let (value, [low, high]) = estimate.value.zip(estimate.interval)?;
    let width = 0.5 * (high - low) / value.abs();
    width.is_finite().then_some(width)
}

/// exp of ln(c s^2) -+ z c sqrt((g - (n - 3)/n) / (n - 1)), under the root: g is the kurtosis about a mean trimmed by 1/(2 sqrt(n - 4)) at
/// each end, c = n/(n - z) (Bonett 2006, Computational Statistics and Data Analysis 50). `None` for fewer than five values, for
/// values that are all equal, and where n is not above z.
fn sigma_interval(values: &[f64], miss: f64) -> Option<[f64; 2]> {
    let n = values.len() as f64;
    let (centre, spread) = (mean(values)?, sigma(values)?);
    let z = -standard_normal::quantile(0.5 * miss);
    if n < 5.0 || n <= z || spread == 0.0 {
        return None;
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let cut = ((n * 0.5 / (n - 4.0).sqrt()) as usize).min((sorted.len() - 1) / 2);
    let trimmed = mean(&sorted[cut..sorted.len() - cut])?;
    let squares = |about: f64| values.iter().map(move |x| (x - about) * (x - about));
    let fourth = sum(&squares(trimmed).map(|square| square * square).collect::<Vec<_>>());
    let second = sum(&squares(centre).collect::<Vec<_>>());
    let kurtosis = n * fourth / (second * second);
    let c = n / (n - z);
    let half = z * c * ((kurtosis - (n - 3.0) / n) / (n - 1.0)).max(0.0).sqrt();
    let middle = ln(c * spread * spread);
    Some([exp(0.5 * (middle - half)), exp(0.5 * (middle + half))])
}
