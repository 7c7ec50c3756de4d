//! The share of collapses as a curve that rises and is nothing else, and whether a lognormal one agrees with it.

use super::campaign::{Campaign, Order};
use super::latent::Latent;
use super::lognormal::{Lognormal, Method, maximum};
use super::probit::Point;
use super::shares::shares;
use crate::random::Stream;
use crate::random::standard_normal::cdf;
use crate::stats::Estimate;
use crate::stats::empirical::clopper_pearson;
use crate::stats::order::quantile_of_sorted;
use crate::stats::reference::student;

/// The isotonic curve at one intensity.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Step {
    /// The intensity.
    pub intensity: f64,
    /// Trials at it.
    pub trials: f64,
    /// The share of them that collapsed.
    pub share: f64,
    /// The isotonic curve with its pointwise 95 % band.
    pub probability: Estimate,
}

/// How far a lognormal curve lies from the isotonic one.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Agreement {
    /// The largest distance in probability, over the intensities of the trials.
    pub distance: f64,
    /// The intensity at which it is.
    pub intensity: f64,
    /// Probability of that distance or a larger one, were the curve lognormal: below 0.05 it is not. `None` where the shares of record
    /// and wall are not defined, which the trials of the null hypothesis are drawn with.
    pub p_value: Option<f64>,
    /// How many campaigns the probability rests on.
    pub drawn: usize,
}

/// The distribution-free curve: of all that do not fall, the one of greatest likelihood (pool adjacent violators; Ayer, Brunk, Ewing, Reid
/// and Silverman 1955). It is known at the intensities of the trials only; the steps are ascending.
///
/// The band holds at each intensity by itself. It is that of percentiles of curves of resampled records and walls (Owen 2007), each as far
/// out as Student's t with one degree of freedom less than there are records (Hesterberg 2015), because percentiles of few clusters are
/// too close. Where the curve is 0 or 1 no resample can show otherwise: its band reaches to that of Clopper and Pearson, each record
/// being one trial.
pub fn isotonic(campaign: &Campaign, replicates: usize, stream: &mut Stream) -> Vec<Step> {
    let order = campaign.order();
    let crossed = campaign.crossed();
    let points = campaign.points(&order, &vec![1.0; crossed.pairs()]);
    let curve = pooled(&points);
    let mut replicas = vec![Vec::with_capacity(replicates); points.len()];
    for _ in 0..replicates {
        let drawn = campaign.points(&order, &crossed.resampled(stream));
        for (own, value) in replicas.iter_mut().zip(pooled(&drawn)) {
            own.push(value);
        }
    }
    let n = campaign.records() as f64;
    let mut steps = Vec::new();
    for (place, (point, value)) in points.iter().zip(&curve).enumerate() {
        if point.trials == 0.0 {
            continue;
        }
        replicas[place].sort_by(f64::total_cmp);
        let ends = (campaign.records() > 1).then(|| tail(n)).and_then(|tail| {
            let low = quantile_of_sorted(&replicas[place], tail)?;
            Some([low, quantile_of_sorted(&replicas[place], 1.0 - tail)?])
        });
        let band = ends.map(|[low, high]| {
            let far = edge(campaign, &order, &curve, place);
            [if *value == 1.0 { low.min(far) } else { low }, if *value == 0.0 { high.max(far) } else { high }]
        });
        steps.push(Step {
            intensity: order.distinct[place],
            trials: point.trials,
            share: point.hits / point.trials,
            probability: Estimate { value: Some(*value), interval: band },
        });
    }
    steps
}

/// Percentile that stands for 2.5 % where `n` clusters are resampled: their spread is short by (n - 1) / n, and Student's.
fn tail(n: f64) -> f64 {
    cdf(-(n / (n - 1.0)).sqrt() * student(n - 1.0))
}

/// How far the probability may lie from a curve that is 0, or 1, at a place: the same outcome came of every record that was tried there
/// or, where it is 0, further up (where it is 1, further down) before the curve leaves that value.
fn edge(campaign: &Campaign, order: &Order, curve: &[f64], place: usize) -> f64 {
    let value = curve[place];
    let tells = |own: usize| curve[own] == value && if value == 0.0 { own >= place } else { own <= place };
    let stripes = campaign.stripes();
    let has_trial = |cell: usize| {
        campaign.outcomes()[cell * campaign.walls()..][..campaign.walls()].iter().any(Option::is_some)
    };
    let is_tried = |record: &usize| {
        (record * stripes..(record + 1) * stripes).any(|cell| tells(order.places[cell]) && has_trial(cell))
    };
    let n = (0..campaign.records()).filter(is_tried).count();
    if value == 0.0 { clopper_pearson(0, n)[1] } else { clopper_pearson(n, n)[0] }
}

/// Shares at the places that rise, each a mean of neighbours that would fall. A place without trials has the value before it, or after
/// it where there is none before.
fn pooled(points: &[Point]) -> Vec<f64> {
    // Hits, trials, and how many places they are of.
    let mut blocks: Vec<(f64, f64, usize)> = Vec::new();
    for point in points {
        let mut own = (point.hits, point.trials, 1);
        while let Some(&(hits, trials, places)) = blocks.last() {
            // Shares compared without division: trials may be none.
            if own.1 > 0.0 && trials > 0.0 && hits * own.1 < own.0 * trials {
                break;
            }
            own = (own.0 + hits, own.1 + trials, own.2 + places);
            blocks.pop();
        }
        blocks.push(own);
    }
    blocks.iter().flat_map(|(hits, trials, places)| std::iter::repeat_n(hits / trials, *places)).collect()
}

/// Whether a lognormal curve agrees with the isotonic one: their largest distance, and how often it is as large in campaigns that are drawn
/// from the lognormal curve with the shares of the variance that [`shares`] finds, and fitted as this one (a parametric bootstrap of records
/// and walls). `None` where there is no lognormal curve.
pub fn agreement(campaign: &Campaign, replicates: usize, stream: &mut Stream) -> Option<Agreement> {
    let (distance, intensity, curve) = apart(campaign)?;
    let found = shares(campaign);
    let parts = [found.record, found.wall, found.interaction, found.rest].map(|own| own.value);
    let drawn: Option<Vec<f64>> = parts.into_iter().collect::<Option<Vec<f64>>>().map(|parts| {
        let all: f64 = parts.iter().map(|own| own.max(0.0)).sum();
        let deviation = |own: f64| curve.beta * (own.max(0.0) / all).sqrt();
        let deviations = [0, 1, 2, 3].map(|own| deviation(parts[own]));
        let latent = Latent { theta: curve.theta, deviations };
        (0..replicates).filter_map(|_| apart(&latent.drawn(campaign, stream))).map(|own| own.0).collect()
    });
    let p_value = drawn.as_ref().map(|drawn| {
        let larger = drawn.iter().filter(|own| **own >= distance).count();
        (larger + 1) as f64 / (drawn.len() + 1) as f64
    });
    Some(Agreement { distance, intensity, p_value, drawn: drawn.map_or(0, |drawn| drawn.len()) })
}

/// Largest distance of the two curves, where it is, and the lognormal one.
fn apart(campaign: &Campaign) -> Option<(f64, f64, Lognormal)> {
    let order = campaign.order();
    let points = campaign.points(&order, &vec![1.0; campaign.crossed().pairs()]);
    let (curve, _) = maximum(&points, Method::Likelihood)?;
    let mut largest = (0.0, order.distinct[0]);
    for ((point, value), intensity) in points.iter().zip(pooled(&points)).zip(&order.distinct) {
        let distance = (value - curve.probability(*intensity)).abs();
        if point.trials > 0.0 && distance > largest.0 {
            largest = (distance, *intensity);
        }
    }
    Some((largest.0, largest.1, curve))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Streams;
    use crate::stats::fragility::Outcome;

    #[test]
    fn neighbours_that_fall_share_their_mean() {
        let points = |shares: &[(f64, f64)]| -> Vec<Point> {
            shares.iter().map(|(hits, trials)| Point { place: 0.0, trials: *trials, hits: *hits }).collect()
        };
        // 0.5, 0.2 and 0.3 fall; their mean, by trials, is 4.5 of 15, which the 0.1 before is below.
        let found = pooled(&points(&[(1.0, 10.0), (2.5, 5.0), (1.0, 5.0), (1.0, 5.0), (8.0, 10.0)]));
        assert_eq!(found, [0.1, 0.3, 0.3, 0.3, 0.8]);
        assert_eq!(pooled(&points(&[(3.0, 4.0), (2.0, 4.0), (1.0, 4.0)])), [0.5; 3]);
        assert_eq!(
            pooled(&points(&[(0.0, 0.0), (1.0, 4.0), (0.0, 0.0), (2.0, 4.0)])),
            [0.25, 0.25, 0.25, 0.5]
        );
    }

    /// A certain outcome of all records leaves the bound of as many independent trials.
    #[test]
    fn where_all_stand_or_all_collapse_the_band_counts_records() {
        let (yes, no) = (Some(Outcome::Collapsed), Some(Outcome::Stands));
        let rows = [vec![no, no, no, no, yes, no, yes, yes], vec![no, no, no, no, no, yes, yes, yes]];
        let outcomes: Vec<Option<Outcome>> = (0..10).flat_map(|record| rows[record % 2].clone()).collect();
        let campaign = Campaign::of_stripes(&[1.0, 2.0, 3.0, 4.0], 10, 2, outcomes);
        let steps = isotonic(&campaign, 100, &mut Streams::new(1, 0).of("band"));
        let ends: Vec<[f64; 2]> = steps.iter().map(|step| step.probability.interval.unwrap()).collect();
        assert_eq!(ends[0], [0.0, clopper_pearson(0, 10)[1]]);
        assert_eq!(ends[3], [clopper_pearson(10, 10)[0], 1.0]);
        assert!(ends[2][0] < 0.5 && ends[2][1] > 0.5);
        let one = Campaign::of_stripes(&[1.0, 2.0], 1, 2, vec![no, no, yes, no]);
        assert_eq!(isotonic(&one, 10, &mut Streams::new(1, 0).of("band"))[1].probability.interval, None);
    }

    #[test]
    fn a_curve_with_a_shelf_is_not_lognormal() {
        let planned =
            Campaign::of_stripes(&[0.25, 0.5, 1.0, 2.0, 4.0], 30, 10, vec![Some(Outcome::Stands); 1500]);
        let latent = Latent { theta: 1.0, deviations: [0.1, 0.05, 0.7, 0.0] };
        let mut stream = Streams::new(4, 0).of("agreement");
        let drawn = latent.drawn(&planned, &mut stream);
        let agrees = agreement(&drawn, 99, &mut stream).unwrap();
        assert!(agrees.p_value.unwrap() > 0.05, "{agrees:?}");
        // Half of the pairs collapse between 0.25 and 0.5, the others between 2 and 4.
        let shelf = |trial: usize| {
            let (pair, stripe) = ((trial % 10 * 7 + trial / 50 * 3) % 10, trial / 10 % 5);
            let collapses = if pair < 5 { stripe > 0 } else { stripe > 3 };
            Some(if collapses { Outcome::Collapsed } else { Outcome::Stands })
        };
        let shelved = Campaign::new(planned.intensities().to_vec(), 30, 10, (0..1500).map(shelf).collect());
        let found = agreement(&shelved, 99, &mut stream).unwrap();
        assert!(found.p_value.unwrap() <= 0.02 && found.distance > 0.1, "{found:?}");
    }
}
