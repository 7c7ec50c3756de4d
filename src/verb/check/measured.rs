//! `pirca check --measured`: what is read from a table of measurements.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde_json::json;

use crate::critic::{Design, data_notes};
use crate::math::degrees;
use crate::study::measured::Dimension;
use crate::study::{Loaded, MEASURED, MeasuredKind, MeasuredQuantity, Measurement, Study, Written, listed};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::arguments::Which;
use crate::verb::diagnose::bank;

/// Says what is read from a file.
pub(super) fn check(which: &Which, file: Option<&Path>) -> Result<Answer, Failure> {
    let loaded = bank::measured(which, file)?;
    let Some(how) = &loaded.written else {
        let study = which.study.display();
        return Err(Failure::Input(format!(
            "{}: there is no {MEASURED} in the study's folder; name a file, or have an empty one written by\n  \
             pirca init {MEASURED} --measured {study}",
            loaded.study.name
        )));
    };
    let notes = bank::noted(&data_notes(&loaded.study, &Design::of(&loaded.study).0));
    let file = file.unwrap_or(Path::new(MEASURED));
    Answer::of(summary(&loaded.study, how, file, &notes), &told(&loaded, how, file, &notes))
}

/// The readings of one quantity in one family.
struct Group<'m> {
    family: &'m str,
    quantity: MeasuredQuantity,
    readings: Vec<&'m Measurement>,
}

impl<'m> Group<'m> {
    /// All of them, families in the order of the file.
    fn all(study: &'m Study) -> Vec<Group<'m>> {
        let mut groups: Vec<Group<'m>> = Vec::new();
        for m in &study.measured {
            match groups.iter_mut().find(|own| own.family == m.family && own.quantity == m.quantity) {
                Some(own) => own.readings.push(m),
                None => groups.push(Group { family: &m.family, quantity: m.quantity, readings: vec![m] }),
            }
        }
        groups.sort_by_key(|own| study.measured.iter().position(|m| m.family == own.family));
        groups
    }

    fn count(&self, kind: MeasuredKind) -> usize {
        self.readings.iter().filter(|m| m.kind == kind).count()
    }

    /// The tilts that were read at (deg), each once, ascending.
    fn tilts(&self) -> Vec<f64> {
        let tilts: BTreeSet<u64> = self.readings.iter().filter_map(|m| m.tilt).map(f64::to_bits).collect();
        // A tilt is not negative, so that its bits are in its order.
        tilts.into_iter().map(|bits| rounded(degrees(f64::from_bits(bits)))).collect()
    }

    /// The smallest and the largest value, in a unit that people use.
    fn range(&self) -> ([f64; 2], &'static str) {
        let (scale, unit) = match self.quantity.dimension() {
            Dimension::Length => (1e3, "mm"),
            Dimension::Angle => (degrees(1.0), "deg"),
            Dimension::Stiffness => (1.0, "Pa/m"),
            Dimension::Force => (1.0, "N"),
            Dimension::Outcome => (1.0, ""),
        };
        let values = || self.readings.iter().map(|m| m.value);
        let range = [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)];
        (range.map(|value| rounded(value * scale)), unit)
    }
}

/// To six digits: what was written in degrees or millimetres is not shown with the last bits of a conversion.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// The specimens with their families and numbers of readings, in the order of the file.
fn specimens(study: &Study) -> Vec<(&str, &str, usize)> {
    let mut found: Vec<(&str, &str, usize)> = Vec::new();
    for m in &study.measured {
        match found.iter_mut().find(|own| own.0 == m.specimen) {
            Some(own) => own.2 += 1,
            None => found.push((&m.specimen, &m.family, 1)),
        }
    }
    found
}

fn counted(n: usize, one: &str, several: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { several })
}

fn separator(how: &Written) -> String {
    match how.separator {
        ',' => "commas".to_owned(),
        ';' => "semicolons".to_owned(),
        '\t' => "tabs".to_owned(),
        other => format!("`{other}`"),
    }
}

fn units(how: &Written, quantity: MeasuredQuantity) -> Vec<&str> {
    // A remainder may have been written as a displacement after going back.
    let own = how.units.get(&quantity).or_else(|| how.units.get(&quantity.remains_of()?));
    own.into_iter().flatten().map(String::as_str).collect()
}

fn summary(study: &Study, how: &Written, file: &Path, notes: &[String]) -> String {
    let (readings, specimens) = (study.measured.len(), specimens(study));
    let mut families: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    specimens.iter().for_each(|(name, family, _)| families.entry(family).or_default().push(name));
    let odd = match notes.len() {
        0 => "nothing looks odd".to_owned(),
        n => format!("{} on standard error", counted(n, "note on what looks odd", "notes on what looks odd")),
    };
    let mut text = format!(
        "{}: {} on {}; {odd}\n  {}, separated by {}, decimals with a {}\n",
        file.display(),
        counted(readings, "reading", "readings"),
        counted(specimens.len(), "specimen", "specimens"),
        if how.wide { "a row per tilt" } else { "a row per value" },
        separator(how),
        if how.decimal_comma { "comma" } else { "point" },
    );
    if !how.unfilled.is_empty() {
        text.push_str(&format!("  without a value: {}\n", listed(&how.unfilled)));
    }
    text.push_str("\nSpecimens\n");
    for (family, names) in families {
        text.push_str(&format!("  {family}: {}\n", names.join(", ")));
    }
    text.push_str("\nReadings\n");
    for group in Group::all(study) {
        let ([low, high], unit) = group.range();
        let kinds = [MeasuredKind::Exact, MeasuredKind::Rounded, MeasuredKind::Below, MeasuredKind::Above];
        let kinds: Vec<String> = kinds
            .into_iter()
            .zip(["exact", "rounded", "below a bound", "above a bound"])
            .map(|(kind, name)| (group.count(kind), name))
            .filter(|(count, _)| *count > 0)
            .map(|(count, name)| format!("{count} {name}"))
            .collect();
        let tilts: Vec<String> = group.tilts().iter().map(f64::to_string).collect();
        let at = match tilts.is_empty() {
            true => String::new(),
            false => format!("; {} {} deg", group.quantity.at_or_after(), tilts.join(", ")),
        };
        let stated = units(how, group.quantity).join(", ");
        let range = if low == high { low.to_string() } else { format!("{low} to {high}") };
        text.push_str(&format!(
            "  {} {}: {}; {range} {unit}, written in {stated}{at}\n",
            group.family,
            group.quantity.name(),
            kinds.join(", ")
        ));
    }
    text
}

fn told(loaded: &Loaded, how: &Written, file: &Path, notes: &[String]) -> serde_json::Value {
    let study = &loaded.study;
    json!({
        "study": study.name,
        "variant": study.variant,
        "file": file.display().to_string(),
        "sha256": loaded.stated.measured().map(|(_, sha256)| sha256),
        "shape": if how.wide { "wide" } else { "long" },
        "separator": how.separator.to_string(),
        "decimal": if how.decimal_comma { "," } else { "." },
        "readings": study.measured.len(),
        "specimens": specimens(study).iter().map(|(name, family, readings)| json!({
            "specimen": name,
            "family": family,
            "readings": readings,
        })).collect::<Vec<_>>(),
        "quantities": Group::all(study).iter().map(|group| {
            let (range, unit) = group.range();
            json!({
                "family": group.family,
                "quantity": group.quantity.name(),
                "readings": group.readings.len(),
                "exact": group.count(MeasuredKind::Exact),
                "rounded": group.count(MeasuredKind::Rounded),
                "below": group.count(MeasuredKind::Below),
                "above": group.count(MeasuredKind::Above),
                "written_in": units(how, group.quantity),
                "range": range,
                "range_unit": unit,
                "tilts_deg": group.tilts(),
            })
        }).collect::<Vec<_>>(),
        "lines_without_value": how.unfilled,
        "warnings": loaded.warnings,
        "notes": notes,
    })
}
