//! Numbers as a person writes them, with their unit: `"30 deg"`, `"2 mm"`, `"25 kN/m3"`.

use std::f64::consts::PI;

use crate::math::STANDARD_GRAVITY;

/// What one of a unit is in that of a key.
#[derive(Clone, Copy, Debug, PartialEq)]
enum One {
    /// So many.
    Times(f64),
    /// One of so many: divided, so that 19 mm and 1.9 cm are the same number as 0.019 m.
    Over(f64),
}

/// The units of keys, and those in which a number for them may be written.
const UNITS: &[(&str, &[(&str, One)])] = &[
    ("m", &[("m", One::Times(1.0)), ("cm", One::Over(1e2)), ("mm", One::Over(1e3))]),
    ("deg", &[("deg", One::Times(1.0)), ("rad", One::Over(PI / 180.0))]),
    (
        "Pa",
        &[
            ("Pa", One::Times(1.0)),
            ("kPa", One::Times(1e3)),
            ("MPa", One::Times(1e6)),
            ("GPa", One::Times(1e9)),
            ("kN/m2", One::Times(1e3)),
            ("N/mm2", One::Times(1e6)),
        ],
    ),
    (
        "Pa/m",
        &[
            ("Pa/m", One::Times(1.0)),
            ("kPa/m", One::Times(1e3)),
            ("MPa/m", One::Times(1e6)),
            ("GPa/m", One::Times(1e9)),
            ("N/mm3", One::Times(1e9)),
        ],
    ),
    (
        "kg/m3",
        &[
            ("kg/m3", One::Times(1.0)),
            ("t/m3", One::Times(1e3)),
            ("kN/m3", One::Over(1e-3 * STANDARD_GRAVITY)),
        ],
    ),
    ("N", &[("N", One::Times(1.0)), ("kN", One::Times(1e3))]),
    ("N/m", &[("N/m", One::Times(1.0)), ("kN/m", One::Times(1e3))]),
    ("s", &[("s", One::Times(1.0)), ("ms", One::Over(1e3))]),
    ("g", &[("g", One::Times(1.0)), ("m/s2", One::Over(STANDARD_GRAVITY))]),
    ("m/s2", &[("m/s2", One::Times(1.0)), ("g", One::Times(STANDARD_GRAVITY))]),
    ("Hz", &[("Hz", One::Times(1.0))]),
    ("%", &[("%", One::Times(1.0))]),
    ("1", &[("%", One::Over(1e2))]),
];

/// The units in which a number for a key of a unit may be written; none where it is a plain number.
fn units(unit: &str) -> &'static [(&'static str, One)] {
    UNITS.iter().find(|(own, _)| *own == unit).map_or(&[], |(_, units)| units)
}

/// The names of these units.
pub fn names(unit: &str) -> Vec<&'static str> {
    units(unit).iter().map(|(name, _)| *name).collect()
}

/// A number with one of these units, in the unit of the key; `None` where the text is nothing of the kind.
pub fn read(text: &str, unit: &str) -> Option<f64> {
    let text = text.trim();
    let (number, one) = units(unit).iter().find_map(|(name, one)| {
        let number: f64 = text.strip_suffix(name)?.trim_end().parse().ok()?;
        Some((number, *one))
    })?;
    match one {
        One::Times(factor) => Some(number * factor),
        One::Over(parts) => Some(number / parts),
    }
}

/// Whether a text begins as a number does.
pub fn is_number(text: &str) -> bool {
    text.trim_start()
        .trim_start_matches(['+', '-'])
        .trim_start_matches('.')
        .starts_with(|own: char| own.is_ascii_digit())
}

/// A regular expression of these texts, for editors.
pub fn pattern(unit: &str) -> Option<String> {
    let names = names(unit);
    (!names.is_empty()).then(|| format!("^\\s*[+-]?[0-9.]+([eE][+-]?[0-9]+)?\\s*({})\\s*$", names.join("|")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_in_the_unit_of_their_key() {
        for (text, unit, wanted) in [
            ("2 mm", "m", 0.002),
            ("2mm", "m", 0.002),
            ("1.9 cm", "m", 0.019),
            ("2.5e3 mm", "m", 2.5),
            ("30 deg", "deg", 30.0),
            ("50 MPa/m", "Pa/m", 5e7),
            ("0.05 N/mm3", "Pa/m", 5e7),
            ("2.4 t/m3", "kg/m3", 2400.0),
            ("15 %", "1", 0.15),
            ("5 %", "%", 5.0),
            ("12 kN", "N", 12e3),
            ("20 ms", "s", 0.02),
        ] {
            assert_eq!(read(text, unit), Some(wanted), "{text}");
        }
        assert!((read("25 kN/m3", "kg/m3").expect("a weight") - 2549.29).abs() < 0.01);
        assert!((read("0.5 rad", "deg").expect("an angle") - 28.6479).abs() < 1e-4);
        assert!((read("1.471 m/s2", "g").expect("a share of gravity") - 0.15).abs() < 1e-4);
    }

    #[test]
    fn what_cannot_be_meant_is_nothing() {
        for (text, unit) in [
            ("2 mm", "deg"),
            ("2 in", "m"),
            ("mm", "m"),
            ("two mm", "m"),
            ("2", "m"),
            ("2 m", "1/s"),
            ("2 kN", "kg/m3"),
        ] {
            assert_eq!(read(text, unit), None, "{text}");
        }
        assert!(is_number("-3 deg") && is_number(".5 m"));
        assert!(!is_number("joint/friction:paper") && !is_number("../size:length"));
    }
}
