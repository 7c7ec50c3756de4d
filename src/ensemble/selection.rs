//! The loop over rounds of a comparison: evaluate the walls that the last look asked for, look, and stop at the first answer or at the end
//! of the budget. A look depends on what was found alone, so that a comparison that was stopped goes on as if it had not been.

use crate::ensemble::run::Evaluations;
use crate::ensemble::{Observed, Quantity, Row, RunError, Settings, Silent, Task, evaluate, is_random};
use crate::math::degrees;
use crate::protocol::Protocol;
use crate::stats::selection::{FIRST, Kind, Measure, Rule, Standing, round};
use crate::study::Study;

/// So many walls that say nothing are no accident.
const TELLING: usize = 100;

/// Arms of a study that are compared at one kn point.
#[derive(Clone, Debug)]
pub struct Contest<'s> {
    /// The study.
    pub study: &'s Study,
    /// Indices of the arms, at least two.
    pub arms: Vec<u32>,
    /// Index of the kn point of each.
    pub point: u32,
    /// What strengths are compared by: larger values are stronger, so that a displacement counts with the other sign.
    pub measure: Measure,
    /// Probability with which all that is said of differences holds together.
    pub confidence: f64,
    /// Differences smaller than this do not matter.
    pub same_within: f64,
    /// Walls that may be evaluated in all.
    pub budget: usize,
}

/// What is known of the arms of a contest after some rounds.
#[derive(Clone, Debug)]
pub struct Compared {
    /// The strengths of each arm's walls.
    pub kinds: Vec<Kind>,
    /// By what rule they are judged: with the weakest and the strongest wall that was seen.
    pub rule: Rule,
    /// What they show.
    pub standing: Standing,
    /// Walls that were evaluated.
    pub walls: usize,
}

/// Why walls cannot be compared.
#[derive(Clone, Debug, PartialEq)]
pub enum Hopeless {
    /// No wall of this arm (by its place in the contest) brought a value.
    NoValue(usize),
    /// All walls lie on the same side of the level: from the weakest to the strongest.
    OneSide([f64; 2]),
}

impl Contest<'_> {
    /// The strength of a wall, of which larger is better; none where it brought no value. A wall that stood to the end of its load path
    /// counts as falling there: it is as strong as anybody asked.
    pub fn strength(&self, row: &Row) -> Option<f64> {
        let quantity = Quantity::of(self.study);
        match quantity.observed(row) {
            Observed::Value(value) | Observed::Above(value) => Some(quantity.strength(value)),
            Observed::Nothing => None,
        }
    }

    /// Evaluates walls round by round until all is settled, or the budget or hope is at its end. Tells of every look. Gives the rows that
    /// were compared, in the order arm, point, member.
    ///
    /// # Errors
    /// See [`RunError`]; whatever was evaluated until then is in the record.
    pub fn run(
        &self,
        settings: &Settings,
        tell: &dyn Fn(&Compared),
    ) -> Result<(Vec<Row>, Compared), RunError> {
        let mut evaluations = Evaluations::begin(self.study, settings, &Silent)?;
        let mut counts: Vec<usize> = self
            .arms
            .iter()
            .map(|arm| if is_random(&self.study.arms[*arm as usize]) { FIRST } else { 1 })
            .collect();
        loop {
            let tasks: Vec<Task> =
                self.arms.iter().zip(&counts).flat_map(|(arm, count)| self.tasks(*arm, *count)).collect();
            evaluations.of(&tasks, &Silent, &evaluate)?;
            let look = self.look(&evaluations, &counts);
            tell(&look);
            let next =
                look.rule.next(&look.kinds, &look.standing, round(look.walls).min(self.left(look.walls)));
            let is_hopeless = look.walls >= TELLING && self.hopeless(&look).is_some();
            if look.standing.is_settled() || next == counts || is_hopeless {
                return Ok((evaluations.end()?, look));
            }
            counts = next;
        }
    }

    /// Strengths no further apart than this are a tie: the bracket of a collapse angle (deg).
    pub fn tie(&self) -> f64 {
        match (&self.study.protocol, Quantity::of(self.study)) {
            (Protocol::Tilting(tilting), Quantity::CollapseAngle) => degrees(tilting.bracket),
            _ => 0.0,
        }
    }

    /// Why more walls would not tell more; `None` where they might.
    pub fn hopeless(&self, look: &Compared) -> Option<Hopeless> {
        let silent = look.kinds.iter().position(|kind| kind.values.iter().all(Option::is_none));
        if let Some(place) = silent {
            return Some(Hopeless::NoValue(place));
        }
        let Measure::ShareBelow(level) = self.measure else { return None };
        let [weakest, strongest] = seen(&look.kinds);
        (weakest >= level || strongest < level).then_some(Hopeless::OneSide([weakest, strongest]))
    }

    fn tasks(&self, arm: u32, count: usize) -> impl Iterator<Item = Task> {
        let point = self.point;
        (0..count as u64).map(move |member| Task { arm, point, member })
    }

    fn left(&self, walls: usize) -> usize {
        self.budget.saturating_sub(walls)
    }

    fn look(&self, evaluations: &Evaluations<'_>, counts: &[usize]) -> Compared {
        let kind = |(arm, count): (&u32, &usize)| {
            let strength = |task| evaluations.row(task).and_then(|row| self.strength(row));
            Kind {
                values: self.tasks(*arm, *count).map(strength).collect(),
                fixed: !is_random(&self.study.arms[*arm as usize]),
            }
        };
        let kinds: Vec<Kind> = self.arms.iter().zip(counts).map(kind).collect();
        let [weakest, strongest] = seen(&kinds);
        // A wall that brings no value may have borne nothing at all; a displacement has no such end.
        let worst = if weakest > 0.0 { 0.0 } else { weakest };
        let Contest { measure, confidence, same_within, .. } = *self;
        let rule = Rule { measure, confidence, same_within, ends: [worst, strongest] };
        let standing = rule.standing(&kinds);
        Compared { kinds, rule, standing, walls: counts.iter().sum() }
    }
}

/// The weakest and the strongest wall of all; nothing twice where no wall brought a value.
fn seen(kinds: &[Kind]) -> [f64; 2] {
    let values = kinds.iter().flat_map(|kind| kind.values.iter().flatten());
    let ends = values.fold(None, |ends: Option<[f64; 2]>, value| {
        Some(ends.map_or([*value; 2], |[low, high]| [low.min(*value), high.max(*value)]))
    });
    ends.unwrap_or([0.0; 2])
}
