//! Two arrangements under the same records, and two measures of intensity on the same outcomes.

use super::campaign::Campaign;
use super::crossed::Crossed;
use super::lognormal::{Method, estimates, exponential, maximum};
use crate::math::ln;
use crate::stats::Estimate;

/// How the walls of two campaigns belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walls {
    /// Wall k of the one is wall k of the other in all but the arrangement: the same random numbers, or the same wall before and after.
    Paired,
    /// Each campaign has walls of its own.
    Apart,
}

/// One arrangement over another, each a ratio with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Ratios {
    /// Of the medians theta: above 1 the first is the stronger.
    pub theta: Estimate,
    /// Of the dispersions beta.
    pub beta: Estimate,
}

/// The median of `first` over that of `second`, and the same of the dispersions. Record k must be the same in both, so that what it does to
/// both cancels; intensities and stripes may differ. The intervals hold for other records and walls of the same kinds: see
/// [Intervals](super#intervals).
///
/// ```
/// use pirca::random::Streams;
/// use pirca::stats::fragility::{Campaign, Latent, Outcome, Walls, ratios};
/// let planned = Campaign::of_stripes(&[0.4, 0.6, 0.9, 1.3, 2.0], 20, 5, vec![Some(Outcome::Stands); 500]);
/// let drawn = |theta: f64| {
///     let latent = Latent { theta, deviations: [0.3, 0.1, 0.1, 0.1] };
///     latent.drawn(&planned, &mut Streams::new(1, 0).of("records and walls"))
/// };
/// let found = ratios(&drawn(1.1), &drawn(1.0), Walls::Paired);
/// assert!((found.theta.value.unwrap() - 1.1).abs() < 0.1);
/// ```
pub fn ratios(first: &Campaign, second: &Campaign, walls: Walls) -> Ratios {
    crate::check!(
        first.records() == second.records(),
        "{} records cannot be paired with {}",
        first.records(),
        second.records()
    );
    let groups = match walls {
        Walls::Paired => {
            crate::check!(
                first.walls() == second.walls(),
                "{} walls cannot be paired with {}",
                first.walls(),
                second.walls()
            );
            vec![first.walls()]
        }
        Walls::Apart => vec![first.walls(), second.walls()],
    };
    let all: usize = groups.iter().sum();
    // The columns of each campaign's walls among the weights.
    let columns = [0..first.walls(), all - second.walls()..all];
    let orders = [first.order(), second.order()];
    let [theta, beta] = estimates(&Crossed::new(first.records(), &groups), |weights, method| {
        let curve = |own: usize| {
            let columns = columns[own].clone();
            let weights: Vec<f64> =
                weights.chunks(all).flat_map(|row| row[columns.clone()].to_vec()).collect();
            maximum(&[first, second][own].points(&orders[own], &weights), method)
        };
        let ((a, _), (b, _)) = curve(0).zip(curve(1))?;
        Some([ln(a.theta / b.theta), ln(a.beta / b.beta)])
    })
    .map(exponential);
    Ratios { theta, beta }
}

/// How much better one measure of intensity predicts collapse than another, on the same outcomes.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Measures {
    /// Dispersion beta of the first measure less that of the second: below 0 the first is the more efficient one.
    pub beta: Estimate,
    /// Deviance of the first less that of the second, a trial: below 0 the first predicts better.
    pub deviance: Estimate,
}

/// Compares the measure of a campaign with another one: peak velocity with peak acceleration, say. `other` gives the second measure's
/// intensities of the same records and stripes, by record, then stripe.
///
/// The deviance is -2 ln L of the lognormal curve over a trial, so that it does not depend on the unit of a measure. Beta does not
/// either, but is one of ln x: it compares measures that both grow in proportion when a record is scaled. The intervals are those of
/// [Intervals](super#intervals); where both measures are one, both differences are 0 without any scatter.
pub fn measures(campaign: &Campaign, other: &[f64]) -> Measures {
    let second = campaign.measured(other.to_vec());
    let orders = [campaign.order(), second.order()];
    let [beta, deviance] = estimates(&campaign.crossed(), |weights, method: Method| {
        let points = campaign.points(&orders[0], weights);
        let (a, of_a) = maximum(&points, method)?;
        let (b, of_b) = maximum(&second.points(&orders[1], weights), method)?;
        let trials: f64 = points.iter().map(|point| point.trials).sum();
        Some([a.beta - b.beta, -2.0 * (of_a - of_b) / trials])
    });
    Measures { beta, deviance }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Streams;
    use crate::stats::fragility::{Latent, Outcome};

    fn drawn(records: usize, walls: usize, name: &str) -> Campaign {
        let x = [0.4, 0.6, 0.9, 1.3, 2.0];
        let planned =
            Campaign::of_stripes(&x, records, walls, vec![Some(Outcome::Stands); records * walls * 5]);
        let latent = Latent { theta: 1.0, deviations: [0.3, 0.15, 0.1, 0.1] };
        latent.drawn(&planned, &mut Streams::new(2, 0).of(name))
    }

    #[test]
    fn what_is_the_same_has_no_scatter() {
        let own = drawn(10, 4, "compared");
        let stretched = own.measured(own.intensities().iter().map(|x| 1.7 * x).collect());
        let found = ratios(&stretched, &own, Walls::Paired);
        // The fits stop at 1e-11.
        for (estimate, known) in [(found.theta, 1.7), (found.beta, 1.0)] {
            let ends = estimate.interval.unwrap();
            assert!(ends.iter().chain(&estimate.value).all(|own| (own - known).abs() < 1e-8), "{estimate:?}");
        }
        let found = measures(&own, stretched.intensities());
        for estimate in [found.beta, found.deviance] {
            let ends = estimate.interval.unwrap();
            assert!(ends.iter().chain(&estimate.value).all(|own| own.abs() < 1e-8), "{estimate:?}");
        }
    }

    /// The same walls taken for others scatter by themselves, and shared records still cancel.
    #[test]
    fn pairs_are_known_better_than_walls_apart() {
        let (a, b) = (drawn(12, 6, "compared"), drawn(12, 6, "compared with"));
        let width = |walls: Walls, b: &Campaign| {
            let [low, high] = ratios(&a, b, walls).theta.interval.unwrap();
            high - low
        };
        assert!(width(Walls::Apart, &a) > 0.05 && width(Walls::Paired, &a) < 1e-8);
        assert!(width(Walls::Apart, &a) < width(Walls::Apart, &b));
        let swapped = ratios(&b, &a, Walls::Apart).theta;
        let straight = ratios(&a, &b, Walls::Apart).theta;
        let product = |end: usize| swapped.interval.unwrap()[end] * straight.interval.unwrap()[1 - end];
        assert!((product(0) - 1.0).abs() < 1e-8 && (product(1) - 1.0).abs() < 1e-8);
        assert!(std::panic::catch_unwind(|| ratios(&a, &drawn(11, 6, "fewer"), Walls::Apart)).is_err());
        assert!(std::panic::catch_unwind(|| ratios(&a, &drawn(12, 5, "fewer"), Walls::Paired)).is_err());
    }
}
