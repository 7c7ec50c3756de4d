//! Rows of measured.csv against one another.

use std::collections::BTreeMap;

use crate::math::degrees;
use crate::study::fault::{Fault, Found, Place};
use crate::study::measured::measurement::{MeasuredKind, MeasuredQuantity, Measurement};
use crate::study::schema::Short;

/// A row and where it stands.
type Read = (Measurement, Place);

/// How many standard deviations of its error a collapse angle may be off before a reading above it is impossible.
const BEYOND: f64 = 3.0;

/// Notes rows that contradict or repeat an earlier one.
pub fn check(rows: &[Read], faults: &mut Vec<Fault>) {
    let mut specimens: BTreeMap<&str, &Read> = BTreeMap::new();
    let mut orders: BTreeMap<(&str, u32), &Read> = BTreeMap::new();
    let mut readings: BTreeMap<_, &Read> = BTreeMap::new();
    for row in rows {
        let (m, place) = row;
        let mut fault = |column: &str, found: String, allowed: String, fix: &str| {
            let found = Found::Words(found);
            faults.push(Fault::at(place, column, found, allowed, fix));
        };
        let (first, _) = specimens.entry(&m.specimen).or_insert(row);
        if first.family != m.family {
            fault(
                "family",
                format!("of {} is {}, and was {} in line {}", m.specimen, m.family, first.family, first.line),
                "one family per specimen".to_owned(),
                "mend the family, or give the specimens different names",
            );
        }
        if first.order != m.order {
            fault(
                "order",
                format!(
                    "of {} is {}, and was {} in line {}",
                    m.specimen,
                    shown(m.order),
                    shown(first.order),
                    first.line
                ),
                "one place per specimen".to_owned(),
                "write the same number in all rows of the specimen",
            );
        } else if let Some(order) = m.order {
            let (other, _) = orders.entry((&m.family, order)).or_insert(row);
            if other.specimen != m.specimen {
                fault(
                    "order",
                    format!("= {order} is that of {} in line {}", other.specimen, other.line),
                    "every place once in a family".to_owned(),
                    "count the specimens in the order of their tests",
                );
            }
        }
        // Bits, as two readings at one tilt are written the same.
        let under = m.under.as_ref().map(|under| (under.record.as_str(), under.scale.to_bits()));
        let key = (m.specimen.as_str(), m.quantity, m.at().map_or(0, f64::to_bits), under, m.stage);
        let (same, _) = readings.entry(key).or_insert(row);
        if same.line != m.line {
            fault(
                "quantity",
                format!("{} of {} was read in line {} already", m.quantity.name(), m.specimen, same.line),
                "one row per specimen, quantity, tilt, drift or record, and stage".to_owned(),
                "remove one, or number the readings in the column stage",
            );
        }
    }
    after_collapse(rows, faults);
}

/// Readings at a tilt that the specimen did not live to see.
fn after_collapse(rows: &[Read], faults: &mut Vec<Fault>) {
    let fallen =
        |m: &&Measurement| m.quantity == MeasuredQuantity::CollapseAngle && m.kind != MeasuredKind::Above;
    let angles: BTreeMap<&str, &Measurement> =
        rows.iter().map(|(m, _)| m).filter(fallen).map(|m| (m.specimen.as_str(), m)).collect();
    for (m, place) in rows {
        let (Some(tilt), Some(fall)) = (m.tilt, angles.get(m.specimen.as_str())) else { continue };
        let latest = fall.value + fall.resolution + BEYOND * (fall.error + fall.common_error);
        if m.stage > fall.stage && fall.stage > 0 {
            let found = Found::Words(format!("{} comes after the collapse of {}", m.stage, m.specimen));
            let allowed = format!("at most {}, by line {}", fall.stage, fall.line);
            faults.push(Fault::at(
                place,
                "stage",
                found,
                allowed,
                "mend the stage: nothing is read on a wall that fell",
            ));
        } else if tilt > latest {
            let found =
                Found::Words(format!("{} is above the collapse angle of {}", in_degrees(tilt), m.specimen));
            let allowed = format!("at most {}, by line {}", in_degrees(latest), fall.line);
            faults.push(Fault::at(place, "tilt_deg", found, allowed, "mend the tilt or the collapse angle"));
        }
    }
}

fn shown(order: Option<u32>) -> String {
    order.map_or_else(|| "empty".to_owned(), |order| order.to_string())
}

/// An angle to a thousandth of a degree.
fn in_degrees(angle: f64) -> String {
    format!("{} deg", Short((degrees(angle) * 1e3).round() / 1e3))
}
