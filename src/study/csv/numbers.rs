//! Numbers as people and spreadsheets write them: with a decimal point or a decimal comma, the same in the whole file.

use crate::study::csv::cells::Cell;
use crate::study::fault::{Fault, Found, Place};

/// Reads the numbers of a file, and keeps where it first met each kind of decimals.
pub struct Numbers {
    separator: char,
    point: Option<Cell>,
    comma: Option<Cell>,
}

impl Numbers {
    /// Of a file whose cells are separated so.
    pub fn new(separator: char) -> Numbers {
        Numbers { separator, point: None, comma: None }
    }

    /// Whether decimals follow a comma.
    pub fn have_decimal_commas(&self) -> bool {
        self.comma.is_some()
    }

    /// The number in a cell, finite or not.
    ///
    /// # Errors
    /// How to mend what is no number.
    pub fn read(&mut self, cell: &Cell) -> Result<f64, &'static str> {
        // The typographer's minus, which some spreadsheets write.
        let text = cell.text.replace('\u{2212}', "-");
        if let Ok(number) = text.parse::<f64>() {
            if text.contains('.') {
                self.point.get_or_insert_with(|| cell.clone());
            }
            return Ok(number);
        }
        match text.replacen(',', ".", 1).parse::<f64>() {
            // Whoever separates cells by commas would write 1,371 for a thousand or for one.
            Ok(_) if self.separator == ',' => {
                Err("write a point for the decimal comma, or separate the cells by semicolons")
            }
            Ok(number) => {
                self.comma.get_or_insert_with(|| cell.clone());
                Ok(number)
            }
            Err(_) => Err(mended(&text)),
        }
    }

    /// The fault of a file that has decimals of both kinds: one of them may be meant to group thousands.
    pub fn mixed(&self) -> Option<Fault> {
        let (point, comma) = (self.point.as_ref()?, self.comma.as_ref()?);
        let line = |place: &Place| place.line_and_column().0;
        let words = format!(
            "has a decimal comma in {}, and a decimal point in {} of line {}",
            comma.text,
            point.text,
            line(&point.place)
        );
        Some(Fault::at(
            &comma.place,
            "",
            Found::Words(words),
            "decimals of one kind in the whole file",
            "write all of them with a point, or all with a comma",
        ))
    }
}

/// How to mend what is no number.
fn mended(text: &str) -> &'static str {
    let parts: Vec<&str> = text.split(['.', '/', '-']).map(str::trim).collect();
    let digits = |part: &str| part.chars().all(|c| c.is_ascii_digit()).then_some(part.len());
    // Day, month and year, in either order.
    if let [Some(1..=2), Some(1..=2), Some(2 | 4)] | [Some(4), Some(1..=2), Some(1..=2)] =
        parts.iter().map(|part| digits(part)).collect::<Vec<_>>()[..]
    {
        return "write the number: a spreadsheet has made a date of it";
    }
    if text.replace(['.', ',', '\'', ' ', '\u{a0}', '\u{202f}'], "").parse::<f64>().is_ok() {
        return "write the number without separators of thousands";
    }
    match text.strip_prefix(['<', '>', '\u{2264}', '\u{2265}']) {
        Some(_) => "write the bound alone, and below or above in the column kind",
        None => "write the number alone",
    }
}
