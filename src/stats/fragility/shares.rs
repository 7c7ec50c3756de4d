//! Where the scatter of capacities comes from: the records, the walls, what is particular to a pair of them, and the rest.

use super::campaign::{Campaign, Order};
use super::lognormal::probit_curve;
use super::reached::{Reached, bisected};
use super::violations::by_violations;
use crate::stats::Estimate;
use crate::stats::reference::fisher;

/// Shares of the variance of ln x at collapse, each with its 95 % interval; they add up to 1.
///
/// The model: a wall collapses under a record at x where ln x exceeds mu + record + wall + interaction + rest. The four are independent
/// normals, drawn anew for each record, each wall, each pair, and each trial. Their variances add up to beta^2, so that beta times the
/// root of a share is that effect's standard deviation in ln x.
///
/// By chance the estimate of a small share may lie below 0, and its interval reaches below 0 where nothing is there. Nothing is defined
/// without a curve, nor from fewer than two records, two walls and two stripes.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Shares {
    /// Of the record: some records are worse than their intensity says.
    pub record: Estimate,
    /// Of the wall: some layouts are weaker than others.
    pub wall: Estimate,
    /// Of the pair: a layout may suit one record and not another.
    pub interaction: Estimate,
    /// Of the single trial: what lets a wall stand at a higher intensity of the same record.
    pub rest: Estimate,
}

/// Shares by the method of moments, after the curve of the campaign is fitted.
///
/// Two trials that share a record have latent variables of the correlation share(record), two that share a wall share(wall), and two of
/// the same pair at different stripes 1 - share(rest). Each is the correlation at which what is expected is what is seen:
/// * of a shared record or wall, the variance between records or walls of generalised residuals phi (y - p) / (p (1 - p)), summed over the
///   stripes of each pair, in a two-way analysis of variance. The smaller of the two has the 95 % interval of Fisher's F, which is long
///   upwards: of five walls the spread may be 2.9 times what they show. The larger one is a ratio that cannot be so skew, and has the
///   interval of [Intervals](super#intervals);
/// * of a pair, the number of times that a wall stands above an intensity at which it collapses: near to a correlation of 1 that count
///   depends on the rest alone, and residuals on everything else. Its interval is the score interval of a Poisson mean, with the number of
///   independent pairs that are worth as much as these (after Korn and Graubard 1998), as it must hold where nothing is seen as well.
///
/// The interaction is what the others leave; its interval follows from that of what neither record nor wall explains and from that of the
/// rest, taken for independent (Zou and Donner 2008).
///
/// In simulated campaigns of 10 to 20 records, 5 to 10 walls and 6 stripes the intervals hold the share of the record in 85 to 97 of 100, of
/// the wall in 96 to 98, of the interaction in 98 to 100, and of the rest in 89 to 100. The value of a small rest is mostly 0, as stripes
/// show it by few events or none, and the interaction's is larger by as much.
///
/// The fit is repeated without each record, wall and pair: some 30 ms for 20 records, 5 walls and 6 stripes, and as the square of the
/// number of pairs for more.
pub fn shares(campaign: &Campaign) -> Shares {
    const NOTHING: Shares = Shares {
        record: Estimate::UNDEFINED,
        wall: Estimate::UNDEFINED,
        interaction: Estimate::UNDEFINED,
        rest: Estimate::UNDEFINED,
    };
    found(campaign).unwrap_or(NOTHING)
}

fn found(campaign: &Campaign) -> Option<Shares> {
    let order = campaign.order();
    let reached =
        Reached::of(&probit_curve(&campaign.points(&order, &vec![1.0; campaign.crossed().pairs()]))?, &order);
    let [record, wall] = by_variance(campaign, &order, &reached)?;
    let rest = by_violations(campaign, &order, &reached)?;
    let [of_record, of_wall, others] = campaign.crossed().estimates(|weights| {
        let part = campaign.kept(weights);
        let order = part.order();
        let curve = probit_curve(&part.points(&order, &vec![1.0; part.crossed().pairs()]))?;
        let [record, wall] = by_variance(&part, &order, &Reached::of(&curve, &order))?
            .map(|own| own.value.unwrap_or(f64::NAN));
        Some([record, wall, 1.0 - record - wall])
    });
    let [record, wall] = if record.value >= wall.value { [of_record, wall] } else { [record, of_wall] };
    Some(Shares { record, wall, interaction: difference(others, rest)?, rest })
}

/// The difference of two estimates that are taken for independent (Zou and Donner 2008).
fn difference(a: Estimate, b: Estimate) -> Option<Estimate> {
    let (value, taken) = (a.value?, b.value?);
    let interval = a.interval.zip(b.interval).map(|(a, b)| {
        let reach = |x: f64, y: f64| (x * x + y * y).sqrt();
        let middle = value - taken;
        [middle - reach(value - a[0], b[1] - taken), middle + reach(a[1] - value, taken - b[0])]
    });
    Some(Estimate { value: Some(value - taken), interval })
}

/// A correlation that is so small is what rounding leaves of 0, as of walls that all do the same.
const ROUNDING: f64 = 1e-12;
/// Terms of the series in the correlation. At 0.9 what is left out is below 1e-4 of the whole.
const TERMS: usize = 40;

/// Correlations of trials that share a record (and no wall), and a wall (and no record).
///
/// The expected product of two generalised residuals is a power series of the correlation: that of Mehler (1866), whose n-th term is
/// w(eta) He_(n-1)(eta) / root of n! at the one trial times the same at the other, with w = phi^2 / (p (1 - p)).
fn by_variance(campaign: &Campaign, order: &Order, reached: &Reached) -> Option<[Estimate; 2]> {
    let outcomes = campaign.outcomes();
    let [records, walls] = [campaign.records(), campaign.walls()];
    if records < 2 || walls < 2 {
        return None;
    }
    let residuals = summed(campaign, |cell, wall| {
        outcomes[cell * walls + wall].map_or(0.0, |outcome| {
            let y = outcome.collapses();
            let [hit, miss] = reached.at[order.places[cell]].ratios;
            y * hit - (1.0 - y) * miss
        })
    });
    let mut terms: Vec<[f64; 2]> = reached.at.iter().map(|at| [0.0, at.weight()]).collect();
    let mut series = Vec::with_capacity(TERMS);
    for n in 1..=TERMS {
        let values = summed(campaign, |cell, wall| {
            if outcomes[cell * walls + wall].is_some() { terms[order.places[cell]][1] } else { 0.0 }
        });
        series.push(products(&values, walls));
        let n = n as f64;
        for (term, eta) in terms.iter_mut().zip(&reached.eta) {
            *term = [term[1], (eta * term[1] - (n - 1.0) / n.sqrt() * term[0]) / (n + 1.0).sqrt()];
        }
    }
    let [between_records, between_walls, rest] = mean_squares(&residuals, walls);
    let estimate = |kind: usize, clusters: usize, others: usize, between: f64| {
        let expected = |rho: f64| series.iter().rev().fold(0.0, |sum, term| (sum + term[kind]) * rho);
        // Of the covariance of two pairs of the same cluster.
        let covariance = |between: f64| (between - rest) / others as f64;
        let correlation = |own: f64| {
            let rho = bisected([-1.0, 1.0], |rho| expected(rho) < own);
            if rho.abs() < ROUNDING { 0.0 } else { rho }
        };
        let [low, high] = fisher((clusters - 1) as f64, ((records - 1) * (walls - 1)) as f64);
        let [value, low, high] = [1.0, high, low].map(|by| correlation(covariance(between / by)));
        let interval = Some([low, high]);
        (series[0][kind] > 0.0).then_some(Estimate { value: Some(value), interval })
    };
    Some([estimate(0, records, walls, between_records)?, estimate(1, walls, records, between_walls)?])
}

/// Sum over the stripes of each pair, by record, then wall.
fn summed(campaign: &Campaign, value: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let (stripes, walls) = (campaign.stripes(), campaign.walls());
    let own = |pair: usize| {
        let first = pair / walls * stripes;
        (first..first + stripes).map(|cell| value(cell, pair % walls)).sum()
    };
    (0..campaign.records() * walls).map(own).collect()
}

/// Mean products of the values of two pairs that share a record (and no wall), and a wall (and no record).
fn products(values: &[f64], walls: usize) -> [f64; 2] {
    let records = values.len() / walls;
    let squares: f64 = values.iter().map(|own| own * own).sum();
    let [rows, columns] = sums(values, walls).map(|own| own.iter().map(|own| own * own).sum::<f64>());
    let pairs = values.len() as f64;
    [(rows - squares) / (pairs * (walls - 1) as f64), (columns - squares) / (pairs * (records - 1) as f64)]
}

/// Sums by record and by wall.
fn sums(values: &[f64], walls: usize) -> [Vec<f64>; 2] {
    let rows = values.chunks(walls).map(|row| row.iter().sum()).collect();
    let columns = (0..walls).map(|wall| values.iter().skip(wall).step_by(walls).sum()).collect();
    [rows, columns]
}

/// Mean squares between records, between walls, and of the rest.
fn mean_squares(values: &[f64], walls: usize) -> [f64; 3] {
    let records = values.len() / walls;
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let [rows, columns] = sums(values, walls);
    let row = |record: usize| rows[record] / walls as f64 - mean;
    let column = |wall: usize| columns[wall] / records as f64 - mean;
    let rest = |pair: usize| values[pair] - mean - row(pair / walls) - column(pair % walls);
    let total = |of: &dyn Fn(usize) -> f64, n: usize| (0..n).map(|own| of(own) * of(own)).sum::<f64>();
    let (free_records, free_walls) = ((records - 1) as f64, (walls - 1) as f64);
    [
        walls as f64 * total(&row, records) / free_records,
        records as f64 * total(&column, walls) / free_walls,
        total(&rest, values.len()) / (free_records * free_walls),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Streams;
    use crate::stats::fragility::violations::Violations;
    use crate::stats::fragility::{Latent, Outcome};

    const STRIPES: [f64; 6] = [0.45, 0.62, 0.85, 1.17, 1.6, 2.2];

    fn drawn(records: usize, walls: usize, deviations: [f64; 4], seed: u64) -> Campaign {
        let planned =
            Campaign::of_stripes(&STRIPES, records, walls, vec![Some(Outcome::Stands); records * walls * 6]);
        Latent { theta: 1.0, deviations }.drawn(&planned, &mut Streams::new(seed, 0).of("shares"))
    }

    /// Values of many clusters, which are known better: without intervals, which would take minutes.
    #[test]
    fn known_shares_are_recovered() {
        let deviations = [0.3, 0.2, 0.15, 0.15];
        let all: f64 = deviations.iter().map(|own| own * own).sum();
        let campaign = drawn(150, 150, deviations, 3);
        let order = campaign.order();
        let curve = probit_curve(&campaign.points(&order, &vec![1.0; 150 * 150])).unwrap();
        let reached = Reached::of(&curve, &order);
        let [record, wall] = by_variance(&campaign, &order, &reached).unwrap().map(|own| own.value.unwrap());
        let violations = Violations::of(&campaign, &order, &reached, &vec![1.0; 150 * 150]);
        let rest = violations.rest(violations.seen).unwrap();
        for (found, own) in [(record, 0.3), (wall, 0.2), (rest, 0.15)] {
            // A variance from 150 draws is known to the root of 2/149, 12 %; three of these, of a share whose total moves along with it.
            assert!(
                (found - own * own / all).abs() < 0.36 * own * own / all * (1.0 - own * own / all) + 0.01,
                "{found} {own}"
            );
        }
    }

    #[test]
    fn nothing_is_not_taken_for_something() {
        let has_nought =
            |estimate: Estimate| estimate.interval.is_some_and(|[low, high]| low <= 0.0 && high >= 0.0);
        let found = shares(&drawn(20, 5, [0.0, 0.0, 0.0, 0.4], 5));
        assert!(
            has_nought(found.record) && has_nought(found.wall) && has_nought(found.interaction),
            "{found:?}"
        );
        let found = shares(&drawn(20, 5, [0.4, 0.0, 0.0, 0.0], 5));
        assert!(
            has_nought(found.wall) && has_nought(found.interaction) && has_nought(found.rest),
            "{found:?}"
        );
        assert!(found.record.interval.unwrap()[0] > 0.3, "{found:?}");
        let one_wall = shares(&drawn(20, 1, [0.4, 0.0, 0.0, 0.1], 5));
        assert_eq!(one_wall.record, Estimate::UNDEFINED);
    }
}
