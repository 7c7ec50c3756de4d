//! Displacements read after the platform has gone back to the level.

use crate::study::measured::measurement::Measurement;

/// A platform within this of 0 deg is level (rad).
const LEVEL: f64 = 1e-9;

/// Names what they are what was read at 0 deg after an earlier stage of the specimen: remainders, at the largest tilt before.
pub fn name_remainders(rows: &mut [Measurement]) {
    let turns: Vec<f64> = rows
        .iter()
        .map(|m| {
            let earlier = rows.iter().filter(|other| other.specimen == m.specimen && other.stage < m.stage);
            earlier.filter_map(|other| other.tilt).fold(0.0, f64::max)
        })
        .collect();
    for (m, turn) in rows.iter_mut().zip(turns) {
        let is_level = m.tilt.is_some_and(|tilt| tilt.abs() < LEVEL);
        if let (true, Some(remainder)) = (is_level && turn > LEVEL, m.quantity.remainder()) {
            (m.quantity, m.tilt) = (remainder, Some(turn));
        }
    }
}
