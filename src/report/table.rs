//! The table that `run` prints: arms, ratios, published statements. At most 100 columns wide.

use crate::ensemble::Quantity;
use crate::report::conclusion::conclusion;
use crate::report::measured;
use crate::report::number::{
    compact, or_dash, shortened, significant, stiffness, with_interval, with_interval_against,
};
use crate::report::shaken::text as shaken_text;
use crate::report::summary::{ArmSummary, EnoughEntry, Summary};

/// Widest line of text and of tables that are split.
pub(super) const WIDTH: usize = 100;

/// What the table shows, in words.
pub(super) fn explanation(quantity: Quantity) -> String {
    format!(
        "Each line is one arm (kind of wall) at one normal stiffness kn of the joints. The quantity is {}. Brackets hold \
         95 % intervals. A dash: not defined (one wall has no sigma). Failed walls ({}) are counted and are not in the \
         mean. sigma: standard deviation between walls; COV: sigma over mean.",
        quantity.words(),
        quantity.failed_words()
    )
}

/// The summary as text for a terminal: the conclusion, then what it rests on under headings.
pub fn terminal_table(summary: &Summary) -> String {
    if let Some(shaken) = &summary.shaken {
        return shaken_text(summary, shaken);
    }
    let mut text = conclusion(summary);
    text.push_str(&format!("\nResults ({} solver, seed {})\n", summary.solver, summary.seed));
    if let Some(arm) = summary.arms.first() {
        text.push_str(&wrapped("", &explanation(arm.shown)));
        text.push('\n');
    }
    text.push_str(&arms(&summary.arms));
    text.push_str(&ratios(summary));
    text.push_str(&measured::text(summary.measured.as_ref()));
    text.push_str(&published(summary));
    text
}

/// Whether an arm had walls enough, and what of.
fn said_enough(arm: &ArmSummary, enough: &EnoughEntry) -> String {
    let shown = |x: f64| arm.shown.shown(x);
    let value = with_interval(enough.value.map(shown), enough.ci.map(|ci| ci.map(shown)), 3);
    let half = or_dash(enough.half_width.map(|half| 100.0 * half), 2);
    let below = significant(100.0 * enough.below, 2);
    let ending = match enough.reached {
        true => format!("{} walls are enough", arm.members),
        false => format!("{} walls, the most allowed, are not enough", arm.members),
    };
    format!(
        "{} at kn {}: {ending}: {} {value} {}, half width {half} % (asked: below {below} %)",
        arm.arm,
        stiffness(arm.kn_pa_per_m),
        enough.of,
        arm.shown.shown_unit()
    )
}

/// The heads, and a row per arm and kn.
pub(super) fn arm_rows(arms: &[ArmSummary]) -> Vec<Vec<String>> {
    let unit = arms.first().map_or("", |arm| arm.shown.shown_unit());
    let in_unit = |name: &str| format!("{name} {unit}");
    let counts = ["arm", "kn Pa/m", "walls", "failed"].map(String::from);
    let header = counts.into_iter().chain([in_unit("mean"), in_unit("sigma"), "COV %".to_string()]);
    let mut rows = vec![header.collect()];
    for arm in arms {
        let shown = |x: f64| arm.shown.shown(x);
        let mean = match arm.random {
            true => with_interval(arm.mean.map(shown), arm.mean_ci.map(|ci| ci.map(shown)), 3),
            false => or_dash(arm.mean.map(shown), 3),
        };
        rows.push(vec![
            arm.arm.clone(),
            compact(arm.kn_pa_per_m),
            arm.computed().to_string(),
            arm.failed().to_string(),
            mean,
            with_interval(arm.sigma.map(shown), arm.sigma_ci.map(|ci| ci.map(shown)), 3),
            with_interval(arm.cov.map(|x| x * 1e2), arm.cov_ci.map(|ci| ci.map(|x| x * 1e2)), 3),
        ]);
    }
    rows
}

/// What is to be said of an arm at one kn: whether it had walls enough, what limit analysis says of them, and which are not in the numbers.
pub(super) fn arm_notes(arm: &ArmSummary) -> [Option<String>; 3] {
    let of_arm = |note: String| format!("{} at kn {}: {note}", arm.arm, stiffness(arm.kn_pa_per_m));
    [
        arm.enough.as_ref().map(|enough| said_enough(arm, enough)),
        arm.limit_analysis.as_ref().map(|bounded| of_arm(bounded.words())),
        arm.note.clone().map(of_arm),
    ]
}

/// One line per arm and kn, and the notes below.
fn arms(arms: &[ArmSummary]) -> String {
    let mut text = aligned(arm_rows(arms));
    for [enough, bounded, note] in arms.iter().map(arm_notes) {
        text.extend([enough, bounded].into_iter().flatten().map(|said| wrapped("", &said)));
        text.extend(note.map(|note| wrapped("! ", &note)));
    }
    text
}

/// A line per kn and a column per pair of arms; as many tables as the width needs.
fn ratios(summary: &Summary) -> String {
    let mut columns: Vec<Vec<String>> = Vec::new();
    let mut pairs: Vec<(&str, &str)> = Vec::new();
    let mut kns: Vec<f64> = Vec::new();
    for comparison in &summary.comparisons {
        if !kns.contains(&comparison.kn_pa_per_m) {
            kns.push(comparison.kn_pa_per_m);
        }
        let pair = (comparison.arm.as_str(), comparison.over.as_str());
        let index = pairs.iter().position(|known| *known == pair).unwrap_or_else(|| {
            pairs.push(pair);
            columns.push(vec![format!(
                "{} / {}",
                shortened(pair.0, LONGEST_NAME),
                shortened(pair.1, LONGEST_NAME)
            )]);
            columns.len() - 1
        });
        let exact = comparison.ratio_ci.is_some_and(|[low, high]| low == high);
        columns[index].push(match exact {
            true => or_dash(comparison.ratio, 3),
            false => with_interval_against(comparison.ratio, comparison.ratio_ci, 3, 1.0),
        });
    }
    if columns.is_empty() {
        return String::new();
    }
    let first: Vec<String> =
        std::iter::once("kn Pa/m".to_string()).chain(kns.iter().copied().map(compact)).collect();
    let mut text = "\nRatios of means (without brackets: neither arm is random)\n".to_string();
    text.push_str(&side_by_side(&first, &columns));
    text
}

/// Columns behind a first one, heads included, in as many tables as the width needs.
pub(super) fn side_by_side(first: &[String], columns: &[Vec<String>]) -> String {
    let table = |group: &[Vec<String>]| {
        let row = |row: usize| {
            let cells = std::iter::once(first).chain(group.iter().map(Vec::as_slice));
            cells.map(|column| column.get(row).cloned().unwrap_or_default()).collect()
        };
        aligned((0..first.len()).map(row).collect())
    };
    fitting(first, columns).into_iter().map(table).collect::<Vec<_>>().join("\n")
}

/// Splits columns into groups that fit the width beside the first column.
fn fitting<'a>(first: &[String], columns: &'a [Vec<String>]) -> Vec<&'a [Vec<String>]> {
    let mut groups = Vec::new();
    let (mut start, mut used) = (0, width(first));
    for (index, column) in columns.iter().enumerate() {
        let own = width(column) + 2;
        if index > start && used + own > WIDTH {
            groups.push(&columns[start..index]);
            (start, used) = (index, width(first));
        }
        used += own;
    }
    groups.push(&columns[start..]);
    groups
}

fn published(summary: &Summary) -> String {
    if summary.published.is_empty() {
        return String::new();
    }
    let mut text = "\nPublished statements beside these numbers\n".to_string();
    for statement in &summary.published {
        let head = format!(
            "{}: {} ({})",
            statement.verdict.words().to_uppercase(),
            statement.claim,
            statement.source
        );
        text.push_str(&wrapped("  ", &head));
        for (name, words) in
            [("theirs", &statement.theirs), ("ours  ", &statement.ours), ("why   ", &statement.why)]
        {
            text.push_str(&wrapped(&format!("      {name}  "), words));
        }
    }
    text
}

/// Names longer than this are cut in tables.
pub(super) const LONGEST_NAME: usize = 18;

/// Rows as text: the first column to the left, numbers to the right, a rule below the first row.
pub(crate) fn aligned(mut rows: Vec<Vec<String>>) -> String {
    for row in &mut rows {
        row[0] = shortened(&row[0], LONGEST_NAME);
    }
    let columns = rows.first().map_or(0, Vec::len);
    let widths: Vec<usize> = (0..columns)
        .map(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0))
        .collect();
    let mut text = String::new();
    for (index, row) in rows.iter().enumerate() {
        let cells: Vec<String> = row
            .iter()
            .zip(&widths)
            .enumerate()
            .map(
                |(column, (cell, &width))| {
                    if column == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
                },
            )
            .collect();
        text.push_str(cells.join("  ").trim_end());
        text.push('\n');
        if index == 0 {
            text.push_str(&"-".repeat(widths.iter().sum::<usize>() + 2 * (columns - 1)));
            text.push('\n');
        }
    }
    text
}

fn width(column: &[String]) -> usize {
    column.iter().map(|cell| cell.chars().count()).max().unwrap_or(0)
}

/// Breaks a text at spaces; the first line begins with `lead`, the others with as many spaces.
pub(super) fn wrapped(lead: &str, text: &str) -> String {
    let indent = " ".repeat(lead.chars().count());
    let (mut lines, mut line, mut used) = (String::new(), lead.to_string(), 0);
    for word in text.split_whitespace() {
        if used > 0 && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push_str(&line);
            lines.push('\n');
            (line, used) = (indent.clone(), 0);
        }
        if used > 0 {
            line.push(' ');
        }
        line.push_str(word);
        used += 1;
    }
    lines + line.trim_end() + "\n"
}
