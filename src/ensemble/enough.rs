//! When an arm has walls enough: its walls are looked at a few times, at numbers that are fixed beforehand, and the first look that
//! knows the statistic well enough is the last.

use crate::ensemble::{Observed, Quantity, Row, Task};
use crate::stats::{Estimate, Looks, Statistic, relative_half_width};
use crate::study::{Study, Until};

/// Above all values: a wall that stood to the end of its load path.
const ABOVE: f64 = 1e100;

/// What the last look at an arm saw, at one stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// What is asked of the walls.
    pub until: Until,
    /// The statistic with its interval, in the unit of the quantity.
    pub estimate: Estimate,
    /// What the interval of this look may miss (a probability): the looks share 5 %.
    pub miss: f64,
    /// Half the width of the interval over the statistic; `None` where one of them is not defined.
    pub half_width: Option<f64>,
}

impl Look {
    /// At the values of walls, and at how many more stood to the end.
    pub fn at(until: Until, values: &[f64], stood: usize) -> Look {
        let miss = Looks::up_to(until.at_most).miss();
        let estimate = match until.of {
            // Of walls whose values are not known there are no moments.
            Statistic::Mean | Statistic::Sigma if stood > 0 => Estimate::UNDEFINED,
            Statistic::Quantile(_) if stood > 0 => {
                let all: Vec<f64> = values.iter().copied().chain((0..stood).map(|_| ABOVE)).collect();
                let known = |value: &f64| *value < 0.1 * ABOVE;
                let Estimate { value, interval } = until.of.of(&all, miss);
                Estimate { value: value.filter(known), interval: interval.filter(|[_, high]| known(high)) }
            }
            of => of.of(values, miss),
        };
        Look { until, estimate, miss, half_width: relative_half_width(estimate) }
    }

    /// Whether the statistic is known well enough.
    pub fn is_enough(&self) -> bool {
        self.half_width.is_some_and(|half| half < self.until.below)
    }
}

/// The number of walls of each arm at its first look; all of an arm whose number is fixed.
pub(super) fn first_looks(study: &Study) -> Vec<u64> {
    let first = |until: Until| Looks::up_to(until.at_most).sizes()[0];
    study.arms.iter().map(|arm| arm.until.map_or(arm.members, first)).collect()
}

/// The number of walls of each arm after a look at those that it has; `None` where all have enough, or may have no more.
pub(super) fn next_looks<'r>(
    study: &Study,
    members: &[u64],
    row: &dyn Fn(Task) -> Option<&'r Row>,
) -> Option<Vec<u64>> {
    let next = |index: usize, own: u64| {
        let arm = &study.arms[index];
        let Some(until) = arm.until else { return own };
        let quantity = Quantity::of(study);
        let enough = |point: usize| {
            let task = |member| Task { arm: index as u32, point: point as u32, member };
            let seen: Vec<Observed> =
                (0..own).filter_map(|member| Some(quantity.observed(row(task(member))?))).collect();
            let values: Vec<f64> = seen
                .iter()
                .filter_map(|seen| if let Observed::Value(value) = seen { Some(*value) } else { None })
                .collect();
            let stood = seen.iter().filter(|seen| matches!(seen, Observed::Above(_))).count();
            Look::at(until, &values, stood).is_enough()
        };
        match (0..arm.kn_points.len()).all(enough) {
            true => own,
            false => {
                Looks::up_to(until.at_most).sizes().iter().copied().find(|size| *size > own).unwrap_or(own)
            }
        }
    };
    let more: Vec<u64> = members.iter().enumerate().map(|(index, own)| next(index, *own)).collect();
    (more != members).then_some(more)
}

/// The study with the number of walls that each arm came to, by the rows of its run.
pub fn come_to(mut study: Study, rows: &[Row]) -> Study {
    for (arm, index) in study.arms.iter_mut().zip(0u32..).filter(|(arm, _)| arm.until.is_some()) {
        arm.members = rows.iter().filter(|row| row.arm_index == index && row.point == 0).count() as u64;
    }
    study
}
