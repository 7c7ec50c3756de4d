//! The header of a table, long or wide, and the readings that a row has by it.

use std::collections::BTreeMap;

use crate::study::csv::cells::{Cell, Line};
use crate::study::csv::compared;
use crate::study::fault::{Fault, Found};
use crate::study::measured::columns::{COLUMNS, named};
use crate::study::measured::measurement::MeasuredQuantity;
use crate::study::measured::record::{Field, Record};
use crate::study::measured::unit::Dimension;
use crate::study::measured::wide::Meant;
use crate::study::schema::suggestion;

/// Columns of a wide table that it shares with a long one.
const SHARED: [&str; 12] = [
    "specimen",
    "family",
    "tilt_deg",
    "unit",
    "error",
    "kind",
    "common_error",
    "resolution",
    "order",
    "stage",
    "record",
    "scale",
];

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slot {
    /// Nothing: no name, and nothing below.
    Nothing,
    /// What a column of a long table holds.
    Long(&'static str),
    /// What only a wide table has.
    Wide(Meant),
}

/// Which column stands where.
pub struct Header {
    /// The cells of the header, each with what is below.
    slots: Vec<(Slot, Cell)>,
    /// The quantities that have columns; none of a long table.
    quantities: Vec<MeasuredQuantity>,
}

/// Whether a column may be called so, in a long table or in a wide one.
pub fn is_column(name: &str) -> bool {
    named(&compared(name)).is_some() || Meant::by(name).is_some()
}

impl Header {
    /// Whether a row holds several readings.
    pub fn is_wide(&self) -> bool {
        !self.quantities.is_empty()
    }

    /// The cell of a column that both tables have.
    pub fn cell<'l>(&self, line: &'l Line, column: &str) -> Option<&'l Cell> {
        line.cells.get(self.at(|slot| matches!(slot, Slot::Long(name) if name == column))?)
    }

    fn at(&self, is: impl Fn(Slot) -> bool) -> Option<usize> {
        self.slots.iter().position(|(slot, _)| is(*slot))
    }

    /// Where something is said of a quantity in a column of its own.
    fn own(&self, quantity: MeasuredQuantity, column: &str) -> Option<usize> {
        self.at(|slot| matches!(slot, Slot::Wide(m) if m.quantity == Some(quantity) && m.column == column))
    }

    /// Where something is said of all lengths.
    fn shared(&self, column: &str) -> Option<usize> {
        let is = |slot| match slot {
            Slot::Long(name) => name == column,
            Slot::Wide(m) => m.quantity.is_none() && m.column == column,
            Slot::Nothing => false,
        };
        self.at(is)
    }

    /// Where something is said of a quantity: in a column of its own, or in that of all lengths.
    fn said(&self, quantity: MeasuredQuantity, column: &str) -> Option<usize> {
        let shared = || self.shared(column).filter(|_| quantity.dimension() == Dimension::Length);
        self.own(quantity, column).or_else(shared)
    }

    /// The unit in a column's name.
    fn unit_in(&self, at: usize) -> Option<&'static str> {
        match self.slots.get(at)?.0 {
            Slot::Wide(m) => m.unit,
            _ => None,
        }
    }

    /// Whether the row of so many cells may end there: a spreadsheet leaves out what is empty at the end.
    pub fn may_end_behind(&self, cells: usize) -> bool {
        let is_needed = |slot: &Slot| match slot {
            Slot::Nothing => false,
            Slot::Long(name) => named(name).is_some_and(|column| column.required),
            Slot::Wide(m) => m.column == "value",
        };
        // Further back a cell that was forgotten would shift the others.
        self.slots.iter().rposition(|(slot, _)| is_needed(slot)).is_some_and(|last| cells == last + 1)
    }

    /// Number of cells of a row.
    pub fn width(&self) -> usize {
        self.slots.len()
    }

    /// What the readings of a row are read from; none where no value was filled in.
    pub fn records<'l>(&self, line: &'l Line) -> Vec<Record<'l>> {
        let filled = |at: &usize| line.cells.get(*at).is_some_and(|cell| !cell.text.is_empty());
        if !self.is_wide() {
            let value = self.at(|slot| slot == Slot::Long("value"));
            let record = Record { line, fields: self.fields(line, COLUMNS.iter().map(|c| c.name)) };
            return value.filter(filled).map(|_| record).into_iter().collect();
        }
        let readings =
            self.quantities.iter().filter_map(|&q| Some((q, self.own(q, "value").filter(filled)?)));
        readings.map(|(quantity, at)| self.reading(line, quantity, at)).collect()
    }

    /// The fields of a row that both tables have.
    fn fields(
        &self,
        line: &Line,
        columns: impl Iterator<Item = &'static str>,
    ) -> BTreeMap<&'static str, Field> {
        let field = |column: &'static str| {
            let cell = self.cell(line, column)?.clone();
            Some((column, Field { name: column.to_owned(), cell }))
        };
        columns.filter_map(field).collect()
    }

    /// One reading of a row of a wide table, its value in a column of its own.
    fn reading<'l>(&self, line: &'l Line, quantity: MeasuredQuantity, at: usize) -> Record<'l> {
        let columns = ["specimen", "family", "order", "stage"].into_iter();
        let tilt = quantity.has_tilt().then_some("tilt_deg");
        let under = ["record", "scale"].into_iter().filter(|_| quantity.is_shaken());
        let mut fields = self.fields(line, columns.chain(tilt).chain(under));
        let (_, head) = &self.slots[at];
        let value = &line.cells[at];
        let stated = |text: &str| Field {
            name: head.text.clone(),
            cell: Cell { text: text.to_owned(), place: value.place.clone() },
        };
        if quantity == MeasuredQuantity::Outcome {
            fields.extend([("value", stated(&value.text)), ("quantity", stated(quantity.name()))]);
            return Record { line, fields };
        }
        for column in ["error", "common_error", "resolution", "kind"] {
            let field = self.said(quantity, column).and_then(|at| {
                Some(Field { name: self.slots[at].1.text.clone(), cell: line.cells.get(at)?.clone() })
            });
            fields.extend(field.map(|field| (column, field)));
        }
        let empty = |column: &str| fields.get(column).is_none_or(|field| field.cell.text.is_empty());
        let (kind, number) = match value.text.chars().next() {
            Some('<' | '\u{2264}') if empty("kind") => {
                ("below", value.text.trim_start_matches(['<', '\u{2264}', '=']))
            }
            Some('>' | '\u{2265}') if empty("kind") => {
                ("above", value.text.trim_start_matches(['>', '\u{2265}', '=']))
            }
            _ if empty("resolution") => ("exact", value.text.as_str()),
            _ => ("rounded", value.text.as_str()),
        };
        if empty("kind") {
            fields.insert("kind", stated(kind));
        }
        if kind == "below" || kind == "above" {
            // A bound has no grid, though the column of the resolution is filled.
            fields.remove("resolution");
        }
        fields.insert("value", stated(number.trim()));
        fields.insert("quantity", stated(quantity.name()));
        match self.unit_in(at) {
            Some(unit) => fields.extend([("unit", stated(unit))]),
            None => fields.extend(self.fields(line, std::iter::once("unit"))),
        }
        Record { line, fields }
    }
}

/// Reads the header; `None` when rows cannot be read by it, and the faults then say why.
pub fn header(line: &Line, rows: &[Line], faults: &mut Vec<Fault>) -> Option<Header> {
    let before = faults.len();
    let has = |name: &str| line.cells.iter().any(|cell| compared(&cell.text) == name);
    let meant = |cell: &Cell| Meant::by(&cell.text).filter(|m| m.column == "value").and_then(|m| m.quantity);
    let is_wide = !has("quantity") && !has("value") && line.cells.iter().any(|cell| meant(cell).is_some());
    let names: Vec<&str> = match is_wide {
        true => SHARED.to_vec(),
        false => COLUMNS.iter().map(|column| column.name).collect(),
    };
    let also = if is_wide { ", and of quantities, as left_mm or collapse_angle_deg," } else { "" };
    let allowed = format!("each of the columns {}{also} at most once", names.join(", "));
    let mut slots: Vec<(Slot, Cell)> = Vec::new();
    for (index, cell) in line.cells.iter().enumerate() {
        let name = compared(&cell.text);
        let long =
            names.iter().find(|own| **own == name).and_then(|own| named(own)).map(|c| Slot::Long(c.name));
        let slot = long.or_else(|| Meant::by(&cell.text).filter(|_| is_wide).map(Slot::Wide));
        let is_empty = |row: &Line| row.cells.get(index).is_none_or(|cell| cell.text.is_empty());
        let wrong = match slot {
            None if cell.text.is_empty() && rows.iter().all(is_empty) => {
                slots.push((Slot::Nothing, cell.clone()));
                continue;
            }
            Some(slot) if !slots.iter().any(|(other, _)| is_same(*other, slot)) => {
                slots.push((slot, cell.clone()));
                continue;
            }
            Some(_) => ("is a column twice", "remove one of them".to_owned()),
            None if cell.text.is_empty() => ("a column without a name", "name it or remove it".to_owned()),
            None => ("is not a known column", mended(&name, &names)),
        };
        let found = Found::Words(wrong.0.to_owned());
        faults.push(Fault::at(&cell.place, &cell.text, found, allowed.clone(), wrong.1));
    }
    let quantities = slots.iter().filter_map(|(_, cell)| meant(cell).filter(|_| is_wide)).collect();
    let header = Header { slots, quantities };
    header.lacking(line, faults);
    header.units(faults);
    (faults.len() == before).then_some(header)
}

/// Whether two columns hold the same, in whatever unit.
fn is_same(one: Slot, other: Slot) -> bool {
    match (one, other) {
        (Slot::Wide(a), Slot::Wide(b)) => (a.quantity, a.column) == (b.quantity, b.column),
        (Slot::Long(a), Slot::Wide(b)) | (Slot::Wide(b), Slot::Long(a)) => {
            b.quantity.is_none() && b.column == a
        }
        _ => one == other && one != Slot::Nothing,
    }
}

/// How to mend a name that no column has.
fn mended(name: &str, names: &[&str]) -> String {
    if name.contains([',', ';', '\t']) {
        return "separate all cells of the file alike: by commas, semicolons or tabs".to_owned();
    }
    let longer = names.iter().find(|own| own.starts_with(&format!("{name}_")));
    longer.map_or_else(|| suggestion(name, names), |own| format!("did you mean \"{own}\"?"))
}

impl Header {
    /// Notes the columns that there must be and are not.
    fn lacking(&self, line: &Line, faults: &mut Vec<Fault>) {
        let mut missing = |name: &str, doc: &str, fix: &str| {
            faults.push(Fault::at(&line.place, name, Found::Missing, format!("a column: {doc}"), fix));
        };
        let fix = "add it to the header and to every row";
        let lengths = || self.quantities.iter().filter(|q| q.dimension() == Dimension::Length);
        for column in COLUMNS.iter().filter(|column| column.required) {
            let is_needed = match column.name {
                _ if !self.is_wide() => true,
                "specimen" | "family" => true,
                "tilt_deg" => self.quantities.iter().any(|quantity| quantity.has_tilt()),
                "unit" => {
                    lengths().any(|q| self.own(*q, "value").is_some_and(|at| self.unit_in(at).is_none()))
                }
                "error" => lengths().any(|q| self.said(*q, "error").is_none()),
                _ => false,
            };
            let there = self.shared(column.name).is_some();
            if is_needed && !there {
                missing(column.name, column.doc, fix);
            }
        }
        if self.quantities.iter().any(|quantity| quantity.is_shaken()) && self.shared("record").is_none() {
            let doc = "name of the record that moved the base";
            missing("record", doc, fix);
        }
        let without_error = [Dimension::Length, Dimension::Outcome];
        let others = self.quantities.iter().filter(|q| !without_error.contains(&q.dimension()));
        for quantity in others.filter(|q| self.own(**q, "error").is_none()) {
            missing(
                &format!("{}_error", quantity.name()),
                &format!("random error of {}, one standard deviation", quantity.name()),
                fix,
            );
        }
    }

    /// Notes quantities without a unit, what is said of a quantity that has no column, and units that do not agree.
    fn units(&self, faults: &mut Vec<Fault>) {
        let mut fault = |at: usize, words: String, allowed: String, fix: String| {
            let (_, cell) = &self.slots[at];
            faults.push(Fault::at(&cell.place, &cell.text, Found::Words(words), allowed, fix));
        };
        for (at, (slot, _)) in self.slots.iter().enumerate() {
            let Slot::Wide(meant) = slot else { continue };
            let name = meant.quantity.map_or("", MeasuredQuantity::name);
            match meant.quantity {
                Some(quantity) if meant.column == "value" => {
                    let dimension = quantity.dimension();
                    if meant.unit.is_none() && !matches!(dimension, Dimension::Length | Dimension::Outcome) {
                        let names: Vec<String> =
                            dimension.units().iter().map(|unit| format!("{name}_{unit}")).collect();
                        fault(
                            at,
                            "does not say its unit".to_owned(),
                            format!("one of {}", names.join(", ")),
                            format!("call it {}", names[0]),
                        );
                    }
                }
                Some(quantity) if self.own(quantity, "value").is_none() => {
                    fault(
                        at,
                        format!("has no column {name} beside it"),
                        "what is said of a quantity that has a column".to_owned(),
                        "add the column, or remove this one".to_owned(),
                    );
                }
                _ => {}
            }
        }
        let errors = ["error", "common_error", "resolution"];
        for (quantity, column) in self.quantities.iter().flat_map(|q| errors.map(|column| (*q, column))) {
            let (Some(value), Some(at)) = (self.own(quantity, "value"), self.said(quantity, column)) else {
                continue;
            };
            let (of_value, own) = (self.unit_in(value), self.unit_in(at));
            // What is said of several in different units may be meant in any of them.
            let is_shared = self.own(quantity, column).is_none();
            let sharing = self.quantities.iter().filter(|q| self.said(**q, column) == Some(at));
            let differ =
                sharing.filter_map(|q| self.own(*q, "value")).any(|other| self.unit_in(other) != of_value);
            if own.map_or(is_shared && differ, |_| own != of_value) {
                let called = &self.slots[value].1.text;
                fault(
                    at,
                    format!("is not in the unit of {called}"),
                    "one unit for the values and their errors".to_owned(),
                    "end the names of all these columns in the same unit, as left_mm and error_mm".to_owned(),
                );
            }
        }
    }
}
