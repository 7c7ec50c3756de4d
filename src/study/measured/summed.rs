//! Rows that sum others up, as spreadsheets have them below a table: a mean is no specimen.

use std::collections::BTreeSet;

use crate::study::fault::{Fault, Found, Place};
use crate::study::measured::measurement::Measurement;

/// What such rows are called, in English, German, French, Italian and Spanish.
const NAMES: [&str; 23] = [
    "mean",
    "average",
    "avg",
    "total",
    "sum",
    "median",
    "min",
    "max",
    "sd",
    "std",
    "stdev",
    "cov",
    "mittelwert",
    "mittel",
    "summe",
    "streuung",
    "moyenne",
    "somme",
    "media",
    "somma",
    "promedio",
    "suma",
    "count",
];

/// A warning for each specimen that is called as a row that sums others up.
pub(super) fn warnings(rows: &[(Measurement, Place)]) -> Vec<Fault> {
    let mut seen = BTreeSet::new();
    let is_summed = |m: &Measurement| {
        let bare: String = m.specimen.to_lowercase().chars().filter(|c| c.is_alphabetic()).collect();
        NAMES.contains(&bare.as_str()) && m.specimen.chars().all(|c| !c.is_ascii_digit())
    };
    let own = rows.iter().filter(|(m, _)| is_summed(m) && seen.insert(m.specimen.clone()));
    let warning = |(m, place): &(Measurement, Place)| {
        let found = Found::Words(format!("is \"{}\", and counts as one more specimen", m.specimen));
        let fix = "remove the row if it sums the others up, or give the specimen another name";
        Fault::at(place, "specimen", found, "this", fix)
    };
    own.map(warning).collect()
}
