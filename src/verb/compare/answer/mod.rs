//! Which arm is the best, and how sure that is: the numbers, and how they are told.

mod arm;
mod difference;
mod document;
mod plot;
mod text;

use serde::Serialize;

pub use arm::SelectedArm;
pub use difference::{ArmDifference, ArmShown, ShareLevels};
pub use document::selection_document;
pub use text::selection_running;

use crate::ensemble::{Compared, Contest, Quantity, Row};
use crate::stats::selection::Measure;
use crate::verb::question::Question;

/// What a comparison found. All intervals of differences hold together, with the stated confidence, at every number of walls.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SelectionSummary {
    /// Name of the study.
    pub study: String,
    /// Its variant.
    pub variant: Option<String>,
    /// Seed of all random streams.
    pub seed: u64,
    /// What is described, and its unit.
    pub quantity: &'static str,
    /// See `quantity`.
    pub unit: &'static str,
    /// What arms are compared by: null for the mean.
    pub question: Option<Question>,
    /// Unit of differences: that of the quantity, or 1 for probabilities.
    pub difference_unit: &'static str,
    /// Probability with which all that is said of differences holds together.
    pub confidence: f64,
    /// Differences smaller than this do not matter.
    pub same_within: f64,
    /// Walls that might have been evaluated, and walls that were.
    pub budget: u64,
    /// See `budget`.
    pub walls: u64,
    /// Whether every other arm is settled: worse than the best, or the same within the zone of indifference.
    pub settled: bool,
    /// The best arm; where not settled, the one that leads.
    pub best: String,
    /// How probable it is, by Student's t, that no arm is better than it by the zone of indifference or more. Of means alone.
    pub probability_of_correct_selection: Option<f64>,
    /// The arms, the best first, then as far as they are behind it.
    pub arms: Vec<SelectedArm>,
    /// Every pair of arms, the better one first.
    pub differences: Vec<ArmDifference>,
    /// How the quantity is shown.
    #[serde(skip)]
    pub shown: Quantity,
}

impl SelectionSummary {
    /// From the rows of a contest and its last look.
    pub fn of(
        contest: &Contest<'_>,
        question: Option<Question>,
        rows: &[Row],
        look: &Compared,
    ) -> SelectionSummary {
        let shown = Quantity::of(contest.study);
        let behind = |place: usize| look.standing.differences[place].and_then(|own| own.value).unwrap_or(0.0);
        let mut order: Vec<usize> =
            (0..look.kinds.len()).filter(|place| *place != look.standing.best).collect();
        order.sort_by(|a, b| behind(*a).total_cmp(&behind(*b)));
        order.insert(0, look.standing.best);
        let arms: Vec<SelectedArm> = order
            .iter()
            .map(|place| SelectedArm::of(contest, contest.arms[*place], rows, question))
            .collect();
        let name = |place: usize| contest.study.arms[contest.arms[place] as usize].name.as_str();
        let mut differences = Vec::new();
        for (rank, a) in order.iter().enumerate() {
            for b in &order[rank + 1..] {
                differences.push(ArmDifference::of([name(*a), name(*b)], [*a, *b], contest, look));
            }
        }
        SelectionSummary {
            study: contest.study.name.clone(),
            variant: contest.study.variant.clone(),
            seed: contest.study.seed,
            quantity: shown.name(),
            unit: shown.unit(),
            question,
            difference_unit: if matches!(contest.measure, Measure::ShareBelow(_)) {
                "1"
            } else {
                shown.unit()
            },
            confidence: contest.confidence,
            same_within: contest.same_within,
            budget: contest.budget as u64,
            walls: look.walls as u64,
            settled: look.standing.is_settled(),
            best: name(look.standing.best).to_owned(),
            probability_of_correct_selection: look
                .rule
                .probability_of_correct_selection(&look.kinds, look.standing.best),
            arms,
            differences,
            shown,
        }
    }

    /// What the best arm has over each other one.
    pub fn of_best(&self) -> impl Iterator<Item = &ArmDifference> {
        self.differences.iter().filter(|own| own.arm == self.best)
    }

    /// A difference in the unit that is shown.
    fn shown_difference(&self, x: f64) -> f64 {
        if self.difference_unit == "1" { x } else { self.shown.shown(x) }
    }

    /// That unit.
    fn shown_unit(&self) -> &'static str {
        if self.difference_unit == "1" { "" } else { self.shown.shown_unit() }
    }
}

/// The study, with its variant if one is named.
fn title(summary: &SelectionSummary) -> String {
    let variant = summary.variant.iter().map(|variant| format!(" \u{2013} variant {variant}"));
    std::iter::once(summary.study.clone()).chain(variant).collect()
}
