//! Records from files. The format is recognised from the content, never from the name; what is odd is refused, never guessed.

mod at2;
mod cosmos;
mod csv;
mod decimals;
mod esm;
mod foreign;
mod knet;
mod number;
mod open;
mod samples;
#[cfg(test)]
mod tests;
mod unit;

use std::path::Path;

use crate::motion::{BadRecord, Motion};

/// Lines at the beginning of a file in which the marks of a format are looked for.
const HEAD: usize = 64;
/// The formats that are read.
const FORMATS: &str = "PEER AT2, ESM or ITACA ASCII, K-NET ASCII, COSMOS or CSMIP V2, or CSV with a header";

/// Lines of a text, each with its number from 1.
type Lines<'a> = &'a [(usize, &'a str)];

impl Motion {
    /// Reads a record from a file. These formats are known, by their content:
    ///
    /// - PEER AT2: `ACCELERATION TIME SERIES IN UNITS OF G` or `Acceleration in g`, then `NPTS= 4000, DT= .0050 SEC` or
    ///   `4000 0.0050 NPTS, DT`, then the values.
    /// - ESM and ITACA ASCII (DYNA 1.2 and 1.0): a header of lines `KEY: value`, with `SAMPLING_INTERVAL_S` and `UNITS`, then one value a
    ///   line.
    /// - K-NET ASCII: `Sampling Freq(Hz)`, `Scale Factor`, then counts, whose mean is taken off.
    /// - COSMOS V2: `4000 acceleration pts, ..., units=cm/sec2 (04)`, with the step in the header of real numbers; CSMIP V2:
    ///   `4000 points of accel data equally spaced at .005 sec, in cm/sec2`.
    /// - CSV with a header that states the unit: `t_s,a_g`, or `ax_m_per_s2,ay_m_per_s2` after a line `# dt_s = 0.005`. Cells may have
    ///   quotes, and decimal commas where these do not separate cells.
    ///
    /// A file of one component acts along x until [`Motion::along`] says otherwise; a vertical one, as far as its header says so, acts along z. Units of g are
    /// standard gravity. The first sample lies at the time 0. [`Motion::notes`] say what the user should know.
    ///
    /// # Errors
    /// The first fault of the file: its line, what was found, what is allowed, and how to mend it. Refused are also a peak above 5 g or
    /// below 5e-4 g, which is nearly always a slip of the unit (unless a header of ESM states that peak), times that are not at equal steps, and a count that is not the one stated.
    pub fn read(path: &Path) -> Result<Motion, BadRecord> {
        let name = path.display().to_string();
        let named = |fault: BadRecord| BadRecord { file: name.clone(), ..fault };
        let text = open::text(path).map_err(named)?;
        Motion::from_text(&name, &text)
    }

    /// The same from the text of a file; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`Motion::read`].
    ///
    /// ```
    /// use pirca::motion::Motion;
    /// let motion = Motion::from_text("push.csv", "# dt_s = 0.01\nay_g\n0.0\n0.1\n-0.1\n").unwrap();
    /// assert!((motion.acceleration(0.01).y - 0.980665).abs() < 1e-12);
    /// let fault = Motion::from_text("push.csv", "a\n0.0\n0.1\n-0.1\n").unwrap_err();
    /// assert!(fault.to_string().starts_with("push.csv:1: the column \"a\" is not known; allowed is"));
    /// ```
    pub fn from_text(name: &str, text: &str) -> Result<Motion, BadRecord> {
        let named = |fault: BadRecord| BadRecord { file: name.to_owned(), ..fault };
        recognised(name, text).map_err(named)
    }
}

fn recognised(name: &str, text: &str) -> Result<Motion, BadRecord> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    // Files of DOS may end in their mark of the end.
    let text = text.trim_end_matches('\u{1a}');
    // Lines end in LF, CR LF, or (on old machines) CR alone.
    let ends = if text.contains('\n') { '\n' } else { '\r' };
    let lines: Vec<(usize, &str)> =
        (1..).zip(text.split(ends)).map(|(number, line)| (number, line.trim())).collect();
    if lines.iter().all(|(_, line)| line.is_empty()) {
        return Err(BadRecord::at(0, "the file is empty", "a record", "check the path"));
    }
    let head = || lines.iter().take(HEAD).map(|(_, line)| *line).filter(|line| !line.starts_with('#'));
    foreign::refused(&lines)?;
    // V2 first: its comments may speak of other formats.
    if head().any(cosmos::is_mark) {
        cosmos::read(name, &lines)
    } else if head().any(knet::is_mark) {
        knet::read(name, &lines)
    } else if head().any(at2::is_mark) {
        at2::read(name, &lines)
    } else if head().any(esm::is_mark) {
        esm::read(name, &lines)
    } else {
        csv::read(name, &lines)
    }
}
