//! `benches/history`: what scenes took, by date and kind of machine, and whether one has become slower since.
//!
//! A file `<date>-<machine>.csv` has a row per scene and quantity. Its columns are found by their names, and the last four of
//! [`COLUMNS`] may be missing: the first records were written by hand.

use std::cmp::Reverse;
use std::fs;
use std::path::Path;

/// A scene that takes more than so many times what its last record says has become slower. Medians of one machine at rest
/// differ by some per cent from day to day, so a fifth is more than chance, and small enough that a lost optimisation shows.
pub const SLOWER: f64 = 1.2;
/// The columns of a record as they are written.
pub const COLUMNS: [&str; 9] =
    ["scene", "quantity", "median", "low", "high", "unit", "runs", "processor", "note"];
/// So many of them, the first ones, every record has.
const NEEDED: usize = 6;

/// One scene's line of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What was run; with `quantity` it names the scene.
    pub scene: String,
    /// What was asked of it.
    pub quantity: String,
    /// Median and spread, in `unit`. New records give the quartiles of the runs as spread.
    pub median: f64,
    /// Lower end of the spread.
    pub low: f64,
    /// Upper end of the spread.
    pub high: f64,
    /// As it is written: `s`, `ms`, `1/s` or `MB`.
    pub unit: String,
    /// Number of runs, if it was written down.
    pub runs: String,
    /// The processor in full, if it was written down.
    pub processor: String,
    /// Anything else.
    pub note: String,
}

/// A row with the date of its record.
#[derive(Clone, Debug, PartialEq)]
pub struct Dated {
    /// `YYYY-MM-DD`.
    pub date: String,
    /// What was recorded.
    pub row: Row,
}

impl Row {
    /// Scene and quantity, as they are printed and as the changelog names them.
    pub fn name(&self) -> String {
        format!("{}, {}", self.scene, self.quantity)
    }

    /// Cost of the scene in a base unit, the more the worse: seconds, seconds per piece, or megabytes. The base unit comes
    /// with it, as only costs in the same one compare.
    fn cost(&self) -> Option<(f64, &'static str)> {
        match self.unit.as_str() {
            "s" => Some((self.median, "s")),
            "ms" => Some((self.median * 1e-3, "s")),
            "1/s" => Some((1.0 / self.median, "s per piece")),
            "MB" => Some((self.median, "MB")),
            _ => None,
        }
    }

    /// How many times as much as before it costs now; above 1 it has become worse. Nothing where the units do not compare.
    pub fn ratio_to(&self, before: &Row) -> Option<f64> {
        let ((now, unit), (then, unit_then)) = (self.cost()?, before.cost()?);
        (unit == unit_then).then_some(now / then)
    }

    /// Whether it costs more than [`SLOWER`] times as much as before.
    pub fn is_slower_than(&self, before: &Row) -> bool {
        self.ratio_to(before).is_some_and(|ratio| ratio > SLOWER)
    }
}

/// The records of one kind of machine, oldest first.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// Every row of every record.
    pub rows: Vec<Dated>,
}

impl History {
    /// Reads the records of a machine from a folder.
    ///
    /// # Errors
    /// A file that cannot be read, or a line of it that is no row of a record.
    pub fn read(folder: &Path, machine: &str) -> Result<History, String> {
        let mut files: Vec<(String, String)> = Vec::new();
        for entry in fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))? {
            let path = entry.map_err(|error| error.to_string())?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if dated(&name).is_some_and(|(_, own)| own == machine) {
                let text = fs::read_to_string(&path).map_err(|error| format!("{name}: {error}"))?;
                files.push((name, text));
            }
        }
        // The names begin with the date.
        files.sort();
        let mut history = History::default();
        for (name, text) in files {
            let date = dated(&name).expect("only such names are kept").0.to_owned();
            let rows = rows(&text).map_err(|fault| format!("{name}: {fault}"))?;
            history.rows.extend(rows.into_iter().map(|row| Dated { date: date.clone(), row }));
        }
        Ok(history)
    }

    /// The last record of the scene that a row is of, if there is one.
    pub fn last(&self, of: &Row) -> Option<&Dated> {
        self.rows.iter().rev().find(|dated| dated.row.name() == of.name())
    }
}

/// Date and machine in a record's file name.
pub fn dated(name: &str) -> Option<(&str, &str)> {
    let stem = name.strip_suffix(".csv")?;
    let (date, machine) = stem.split_at_checked(10)?;
    let is_date = date.bytes().enumerate().all(|(at, byte)| match at {
        4 | 7 => byte == b'-',
        _ => byte.is_ascii_digit(),
    });
    Some((date, machine.strip_prefix('-')?)).filter(|_| is_date)
}

/// Reads the rows of a record.
///
/// # Errors
/// The first line that is not one, with what is wrong.
pub fn rows(text: &str) -> Result<Vec<Row>, String> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let header = lines.next().map(|(_, line)| cells(line)).unwrap_or_default();
    let places = COLUMNS.map(|column| header.iter().position(|name| name == column));
    if let Some(missing) = (0..NEEDED).find(|&column| places[column].is_none()) {
        return Err(format!("no column `{}`", COLUMNS[missing]));
    }
    lines
        .map(|(at, line)| row(&cells(line), places).map_err(|fault| format!("line {}: {fault}", at + 1)))
        .collect()
}

fn row(cells: &[String], places: [Option<usize>; COLUMNS.len()]) -> Result<Row, String> {
    let cell = |column: usize| places[column].and_then(|place| cells.get(place)).cloned().unwrap_or_default();
    let number = |column: usize| {
        let positive = cell(column).parse().ok().filter(|value: &f64| *value > 0.0 && value.is_finite());
        positive.ok_or_else(|| format!("{} is `{}`, not a number above 0", COLUMNS[column], cell(column)))
    };
    let row = Row {
        scene: cell(0),
        quantity: cell(1),
        median: number(2)?,
        low: number(3)?,
        high: number(4)?,
        unit: cell(5),
        runs: cell(6),
        processor: cell(7),
        note: cell(8),
    };
    row.cost().ok_or_else(|| format!("unit is `{}`, not s, ms, 1/s or MB", row.unit))?;
    Ok(row)
}

/// The cells of a line; quotes let one hold commas, and two quotes in it are one.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut is_quoted) = (vec![String::new()], false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if is_quoted && letters.peek() == Some(&'"') => {
                letters.next();
                cells.last_mut().expect("there is one from the start").push('"');
            }
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(String::new()),
            _ => cells.last_mut().expect("there is one from the start").push(letter),
        }
    }
    cells
}

/// The text of a record: the rows that are there, of which those measured anew are replaced.
pub fn written(there: Vec<Row>, anew: &[Row]) -> String {
    let is_anew = |row: &Row| anew.iter().any(|new| new.name() == row.name());
    let kept = there.into_iter().filter(|row| !is_anew(row));
    let lines = kept.chain(anew.iter().cloned()).map(|row| {
        let [median, low, high] = [row.median, row.low, row.high].map(short);
        [row.scene, row.quantity, median, low, high, row.unit, row.runs, row.processor, row.note]
            .map(|cell| quoted(&cell))
            .join(",")
    });
    let text: Vec<String> = std::iter::once(COLUMNS.join(",")).chain(lines).collect();
    text.join("\n") + "\n"
}

/// A number to three digits, as records have it: the fourth is not the same twice.
pub fn short(value: f64) -> String {
    if value >= 1e5 {
        return format!("{value:.2e}");
    }
    let is_below = |digits: &usize| value >= [100.0, 10.0, 1.0][*digits];
    match (0..3).find(is_below) {
        Some(digits) => format!("{value:.digits$}"),
        None => format!("{value:.3}"),
    }
}

fn quoted(cell: &str) -> String {
    match cell.contains([',', '"']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    }
}

/// What is said at the end of a bench: the scenes that have become slower, the worst first; nothing where there are none.
pub fn warning(history: &History, measured: &[Row]) -> Option<String> {
    let mut slower: Vec<(f64, String)> = Vec::new();
    for row in measured {
        let Some(Dated { date, row: before }) = history.last(row) else { continue };
        let Some(ratio) = row.ratio_to(before).filter(|_| row.is_slower_than(before)) else { continue };
        let [now, then] = [row, before].map(|row| format!("{} {}", short(row.median), row.unit));
        slower
            .push((ratio, format!("  {}: {now}, {ratio:.2} times the cost of {date} ({then})", row.name())));
    }
    slower.sort_by_key(|(ratio, _)| Reverse((ratio * 1e6) as u64));
    let lines: Vec<String> = slower.into_iter().map(|(_, line)| line).collect();
    (!lines.is_empty()).then(|| {
        format!(
            "SLOWER than {SLOWER} times the last record: {} of {} scenes. Each belongs in CHANGELOG.md by this name, with its \
             reason:\n{}",
            lines.len(),
            measured.len(),
            lines.join("\n")
        )
    })
}
