//! Units of measured values, and the SI value of a number in them.

use crate::math::radians;

/// What a quantity is, as far as its units go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// m inside.
    Length,
    /// rad inside.
    Angle,
    /// Stress per displacement: Pa/m inside.
    Stiffness,
    /// N inside.
    Force,
    /// One of two words, and no number.
    Outcome,
}

impl Dimension {
    /// Units that may be written.
    pub fn units(self) -> &'static [&'static str] {
        match self {
            Dimension::Length => &["m", "cm", "mm"],
            Dimension::Angle => &["deg", "rad"],
            Dimension::Stiffness => &["Pa/m", "kPa/m", "MPa/m", "GPa/m", "N/mm3"],
            Dimension::Force => &["N", "kN"],
            Dimension::Outcome => &[],
        }
    }

    /// A number in one of [`Dimension::units`], in SI units. Divides where the unit is the smaller one, so that 19 mm and
    /// 1.9 cm are the same number as 0.019 m.
    pub fn si(self, number: f64, unit: &str) -> f64 {
        match unit {
            "cm" => number / 1e2,
            "mm" => number / 1e3,
            "deg" => radians(number),
            "kPa/m" | "kN" => number * 1e3,
            "MPa/m" => number * 1e6,
            "GPa/m" | "N/mm3" => number * 1e9,
            _ => {
                crate::check!(self.units().contains(&unit), "`{unit}` is no unit of {self:?}");
                number
            }
        }
    }
}
