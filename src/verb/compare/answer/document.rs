//! Which arm is the best, as a document.

use crate::render::csv::Csv;
use crate::render::document::{Captioned, Document, Layout, Part, Table};
use crate::render::number::{with_interval, with_interval_against};
use crate::verb::compare::answer::plot::Forest;
use crate::verb::compare::answer::text::{MEANS, conclusion, measure, table};
use crate::verb::compare::answer::{ArmDifference, ArmShown, SelectionSummary, title};
use crate::verb::run::answer::fragility::{fragility, shares};

/// The document of a comparison.
pub fn selection_document(summary: &SelectionSummary) -> Document<'_> {
    let title = title(summary);
    let caption = format!(
        "How far each arm is behind the best one. All intervals hold together with a confidence of {}. Grey: differences that do not \
         matter.",
        summary.confidence
    );
    let forest =
        Captioned::new("compare", "Arms behind the best one", caption, |scale| Forest::new(summary, scale));
    let ladders: Vec<_> = summary.arms.iter().map(|arm| arm.ladder(summary.shown)).collect();
    let distributions = Captioned::chart(
        "distributions",
        "Distributions of the arms",
        "The walls of each arm: which share has failed at each level, a step per wall, with its 95 % band.",
        fragility(&title, &ladders, summary.shown),
    );
    let distributions = distributions.with_read_off(shares(&ladders, summary.shown));
    let arms = Table::headed("Arms, the best first", table(summary));
    let arms = Table { layout: Layout::Bare, caption: MEANS.to_owned(), ..arms };
    let tables = [arms, pairs(summary)].map(Part::Table);
    let figures = [forest, distributions].map(Part::Figure);
    Document {
        title: format!("Arms of study {title} compared"),
        question: format!("Which arm is the best by {}, and how sure is that?", measure(summary)),
        parts: Part::sentences(conclusion(summary)).chain(tables).chain(figures).collect(),
        files: vec![
            ("compare.csv", differences_csv(summary)),
            ("distributions.csv", distributions_csv(summary)),
        ],
        limits: vec![
            "Arms are compared on the same random numbers. The order holds for walls drawn as the study states them.".to_owned(),
        ],
        methods: "Walls were added to the arms in turn until every other arm was shown to be worse than the best one or the same within \
                  the zone of indifference. Intervals of differences hold together at every number of walls (always-valid)."
            .to_owned(),
    }
}

/// Every pair of arms.
fn pairs(summary: &SelectionSummary) -> Table {
    let row = |own: &ArmDifference| {
        let shown = |x: f64| summary.shown_difference(x);
        let by =
            with_interval_against(own.better_by.map(shown), own.interval.map(|ends| ends.map(shown)), 2, 0.0);
        let next = with_interval(own.next_wall.probability, own.next_wall.interval, 2);
        vec![own.arm.clone(), own.over.clone(), by, next, name(own.shown).to_owned()]
    };
    let by = format!("better by {}", summary.shown_unit());
    let heads = ["arm", "over", by.trim_end(), "the next wall is stronger with probability", "shown"];
    let pairs = Table::new("Every pair of arms", &heads, summary.differences.iter().map(row).collect());
    Table { layout: Layout::OnPage, ..pairs }
}

/// What is shown of a pair, in a word.
fn name(shown: ArmShown) -> &'static str {
    match shown {
        ArmShown::Better => "better",
        ArmShown::Same => "same",
        ArmShown::Open => "open",
    }
}

/// One line per pair of arms.
fn differences_csv(summary: &SelectionSummary) -> Vec<u8> {
    let mut csv = Csv::new(
        "arm,over,shown,pairs,lost_pairs,better_by,low,high,low_whatever_failed,high_whatever_failed,next_wall,\
         next_wall_low,next_wall_high,on_average",
    );
    for own in &summary.differences {
        csv.line(&[
            &own.arm,
            &own.over,
            &name(own.shown),
            &own.pairs,
            &own.lost_pairs,
            &own.better_by,
            &own.interval,
            &own.interval_whatever_failed,
            &own.next_wall.probability,
            &own.next_wall.interval,
            &own.on_average,
        ]);
    }
    csv.bytes()
}

/// One line per arm and step of its empirical distribution.
fn distributions_csv(summary: &SelectionSummary) -> Vec<u8> {
    let mut csv = Csv::new(format!("arm,walls,{}_{},share_below,low,high", summary.quantity, summary.unit));
    for arm in &summary.arms {
        for step in &arm.steps {
            csv.line(&[&arm.name, &arm.walls, &step.value, &step.probability, &step.pointwise]);
        }
    }
    csv.bytes()
}
