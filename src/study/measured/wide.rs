//! The names of the columns of a wide table: a row per specimen and tilt, a column per quantity.

use crate::study::csv::compared;
use crate::study::measured::measurement::MeasuredQuantity;
use crate::study::measured::unit::Dimension;

/// Short names that stand for displacements.
const SHORT: [(&str, MeasuredQuantity); 6] = [
    ("left", MeasuredQuantity::DisplacementLeft),
    ("centre", MeasuredQuantity::DisplacementCentre),
    ("center", MeasuredQuantity::DisplacementCentre),
    ("right", MeasuredQuantity::DisplacementRight),
    ("mean", MeasuredQuantity::DisplacementMean),
    ("centre_minus_ends", MeasuredQuantity::DisplacementCentreMinusEnds),
];

/// What a wide table may say of a quantity in columns of its own, besides the value.
const OWN: [&str; 4] = ["common_error", "error", "resolution", "kind"];

/// What a column of a wide table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Meant {
    /// Of which quantity; `None` where it is said of all lengths.
    pub quantity: Option<MeasuredQuantity>,
    /// The column of a long table that it stands for.
    pub column: &'static str,
    /// The unit in its name.
    pub unit: Option<&'static str>,
}

impl Meant {
    /// What a column of that name holds: `left_mm`, `collapse_angle_deg`, `mean_error` or `error_mm`; `None` where the name is not of a
    /// wide table alone.
    pub fn by(name: &str) -> Option<Meant> {
        let name = compared(name);
        let long = MeasuredQuantity::ALL.map(|quantity| (quantity.name(), quantity));
        let of_one = long.into_iter().chain(SHORT).find_map(|(alias, quantity)| {
            let (column, unit) = property(behind(&name, alias)?, quantity.dimension())?;
            Some(Meant { quantity: Some(quantity), column, unit })
        });
        // Without a unit these are columns of a long table as well.
        of_one.or_else(|| match property(&name, Dimension::Length)? {
            (column, Some(unit)) if column != "value" => {
                Some(Meant { quantity: None, column, unit: Some(unit) })
            }
            _ => None,
        })
    }
}

/// What follows a beginning of a name and an underscore, or nothing.
fn behind<'n>(name: &'n str, beginning: &str) -> Option<&'n str> {
    let rest = name.strip_prefix(beginning)?;
    if rest.is_empty() { Some(rest) } else { rest.strip_prefix('_') }
}

/// What is said of a quantity by the end of a column's name, and the unit in it.
fn property(end: &str, dimension: Dimension) -> Option<(&'static str, Option<&'static str>)> {
    let unit = |text: &str| dimension.units().iter().find(|unit| unit.eq_ignore_ascii_case(text)).copied();
    let own = OWN.into_iter().find_map(|column| {
        let rest = behind(end, column)?;
        match (rest, column) {
            ("", _) => Some((column, None)),
            (_, "kind") => None,
            _ => unit(rest).map(|unit| (column, Some(unit))),
        }
    });
    own.or_else(|| {
        if end.is_empty() { Some(("value", None)) } else { unit(end).map(|unit| ("value", Some(unit))) }
    })
}
