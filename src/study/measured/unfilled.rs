//! Rows in which no value was filled in.

use crate::math::radians;
use crate::study::csv::cells::Line;
use crate::study::csv::numbers::Numbers;
use crate::study::fault::{Fault, Found};
use crate::study::measured::header::Header;
use crate::study::measured::measurement::{MeasuredQuantity, Measurement};

/// Whether nothing could be read in a row, as its wall had fallen at a smaller tilt.
pub fn had_fallen(header: &Header, line: &Line, rows: &[Measurement], numbers: &mut Numbers) -> bool {
    let cell = |column| header.cell(line, column).filter(|cell| !cell.text.is_empty());
    let (Some(specimen), Some(tilt)) = (cell("specimen"), cell("tilt_deg")) else { return false };
    let fell = rows
        .iter()
        .find(|m| m.specimen == specimen.text && m.quantity == MeasuredQuantity::CollapseAngle)
        .map(|m| m.value);
    // A tilt that is no number is told with the row.
    numbers.read(tilt).ok().zip(fell).is_some_and(|(tilt, fell)| radians(tilt) >= fell)
}

/// What is said of any other such row.
pub fn warning(line: &Line) -> Fault {
    let found = Found::Words("has no value and is read over".to_owned());
    Fault::at(&line.place, "", found, "a value in each row", "write the value, or remove the row")
}
