//! Which measurement would separate what these data cannot: each of a menu is simulated under every cause that is still possible,
//! and judged by the information about the cause that it brings, and what it costs.

use rayon::prelude::*;

use crate::critic::advise::information::information;
use crate::critic::advise::menu::{FINE, MENU, Offer, Per, finest, planned};
use crate::critic::simulate::Truth;
use crate::critic::verdict::Judge;
use crate::math::ln;
use crate::stats;

/// Below so much that is not known of the cause (bit) nothing is offered.
const OPEN: f64 = 0.01;
/// Standard errors to either end of a 95 % interval of a mean over many campaigns.
const NORMAL: f64 = 1.96;

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::advise::information::Information;
    use crate::critic::fixture::{EFFORT, judged, made};
    use crate::critic::simulate::Design;
    use crate::math::radians;
    use crate::random::Streams;
    use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};

    #[test]
    #[ignore = "slow: 50 s of processor time"]
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
        let indistinct = offers(judge, &[draws("end_release", 1.0), draws("cohesion", 1.0)], 6);
        assert!(indistinct.iter().all(|own| own.bits < 0.15), "{indistinct:?}");
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
        assert!(
            bits(&back, Offer::Remainders) > 0.8 && bits(&indistinct, Offer::Remainders) < 0.15,
            "{back:?}"
        );
        let turned = planned(Offer::TurnedWalls, judge, FINE).expect("they can be turned");
        assert!(turned.specimens.len() == 9 && turned.specimens.iter().all(|own| own.turned));
        assert!(turned.specimens.iter().flat_map(|own| &own.readings).all(|m| m.tilt.is_some()));
        // A wall that leans moves a little further before its fall, turned round a little less.
        let leans = offers(judge, &[draws("lean", 1.5), draws("lean", -1.5)], 6);
        assert!(
            bits(&leans, Offer::TurnedWalls) > 0.07 && bits(&indistinct, Offer::TurnedWalls) < 0.05,
            "{leans:?}"
        );
        // The interval holds the number, and is within what is open.
        for own in [&offered, &indistinct, &weighed, &still, &back, &leans].into_iter().flatten() {
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
    #[ignore = "slow: 50 s of processor time"]
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
