//! K-NET ASCII, of K-NET and KiK-net (NIED, Japan): seventeen lines `Key   value`, then counts of the digitiser in columns.

use crate::math::Vec3;
use crate::motion::read::number::{number, shortened, values};
use crate::motion::read::samples::{SAME_PEAK, Samples, Unit, checked_step};
use crate::motion::read::{HEAD, Lines};
use crate::motion::{BadRecord, Motion};

/// Keys of the header that no other format has.
const MARKS: [&str; 2] = ["Sampling Freq", "Scale Factor  "];
/// The last line of the header.
const LAST: &str = "Memo.";

/// Whether a line belongs to such a file alone.
pub(super) fn is_mark(line: &str) -> bool {
    MARKS.iter().any(|mark| line.starts_with(mark))
}

/// A record along x, or along z of a vertical channel, from the lines of a file.
///
/// The digitiser's zero is not that of the ground: the mean of the counts is taken off, as NIED's maximum in the header is without it.
pub(super) fn read(name: &str, lines: Lines) -> Result<Motion, BadRecord> {
    let last = lines.iter().take(HEAD).position(|(_, line)| line.starts_with(LAST));
    let Some(end) = last else {
        let found = "this is K-NET ASCII, and the line \"Memo.\" that ends its header is missing";
        return Err(BadRecord::at(0, found, "a header of 17 lines", "get the whole file"));
    };
    let (head, body) = lines.split_at(end + 1);
    let (line, rate) = stated(head, "Sampling Freq")?;
    let of_word = |word: &str| number(word.trim_end_matches(|c: char| c.is_ascii_alphabetic())).ok();
    let hertz = of_word(rate).filter(|hertz| *hertz > 0.0).ok_or_else(|| {
        let found = format!("Sampling Freq is {:?}", shortened(rate));
        BadRecord::at(line, found, "a frequency, as 100Hz", "correct it")
    })?;
    let step = checked_step(1.0 / hertz, line)?;
    let (line, factor) = stated(head, "Scale Factor")?;
    let gal_per_count = scale(factor).ok_or_else(|| {
        let found = format!("Scale Factor is {:?}", shortened(factor));
        BadRecord::at(line, found, "a ratio, as 3920(gal)/6182761", "correct it")
    })?;
    let mut counts = Vec::new();
    for (line, text) in body.iter().filter(|(_, text)| !text.is_empty()) {
        let found = values(text).map_err(|found| {
            BadRecord::at(*line, found, "counts alone, after the header", "remove or mend what is no value")
        })?;
        counts.extend(found.into_iter().map(|count| (count, *line)));
    }
    let mean = counts.iter().map(|(count, _)| count).sum::<f64>() / counts.len().max(1) as f64;
    let mut samples = Samples::default();
    for (count, line) in counts {
        samples.push((count - mean) * gal_per_count, line)?;
    }
    let unit = Unit::CentimetrePerSquareSecond;
    let peak = samples.peak();
    let said = peak_stated(head);
    let is_said = said.is_some_and(|said| (said - peak).abs() <= SAME_PEAK * peak);
    if let Some(fault) = samples.weakness(unit).filter(|_| !is_said || peak == 0.0) {
        return Err(fault);
    }
    let (record, mut notes) = samples.record(step, unit)?;
    let offset = mean * gal_per_count;
    notes.push(format!("the mean of the values, {offset:.3} cm/s^2, is the digitiser's zero and taken off"));
    if let Some(said) = said.filter(|_| !is_said) {
        notes.push(format!("the header states a peak of {said} cm/s^2, and that of the values is {peak:.3}"));
    }
    let motion = Motion::of_record(name, record).noted(notes);
    // KiK-net numbers its channels: 3 and 6 are vertical.
    let is_vertical = stated(head, "Dir.").is_ok_and(|(_, way)| matches!(way, "U-D" | "UD" | "3" | "6"));
    Ok(if is_vertical { motion.along(&Vec3::z()).expect("one component and a direction") } else { motion })
}

/// Line and value of a key.
fn stated<'a>(head: Lines<'a>, key: &str) -> Result<(usize, &'a str), BadRecord> {
    let found = head.iter().find_map(|(line, text)| {
        let rest = text.strip_prefix(key)?;
        // A unit belongs to the key: Sampling Freq(Hz).
        let rest = rest.strip_prefix('(').and_then(|unit| Some(unit.split_once(')')?.1)).unwrap_or(rest);
        Some((*line, rest.trim())).filter(|(_, value)| !value.is_empty())
    });
    found.ok_or_else(|| {
        let fix = "get the whole file, or add the line to the header";
        BadRecord::at(0, format!("{key} is missing"), "the 17 lines of a K-NET header", fix)
    })
}

/// cm/s^2 of a count: `3920(gal)/6182761`.
fn scale(factor: &str) -> Option<f64> {
    let (full, counts) = factor.split_once('/')?;
    let (full, unit) = full.split_once('(')?;
    let [full, counts] = [full, counts].map(|word| number(word.trim()).ok());
    let ratio = full? / counts?;
    (unit.trim_end().eq_ignore_ascii_case("gal)") && ratio > 0.0 && ratio.is_finite()).then_some(ratio)
}

/// The largest acceleration (cm/s^2) that the header states, spelled `Max. Acc. (gal)` or `Max Acc. (gal)`.
fn peak_stated(head: Lines) -> Option<f64> {
    let line = head.iter().map(|(_, text)| *text).find(|text| text.starts_with("Max"))?;
    number(line.split_once(')')?.1.trim()).ok()
}
