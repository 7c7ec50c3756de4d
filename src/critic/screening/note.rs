//! A note on measurements that look odd and are judged all the same, and its words.

use std::fmt;

use crate::math::degrees;
use crate::study::measured::Dimension;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement, listed};

/// A note on lines of the measurements. SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum DataNote {
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
    /// Mechanisms that cannot act on the walls that were measured.
    CannotAct {
        /// Their names, each with the reason.
        mechanisms: Vec<(&'static str, &'static str)>,
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
    /// Said to stand where the wall overturns as one rigid body.
    Overturned {
        /// The lines.
        lines: Vec<usize>,
        /// The first of the readings.
        first: Box<Measurement>,
        /// The tilt at which it overturns (rad).
        most: f64,
    },
    /// A mean, or a difference of centre and ends, that is not that of the points read beside it.
    Contradicted {
        /// The lines.
        lines: Vec<usize>,
        /// The mean or the difference.
        first: Box<Measurement>,
        /// What follows from the points.
        computed: f64,
    },
    /// Off from what its fellows show by the ratio of two units.
    OtherUnit {
        /// The lines.
        lines: Vec<usize>,
        /// The first of the readings.
        first: Box<Measurement>,
        /// What the specimens show there.
        usual: f64,
        /// The ratio of the units, below 1 where the readings are too small.
        factor: f64,
        /// How many readings.
        readings: usize,
        /// How much of the specimen these are.
        extent: Extent,
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

/// How much of a specimen is off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Of one specimen alone, which has so many of the kind.
    Whole(usize),
    /// Of one of two specimens, which has so many of the kind: either may be the odd one.
    OfTwo(usize),
    /// Of a specimen whose other readings are not off.
    Part,
}

impl fmt::Display for DataNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DataNote::OneSpecimen => f.write_str(
                "there is one specimen: the scatter between specimens cannot be judged, and none can be held out to see how \
                 well it is predicted",
            ),
            DataNote::NotConsidered { mechanisms } => write!(
                f,
                "too few walls of the bank came to a fall (pushed ones, to rest) under {}: these are not considered, and another cause may be named in \
                 their place; ask for more --points",
                mechanisms.join(", ")
            ),
            DataNote::CannotAct { mechanisms } => {
                let each: Vec<String> = mechanisms.iter().map(|(name, why)| format!("{name} ({why})")).collect();
                write!(f, "not considered, as they cannot act on these walls: {}", each.join(", "))
            }
            DataNote::Level { lines } => write!(
                f,
                "{}: a displacement at 0 deg is 0, as readings are relative to the one at rest at 0 deg, and is not used: if it is what \
                 was left after going back, number the readings in the column stage",
                listed(lines)
            ),
            DataNote::NotEvaluated { family, lines } => write!(
                f,
                "{}: {family} is an arm that the study does not evaluate here (study.arms): not used",
                listed(lines)
            ),
            DataNote::BeyondPlatform { lines, tilt, end } => write!(
                f,
                "{}: read at up to {}, and the study's platform goes to {}: check the tilts, or set load.end_deg",
                listed(lines),
                shown(Dimension::Angle, *tilt),
                shown(Dimension::Angle, *end),
            ),
            DataNote::ThickerThanWall { lines, first, thickness } => write!(
                f,
                "{}: {}, more than the wall's thickness of {}: is the unit right?",
                listed(lines),
                described(first),
                shown(Dimension::Length, *thickness)
            ),
            DataNote::Overturned { .. } | DataNote::Contradicted { .. } | DataNote::OtherUnit { .. } => self.of_the_table(f),
            DataNote::Fallen { lines, first } => write!(
                f,
                "{}: {}, where every simulated wall has fallen: only that the wall still stood there counts, as off; check the tilt",
                listed(lines),
                described(first)
            ),
            DataNote::OutOfRange { lines, first, range: [low, high], fits } => {
                let dimension = first.quantity.dimension();
                let [low, high] = [*low, *high].map(|x| shown(dimension, x));
                let of = format!("{}: {}", listed(lines), described(first));
                write!(f, "{of}, where 99.9 % of simulated readings lie within {low} to {high}")?;
                match fits {
                    Some(fits) => write!(f, "; {} would: was it meant in another unit?", shown(dimension, *fits)),
                    None => f.write_str(": check the value and its unit"),
                }
            }
        }
    }
}

impl DataNote {
    /// The words of a note that the measurements give rise to by themselves.
    fn of_the_table(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DataNote::Overturned { lines, first, most } => write!(
                f,
                "{}: {}, and a wall with free ends as the study draws it overturns as a whole at {}: check the angle, the \
                 thickness and the height",
                listed(lines),
                described(first),
                shown(Dimension::Angle, *most)
            ),
            DataNote::Contradicted { lines, first, computed } => write!(
                f,
                "{}: {}, where left, centre and right make it {}: are these readings of one wall at one tilt, in one unit?",
                listed(lines),
                described(first),
                shown(first.quantity.dimension(), *computed)
            ),
            _ => self.other_unit(f),
        }
    }

    /// The words of a specimen, or of a part of its readings, in another unit.
    fn other_unit(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DataNote::OtherUnit { lines, first, usual, factor, readings, extent } = self else {
            return Ok(());
        };
        let name = &first.specimen;
        let (times, size) = if *factor < 1.0 { (1.0 / factor, "small") } else { (*factor, "large") };
        let times = format!("by a factor of about {}", (10.0 * times).round() / 10.0);
        let usual = shown(first.quantity.dimension(), *usual);
        let compared = match extent {
            Extent::Whole(all) | Extent::OfTwo(all) if all > readings => " that can be compared",
            _ => "",
        };
        let (these, are) = match (readings, extent) {
            (1, _) => (first.quantity.name().to_owned(), "is"),
            (n, Extent::Part) => (format!("{n} readings"), "are"),
            (n, _) => (format!("all {n} readings{compared}"), "are"),
        };
        write!(f, "{}: ", listed(lines))?;
        match extent {
            Extent::Whole(_) => write!(f, "{name} alone is off {times} on {these}, which {are} too {size}")?,
            Extent::OfTwo(_) => {
                write!(
                    f,
                    "{name} is off {times} from the other specimen on {these}, which {are} too {size}"
                )?;
            }
            Extent::Part => write!(f, "{name} is off {times} on {these} alone, which {are} too {size}")?,
        }
        write!(f, " ({}, where {usual} is usual): was it meant in another unit?", described(first))
    }
}

/// A reading in words.
fn described(m: &Measurement) -> String {
    let value = match (m.quantity, m.kind) {
        (MeasuredQuantity::Outcome, MeasuredKind::Below) => "fell".to_owned(),
        (MeasuredQuantity::Outcome, _) => "stood".to_owned(),
        _ => shown(m.quantity.dimension(), m.value),
    };
    let at = m.quantity.at_or_after();
    let place = match (m.tilt, m.drift, &m.under) {
        (Some(tilt), ..) => format!(" {at} {}", shown(Dimension::Angle, tilt)),
        (None, Some(drift), _) => format!(" {at} a drift of {} %", (1e5 * drift).round() / 1e3),
        (None, None, Some(under)) => format!(" under {} times {}", under.record, under.scale),
        (None, None, None) => String::new(),
    };
    format!("{} of {} is {value}{place}", m.quantity.name(), m.specimen)
}

/// A value in the unit that people use, with four digits.
fn shown(dimension: Dimension, value: f64) -> String {
    let (number, unit) = match dimension {
        Dimension::Length => (value * 1e3, "mm"),
        Dimension::Angle => (degrees(value), "deg"),
        Dimension::Stiffness => (value, "Pa/m"),
        Dimension::Force => (value, "N"),
        Dimension::Outcome => (value, "of the motions survived"),
    };
    let rounded = format!("{number:.3e}").parse::<f64>().unwrap_or(number);
    if (1e-3..1e6).contains(&rounded.abs()) || rounded == 0.0 {
        format!("{rounded} {unit}")
    } else {
        format!("{rounded:e} {unit}")
    }
}
