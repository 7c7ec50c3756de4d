//! What is printed of a capacity.

use crate::report::capacity::group::{CapacityGroup, Repeats};
use crate::report::capacity::{CapacitySummary, Question, SupportedValue};
use crate::report::number::{compact, or_dash, significant, with_interval};
use crate::report::table::{aligned, wrapped};
use crate::stats::Shape;

/// Fewer walls than this support no design value that anybody should use.
const FEW: u64 = 10;

/// The conclusion, a line per group, and what the values mean.
pub fn capacity_text(summary: &CapacitySummary) -> String {
    let mut text = String::new();
    for group in &summary.groups {
        text.push_str(&wrapped("", &conclusion(summary, group)));
    }
    text.push_str(&table(summary));
    text.push_str(&wrapped(
        "",
        "characteristic: the next wall lies below it with a probability of 5 % (EN 1990 D7.2); 95/95: no more than 5 % of all walls \
         lie below it, with a confidence of 95 %; design: the next wall lies below it with a probability of 0.1 % (D7.3).",
    ));
    text
}

fn name(group: &CapacityGroup) -> String {
    match group.kn_pa_per_m {
        Some(kn) => format!("{} at kn {}", group.name, compact(kn)),
        None => group.name.clone(),
    }
}

fn conclusion(summary: &CapacitySummary, group: &CapacityGroup) -> String {
    let unit = summary.shown.shown_unit();
    let shown = |x: f64| summary.shown.shown(x);
    let name = name(group);
    if !group.random {
        let value = or_dash(group.answer.map(shown), 3);
        return match summary.question {
            Question::Quantile(_) => format!("{name}: nothing is drawn, every wall has {value} {unit}."),
            _ => format!("{name}: nothing is drawn, every wall is alike."),
        };
    }
    if let Some(repeats) = &group.repeats {
        return by_subset(summary, group, repeats);
    }
    let lost: u64 = group.failed.values().sum();
    let counted = if lost > 0 {
        format!("{} walls, {lost} without a value", group.walls)
    } else {
        format!("{} walls", group.walls)
    };
    let mut text = match summary.question {
        Question::Below(level) | Question::Above(level) => {
            let side = if matches!(summary.question, Question::Below(_)) { "below" } else { "above" };
            format!(
                "{name}: {side} {} {unit} with a probability of {} ({counted}).",
                significant(shown(level), 3),
                with_interval(group.answer, group.interval, 2)
            )
        }
        Question::Quantile(share) if group.answer.is_none() => {
            format!(
                "{name}: {counted} are too few to show a {} % quantile by themselves.",
                significant(100.0 * share, 2)
            )
        }
        Question::Quantile(share) => format!(
            "{name}: {} % of walls lie below {} {unit} ({counted}).",
            significant(100.0 * share, 2),
            with_interval(group.answer.map(shown), group.interval.map(|ends| ends.map(shown)), 3)
        ),
    };
    if let Some(ends) = group.interval_whatever_failed {
        let ends = match summary.question {
            Question::Quantile(_) => ends.map(shown),
            _ => ends,
        };
        let [low, high] = ends.map(|end| significant(end, 2));
        text.push_str(&format!(" Whatever those without a value would have borne: [{low}, {high}]."));
    }
    if group.method == "measured" && group.walls < FEW {
        text.push_str(&few(summary, group));
    }
    text
}

/// What subset simulation found.
fn by_subset(summary: &CapacitySummary, group: &CapacityGroup, repeats: &Repeats) -> String {
    let (side, level) = match summary.question {
        Question::Above(level) => ("above", level),
        Question::Below(level) | Question::Quantile(level) => ("below", level),
    };
    let unit = summary.shown.shown_unit();
    let mut text = format!(
        "{}: {side} {} {unit} with a probability of {} (subset simulation, {} independent runs, {} walls).",
        name(group),
        significant(summary.shown.shown(level), 3),
        with_interval(group.answer, group.interval, 2),
        repeats.probabilities.len(),
        repeats.evaluations
    );
    if let Some((_, value)) = &repeats.weakest {
        let value = significant(summary.shown.shown(*value), 3);
        text.push_str(&format!(" The weakest wall found has {value} {unit}."));
    }
    if repeats.failed > 0 {
        text.push_str(&format!(
            " {} walls brought no value and count as on the better side.",
            repeats.failed
        ));
    }
    text
}

/// What few tests can and cannot carry.
fn few(summary: &CapacitySummary, group: &CapacityGroup) -> String {
    let normal = group.supported.iter().find(|own| own.shape == Shape::Normal);
    match normal.and_then(|own| own.design) {
        Some(design) if design.value <= 0.0 => format!(
            " {} specimens carry no design value: a normal one is {} {}, which says nothing. State a known coefficient of variation.",
            group.walls,
            significant(summary.shown.shown(design.value), 3),
            summary.shown.shown_unit()
        ),
        Some(_) => " So few specimens carry a characteristic value at best.".to_owned(),
        None => " So few specimens carry no value unless the coefficient of variation is known.".to_owned(),
    }
}

fn table(summary: &CapacitySummary) -> String {
    let unit = summary.shown.shown_unit();
    let header =
        ["walls of", "kn Pa/m", "n", "COV %", "shape", "characteristic", "95/95", "design"].map(|head| {
            match head {
                "characteristic" | "95/95" | "design" => format!("{head} {unit}"),
                head => head.to_owned(),
            }
        });
    let mut rows = vec![header.to_vec()];
    for group in &summary.groups {
        for own in &group.supported {
            let value = |of: Option<SupportedValue>| or_dash(of.map(|of| summary.shown.shown(of.value)), 3);
            rows.push(vec![
                group.name.clone(),
                group.kn_pa_per_m.map_or_else(|| "-".to_owned(), compact),
                group.walls.to_string(),
                or_dash(group.cov.map(|cov| 100.0 * cov), 2),
                match own.shape {
                    Shape::Normal => "normal".to_owned(),
                    Shape::Lognormal => "lognormal".to_owned(),
                },
                value(own.characteristic),
                value(own.tolerance_95_95),
                value(own.design),
            ]);
        }
    }
    if rows.len() == 1 {
        return String::new();
    }
    format!("\nValues that these walls support\n{}", aligned(rows))
}
