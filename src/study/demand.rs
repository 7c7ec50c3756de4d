//! What a wall must bear, or how far it may move, as a person writes it: `0.15g`, `8.5deg`, `12kN`, `4mm`.

use std::str::FromStr;

use crate::math::radians;

/// What a wall must bear, or how far it may move.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand {
    /// As it was written.
    pub stated: String,
    /// How much.
    pub amount: Amount,
}

/// An amount by its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// A number without a unit: a multiple of the weight, or of the full load.
    Factor(f64),
    /// An acceleration as a multiple of gravity, which is a push of that multiple of the weight.
    Gravity(f64),
    /// An acceleration (m/s^2).
    Acceleration(f64),
    /// A tilt (rad).
    Tilt(f64),
    /// A displacement (m).
    Length(f64),
    /// A force (N).
    Force(f64),
    /// A velocity of the ground (m/s).
    Speed(f64),
}

/// What a number of a unit is.
type Of = fn(f64) -> Amount;

/// The units, each with the amount of one. A unit stands before those that its spelling ends with.
const UNITS: [(&str, Of); 13] = [
    ("deg", |x| Amount::Tilt(radians(x))),
    ("°", |x| Amount::Tilt(radians(x))),
    ("m/s2", Amount::Acceleration),
    ("m/s^2", Amount::Acceleration),
    ("cm/s", |x| Amount::Speed(1e-2 * x)),
    ("m/s", Amount::Speed),
    ("mm", |x| Amount::Length(1e-3 * x)),
    ("cm", |x| Amount::Length(1e-2 * x)),
    ("m", Amount::Length),
    ("kN", |x| Amount::Force(1e3 * x)),
    ("N", Amount::Force),
    ("%", |x| Amount::Factor(1e-2 * x)),
    ("g", Amount::Gravity),
];

impl FromStr for Demand {
    type Err = String;

    /// A number above 0 with its unit.
    fn from_str(text: &str) -> Result<Demand, String> {
        let stated = text.trim();
        let unit = UNITS.iter().find_map(|(unit, of)| Some((stated.strip_suffix(unit)?, *of)));
        let (number, of) = unit.unwrap_or((stated, Amount::Factor));
        let number = number.trim().parse().ok().filter(|x: &f64| *x > 0.0 && x.is_finite());
        let amount = number.map(of).ok_or_else(|| {
            "allowed is a number above 0 with its unit: 0.15g, 0.15 (of the weight), 8.5deg, 12kN, 4mm, 0.3m/s".to_owned()
        })?;
        match amount {
            Amount::Tilt(tilt) if tilt >= radians(90.0) => Err("allowed is a tilt below 90deg".to_owned()),
            amount => Ok(Demand { stated: stated.to_owned(), amount }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_are_read_with_their_units() {
        let amount = |text: &str| text.parse::<Demand>().map(|own| own.amount);
        assert_eq!(amount("0.15g"), Ok(Amount::Gravity(0.15)));
        assert_eq!(amount("0.15"), Ok(Amount::Factor(0.15)));
        assert_eq!(amount("15 %"), Ok(Amount::Factor(0.15)));
        assert_eq!(amount("30 deg"), Ok(Amount::Tilt(radians(30.0))));
        assert_eq!(amount("30°"), Ok(Amount::Tilt(radians(30.0))));
        assert_eq!(amount(" 4mm "), Ok(Amount::Length(4e-3)));
        assert_eq!(amount("0.4 cm"), Ok(Amount::Length(4e-3)));
        assert_eq!(amount("12kN"), Ok(Amount::Force(12e3)));
        assert_eq!(amount("12000N"), Ok(Amount::Force(12e3)));
        assert_eq!(amount("1.5m/s2"), Ok(Amount::Acceleration(1.5)));
        assert_eq!(amount("1.5m/s^2"), Ok(Amount::Acceleration(1.5)));
        assert_eq!(amount("0.3m/s"), Ok(Amount::Speed(0.3)));
        assert_eq!(amount("30cm/s"), Ok(Amount::Speed(0.3)));
        assert_eq!("0.15 g".parse::<Demand>().unwrap().stated, "0.15 g");
    }

    #[test]
    fn what_is_no_demand_is_refused_with_what_is_allowed() {
        for text in ["", "g", "-0.1g", "0", "nan", "inf", "0.1kg", "2 ft", "1e999g"] {
            assert!(text.parse::<Demand>().unwrap_err().contains("8.5deg"), "{text}");
        }
        assert!("90deg".parse::<Demand>().unwrap_err().contains("below 90deg"));
    }
}
