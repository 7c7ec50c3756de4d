//! Which measurement would separate what these data cannot: each of a menu is simulated under every cause that is still possible,
//! and judged by the information about the cause that it brings, and what it costs.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::critic::causes::softmax;
use crate::critic::compare::reading_variance;
use crate::critic::discrepancy::{Feature, Scale, features};
use crate::critic::simulate::{Design, Specimen, Truth};
use crate::critic::verdict::Judge;
use crate::math::{ln, radians};
use crate::random::Streams;
use crate::stats;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};

/// Campaigns of each cause.
const SIMULATED: u64 = 240;
/// Campaigns of the base model that scale them.
const SCALING: u64 = 200;
/// Ridge on the covariance of features, in their variance.
const RIDGE: f64 = 0.05;
/// Random error of a displacement read with a dial gauge (m), unless the campaign was read better.
const FINE: f64 = 0.3e-3;
/// Below so much that is not known of the cause (bit) nothing is offered.
const OPEN: f64 = 0.01;
/// Random error of a weight, as a share of it.
const WEIGHED: f64 = 5e-3;
/// Standard errors to either end of a 95 % interval of a mean over many campaigns.
const NORMAL: f64 = 1.96;

/// A measurement that could be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Offer {
    /// kn (10 %) and friction angle (1 deg) of two stones' joints, of every family.
    TwoStones,
    /// The weight of a specimen of every family, to 0.5 %.
    Weights,
    /// What the gauge shows of a target that does not move, read [finely](Offered::fine).
    FixedTarget,
    /// What is left at three points, read [finely](Offered::fine), when the platform goes back from the largest tilt of the
    /// campaign's readings, on as many specimens of every family as there were.
    Remainders,
    /// The readings of the campaign but its collapse angles, on walls that are turned round.
    TurnedWalls,
    /// Six readings up to 3 deg at three points, read [finely](Offered::fine), on as many specimens of every family as there were.
    LowTilts,
    /// The tilts of the campaign once more at three points, read [finely](Offered::fine).
    FinerReadings,
    /// What the campaign reads of displacements at every degree up to the largest tilt, with its errors.
    MoreTilts,
    /// As many specimens again, read as these were.
    MoreSpecimens,
}

/// What hours are counted by.
#[derive(Clone, Copy)]
enum Per {
    Campaign,
    Family,
    Specimen,
}

/// All offers with what they cost, in hours of two people (our estimate).
const MENU: [(Offer, f64, Per); 9] = [
    (Offer::FixedTarget, 0.5, Per::Campaign),
    (Offer::Weights, 0.33, Per::Family),
    (Offer::TwoStones, 0.67, Per::Family),
    (Offer::Remainders, 0.55, Per::Specimen),
    (Offer::LowTilts, 0.65, Per::Specimen),
    (Offer::TurnedWalls, 1.0, Per::Specimen),
    (Offer::FinerReadings, 0.9, Per::Specimen),
    (Offer::MoreTilts, 0.8, Per::Specimen),
    (Offer::MoreSpecimens, 4.5, Per::Specimen),
];

/// What an offer is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offered {
    /// The measurement.
    pub offer: Offer,
    /// Hours of two people, for as many families or specimens as it is made on.
    pub hours: f64,
    /// Random error of a displacement that is read finely (m): that of a dial gauge, or of the campaign's own readings where these
    /// are better.
    pub fine: f64,
    /// Expected information about the cause (bit).
    pub bits: f64,
    /// Its 95 % interval, of the campaigns that it was counted on.
    pub interval: [f64; 2],
    /// What is not known of the cause before (bit).
    pub of: f64,
}

/// Judges the menu for causes with their probabilities and draws of what is true under each; the most information per hour first. A
/// pure function of its arguments. Stones are drawn anew: what these specimens showed of their own stones is not used.
pub fn offers(judge: &Judge<'_>, possible: &[(f64, Vec<Truth>)], seed: u64) -> Vec<Offered> {
    let sum = stats::sum(&possible.iter().map(|(p, _)| *p).collect::<Vec<_>>());
    let weights: Vec<f64> = possible.iter().map(|(p, _)| p / sum).collect();
    let entropy = -stats::sum(&weights.iter().map(|w| w * ln(w.max(1e-12))).collect::<Vec<_>>());
    if possible.len() < 2 || entropy < OPEN * ln(2.0) {
        return Vec::new();
    }
    let fine = finest(&judge.design).map_or(FINE, |own| own.min(FINE));
    let mut offered: Vec<Offered> = MENU
        .par_iter()
        .filter_map(|&(offer, hours, per)| {
            let design = planned(offer, judge, fine)?;
            let found = information(judge, &design, possible, &weights, entropy, seed);
            let times = match per {
                Per::Campaign => 1,
                Per::Family => judge.design.families().len(),
                Per::Specimen => design.specimens.len(),
            };
            let hours = hours * times as f64;
            let [bits, error, of] = [found.value, found.error, entropy].map(|nats| nats / ln(2.0));
            let interval = [-NORMAL, NORMAL].map(|side| (bits + side * error).clamp(0.0, of));
            Some(Offered { offer, hours, fine, bits: bits.clamp(0.0, of), interval, of })
        })
        .collect();
    offered.sort_by(|a, b| (b.bits / b.hours).total_cmp(&(a.bits / a.hours)));
    offered
}

/// The standard deviation of the best displacement of a campaign, rounding included (m).
fn finest(design: &Design) -> Option<f64> {
    let readings = design.specimens.iter().flat_map(|specimen| &specimen.readings);
    let errors = readings.filter(|m| m.tilt.is_some()).map(|m| reading_variance(m).sqrt());
    errors.filter(|error| *error > 0.0).reduce(f64::min)
}

/// The readings of an offer, displacements with such an error where they are read finely; `None` where it adds nothing to a design.
fn planned(offer: Offer, judge: &Judge<'_>, fine: f64) -> Option<Design> {
    use MeasuredQuantity as Q;
    let design = &judge.design;
    let mut new = Design { specimens: Vec::new(), apart: Vec::new(), unused: Vec::new() };
    let pattern = design.specimens.iter().flat_map(|specimen| &specimen.readings).next()?;
    let reading = |quantity, tilt: Option<f64>, error: f64| Measurement {
        quantity,
        tilt,
        error,
        kind: MeasuredKind::Exact,
        common_error: 0.0,
        unknown_share: false,
        resolution: 0.0,
        ..pattern.clone()
    };
    let middle = judge.world.truth(None, &vec![0.0; judge.world.inputs(None)]);
    let points = [Q::DisplacementLeft, Q::DisplacementCentre, Q::DisplacementRight];
    let finely = |points: [Q; 3], tilts: &[f64]| -> Vec<Measurement> {
        tilts.iter().flat_map(|tilt| points.map(|point| reading(point, Some(*tilt), fine))).collect()
    };
    let largest = |own: &Specimen| own.tilts().last().copied().filter(|tilt| *tilt > 0.0);
    let again = |readings: &dyn Fn(&Specimen) -> Vec<Measurement>| -> Vec<Specimen> {
        let specimens = design.specimens.iter();
        specimens.map(|own| Specimen { readings: readings(own), ..own.clone() }).collect()
    };
    match offer {
        Offer::Weights => {
            for family in design.families() {
                let mut weight = reading(Q::SpecimenWeight, None, 0.0);
                weight.error = WEIGHED * judge.world.apart(family, &weight, &middle);
                new.apart.push((family, weight));
            }
        }
        Offer::FixedTarget => {
            let family = design.specimens.first()?.family;
            new.apart.push((family, reading(Q::FixedTarget, None, fine)));
        }
        Offer::TwoStones => {
            for family in design.families() {
                let mut kn = reading(Q::JointKn, None, 0.0);
                kn.error = 0.1 * judge.world.apart(family, &kn, &middle);
                new.apart.push((family, kn));
                new.apart.push((family, reading(Q::JointPhi, None, radians(1.0))));
            }
        }
        Offer::Remainders => {
            let left = [Q::RemainderLeft, Q::RemainderCentre, Q::RemainderRight];
            new.specimens = again(&|own| finely(left, largest(own).as_slice()));
        }
        Offer::TurnedWalls => {
            new.specimens = again(&|own| own.readings.iter().filter(|m| m.tilt.is_some()).cloned().collect());
            new.specimens.retain(|own| judge.world.can_turn(own.family));
            new.specimens.iter_mut().for_each(|own| own.turned = true);
        }
        Offer::LowTilts => {
            let tilts = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0].map(radians);
            new.specimens = again(&|_| finely(points, &tilts));
        }
        Offer::FinerReadings => {
            let is_fine = |own: &Specimen, m: &Measurement| {
                let read = |other: &Measurement| (other.quantity, other.tilt) == (m.quantity, m.tilt);
                own.readings.iter().any(|other| read(other) && reading_variance(other) <= fine * fine)
            };
            new.specimens = again(&|own| {
                let all = finely(points, &own.tilts());
                if all.iter().all(|m| is_fine(own, m)) { Vec::new() } else { all }
            });
        }
        Offer::MoreTilts => {
            new.specimens = again(&|own| {
                let largest = largest(own).unwrap_or(0.0);
                let mut patterns: Vec<&Measurement> = Vec::new();
                for m in own.readings.iter().filter(|m| m.tilt.is_some() && !m.quantity.is_remainder()) {
                    if patterns.iter().all(|known| known.quantity != m.quantity) {
                        patterns.push(m);
                    }
                }
                let degrees = (1..90).map(|deg| radians(f64::from(deg)));
                let tilts = degrees.take_while(|tilt| *tilt <= largest + 1e-9);
                let at = |tilt: f64| {
                    patterns.iter().map(move |m| Measurement { tilt: Some(tilt), ..(*m).clone() })
                };
                tilts.flat_map(at).collect()
            });
        }
        Offer::MoreSpecimens => new.specimens.clone_from(&design.specimens),
    }
    new.specimens.retain(|specimen| !specimen.readings.is_empty());
    (!new.specimens.is_empty() || !new.apart.is_empty()).then_some(new)
}

/// Expected information (nat), and its standard error.
#[derive(Default)]
struct Information {
    value: f64,
    error: f64,
}

impl Information {
    /// An entropy less a cross entropy: `logs` are the logarithms of the probability of the right class, of campaigns of each.
    fn of(entropy: f64, weights: &[f64], logs: &[Vec<f64>]) -> Information {
        let (mut value, mut variance) = (entropy, 0.0);
        for (weight, own) in weights.iter().zip(logs) {
            value += weight * stats::mean(own).unwrap_or(0.0);
            let sigma = weight * stats::sigma(own).unwrap_or(0.0);
            variance += sigma * sigma / own.len() as f64;
        }
        Information { value, error: variance.sqrt() }
    }
}

/// Expected information of new readings about the cause: its entropy less the mean cross entropy of a Gaussian classifier on
/// campaigns that it has not seen, which can only be too little.
fn information(
    judge: &Judge<'_>,
    design: &Design,
    possible: &[(f64, Vec<Truth>)],
    weights: &[f64],
    entropy: f64,
    seed: u64,
) -> Information {
    let shown = |truth: &Truth, k: u64| judge.world.campaign(design, truth, &Streams::new(seed, k));
    let scaling: Vec<_> = (0..SCALING)
        .map(|k| shown(&judge.world.drawn(None, &Streams::new(seed.wrapping_add(1), k)), k))
        .collect();
    let scale = Scale::of(design, &scaling);
    let seen: Vec<Vec<BTreeMap<Feature, f64>>> = possible
        .iter()
        .enumerate()
        .map(|(class, (_, draws))| {
            let draw = |k: u64| &draws[Streams::new(seed, k).of("offer").below(draws.len())];
            let first = class as u64 * SIMULATED;
            (0..SIMULATED).map(|k| features(design, &scale, &shown(draw(k), first + k))).collect()
        })
        .collect();
    let mut names: Vec<Feature> = seen.iter().flatten().flat_map(|found| found.keys().copied()).collect();
    names.sort();
    names.dedup();
    let vector = |found: &BTreeMap<Feature, f64>| {
        let tamed = |x: f64| x.signum() * ln(1.0 + x.abs());
        DVector::from_iterator(
            names.len(),
            names.iter().map(|name| tamed(found.get(name).copied().unwrap_or(0.0))),
        )
    };
    let points: Vec<Vec<DVector<f64>>> = seen.iter().map(|own| own.iter().map(vector).collect()).collect();
    // Learnt from the even campaigns, judged on the odd ones.
    let normals: Vec<Normal> =
        points.iter().filter_map(|own| Normal::of(&own.iter().step_by(2).collect::<Vec<_>>())).collect();
    if normals.len() < points.len() {
        return Information::default();
    }
    let judged = |(class, own): (usize, &Vec<DVector<f64>>)| -> Vec<f64> {
        let logs = own.iter().skip(1).step_by(2).map(|point| {
            let joint: Vec<f64> =
                normals.iter().zip(weights).map(|(normal, w)| normal.log(point) + ln(w.max(1e-12))).collect();
            // A classifier that is sure and wrong tells as little as one that knows nothing.
            ln(softmax(&joint, 1.0)[class]).max(ln(weights[class].max(1e-12)) - 1.0)
        });
        logs.collect()
    };
    Information::of(entropy, weights, &points.iter().enumerate().map(judged).collect::<Vec<_>>())
}

/// A normal distribution of features.
struct Normal {
    mean: DVector<f64>,
    lower: nalgebra::Cholesky<f64, nalgebra::Dyn>,
    half_log_determinant: f64,
}

impl Normal {
    fn of(points: &[&DVector<f64>]) -> Option<Normal> {
        let n = points.len() as f64;
        let size = points.first()?.len();
        let mean = points.iter().fold(DVector::zeros(size), |sum, point| sum + *point) / n;
        let mut covariance: DMatrix<f64> = DMatrix::zeros(size, size);
        for point in points {
            let off = *point - &mean;
            covariance += &off * off.transpose() / n;
        }
        for k in 0..size {
            covariance[(k, k)] = covariance[(k, k)] * (1.0 + RIDGE) + 1e-4;
        }
        let lower = covariance.cholesky()?;
        let half_log_determinant = (0..size).fold(0.0, |sum, k| sum + ln(lower.l_dirty()[(k, k)]));
        Some(Normal { mean, lower, half_log_determinant })
    }

    fn log(&self, point: &DVector<f64>) -> f64 {
        let off = point - &self.mean;
        -0.5 * off.dot(&self.lower.solve(&off)) - self.half_log_determinant
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::{EFFORT, judged, made};
    use crate::critic::simulate::Design;

    #[test]
    fn a_measurement_that_tells_causes_apart_brings_what_is_open_and_others_bring_nothing() {
        let (made, judge) = judged();
        let world = judge.world;
        let draws = |name: &str, score: f64| -> (f64, Vec<Truth>) {
            let cause = Some(made.cause(name));
            let one = |k: u64| {
                let mut truth = world.drawn(cause, &Streams::new(81, k));
                truth.parameters.iter_mut().for_each(|own| *own = score);
                truth
            };
            (0.5, (0..100).map(one).collect())
        };
        // In the made-up bank creep moves every wall, cohesion none, and two stones show neither.
        let offered = offers(judge, &[draws("creep", 1.5), draws("cohesion", 0.0)], 6);
        let of = |wanted: Offer| offered.iter().find(|own| own.offer == wanted).expect("in the menu");
        println!("{offered:?}");
        assert!((of(Offer::FinerReadings).of - 1.0).abs() < 1e-9);
        assert!(of(Offer::FinerReadings).bits > 0.8 && of(Offer::TwoStones).bits < 0.1);
        let alike = offers(judge, &[draws("end_release", 1.0), draws("cohesion", 1.0)], 6);
        assert!(alike.iter().all(|own| own.bits < 0.15), "{alike:?}");
        // Nor does density move any, but it weighs.
        let weighed = offers(judge, &[draws("density", 1.0), draws("cohesion", 1.0)], 6);
        assert!(weighed[0].offer == Offer::Weights && weighed[0].bits > 0.9, "{weighed:?}");
        assert!(weighed[1..].iter().all(|own| own.bits < 0.15), "{weighed:?}");
        // A gauge that has moved by 5 mm shows it on what stands still, which a wall that leans does not.
        let still = offers(judge, &[draws("gauge_offset", 1.0), draws("lean", 0.0)], 6);
        assert!(still[0].offer == Offer::FixedTarget && still[0].bits > 0.9, "{still:?}");
        assert!(weighed.iter().all(|own| own.offer != Offer::FixedTarget || own.bits < 0.05), "{weighed:?}");
        // What has crept does not come back.
        let bits = |offered: &[Offered], wanted: Offer| {
            offered.iter().find(|own| own.offer == wanted).expect("in the menu").bits
        };
        let back = offers(judge, &[draws("creep", 1.5), draws("cohesion", 1.5)], 6);
        assert!(bits(&back, Offer::Remainders) > 0.8 && bits(&alike, Offer::Remainders) < 0.15, "{back:?}");
        let turned = planned(Offer::TurnedWalls, judge, FINE).expect("they can be turned");
        assert!(turned.specimens.len() == 9 && turned.specimens.iter().all(|own| own.turned));
        assert!(turned.specimens.iter().flat_map(|own| &own.readings).all(|m| m.tilt.is_some()));
        // A wall that leans moves a little further before its fall, turned round a little less.
        let leans = offers(judge, &[draws("lean", 1.5), draws("lean", -1.5)], 6);
        assert!(
            bits(&leans, Offer::TurnedWalls) > 0.1 && bits(&alike, Offer::TurnedWalls) < 0.05,
            "{leans:?}"
        );
        // The interval holds the number, and is within what is open.
        for own in [&offered, &alike, &weighed, &still, &back, &leans].into_iter().flatten() {
            let [low, high] = own.interval;
            assert!(0.0 <= low && low <= own.bits && own.bits <= high && high <= own.of, "{own:?}");
        }
        // The most information per hour comes first.
        let worth: Vec<f64> = offered.iter().map(|own| own.bits / own.hours).collect();
        assert!(worth.windows(2).all(|pair| pair[0] >= pair[1]));
        assert_eq!(offers(judge, &[draws("creep", 1.0)], 6), []);
    }

    #[test]
    fn information_is_as_sure_as_its_campaigns_are_many_and_alike() {
        // Means of -0.2 and -0.4; standard deviations of 0.1 root 2 over the root of two, and of 0.2 over the root of three.
        let Information { value, error } =
            Information::of(0.6, &[0.25, 0.75], &[vec![-0.1, -0.3], vec![-0.2, -0.4, -0.6]]);
        assert!((value - (0.6 - 0.25 * 0.2 - 0.75 * 0.4)).abs() < 1e-12, "{value}");
        let squares = 0.25 * 0.25 * 0.01 + 0.75 * 0.75 * 0.04 / 3.0;
        assert!((error * error - squares).abs() < 1e-12, "{error}");
    }

    #[test]
    fn an_offer_is_read_no_worse_than_the_campaign_and_costs_by_the_wall() {
        let made = made();
        let world = made.world();
        let mut study = made.study.clone();
        // One wall, read finely at three points.
        let of_family = |m: &Measurement| m.specimen.ends_with('1') && m.tilt.is_some();
        let pattern = study.measured.iter().find(|m| of_family(m)).expect("it is read").clone();
        let tilts = [4.0, 8.0].map(radians);
        let points = [
            MeasuredQuantity::DisplacementLeft,
            MeasuredQuantity::DisplacementCentre,
            MeasuredQuantity::DisplacementRight,
        ];
        study.measured = tilts
            .iter()
            .flat_map(|tilt| {
                let fine = Measurement {
                    error: 1e-4,
                    resolution: 0.0,
                    kind: MeasuredKind::Exact,
                    ..pattern.clone()
                };
                points.map(|quantity| Measurement { quantity, tilt: Some(*tilt), ..fine.clone() })
            })
            .collect();
        let (design, _) = Design::of(&study);
        let judge = Judge::trained(&world, &design, EFFORT, 5).expect("it can be told");
        assert_eq!(finest(&design), Some(1e-4));
        assert_eq!(planned(Offer::FinerReadings, &judge, 1e-4), None);
        // Every degree up to 8, at all three points.
        let more = planned(Offer::MoreTilts, &judge, 1e-4).expect("it adds readings");
        let read = |quantity| more.specimens[0].readings.iter().filter(|m| m.quantity == quantity).count();
        assert_eq!(points.map(read), [8, 8, 8]);
        let draws = |score: f64| -> (f64, Vec<Truth>) {
            let mut truth = world.drawn(Some(made.cause("creep")), &Streams::new(81, 1));
            truth.parameters[0] = score;
            (0.5, vec![truth])
        };
        let offered = offers(&judge, &[draws(-1.0), draws(1.0)], 6);
        let of = |wanted: Offer| offered.iter().find(|own| own.offer == wanted);
        assert!(offered.iter().all(|own| own.fine == 1e-4), "{offered:?}");
        assert_eq!(of(Offer::FinerReadings), None);
        // One wall, one family.
        assert_eq!(of(Offer::MoreSpecimens).map(|own| own.hours), Some(4.5));
        assert_eq!(of(Offer::TwoStones).map(|own| own.hours), Some(0.67));
    }
}
