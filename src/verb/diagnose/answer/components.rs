//! What the base model misses where no cause explains it.

use crate::critic::{Component, ComponentEstimate};
use crate::render::number::with_interval;
use crate::study::Study;
use crate::verb::diagnose::answer::words::place;
use crate::verb::run::answer::measured::{in_unit, tidy_degrees, tidy_percent, unit};

/// A discrepancy is reported where it is larger than so many of its standard deviations.
const SURE: f64 = 2.0;

/// A component of the discrepancy at a tilt, or from test to test.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ComponentEntry {
    /// What it is: `level` of the readings as they are, `twist` of the left end less the right one, `bow` of the centre less the
    /// mean of the ends, `drift` of a reading from each test to the next, which all readings of a kind share by their standard
    /// deviations.
    pub part: &'static str,
    /// The arm.
    pub family: String,
    /// What was measured; of a twist that of the left end, of a bow that of the centre.
    pub quantity: &'static str,
    /// At which tilt; null where the quantity has none of its own.
    pub tilt_deg: Option<f64>,
    /// At which drift; left out where the quantity has none of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift_percent: Option<f64>,
    /// Unit of the numbers.
    pub unit: &'static str,
    /// Measured less base model.
    pub value: f64,
    /// 95 % interval.
    pub interval: [f64; 2],
}

impl ComponentEntry {
    /// From a discrepancy; `None` where it may be nothing.
    pub fn of(study: &Study, estimate: &ComponentEstimate) -> Option<ComponentEntry> {
        let in_units = |x: f64| in_unit(estimate.quantity, x);
        let reach = SURE * estimate.sd;
        (estimate.value.abs() > reach && estimate.value != 0.0).then(|| ComponentEntry {
            part: match estimate.part {
                Component::Level => "level",
                Component::Twist => "twist",
                Component::Bow => "bow",
                Component::Drift => "drift",
            },
            family: study.arms[estimate.family].name.clone(),
            quantity: estimate.quantity.name(),
            tilt_deg: estimate.tilt.map(tidy_degrees),
            drift_percent: estimate.drift.map(tidy_percent),
            unit: unit(estimate.quantity),
            value: in_units(estimate.value),
            interval: [in_units(estimate.value - reach), in_units(estimate.value + reach)],
        })
    }

    /// In words.
    pub fn sentence(&self) -> String {
        let (scale, unit) = match (self.unit, self.drift_percent) {
            ("m", _) => (1e3, "mm"),
            ("N", Some(_)) => (1e-3, "kN"),
            (unit, _) => (1.0, unit),
        };
        let place = place(self.quantity, self.tilt_deg, self.drift_percent);
        let value = with_interval(Some(scale * self.value), Some(self.interval.map(|x| scale * x)), 2);
        let quantity = match (self.part, self.quantity) {
            ("twist", _) => "left end less right end".to_owned(),
            ("bow", _) => "centre less mean of the ends".to_owned(),
            (_, quantity) => quantity.replace('_', " "),
        };
        let by = if self.part == "drift" { ", from each test to the next" } else { "" };
        format!("{}: {quantity}{place}{by}: {value} {unit}", self.family)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_what_is_lacking_where() {
        let line = |part, quantity| {
            let (family, unit, interval) = ("SBL".to_owned(), "m", [1e-3, 3e-3]);
            let (tilt_deg, drift_percent) = (Some(10.0), None);
            ComponentEntry { part, family, quantity, tilt_deg, drift_percent, unit, value: 2e-3, interval }
                .sentence()
        };
        let all = [
            ("level", "displacement_left"),
            ("twist", "displacement_left"),
            ("bow", "remainder_centre"),
            ("drift", "displacement_left"),
        ];
        let wanted = [
            "displacement left at 10 deg",
            "left end less right end at 10 deg",
            "centre less mean of the ends after 10 deg",
            "displacement left at 10 deg, from each test to the next",
        ];
        let wanted = wanted.map(|what| format!("SBL: {what}: 2.0 [1.0, 3.0] mm"));
        assert_eq!(all.map(|(part, quantity)| line(part, quantity)), wanted);
    }
}
