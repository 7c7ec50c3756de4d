//! The walls of one kind: how many were evaluated, and what they answer.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::ensemble::{Draw, Quantity};
use crate::report::capacity::Question;
use crate::report::capacity::values::Supported;
use crate::report::population::Population;
use crate::stats::{self, Estimate, Shape, Summary, Variation, clopper_pearson};

/// Beyond all values: what a wall that brought none counts at worst, and at best.
const BEYOND: f64 = 1e100;

/// The walls of one kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CapacityGroup {
    /// The arm, or the family.
    pub name: String,
    /// Stiffness of the joints (Pa/m) of simulated walls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kn_pa_per_m: Option<f64>,
    /// Whether anything is drawn: walls that are all alike have no probability.
    pub random: bool,
    /// Walls that were evaluated.
    pub walls: u64,
    /// Walls whose value is known to lie above where their load path ended.
    pub stood_to_the_end: u64,
    /// Walls that brought no value, by why.
    pub failed: BTreeMap<String, u64>,
    /// The probability, or the quantile in the unit of the quantity; none where the walls do not tell.
    pub answer: Option<f64>,
    /// Its 95 % interval: of a probability Clopper and Pearson's, of a quantile that between two order statistics.
    pub interval: Option<[f64; 2]>,
    /// The interval if every wall that brought no value had been on the worse side, and on the better one; none where all brought one.
    pub interval_whatever_failed: Option<[f64; 2]>,
    /// How it was found: `plain`, every wall counts alike; `subset`, by subset simulation; `measured`, specimens alone.
    pub method: &'static str,
    /// Independent repeats that the interval comes from, of subset simulation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repeats: Option<Repeats>,
    /// Coefficient of variation of the walls, where all values are known.
    pub cov: Option<f64>,
    /// Values that the walls support, normal and lognormal; none where some value is not known, or nothing is drawn.
    pub supported: Vec<Supported>,
}

/// Independent runs of subset simulation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Repeats {
    /// The probability of each.
    pub probabilities: Vec<f64>,
    /// Coefficient of variation of their mean.
    pub cov: Option<f64>,
    /// Walls that were evaluated in all.
    pub evaluations: usize,
    /// Walls that brought no value: they count as on the better side.
    pub failed: usize,
    /// The weakest wall that was found, with its value.
    pub weakest: Option<(Draw, f64)>,
}

/// What is known of walls.
struct Known {
    values: Vec<f64>,
    above: Vec<f64>,
    lost: u64,
}

impl CapacityGroup {
    /// Simulated walls.
    pub fn simulated(own: &Population, question: Question, variation: Variation) -> CapacityGroup {
        let known = Known { values: own.ordered(), above: own.limits(), lost: own.lost() };
        let mut group = CapacityGroup::of(&own.arm, known, question, variation);
        group.kn_pa_per_m = Some(own.kn);
        group.random = !own.fixed;
        group.failed = own.failed().into_iter().collect();
        if own.fixed {
            (group.interval, group.interval_whatever_failed) = (None, None);
        }
        // A displacement is the worse the larger it is: its low fractiles are no capacity.
        if own.fixed || own.quantity == Quantity::TopDisplacement {
            group.supported.clear();
        }
        group
    }

    /// Specimens of a family: values that were read, bounds that they lie above, and how many lie below a bound.
    pub fn measured(
        family: &str,
        values: Vec<f64>,
        above: Vec<f64>,
        unread: u64,
        question: Question,
        variation: Variation,
    ) -> CapacityGroup {
        let mut group = CapacityGroup::of(family, Known { values, above, lost: unread }, question, variation);
        group.method = "measured";
        if unread > 0 {
            group.failed.insert("below a bound".to_owned(), unread);
        }
        group
    }

    /// The same answered by independent runs of subset simulation. The interval is Student's on their mean, above 0.
    pub fn by_subset(&mut self, repeats: Repeats, is_high: bool) {
        let Estimate { value, interval } = Summary::of_positive(&repeats.probabilities).mean;
        (self.answer, self.interval, self.interval_whatever_failed) = (value, interval, None);
        self.method = "subset";
        let signed = |(draw, value): (Draw, f64)| (draw, if is_high { -value } else { value });
        self.repeats = Some(Repeats { weakest: repeats.weakest.map(signed), ..repeats });
    }

    fn of(name: &str, known: Known, question: Question, variation: Variation) -> CapacityGroup {
        let (answer, interval, whatever) = known.answer(question);
        let complete = known.above.is_empty() && known.lost == 0;
        let shapes: &[Shape] = if complete { &[Shape::Normal, Shape::Lognormal] } else { &[] };
        CapacityGroup {
            name: name.to_owned(),
            kn_pa_per_m: None,
            random: true,
            walls: (known.values.len() + known.above.len()) as u64 + known.lost,
            stood_to_the_end: known.above.len() as u64,
            failed: BTreeMap::new(),
            answer,
            interval,
            interval_whatever_failed: whatever.filter(|_| known.lost > 0),
            method: "plain",
            repeats: None,
            cov: complete.then(|| stats::cov(&known.values)).flatten(),
            supported: shapes.iter().map(|shape| Supported::by(&known.values, *shape, variation)).collect(),
        }
    }
}

type Answer = (Option<f64>, Option<[f64; 2]>, Option<[f64; 2]>);

impl Known {
    fn answer(&self, question: Question) -> Answer {
        match question {
            Question::Below(level) => self.share(&|value| value < level, level),
            Question::Above(level) => {
                let (share, interval, whatever) = self.share(&|value| value <= level, level);
                let turned = |[low, high]: [f64; 2]| [1.0 - high, 1.0 - low];
                (share.map(|share| 1.0 - share), interval.map(turned), whatever.map(turned))
            }
            Question::Quantile(share) => self.quantile(share),
        }
    }

    /// The share of walls with a value on the lower side of a level. A wall that stood to a lower end than the level says nothing.
    fn share(&self, is_below: &dyn Fn(f64) -> bool, level: f64) -> Answer {
        let below = self.values.iter().filter(|value| is_below(**value)).count();
        let stood = self.above.iter().filter(|end| **end >= level).count();
        let silent = self.above.len() - stood + self.lost as usize;
        let told = self.values.len() + stood;
        if told == 0 {
            return (None, None, None);
        }
        let all = told + silent;
        let whatever = [clopper_pearson(below, all)[0], clopper_pearson(below + silent, all)[1]];
        (Some(below as f64 / told as f64), Some(clopper_pearson(below, told)), Some(whatever))
    }

    /// The value that a share of all walls lie below. Walls that stood to the end are above all that fell.
    fn quantile(&self, share: f64) -> Answer {
        let with = |lost: Option<f64>| {
            let stood = self.above.iter().map(|_| BEYOND);
            let lost = lost.into_iter().flat_map(|at| (0..self.lost).map(move |_| at));
            self.values.iter().copied().chain(stood).chain(lost).collect::<Vec<f64>>()
        };
        let finite = |value: f64| value.abs() < 0.1 * BEYOND;
        let within = |ends: [f64; 2]| ends.iter().all(|end| finite(*end));
        let told = with(None);
        if told.len() as f64 * share.min(1.0 - share) < 1.0 {
            // No wall in the mean lies beyond it: what is between the last two says nothing of it.
            return (None, None, None);
        }
        let ends = |values: &[f64]| stats::quantile_interval(values, share);
        let whatever =
            ends(&with(Some(-BEYOND))).zip(ends(&with(Some(BEYOND)))).map(|(low, high)| [low[0], high[1]]);
        (
            stats::quantile(&told, share).filter(|value| finite(*value)),
            ends(&told).filter(|ends| within(*ends)),
            whatever.filter(|ends| within(*ends)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: &[f64], above: &[f64], lost: u64, question: Question) -> CapacityGroup {
        let known = Known { values: values.to_vec(), above: above.to_vec(), lost };
        CapacityGroup::of("any", known, question, Variation::Unknown)
    }

    #[test]
    fn walls_that_failed_are_counted_bounded_and_never_dropped() {
        let values: Vec<f64> = (1..=98).map(f64::from).collect();
        let group = of(&values, &[], 2, Question::Below(10.5));
        assert_eq!((group.walls, group.answer), (100, Some(10.0 / 98.0)));
        assert_eq!(group.interval, Some(clopper_pearson(10, 98)));
        assert_eq!(
            group.interval_whatever_failed,
            Some([clopper_pearson(10, 100)[0], clopper_pearson(12, 100)[1]])
        );
        // What is not known has no moments.
        assert!(group.supported.is_empty() && group.cov.is_none());
        let whole = of(&values, &[], 0, Question::Below(10.5));
        assert!(whole.interval_whatever_failed.is_none() && whole.supported.len() == 2);
        let above = of(&values, &[], 2, Question::Above(10.0));
        assert_eq!(above.answer, Some(88.0 / 98.0));
    }

    #[test]
    fn a_wall_that_stood_to_the_end_is_above_the_levels_before_it_and_says_nothing_of_others() {
        let group = of(&[10.0, 12.0], &[30.0, 30.0], 0, Question::Below(20.0));
        assert_eq!((group.answer, group.interval_whatever_failed), (Some(0.5), None));
        let group = of(&[10.0, 12.0], &[15.0, 30.0], 0, Question::Below(20.0));
        assert_eq!(group.answer, Some(2.0 / 3.0));
        let median = of(&[10.0, 12.0, 14.0], &[30.0, 30.0], 0, Question::Quantile(0.25));
        assert_eq!(median.answer, Some(12.0));
        // The upper quantiles lie among those that stood.
        assert_eq!(of(&[10.0, 12.0], &[30.0, 30.0, 30.0], 0, Question::Quantile(0.9)).answer, None);
    }

    #[test]
    fn a_quantile_has_the_interval_of_its_order_statistics() {
        let values: Vec<f64> = (1..=200).map(f64::from).collect();
        let group = of(&values, &[], 0, Question::Quantile(0.05));
        assert_eq!(group.answer, stats::quantile(&values, 0.05));
        assert_eq!(group.interval, stats::quantile_interval(&values, 0.05));
        // Three lost walls may have been the weakest, or the strongest.
        let [low, high] =
            of(&values, &[], 3, Question::Quantile(0.05)).interval_whatever_failed.expect("200 walls");
        let [own_low, own_high] = group.interval.expect("200 walls");
        assert!(low < own_low && high >= own_high);
        let few = of(&values[..20], &[], 0, Question::Quantile(0.05));
        assert!(few.answer.is_some() && few.interval.is_none());
        assert_eq!(of(&values[..19], &[], 0, Question::Quantile(0.05)).answer, None);
    }
}
