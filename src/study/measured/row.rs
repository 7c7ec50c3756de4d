//! The cells of one reading to one measurement.

use crate::math::{degrees, ln, radians};
use crate::study::csv::cells::Cell;
use crate::study::csv::numbers::Numbers;
use crate::study::fault::{Fault, Found, Place};
use crate::study::measured::Known;
use crate::study::measured::measurement::{MeasuredKind, MeasuredQuantity, Measurement, Under};
use crate::study::measured::record::Record;
use crate::study::measured::unit::Dimension;
use crate::study::schema::{Interval, Short, quoted, suggestion};

/// Longest name of a specimen (characters).
const LONGEST_NAME: usize = 64;
/// How far a rounded value may be from a multiple of its resolution, as a share of it: decimals are not exact in binary.
const OFF_GRID: f64 = 1e-6;

/// Reads a reading; `None` when it is faulty, and the faults then say why. The place is that of the row.
pub fn read(
    record: &Record<'_>,
    known: Known<'_>,
    numbers: &mut Numbers,
    faults: &mut Vec<Fault>,
) -> Option<(Measurement, Place)> {
    let place = record.line.place.clone();
    Row { record, numbers, faults }.measurement(known).map(|measurement| (measurement, place))
}

/// A common error of which nobody knows how much of the error it is.
const UNKNOWN: &str = "unknown";

/// Where the values of a quantity must lie, in the first of its units.
fn limits(quantity: MeasuredQuantity) -> Interval {
    match quantity {
        MeasuredQuantity::CollapseAngle => Interval::above(0.0, 90.0),
        MeasuredQuantity::JointPhi => Interval::closed(0.0, 85.0),
        MeasuredQuantity::JointKn => Interval::above(0.0, 1e15),
        MeasuredQuantity::SpecimenWeight | MeasuredQuantity::BlockWeight => Interval::above(0.0, 1e9),
        MeasuredQuantity::ForceAtDrift => Interval::closed(-1e9, 1e9),
        _ => Interval::closed(-100.0, 100.0),
    }
}

/// How a wall may come through a motion of its base.
const OUTCOMES: [&str; 2] = ["fell", "stood"];

/// A record's name without its folder and without the end that says how it is written.
fn stem(record: &str) -> &str {
    let file = record.rsplit('/').next().unwrap_or(record);
    file.rsplit_once('.').map_or(file, |(stem, end)| if end.parse::<f64>().is_ok() { file } else { stem })
}

/// A reading's cells.
struct Row<'r> {
    record: &'r Record<'r>,
    numbers: &'r mut Numbers,
    faults: &'r mut Vec<Fault>,
}

impl Row<'_> {
    fn measurement(&mut self, known: Known<'_>) -> Option<Measurement> {
        let specimen = self.specimen();
        let family = self.family(known.arms);
        let quantity = self.quantity();
        let is_outcome = quantity == Some(MeasuredQuantity::Outcome);
        let kind = if is_outcome { self.fell_or_stood() } else { self.kind() };
        let (order, stage) = (self.whole("order", 1), self.whole("stage", 0));
        let tilt = quantity.and_then(|quantity| self.tilt(quantity));
        let drift = quantity.and_then(|quantity| self.drift(quantity));
        let under = quantity.and_then(|quantity| self.under(quantity, known.records));
        let numbers = quantity.and_then(|quantity| {
            if is_outcome {
                let scale = under.as_ref()?.as_ref()?.scale;
                return Some(([ln(scale), 0.0, 0.0, 0.0], false));
            }
            let unit = self.unit(quantity.dimension())?;
            self.numbers(quantity, &unit, kind)
        });
        let ([value, error, common_error, resolution], unknown_share) = numbers?;
        Some(Measurement {
            specimen: specimen?,
            family: family?,
            tilt: tilt?,
            drift: drift?,
            under: under?,
            quantity: quantity?,
            value,
            kind: kind?,
            error,
            common_error,
            unknown_share,
            resolution,
            order: order?,
            stage: stage?.unwrap_or(0),
            line: self.record.line.number,
        })
    }

    /// The cell of a column, if the file has it and it is not empty.
    fn given(&self, column: &str) -> Option<Cell> {
        self.record.given(column).cloned()
    }

    /// The cell of a column that must not be empty.
    fn needed(&mut self, column: &str, allowed: impl Into<String>, fix: &str) -> Option<Cell> {
        let cell = self.given(column);
        if cell.is_none() {
            let (place, name) = (self.record.place(column), self.record.name(column));
            self.faults.push(Fault::at(place, name, Found::Missing, allowed, fix));
        }
        cell
    }

    fn refuse(&mut self, cell: &Cell, column: &str, allowed: impl Into<String>, fix: impl Into<String>) {
        self.refuse_as(cell.text.clone(), cell, column, allowed, fix);
    }

    /// Refuses a cell whose text is told with what it comes to.
    fn refuse_as(
        &mut self,
        told: String,
        cell: &Cell,
        column: &str,
        allowed: impl Into<String>,
        fix: impl Into<String>,
    ) {
        let name = self.record.name(column);
        self.faults.push(Fault::at(&cell.place, name, Found::Value(told), allowed, fix));
    }

    fn specimen(&mut self) -> Option<String> {
        let allowed = format!("a name of at most {LONGEST_NAME} characters");
        let cell = self.needed("specimen", allowed.as_str(), "name the specimen")?;
        if cell.text.chars().count() > LONGEST_NAME || cell.text.chars().any(char::is_control) {
            self.refuse(&cell, "specimen", allowed, "shorten it, and write letters");
            return None;
        }
        Some(cell.text)
    }

    /// The arm, whose own name has lower-case letters only.
    fn family(&mut self, arms: Option<&[String]>) -> Option<String> {
        let allowed = arms.map_or_else(
            || "an arm of study.toml".to_owned(),
            |arms| format!("an arm of study.toml: {}", arms.join(", ")),
        );
        let cell = self.needed("family", allowed.as_str(), "name the arm that the specimen belongs to")?;
        let name = cell.text.to_ascii_lowercase();
        match arms {
            Some(arms) if !arms.contains(&name) => {
                self.refuse(&cell, "family", allowed, suggestion(&name, arms));
                None
            }
            _ => Some(name),
        }
    }

    fn quantity(&mut self) -> Option<MeasuredQuantity> {
        let names = MeasuredQuantity::ALL.map(MeasuredQuantity::name);
        MeasuredQuantity::named(&self.one_of("quantity", &names)?)
    }

    fn kind(&mut self) -> Option<MeasuredKind> {
        MeasuredKind::named(&self.one_of("kind", &MeasuredKind::NAMES)?)
    }

    /// How an outcome is to be read: a wall that fell would have fallen under a weaker motion, one that stood stands still under a
    /// stronger one.
    fn fell_or_stood(&mut self) -> Option<MeasuredKind> {
        for column in ["kind", "unit", "error", "common_error", "resolution"] {
            let Some(cell) = self.given(column) else { continue };
            let fix = "empty the cell: an outcome is one of two words";
            self.refuse(&cell, column, "nothing where quantity = outcome", fix);
            return None;
        }
        let allowed = format!("one of {}", quoted(&OUTCOMES));
        let cell = self.needed("value", allowed.as_str(), "write how the wall came through")?;
        match cell.text.to_ascii_lowercase().as_str() {
            "fell" => Some(MeasuredKind::Below),
            "stood" => Some(MeasuredKind::Above),
            other => {
                let fix = suggestion(other, &OUTCOMES);
                self.refuse(&cell, "value", allowed, fix);
                None
            }
        }
    }

    /// The motion that it was read under, or none where the quantity has none; the outer `None` is a fault.
    fn under(&mut self, quantity: MeasuredQuantity, records: Option<&[String]>) -> Option<Option<Under>> {
        let name = quantity.name();
        if !quantity.is_shaken() {
            for column in ["record", "scale"] {
                let Some(cell) = self.given(column) else { continue };
                self.refuse(&cell, column, format!("nothing where quantity = {name}"), "empty the cell");
                return None;
            }
            return Some(None);
        }
        let allowed = "the name of a record of study.toml";
        let cell = self.needed("record", allowed, "name the record that moved the base")?;
        let scale = match self.given("scale") {
            None => 1.0,
            Some(cell) => {
                let within = Interval::above(0.0, 1000.0);
                self.number(&cell, "scale", within, &format!("a number {within}"))?
            }
        };
        let Some(records) = records else { return Some(Some(Under { record: cell.text, scale })) };
        let same = |record: &&String| **record == cell.text || stem(record) == stem(&cell.text);
        let mut same = records.iter().filter(same);
        match (same.next(), same.next()) {
            (Some(record), None) => Some(Some(Under { record: record.clone(), scale })),
            (Some(_), Some(_)) => {
                self.refuse(&cell, "record", allowed, "write the whole name: several records end so");
                None
            }
            (None, _) if records.is_empty() => {
                let fix = "outcomes belong to a study with load.protocol = \"base_motion\"";
                self.refuse(&cell, "record", "nothing, as no base moves in this study", fix);
                None
            }
            (None, _) => {
                let fix = suggestion(&cell.text, records);
                self.refuse(&cell, "record", allowed, fix);
                None
            }
        }
    }

    fn unit(&mut self, dimension: Dimension) -> Option<String> {
        self.one_of("unit", dimension.units())
    }

    fn one_of(&mut self, column: &str, names: &[&str]) -> Option<String> {
        let allowed = format!("one of {}", quoted(names));
        let cell = self.needed(column, allowed.as_str(), "choose one")?;
        if names.contains(&cell.text.as_str()) {
            return Some(cell.text);
        }
        let fix = match names.iter().find(|name| name.eq_ignore_ascii_case(&cell.text)) {
            Some(name) => format!("did you mean \"{name}\"?"),
            // A unit near in letters is far in meaning: kg and kN, km and m.
            None if column == "unit" && ["g", "kg", "t"].contains(&cell.text.as_str()) => {
                "that is a mass: multiply by 9.81 m/s2 and state the weight".to_owned()
            }
            None if column == "unit" => {
                "convert the value, the errors and the resolution to one of these".to_owned()
            }
            None => suggestion(&cell.text, names),
        };
        self.refuse(&cell, column, allowed, fix);
        None
    }

    /// The tilt (rad), or none where the quantity has none; the outer `None` is a fault.
    fn tilt(&mut self, quantity: MeasuredQuantity) -> Option<Option<f64>> {
        let name = quantity.name();
        if !quantity.has_tilt() {
            return match self.given("tilt_deg") {
                None => Some(None),
                Some(cell) => {
                    let fix = "empty the cell; a collapse angle stands in the column value";
                    self.refuse(&cell, "tilt_deg", format!("nothing where quantity = {name}"), fix);
                    None
                }
            };
        }
        let within = Interval::closed(0.0, 90.0);
        let allowed = format!("a number {within} (deg)");
        let fix = format!("state the tilt at which the {name} was read");
        let cell = self.needed("tilt_deg", allowed.as_str(), &fix)?;
        let tilt = self.number(&cell, "tilt_deg", within, &allowed)?;
        Some(Some(radians(tilt)))
    }

    /// The drift (a share), or none where the quantity has none; the outer `None` is a fault.
    fn drift(&mut self, quantity: MeasuredQuantity) -> Option<Option<f64>> {
        let name = quantity.name();
        if !quantity.has_drift() {
            return match self.given("drift_percent") {
                None => Some(None),
                Some(cell) => {
                    let allowed = format!("nothing where quantity = {name}");
                    self.refuse(&cell, "drift_percent", allowed, "empty the cell");
                    None
                }
            };
        }
        let within = Interval::above(0.0, 100.0);
        let allowed = format!("a number {within} (%)");
        let fix = "state the drift at which the push was read; its size where the wall went back";
        let cell = self.needed("drift_percent", allowed.as_str(), fix)?;
        let drift = self.number(&cell, "drift_percent", within, &allowed)?;
        Some(Some(0.01 * drift))
    }

    /// Value, error, common error and resolution in SI units, and whether nobody knows how much of the error is common; `kind` is
    /// `None` where it is faulty itself.
    fn numbers(
        &mut self,
        quantity: MeasuredQuantity,
        unit: &str,
        kind: Option<MeasuredKind>,
    ) -> Option<([f64; 4], bool)> {
        let value = self.value(quantity, unit);
        let any = Interval::closed(0.0, 1e15);
        // Walls differ, and what is read on one is never known exactly; of what is measured apart the error is all that is left open.
        let needs_error = quantity.is_apart() && kind == Some(MeasuredKind::Exact);
        let (some, least, none) = match needs_error {
            true => (Interval::above(0.0, 1e15), "above", ""),
            false => (any, "at least", "; 0 for none"),
        };
        let error_allowed = format!("a number {least} 0 ({unit})");
        let fix = &format!("state one standard deviation of the instrument's random error{none}");
        let error = self
            .needed("error", error_allowed.as_str(), fix)
            .and_then(|cell| self.number(&cell, "error", some, &error_allowed));
        let given = self.given("common_error");
        let unknown_share = given.as_ref().is_some_and(|cell| cell.text == UNKNOWN);
        let common = match given.filter(|_| !unknown_share) {
            None => Some(0.0),
            Some(cell) => {
                let allowed = format!("a number at least 0 ({unit}), or {UNKNOWN}");
                self.number(&cell, "common_error", any, &allowed)
            }
        };
        let resolution = self.resolution(unit, kind, value);
        let (error, common) = match unknown_share {
            true => (error.map(|error| error * 0.5_f64.sqrt()), error.map(|error| error * 0.5_f64.sqrt())),
            false => (error, common),
        };
        let numbers = [value?, error?, common?, resolution?];
        Some((numbers.map(|number| quantity.dimension().si(number, unit)), unknown_share))
    }

    /// The value as written, after it was found to be possible.
    fn value(&mut self, quantity: MeasuredQuantity, unit: &str) -> Option<f64> {
        let (within, first) = (limits(quantity), quantity.dimension().units()[0]);
        let allowed = format!("a number {within} ({first})");
        let cell = self.needed("value", allowed.as_str(), "write the value, or remove the row")?;
        let number = self.number(&cell, "value", Interval::any(), &allowed)?;
        let in_first = match (first, unit) {
            ("deg", "deg") => number,
            ("deg", _) => degrees(number),
            _ => quantity.dimension().si(number, unit),
        };
        if !within.contains(in_first) {
            let told = match unit == first {
                true => cell.text.clone(),
                false => format!("{}, which is {} {first}", cell.text, Short(in_first)),
            };
            self.refuse_as(told, &cell, "value", allowed, "mend the value or its unit");
            return None;
        }
        Some(number)
    }

    /// The resolution as written; 0 where the reading is not rounded.
    fn resolution(&mut self, unit: &str, kind: Option<MeasuredKind>, value: Option<f64>) -> Option<f64> {
        let within = Interval::above(0.0, 1e15);
        let allowed = format!("a number above 0 ({unit})");
        if kind != Some(MeasuredKind::Rounded) {
            let cell = self.given("resolution");
            if let (Some(cell), Some(_)) = (&cell, kind) {
                let fix = "empty the cell, or say that the kind is rounded";
                self.refuse(cell, "resolution", "nothing unless kind = rounded", fix);
            }
            return cell.is_none().then_some(0.0);
        }
        let fix = "state the distance of neighbouring values, in a column of that name";
        let cell = self.needed("resolution", allowed.as_str(), fix)?;
        let resolution = self.number(&cell, "resolution", within, &allowed)?;
        if let Some(value) = value {
            let steps = value / resolution;
            if (steps - steps.round()).abs() > OFF_GRID * steps.abs().max(1.0) {
                let allowed = format!("a step of which the value {} is a multiple", Short(value));
                self.refuse(&cell, "resolution", allowed, "mend the value or the resolution");
                return None;
            }
        }
        Some(resolution)
    }

    fn number(&mut self, cell: &Cell, column: &str, within: Interval, allowed: &str) -> Option<f64> {
        let fix = match self.numbers.read(cell) {
            Ok(number) if within.contains(number) => return Some(number),
            Ok(number) if !number.is_finite() => "a finite number is needed",
            Ok(number) if number < within.low || (within.open_low && number == within.low) => "raise it",
            Ok(_) => "reduce it",
            Err(fix) => fix,
        };
        self.refuse(cell, column, allowed, fix);
        None
    }

    /// A whole number of at least `least` in an optional column; the outer `None` is a fault.
    fn whole(&mut self, column: &str, least: u32) -> Option<Option<u32>> {
        let Some(cell) = self.given(column) else { return Some(None) };
        match cell.text.parse::<u32>() {
            Ok(number) if number >= least => Some(Some(number)),
            _ => {
                let allowed = format!("a whole number, at least {least}, or nothing");
                self.refuse(&cell, column, allowed, "count in whole numbers, or empty the cell");
                None
            }
        }
    }
}
