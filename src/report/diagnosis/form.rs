//! What the base model lacks where no cause explains it.

use crate::critic::{Bent, Lacking};
use crate::report::diagnosis::words::at;
use crate::report::measured::{in_unit, tidy_degrees, unit};
use crate::report::number::significant;
use crate::study::Study;

/// A discrepancy is told where it is larger than so many of its standard deviations.
const SURE: f64 = 2.0;

/// What is lacking at a tilt, or from test to test.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct BentEntry {
    /// What it is: `level` of the readings as they are, `twist` of the left end less the right one, `bow` of the centre less the
    /// mean of the ends, `drift` from each test to the next.
    pub part: &'static str,
    /// The arm; null where all share it.
    pub family: Option<String>,
    /// What was measured; of a twist that of the left end, of a bow that of the centre, of a drift the first quantity of its kind.
    pub quantity: &'static str,
    /// At which tilt; null where the quantity has none of its own.
    pub tilt_deg: Option<f64>,
    /// Unit of the numbers.
    pub unit: &'static str,
    /// Measured less base model.
    pub value: f64,
    /// 95 % interval.
    pub interval: [f64; 2],
}

impl BentEntry {
    /// From a discrepancy; `None` where it may be nothing.
    pub fn of(study: &Study, bent: &Bent) -> Option<BentEntry> {
        let told = |x: f64| in_unit(bent.quantity, x);
        let reach = SURE * bent.sd;
        (bent.value.abs() > reach && bent.value != 0.0).then(|| BentEntry {
            part: match bent.part {
                Lacking::Level => "level",
                Lacking::Twist => "twist",
                Lacking::Bow => "bow",
                Lacking::Drift => "drift",
            },
            family: bent.family.map(|family| study.arms[family].name.clone()),
            quantity: bent.quantity.name(),
            tilt_deg: bent.tilt.map(tidy_degrees),
            unit: unit(bent.quantity),
            value: told(bent.value),
            interval: [told(bent.value - reach), told(bent.value + reach)],
        })
    }

    /// In words.
    pub fn sentence(&self) -> String {
        let (scale, unit) = if self.unit == "m" { (1e3, "mm") } else { (1.0, self.unit) };
        let number = |x: f64| significant(scale * x, 2);
        let tilt =
            self.tilt_deg.map_or_else(String::new, |tilt| format!(" {} {tilt} deg", at(self.quantity)));
        let [low, high] = self.interval.map(number);
        let quantity = match (self.part, self.quantity) {
            ("twist", _) => "left end less right end".to_owned(),
            ("bow", _) => "centre less mean of the ends".to_owned(),
            ("drift", "collapse_angle") => "collapse angles from each test to the next".to_owned(),
            ("drift", quantity) if at(quantity) == "after" => {
                "what is left from each test to the next".to_owned()
            }
            ("drift", _) => "displacements from each test to the next".to_owned(),
            (_, quantity) => quantity.replace('_', " "),
        };
        let family = self.family.as_deref().unwrap_or("all families");
        format!("{family}: {quantity}{tilt}: {} [{low}, {high}] {unit}", number(self.value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drift_is_told_by_what_drifts() {
        let drift = |quantity| {
            let (part, unit, interval) = ("drift", "m", [1e-3, 3e-3]);
            BentEntry { part, family: None, quantity, tilt_deg: None, unit, value: 2e-3, interval }.sentence()
        };
        let all = ["displacement_left", "remainder_left"].map(drift);
        let told = ["displacements", "what is left"]
            .map(|what| format!("all families: {what} from each test to the next: 2.0 [1.0, 3.0] mm"));
        assert_eq!(all, told);
    }
}
