//! One arm of a comparison: its walls, what they bear, and how they fail.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::ensemble::{Contest, Quantity, Row, is_random};
use crate::stats;
use crate::stats::{EmpiricalStep, Estimate, Summary, empirical};
use crate::verb::question::Question;
use crate::verb::run::answer::figure::Ladder;
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::undecided::LeftOpen;

/// One arm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SelectedArm {
    /// Its name.
    pub name: String,
    /// Whether anything is drawn.
    pub random: bool,
    /// Stiffness of its joints (Pa/m).
    pub kn_pa_per_m: f64,
    /// Walls that were evaluated.
    pub walls: u64,
    /// Walls that stood to the end of the load path; they count as failing there.
    pub stood_to_the_end: u64,
    /// Walls that brought no value, by why.
    pub failed: BTreeMap<String, u64>,
    /// Walls whose value rigid blocks leave open: it is an upper end. Left out where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_open: Option<LeftOpen>,
    /// The probability or the quantile that is asked for; null where the mean is.
    pub answer: Option<f64>,
    /// The mean of the walls that brought a value, with Student's 95 % interval for these walls as if their number had been fixed.
    pub mean: Estimate,
    /// Their coefficient of variation.
    pub cov: Option<f64>,
    /// Walls by the mechanism that they fell by.
    pub failure_modes: BTreeMap<String, u64>,
    /// Mean height of the hinge, or of the plane of sliding, above the foot (m).
    pub hinge_height_m: Option<f64>,
    /// Mean share of the weight that moves.
    pub moving_weight_share: Option<f64>,
    /// Mean share of the wall's length that moves.
    pub moving_length_share: Option<f64>,
    /// The distribution of its values.
    #[serde(skip)]
    pub steps: Vec<EmpiricalStep>,
    /// Its place among the arms of the study, which gives it its colour.
    #[serde(skip)]
    pub place: usize,
}

impl SelectedArm {
    /// The arm with this index, from the rows of a contest.
    pub fn of(contest: &Contest<'_>, index: u32, rows: &[Row], question: Option<Question>) -> SelectedArm {
        let arm = &contest.study.arms[index as usize];
        let kn = arm.kn_points[contest.point as usize];
        let quantity = Quantity::of(contest.study);
        let own: Vec<&Row> = rows.iter().filter(|row| row.arm_index == index).collect();
        let walls = own.len() as u64;
        let mut population = Population::new((&arm.name, !is_random(arm)), (kn, walls), quantity, 1, &[]);
        own.iter().for_each(|row| population.take(row));
        let values: Vec<f64> = [population.values.values(), &population.above].concat();
        let summary = Summary::of(&values);
        let mean_of = |of: fn(&crate::ensemble::Mechanism) -> f64| {
            stats::mean(&own.iter().filter_map(|row| row.mechanism.as_ref().map(of)).collect::<Vec<f64>>())
        };
        SelectedArm {
            name: arm.name.clone(),
            random: is_random(arm),
            kn_pa_per_m: kn,
            walls,
            stood_to_the_end: population.above.len() as u64,
            failed: population.failed().into_iter().collect(),
            left_open: population.left_open(),
            answer: question.and_then(|question| answer(&values, question)),
            mean: summary.mean,
            cov: summary.cov.value,
            failure_modes: population.modes.clone(),
            hinge_height_m: mean_of(|m| m.hinge_height_m),
            moving_weight_share: mean_of(|m| m.weight_share),
            moving_length_share: mean_of(|m| m.length_share),
            steps: empirical(population.values.values(), &population.above),
            place: index as usize,
        }
    }

    /// Walls that brought no value.
    pub fn lost(&self) -> u64 {
        self.failed.values().sum()
    }

    /// The mechanism that most of its walls fell by, with the share of these.
    pub fn mode(&self) -> Option<(&str, f64)> {
        let all: u64 = self.failure_modes.values().sum();
        let most = self.failure_modes.iter().max_by_key(|(_, count)| **count);
        most.map(|(mode, count)| (mode.as_str(), *count as f64 / all as f64))
    }

    /// Its distribution as it is drawn.
    pub fn ladder(&self, quantity: Quantity) -> Ladder {
        let shown = |step: &EmpiricalStep| EmpiricalStep { value: quantity.shown(step.value), ..*step };
        Ladder {
            arm: self.name.clone(),
            place: self.place,
            random: self.random,
            kn: self.kn_pa_per_m,
            walls: self.walls - self.lost(),
            lost: self.lost(),
            steps: self.steps.iter().map(shown).collect(),
        }
    }
}

fn answer(values: &[f64], question: Question) -> Option<f64> {
    let share = |is_worse: &dyn Fn(f64) -> bool| {
        let worse = values.iter().filter(|value| is_worse(**value)).count();
        (!values.is_empty()).then(|| worse as f64 / values.len() as f64)
    };
    match question {
        Question::Below(level) => share(&|value| value < level),
        Question::Above(level) => share(&|value| value > level),
        Question::Quantile(p) => stats::quantile(values, p),
    }
}
