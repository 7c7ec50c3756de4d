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

/// Leaves such rows out, with a warning for each specimen.
pub(super) fn left_out(rows: &mut Vec<(Measurement, Place)>) -> Vec<Fault> {
    let is_summed = |m: &Measurement| {
        let bare: String = m.specimen.to_lowercase().chars().filter(|c| c.is_alphabetic()).collect();
        NAMES.contains(&bare.as_str()) && m.specimen.chars().all(|c| !c.is_ascii_digit())
    };
    let out: Vec<(Measurement, Place)> = rows.extract_if(.., |(m, _)| is_summed(m)).collect();
    let mut seen = BTreeSet::new();
    let own = out.iter().filter(|(m, _)| seen.insert(m.specimen.clone()));
    let warning = |(m, place): &(Measurement, Place)| {
        let found =
            Found::Words(format!("is \"{}\", which sums others up: the row was left out", m.specimen));
        Fault::at(place, "specimen", found, "this", "give the specimen another name if it is one")
    };
    own.map(warning).collect()
}
