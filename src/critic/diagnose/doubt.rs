//! A doubt about measurements that are judged all the same, and its words.

use std::fmt;

use crate::math::degrees;
use crate::study::Measurement;
use crate::study::measured::Dimension;

/// A doubt about lines of the measurements. SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Doubt {
    /// There is but one specimen.
    OneSpecimen,
    /// The bank has too few walls of some mechanisms.
    NotConsidered {
        /// The mechanisms.
        mechanisms: Vec<&'static str>,
    },
    /// Displacements at 0 deg that no earlier stage makes remainders of.
    Level {
        /// The lines.
        lines: Vec<usize>,
    },
    /// The study has the arm, but does not evaluate it.
    NotEvaluated {
        /// The arm.
        family: String,
        /// Its lines.
        lines: Vec<usize>,
    },
    /// Read at a tilt that the platform does not reach in the study.
    BeyondPlatform {
        /// The lines.
        lines: Vec<usize>,
        /// The largest of their tilts (rad).
        tilt: f64,
        /// Where the load path ends (rad).
        end: f64,
    },
    /// Displaced by more than the wall is thick.
    ThickerThanWall {
        /// The lines.
        lines: Vec<usize>,
        /// The first of the readings.
        first: Box<Measurement>,
        /// Thickness of the wall at the base (m).
        thickness: f64,
    },
    /// Read where simulated walls have fallen.
    Fallen {
        /// The lines.
        lines: Vec<usize>,
        /// The first of the readings.
        first: Box<Measurement>,
    },
    /// Beyond what simulated campaigns show.
    OutOfRange {
        /// The lines.
        lines: Vec<usize>,
        /// The first of the readings.
        first: Box<Measurement>,
        /// Where 99.9 % of the simulated values of the first lie.
        range: [f64; 2],
        /// What it would be in another unit, if that lies there.
        fits: Option<f64>,
    },
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Doubt::OneSpecimen => f.write_str(
                "there is one specimen: the scatter between specimens cannot be judged, and none can be held out to see how \
                 well it is predicted",
            ),
            Doubt::NotConsidered { mechanisms } => write!(
                f,
                "too few walls of the bank came to a fall under {}: these are not considered, and another cause may be named in \
                 their place; ask for more --points",
                mechanisms.join(", ")
            ),
            Doubt::Level { lines } => write!(
                f,
                "{}: a displacement at 0 deg is 0, as readings are relative to the one at rest at 0 deg, and is not used: if it is what \
                 was left after going back, number the readings in the column stage",
                listed(lines)
            ),
            Doubt::NotEvaluated { family, lines } => write!(
                f,
                "{}: {family} is an arm that the study does not evaluate here (study.arms): not used",
                listed(lines)
            ),
            Doubt::BeyondPlatform { lines, tilt, end } => write!(
                f,
                "{}: read at up to {}, and the study's platform goes to {}: check the tilts, or set load.end_deg",
                listed(lines),
                shown(Dimension::Angle, *tilt),
                shown(Dimension::Angle, *end),
            ),
            Doubt::ThickerThanWall { lines, first, thickness } => write!(
                f,
                "{}: {}, more than the wall's thickness of {}: is the unit right?",
                listed(lines),
                told(first),
                shown(Dimension::Length, *thickness)
            ),
            Doubt::Fallen { lines, first } => write!(
                f,
                "{}: {}, where every simulated wall has fallen: only that the wall still stood there counts, as off; check the tilt",
                listed(lines),
                told(first)
            ),
            Doubt::OutOfRange { lines, first, range: [low, high], fits } => {
                let dimension = first.quantity.dimension();
                let [low, high] = [*low, *high].map(|x| shown(dimension, x));
                let of = format!("{}: {}", listed(lines), told(first));
                write!(f, "{of}, where 99.9 % of simulated readings lie within {low} to {high}")?;
                match fits {
                    Some(fits) => write!(f, "; {} would: was it meant in another unit?", shown(dimension, *fits)),
                    None => f.write_str(": check the value and its unit"),
                }
            }
        }
    }
}

/// Lines of a file in words.
pub fn listed(lines: &[usize]) -> String {
    let words: Vec<String> = lines.iter().map(ToString::to_string).collect();
    if let [line] = &words[..] { format!("line {line}") } else { format!("lines {}", words.join(", ")) }
}

/// A reading in words.
fn told(m: &Measurement) -> String {
    let value = shown(m.quantity.dimension(), m.value);
    let at = m.quantity.at_or_after();
    let tilt = m.tilt.map(|tilt| format!(" {at} {}", shown(Dimension::Angle, tilt))).unwrap_or_default();
    format!("{} of {} is {value}{tilt}", m.quantity.name(), m.specimen)
}

/// A value in the unit that people use, with four digits.
fn shown(dimension: Dimension, value: f64) -> String {
    let (number, unit) = match dimension {
        Dimension::Length => (value * 1e3, "mm"),
        Dimension::Angle => (degrees(value), "deg"),
        Dimension::Stiffness => (value, "Pa/m"),
        Dimension::Force => (value, "N"),
    };
    let rounded = format!("{number:.3e}").parse::<f64>().unwrap_or(number);
    if (1e-3..1e6).contains(&rounded.abs()) || rounded == 0.0 {
        format!("{rounded} {unit}")
    } else {
        format!("{rounded:e} {unit}")
    }
}
