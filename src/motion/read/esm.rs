//! ASCII files of the Engineering Strong-Motion database (ESM, format DYNA 1.2) and of ITACA (DYNA 1.0): lines `KEY: value`, then one
//! value a line.

use std::collections::BTreeMap;

use crate::math::Vec3;
use crate::motion::read::number::{number, shortened};
use crate::motion::read::samples::{SAME_PEAK, Samples, Unit, checked_step};
use crate::motion::read::{Lines, unit};
use crate::motion::{BadRecord, Motion};

/// What DATA_TYPE may say: of ESM the last word alone, of ITACA both.
const ACCELERATIONS: [&str; 3] = ["ACCELERATION", "PROCESSED ACCELERATION", "UNPROCESSED ACCELERATION"];

/// Whether a line belongs to such a file alone.
pub(super) fn is_mark(line: &str) -> bool {
    ["EVENT_NAME:", "SAMPLING_INTERVAL_S:", "NDATA:", "HEADER_FORMAT:"]
        .iter()
        .any(|key| line.starts_with(key))
}

/// Keys of a header with their lines and values.
type Header<'a> = BTreeMap<&'a str, (usize, &'a str)>;

/// A record along x, or along z of a vertical stream, from the lines of a file.
pub(super) fn read(name: &str, lines: Lines) -> Result<Motion, BadRecord> {
    let is_header = |(_, line): &&(usize, &str)| line.is_empty() || line.contains(':');
    let end = lines.iter().take_while(is_header).count();
    let pairs = lines[..end].iter().filter_map(|(number, line)| {
        let (key, value) = line.split_once(':')?;
        Some((key.trim(), (*number, value.trim())))
    });
    let header: Header = pairs.collect();
    let kind = stated(&header, "DATA_TYPE").unwrap_or((0, "ACCELERATION"));
    if !ACCELERATIONS.contains(&kind.1.to_ascii_uppercase().as_str()) {
        let found = format!("DATA_TYPE is {:?}", shortened(kind.1));
        let allowed = "ACCELERATION, PROCESSED ACCELERATION or UNPROCESSED ACCELERATION";
        return Err(BadRecord::at(kind.0, found, allowed, "give the file of accelerations"));
    }
    let unit = unit_of(&header)?;
    let (line, step) = numeric(&header, "SAMPLING_INTERVAL_S")?.ok_or_else(|| {
        let found = "SAMPLING_INTERVAL_S is missing";
        BadRecord::at(0, found, "a line \"SAMPLING_INTERVAL_S: 0.005\"", "add it to the header")
    })?;
    let step = checked_step(step, line)?;
    let mut samples = Samples::default();
    for (line, text) in lines[end..].iter().filter(|(_, text)| !text.is_empty()) {
        let value = number(text).map_err(|found| {
            BadRecord::at(
                *line,
                found,
                "one value a line, after the header",
                "remove or mend what is no value",
            )
        })?;
        samples.push(value, *line)?;
    }
    if let Some((line, count)) = numeric(&header, "NDATA")?
        && count != samples.len() as f64
    {
        let found = format!("NDATA states {count} values, and there are {}", samples.len());
        return Err(BadRecord::at(line, found, "as many as stated", "get the whole file"));
    }
    let peak = samples.peak();
    let said = numeric(&header, "PGA_CM/S^2")?.filter(|_| unit == Unit::CentimetrePerSquareSecond);
    let is_said = said.is_some_and(|(_, said)| (said.abs() - peak).abs() <= SAME_PEAK * peak);
    // A weak record is none of another unit if the header states its peak.
    if let Some(fault) = samples.weakness(unit).filter(|_| !is_said || peak == 0.0) {
        return Err(fault);
    }
    let (record, mut notes) = samples.record(step, unit)?;
    if let Some((_, said)) = said.filter(|_| !is_said) {
        notes.push(format!("the header states a peak of {said} cm/s^2, and that of the values is {peak}"));
    }
    let motion = Motion::of_record(name, record).noted(notes);
    let vertical = stated(&header, "STREAM").is_some_and(|(_, stream)| stream.ends_with(['Z', 'z']));
    Ok(if vertical { motion.along(&Vec3::z()).expect("one component and a direction") } else { motion })
}

/// Line and value of a key that is not left empty.
fn stated<'a>(header: &Header<'a>, key: &str) -> Option<(usize, &'a str)> {
    header.get(key).copied().filter(|(_, value)| !value.is_empty())
}

/// Line and number of a key; `None` where nothing is stated.
fn numeric(header: &Header, key: &str) -> Result<Option<(usize, f64)>, BadRecord> {
    let Some((line, value)) = stated(header, key) else { return Ok(None) };
    let value = number(value).map_err(|found| {
        BadRecord::at(line, format!("{key}: {found}"), "a number", format!("correct {key}"))
    })?;
    Ok(Some((line, value)))
}

fn unit_of(header: &Header) -> Result<Unit, BadRecord> {
    let stated = stated(header, "UNITS");
    if let Some(unit) = stated.and_then(|(_, word)| unit::named(word)) {
        return Ok(unit);
    }
    let (line, found) = match stated {
        Some((line, other)) => (line, format!("UNITS is {:?}", shortened(other))),
        None => (0, "UNITS is missing".to_owned()),
    };
    Err(BadRecord::at(line, found, "cm/s^2, m/s^2 or g", "state the unit of the values"))
}
