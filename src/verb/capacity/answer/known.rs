//! What walls tell of a question, those included that brought no value or stood to the end.

use crate::stats;
use crate::stats::{EmpiricalStep, clopper_pearson};
use crate::verb::capacity::answer::{Question, Rung};

/// Beyond all values: what a wall that brought none counts at worst, and at best.
const BEYOND: f64 = 1e100;

/// What is known of walls.
pub(crate) struct Known {
    /// Values of those that brought one.
    pub values: Vec<f64>,
    /// What the values of those that stood to the end lie above.
    pub above: Vec<f64>,
    /// How many brought none.
    pub lost: u64,
    /// Whether a high value is the worse one.
    pub worse_is_high: bool,
}

/// What walls tell of a question.
#[derive(Default)]
pub(crate) struct Told {
    pub answer: Option<f64>,
    /// How many of them tell it.
    pub told: usize,
    pub interval: Option<[f64; 2]>,
    /// The interval if all that tell nothing had been on the worse side, and on the better one.
    pub if_failed: Option<[f64; 2]>,
    pub if_not: Option<[f64; 2]>,
}

impl Known {
    /// The share of walls on the worse side of each value that was found, with Clopper and Pearson's interval.
    pub fn rungs(&self) -> Vec<Rung> {
        let sign = if self.worse_is_high { -1.0 } else { 1.0 };
        let values: Vec<f64> = self.values.iter().map(|value| sign * value).collect();
        let rung = |step: EmpiricalStep| Rung {
            run: None,
            level: sign * step.value,
            probability: step.probability,
            interval: Some(step.pointwise),
        };
        stats::empirical(&values, &self.above).into_iter().map(rung).collect()
    }

    /// What they tell of a question.
    pub fn answer(&self, question: Question) -> Told {
        match question {
            Question::Below(level) => self.share(&|value| value < level, level),
            Question::Above(level) => {
                let Told { answer, told, interval, if_failed, if_not } =
                    self.share(&|value| value <= level, level);
                let turned = |[low, high]: [f64; 2]| [1.0 - high, 1.0 - low];
                Told {
                    answer: answer.map(|share| 1.0 - share),
                    told,
                    interval: interval.map(turned),
                    // What counts as above a level is not below it.
                    if_failed: if_not.map(turned),
                    if_not: if_failed.map(turned),
                }
            }
            Question::Quantile(share) => self.quantile(share),
        }
    }

    /// The share of walls with a value on the lower side of a level. A wall that stood to a lower end than the level says nothing.
    fn share(&self, is_below: &dyn Fn(f64) -> bool, level: f64) -> Told {
        let below = self.values.iter().filter(|value| is_below(**value)).count();
        let stood = self.above.iter().filter(|end| **end >= level).count();
        let silent = self.above.len() - stood + self.lost as usize;
        let told = self.values.len() + stood;
        if told == 0 {
            return Told::default();
        }
        Told {
            answer: Some(below as f64 / told as f64),
            told,
            interval: Some(clopper_pearson(below, told)),
            if_failed: Some(clopper_pearson(below + silent, told + silent)),
            if_not: Some(clopper_pearson(below, told + silent)),
        }
    }

    /// The value that a share of all walls lie below. Walls that stood to the end are above all that fell.
    fn quantile(&self, share: f64) -> Told {
        let with = |lost: Option<f64>| {
            let stood = self.above.iter().map(|_| BEYOND);
            let lost = lost.into_iter().flat_map(|at| (0..self.lost).map(move |_| at));
            self.values.iter().copied().chain(stood).chain(lost).collect::<Vec<f64>>()
        };
        let finite = |value: f64| value.abs() < 0.1 * BEYOND;
        let within = |ends: &[f64; 2]| ends.iter().all(|end| finite(*end));
        let all = with(None);
        if all.len() as f64 * share.min(1.0 - share) < 1.0 {
            // No wall in the mean lies beyond it: what is between the last two says nothing of it.
            return Told::default();
        }
        let ends = |lost: Option<f64>| stats::quantile_interval(&with(lost), share).filter(within);
        let [worse, better] = if self.worse_is_high { [BEYOND, -BEYOND] } else { [-BEYOND, BEYOND] };
        Told {
            answer: stats::quantile(&all, share).filter(|value| finite(*value)),
            told: all.len(),
            interval: ends(None),
            if_failed: ends(Some(worse)),
            if_not: ends(Some(better)),
        }
    }
}
