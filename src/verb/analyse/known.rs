//! Numbers that the user may know exactly or within a range.

use std::ops::RangeInclusive;

use crate::ensemble::{Scale, Spread};
use crate::verb::analyse::numbers;
use crate::verb::analyse::numbers::{DENSITIES, FRICTION_ANGLES, STIFFNESSES};

/// Friction angles (deg) where none is stated: the least and the most of distributions/joint/friction.toml, which are those of walls.
pub(crate) const USUAL_FRICTION: &str = "25..38";
/// Stiffnesses (Pa/m) where none is stated: the least and the most of distributions/joint/stiffness.toml.
pub(crate) const USUAL_STIFFNESS: &str = "5e7..1e9";

/// A number as the user knows it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Known {
    /// Exactly.
    Exactly(f64),
    /// As a range or a distribution.
    Within {
        /// As it was spelled.
        stated: String,
        /// What that means.
        spread: Spread,
    },
}

impl Known {
    /// The number, or the median.
    pub fn middle(&self) -> f64 {
        match self {
            Known::Exactly(x) => *x,
            Known::Within { spread, .. } => spread.middle(),
        }
    }

    /// The number, the low end of a range, or the 5 % point of a distribution.
    pub fn low(&self) -> f64 {
        match self {
            Known::Exactly(x) => *x,
            Known::Within { spread, .. } => spread.ends()[0],
        }
    }

    /// The range that is taken where nothing is stated, if it is one.
    pub fn usual(&self) -> Option<&str> {
        match self {
            Known::Within { stated, .. } => {
                Some(&stated[..]).filter(|own| [USUAL_FRICTION, USUAL_STIFFNESS].contains(own))
            }
            Known::Exactly(_) => None,
        }
    }

    /// As a page says it: the number, or the range and the value at which the wall is drawn.
    pub fn said(&self, number: impl Fn(f64) -> String) -> String {
        match self {
            Known::Exactly(x) => number(*x),
            Known::Within { stated, .. } => format!("{stated}; drawn at {}", number(self.middle())),
        }
    }
}

/// Friction angle (deg).
pub(crate) fn friction_angle(text: &str) -> Result<Known, String> {
    known(text, numbers::friction_angle, FRICTION_ANGLES, Scale::Linear)
}

/// Stiffness per joint area (Pa/m), which is known to its order of magnitude.
pub(crate) fn stiffness(text: &str) -> Result<Known, String> {
    known(text, numbers::stiffness, STIFFNESSES, Scale::Logarithmic)
}

/// Density (kg/m^3).
pub(crate) fn density(text: &str) -> Result<Known, String> {
    known(text, numbers::density, DENSITIES, Scale::Linear)
}

/// A number where the text is one, and otherwise a spread.
fn known(
    text: &str,
    exactly: fn(&str) -> Result<f64, String>,
    range: RangeInclusive<f64>,
    scale: Scale,
) -> Result<Known, String> {
    let refused = match exactly(text) {
        Ok(number) => return Ok(Known::Exactly(number)),
        Err(refused) => refused,
    };
    if text.parse::<f64>().is_ok() {
        return Err(refused);
    }
    match Spread::spelled(text, [*range.start(), *range.end()], scale) {
        Ok(spread) => Ok(Known::Within { stated: text.trim().to_owned(), spread }),
        Err(wrong) => {
            let allowed = refused.trim_start_matches("no number; ");
            Err(format!(
                "{wrong}; {allowed}, a range LOW..HIGH of such, or a distribution as normal(MEAN, SD)"
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_states_is_the_range_of_the_distributions() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let files = crate::study::load_distributions(&folder).unwrap();
        let ends = |name: &str| {
            let all = || files[name].entries.values().map(|own| own.family.support());
            let low = all().map(|(low, _)| low).fold(f64::MAX, f64::min);
            [low, all().map(|(_, high)| high).fold(0.0, f64::max)]
        };
        let usual = |known: Known| match known {
            Known::Within { spread, .. } => spread.ends(),
            Known::Exactly(x) => [x, x],
        };
        let close = |a: [f64; 2], b: [f64; 2]| a.iter().zip(b).all(|(a, b)| (a / b - 1.0).abs() < 1e-12);
        assert!(close(usual(friction_angle(USUAL_FRICTION).unwrap()), ends("joint/friction")));
        assert!(close(usual(stiffness(USUAL_STIFFNESS).unwrap()), ends("joint/stiffness")));
        assert_eq!(friction_angle(USUAL_FRICTION).unwrap().usual(), Some(USUAL_FRICTION));
        assert_eq!(friction_angle("30..38").unwrap().usual(), None);
    }

    #[test]
    fn a_number_stays_one_and_what_is_neither_is_told_what_is_allowed() {
        assert_eq!(friction_angle("30"), Ok(Known::Exactly(30.0)));
        assert_eq!(density("2000..2400").map(|known| known.middle()), Ok(2200.0));
        let kn = stiffness("1e7..1e9").map(|known| known.middle()).unwrap();
        assert!((kn / 1e8 - 1.0).abs() < 1e-12);
        for text in ["-5", "90", "nan", "inf", "30..95", "normal(34)", "thirty", ""] {
            let found = friction_angle(text).unwrap_err();
            assert!(found.contains("allowed is a number from 0 to 89 degrees"), "{text}: {found}");
        }
    }
}
