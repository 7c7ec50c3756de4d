//! The words of a comparison: at most five lines of conclusion, and a table.

use crate::ensemble::{Compared, Contest, Quantity};
use crate::render::number::{
    compact, from_to, or_dash, shortened, significant, with_interval, with_interval_against,
};
use crate::render::text::LONGEST_NAME;
use crate::stats::selection::{Measure, Shown};
use crate::verb::compare::answer::{ArmDifference, ArmShown, SelectedArm, SelectionSummary};
use crate::verb::question::Question;

/// So many names are listed; of the others the number is told.
const MOST_NAMES: usize = 3;

/// A bound on a difference of shares that is wider than this tells nothing.
const TOLD: f64 = 0.5;

/// Where a comparison stands, in one line.
pub fn selection_running(contest: &Contest<'_>, look: &Compared) -> String {
    let quantity = Quantity::of(contest.study);
    let is_share = matches!(contest.measure, Measure::ShareBelow(_));
    let shown = |x: f64| if is_share { x } else { quantity.shown(x) };
    let unit = if is_share { String::new() } else { format!(" {}", quantity.shown_unit()) };
    let name = |place: usize| contest.study.arms[contest.arms[place] as usize].name.as_str();
    let rivals =
        look.standing.differences.iter().enumerate().filter_map(|(place, own)| Some((place, (*own)?)));
    let behind = |(_, own): &(usize, crate::stats::selection::Difference)| own.value.unwrap_or(f64::INFINITY);
    let Some((nearest, own)) = rivals.min_by(|a, b| behind(a).total_cmp(&behind(b))) else {
        return String::new();
    };
    let open = look.standing.shown.iter().filter(|shown| **shown == Shown::Open).count();
    format!(
        "{} walls: {} leads, over {} by {}{unit}; {open} of {} not settled",
        look.walls,
        name(look.standing.best),
        name(nearest),
        with_interval(own.value.map(shown), own.interval.map(|ends| ends.map(shown)), 2),
        look.kinds.len() - 1
    )
}

/// At most five lines.
pub(crate) fn conclusion(summary: &SelectionSummary) -> Vec<String> {
    let mut lines = vec![answer(summary)];
    lines.extend(summary.of_best().next().map(|rival| nearest(summary, rival)));
    lines.extend(summary.of_best().next().and_then(|rival| levels(summary, rival)));
    let lost: u64 = summary.arms.iter().map(SelectedArm::lost).sum();
    let mut walls = format!("{} walls of at most {}", summary.walls, summary.budget);
    if let Some(p) = summary.probability_of_correct_selection {
        walls.push_str(&format!("; probability of a correct selection {}", chance(p)));
    }
    lines.push(walls + ".");
    lines.extend(summary.arms.iter().filter_map(|arm| {
        let open = arm.left_open?;
        Some(format!("{}: {}.", shortened(&arm.name, LONGEST_NAME), open.said(summary.shown, arm.walls)))
    }));
    if lost > 0 {
        lines.push(format!(
            "{lost} walls brought no value; \"better\" and \"same\" hold whatever they would have borne."
        ));
    }
    lines
}

fn answer(summary: &SelectionSummary) -> String {
    let of = |shown: ArmShown| -> Vec<&str> {
        summary.of_best().filter(|own| own.shown == shown).map(|own| own.over.as_str()).collect()
    };
    let (better, same, open) = (of(ArmShown::Better), of(ArmShown::Same), of(ArmShown::Open));
    let best = shortened(&summary.best, LONGEST_NAME);
    let zone = zone(summary);
    match (better.len(), same.len(), open.len()) {
        (_, 0, 0) => {
            format!("{best} is the best, by {} (confidence {}).", measure(summary), summary.confidence)
        }
        (0, _, 0) => format!("{best} and {} are the same within {zone}.", names(&same)),
        (_, _, 0) => format!(
            "{best} is better than {}, and the same as {} within {zone}.",
            names(&better),
            names(&same)
        ),
        _ => format!("Not decided: {best} leads, but {} may be as good.", names(&open)),
    }
}

fn nearest(summary: &SelectionSummary, rival: &ArmDifference) -> String {
    let unit = summary.shown_unit();
    let by = with_interval_against(
        rival.better_by.map(|x| summary.shown_difference(x)),
        rival.interval.map(|ends| ends.map(|x| summary.shown_difference(x))),
        2,
        0.0,
    );
    let next = rival.next_wall.interval.map(|ends| ends.map(|x| (100.0 * x).round() / 100.0));
    format!(
        "Over {}: {by}{}{unit}; stronger with a probability of {} (the next wall) and {} (the mean).",
        shortened(&rival.over, LONGEST_NAME),
        if unit.is_empty() { "" } else { " " },
        with_interval(rival.next_wall.probability, next, 2),
        rival.on_average.map_or_else(|| "-".to_owned(), chance)
    )
}

fn levels(summary: &SelectionSummary, rival: &ArmDifference) -> Option<String> {
    let own = rival.distribution?;
    let unit = summary.shown.shown_unit();
    let ends = |ends: [f64; 2]| from_to(ends.map(|level| summary.shown.shown(level)), 3);
    let more = significant(own.more_fail_by_at_most, 2);
    Some(match (own.fewer_fail_between, own.more_fail_between) {
        (Some(fewer), None) => {
            format!(
                "Fewer of its walls fail at levels of {} {unit}; at none do over {more} more of them.",
                ends(fewer)
            )
        }
        (Some(fewer), Some(worse)) => {
            let [fewer, more] = [fewer, worse].map(ends);
            format!("Fewer of its walls fail at {fewer} {unit}, and more of them at {more}.")
        }
        (None, _) if own.more_fail_by_at_most < TOLD => {
            format!(
                "No level is shown at which fewer of its walls fail; at none do over {more} more of them."
            )
        }
        (None, _) => "No level is shown at which fewer of its walls fail.".to_owned(),
    })
}

/// By what arms are compared.
pub(crate) fn measure(summary: &SelectionSummary) -> String {
    let unit = summary.shown.shown_unit();
    let shown = |level: f64| significant(summary.shown.shown(level), 3);
    let quantity = summary.quantity.replace('_', " ");
    match summary.question {
        None => format!("the mean {quantity}"),
        Some(Question::Below(level)) => format!("how few have a {quantity} below {} {unit}", shown(level)),
        Some(Question::Above(level)) => format!("how few have a {quantity} above {} {unit}", shown(level)),
        Some(Question::Quantile(share)) => {
            format!("the {} % quantile of the {quantity}", significant(100.0 * share, 2))
        }
    }
}

fn zone(summary: &SelectionSummary) -> String {
    let zone = significant(summary.shown_difference(summary.same_within), 2);
    format!("{zone} {}", summary.shown_unit()).trim_end().to_owned()
}

/// A probability that is not rounded to 1.
fn chance(p: f64) -> String {
    match p {
        p if p > 0.999 => "over 0.999".to_owned(),
        p if p < 0.001 => "below 0.001".to_owned(),
        p => significant(p, 3),
    }
}

fn names(all: &[&str]) -> String {
    let short: Vec<String> = all.iter().take(MOST_NAMES).map(|name| shortened(name, LONGEST_NAME)).collect();
    match (all.len(), short.split_last()) {
        (count, _) if count > MOST_NAMES => format!("{count} others"),
        (_, Some((last, first))) if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => short.concat(),
    }
}

/// What the two columns of means are: walls of arms are paired, and the best arm has others than each arm.
pub(crate) const MEANS: &str = "mean: over the walls that the arm shares with the best one; best: that of the best arm over the same walls.";

/// A line per arm, with the heads in the first row.
pub(crate) fn table(summary: &SelectionSummary) -> Vec<Vec<String>> {
    let unit = summary.shown.shown_unit();
    let asked = match summary.question {
        None => None,
        Some(Question::Quantile(_)) => Some(format!("quantile {unit}")),
        Some(_) => Some("share".to_owned()),
    };
    let mut header = vec![
        "arm".to_owned(),
        "kn Pa/m".to_owned(),
        "n".to_owned(),
        format!("mean {unit}"),
        format!("best {unit}"),
        "COV %".to_owned(),
    ];
    header.extend(asked);
    header.extend(["behind the best", "shown", "falls by", "hinge m"].map(str::to_owned));
    let mut rows = vec![header];
    let mean = |value: Option<f64>| or_dash(value.map(|x| summary.shown.shown(x)), 3);
    for arm in &summary.arms {
        let rival = summary.of_best().find(|own| own.over == arm.name);
        let mut row = vec![
            arm.name.clone(),
            compact(arm.kn_pa_per_m),
            arm.walls.to_string(),
            mean(rival.map_or(arm.mean.value, |own| own.means.map(|[_, own]| own))),
            mean(rival.and_then(|own| own.means).map(|[best, _]| best)),
            or_dash(arm.cov.map(|cov| 100.0 * cov), 2),
        ];
        row.extend(match summary.question {
            None => None,
            Some(Question::Quantile(_)) => Some(or_dash(arm.answer.map(|x| summary.shown.shown(x)), 3)),
            Some(_) => Some(or_dash(arm.answer, 2)),
        });
        row.extend([
            rival.map_or_else(
                || "-".to_owned(),
                |own| {
                    let shown = |x: f64| summary.shown_difference(x);
                    let ends = own.interval.map(|ends| ends.map(shown));
                    with_interval_against(own.better_by.map(shown), ends, 2, 0.0)
                },
            ),
            rival
                .map_or("best", |own| match own.shown {
                    ArmShown::Better => "worse",
                    ArmShown::Same => "same",
                    ArmShown::Open => "open",
                })
                .to_owned(),
            arm.mode().map_or_else(
                || "-".to_owned(),
                |(mode, share)| format!("{mode} {} %", (100.0 * share).round()),
            ),
            or_dash(arm.hinge_height_m, 2),
        ]);
        rows.push(row);
    }
    rows
}
