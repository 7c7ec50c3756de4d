//! What is printed of the map: the table, and a sentence per mechanism.

use crate::critic::Sight;
use crate::report::sensitivity::SensitivitySummary;
use crate::report::sensitivity::entry::{MechanismEntry, ObservableEntry};
use crate::report::table::{aligned, wrapped};

/// How the signs of the table are read.
pub(super) const SIGNS: &str = "~: the interval includes 0; falls: collapsed before the reading; fallen: also without the \
    mechanism; stands: reaches the reading only with it; end: stood to the end of the load path; n/a: not applicable; lost: \
    not solved; -: no error is known";

/// The map for a terminal.
pub fn sensitivity_text(summary: &SensitivitySummary) -> String {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let head = format!(
        "Study {}{variant}, seed {}: what each mechanism changes, at the {} quantile of its priors from the weak end, {} walls \
         per family",
        summary.study, summary.seed, summary.quantile, summary.members
    );
    let mut text = wrapped("", &head);
    text.push_str(&wrapped("", &format!("In units of the error. {}. {SIGNS}.", capital(summary.definition))));
    text.push('\n');
    for family in families(summary) {
        text.push_str(&table(summary, family));
        text.push('\n');
    }
    for row in &summary.mechanisms {
        text.push_str(&wrapped("  ", &sentence(row, &summary.observables)));
    }
    text
}

fn families(summary: &SensitivitySummary) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for observable in &summary.observables {
        if !names.contains(&observable.family.as_str()) {
            names.push(&observable.family);
        }
    }
    names
}

/// A line per mechanism and a column per observable of a family.
fn table(summary: &SensitivitySummary, family: &str) -> String {
    let columns: Vec<usize> =
        (0..summary.observables.len()).filter(|&k| summary.observables[k].family == family).collect();
    let mut header = vec![family.to_string()];
    header.extend(columns.iter().map(|&k| heading(&summary.observables[k]).join(" ")));
    let mut rows = vec![header];
    for row in &summary.mechanisms {
        let mut line = vec![row.mechanism.to_string()];
        line.extend(columns.iter().map(|&k| row.cells[k].shown()));
        rows.push(line);
    }
    aligned(rows)
}

/// The head of a column, in two lines.
pub(super) fn heading(observable: &ObservableEntry) -> [String; 2] {
    let bound = if observable.bounds_only { " *" } else { "" };
    let tilt = observable.tilt_deg.map(|tilt| format!("{tilt} deg")).unwrap_or_default();
    [observable.short().to_string(), format!("{tilt}{bound}")]
}

/// Which of the data could see a mechanism.
fn sentence(row: &MechanismEntry, observables: &[ObservableEntry]) -> String {
    let list = |sight: Sight| {
        let found = row.cells.iter().zip(observables).filter(|(cell, _)| cell.sight == sight);
        found.map(|(cell, one)| format!("{} ({})", one.words(), cell.shown())).collect::<Vec<_>>()
    };
    let (seen, perhaps) = (list(Sight::Seen), list(Sight::Perhaps));
    let said = match (seen.is_empty(), perhaps.is_empty()) {
        (true, true) => match largest(row) {
            Some(most) => format!("none of the data could see it (at most {most:.1} errors)"),
            None => "none of the data could see it".to_string(),
        },
        (true, false) => format!("the data could perhaps see it in {}", perhaps.join(", ")),
        (false, true) => format!("the data could see it in {}", seen.join(", ")),
        (false, false) => {
            format!("the data could see it in {}, and perhaps in {}", seen.join(", "), perhaps.join(", "))
        }
    };
    format!("{} ({}): {said}.", row.mechanism, row.strength())
}

/// The largest change in errors, either way.
fn largest(row: &MechanismEntry) -> Option<f64> {
    row.cells.iter().filter_map(|cell| cell.in_errors).map(f64::abs).reduce(f64::max)
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}
