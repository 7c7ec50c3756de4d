//! Outcomes of walls under records at several intensities.

use super::crossed::Crossed;
use super::probit::Point;
use crate::math::ln;
use crate::stats::Estimate;
use crate::stats::empirical::clopper_pearson;

/// How one wall came through one record at one intensity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It collapsed.
    Collapsed,
    /// It stands.
    Stands,
    /// A start that differs by rounding gives the other verdict: chance decides.
    ///
    /// It counts as half a collapse. To leave it out would take away the trials next to the capacity and no others, so that the curve
    /// came out too steep.
    Undecided,
}

impl Outcome {
    /// What it counts as a collapse: 0, 1/2 or 1.
    pub fn collapses(self) -> f64 {
        match self {
            Outcome::Collapsed => 1.0,
            Outcome::Stands => 0.0,
            Outcome::Undecided => 0.5,
        }
    }
}

/// Outcomes of records x stripes x walls. Every wall meets every record at every stripe; what was not run, or brought no verdict, is
/// `None` and says nothing.
///
/// A stripe is one intensity level of each record. In the measure that the records are scaled by, a stripe has the same intensity for all
/// records; in another measure (the peak velocity, where peak accelerations were scaled) each record has its own.
///
/// A stronger record need not topple what a weaker one did, so that the intensities at which a pair of record and wall collapses are a
/// set. No first collapse is looked for: every trial counts at its own intensity.
///
/// ```
/// use pirca::stats::fragility::{Campaign, Outcome};
/// // Two records at three stripes, one wall; the second record topples it at 2 and not at 3.
/// let (yes, no) = (Some(Outcome::Collapsed), Some(Outcome::Stands));
/// let campaign = Campaign::of_stripes(&[1.0, 2.0, 3.0], 2, 1, vec![no, no, yes, no, yes, no]);
/// assert_eq!(campaign.counts().not_monotone, 1);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Campaign {
    records: usize,
    stripes: usize,
    walls: usize,
    intensities: Vec<f64>,
    outcomes: Vec<Option<Outcome>>,
}

/// How many trials ended how, and how many pairs are not monotone.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Counts {
    /// Trials in which the wall collapsed.
    pub collapsed: usize,
    /// Trials in which it stands.
    pub stands: usize,
    /// Trials that are undecided; each counts as half a collapse.
    pub undecided: usize,
    /// Trials without an outcome.
    pub without: usize,
    /// Pairs of record and wall with two decided trials or more: those that could show it.
    pub pairs: usize,
    /// Pairs in which the wall stands at an intensity above one at which it collapses.
    pub not_monotone: usize,
    /// Their share of the pairs, with its 95 % interval over records and walls; see
    /// [Intervals](super#intervals). Where no pair is so, or each, the interval is that of Clopper and Pearson with as many
    /// trials as there are records.
    pub share_not_monotone: Estimate,
}

/// Trials at one intensity, whoever shared them.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Stripe {
    /// Intensity, in the unit of the measure; above 0.
    pub intensity: f64,
    /// How many trials; weights need not be whole.
    pub trials: f64,
    /// How many of them collapsed.
    pub collapsed: f64,
}

impl Stripe {
    pub(super) fn point(&self, place: f64) -> Point {
        Point { place, trials: self.trials, hits: self.collapsed }
    }
}

impl Campaign {
    /// A campaign whose stripes have an intensity for each record: `intensities` by record, then stripe; `outcomes` by record, then stripe,
    /// then wall. Intensities must be above 0 and finite; the lengths must agree.
    pub fn new(
        intensities: Vec<f64>,
        records: usize,
        walls: usize,
        outcomes: Vec<Option<Outcome>>,
    ) -> Campaign {
        crate::check!(records > 0 && walls > 0, "{records} records and {walls} walls");
        let stripes = intensities.len() / records;
        crate::check!(
            stripes > 0 && intensities.len() == records * stripes,
            "{} intensities of {records} records",
            intensities.len()
        );
        crate::check!(
            outcomes.len() == intensities.len() * walls,
            "{} outcomes of {records} records, {stripes} stripes and {walls} walls",
            outcomes.len()
        );
        for (index, x) in intensities.iter().enumerate() {
            crate::check!(*x > 0.0 && x.is_finite(), "intensity {index} is {x}");
        }
        Campaign { records, stripes, walls, intensities, outcomes }
    }

    /// A campaign whose stripes have the same intensity for all records; `outcomes` by record, then stripe, then wall.
    pub fn of_stripes(
        intensities: &[f64],
        records: usize,
        walls: usize,
        outcomes: Vec<Option<Outcome>>,
    ) -> Campaign {
        Campaign::new(intensities.repeat(records), records, walls, outcomes)
    }

    /// The same outcomes by another measure of the same records; intensities by record, then stripe.
    pub fn measured(&self, intensities: Vec<f64>) -> Campaign {
        Campaign::new(intensities, self.records, self.walls, self.outcomes.clone())
    }

    /// Number of records.
    pub fn records(&self) -> usize {
        self.records
    }

    /// Number of stripes of each record.
    pub fn stripes(&self) -> usize {
        self.stripes
    }

    /// Number of walls.
    pub fn walls(&self) -> usize {
        self.walls
    }

    /// Intensities by record, then stripe.
    pub fn intensities(&self) -> &[f64] {
        &self.intensities
    }

    /// Outcomes by record, then stripe, then wall.
    pub fn outcomes(&self) -> &[Option<Outcome>] {
        &self.outcomes
    }

    /// How the trials ended.
    pub fn counts(&self) -> Counts {
        let of = |wanted: Option<Outcome>| self.outcomes.iter().filter(|own| **own == wanted).count();
        let shown: Vec<Option<bool>> = (0..self.records * self.walls)
            .map(|pair| self.is_monotone(pair / self.walls, pair % self.walls))
            .collect();
        let pairs = shown.iter().flatten().count();
        let not_monotone = shown.iter().filter(|own| **own == Some(false)).count();
        let share = |weights: &[f64]| {
            let (mut all, mut not) = (0.0, 0.0);
            for (weight, is_monotone) in weights.iter().zip(&shown) {
                all += weight * f64::from(u8::from(is_monotone.is_some()));
                not += weight * f64::from(u8::from(*is_monotone == Some(false)));
            }
            (all > 0.0).then(|| [not / all])
        };
        let edge = |hits: usize| Estimate {
            value: Some(hits as f64 / self.records as f64),
            interval: Some(clopper_pearson(hits, self.records)),
        };
        let share_not_monotone = match (pairs, not_monotone) {
            (0, _) => Estimate::UNDEFINED,
            (_, 0) => edge(0),
            (all, not) if all == not => edge(self.records),
            _ => {
                let [Estimate { value, interval }] = self.crossed().estimates(share);
                Estimate { value, interval: interval.map(|ends| ends.map(|end| end.clamp(0.0, 1.0))) }
            }
        };
        Counts {
            collapsed: of(Some(Outcome::Collapsed)),
            stands: of(Some(Outcome::Stands)),
            undecided: of(Some(Outcome::Undecided)),
            without: of(None),
            pairs,
            not_monotone,
            share_not_monotone,
        }
    }

    /// Whether no wall stands above an intensity that it collapses at; `None` below two decided trials.
    fn is_monotone(&self, record: usize, wall: usize) -> Option<bool> {
        let (mut decided, mut lowest, mut highest) = (0, f64::INFINITY, 0.0_f64);
        for stripe in 0..self.stripes {
            let x = self.intensities[record * self.stripes + stripe];
            match self.outcomes[(record * self.stripes + stripe) * self.walls + wall] {
                Some(Outcome::Collapsed) => lowest = lowest.min(x),
                Some(Outcome::Stands) => highest = highest.max(x),
                Some(Outcome::Undecided) | None => continue,
            }
            decided += 1;
        }
        (decided > 1).then_some(lowest >= highest)
    }

    /// The trials by intensity, ascending.
    pub fn by_intensity(&self) -> Vec<Stripe> {
        let order = self.order();
        let points = self.points(&order, &vec![1.0; self.records * self.walls]);
        let mut stripes: Vec<Stripe> = Vec::new();
        for (point, x) in points.iter().zip(&order.distinct) {
            if point.trials > 0.0 {
                stripes.push(Stripe { intensity: *x, trials: point.trials, collapsed: point.hits });
            }
        }
        stripes
    }

    /// The campaign without the pairs of weight 0, and without the records and walls that no pair is left of.
    pub(super) fn kept(&self, weights: &[f64]) -> Campaign {
        let has = |record: usize, wall: usize| weights[record * self.walls + wall] > 0.0;
        let all = |n: usize, is_kept: &dyn Fn(usize) -> bool| {
            (0..n).filter(|own| is_kept(*own)).collect::<Vec<_>>()
        };
        let records = all(self.records, &|record| (0..self.walls).any(|wall| has(record, wall)));
        let walls = all(self.walls, &|wall| (0..self.records).any(|record| has(record, wall)));
        let (mut intensities, mut outcomes) = (Vec::new(), Vec::new());
        for &record in &records {
            for cell in record * self.stripes..(record + 1) * self.stripes {
                intensities.push(self.intensities[cell]);
                let outcome =
                    |wall: &usize| self.outcomes[cell * self.walls + wall].filter(|_| has(record, *wall));
                outcomes.extend(walls.iter().map(outcome));
            }
        }
        Campaign { records: records.len(), stripes: self.stripes, walls: walls.len(), intensities, outcomes }
    }

    /// Records and walls as clusters that cross.
    pub(super) fn crossed(&self) -> Crossed {
        Crossed::new(self.records, &[self.walls])
    }

    /// The different intensities and where each record and stripe belongs.
    pub(super) fn order(&self) -> Order {
        let mut distinct = self.intensities.clone();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        let place = |x: &f64| distinct.partition_point(|own| own < x);
        let places = self.intensities.iter().map(place).collect();
        let logs = distinct.iter().map(|x| ln(*x)).collect();
        Order { distinct, logs, places }
    }

    /// Trials and collapses at each of the different intensities over ln x, with a weight for each pair of record and wall (by record,
    /// then wall).
    pub(super) fn points(&self, order: &Order, weights: &[f64]) -> Vec<Point> {
        let mut points: Vec<Point> =
            order.logs.iter().map(|place| Point { place: *place, trials: 0.0, hits: 0.0 }).collect();
        for (cell, (place, own)) in order.places.iter().zip(self.outcomes.chunks(self.walls)).enumerate() {
            let weights = &weights[cell / self.stripes * self.walls..][..self.walls];
            for (outcome, weight) in own.iter().zip(weights) {
                if let Some(outcome) = outcome {
                    points[*place].trials += weight;
                    points[*place].hits += weight * outcome.collapses();
                }
            }
        }
        points
    }
}

/// The different intensities of a campaign.
#[derive(Clone, Debug)]
pub(super) struct Order {
    /// Ascending.
    pub distinct: Vec<f64>,
    /// Their logarithms.
    pub logs: Vec<f64>,
    /// Which of them a record has at a stripe, by record, then stripe.
    pub places: Vec<usize>,
}

#[cfg(test)]
mod tests {
    use super::*;

    const YES: Option<Outcome> = Some(Outcome::Collapsed);
    const NO: Option<Outcome> = Some(Outcome::Stands);
    const OPEN: Option<Outcome> = Some(Outcome::Undecided);

    #[test]
    fn trials_count_at_their_intensity_and_undecided_ones_by_half() {
        // Two records, three stripes, two walls; the second record is 1.5 times as strong at each stripe.
        let outcomes = vec![NO, NO, YES, OPEN, None, YES, NO, YES, YES, NO, YES, YES];
        let campaign = Campaign::new(vec![1.0, 2.0, 3.0, 1.5, 3.0, 4.5], 2, 2, outcomes);
        let found = campaign.by_intensity();
        let own = |intensity: f64, trials: f64, collapsed: f64| Stripe { intensity, trials, collapsed };
        assert_eq!(
            found,
            [
                own(1.0, 2.0, 0.0),
                own(1.5, 2.0, 1.0),
                own(2.0, 2.0, 1.5),
                own(3.0, 3.0, 2.0),
                own(4.5, 2.0, 2.0)
            ]
        );
        let counts = campaign.counts();
        assert_eq!((counts.collapsed, counts.stands, counts.undecided, counts.without), (6, 4, 1, 1));
        // The second wall collapses under the second record at 1.5 and stands at 3.
        assert_eq!((counts.pairs, counts.not_monotone), (4, 1));
        assert_eq!(counts.share_not_monotone.value, Some(0.25));
    }

    #[test]
    fn no_pair_that_is_not_monotone_is_bounded_by_the_number_of_records() {
        let monotone = Campaign::of_stripes(&[1.0, 2.0], 12, 3, [NO, NO, NO, YES, YES, NO].repeat(12));
        let share = monotone.counts().share_not_monotone;
        assert_eq!((share.value, share.interval), (Some(0.0), Some(clopper_pearson(0, 12))));
        let falling = Campaign::of_stripes(&[1.0, 2.0], 12, 1, [YES, NO].repeat(12));
        assert_eq!(falling.counts().share_not_monotone.interval, Some(clopper_pearson(12, 12)));
        let single = Campaign::of_stripes(&[1.0], 2, 1, vec![YES, NO]);
        assert_eq!(single.counts().share_not_monotone, Estimate::UNDEFINED);
    }

    #[test]
    fn what_is_kept_are_the_pairs_with_weight() {
        let outcomes = vec![NO, YES, OPEN, YES, YES, YES, NO, NO, NO, OPEN, YES, NO];
        let campaign = Campaign::of_stripes(&[1.0, 2.0], 2, 3, outcomes);
        let kept = campaign.kept(&[0.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
        let known = Campaign::of_stripes(&[1.0, 2.0], 2, 2, vec![None, YES, None, YES, NO, NO, OPEN, YES]);
        assert_eq!(kept, known);
    }

    #[test]
    fn lengths_and_intensities_are_checked() {
        let refused = |intensities: &[f64], outcomes: usize| {
            std::panic::catch_unwind(|| Campaign::new(intensities.to_vec(), 2, 1, vec![NO; outcomes]))
                .is_err()
        };
        assert!(!refused(&[1.0, 2.0], 2));
        assert!(refused(&[1.0, 2.0], 3) && refused(&[1.0, 2.0, 3.0], 3) && refused(&[], 0));
        assert!(refused(&[1.0, 0.0], 2) && refused(&[f64::NAN, 1.0], 2) && refused(&[f64::INFINITY, 1.0], 2));
    }
}
