//! The lognormal fragility curve, and what can be said where the trials do not tell one.

use super::campaign::{Campaign, Stripe};
use super::crossed::Crossed;
use super::probit::{self, Point, Probit};
use crate::math::{exp, ln, ln_gamma};
use crate::random::standard_normal::cdf;
use crate::stats::Estimate;

/// P(collapse | x) = Phi(ln(x / theta) / beta).
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Lognormal {
    /// Median: the intensity at which half collapse, in the unit of the intensities.
    pub theta: f64,
    /// Dispersion: the standard deviation of ln x at collapse.
    pub beta: f64,
}

impl Lognormal {
    /// Probability of collapse at an intensity above 0.
    ///
    /// ```
    /// use pirca::stats::fragility::Lognormal;
    /// assert_eq!(Lognormal { theta: 1.2, beta: 0.4 }.probability(1.2), 0.5);
    /// ```
    pub fn probability(&self, intensity: f64) -> f64 {
        cdf(ln(intensity / self.theta) / self.beta)
    }

    /// That of a curve over ln x; `None` where it does not rise.
    pub(super) fn of(curve: &Probit) -> Option<Lognormal> {
        let own = Lognormal { theta: exp(curve.centre - curve.level / curve.slope), beta: 1.0 / curve.slope };
        (curve.slope > 0.0 && own.theta.is_finite() && own.theta > 0.0 && own.beta.is_finite()).then_some(own)
    }
}

/// What trials tell of a lognormal curve.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case", tag = "is")]
pub enum Told {
    /// Theta and beta: both outcomes occur, and some wall stands above an intensity at which one collapses.
    Curve,
    /// Nothing: there is no trial.
    NoTrial,
    /// All trials are at one intensity: the share of collapses there and no curve; see [`isotonic`](super::isotonic()).
    OneIntensity {
        /// That intensity.
        intensity: f64,
    },
    /// No wall collapses. Theta lies above what was tested, if not by chance; how probable collapse may be there is said by
    /// [`isotonic`](super::isotonic()).
    NoneCollapsed {
        /// The highest intensity of a trial.
        highest: f64,
    },
    /// Every wall collapses, however weak the record.
    AllCollapsed {
        /// The lowest intensity of a trial.
        lowest: f64,
    },
    /// Beta is not identified: all collapses lie at or above all that stands, and the likelihood grows as beta goes to 0. The stripes are
    /// too far apart, or the trials too few. No interval is given, as nothing bounds beta from below.
    BetaNotIdentified {
        /// Theta lies between the highest intensity that all stand at and the lowest that all collapse at, if beta is small.
        theta: [f64; 2],
    },
    /// The share of collapses does not rise with the intensity: it is no measure of what topples.
    NotRising,
}

/// A lognormal curve by maximum likelihood, without intervals.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Fit {
    /// What the trials tell.
    pub told: Told,
    /// The curve of greatest likelihood, where the trials tell one.
    pub curve: Option<Lognormal>,
    /// The curve of greatest likelihood times Jeffreys' prior, where both outcomes occur and the shares rise: finite too where beta is
    /// not identified, but then beta is the prior's (Firth 1993; Kosmidis and Firth 2021). Of a probit the prior shrinks the curve
    /// towards a half, which removes most of the bias of small samples and not all of it, as it would of a logit.
    pub penalised: Option<Lognormal>,
    /// Logarithm of the binomial likelihood of `curve`, with the binomial coefficients.
    pub log_likelihood: Option<f64>,
}

/// A lognormal curve with 95 % intervals over records and walls.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Fragility {
    /// What the trials tell, the curve, and its likelihood as of independent trials.
    pub fit: Fit,
    /// Theta; no value where there is no curve, no interval from one record.
    pub theta: Estimate,
    /// Beta.
    pub beta: Estimate,
}

/// The lognormal curve of greatest binomial likelihood over all trials, k_j of n_j at x_j ~ Bin(n_j, Phi(ln(x_j / theta) / beta)).
///
/// Intensities must be above 0, and collapses between 0 and the trials. Stripes may come in any order, and more than once.
///
/// ```
/// use pirca::stats::fragility::{Stripe, fitted};
/// let shares = [(0.5, 1.0), (1.0, 8.0), (2.0, 19.0)];
/// let stripes = shares.map(|(intensity, collapsed)| Stripe { intensity, trials: 20.0, collapsed });
/// let curve = fitted(&stripes).curve.unwrap();
/// assert!((curve.theta - 1.064).abs() < 1e-3 && (curve.beta - 0.419).abs() < 1e-3, "{curve:?}");
/// ```
pub fn fitted(stripes: &[Stripe]) -> Fit {
    for Stripe { intensity, trials, collapsed } in stripes {
        crate::check!(
            *intensity > 0.0
                && intensity.is_finite()
                && trials.is_finite()
                && (0.0..=*trials).contains(collapsed),
            "{collapsed} collapses in {trials} trials at the intensity {intensity}"
        );
    }
    let points: Vec<Point> = stripes.iter().map(|own| own.point(ln(own.intensity))).collect();
    let told = told(&stripes.iter().map(|own| own.point(own.intensity)).collect::<Vec<_>>());
    let curve = maximum(&points, Method::Likelihood);
    Fit {
        told: if told == Told::Curve && curve.is_none() { Told::NotRising } else { told },
        curve: curve.map(|(own, _)| own),
        penalised: matches!(told, Told::Curve | Told::BetaNotIdentified { .. })
            .then(|| maximum(&points, Method::Penalised))
            .flatten()
            .map(|(own, _)| own),
        log_likelihood: curve.map(|(_, value)| value + coefficients(&points)),
    }
}

/// The lognormal curve of a campaign with 95 % intervals that hold for other records and other walls of the same kinds: see
/// [Intervals](super#intervals).
///
/// Where the trials without one record, wall or pair do not tell a curve, the intervals are those of the penalised fit.
pub fn lognormal(campaign: &Campaign) -> Fragility {
    let fit = fitted(&campaign.by_intensity());
    let order = campaign.order();
    let ends = estimates(&campaign.crossed(), |weights, method| {
        let (curve, _) = maximum(&campaign.points(&order, weights), method)?;
        Some([ln(curve.theta), ln(curve.beta)])
    })
    .map(|own| exponential(own).interval);
    let value = |of: fn(&Lognormal) -> f64| fit.curve.as_ref().map(of);
    Fragility {
        fit,
        theta: Estimate { value: value(|curve| curve.theta), interval: ends[0] },
        beta: Estimate { value: value(|curve| curve.beta), interval: ends[1] },
    }
}

/// How a curve is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// By greatest likelihood.
    Likelihood,
    /// With Jeffreys' prior as a penalty.
    Penalised,
}

/// Statistics of curves with intervals: those by likelihood, or, where a resample has none, with the penalty.
pub(super) fn estimates<const N: usize>(
    crossed: &Crossed,
    statistic: impl Fn(&[f64], Method) -> Option<[f64; N]>,
) -> [Estimate; N] {
    let found = crossed.estimates(|weights| statistic(weights, Method::Likelihood));
    if found.iter().all(|own| own.value.is_none() || own.interval.is_some()) {
        return found;
    }
    let penalised = crossed.estimates(|weights| statistic(weights, Method::Penalised));
    std::array::from_fn(|own| Estimate { interval: penalised[own].interval, ..found[own] })
}

/// The exponential of an estimate.
pub(super) fn exponential(estimate: Estimate) -> Estimate {
    Estimate { value: estimate.value.map(exp), interval: estimate.interval.map(|ends| ends.map(exp)) }
}

/// The curve over trials at ln x with its log-likelihood without binomial coefficients; `None` where there is none that rises.
pub(super) fn maximum(points: &[Point], method: Method) -> Option<(Lognormal, f64)> {
    let curve = match method {
        Method::Likelihood => probit_curve(points),
        Method::Penalised => matches!(told(points), Told::Curve | Told::BetaNotIdentified { .. })
            .then(|| probit::penalised(points))
            .flatten(),
    }?;
    Some((Lognormal::of(&curve)?, curve.log_likelihood))
}

/// The curve of greatest likelihood over ln x; `None` where there is none that rises.
pub(super) fn probit_curve(points: &[Point]) -> Option<Probit> {
    let curve = if told(points) == Told::Curve { probit::fitted(points) } else { None }?;
    Lognormal::of(&curve).map(|_| curve)
}

/// What trials tell at places x, or ln x, before a curve is looked for.
fn told(points: &[Point]) -> Told {
    let (mut all, mut hits, mut misses) = (NONE, NONE, NONE);
    for point in points.iter().filter(|point| point.trials > 0.0) {
        let widen =
            |[low, high]: &mut [f64; 2]| (*low, *high) = (low.min(point.place), high.max(point.place));
        widen(&mut all);
        if point.hits > 0.0 {
            widen(&mut hits);
        }
        if point.hits < point.trials {
            widen(&mut misses);
        }
    }
    if all == NONE {
        Told::NoTrial
    } else if hits == NONE {
        Told::NoneCollapsed { highest: all[1] }
    } else if misses == NONE {
        Told::AllCollapsed { lowest: all[0] }
    } else if all[0] == all[1] {
        Told::OneIntensity { intensity: all[0] }
    } else if misses[1] <= hits[0] {
        Told::BetaNotIdentified { theta: [misses[1], hits[0]] }
    } else if hits[1] <= misses[0] {
        Told::NotRising
    } else {
        Told::Curve
    }
}

/// A range that nothing lies in.
const NONE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// Sum of the logarithms of the binomial coefficients.
fn coefficients(points: &[Point]) -> f64 {
    let own = |Point { trials, hits, .. }: &Point| {
        ln_gamma(trials + 1.0) - ln_gamma(hits + 1.0) - ln_gamma(trials - hits + 1.0)
    };
    points.iter().map(own).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::fragility::Outcome;

    fn stripes(shares: &[(f64, f64, f64)]) -> Vec<Stripe> {
        shares
            .iter()
            .map(|(intensity, collapsed, trials)| Stripe {
                intensity: *intensity,
                trials: *trials,
                collapsed: *collapsed,
            })
            .collect()
    }

    #[test]
    fn what_trials_do_not_tell_is_said() {
        let told = |shares: &[(f64, f64, f64)]| fitted(&stripes(shares)).told;
        assert_eq!(told(&[]), Told::NoTrial);
        assert_eq!(told(&[(0.3, 0.0, 0.0)]), Told::NoTrial);
        assert_eq!(told(&[(0.3, 1.0, 4.0)]), Told::OneIntensity { intensity: 0.3 });
        assert_eq!(told(&[(0.7, 0.0, 5.0), (0.3, 0.0, 4.0)]), Told::NoneCollapsed { highest: 0.7 });
        assert_eq!(told(&[(0.7, 5.0, 5.0), (0.3, 4.0, 4.0)]), Told::AllCollapsed { lowest: 0.3 });
        assert_eq!(
            told(&[(0.3, 0.0, 5.0), (0.7, 5.0, 5.0), (0.5, 0.0, 5.0)]),
            Told::BetaNotIdentified { theta: [0.5, 0.7] }
        );
        // One mixed stripe among pure ones does not tell beta either.
        let mixed = [(0.3, 0.0, 5.0), (0.5, 2.0, 5.0), (0.7, 5.0, 5.0)];
        assert_eq!(told(&mixed), Told::BetaNotIdentified { theta: [0.5, 0.5] });
        assert_eq!(told(&[(0.3, 5.0, 5.0), (0.7, 0.0, 5.0)]), Told::NotRising);
        assert_eq!(told(&[(0.3, 3.0, 5.0), (0.7, 2.0, 5.0)]), Told::NotRising);
        assert_eq!(told(&[(0.3, 1.0, 5.0), (0.7, 4.0, 5.0)]), Told::Curve);
    }

    #[test]
    fn separated_trials_have_no_beta_but_that_of_the_prior() {
        let fit = fitted(&stripes(&[(0.3, 0.0, 20.0), (0.5, 0.0, 20.0), (0.7, 20.0, 20.0)]));
        assert_eq!((fit.curve, fit.log_likelihood), (None, None));
        let own = fit.penalised.unwrap();
        assert!(own.theta > 0.5 && own.theta < 0.7 && own.beta > 0.0 && own.beta < 0.3, "{own:?}");
        let none = fitted(&stripes(&[(0.3, 0.0, 20.0), (0.5, 0.0, 20.0)]));
        assert_eq!(none.penalised, None);
    }

    /// Four records, one wall: without the third the rest is separated.
    #[test]
    fn an_interval_that_one_record_carries_is_that_of_the_penalised_fit() {
        let (yes, no) = (Some(Outcome::Collapsed), Some(Outcome::Stands));
        let outcomes = vec![no, no, yes, no, no, yes, yes, no, yes, no, no, yes];
        let campaign = Campaign::of_stripes(&[1.0, 2.0, 3.0], 4, 1, outcomes);
        let found = lognormal(&campaign);
        assert_eq!(found.fit.told, Told::Curve);
        let value = found.theta.value.unwrap();
        let [low, high] = found.theta.interval.unwrap();
        assert!(low < value && value < high, "{found:?}");
        let order = campaign.order();
        let plain = campaign.crossed().estimates(|weights| {
            maximum(&campaign.points(&order, weights), Method::Likelihood).map(|own| [own.0.theta])
        });
        assert_eq!(plain[0].interval, None);
    }
}
