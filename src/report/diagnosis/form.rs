//! What the base model lacks where no cause explains it.

use crate::critic::Bent;
use crate::report::measured::{in_unit, tidy_degrees, unit};
use crate::report::number::significant;
use crate::study::Study;

/// A discrepancy is told where it is larger than so many of its standard deviations.
const SURE: f64 = 2.0;

/// What is lacking at a tilt.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct BentEntry {
    /// The arm.
    pub family: String,
    /// What was measured.
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
            family: study.arms[bent.family].name.clone(),
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
        let tilt = self.tilt_deg.map_or_else(String::new, |tilt| format!(" at {tilt} deg"));
        let [low, high] = self.interval.map(number);
        let quantity = self.quantity.replace('_', " ");
        format!("{}: {quantity}{tilt}: {} [{low}, {high}] {unit}", self.family, number(self.value))
    }
}
