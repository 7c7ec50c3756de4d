//! Values of one component as they come from a file, and whether they can be the acceleration of a ground.

use crate::math::STANDARD_GRAVITY;
use crate::motion::{Accelerogram, BadRecord};

/// Most values of one component.
const MOST_VALUES: usize = 2_000_000;
/// Fewest: two steps.
const FEWEST_VALUES: usize = 3;
/// Largest peak (g). The largest ever recorded are below 4 g.
const LARGEST_PEAK: f64 = 5.0;
/// Smallest peak (g). No wall feels it, and nearly every record of g that is taken for cm/s^2 lies below.
const SMALLEST_PEAK: f64 = 5e-4;
/// Steps (s) that an accelerograph has.
const STEPS: [f64; 2] = [1e-5, 0.1];
/// Share of the peak velocity that the base may keep before it is noted.
const DRIFT: f64 = 0.1;

/// Largest difference between the peak that a header states and that of the values, as a share, up to which they agree.
pub(super) const SAME_PEAK: f64 = 0.01;

/// Units of acceleration in which records come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Gravity,
    CentimetrePerSquareSecond,
    MetrePerSquareSecond,
}

impl Unit {
    /// How many m/s^2 it is.
    fn size(self) -> f64 {
        match self {
            Unit::Gravity => STANDARD_GRAVITY,
            Unit::CentimetrePerSquareSecond => 0.01,
            Unit::MetrePerSquareSecond => 1.0,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Unit::Gravity => "g",
            Unit::CentimetrePerSquareSecond => "cm/s^2",
            Unit::MetrePerSquareSecond => "m/s^2",
        }
    }
}

/// The values of a component, in the unit of the file.
#[derive(Default)]
pub(super) struct Samples {
    values: Vec<f64>,
    /// Largest size, and its line.
    peak: f64,
    peak_line: usize,
}

impl Samples {
    pub(super) fn push(&mut self, value: f64, line: usize) -> Result<(), BadRecord> {
        if self.values.len() == MOST_VALUES {
            let (found, allowed) = ("there are more values than are read", format!("at most {MOST_VALUES}"));
            return Err(BadRecord::at(line, found, allowed, "cut the record to its shaking"));
        }
        if value.abs() > self.peak {
            (self.peak, self.peak_line) = (value.abs(), line);
        }
        self.values.push(value);
        Ok(())
    }

    pub(super) fn len(&self) -> usize {
        self.values.len()
    }

    /// Largest size of a value, in the unit of the file.
    pub(super) fn peak(&self) -> f64 {
        self.peak
    }

    /// Why it moves nothing, if it is so weak; a component may be, beside another one.
    pub(super) fn weakness(&self, unit: Unit) -> Option<BadRecord> {
        let peak = self.peak_in_g(unit);
        if self.peak == 0.0 {
            return Some(BadRecord::at(0, "all values are 0", "a record that moves", "give another record"));
        }
        let found = format!("the peak is {} {}, which is {peak:.2e} g", self.peak, unit.name());
        let fix = "state the unit that the values have, or scale up a record that is so weak";
        let allowed = format!("at least {SMALLEST_PEAK} g");
        (peak < SMALLEST_PEAK).then(|| BadRecord::at(self.peak_line, found, allowed, fix))
    }

    fn peak_in_g(&self, unit: Unit) -> f64 {
        self.peak * unit.size() / STANDARD_GRAVITY
    }

    /// The record in m/s^2, and what is to be noted about it.
    pub(super) fn record(self, step: f64, unit: Unit) -> Result<(Accelerogram, Vec<String>), BadRecord> {
        if self.values.len() < FEWEST_VALUES {
            let found = format!("the record has {} values", self.values.len());
            return Err(BadRecord::at(
                0,
                found,
                format!("at least {FEWEST_VALUES}"),
                "give the whole record",
            ));
        }
        let peak = self.peak_in_g(unit);
        if peak > LARGEST_PEAK {
            let found = format!("the peak is {} {}, which is {peak:.3} g", self.peak, unit.name());
            let allowed = format!("at most {LARGEST_PEAK} g");
            return Err(BadRecord::at(self.peak_line, found, allowed, "state the unit that the values have"));
        }
        // Divided where that rounds once: 100 cm are 1 m to the bit.
        let in_si = |value: &f64| match unit {
            Unit::CentimetrePerSquareSecond => value / 100.0,
            _ => value * unit.size(),
        };
        let record = Accelerogram::new(step, self.values.iter().map(in_si).collect())
            .expect("enough finite values at a checked step");
        let notes = drift(&record).into_iter().collect();
        Ok((record, notes))
    }
}

/// Whether the zero line is off so far that the base runs away.
fn drift(record: &Accelerogram) -> Option<String> {
    let end = *record.velocities().last()?;
    let pgv = record.velocities().iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
    (end.abs() > DRIFT * pgv).then(|| {
        let mean = end / record.duration();
        format!("the zero line is off or the record is cut: the base ends at {end:.3} m/s (mean acceleration {mean:.2e} m/s^2)")
    })
}

/// Accepts a step between samples (s) that is stated at a line.
pub(super) fn checked_step(step: f64, line: usize) -> Result<f64, BadRecord> {
    if (STEPS[0]..=STEPS[1]).contains(&step) {
        return Ok(step);
    }
    let allowed = format!("{} to {} s", STEPS[0], STEPS[1]);
    Err(BadRecord::at(
        line,
        format!("the step is {step} s"),
        allowed,
        "state the time between samples in seconds",
    ))
}
