//! What walls can be relied on to bear, as a document.

use crate::ensemble::Quantity;
use crate::render::document::{Captioned, Document, Layout, Part, ReadOff, Scale, Table, Trace};
use crate::render::number::{compact, or_dash, significant, with_interval};
use crate::verb::capacity::answer::figure::{capacity_chart, capacity_csv, drawn};
use crate::verb::capacity::answer::text::{SUPPORTED, VALUES, conclusions, method, probability, supported};
use crate::verb::capacity::answer::{CapacityGroup, CapacitySummary, Question};

/// File name, without ending, of the probability over the level and the figure of it.
const FIGURE: &str = "probability";

/// The document of an answer.
pub fn capacity_document(summary: &CapacitySummary) -> Document<'_> {
    let (all, drawn) = (summary.spread().count(), drawn(summary).len());
    let at = if drawn < all { " Each arm at the middle of its stiffnesses." } else { "" };
    let caption = format!(
        "How probable it is that a wall lies on the worse side of a level, over the level. Bars: 95 % intervals of the answers.{at} The \
         numbers are in probability.csv."
    );
    let figure = capacity_chart(summary).map(|chart| {
        let figure = Captioned::chart(FIGURE, "Probability over the level", caption, chart);
        Part::Figure(figure.with_read_off(read_off(summary)))
    });
    let values = Table { caption: VALUES.to_owned(), ..Table::headed(SUPPORTED, supported(summary)) };
    let tables = [answers(summary), values].map(Part::Table);
    Document {
        title: title(summary),
        question: question(summary),
        parts: Part::sentences(conclusions(summary)).chain(tables).chain(figure).collect(),
        files: vec![("probability.csv", capacity_csv(summary))],
        limits: vec![
            "A probability is that of walls drawn as the study states them. What nobody knows of real walls is in it only as far as \
             the study draws it."
                .to_owned(),
        ],
        methods: "Probabilities are shares of walls with the interval of Clopper and Pearson, or means of independent runs with \
                  Student's interval; quantiles lie between two order statistics. Characteristic and design values follow EN 1990, \
                  annex D7."
            .to_owned(),
    }
}

/// The probability over the level by all walls alike, and by each run.
fn read_off(summary: &CapacitySummary) -> Option<ReadOff> {
    let line = |(group, run): (&CapacityGroup, Option<usize>)| {
        let rungs = group.rungs.iter().filter(|rung| rung.run == run && rung.probability > 0.0);
        let level = |level: f64| summary.shown.shown(level);
        let name = run.map_or_else(|| group.name.clone(), |run| format!("{}, run {}", group.name, run + 1));
        let mut points: Vec<_> =
            rungs.map(|rung| (level(rung.level), Some(rung.probability), rung.interval)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Trace { colour: Some(group.place), ..Trace::through(name, points) }
    };
    let runs = |group: &CapacityGroup| {
        group.rungs.iter().filter_map(|rung| rung.run).max().map_or(0, |last| last + 1)
    };
    let each = drawn(summary).into_iter().flat_map(|group| {
        std::iter::once(None).chain((0..runs(group)).map(Some)).map(move |run| (group, run))
    });
    let x = Scale::of(format!("level ({})", summary.shown.shown_unit()));
    ReadOff::with(x, Scale::of("probability").by_powers(), each.map(line))
}

fn title(summary: &CapacitySummary) -> String {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    match summary.shown {
        Quantity::TopDisplacement => format!("How far walls of study {}{variant} move", summary.study),
        _ => format!("What walls of study {}{variant} can be relied on to bear", summary.study),
    }
}

fn question(summary: &CapacitySummary) -> String {
    let (quantity, unit) = (summary.quantity.replace('_', " "), summary.shown.shown_unit());
    let shown = |level: f64| significant(summary.shown.shown(level), 3);
    match summary.question {
        Question::Below(level) => format!("How probable is a {quantity} below {} {unit}?", shown(level)),
        Question::Above(level) => format!("How probable is a {quantity} above {} {unit}?", shown(level)),
        Question::Quantile(share) => {
            format!("Below which {quantity} do {} % of walls lie?", significant(100.0 * share, 2))
        }
    }
}

fn answers(summary: &CapacitySummary) -> Table {
    let unit = summary.shown.shown_unit();
    let shown = |x: f64| summary.shown.shown(x);
    let quantile = |group: &CapacityGroup| {
        with_interval(group.answer.value().map(shown), group.interval.map(|ends| ends.map(shown)), 2)
    };
    let (head, answer): (String, &dyn Fn(&CapacityGroup) -> String) = match summary.question {
        Question::Quantile(_) => (format!("quantile {unit}, 95 % interval"), &quantile),
        _ => ("probability, 95 % interval".to_owned(), &probability),
    };
    let row = |group: &CapacityGroup| {
        vec![
            group.name.clone(),
            group.kn_pa_per_m.map_or_else(|| "-".to_owned(), compact),
            answer(group),
            or_dash(group.cov.map(|cov| 100.0 * cov), 2),
            method(group).to_owned(),
            group.evaluations.values().sum::<u64>().max(group.walls).to_string(),
            group.failed.walls.to_string(),
        ]
    };
    let heads = ["walls of", "kn Pa/m", &head, "COV %", "by", "walls", "without a value"];
    let answers = Table::new("Answers", &heads, summary.spread().map(row).collect());
    Table { layout: Layout::OnPage, ..answers }
}
