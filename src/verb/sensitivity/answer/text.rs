//! What is printed of the map: the table, and a sentence per mechanism.

use crate::critic::Sight;
use crate::render::text::{side_by_side, wrapped};
use crate::verb::sensitivity::answer::SensitivitySummary;
use crate::verb::sensitivity::answer::entry::{MechanismEntry, ObservableEntry};

/// How the signs of the table are read.
pub(crate) const SIGNS: &str = "~: the interval includes 0; falls: collapsed before the reading; fallen: also without the \
    mechanism; stands: reaches the reading only with it; end: stood to the end of the load path; n/a: not applicable; lost: \
    not solved; -: no error is known";

/// The map for a terminal.
pub fn sensitivity_text(summary: &SensitivitySummary) -> String {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let mut text = conclusion(summary, &variant);
    text.push_str("\nChange of every measured quantity, in units of its error\n");
    text.push_str(&wrapped("", &format!("{}. {SIGNS}.", capital(summary.definition))));
    text.push('\n');
    for family in families(summary) {
        text.push_str(&table(summary, family));
        text.push('\n');
    }
    text.push_str("What each mechanism was\n");
    for row in &summary.mechanisms {
        text.push_str(&wrapped("  ", &format!("{}: {}", row.mechanism, row.strength())));
    }
    text
}

/// Which mechanisms the data could see, which perhaps, which not.
fn conclusion(summary: &SensitivitySummary, variant: &str) -> String {
    let sees = |row: &&MechanismEntry, sight: Sight| row.cells.iter().any(|cell| cell.sight == sight);
    let rows = || summary.mechanisms.iter();
    let seen: Vec<&MechanismEntry> = rows().filter(|row| sees(row, Sight::Seen)).collect();
    let perhaps: Vec<&MechanismEntry> =
        rows().filter(|row| !sees(row, Sight::Seen) && sees(row, Sight::Perhaps)).collect();
    let unseen: Vec<&MechanismEntry> =
        rows().filter(|row| !sees(row, Sight::Seen) && !sees(row, Sight::Perhaps)).collect();
    let list = |found: &[&MechanismEntry]| match found {
        [] => "none".to_string(),
        some => some.iter().map(|row| named(row)).collect::<Vec<_>>().join(", "),
    };
    let head = format!(
        "{}{variant}: data like these could see {} of {} mechanisms, each at the {} quantile of its priors ({} walls per family, \
         seed {}).",
        summary.study,
        seen.len(),
        summary.mechanisms.len(),
        summary.quantile,
        summary.members,
        summary.seed
    );
    [
        head,
        format!("Seen: {}.", list(&seen)),
        format!("Perhaps: {}.", list(&perhaps)),
        format!("Not seen: {}.", list(&unseen)),
    ]
    .iter()
    .map(|line| wrapped("", line))
    .collect()
}

/// A mechanism with the largest change it makes, in errors.
fn named(row: &MechanismEntry) -> String {
    largest(row).map_or_else(|| row.mechanism.to_string(), |most| format!("{} ({most:.1})", row.mechanism))
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

/// A line per mechanism and a column per observable of a family, in as many tables as the width needs.
fn table(summary: &SensitivitySummary, family: &str) -> String {
    let own = (0..summary.observables.len()).filter(|&k| summary.observables[k].family == family);
    let columns: Vec<Vec<String>> = own
        .map(|k| {
            let head = heading(&summary.observables[k]).join(" ");
            std::iter::once(head).chain(summary.mechanisms.iter().map(|row| row.cells[k].shown())).collect()
        })
        .collect();
    let names = summary.mechanisms.iter().map(|row| row.mechanism.to_string());
    let first: Vec<String> = std::iter::once(family.to_string()).chain(names).collect();
    side_by_side(&first, &columns)
}

/// The head of a column, in two lines.
pub(crate) fn heading(observable: &ObservableEntry) -> [String; 2] {
    let bound = if observable.bounds_only { " *" } else { "" };
    let tilt = observable.tilt_deg.map(|tilt| format!("{tilt} deg")).unwrap_or_default();
    [observable.short().to_string(), format!("{tilt}{bound}")]
}

/// The largest change in errors, either way.
fn largest(row: &MechanismEntry) -> Option<f64> {
    row.cells.iter().filter_map(|cell| cell.in_errors).map(f64::abs).reduce(f64::max)
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}
