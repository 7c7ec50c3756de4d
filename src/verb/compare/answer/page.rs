//! Which arm is the best, as a page.

use anyhow::Result;

use crate::render::draw::svg;
use crate::render::number::{with_interval, with_interval_against};
use crate::study::{Loaded, Study};
use crate::verb::compare::answer::plot::Forest;
use crate::verb::compare::answer::text::{conclusion, measure, table};
use crate::verb::compare::answer::{ArmDifference, ArmShown, SelectionSummary, title};
use crate::verb::run::answer::fragility::FragilityPlot;
use crate::verb::run::answer::page::{Asked, Chart, Drawing, PageOrigin, Table, answer_page};

/// The page of a comparison; `loaded` is the study as its files state it.
///
/// # Errors
/// A figure that cannot be drawn, or a template that is faulty.
pub fn selection_page(
    summary: &SelectionSummary,
    (study, loaded): (&Study, &Loaded),
    origin: &PageOrigin,
) -> Result<String> {
    let title = title(summary);
    let ladders: Vec<_> = summary.arms.iter().map(|arm| arm.ladder(summary.shown)).collect();
    let caption = format!(
        "How far each arm is behind the best one. All intervals hold together with a confidence of {}. Grey: differences that do not \
         matter.",
        summary.confidence
    );
    let figures = vec![
        Drawing::picture(
            "figure-compare",
            "Arms behind the best one",
            &caption,
            &svg(&Forest::new(summary, 1))?,
        ),
        Drawing::picture(
            "figure-distributions",
            "Distributions of the arms",
            "The walls of each arm: which share has failed at each level, a step per wall, with its 95 % band.",
            &svg(&FragilityPlot::new(&title, &ladders, 1).of(summary.shown))?,
        )
        .with_chart(Chart::of_ladders(&ladders, summary.shown)),
    ];
    let asked = Asked {
        title: format!("Arms of study {title} compared"),
        question: format!("Which arm is the best by {}, and how sure is that?", measure(summary)),
        answer: conclusion(summary),
        tables: vec![Table::headed("Arms, the best first", table(summary)), pairs(summary)],
        figures,
        limits: vec![
            "Arms are compared on the same random numbers. The order holds for walls drawn as the study states them.".to_owned(),
        ],
        methods: "Walls were added to the arms in turn until every other arm was shown to be worse than the best one or the same within \
                  the zone of indifference. Intervals of differences hold together at every number of walls (always-valid)."
            .to_owned(),
    };
    answer_page(&asked, (study, loaded), origin)
}

/// Every pair of arms.
fn pairs(summary: &SelectionSummary) -> Table {
    let row = |own: &ArmDifference| {
        let shown = |x: f64| summary.shown_difference(x);
        let by =
            with_interval_against(own.better_by.map(shown), own.interval.map(|ends| ends.map(shown)), 2, 0.0);
        let next = with_interval(own.next_wall.probability, own.next_wall.interval, 2);
        let verdict = match own.shown {
            ArmShown::Better => "better",
            ArmShown::Same => "same",
            ArmShown::Open => "open",
        };
        vec![own.arm.clone(), own.over.clone(), by, next, verdict.to_owned()]
    };
    let by = format!("better by {}", summary.shown_unit());
    let heads = ["arm", "over", by.trim_end(), "the next wall is stronger with probability", "shown"];
    Table::new("Every pair of arms", &heads, summary.differences.iter().map(row).collect())
}
