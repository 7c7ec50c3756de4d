//! Tables of values whose header states the unit.

use crate::math::{Vec3, pow};
use crate::motion::read::decimals::Decimals;
use crate::motion::read::number::{number, shortened};
use crate::motion::read::samples::{Samples, Unit, checked_step};
use crate::motion::read::{FORMATS, Lines};
use crate::motion::{BadRecord, Motion};

/// What a column may be called.
const COLUMNS: &str = "t_s for times, and a (or ax, ay, az) with its unit: a_m_per_s2, a_cm_per_s2 or a_g";
/// Largest distance of a time from its place at equal steps, as a share of the step, whatever the rounding in print: a time that is missing
/// is half a step off at least, by the mean step.
const LARGEST_SHIFT: f64 = 0.25;

/// A column.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Column {
    Time,
    /// Along x unless an axis is named.
    Acceleration {
        axis: Option<usize>,
        unit: Unit,
    },
}

impl Column {
    /// The axis it speaks of: `None` of times, `Some(None)` where none is named.
    fn axis(self) -> Option<Option<usize>> {
        match self {
            Column::Time => None,
            Column::Acceleration { axis, .. } => Some(axis),
        }
    }

    fn named(name: &str) -> Option<Column> {
        if name == "t_s" {
            return Some(Column::Time);
        }
        let (quantity, unit) = name.split_once('_')?;
        let axis = match quantity {
            "a" => None,
            "ax" => Some(0),
            "ay" => Some(1),
            "az" => Some(2),
            _ => return None,
        };
        let unit = match unit {
            "m_per_s2" => Unit::MetrePerSquareSecond,
            "cm_per_s2" => Unit::CentimetrePerSquareSecond,
            "g" => Unit::Gravity,
            _ => return None,
        };
        Some(Column::Acceleration { axis, unit })
    }
}

/// Times as they are printed.
#[derive(Default)]
struct Times {
    values: Vec<f64>,
    lines: Vec<usize>,
    /// Worth of the last digit (s) of those that have a fraction: the finest and the coarsest one.
    digits: Option<[f64; 2]>,
    /// Whether they have exponents, so that a longer time has a coarser last digit. Else zeros at the end may have been left out.
    exponents: bool,
}

/// Components along their axes, from the lines of a file.
pub(super) fn read(name: &str, lines: Lines) -> Result<Motion, BadRecord> {
    let stated = stated_step(lines)?;
    let mut rows = lines.iter().filter(|(_, line)| !is_without_cells(line)).peekable();
    let told = rows.next_if(|(_, first)| told_separator(first).is_some());
    let Some((header_line, header)) = rows.next() else {
        return Err(BadRecord::at(0, "there are only comments", "a header and values", "add the values"));
    };
    let separator = [';', '\t', ','].into_iter().find(|c| header.contains(*c));
    let separator = told.and_then(|(_, first)| told_separator(first)).or(separator);
    let columns = columns(*header_line, header, separator)?;
    let mut times = Times::default();
    let mut decimals = Decimals::default();
    let mut samples: Vec<Samples> = columns.iter().map(|_| Samples::default()).collect();
    for (line, text) in rows {
        let words = cells(*line, text, separator)?;
        if words.len() != columns.len() {
            let found = format!("the row has {} values", words.len());
            let allowed = format!("{}, as the header has columns", columns.len());
            let fix = match separator == Some(',') && words.len() == 2 * columns.len() {
                true => "write a point for the decimal comma, or separate the cells by semicolons",
                false => "complete or mend the row",
            };
            return Err(BadRecord::at(*line, found, allowed, fix));
        }
        for ((column, samples), word) in columns.iter().zip(&mut samples).zip(words) {
            let word = decimals.pointed(word, *line);
            let value = cell(*line, &word)?;
            match column {
                Column::Time => times.push(value, &word, *line)?,
                Column::Acceleration { .. } => samples.push(value, *line)?,
            }
        }
    }
    decimals.agree()?;
    let step = if columns.contains(&Column::Time) {
        times.step(stated)?
    } else {
        let Some((line, step)) = stated else {
            let fix = "add a column t_s, or a line \"# dt_s = 0.005\" before the header";
            return Err(BadRecord::at(
                *header_line,
                "no step is stated",
                "a column t_s or a stated step",
                fix,
            ));
        };
        checked_step(step, line)?
    };
    motion(name, step, &columns, samples)
}

/// The motion of all columns. One too weak to be alone may go with another one.
fn motion(name: &str, step: f64, columns: &[Column], samples: Vec<Samples>) -> Result<Motion, BadRecord> {
    let mut weak = None;
    let mut components = Vec::new();
    for (column, samples) in columns.iter().zip(samples) {
        let Column::Acceleration { axis, unit } = *column else { continue };
        let fault = samples.weakness(unit);
        let is_weak = fault.is_some();
        weak = weak.or(fault);
        let (record, notes) = samples.record(step, unit)?;
        let mut direction = Vec3::zeros();
        direction[axis.unwrap_or(0)] = 1.0;
        let one = Motion::of_record(name, record).noted(notes).along(&direction);
        components.push((is_weak, one.expect("one component and a direction")));
    }
    if let Some(fault) = weak.filter(|_| components.iter().all(|(is_weak, _)| *is_weak)) {
        return Err(fault);
    }
    let whole = components.into_iter().map(|(_, one)| one);
    let whole = whole.reduce(|whole, one| whole.with(&one).expect("the same step"));
    Ok(whole.expect("a header without acceleration is refused"))
}

/// The step of a comment `dt_s = 0.005`, with its line.
fn stated_step(lines: Lines) -> Result<Option<(usize, f64)>, BadRecord> {
    let mut found = None;
    for (line, text) in lines.iter().filter(|(_, text)| text.starts_with('#')) {
        let said = text.trim_start_matches('#').trim();
        let Some((key, value)) = said.split_once(['=', ':']) else { continue };
        if key.trim() != "dt_s" {
            continue;
        }
        let value = number(value.trim()).map_err(|found| {
            BadRecord::at(
                *line,
                format!("dt_s: {found}"),
                "a number of seconds",
                "write it as \"# dt_s = 0.005\"",
            )
        })?;
        if found.is_some() {
            return Err(BadRecord::at(*line, "dt_s is stated twice", "one step", "keep one of them"));
        }
        found = Some((*line, value));
    }
    Ok(found)
}

/// Whether a line is blank, a comment, or a row of nothing but separators, as spreadsheets leave them below a table.
fn is_without_cells(line: &str) -> bool {
    line.trim_start_matches('"').starts_with('#') || line.chars().all(|c| " \t;,\"".contains(c))
}

/// The separator that a first line `sep=;` states.
fn told_separator(line: &str) -> Option<char> {
    let line = line.trim_matches('"');
    let told = line.get(..4).filter(|start| start.eq_ignore_ascii_case("sep=")).and(line.get(4..))?;
    told.chars().next().filter(|c| [';', '\t', ','].contains(c))
}

/// The cells of a row, without the quotes that spreadsheets put about them. A separator within quotes separates nothing.
fn cells(line: usize, row: &str, separator: Option<char>) -> Result<Vec<&str>, BadRecord> {
    let mut is_quoted = false;
    let parts = row.split(|c: char| {
        is_quoted ^= c == '"';
        !is_quoted && Some(c) == separator
    });
    let found = parts.map(|cell| cell.trim().trim_matches('"').trim()).collect();
    match is_quoted {
        false => Ok(found),
        true => {
            let allowed = "quotes in pairs";
            Err(BadRecord::at(line, "a quote is not closed on its line", allowed, "mend the quotes"))
        }
    }
}

fn columns(line: usize, header: &str, separator: Option<char>) -> Result<Vec<Column>, BadRecord> {
    let names = cells(line, header, separator)?;
    if names.iter().all(|name| number(name).is_ok())
        || header.split_whitespace().all(|word| number(word).is_ok())
    {
        let found = "the values begin without a header, so that neither unit nor step is known";
        return Err(BadRecord::at(line, found, FORMATS, format!("add a header of columns ({COLUMNS})")));
    }
    let mut columns = Vec::new();
    for name in names {
        let column = Column::named(&name.to_ascii_lowercase()).ok_or_else(|| {
            let found = format!("the column {:?} is not known", shortened(name));
            BadRecord::at(line, found, COLUMNS, "rename or remove the column")
        })?;
        if columns.iter().any(|other: &Column| other.axis() == column.axis()) {
            let found = format!("the column {:?} comes twice, or in two units", shortened(name));
            return Err(BadRecord::at(line, found, "each component once", "remove one of them"));
        }
        columns.push(column);
    }
    let axes: Vec<_> = columns.iter().filter_map(|column| column.axis()).collect();
    if axes.is_empty() {
        return Err(BadRecord::at(line, "there is no acceleration", COLUMNS, "add a column of acceleration"));
    }
    if axes.len() > 1 && axes.contains(&None) {
        let found = "a component without an axis stands beside others";
        return Err(BadRecord::at(line, found, "ax, ay and az", "name the axis of each component"));
    }
    Ok(columns)
}

fn cell(line: usize, word: &str) -> Result<f64, BadRecord> {
    let refused = |found: String, fix: &str| Err(BadRecord::at(line, found, "a number in every cell", fix));
    match number(word) {
        _ if word.is_empty() => refused("a cell is empty".to_owned(), "complete the row"),
        Ok(value) => Ok(value),
        Err(found) => refused(found, "remove or mend what is no value"),
    }
}

impl Times {
    fn push(&mut self, time: f64, word: &str, line: usize) -> Result<(), BadRecord> {
        if let Some(before) = self.values.last()
            && time <= *before
        {
            let found = format!("the time {time} s follows {before} s");
            let fix = "sort the rows, remove those that come twice, or print times with more digits";
            return Err(BadRecord::at(line, found, "times that rise", fix));
        }
        if let Some(digit) = last_digit(word) {
            let [finest, coarsest] = self.digits.unwrap_or([digit; 2]);
            self.digits = Some([digit.min(finest), digit.max(coarsest)]);
        }
        self.exponents |= word.contains(['e', 'E', 'd', 'D']);
        self.values.push(time);
        self.lines.push(line);
        Ok(())
    }

    /// The step of times that are equally far apart but for their rounding in print; with a stated step, that one.
    fn step(&self, stated: Option<(usize, f64)>) -> Result<f64, BadRecord> {
        let last = self.values.len().saturating_sub(1);
        if last == 0 {
            let found = "there are fewer than two times";
            return Err(BadRecord::at(
                0,
                found,
                "a time for each of at least 3 values",
                "give the whole record",
            ));
        }
        let mean = (self.values[last] - self.values[0]) / last as f64;
        let (line, step) = stated.unwrap_or((self.lines[1], mean));
        let step = checked_step(step, line)?;
        let [finest, coarsest] = self.digits.unwrap_or_default();
        // Half a digit of the time itself, and half a digit of the first and the last one. Times of many digits have rounding of their own.
        let rounding = 1.01 * if self.exponents { coarsest } else { finest };
        let allowed = rounding.max(1e-6 * step).min(LARGEST_SHIFT * step);
        let shift = |i: usize| self.values[i] - self.values[0] - step * i as f64;
        if (1..=last).all(|i| shift(i).abs() <= allowed) {
            return Ok(step);
        }
        // To blame is the first one of the largest leaps: a mean step is bent by a gap, and times before it are off as well.
        let leap = |i: usize| (shift(i) - shift(i - 1)).abs();
        let largest = (1..=last).fold(0.0, |largest: f64, i| largest.max(leap(i)));
        let at = (1..=last).find(|&i| leap(i) >= largest - 1e-6 * step).unwrap_or(1);
        let found = format!(
            "the times step by {:.6} s from {} s to {} s, and by {step:.6} s on the whole",
            self.values[at] - self.values[at - 1],
            self.values[at - 1],
            self.values[at]
        );
        let fix =
            "resample the record to equal steps, or state the step (\"# dt_s = 0.005\") if times are rounded";
        Err(BadRecord::at(self.lines[at], found, "equal steps", fix))
    }
}

/// Worth of the last digit of a number as it is printed: 0.001 of `0.125`, 1e-5 of `1.25E-3`. Without a fraction a number is exact.
fn last_digit(word: &str) -> Option<f64> {
    let lower = word.to_ascii_lowercase();
    let (mantissa, exponent) = lower.split_once(['e', 'd']).unwrap_or((&lower, "0"));
    let (_, fraction) = mantissa.split_once('.')?;
    let places = exponent.parse::<i32>().unwrap_or(0) - fraction.len() as i32;
    Some(pow(10.0, f64::from(places)))
}
