//! What is known of a number that is not known exactly, as a command line spells it: `30..38`, `normal(34, 2)`.

use super::{BadFamily, Family};
use crate::math::{exp, ln, ln_1p};

/// The families that can be spelled, with their parameters in this order.
const SPELLED: [(&str, &[&str]); 6] = [
    ("uniform", &["low", "high"]),
    ("triangular", &["low", "mode", "high"]),
    ("normal", &["mean", "sd"]),
    ("lognormal", &["mean", "sd"]),
    ("truncated_normal", &["mean", "sd", "low", "high"]),
    ("truncated_lognormal", &["median", "log_sd", "low", "high"]),
];
/// A lognormal variable has no value at 0: it is cut there at this share of the upper bound.
const NEXT_TO_0: f64 = 1e-12;
/// The ends of what has no bounds of its own, as probabilities.
const ENDS: [f64; 2] = [0.05, 0.95];

/// How the values of a range `LOW..HIGH` lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Each as likely as any other.
    Linear,
    /// Each power of ten as likely as any other, for what is known to its order of magnitude.
    Logarithmic,
}

/// The distribution of a number that is not known exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    /// Of the number, or of its logarithm.
    family: Family,
    /// Whether it is of the logarithm.
    is_log: bool,
}

impl Spread {
    /// Reads a range or a family with its parameters. Values must lie within two bounds: a normal or lognormal variable, which has no
    /// bounds, is cut there; all others must have none beyond.
    ///
    /// ```
    /// use pirca::random::{Scale, Spread};
    /// let kn = Spread::spelled("1e7..1e9", [1e3, 1e16], Scale::Logarithmic).unwrap();
    /// assert!((kn.middle() / 1e8 - 1.0).abs() < 1e-12);
    /// assert!(Spread::spelled("normal(34, -2)", [0.0, 89.0], Scale::Linear).is_err());
    /// ```
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn spelled(text: &str, within: [f64; 2], scale: Scale) -> Result<Spread, String> {
        let text = text.trim();
        let (family, is_range) = match text.split_once("..") {
            Some((low, high)) => {
                let [low, high] = [number(low)?, number(high)?];
                (Family::Uniform { low, high }, true)
            }
            None => (family(text)?, false),
        };
        let family = cut(checked(family)?, within)?;
        match family {
            Family::Uniform { low, high } if is_range && scale == Scale::Logarithmic => Ok(Spread {
                family: checked(Family::Uniform { low: ln(low), high: ln(high) })?,
                is_log: true,
            }),
            _ => Ok(Spread { family, is_log: false }),
        }
    }

    /// Inverse CDF, for `u` in the open interval (0, 1).
    pub fn quantile(&self, u: f64) -> f64 {
        self.value(self.family.quantile(u))
    }

    /// The median.
    pub fn middle(&self) -> f64 {
        self.quantile(0.5)
    }

    /// The bounds of what is spread evenly between them; the 5 and 95 % points of everything else.
    pub fn ends(&self) -> [f64; 2] {
        match self.family {
            Family::Uniform { low, high } => [low, high].map(|end| self.value(end)),
            _ => ENDS.map(|p| self.quantile(p)),
        }
    }

    /// The distribution, of the logarithm where [`Spread::is_log`].
    pub fn family(&self) -> &Family {
        &self.family
    }

    /// Whether values are spread evenly in their logarithm.
    pub fn is_log(&self) -> bool {
        self.is_log
    }

    fn value(&self, drawn: f64) -> f64 {
        if self.is_log { exp(drawn) } else { drawn }
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| format!("\"{}\" is no number", text.trim()))
}

/// A family with its parameters.
fn family(text: &str) -> Result<Family, String> {
    let spelled = text.strip_suffix(')').and_then(|inner| inner.split_once('('));
    let (name, inner) = spelled.ok_or("no number, no range, and no distribution")?;
    let name = name.trim();
    let Some((_, parameters)) = SPELLED.iter().find(|(known, _)| *known == name) else {
        let known: Vec<&str> = SPELLED.iter().map(|(known, _)| *known).collect();
        return Err(format!("no distribution \"{name}\"; there are {}", known.join(", ")));
    };
    let numbers = inner.split(',').map(number).collect::<Result<Vec<f64>, String>>()?;
    match (name, &numbers[..]) {
        ("uniform", &[low, high]) => Ok(Family::Uniform { low, high }),
        ("triangular", &[low, mode, high]) => Ok(Family::Triangular { low, mode, high }),
        ("normal", &[mean, sd]) => Ok(Family::Normal { mean, sd }),
        ("lognormal", &[mean, sd]) => Ok(Family::Lognormal { mean, sd }),
        ("truncated_normal", &[mean, sd, low, high]) => Ok(Family::TruncatedNormal { mean, sd, low, high }),
        ("truncated_lognormal", &[median, log_sd, low, high]) => {
            Ok(Family::TruncatedLognormal { median, log_sd, low, high })
        }
        _ => Err(format!("write {name}({})", parameters.join(", "))),
    }
}

fn checked(family: Family) -> Result<Family, String> {
    let said = |faults: Vec<BadFamily>| faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    family.checked().map_err(said)
}

/// A sound family within two bounds.
fn cut(family: Family, [low, high]: [f64; 2]) -> Result<Family, String> {
    let is_inside = |x: f64| (low..=high).contains(&x);
    let [first, last] = match family {
        Family::Normal { .. } | Family::Lognormal { .. } => [family.quantile(0.5); 2],
        _ => family.support().into(),
    };
    if !(is_inside(first) && is_inside(last)) {
        return Err(match first == last {
            true => format!("its middle is {first}"),
            false => format!("its values run from {first} to {last}"),
        });
    }
    match family {
        Family::Normal { mean, sd } => checked(Family::TruncatedNormal { mean, sd, low, high }),
        Family::Lognormal { mean, sd } => {
            let variance = ln_1p((sd / mean) * (sd / mean));
            let (median, log_sd) = (mean * exp(-0.5 * variance), variance.sqrt());
            let low = low.max(NEXT_TO_0 * high);
            checked(Family::TruncatedLognormal { median, log_sd, low, high })
        }
        _ => Ok(family),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PHI: [f64; 2] = [0.0, 89.0];

    fn spelled(text: &str) -> Result<Spread, String> {
        Spread::spelled(text, PHI, Scale::Linear)
    }

    #[test]
    fn a_range_is_even_in_the_number_or_in_its_logarithm() {
        let phi = spelled(" 30 .. 38 ").unwrap();
        assert_eq!((phi.ends(), phi.middle(), phi.quantile(0.25)), ([30.0, 38.0], 34.0, 32.0));
        let kn = Spread::spelled("1e6..1e10", [1e3, 1e16], Scale::Logarithmic).unwrap();
        assert!(kn.is_log() && (kn.quantile(0.25) / 1e7 - 1.0).abs() < 1e-12);
        assert!((kn.ends()[1] / 1e10 - 1.0).abs() < 1e-12);
        // A family that is named is what it says.
        let named = Spread::spelled("uniform(1e6, 1e10)", [1e3, 1e16], Scale::Logarithmic).unwrap();
        assert_eq!(named.middle(), 0.5 * (1e6 + 1e10));
    }

    #[test]
    fn what_has_no_bounds_is_cut_at_those_of_the_number_and_keeps_its_shape() {
        let phi = spelled("normal(34, 2)").unwrap();
        let [low, high] = phi.ends();
        assert!((phi.middle() - 34.0).abs() < 1e-9);
        assert!((low - (34.0 - 2.0 * 1.644_853_627)).abs() < 1e-6 && (high - 34.0 + low - 34.0).abs() < 1e-6);
        assert!(spelled("normal(2, 4)").unwrap().quantile(1e-9) >= 0.0);
        // The median of a lognormal variable is its mean over sqrt(1 + cov^2).
        let kn = Spread::spelled("lognormal(1e8, 3e7)", [1e3, 1e16], Scale::Logarithmic).unwrap();
        assert!((kn.middle() / (1e8 / 1.09_f64.sqrt()) - 1.0).abs() < 1e-9);
        assert!(spelled("lognormal(30, 3)").is_ok());
    }

    #[test]
    fn what_makes_no_distribution_is_refused_with_what_is_wrong() {
        for (text, said) in [
            ("38..30", "high = 30: must be above low"),
            ("30..", "\"\" is no number"),
            ("30..95", "its values run from 30 to 95"),
            ("nan..40", "low = NaN"),
            ("normal(34, -2)", "sd = -2: must be between"),
            ("normal(95, 2)", "its middle is 95"),
            ("normal(34)", "write normal(mean, sd)"),
            ("normal(34, 2", "no distribution"),
            ("gauss(34, 2)", "there are uniform, triangular, normal"),
            ("triangular(30, 50, 40)", "mode = 50: must lie between"),
            ("thirty", "no number"),
        ] {
            let found = spelled(text).unwrap_err();
            assert!(found.contains(said), "{text}: {found}");
        }
    }
}
