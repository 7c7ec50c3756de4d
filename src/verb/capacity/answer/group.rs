//! The walls of one kind: how many were evaluated, and what they answer.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::ensemble::{Draw, Quantity};
use crate::stats;
use crate::stats::tally::Pooled;
use crate::stats::{Shape, Statistic, Variation};
use crate::study::Until;
use crate::verb::capacity::answer::known::{Known, Told};
use crate::verb::capacity::answer::values::Supported;
use crate::verb::capacity::answer::{Question, Rung};
use crate::verb::question::Answer;
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::stated_cov::StatedCov;
use crate::verb::run::answer::summary::EnoughEntry;
use crate::verb::run::answer::undecided::LeftOpenAnswer;

/// The walls of one kind, and what they answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CapacityGroup {
    /// The arm, or the family.
    pub name: String,
    /// Stiffness of the joints (Pa/m) of simulated walls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kn_pa_per_m: Option<f64>,
    /// Whether anything is drawn: walls that are all alike have no probability.
    pub random: bool,
    /// What was asked.
    pub question: Question,
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
    /// Its 95 % interval: of a probability Clopper and Pearson's, of a quantile that between two order statistics.
    pub interval: Option<[f64; 2]>,
    /// Coefficient of variation of the answer, of a probability above 0: by independent repeats where there are some, else that of a
    /// binomial share. It is no interval.
    pub cov: Option<f64>,
    /// Walls that were evaluated, by the name of the solver; none of specimens.
    pub evaluations: BTreeMap<&'static str, u64>,
    /// How it was found: `plain`, every wall counts alike; `stratified`, by walls that limit analysis sorted; `importance`, by walls with
    /// shifted parameters; `subset`, by subset simulation; `measured`, specimens alone.
    pub method: &'static str,
    /// Independent runs that the interval comes from, where the study's own walls did not tell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repeats: Option<Repeats>,
    /// The coefficient of variation that was asked for, and whether it was reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<Target>,
    /// Walls that brought no value.
    pub failed: Failed,
    /// Why there were walls enough, where they were added until the quantile was known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub enough: Option<EnoughEntry>,
    /// The same with what stiff joints bear in the place of values that rigid blocks leave open; left out where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_open: Option<LeftOpenAnswer>,
    /// Walls that count alike.
    pub walls: u64,
    /// Walls whose value is known to lie above where their load path ended.
    pub stood_to_the_end: u64,
    /// Coefficient of variation of the walls, where all values are known.
    pub walls_cov: Option<f64>,
    /// How the coefficient of variation that was stated agrees with the walls; none where none was stated, or some value is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stated_cov: Option<StatedCov>,
    /// Values that the walls support, normal and lognormal; where a stated variation is in doubt with it first and then without it. None
    /// where some value is not known, or nothing is drawn.
    pub supported: Vec<Supported>,
    /// Its place among the arms of the study, or among the families, which gives it its colour.
    #[serde(skip)]
    pub place: usize,
    /// The probability of the worse side over the level, by all walls alike and by each run: in the figure and its table.
    #[serde(skip)]
    pub rungs: Vec<Rung>,
}

/// How well a probability was to be known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Target {
    /// The largest coefficient of variation.
    pub cov: f64,
    /// Whether that of the answer is no larger.
    pub reached: bool,
}

/// Walls that brought no value: counted, bounded and never dropped.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Failed {
    /// How many.
    pub walls: u64,
    /// By why.
    pub by: BTreeMap<String, u64>,
    /// The interval of the answer if all of them had been on the worse side; `None` where there are none, or it has no end.
    pub interval_if_failed: Option<[f64; 2]>,
    /// The same if all of them had been on the better side.
    pub interval_if_not: Option<[f64; 2]>,
}

impl Failed {
    /// What holds the answer whatever they would have borne.
    pub fn whatever(&self) -> Option<[f64; 2]> {
        let ([a, b], [c, d]) = self.interval_if_failed.zip(self.interval_if_not)?;
        Some([a.min(c), b.max(d)])
    }
}

/// Independent runs of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Repeats {
    /// Its name.
    #[serde(skip)]
    pub method: &'static str,
    /// The probability of each.
    pub probabilities: Vec<f64>,
    /// Coefficient of variation of what they come to.
    pub cov: Option<f64>,
    /// An upper end that rests on nothing but how walls were drawn, where the interval rests on more: on limit analysis, on where a shift leads,
    /// or on chains that reach what they should.
    pub at_most: Option<f64>,
    /// Runs of subset simulation that were stuck: their chains hardly moved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stuck: Option<usize>,
    /// What chains kept of a wall's numbers from their first wall to their last, as a correlation; the largest of all levels and runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kept: Option<f64>,
    /// What their interval may miss: 0.05, or a part of it where runs were added until they were enough.
    pub miss: f64,
    /// Walls that were evaluated in all.
    pub evaluations: usize,
    /// Limit analyses of walls, where these were sorted by them.
    #[serde(skip)]
    pub limit_evaluations: usize,
    /// How they were sorted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub screen: Option<Screen>,
    /// Share of the variance of values that parameters explain, where these were shifted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub explained: Option<f64>,
    /// Walls that brought no value: they count as on the better side.
    #[serde(skip)]
    pub failed: usize,
    /// What the runs come to.
    #[serde(skip)]
    pub found: Pooled,
    /// The same if those had been on the worse side; of subset simulation their share of the walls that were drawn before any was moved is
    /// added.
    #[serde(skip)]
    pub if_failed: Pooled,
    /// The weakest wall that was found, with its value.
    pub weakest: Option<(Draw, f64)>,
    /// Its number, for `pirca wall --draw`.
    pub weakest_draw: Option<u64>,
    /// By run, the levels that it went down by, the last one the level asked for, each with its probability.
    #[serde(skip)]
    pub ladders: Vec<Vec<[f64; 2]>>,
    /// The number of the first wall that was found on the worse side.
    pub first_failed_draw: Option<u64>,
}

/// Limit analysis that walls were sorted by.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Screen {
    /// Correlation of limit and value on walls that enter no answer.
    pub rho: f64,
    /// How many these were.
    pub pilot_walls: usize,
    /// Walls with a limit above it (in the unit of the quantity) are expected to lie beyond the level by four standard deviations.
    pub bound: f64,
    /// Whether subset simulation by limit analysis went down to the bound first, so that no wall beyond it was solved.
    pub goes_down: bool,
    /// Walls beyond the bound that were solved all the same, and how many of them were on the worse side.
    pub beyond: [usize; 2],
    /// The largest limit of all walls that were found on the worse side. Near the bound, walls beyond it may have been missed.
    pub largest_on_worse_side: Option<f64>,
}

impl CapacityGroup {
    /// Simulated walls of an arm, solved by a solver of this name; `until` says when they were enough, if that was asked.
    pub fn simulated(
        own: &Population,
        question: Question,
        variation: Variation,
        solver: &'static str,
        until: Option<Until>,
    ) -> CapacityGroup {
        let known = Known {
            values: own.values.values().to_vec(),
            above: own.above.clone(),
            lost: own.lost(),
            worse_is_high: own.quantity == Quantity::TopDisplacement,
        };
        let mut group = CapacityGroup::of(&own.arm, known, question, variation);
        group.kn_pa_per_m = Some(own.kn);
        group.random = !own.fixed;
        group.failed.by = own.failed().into_iter().collect();
        group.evaluations.insert(solver, group.walls);
        if let (Question::Quantile(share), Some(until)) = (question, until)
            && until.of == Statistic::Quantile(share)
        {
            let entry = EnoughEntry::of(until, own);
            (group.interval, group.enough) = (entry.ci, Some(entry));
        }
        if own.fixed {
            (group.interval, group.cov) = (None, None);
            (group.failed.interval_if_failed, group.failed.interval_if_not) = (None, None);
        }
        // A displacement is the worse the larger it is: its low fractiles are no capacity.
        if own.fixed || own.quantity == Quantity::TopDisplacement {
            group.supported.clear();
            group.stated_cov = None;
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
        let known = Known { values, above, lost: unread, worse_is_high: false };
        let mut group = CapacityGroup::of(family, known, question, variation);
        group.method = "measured";
        if unread > 0 {
            group.failed.by.insert("below a bound".to_owned(), unread);
        }
        group
    }

    /// The same answered by independent runs, see [`Pooled`]. What they bound by nothing is bounded by the walls that count alike. Walls
    /// without a value count as on the better side; at worst all are on the worse one.
    pub fn by_repeats(&mut self, repeats: Repeats, solver: &'static str, is_high: bool) {
        let by_walls = self.interval.map(|[_, high]| [0.0, high]);
        let interval = repeats.found.interval.or(by_walls);
        let at_most = match repeats.screen {
            // No wall beyond the bound of limit analysis was solved but those that count alike.
            Some(Screen { goes_down: true, .. }) => by_walls.map(|[_, high]| high),
            _ => repeats.at_most,
        };
        let at_most = at_most.filter(|high| interval.is_some_and(|own| own[1] < *high));
        let repeats = Repeats { at_most, ..repeats };
        (self.answer, self.interval) = (Answer::to(self.question, Some(repeats.found.probability)), interval);
        self.cov = repeats.cov;
        self.method = repeats.method;
        *self.evaluations.entry(solver).or_default() += repeats.evaluations as u64;
        if let Some(screen) = repeats.screen {
            let limits = (repeats.limit_evaluations + screen.pilot_walls) as u64;
            *self.evaluations.entry("limit").or_default() += limits;
        }
        let had_failed = repeats.if_failed.interval.zip(interval);
        let had_failed = had_failed.map(|([_, high], [low, own])| [low, high.max(own).min(1.0)]);
        self.failed = Failed {
            walls: repeats.failed as u64,
            by: BTreeMap::from([("without a value".to_owned(), repeats.failed as u64)]),
            interval_if_failed: had_failed.filter(|_| repeats.failed > 0),
            interval_if_not: interval.filter(|_| repeats.failed > 0),
        };
        if repeats.failed == 0 {
            self.failed.by.clear();
        }
        let signed = |(draw, value): (Draw, f64)| (draw, if is_high { -value } else { value });
        let rung = |run: usize, [level, probability]: [f64; 2]| Rung {
            run: Some(run),
            level: if is_high { -level } else { level },
            probability,
            interval: None,
        };
        let ladders = repeats.ladders.iter().enumerate();
        self.rungs.extend(ladders.flat_map(|(run, ladder)| ladder.iter().map(move |own| rung(run, *own))));
        self.repeats = Some(Repeats { weakest: repeats.weakest.map(signed), ..repeats });
    }

    /// With what was asked for.
    pub fn aim(&mut self, cov: f64) {
        self.target = Some(Target { cov, reached: self.cov.is_some_and(|own| own <= cov) });
    }

    fn of(name: &str, known: Known, question: Question, variation: Variation) -> CapacityGroup {
        let Known { values, above, lost, .. } = &known;
        let Told { answer, told, interval, if_failed, if_not } = known.answer(question);
        let complete = above.is_empty() && *lost == 0;
        let stated_cov = match variation {
            Variation::Known(cov) if complete => StatedCov::of(cov, values),
            _ => None,
        };
        let is_doubted = stated_cov.as_ref().is_some_and(|own| own.doubted.is_some());
        let variations = if is_doubted { &[variation, Variation::Unknown][..] } else { &[variation] };
        let shapes = [Shape::Normal, Shape::Lognormal];
        let of = |variation: &Variation| shapes.map(|shape| Supported::by(values, shape, *variation));
        let supported = if complete { variations.iter().flat_map(of).collect() } else { Vec::new() };
        let share = answer.filter(|share| *share > 0.0 && !matches!(question, Question::Quantile(_)));
        CapacityGroup {
            name: name.to_owned(),
            kn_pa_per_m: None,
            random: true,
            question,
            answer: Answer::to(question, answer),
            interval,
            cov: share.map(|share| ((1.0 - share) / (share * told as f64)).sqrt()),
            evaluations: BTreeMap::new(),
            method: "plain",
            repeats: None,
            target: None,
            failed: Failed {
                walls: *lost,
                by: BTreeMap::new(),
                interval_if_failed: if_failed.filter(|_| *lost > 0),
                interval_if_not: if_not.filter(|_| *lost > 0),
            },
            enough: None,
            left_open: None,
            walls: (values.len() + above.len()) as u64 + lost,
            stood_to_the_end: above.len() as u64,
            walls_cov: complete.then(|| stats::cov(values)).flatten(),
            stated_cov,
            supported,
            place: 0,
            rungs: known.rungs(),
        }
    }

    /// Whether its walls can answer: they differ, and one alone shows no scatter. A specimen has that of its kind, if it is stated.
    pub(crate) fn is_spread(&self) -> bool {
        self.random && (self.walls > 1 || self.kn_pa_per_m.is_none())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::clopper_pearson;

    fn of(values: &[f64], above: &[f64], lost: u64, question: Question) -> CapacityGroup {
        let known = Known { values: values.to_vec(), above: above.to_vec(), lost, worse_is_high: false };
        CapacityGroup::of("any", known, question, Variation::Unknown)
    }

    #[test]
    fn walls_that_failed_are_counted_bounded_and_never_dropped() {
        let values: Vec<f64> = (1..=98).map(f64::from).collect();
        let group = of(&values, &[], 2, Question::Below(10.5));
        assert_eq!((group.walls, group.answer), (100, Answer::Probability(Some(10.0 / 98.0))));
        assert_eq!(group.interval, Some(clopper_pearson(10, 98)));
        assert_eq!(group.failed.interval_if_failed, Some(clopper_pearson(12, 100)));
        assert_eq!(group.failed.interval_if_not, Some(clopper_pearson(10, 100)));
        assert_eq!(group.failed.whatever(), Some([clopper_pearson(10, 100)[0], clopper_pearson(12, 100)[1]]));
        // Of 98 walls: sqrt(88/98 / 10).
        assert!((group.cov.expect("a share above 0") - (88.0 / 98.0 / 10.0_f64).sqrt()).abs() < 1e-12);
        // What is not known has no moments.
        assert!(group.supported.is_empty() && group.walls_cov.is_none());
        let whole = of(&values, &[], 0, Question::Below(10.5));
        assert!(whole.failed.whatever().is_none() && whole.supported.len() == 2);
        let above = of(&values, &[], 2, Question::Above(10.0));
        assert_eq!(above.answer.value(), Some(88.0 / 98.0));
        // Walls that count as above the level are on the worse side now.
        let [low, high] = clopper_pearson(10, 100);
        assert_eq!(above.failed.interval_if_failed, Some([1.0 - high, 1.0 - low]));
    }

    #[test]
    fn a_wall_that_stood_to_the_end_is_above_the_levels_before_it_and_says_nothing_of_others() {
        let group = of(&[10.0, 12.0], &[30.0, 30.0], 0, Question::Below(20.0));
        assert_eq!((group.answer.value(), group.failed.whatever()), (Some(0.5), None));
        let group = of(&[10.0, 12.0], &[15.0, 30.0], 0, Question::Below(20.0));
        assert_eq!(group.answer.value(), Some(2.0 / 3.0));
        let median = of(&[10.0, 12.0, 14.0], &[30.0, 30.0], 0, Question::Quantile(0.25));
        assert_eq!(median.answer.value(), Some(12.0));
        // The upper quantiles lie among those that stood.
        assert_eq!(of(&[10.0, 12.0], &[30.0, 30.0, 30.0], 0, Question::Quantile(0.9)).answer.value(), None);
    }

    #[test]
    fn a_quantile_has_the_interval_of_its_order_statistics() {
        let values: Vec<f64> = (1..=200).map(f64::from).collect();
        let group = of(&values, &[], 0, Question::Quantile(0.05));
        assert_eq!(group.answer, Answer::Quantile(stats::quantile(&values, 0.05)));
        assert_eq!(group.interval, stats::quantile_interval(&values, 0.05));
        // Three lost walls may have been the weakest, or the strongest.
        let [low, high] = of(&values, &[], 3, Question::Quantile(0.05)).failed.whatever().expect("200 walls");
        let [own_low, own_high] = group.interval.expect("200 walls");
        assert!(low < own_low && high >= own_high);
        let few = of(&values[..20], &[], 0, Question::Quantile(0.05));
        assert!(few.answer.value().is_some() && few.interval.is_none());
        assert_eq!(of(&values[..19], &[], 0, Question::Quantile(0.05)).answer.value(), None);
    }
}
