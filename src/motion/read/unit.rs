//! What the header of a record says of the unit of its values.

use crate::motion::read::samples::Unit;

/// The unit of acceleration that a word names, however it is written: `g`, `(g)`, `cm/s^2`, `CM/SEC/SEC`, `gal`, `m/s2`.
pub(super) fn named(word: &str) -> Option<Unit> {
    let bare: String =
        word.to_ascii_uppercase().chars().filter(|c| !" \t\"'()[]{}.^*".contains(*c)).collect();
    match bare.replace("SEC", "S").replace("/S/S", "/S2").as_str() {
        "G" | "GS" => Some(Unit::Gravity),
        "CM/S2" | "GAL" | "GALS" => Some(Unit::CentimetrePerSquareSecond),
        "M/S2" => Some(Unit::MetrePerSquareSecond),
        _ => None,
    }
}

/// What a line of a header says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Said {
    /// The unit of accelerations.
    Acceleration(Unit),
    /// That the values are no accelerations.
    Other,
    /// A unit that is not known.
    Unknown,
}

/// Words behind which a unit is stated.
const STATES: [&str; 6] = ["UNITS OF", "UNITS ARE", "UNITS IN", "UNITS:", "UNITS=", "UNIT:"];
/// Words of a line that speaks of single values, not of all.
const SINGLE: [&str; 5] = ["PEAK", "MAX", "PGA", "PGV", "PGD"];

/// What a line says of the unit of the values: `IN UNITS OF G`, `The units are (g)`, `Acceleration in g`, `ACCELERATION (G)`.
pub(super) fn said(line: &str) -> Option<Said> {
    let line = line.to_ascii_uppercase();
    let has = |words: &[&str]| words.iter().any(|word| line.contains(word));
    let is_other = has(&["VELOC", "DISPL"]) && !has(&["ACC"]);
    if let Some(rest) = STATES.iter().find_map(|words| Some(line.split_once(words)?.1)) {
        return Some(match named(first_word(rest)) {
            _ if is_other => Said::Other,
            Some(unit) => Said::Acceleration(unit),
            None => Said::Unknown,
        });
    }
    if has(&SINGLE) || !has(&["ACC", "VELOC", "DISPL"]) {
        return None;
    }
    let behind = line.rsplit_once(" IN ").map(|(_, rest)| first_word(rest));
    let within = line.split('(').skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
    let words: Vec<&str> = behind.into_iter().chain(within).collect();
    match words.iter().find_map(|word| named(word)) {
        Some(unit) if !is_other => Some(Said::Acceleration(unit)),
        Some(_) => Some(Said::Other),
        None => {
            let is_length = |word: &&str| matches!(*word, "CM" | "M" | "CM/S" | "CM/SEC" | "M/S" | "M/SEC");
            (is_other && words.iter().any(is_length)).then_some(Said::Other)
        }
    }
}

/// The first word, without the point that ends a sentence.
fn first_word(text: &str) -> &str {
    let text = text.trim_start_matches([' ', '\t', '=', ':']);
    text.split([' ', '\t', ',', ';']).next().unwrap_or_default().trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_known_however_the_header_writes_it() {
        let g = Said::Acceleration(Unit::Gravity);
        let cm = Said::Acceleration(Unit::CentimetrePerSquareSecond);
        for (line, wanted) in [
            ("ACCELERATION TIME SERIES IN UNITS OF G", Some(g)),
            ("Acceleration in g", Some(g)),
            ("ACCELERATION (G)", Some(g)),
            ("The units are (g)", Some(g)),
            ("Units: g. Filter points: hp=0.2", Some(g)),
            ("ACCELERATION TIME HISTORY IN UNITS OF CM/SEC/SEC", Some(cm)),
            ("acceleration, units=cm/s**2, corrected", Some(cm)),
            ("ACCEL. IN GAL", Some(cm)),
            ("Acceleration [component 090] in m/s^2", Some(Said::Acceleration(Unit::MetrePerSquareSecond))),
            ("VELOCITY TIME SERIES IN UNITS OF CM/S", Some(Said::Other)),
            ("Displacement (cm)", Some(Said::Other)),
            ("ACCELERATION IN UNITS OF FURLONGS", Some(Said::Unknown)),
            ("rotation angle - clockwise   -37.0", None),
            ("Orig PEER filename = X/Y.acc, Scale factor = 2.4", None),
            ("PGA, PEAK VELOCITY (G, CM/S) = 0.3 21", None),
            ("Acceleration recorded in California", None),
        ] {
            assert_eq!(said(line), wanted, "{line}");
        }
    }
}
