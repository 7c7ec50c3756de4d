//! What the gauges of a campaign show at every quarter of a degree, and how readers write it down.

use std::fmt::Write as _;

use pirca::math::{degrees, radians};
use pirca::study::MeasuredQuantity;

use super::effect::{Effect, Specimen};
use super::walls::Way;

/// Tilts between two looks at the gauges (deg): all designs read at multiples of it.
const LOOKS_DEG: f64 = 0.25;

/// What is shown of a specimen until it falls.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The tilt shown when it fell (rad).
    pub collapse: f64,
    /// The displacements shown of the left end, the centre and the right end (m), at each multiple of a quarter degree from 0.
    pub points: Vec<[f64; 3]>,
}

impl Series {
    /// Of a wall, as platform and gauges show it.
    pub fn of(
        way: &Way,
        gauge: impl Fn(f64) -> f64,
        effects: &[Box<dyn Effect>],
        specimen: &Specimen,
    ) -> Series {
        let tilt = |shown: f64| effects.iter().rev().fold(shown, |tilt, effect| effect.tilt(tilt));
        let collapse = effects.iter().fold(way.collapse, |tilt, effect| effect.shown(tilt));
        let zero = way.displacements(tilt(0.0));
        let look = |number: usize| {
            let now = way.displacements(tilt(radians(number as f64 * LOOKS_DEG)));
            std::array::from_fn(|k| if number == 0 { 0.0 } else { gauge(now[k] - zero[k]) })
        };
        let mut series = Series { collapse, points: (0..looks(collapse)).map(look).collect() };
        effects.iter().for_each(|effect| effect.read(&mut series, specimen));
        series
    }

    /// The same specimen, had it fallen earlier.
    pub fn fall_at(&mut self, collapse: f64) {
        self.collapse = collapse;
        self.points.truncate(looks(collapse));
    }

    /// The tilt of a look (deg).
    pub fn tilt_deg(look: usize) -> f64 {
        look as f64 * LOOKS_DEG
    }

    /// The displacements shown at a tilt (deg); `None` where the wall has fallen.
    pub fn at(&self, tilt_deg: f64) -> Option<[f64; 3]> {
        self.points.get((tilt_deg / LOOKS_DEG).round() as usize).copied()
    }
}

/// Looks at a specimen until it falls.
fn looks(collapse: f64) -> usize {
    (degrees(collapse) / LOOKS_DEG).floor().max(0.0) as usize + 1
}

/// A row of measured.csv. Numbers are in its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub specimen: String,
    pub family: String,
    pub tilt_deg: Option<f64>,
    pub quantity: MeasuredQuantity,
    pub value: f64,
    pub unit: &'static str,
    pub error: f64,
    pub kind: &'static str,
    pub resolution: Option<f64>,
    pub order: Option<u32>,
}

/// The rows as a file.
pub fn csv(rows: &[Entry]) -> String {
    let mut text = "specimen,family,tilt_deg,quantity,value,unit,error,kind,resolution,order\n".to_owned();
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    for row in rows {
        let order = row.order.map_or_else(String::new, |order| order.to_string());
        writeln!(
            text,
            "{},{},{},{},{},{},{},{},{},{order}",
            row.specimen,
            row.family,
            number(row.tilt_deg),
            row.quantity.name(),
            row.value,
            row.unit,
            row.error,
            row.kind,
            number(row.resolution),
        )
        .expect("text can grow");
    }
    text
}
