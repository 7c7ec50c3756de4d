//! What is printed of an influence: at most five lines that say it, and the table.

use crate::report::influence::{InfluenceSummary, ShareEntry};
use crate::report::number::{compact, or_dash, significant, with_interval};
use crate::report::table::{aligned, wrapped};

/// The conclusion and the shares of all sources.
pub fn influence_text(summary: &InfluenceSummary) -> String {
    let mut text: String = conclusion(summary).iter().map(|line| wrapped("", line)).collect();
    text.push_str(&format!("\n{SHARES}\n{}", aligned(shares(summary))));
    text.push_str(&wrapped("", ORDERS));
    text
}

/// What the table holds.
pub(super) const SHARES: &str = "Shares of the variance in %, with 95 % intervals";
/// What its columns mean.
pub(super) const ORDERS: &str = "first order: what would go if the source were known; total: what would be left if all others were known; \
     behind a dash: part of the layout.";

/// At most five lines.
pub(super) fn conclusion(summary: &InfluenceSummary) -> Vec<String> {
    let lines = [scatter(summary), largest(summary), interactions(summary)];
    lines.into_iter().filter(|line| !line.is_empty()).collect()
}

/// A line per source, with the heads in the first row.
pub(super) fn shares(summary: &InfluenceSummary) -> Vec<Vec<String>> {
    let header = ["source", "first order", "total", "points"].map(str::to_owned).to_vec();
    let rows = summary.groups.iter().map(|group| {
        let name = if group.is_in_layout { format!("- {}", group.name) } else { group.name.clone() };
        vec![name, percent(group.first), percent(group.total), group.points.to_string()]
    });
    std::iter::once(header).chain(rows).collect()
}

/// How much the walls scatter, and how many brought no value.
fn scatter(summary: &InfluenceSummary) -> String {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let sigma = summary.variance.map(f64::sqrt);
    let shown = |x: f64| summary.shown.shown(x);
    let cov = sigma.zip(summary.mean).map(|(sigma, mean)| 100.0 * sigma / mean.abs());
    let failed: u64 = summary.failed.values().sum();
    let failed = match failed {
        0 => "none without a value".to_owned(),
        some => {
            let why: Vec<String> =
                summary.failed.iter().map(|(how, n)| format!("{n} {}", how.replace('_', " "))).collect();
            format!("{some} without a value: {}", why.join(", "))
        }
    };
    format!(
        "{}{variant}: walls of {} at kn {} scatter by {} {} about {} (COV {} %), over {} walls, {failed}.",
        summary.study,
        summary.arm,
        compact(summary.kn_pa_per_m),
        or_dash(sigma.map(shown), 3),
        summary.shown.shown_unit(),
        or_dash(summary.mean.map(shown), 3),
        or_dash(cov, 2),
        summary.walls
    )
}

/// The sources by their total shares, the largest first; two lines hold three of them.
fn largest(summary: &InfluenceSummary) -> String {
    let mut whole: Vec<(&ShareEntry, f64)> = summary
        .groups
        .iter()
        .filter(|group| !group.is_in_layout)
        .filter_map(|group| Some((group, group.total[0]?)))
        .collect();
    whole.sort_by(|a, b| b.1.total_cmp(&a.1));
    let named: Vec<String> =
        whole.iter().take(3).map(|(group, _)| format!("{} {} %", group.name, percent(group.total))).collect();
    if named.is_empty() {
        return "Nothing scatters: every wall has the same value.".to_owned();
    }
    let others = if whole.len() > 3 { "; others less" } else { "" };
    format!("Responsible in all, with interactions: {}{others}.", named.join(", "))
}

/// What no source is responsible for alone.
fn interactions(summary: &InfluenceSummary) -> String {
    let whole = summary.groups.iter().filter(|group| !group.is_in_layout);
    let firsts: Option<Vec<f64>> = whole.map(|group| group.first[0]).collect();
    match firsts {
        Some(firsts) if firsts.len() > 1 => {
            let sum: f64 = firsts.iter().fold(0.0, |sum, first| sum + first);
            format!(
                "Alone they are responsible for {} %; the rest is interactions and chance.",
                significant(100.0 * sum, 2)
            )
        }
        _ => String::new(),
    }
}

/// A share in % with its interval.
fn percent([value, low, high]: [Option<f64>; 3]) -> String {
    let interval = low.zip(high).map(|(low, high)| [100.0 * low, 100.0 * high]);
    with_interval(value.map(|value| 100.0 * value), interval, 2)
}
