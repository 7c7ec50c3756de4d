//! Formats of records that are known by sight and not read: named, so that the user knows what to convert.

use crate::motion::BadRecord;
use crate::motion::read::{FORMATS, Lines};

/// The name of a format, and how its header is recognised, in capitals.
struct Foreign {
    name: &'static str,
    is: fn(&str) -> bool,
}

/// In the order in which they are asked: the last one is the most general.
const FOREIGN: [Foreign; 5] = [
    Foreign { name: "GeoNet V1A or V2A (New Zealand)", is: |line| line.contains("GNS SCIENCE") },
    Foreign { name: "AFAD ASCII (Turkey)", is: |line| line.contains("STRONG GROUND MOTION RECORDS OF TURK") },
    Foreign { name: "an ASCII file of SAC", is: |line| line.starts_with("-12345.00") },
    Foreign {
        name: "SMC (USGS)",
        is: |line| line.starts_with(|c: char| c.is_ascii_digit()) && line.contains("CORRECTED ACCELEROGRAM"),
    },
    Foreign { name: "CSMIP V1 or another V1 file", is: |line| line.starts_with("UNCORRECTED ACCELEROGRAM") },
];

/// Refuses a file whose first lines are of a format that is known and not read.
pub(super) fn refused(lines: Lines) -> Result<(), BadRecord> {
    let known = lines.iter().filter(|(_, text)| !text.is_empty()).take(2).find_map(|(line, text)| {
        let upper = text.to_ascii_uppercase();
        FOREIGN.iter().find(|foreign| (foreign.is)(&upper)).map(|foreign| (*line, foreign.name))
    });
    known.map_or(Ok(()), |(line, name)| {
        let fix = "convert it to CSV: a line \"# dt_s = 0.01\", the header a_cm_per_s2 (or a_g), then one value a line";
        Err(BadRecord::at(line, format!("this is {name}, which is not read"), FORMATS, fix))
    })
}
