//! measured.csv: what was measured in tests on specimens of the study's arms, every fault of the file at once.

mod columns;
mod header;
mod measurement;
mod record;
mod returned;
mod row;
mod summed;
mod template;
mod together;
mod unfilled;
mod unit;
mod wide;

pub(super) use columns::{COLUMNS, FORMS};
pub use measurement::{MeasuredKind, MeasuredQuantity, Measurement, Under};
pub use template::{Template, template};
pub use unit::Dimension;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::math::degrees;
use crate::study::angle::Angle;
use crate::study::csv;
use crate::study::csv::cells::Line;
use crate::study::csv::numbers::Numbers;
use crate::study::fault::{Fault, Found, Place, Source};
use crate::study::measured::header::Header;

/// Name of the file, beside study.toml.
pub const FILE: &str = "measured.csv";

/// How a file of measurements is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// What separates its cells.
    pub separator: char,
    /// Whether decimals follow a comma.
    pub decimal_comma: bool,
    /// Whether a row holds several quantities.
    pub wide: bool,
    /// The units that its values are in.
    pub units: BTreeMap<MeasuredQuantity, BTreeSet<String>>,
    /// Lines of rows without a value.
    pub unfilled: Vec<usize>,
}

/// What the rows of a file may name.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known<'s> {
    /// The arms.
    pub arms: Option<&'s [String]>,
    /// The records; none of a study whose base does not move.
    pub records: Option<&'s [String]>,
}

/// What was read from a file; of none by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Read {
    /// The measurements.
    pub rows: Vec<Measurement>,
    /// How they are written.
    pub written: Option<Written>,
    /// What is allowed and yet looks wrong.
    pub warnings: Vec<Fault>,
}

/// Reads all measurements of a file, of arms and under records of these names, each `None` when what the study says of them is faulty
/// itself.
///
/// # Errors
/// All faults of the file: of its cells, its header, its rows, and of rows against one another.
pub(super) fn read(source: &Arc<Source>, known: Known<'_>) -> Result<Read, Vec<Fault>> {
    let mut faults = Vec::new();
    let table = csv::cells::table(source, header::is_column, &mut faults);
    let Some((first, lines)) = table.lines.split_first() else {
        faults.push(columns::no_header(source));
        return Err(faults);
    };
    let header = header::header(first, lines, &mut faults);
    if lines.is_empty() {
        faults.push(columns::no_rows(source));
    }
    let Some(header) = header else { return Err(Fault::gathered(faults)) };
    let mut numbers = Numbers::new(table.separator);
    let mut units: BTreeMap<MeasuredQuantity, BTreeSet<String>> = BTreeMap::new();
    let mut read: Vec<(Measurement, Place)> = Vec::new();
    let mut unfilled: Vec<&Line> = Vec::new();
    for line in lines {
        if let Some(fault) = ill_sized(&header, line, table.separator) {
            faults.push(fault);
            continue;
        }
        let records = header.records(line);
        if records.is_empty() {
            unfilled.push(line);
        }
        for record in records {
            let Some((m, place)) = row::read(&record, known, &mut numbers, &mut faults) else { continue };
            let unit = record.given("unit").map(|cell| cell.text.clone());
            units.entry(m.quantity).or_default().extend(unit);
            if !(header.is_wide() && said_before(&mut read, &m)) {
                read.push((m, place));
            }
        }
    }
    if !lines.is_empty() && unfilled.len() == lines.len() {
        faults.push(columns::no_rows(source));
    }
    faults.extend(numbers.mixed());
    let summed = summed::left_out(&mut read);
    together::check(&read, &mut faults);
    if !faults.is_empty() {
        return Err(Fault::gathered(faults));
    }
    let in_radians: Vec<Fault> = read.iter().filter_map(|(m, place)| in_radians(m, place)).collect();
    let mut rows: Vec<Measurement> = read.into_iter().map(|(measurement, _)| measurement).collect();
    let odd = unfilled.iter().filter(|line| !unfilled::had_fallen(&header, line, &rows, &mut numbers));
    let odd: Vec<Fault> = odd.map(|line| unfilled::warning(line)).collect();
    let warnings = Fault::gathered([odd, in_radians, summed].concat());
    returned::name_remainders(&mut rows);
    let written = Written {
        separator: table.separator,
        decimal_comma: numbers.have_decimal_commas(),
        wide: header.is_wide(),
        units,
        unfilled: unfilled.iter().map(|line| line.number).collect(),
    };
    Ok(Read { rows, written: Some(written), warnings })
}

/// A collapse angle that looks as if it were not in degrees.
fn in_radians(m: &Measurement, place: &Place) -> Option<Fault> {
    let is_angle = m.quantity == MeasuredQuantity::CollapseAngle && !m.kind.is_censored();
    let doubt = Angle::Tilt.doubt(degrees(m.value)).filter(|_| is_angle)?;
    let found = Found::Words("looks like radians".to_owned());
    Some(Fault::at(place, "value", found, format!("this, but {doubt}"), "state it in degrees"))
}

/// The fault of a row that has not as many cells as the header. What is empty at its end does not count, but for commas: one that
/// stands for a decimal point would shift what is behind it.
fn ill_sized(header: &Header, line: &Line, separator: char) -> Option<Fault> {
    let (cells, width) = (line.cells.len(), header.width());
    let surplus = line.cells.iter().skip(width).any(|cell| !cell.text.is_empty());
    let fix = match cells.cmp(&width) {
        std::cmp::Ordering::Greater if separator == ',' => {
            "write decimals with a point, or separate the cells by semicolons; put quotes around a cell that holds a comma"
        }
        std::cmp::Ordering::Greater if surplus => "put quotes around a cell that holds the separator",
        std::cmp::Ordering::Less if !header.may_end_behind(cells) => {
            "add the missing ones; an empty cell has its separator as well"
        }
        _ => return None,
    };
    let found = Found::Words(format!("has {cells} cell{}", if cells == 1 { "" } else { "s" }));
    let allowed = format!("{width}, as in the header");
    Some(Fault::at(&line.place, "", found, allowed, fix))
}

/// Whether a row of a wide table repeats what a wall has but once, as its collapse angle; it then counts where it stands last in the
/// sequence on the specimen.
fn said_before(read: &mut [(Measurement, Place)], m: &Measurement) -> bool {
    if m.quantity.has_tilt() || m.quantity.is_shaken() {
        return false;
    }
    let same = |own: &Measurement| Measurement { line: m.line, stage: m.stage, ..own.clone() } == *m;
    let before = read.iter_mut().map(|(own, _)| own).find(|own| same(own));
    before.map(|own| own.stage = own.stage.max(m.stage)).is_some()
}
