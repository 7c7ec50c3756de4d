//! What is printed of the readings: which of them explain what was published, and by which numbers.

use crate::render::text::wrapped;
use crate::verb::readings::answer::entry::{Extent, ReadingEntry, ReadingsSummary};
use crate::verb::run::answer::published::Verdict;

/// So many readings are listed at most; files hold all.
const MOST_LISTED: usize = 12;
/// So many of the best are shown with their numbers.
const MOST_SHOWN: usize = 2;

/// The readings for a terminal.
pub fn readings_text(summary: &ReadingsSummary) -> String {
    let mut text = conclusion(summary);
    text.push_str(
        "\nReadings, the best ones first (y: reproduced, n: not reproduced, ?: cannot be judged)\n",
    );
    let listed: Vec<&ReadingEntry> = summary.in_full().take(MOST_LISTED).collect();
    let width = listed.iter().map(|one| one.name().chars().count()).max().unwrap_or(0);
    for one in &listed {
        let marks: String = one.statements.iter().map(|s| format!("  {}", mark(s.verdict))).collect();
        text.push_str(&format!("  {:<width$}{marks}\n", one.name()));
    }
    let left = summary.in_full().count() - listed.len();
    if left > 0 {
        text.push_str(&format!("  ({left} more in readings.csv)\n"));
    }
    text.push_str("\nStatements\n");
    for (number, statement) in summary.statements.iter().enumerate() {
        text.push_str(&wrapped(&format!("  {}  ", number + 1), statement));
    }
    for one in summary.explaining().take(MOST_SHOWN) {
        text.push_str(&format!("\n{}\n", one.name()));
        for (number, statement) in one.statements.iter().enumerate() {
            let words =
                format!("{}; stated {}; {}", statement.ours, statement.theirs, statement.verdict.words());
            text.push_str(&wrapped(&format!("  {}  ", number + 1), &words));
        }
    }
    text
}

/// The sign of a verdict.
pub(crate) fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Reproduced => "y",
        Verdict::NotReproduced => "n",
        Verdict::CannotJudge => "?",
    }
}

/// Which readings explain most, and how many were tried.
fn conclusion(summary: &ReadingsSummary) -> String {
    let all = summary.statements.len();
    let with = |n: usize| -> Vec<&ReadingEntry> {
        summary.in_full().filter(|one| one.reproduced == Some(n)).collect()
    };
    let most = summary.in_full().filter_map(|one| one.reproduced).max().unwrap_or(0);
    let best = with(most);
    let fewest = best.first().map_or(0, |one| one.variants.len());
    let names: Vec<String> =
        best.iter().take_while(|one| one.variants.len() == fewest).map(|one| one.name()).collect();
    let base =
        summary.in_full().find(|one| one.variants.is_empty()).and_then(|one| one.reproduced).unwrap_or(0);
    let of = |extent| summary.readings.iter().filter(|one| one.extent == extent).count();
    let refused = match of(Extent::Refused) {
        0 => String::new(),
        some => format!(", {some} do not go together"),
    };
    [
        format!("{}: at most {most} of {all} statements come out together; {base} in the main reading.", summary.study),
        format!("With the fewest departures ({fewest}) by: {}.", names.join(", ")),
        format!(
            "{} readings of up to {} variants: {} evaluated in full, {} dropped after {} walls of each arm at the ends of \
             kn{refused}.",
            summary.readings.len(),
            summary.departures,
            of(Extent::Full),
            of(Extent::FirstWalls),
            summary.first_walls
        ),
    ]
    .iter()
    .map(|line| wrapped("", line))
    .collect()
}
