//! The words of an sensitivity: at most five lines that say it, and the table.

use crate::render::number::{compact, or_dash, significant, with_interval};
use crate::verb::sensitivity::answer::entry::WELL_KNOWN;
use crate::verb::sensitivity::answer::{SensitivitySummary, ShareEntry};

/// What the table holds.
pub(crate) const SHARES: &str = "Shares of the variance in %, with 95 % intervals";
/// What its columns mean.
pub(crate) const ORDERS: &str = "first order: what would go if the source were known; total: what would be left if all others were known; \
     behind a dash: part of the layout. Shares are the nearest to the estimates that can be: no total is below its first order, and first \
     orders sum to 100 at most.";

/// At most five lines.
pub(crate) fn conclusion(summary: &SensitivitySummary) -> Vec<String> {
    let lines = [scatter(summary), largest(summary), interactions(summary)];
    lines.into_iter().filter(|line| !line.is_empty()).collect()
}

/// A line per source, with the heads in the first row.
pub(crate) fn shares(summary: &SensitivitySummary) -> Vec<Vec<String>> {
    let header = ["source", "first order", "total", "points"].map(str::to_owned).to_vec();
    let rows = summary.groups.iter().map(|group| {
        let name = if group.is_in_layout { format!("- {}", group.name) } else { group.name.clone() };
        vec![name, percent(group.first), percent(group.total), group.points.to_string()]
    });
    std::iter::once(header).chain(rows).collect()
}

/// How much the walls scatter, and how many brought no value.
fn scatter(summary: &SensitivitySummary) -> String {
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
fn largest(summary: &SensitivitySummary) -> String {
    let mut whole: Vec<(&ShareEntry, f64)> = summary
        .groups
        .iter()
        .filter(|group| !group.is_in_layout)
        .filter_map(|group| Some((group, group.total[0]?)))
        .collect();
    whole.sort_by(|a, b| b.1.total_cmp(&a.1));
    if let [(only, _)] = whole[..]
        && only.is_exact
    {
        return format!("All of it comes from {}, the only source (100 % by definition).", only.name);
    }
    let named: Vec<String> =
        whole.iter().take(3).map(|(group, _)| format!("{} {} %", group.name, percent(group.total))).collect();
    if named.is_empty() {
        return "Nothing scatters: every wall has the same value.".to_owned();
    }
    let others = if whole.len() > 3 { "; others less" } else { "" };
    format!("Responsible in all, with interactions: {}{others}.", named.join(", "))
}

/// What the sources are responsible for alone, and what their interactions are.
fn interactions(summary: &SensitivitySummary) -> String {
    let several = summary.groups.iter().filter(|group| !group.is_in_layout).count() > 1;
    if !several || summary.alone[0].is_none() {
        return String::new();
    }
    let (alone, together) = (percent(summary.alone), percent(summary.interactions));
    match summary.interactions {
        [_, Some(low), _] if low > 0.0 => {
            format!("Alone they are responsible for {alone} %, their interactions for {together} %.")
        }
        [_, Some(_), Some(high)] => format!(
            "Alone they are responsible for {alone} %; interactions are not shown, {} % at most.",
            significant(100.0 * high, 2)
        ),
        _ => format!("Alone they are responsible for {alone} %."),
    }
}

/// How well the shares are known, where that is not well enough, and with how many base points it would be.
pub(crate) fn known(summary: &SensitivitySummary) -> Option<String> {
    let (half, wanted) = summary.half_width.zip(summary.points_wanted)?;
    Some(format!(
        "Shares are known to within {} % of the variance; to within {} % they would be with about {wanted} points (--points), as \
         intervals shrink with the square root of their number.",
        significant(100.0 * half, 2),
        significant(100.0 * WELL_KNOWN, 2)
    ))
}

/// What looks wrong: so few base points that shares say little, or that their intervals hold less often than they say.
pub fn sensitivity_warnings(summary: &SensitivitySummary) -> Vec<String> {
    let Some(half) = summary.half_width.filter(|half| *half > 0.0) else { return Vec::new() };
    let is_short = summary.points < FEW;
    if half <= POOR && !is_short {
        return Vec::new();
    }
    let short = is_short.then(|| SHORT.to_owned());
    let why: Vec<String> = short.into_iter().chain(known(summary)).collect();
    vec![format!("--points {}: too few. {}", summary.points, why.join(" "))]
}

/// Shares that are known to within no less than this say little.
const POOR: f64 = 0.25;
/// Fewer base points than this are two or three to a randomisation.
const FEW: u64 = 64;
/// What is wrong with intervals over so few, as a test on a function of known shares finds.
const SHORT: &str =
    "Intervals over two or three points per randomisation hold the truth in some 91 of 100 cases.";

/// A share in % with its interval.
fn percent([value, low, high]: [Option<f64>; 3]) -> String {
    let interval = low.zip(high).map(|(low, high)| [100.0 * low, 100.0 * high]);
    with_interval(value.map(|value| 100.0 * value), interval, 2)
}
