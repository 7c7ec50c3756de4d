//! Surveys: tables beside a study whose columns it takes as distributions, one value as likely as any other.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use crate::motion::Motion;
use crate::study::checked::InputFile;
use crate::study::csv::cells::{self, Cell, Line};
use crate::study::csv::numbers::Numbers;
use crate::study::csv::{self, compared};
use crate::study::fault::{Fault, Found, Place};
use crate::study::files;
use crate::study::raw::Node;
use crate::study::schema::{Interval, nearest};

/// Most rows of a survey.
pub const MOST_ROWS: usize = 10_000;

/// Reads the tables beside a study when they are first referred to.
pub struct Surveys {
    /// The study's folder; `None` where there is none, and so no survey.
    folder: Option<PathBuf>,
    files: BTreeMap<String, Option<Arc<Survey>>>,
    /// The records of ground motion, by the names that the study gives them, each read once.
    pub records: BTreeMap<String, Arc<Recorded>>,
    /// Faults of the files read.
    pub faults: Vec<Fault>,
    /// The files read, in that order.
    pub inputs: Vec<InputFile>,
}

/// A record of ground motion that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    motion: Motion,
    sha256: String,
    /// The bytes of its file.
    pub bytes: Vec<u8>,
}

/// A table that was read.
struct Survey {
    separator: char,
    /// Names of its columns, as they are compared.
    columns: Vec<String>,
    rows: Vec<Line>,
}

/// What is asked of a column.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// The value in the study that refers to it.
    pub node: &'a Node,
    /// The path of its key.
    pub path: &'a str,
    /// The unit that its values are in, as the key table names units.
    pub unit: &'static str,
    /// Where each value must lie.
    pub within: Interval,
}

impl Asked<'_> {
    /// The fault of a reference where no table can lie.
    pub fn without_a_table(&self) -> Box<Fault> {
        self.fault("numbers, in a file of `distributions`".to_owned(), "write them here, in a list")
    }

    fn fault(&self, allowed: String, fix: impl Into<String>) -> Box<Fault> {
        Box::new(Fault::at(&self.node.place, self.path, Found::Value(self.node.shown.clone()), allowed, fix))
    }
}

impl Surveys {
    /// Those in the folder of a study.
    pub fn beside(folder: Option<PathBuf>) -> Surveys {
        let (files, records) = (BTreeMap::new(), BTreeMap::new());
        Surveys { folder, files, records, faults: Vec::new(), inputs: Vec::new() }
    }

    /// Where a file lies.
    pub fn place(&self, file: &str) -> String {
        self.folder.as_ref().map_or_else(|| file.to_owned(), |folder| folder.join(file).display().to_string())
    }

    /// The values of a column that is named as `survey.csv:length_m`, in its unit; `None` where the file or a cell is faulty.
    ///
    /// # Errors
    /// A fault at the reference when it names no column.
    pub fn column(&mut self, reference: &str, asked: Asked) -> Result<Option<Vec<f64>>, Box<Fault>> {
        let Some((file, column)) = reference.rsplit_once(':') else {
            let allowed = "numbers, or a column of a table beside the study, as \"survey.csv:length_m\"";
            return Err(asked.fault(allowed.to_owned(), "write file and column with a colon between them"));
        };
        let Some(survey) = self.survey(file, asked)? else { return Ok(None) };
        let at = survey.find(file, column, &[], asked)?;
        Ok(self.values(&survey, at, column, asked, |_| "reduce it: check the unit"))
    }

    /// Rows of two columns of a file, sizes of stones in m; `None` where the file or a cell is faulty. `most` are the sizes of the wall.
    ///
    /// # Errors
    /// A fault at the reference when it names no such file, or one without these columns.
    pub fn pairs(
        &mut self,
        file: &str,
        columns: [&str; 2],
        asked: Asked,
        most: [Option<f64>; 2],
    ) -> Result<Option<Vec<[f64; 2]>>, Box<Fault>> {
        let Some(survey) = self.survey(file, asked)? else { return Ok(None) };
        let [first, second] = columns;
        let at = [survey.find(file, first, &columns, asked)?, survey.find(file, second, &columns, asked)?];
        let read = [0, 1].map(|k| {
            let high = most[k].map_or(asked.within.high, |most| most.min(asked.within.high));
            let asked = Asked { within: Interval { high, ..asked.within }, ..asked };
            self.values(&survey, at[k], columns[k], asked, larger_than_the_wall)
        });
        let [Some(first), Some(second)] = read else { return Ok(None) };
        Ok(Some(first.into_iter().zip(second).map(|(a, b)| [a, b]).collect()))
    }

    /// The file of that name, read once; `None` where it is faulty.
    fn survey(&mut self, file: &str, asked: Asked) -> Result<Option<Arc<Survey>>, Box<Fault>> {
        let fault = |allowed: String, fix: &str| asked.fault(allowed, fix);
        let path = self.beside_study(file, "a table", "survey.csv", &fault)?;
        if !self.files.contains_key(file) {
            let read = self.read(file, &path).map(Arc::new);
            self.files.insert(file.to_owned(), read);
        }
        Ok(self.files.get(file).cloned().flatten())
    }

    /// The path of a file in the study's folder; `what` it is, as the file `like`.
    ///
    /// # Errors
    /// A fault, from what is allowed and how to mend it, where no such file lies there.
    pub fn beside_study(
        &self,
        file: &str,
        what: &str,
        like: &str,
        fault: &dyn Fn(String, &str) -> Box<Fault>,
    ) -> Result<PathBuf, Box<Fault>> {
        let Some(folder) = &self.folder else {
            return Err(fault("numbers".to_owned(), "write them here: no file lies beside this"));
        };
        let is_beside = |path: &Path| path.components().all(|part| matches!(part, Component::Normal(_)));
        if file.is_empty() || !is_beside(Path::new(file)) {
            let fix = format!("put {} beside study.toml, and give its name", what.replacen("a ", "the ", 1));
            return Err(fault(format!("{what} in the folder of the study, as \"{like}\""), &fix));
        }
        let path = folder.join(file);
        if !path.exists() {
            let allowed = format!("{what} in the folder of the study, which has no {file}");
            return Err(fault(allowed, &files::similar(&path)));
        }
        Ok(path)
    }

    /// A record of ground motion in the study's folder, and the hash of its file.
    ///
    /// # Errors
    /// A fault, from what is allowed and how to mend it, where no such file lies there, or it holds no record.
    pub fn record(
        &mut self,
        file: &str,
        fault: &dyn Fn(String, &str) -> Box<Fault>,
    ) -> Result<(Motion, String), Box<Fault>> {
        if let Some(known) = self.records.get(file) {
            return Ok((known.motion.clone(), known.sha256.clone()));
        }
        let path = self.beside_study(file, "a record", "records/one.at2", fault)?;
        let rank = 2000 + self.inputs.len();
        let motion = Motion::read(&path).map_err(|bad| {
            Box::new(Fault::of_file(file, rank, &bad.found, &bad.allowed, &bad.fix).in_line(bad.line))
        })?;
        let bytes = std::fs::read(&path).map_err(|error| {
            Box::new(Fault::of_file(
                file,
                rank,
                &format!("cannot be read: {error}"),
                "a file",
                "check its permissions",
            ))
        })?;
        let sha256 = files::sha256(&bytes);
        self.inputs.push(InputFile { path: PathBuf::from(file), sha256: sha256.clone() });
        let read = Recorded { motion: motion.named(file), sha256, bytes };
        let known = self.records.entry(file.to_owned()).or_insert(Arc::new(read));
        Ok((known.motion.clone(), known.sha256.clone()))
    }

    fn read(&mut self, file: &str, path: &Path) -> Option<Survey> {
        // Behind all other files of a study.
        let rank = 1000 + self.files.len();
        let text =
            files::read(path, file, rank, csv::FORMAT).map_err(|fault| self.faults.push(*fault)).ok()?;
        self.inputs.push(InputFile { path: PathBuf::from(file), sha256: text.sha256 });
        let mut faults = Vec::new();
        let table = cells::table(&text.source, |name| !name.is_empty(), &mut faults);
        let whole = |found: &str, fix: &str| {
            let allowed = "a header and one row or more, each a stone or whatever else was surveyed";
            Fault::of_file(file, rank, found, allowed, fix)
        };
        let mut rows = table.lines.into_iter();
        let Some(header) = rows.next() else {
            self.faults.append(&mut faults);
            let fix = "begin with the names of the columns, as length_m,height_m";
            self.faults.push(whole("has no header", fix));
            return None;
        };
        let columns: Vec<String> = header.cells.iter().map(|cell| named(&cell.text)).collect();
        check_header(&columns, &header.cells, &mut faults);
        let rows: Vec<Line> = rows.collect();
        faults.extend(rows.iter().filter_map(|row| too_wide(row, columns.len(), table.separator)));
        if rows.is_empty() {
            faults.push(whole("has no rows", "add the values below the header"));
        }
        if rows.len() > MOST_ROWS {
            let (found, allowed) = (format!("has {} rows", rows.len()), format!("at most {MOST_ROWS} rows"));
            faults.push(Fault::of_file(file, rank, &found, &allowed, "take a sample of them"));
        }
        let is_sound = faults.is_empty();
        self.faults.append(&mut Fault::gathered(faults));
        is_sound.then_some(Survey { separator: table.separator, columns, rows })
    }

    /// The values of a column; `None` where one of them is faulty. `reduce` says how to mend one that is too large.
    fn values(
        &mut self,
        survey: &Survey,
        at: usize,
        column: &str,
        asked: Asked,
        reduce: fn(f64) -> &'static str,
    ) -> Option<Vec<f64>> {
        let mut numbers = Numbers::new(survey.separator);
        let mut faults = Vec::new();
        let mut values = Vec::with_capacity(survey.rows.len());
        for row in &survey.rows {
            match value(row, at, &mut numbers, (asked, reduce)) {
                Ok(value) => values.push(value),
                Err((place, found, fix)) => {
                    let allowed = format!("a number {}{}", asked.within, in_words(asked.unit));
                    faults.push(Fault::at(&place, column, found, allowed, fix));
                }
            }
        }
        faults.extend(numbers.mixed());
        let is_sound = faults.is_empty();
        self.faults.append(&mut Fault::gathered(faults));
        is_sound.then_some(values)
    }
}

impl Survey {
    /// Where the column of that name stands, if its name says that it is in the unit asked for. Those that are `taken` are not meant
    /// by a slip in its name.
    fn find(&self, file: &str, column: &str, taken: &[&str], asked: Asked) -> Result<usize, Box<Fault>> {
        let unit = suffix(asked.unit);
        let listed = || self.columns.iter().filter(|name| !name.is_empty()).cloned().collect::<Vec<_>>();
        if !named(column).ends_with(&unit) {
            let what = format!("a column of {file} in {}, whose name ends in \"{unit}\"", asked.unit);
            let fix = format!("give its values in {}, and call it {}{unit}", asked.unit, stem(column));
            return Err(asked.fault(what, fix));
        }
        if let Some(at) = self.columns.iter().position(|name| *name == named(column)) {
            return Ok(at);
        }
        let allowed = format!("a column of {file}, which has {}; it has no {column}", listed().join(", "));
        let free: Vec<String> = listed().into_iter().filter(|name| !taken.contains(&name.as_str())).collect();
        let other = self.columns.iter().find(|name| !unit.is_empty() && stem(name) == stem(column));
        Err(asked.fault(
            allowed,
            match (other, nearest(&named(column), &free)) {
                (Some(other), _) => format!("give {other} in {}, and call it {column}", asked.unit),
                (None, Some(near)) => format!("did you mean \"{near}\"?"),
                (None, None) => format!("add a column {column}"),
            },
        ))
    }
}

/// The stem of a name of a column: what stands before its unit.
fn stem(column: &str) -> String {
    const UNITS: [&str; 12] = [
        "_kg_per_m3",
        "_pa_per_m",
        "_n_per_m",
        "_pa",
        "_mm",
        "_cm",
        "_dm",
        "_m",
        "_in",
        "_ft",
        "_deg",
        "_rad",
    ];
    let name = named(column);
    UNITS.iter().find_map(|unit| name.strip_suffix(unit)).unwrap_or(&name).to_owned()
}

/// A column's name as it is compared, its unit as in the name of a key.
fn named(column: &str) -> String {
    compared(&column.replace('/', " per "))
}

/// How the name of a quantity in that unit ends.
fn suffix(unit: &str) -> String {
    if unit == "1" { String::new() } else { format!("_{}", named(unit)) }
}

fn in_words(unit: &str) -> String {
    if unit == "1" { String::new() } else { format!(" ({unit})") }
}

/// Every column has its name once.
fn check_header(columns: &[String], header: &[Cell], faults: &mut Vec<Fault>) {
    for (at, name) in columns.iter().enumerate() {
        if !name.is_empty() && columns[..at].contains(name) {
            let found = Found::Words("is the name of two columns".to_owned());
            faults.push(Fault::at(&header[at].place, name, found, "every name once", "rename one of them"));
        }
    }
}

/// The fault of a row with more cells than the header.
fn too_wide(row: &Line, width: usize, separator: char) -> Option<Fault> {
    row.cells.iter().skip(width).find(|cell| !cell.text.is_empty())?;
    let found = Found::Words(format!("has {} cells", row.cells.len()));
    let fix = match separator {
        ',' => "write decimals with a point, or separate the cells by semicolons",
        _ => "put quotes around a cell that holds the separator",
    };
    Some(Fault::at(&row.place, "", found, format!("{width}, as in the header"), fix))
}

/// A stone of a centimetre (m) is none that anybody surveys.
const LEAST_STONE: f64 = 0.01;

/// How to mend a stone of that size (m) that does not fit into its wall.
fn larger_than_the_wall(size: f64) -> &'static str {
    match size / 1000.0 >= LEAST_STONE {
        true => "the stone is larger than the wall: in mm by mistake? Divide by 1000",
        false => "the stone is larger than the wall: check its decimal point",
    }
}

/// The value in a cell of a row; else the place of what is wrong, what was found, and how to mend it.
fn value(
    row: &Line,
    at: usize,
    numbers: &mut Numbers,
    (asked, reduce): (Asked, fn(f64) -> &'static str),
) -> Result<f64, (Place, Found, &'static str)> {
    let Some(cell) = row.cells.get(at).filter(|cell| !cell.text.is_empty()) else {
        let place = row.cells.get(at).map_or(&row.place, |cell| &cell.place);
        let words = Found::Words("is empty".to_owned());
        return Err((place.clone(), words, "fill it in, or take the row away"));
    };
    let wrong = |fix| (cell.place.clone(), Found::Value(cell.text.clone()), fix);
    if cell.text.starts_with(['<', '>']) {
        return Err(wrong("write the number alone: a survey knows no bounds"));
    }
    let number = numbers.read(cell).map_err(wrong)?;
    match number {
        x if !x.is_finite() => Err(wrong("write the number, or take the row away")),
        x if !asked.within.contains(x) && x > asked.within.low => Err(wrong(reduce(x))),
        x if !asked.within.contains(x) => Err(wrong("mend it, or take the row away")),
        x => Ok(x),
    }
}
