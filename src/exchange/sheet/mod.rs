//! Reading the first table of an Excel workbook (.xlsx) as rows of texts.
//!
//! Not by calamine (0.38): it asks for as much memory as the file claims to need (the count of its texts, a cell at the far end of the sheet),
//! and the program ends when there is none. What it stands on, zip and quick-xml, does the hard part here too.

mod parts;

use std::borrow::Cow;

use quick_xml::events::Event;

use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::mesh::{quoted, refusal};
use crate::exchange::sheet::parts::{
    ALLOWED, MOST_UNPACKED, Package, SAVE, Writing, attribute, broken, events, within,
};

/// Most cells of a sheet, with the empty ones before others in their rows; and most rows.
const MOST_CELLS: usize = 200_000;
/// Most sheets that are looked at.
const MOST_SHEETS: usize = 100;
/// How a file begins that is an old workbook, or a new one behind a password.
const OLD: [u8; 4] = [0xd0, 0xcf, 0x11, 0xe0];
/// Rows of cells as texts.
type Rows = Vec<Vec<String>>;

/// The rows of the first sheet that shows and is not empty, and warnings. An empty cell is an empty text, a row ends with its last cell that is
/// not empty, and the row at place 0 is row 1 of the sheet. Numbers have as many digits as bring them back, with a point; a date is the number
/// of its day as Excel counts, and a formula is the value that it had last.
///
/// # Errors
/// Why the file is no workbook, is too large, or has no cells.
pub(in crate::exchange) fn sheet_rows(bytes: &[u8]) -> Result<(Rows, Vec<String>), WallFaults> {
    read(bytes).map_err(|fault| {
        let mut faults = WallFaults::new("table.xlsx");
        faults.push(*fault);
        faults
    })
}

fn read(bytes: &[u8]) -> Result<(Rows, Vec<String>), Box<Fault>> {
    if bytes.starts_with(&OLD) {
        let found = "it is an old workbook (.xls), or one behind a password";
        return Err(refusal("", found, ALLOWED, SAVE));
    }
    let mut package = Package::of(bytes)?;
    let root = package.relations("_rels/.rels", "")?;
    let Some(book) = root.iter().find(|own| own.kind == "officeDocument") else {
        return Err(refusal("", "it holds no workbook", ALLOWED, SAVE));
    };
    let (folder, file) = book.path.rsplit_once('/').unwrap_or(("", &book.path));
    let relations = package.relations(&within(folder, &format!("_rels/{file}.rels")), folder)?;
    let strings = match relations.iter().find(|own| own.kind == "sharedStrings") {
        Some(own) => strings(&package.part(&own.path)?)?,
        None => Vec::new(),
    };
    let (mut first, mut others) = (None, Vec::new());
    for (name, id) in sheets(&package.part(&book.path)?)?.into_iter().take(MOST_SHEETS) {
        let own = relations.iter().find(|own| own.id == id && own.kind == "worksheet");
        let Some(path) = own.map(|own| &own.path) else { continue };
        if first.is_none() {
            let rows = rows(&package.part(path)?, &strings)?;
            first = (!rows.is_empty()).then_some((name, rows));
        } else if package.part(path).and_then(|text| rows(&text, &strings)).is_ok_and(|rows| rows.is_empty())
        {
            // Nothing is lost.
        } else {
            others.push(format!("\"{name}\""));
        }
    }
    let Some((name, rows)) = first else {
        return Err(refusal("", "its sheets are empty", "a table with a row per stone", "add the stones"));
    };
    let warning = || format!("only the sheet \"{name}\" is read; there are others: {}", listed(&others));
    Ok((rows, (!others.is_empty()).then(warning).into_iter().collect()))
}

/// Some names.
fn listed(names: &[String]) -> String {
    let more = if names.len() > 5 { ", ..." } else { "" };
    format!("{}{more}", names[..names.len().min(5)].join(", "))
}

fn large(found: &str) -> Box<Fault> {
    let fix = "leave only the table of the stones in it, or save that as .csv";
    refusal("", found, format!("at most {MOST_CELLS} cells"), fix)
}

/// Names and ids of the sheets that show.
fn sheets(book: &str) -> Result<Vec<(String, String)>, Box<Fault>> {
    let mut all = Vec::new();
    events(book, |event| {
        if let Event::Start(tag) = event
            && tag.local_name().as_ref() == "sheet"
            && attribute(&tag, "state").is_none_or(|state| state == "visible")
        {
            let own = |name| attribute(&tag, name).unwrap_or_default();
            all.push((quoted(own("name").as_bytes()), own("id")));
        }
        Ok(())
    })?;
    Ok(all)
}

/// The texts that cells name by their numbers.
fn strings(text: &str) -> Result<Vec<String>, Box<Fault>> {
    let (mut all, mut writing) = (Vec::new(), Writing::default());
    events(text, |event| {
        writing.take(&event);
        if matches!(&event, Event::End(tag) if tag.local_name().as_ref() == "si") {
            all.push(std::mem::take(&mut writing).text);
        }
        Ok(())
    })?;
    Ok(all)
}

/// The rows of a sheet up to its last cell that is not empty.
fn rows(text: &str, strings: &[String]) -> Result<Rows, Box<Fault>> {
    let (mut table, mut writing) = (Table::default(), Writing::default());
    // Where the cell is, from 1, and what its text means.
    let (mut row, mut column, mut kind) = (0_usize, 0_usize, String::new());
    events(text, |event| {
        writing.take(&event);
        match &event {
            Event::Start(tag) if tag.local_name().as_ref() == "row" => {
                let number = attribute(tag, "r").and_then(|r| r.parse().ok());
                (row, column) = (number.unwrap_or(row.saturating_add(1)), 0);
            }
            Event::Start(tag) if tag.local_name().as_ref() == "c" => {
                let own = attribute(tag, "r").and_then(|r| referred(&r));
                (row, column) = own.unwrap_or((row, column.saturating_add(1)));
                kind = attribute(tag, "t").unwrap_or_default();
                writing = Writing::default();
            }
            Event::End(tag) if tag.local_name().as_ref() == "c" => {
                table.put(row, column, value(&kind, &writing.text, strings)?)?;
            }
            _ => {}
        }
        Ok(())
    })?;
    Ok(table.rows)
}

/// A sheet in the making.
#[derive(Default)]
struct Table {
    rows: Rows,
    /// Its cells, also the empty ones.
    cells: usize,
    /// Bytes of their texts: many cells may name one long text.
    bytes: usize,
}

impl Table {
    /// Puts a text at a row and a column, from 1.
    fn put(&mut self, row: usize, column: usize, text: Cow<str>) -> Result<(), Box<Fault>> {
        if text.is_empty() || row == 0 {
            return Ok(());
        }
        let before = self.rows.get(row - 1).map_or(0, Vec::len);
        self.cells = self.cells.saturating_add(column.saturating_sub(before));
        self.bytes += text.len();
        if row > MOST_CELLS || self.cells > MOST_CELLS || self.bytes as u64 > MOST_UNPACKED {
            return Err(large("its sheet has more, or cells far from the first"));
        }
        if self.rows.len() < row {
            self.rows.resize(row, Vec::new());
        }
        let own = &mut self.rows[row - 1];
        own.resize(before.max(column), String::new());
        own[column - 1] = text.into_owned();
        Ok(())
    }
}

/// Row and column, from 1, of a reference such as `B7`.
fn referred(reference: &str) -> Option<(usize, usize)> {
    let (letters, row) = reference.split_at(reference.find(|c: char| c.is_ascii_digit())?);
    let column = letters.bytes().try_fold(0_usize, |sum, letter| {
        let digit = usize::from(letter.to_ascii_uppercase().checked_sub(b'A').filter(|digit| *digit < 26)?);
        sum.checked_mul(26)?.checked_add(digit + 1)
    })?;
    Some((row.parse().ok()?, column)).filter(|_| column > 0)
}

/// The text of a cell of a kind.
fn value<'a>(kind: &str, text: &'a str, strings: &'a [String]) -> Result<Cow<'a, str>, Box<Fault>> {
    let word = text.trim();
    Ok(match kind {
        "s" if word.is_empty() => Cow::Borrowed(""),
        "s" => match word.parse().ok().and_then(|number: usize| strings.get(number)) {
            Some(own) => Cow::Borrowed(own),
            None => return Err(broken(&format!("a cell names the text {word}, which is not there"))),
        },
        "b" if word == "1" => Cow::Borrowed("TRUE"),
        "b" if word == "0" => Cow::Borrowed("FALSE"),
        // 0.1 is often written as 0.10000000000000001.
        "" | "n" => match word.parse().ok().filter(|number: &f64| number.is_finite()) {
            Some(number) => Cow::Owned(number.to_string()),
            None => Cow::Borrowed(text),
        },
        _ => Cow::Borrowed(text),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Cursor, Write};
    use zip::write::SimpleFileOptions;
    use zip::{CompressionMethod, ZipWriter};

    use crate::exchange::mesh::twisted::twisted;

    const ROOT: &str = r#"<Relationships><Relationship Id="r" Type="http://x/officeDocument" Target="xl/workbook.xml"/></Relationships>"#;
    const BOOK: &str = r#"<?xml version="1.0"?><workbook xmlns:r="x"><sheets><sheet name="lists" state="hidden" sheetId="1" r:id="a"/><sheet name="none" sheetId="2" r:id="b"/><sheet name="stones" sheetId="3" r:id="c"/><sheet name="M&amp;M" sheetId="4" r:id="a"/></sheets></workbook>"#;
    const LINKS: &str = r#"<Relationships><Relationship Id="a" Type="http://x/worksheet" Target="/xl/a.xml"/><Relationship Id="b" Type="http://x/worksheet" Target="b.xml"/><Relationship Id="c" Type="http://x/worksheet" Target="c.xml"/><Relationship Id="s" Type="http://x/sharedStrings" Target="s.xml"/></Relationships>"#;
    const STRINGS: &str = r#"<sst count="9" uniqueCount="1000000000000000"><si><t>x (cm)</t></si><si><r><t>le</t></r><r><t>ft &lt;&#65;</t></r><rPh><t>no</t></rPh></si></sst>"#;
    const OTHER: &str = r#"<worksheet><sheetData><row><c><v>1</v></c></row></sheetData></worksheet>"#;
    const SHEET: &str = r#"<worksheet><dimension ref="A1:ZZZZZZZ9"/><sheetData><row r="1"><c r="A1" t="s"><v>0</v></c><c r="C1" t="s"><v>1</v></c></row><row r="3"><c t="n"><v>0.10000000000000001</v></c><c t="b"><v>1</v></c><c t="inlineStr"><is><t> a </t></is></c><c s="4"/><c t="e"><v>#N/A</v></c><c><f>A3*2</f><v>1E-2</v></c><c t="str"><v></v></c></row></sheetData></worksheet>"#;

    fn book(sheet: &str, method: CompressionMethod) -> Vec<u8> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (path, text) in [
            ("_rels/.rels", ROOT),
            ("xl/workbook.xml", BOOK),
            ("xl/_rels/workbook.xml.rels", LINKS),
            ("xl/a.xml", OTHER),
            ("xl/b.xml", "<worksheet><sheetData/></worksheet>"),
            ("xl/c.xml", sheet),
            ("xl/s.xml", STRINGS),
        ] {
            let options = SimpleFileOptions::default().compression_method(method);
            zip.start_file(path, options).expect("a part");
            zip.write_all(text.as_bytes()).expect("its text");
        }
        zip.finish().expect("a file").into_inner()
    }

    fn stored(sheet: &str) -> Vec<u8> {
        book(sheet, CompressionMethod::Stored)
    }

    #[test]
    fn the_first_sheet_with_cells_is_read_as_texts() {
        for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
            let (rows, warnings) = sheet_rows(&book(SHEET, method)).expect("it reads");
            let told = "only the sheet \"stones\" is read; there are others: \"M&M\"";
            assert_eq!(warnings, [told]);
            assert_eq!(rows.len(), 3);
            assert_eq!(rows[0], ["x (cm)", "", "left <A"]);
            assert!(rows[1].is_empty());
            assert_eq!(rows[2], ["0.1", "TRUE", " a ", "", "#N/A", "0.01"]);
        }
    }

    #[test]
    fn what_cannot_be_read_is_refused_with_a_reason() {
        let cell = |own: &str| stored(&SHEET.replace(r#"<c r="A1" t="s"><v>0</v></c>"#, own));
        for (bytes, found) in [
            (Vec::new(), "cannot be read as a workbook"),
            ([&OLD[..], &[0; 99]].concat(), "behind a password"),
            (cell(r#"<c r="A200001"><v>1</v></c>"#), "cells far from the first"),
            (cell(r#"<c r="AAAAAAAAAAAAA1"><v>1</v></c>"#), "cells far from the first"),
            (cell(r#"<c t="s"><v>2</v></c>"#), "names the text 2"),
            (cell("<c><v>1</c>"), "cannot be read"),
            (stored(&SHEET[..200]).to_vec(), "cannot be read"),
        ] {
            let faults = sheet_rows(&bytes).map(|(rows, _)| rows.len()).expect_err(found);
            assert!(faults.faults[0].found.contains(found), "{faults}");
        }
        let empty = stored("<worksheet/>");
        let (rows, _) = sheet_rows(&empty).expect("the other one");
        assert_eq!(rows, [["1"]]);
    }

    #[test]
    fn nothing_that_is_twisted_breaks_it() {
        twisted(&stored(SHEET), |bytes| drop(sheet_rows(bytes)));
        twisted(SHEET.as_bytes(), |text| {
            let own = rows(&String::from_utf8_lossy(text), &["x".to_owned()]).unwrap_or_default();
            assert!(own.iter().map(Vec::len).sum::<usize>() <= MOST_CELLS);
        });
        twisted(STRINGS.as_bytes(), |text| drop(strings(&String::from_utf8_lossy(text))));
        twisted(BOOK.as_bytes(), |text| drop(sheets(&String::from_utf8_lossy(text))));
    }
}
