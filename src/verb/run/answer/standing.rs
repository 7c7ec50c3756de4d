//! How one number stands against a statement at one kn, and how the numbers at all kn add up to a verdict.

use crate::render::number::{bracketed, range, significant, stiffness, with_interval};

/// One of our numbers at one kn (or one step of kn).
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Where: `kn = 7.5e7 Pa/m`.
    pub place: String,
    /// The number, if it is defined there.
    pub value: Option<f64>,
    /// Its 95 % interval.
    pub interval: Option<[f64; 2]>,
}

/// How a number stands against a statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Standing {
    /// As stated.
    Holds,
    /// It cannot be said, with the reason.
    Open(String),
    /// Against the statement beyond the sampling error, with the reason.
    Refuted(String),
}

impl Number {
    /// At one kn.
    pub fn at(kn: f64, value: Option<f64>, interval: Option<[f64; 2]>) -> Self {
        Number { place: format!("kn = {}", stiffness(kn)), value, interval }
    }

    /// Stands against the accepted range `[low, high]`.
    ///
    /// Holds when the value lies inside and has an interval; refuted when the interval lies wholly outside; open
    /// otherwise (value or interval missing, or value outside while its interval reaches into the range).
    pub fn within(&self, low: f64, high: f64) -> Standing {
        let accepted = format!("{} to {}", significant(low, 3), significant(high, 3));
        let (Some(value), Some([from, to])) = (self.value, self.interval) else {
            return Standing::Open(self.missing());
        };
        if low <= value && value <= high {
            Standing::Holds
        } else if to < low || from > high {
            Standing::Refuted(format!("{}, wholly outside {accepted}", self.words()))
        } else {
            Standing::Open(format!("{}: outside {accepted}, but its interval reaches into it", self.words()))
        }
    }

    /// Stands against "below one".
    ///
    /// Holds when the value is below one and has an interval; refuted when the interval does not reach below one.
    pub fn below_one(&self) -> Standing {
        let (Some(value), Some([from, _])) = (self.value, self.interval) else {
            return Standing::Open(self.missing());
        };
        if value < 1.0 {
            Standing::Holds
        } else if from >= 1.0 {
            Standing::Refuted(format!("{}, not below 1", self.words()))
        } else {
            Standing::Open(format!("{}: not below 1, but its interval reaches below", self.words()))
        }
    }

    fn words(&self) -> String {
        format!("at {} ours is {}", self.place, with_interval(self.value, self.interval, 3))
    }

    /// Why there is nothing to compare.
    pub fn missing(&self) -> String {
        match self.value {
            None => format!("at {} ours is not defined (too few standing walls)", self.place),
            Some(value) => {
                format!(
                    "at {} ours is {} without an interval (too few standing walls)",
                    self.place,
                    significant(value, 3)
                )
            }
        }
    }
}

/// Lowest to highest of our numbers, and what their intervals span.
pub fn spread(numbers: &[Number]) -> String {
    let Some([low, high]) = range(numbers.iter().filter_map(|number| number.value)) else {
        return "not defined".to_string();
    };
    let defined = numbers.iter().filter(|number| number.value.is_some()).count();
    let values = match defined {
        1 => significant(low, 3),
        _ if significant(low, 3) == significant(high, 3) => format!("{} throughout", significant(low, 3)),
        _ => format!("{} to {}", significant(low, 3), significant(high, 3)),
    };
    let spans = range(numbers.iter().filter_map(|number| number.interval).flatten());
    let intervals = match spans {
        None => "no interval".to_string(),
        Some(_) if numbers.iter().all(|number| number.interval.is_none_or(|[from, to]| from == to)) => {
            "no sampling error".to_string()
        }
        Some(ends) => format!("95 % intervals within {}", bracketed(ends, 3)),
    };
    match defined == numbers.len() {
        true => format!("{values} ({intervals})"),
        false => format!("{values} ({intervals}; defined in {defined} of {} comparisons)", numbers.len()),
    }
}
