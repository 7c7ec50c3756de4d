//! What was said of campaigns so far, kept in the repository. The whole test takes more than an hour: it goes on from here on any
//! machine, and everybody can count its table anew.
//!
//! A run's folder as a table, a row per file: all that takes long to find and is short to tell. Campaigns are not kept, as they are
//! solved again to the bit from their labels, nor are labels, which come from the roster and the secret.

use std::fs;
use std::path::Path;

use pirca::ensemble::replace_file;
use polars::prelude::{Column, DataFrame, NamedFrom, PolarsResult, Series};
use polars_io::prelude::{ParquetReader, ParquetWriter, SerReader};
use serde::Serialize;
use serde_json::{Number, Value};

use crate::folders::put;

/// Folders of a run that are kept, with those in them.
const KEPT: [&str; 4] = ["verdicts", "shifts", "conflicts", "laws"];
/// What was said, and no part of it that a run which was stopped has left.
const SAID: [&str; 1] = ["json"];
/// Where labels lie; of these the secret is kept, the bank's design, and which campaigns could not be solved.
const SEALED: &str = "sealed";
const SEALED_KEPT: [&str; 2] = ["txt", "unsolved"];
/// Columns: the folder, the file in it, and what it says.
const COLUMNS: [&str; 3] = ["folder", "file", "text"];

/// A number is told by so many digits.
const DIGITS: usize = 6;

/// What is written of a campaign: JSON with no more digits than tell anything.
pub fn json(what: &impl Serialize) -> String {
    let mut value = serde_json::to_value(what).expect("it has string keys only");
    shorten(&mut value);
    value.to_string()
}

fn shorten(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() => {
            let whole = number.as_f64().expect("it is one");
            let short = format!("{whole:.*e}", DIGITS - 1).parse().expect("a number");
            *number = Number::from_f64(short).expect("JSON has finite numbers only");
        }
        Value::Array(values) => values.iter_mut().for_each(shorten),
        Value::Object(values) => values.values_mut().for_each(shorten),
        _ => {}
    }
}

/// Writes a run's folder into a file.
pub fn pack(out: &Path, record: &Path) {
    let mut rows = Vec::new();
    for folder in KEPT {
        collect(out, folder, &SAID, &mut rows);
    }
    collect(out, SEALED, &SEALED_KEPT, &mut rows);
    rows.sort();
    let column = |k: usize| {
        let own: Vec<&str> = rows.iter().map(|row: &[String; 3]| row[k].as_str()).collect();
        Column::from(Series::new(COLUMNS[k].into(), own))
    };
    let mut bytes = Vec::new();
    DataFrame::new(rows.len(), [0, 1, 2].map(column).to_vec())
        .and_then(|mut frame| ParquetWriter::new(&mut bytes).finish(&mut frame))
        .unwrap_or_else(|error| panic!("{}: {error}", record.display()));
    replace_file(record, &bytes).unwrap_or_else(|error| panic!("{error}"));
}

/// Adds the files of a folder, and of those in it, whose extension is kept.
fn collect(out: &Path, folder: &str, kept: &[&str], rows: &mut Vec<[String; 3]>) {
    let Ok(entries) = fs::read_dir(out.join(folder)) else { return };
    for entry in entries {
        let path = entry.unwrap_or_else(|error| panic!("{folder}: {error}")).path();
        let name =
            path.file_name().and_then(|name| name.to_str()).expect("runs write plain names").to_owned();
        if path.is_dir() {
            collect(out, &format!("{folder}/{name}"), kept, rows);
        } else if path.extension().and_then(|own| own.to_str()).is_some_and(|own| kept.contains(&own)) {
            let text =
                fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            rows.push([folder.to_owned(), name, text]);
        }
    }
}

/// Writes what a file holds into a run's folder, where it is not there yet. A file that is not there holds nothing.
pub fn unpack(record: &Path, out: &Path) {
    let Ok(file) = fs::File::open(record) else { return };
    let rows = rows(file).unwrap_or_else(|error| panic!("{} is no record: {error}", record.display()));
    for [folder, file, text] in rows {
        let folder = out.join(folder);
        if !folder.join(&file).exists() {
            fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
            put(&folder.join(file), &text);
        }
    }
}

/// By [`COLUMNS`].
fn rows(file: fs::File) -> PolarsResult<Vec<[String; 3]>> {
    let frame = ParquetReader::new(file).finish()?;
    let [folders, files, texts] = COLUMNS.map(|name| frame.column(name).and_then(|own| own.str()));
    let rows = folders?.iter().zip(files?.iter()).zip(texts?.iter());
    Ok(rows
        .map(|((folder, file), text)| [folder, file, text].map(|own| own.unwrap_or_default().into()))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_goes_on_from_its_record_with_all_that_was_said_and_nothing_that_is_solved_again() {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("record");
        if folder.exists() {
            fs::remove_dir_all(&folder).expect("the folder is the test's own");
        }
        let [first, second] = ["first", "second"].map(|name| folder.join(name));
        let said = [
            ("verdicts", "b.json", r#"{"paper":{"p_value":0.5}}"#),
            ("verdicts", "a.json", "{}"),
            ("conflicts/rich", "a.json", "0.5"),
            ("shifts/rich", "a.json", "2.5"),
            ("laws", "a.json", "null"),
            ("sealed", "secret.txt", "never told"),
            ("sealed", "c.unsolved", "strong"),
        ];
        let others = [
            ("sealed", "a.json", "a label"),
            ("campaigns/a", "rich.csv", "1"),
            ("again", "a.json", "{}"),
            ("verdicts", "c.json.partial", "{"),
        ];
        for (own, file, text) in said.iter().chain(&others) {
            fs::create_dir_all(first.join(own)).expect("it can be made");
            fs::write(first.join(own).join(file), text).expect("it can be written");
        }
        let record = folder.join("record.parquet");
        pack(&first, &record);
        // What is there stays.
        fs::create_dir_all(second.join("verdicts")).expect("it can be made");
        fs::write(second.join("verdicts/a.json"), "of its own").expect("it can be written");
        unpack(&record, &second);
        let read = |own: &str, file: &str| fs::read_to_string(second.join(own).join(file)).ok();
        for (own, file, text) in said {
            let text = if (own, file) == ("verdicts", "a.json") { "of its own" } else { text };
            assert_eq!(read(own, file).as_deref(), Some(text), "{own}/{file}");
        }
        for (own, file, _) in others {
            assert_eq!(read(own, file), None, "{own}/{file}");
        }
        // A run that begins has none.
        unpack(&folder.join("none.parquet"), &second);
    }

    #[test]
    fn numbers_are_told_by_six_digits_and_read_as_they_were_told() {
        let said = json(&(1.0 / 3.0, vec![2e-300 / 3.0, 1e20 / 3.0], "1.23456789", 123_456_789_u64));
        assert_eq!(said, r#"[0.333333,[6.66667e-301,3.33333e+19],"1.23456789",123456789]"#);
        let again: Value = serde_json::from_str(&said).expect("JSON");
        assert_eq!(json(&again), said);
    }
}
