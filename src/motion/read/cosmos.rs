//! V2 files of strong motion: COSMOS V1.20 (CESMD, PRISM) and CSMIP. Text, integers and reals in a header, one line that says of what
//! and how many the values are, then the values.

use crate::math::Vec3;
use crate::motion::read::number::{number, shortened, values};
use crate::motion::read::samples::{Samples, Unit, checked_step};
use crate::motion::read::{Lines, unit};
use crate::motion::{BadRecord, Motion};

/// What begins the block of the values of COSMOS and of CSMIP (in capitals).
const COSMOS: &str = "ACCELERATION PTS";
const CSMIP: &str = "POINTS OF ACCEL DATA EQUALLY SPACED AT";
/// Blocks of a file that has no accelerations.
const OTHERS: [&str; 4] =
    ["VELOCITY PTS", "DISPLACEMENT PTS", "POINTS OF VELOC DATA", "POINTS OF DISPL DATA"];
/// What announces the real numbers of a COSMOS header; the 34th is the step (s).
const REALS: &str = "REAL-HEADER VALUES FOLLOW";
const STEP: usize = 34;
/// The 54th of its integers is where the channel points: 400 up, 401 down.
const INTEGERS: &str = "INTEGER-HEADER VALUES FOLLOW";
const AZIMUTH: usize = 54;

/// Whether a line belongs to such a file alone.
pub(super) fn is_mark(line: &str) -> bool {
    let line = line.to_ascii_uppercase();
    let has = |marks: &[&str]| marks.iter().any(|mark| line.contains(mark));
    line.contains("(FORMAT V") || has(&[COSMOS, CSMIP, REALS]) || has(&OTHERS)
}

/// The line that says how many values follow.
struct Block {
    /// Place in the lines.
    place: usize,
    line: usize,
    count: usize,
    step: f64,
    unit: Unit,
}

/// A record along x, or along z of a vertical channel, from the lines of a file.
pub(super) fn read(name: &str, lines: Lines) -> Result<Motion, BadRecord> {
    let block = block(lines)?;
    let mut samples = Samples::default();
    let mut rows = lines[block.place + 1..].iter().filter(|(_, text)| !text.is_empty());
    while samples.len() < block.count
        && let Some((line, text)) = rows.next()
    {
        let found = values(text).map_err(|found| {
            let found = format!("after {} of {} values, {found}", samples.len(), block.count);
            BadRecord::at(*line, found, "values alone, once they have begun", "get the whole file")
        })?;
        found.into_iter().try_for_each(|value| samples.push(value, *line))?;
    }
    if samples.len() != block.count {
        let found = format!("the line states {} values, and there are {}", block.count, samples.len());
        return Err(BadRecord::at(block.line, found, "as many as stated", "get the whole file"));
    }
    // Velocities and displacements of the same channel may follow.
    if let Some((line, _)) = rows.find(|(_, text)| begins(text)) {
        let found = "a second channel begins in the same file";
        return Err(BadRecord::at(*line, found, "one channel a file", "cut the file into one per channel"));
    }
    if let Some(fault) = samples.weakness(block.unit) {
        return Err(fault);
    }
    let (record, notes) = samples.record(block.step, block.unit)?;
    let motion = Motion::of_record(name, record).noted(notes);
    Ok(match vertical(&lines[..block.place]) {
        None => motion,
        Some(way) => motion.along(&(Vec3::z() * way)).expect("one component and a direction"),
    })
}

/// Whether a line begins a block of accelerations.
fn begins(text: &str) -> bool {
    let text = text.to_ascii_uppercase();
    [COSMOS, CSMIP].iter().any(|mark| text.contains(mark))
}

fn block(lines: Lines) -> Result<Block, BadRecord> {
    let Some(place) = lines.iter().position(|(_, text)| begins(text)) else {
        let is_other = |text: &str| OTHERS.iter().any(|mark| text.to_ascii_uppercase().contains(mark));
        let found = lines.iter().find(|(_, text)| is_other(text));
        let said = match found {
            Some((_, text)) => format!("this V2 file says {:?}", shortened(text)),
            None => "this is a COSMOS file without accelerations".to_owned(),
        };
        let allowed = "a line \"4000 acceleration pts, ..., units=cm/sec2 (04)\"";
        let fix = "give the V2 file of accelerations";
        return Err(BadRecord::at(found.map_or(0, |(line, _)| *line), said, allowed, fix));
    };
    let (line, text) = lines[place];
    let upper = text.to_ascii_uppercase();
    let refused = |what: &str| {
        let found = format!("{what} is not to be read in {:?}", shortened(text));
        let fix = "correct the line, or convert the record to CSV with its step and unit in the header";
        BadRecord::at(line, found, "a line of COSMOS or CSMIP V2", fix)
    };
    let count = upper.split_whitespace().next().and_then(|word| word.parse::<usize>().ok());
    let count = count.filter(|count| *count > 0).ok_or_else(|| refused("the number of values"))?;
    let (unit, step) = match upper.split_once(CSMIP) {
        Some((_, rest)) => {
            let unit = rest.split_once(" IN ").map(|(_, rest)| rest);
            (unit, rest.split_whitespace().next().and_then(|word| number(word).ok()))
        }
        None => (upper.split_once("UNITS=").map(|(_, rest)| rest), Some(step_of_reals(lines, place)?)),
    };
    let unit = unit.and_then(|rest| unit::named(rest.split([' ', ',', '(']).find(|word| !word.is_empty())?));
    let unit = unit.ok_or_else(|| refused("the unit"))?;
    let step = checked_step(step.ok_or_else(|| refused("the step"))?, line)?;
    Ok(Block { place, line, count, step, unit })
}

/// The step (s) in the header of COSMOS, of which the line of the values says a rounded duration only.
fn step_of_reals(lines: Lines, place: usize) -> Result<f64, BadRecord> {
    let missing = |line: usize, found: &str| {
        let allowed =
            "a header \"100 Real-header values follow on 20 lines\" whose 34th value is the step (s)";
        let fix = "get the whole file; or write the values to CSV, below the lines \"# dt_s = 0.01\" and \"a_cm_per_s2\"";
        BadRecord::at(line, format!("this is a COSMOS V2 file, and {found}"), allowed, fix)
    };
    let Some((line, reals)) = header(&lines[..place], REALS) else {
        return Err(missing(
            lines[place].0,
            "its header of real numbers is missing, so that the step is not known",
        ));
    };
    reals
        .get(STEP - 1)
        .copied()
        .filter(|step| *step > 0.0)
        .ok_or_else(|| missing(line, "its header of real numbers does not state the step"))
}

/// Line and numbers of the part of the header that such a line announces.
fn header(lines: Lines, announced: &str) -> Option<(usize, Vec<f64>)> {
    let at = lines.iter().position(|(_, text)| text.to_ascii_uppercase().contains(announced))?;
    let rows = lines[at + 1..].iter().map_while(|(_, text)| values(text).ok());
    Some((lines[at].0, rows.flatten().collect()))
}

/// Along z, and its sign, where the header says that the channel is vertical.
fn vertical(head: Lines) -> Option<f64> {
    let stated = header(head, INTEGERS).and_then(|(_, integers)| integers.get(AZIMUTH - 1).copied());
    // CSMIP writes it behind the number of the channel: "Chan  2: Up".
    let is_up = |text: &str| {
        let text = text.to_ascii_uppercase();
        text.starts_with("CH")
            && text.split_once(':').is_some_and(|(_, rest)| rest.split_whitespace().next() == Some("UP"))
    };
    match stated {
        Some(400.0) => Some(1.0),
        Some(401.0) => Some(-1.0),
        Some(_) => None,
        None => head.iter().any(|(_, text)| is_up(text)).then_some(1.0),
    }
}
