//! Causes with their priors, as they are listed, and at one strength.

use std::collections::BTreeMap;

use crate::math::ln;
use crate::random::Family;
use crate::study::catalogue::{DistributionFile, read_distributions};
use crate::study::cause::CAUSES;
use crate::study::cause::entry::{Acts, Cause, InLimitAnalysis, Unloading};
use crate::study::distributions::Distributions;
use crate::study::schema::{Key, Kind, Presence};

/// The plain words of a mechanism, with its name behind them; the name alone of one that is not known.
pub fn in_plain_words(name: &str) -> String {
    Cause::named(name).map_or_else(|| name.to_owned(), |cause| format!("{} ({name})", cause.title))
}

/// Where a mechanism is the stronger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stronger {
    /// At large values of a parameter.
    Above,
    /// At small ones.
    Below,
    /// At both, as it has no effect in between.
    EitherWay,
}

/// A mechanism with all that is known of it.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Described {
    /// Its name: `[mechanism.<name>]` switches it on.
    pub name: &'static str,
    /// Its name in plain words.
    pub title: &'static str,
    /// What it is.
    pub what: &'static str,
    /// What would be true of the wall or of the test, with what looks the same and has no name of its own.
    pub means: &'static str,
    /// Where it acts.
    pub acts: Acts,
    /// What becomes of its effect when the wall is unloaded.
    pub unloading: Unloading,
    /// How limit analysis takes it.
    pub limit_analysis: InLimitAnalysis,
    /// What looks alike on a tilting table.
    pub confounded_with: &'static [&'static str],
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// What is said of it.
    #[serde(skip)]
    cause: &'static Cause,
}

/// A parameter of a mechanism.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Parameter {
    /// Its key.
    pub key: &'static str,
    /// Its unit; "1" for a plain number.
    pub unit: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// What it has where it is left out, written in TOML.
    pub default: Option<&'static str>,
    /// What it may be, before anything has been measured: the physical prior.
    pub prior: Family,
    /// Where a diagnosis looks for it: the same centre and four times the spread (of the logarithm where it is positive), cut only
    /// by physics. A cause that is stronger than anybody expected is found, and said to be.
    pub search: Family,
    /// measured, literature, calibrated or assumed.
    pub status: String,
    /// Paper and table, or who assumed it and why.
    pub source: String,
    /// What a user should know.
    pub note: Option<String>,
}

impl Described {
    /// Where it is the stronger, over a parameter.
    pub fn stronger(&self, key: &str) -> Stronger {
        let Cause { either_way, stronger_below, .. } = self.cause;
        match (either_way.contains(&key), stronger_below.contains(&key)) {
            (true, _) => Stronger::EitherWay,
            (false, true) => Stronger::Below,
            (false, false) => Stronger::Above,
        }
    }

    /// Whether it and another one can be on together.
    pub fn goes_with(&self, other: &str) -> bool {
        self.name != other && !self.cause.instead_of.contains(&other)
    }

    /// Its parameters at one strength, by key and in the key's unit: each at that quantile of its prior, counted from the end
    /// at which the mechanism is weak. Several parameters go together: their mechanism is rarer than one of them.
    pub fn at_strength(&self, quantile: f64) -> Vec<(&'static str, f64)> {
        let value = |p: &Parameter| {
            let falls = self.cause.stronger_below.contains(&p.key);
            p.prior.quantile(if falls { 1.0 - quantile } else { quantile })
        };
        self.parameters.iter().map(|p| (p.key, value(p))).collect()
    }
}

/// The search prior of a parameter is so many times as wide as its physical one.
pub const WIDER: f64 = 4.0;

impl Parameter {
    /// How many standard deviations of its physical prior a value lies above the centre; of the logarithm where it is searched by
    /// that. `None` for a constant.
    pub fn spreads_out(&self, value: f64) -> Option<f64> {
        match (&self.prior, &self.search) {
            (Family::Constant { .. }, _) => None,
            (_, Family::TruncatedLognormal { median, log_sd, .. }) => {
                Some(WIDER * ln(value / median) / log_sd)
            }
            (prior, _) => Some((value - prior.mean()) / prior.sd()),
        }
    }
}

/// Name of the file with the prior of a mechanism's key.
fn prior_file(mechanism: &str, key: &Key) -> String {
    format!("mechanism/{mechanism}/{}", key.name)
}

/// All mechanisms with their priors, the entries `prior` and `search` of `mechanism/<name>/<key>.toml` in a folder or where a study
/// looks.
///
/// # Errors
/// The faults of these files; or the priors that are not there or in another unit, in words.
pub fn described(distributions: impl Into<Distributions>) -> Result<Vec<Described>, String> {
    let distributions = distributions.into();
    let names = CAUSES.iter().flat_map(|cause| cause.section.all().map(|key| prior_file(cause.name, key)));
    let names: Vec<String> = names.collect();
    let files = read_distributions(&distributions, &names).map_err(|faults| faults.to_string())?;
    let mut missing = Vec::new();
    let described = CAUSES
        .iter()
        .map(|cause| {
            let parameters = cause.section.all().filter_map(|key| {
                let found = parameter(cause.name, key, &files);
                if found.is_none() {
                    missing.push(format!("{}.toml: [prior] and [search]", prior_file(cause.name, key)));
                }
                found
            });
            Described {
                parameters: parameters.collect(),
                name: cause.name,
                title: cause.title,
                what: cause.section.doc,
                means: cause.means,
                acts: cause.acts,
                unloading: cause.unloading,
                limit_analysis: cause.limit(),
                confounded_with: cause.confounded,
                cause,
            }
        })
        .collect();
    if missing.is_empty() {
        return Ok(described);
    }
    Err(format!("{distributions} lacks, in the unit of its key:\n  {}", missing.join("\n  ")))
}

fn parameter(
    mechanism: &str,
    key: &'static Key,
    files: &BTreeMap<String, DistributionFile>,
) -> Option<Parameter> {
    let Kind::Real { unit, .. } = key.kind else { return None };
    let file = files.get(&prior_file(mechanism, key)).filter(|file| file.unit == unit)?;
    let prior = file.entries.get("prior")?.clone();
    let search = file.entries.get("search")?.family.clone();
    let default = if let Presence::Default(text) = key.presence { Some(text) } else { None };
    Some(Parameter {
        key: key.name,
        unit,
        meaning: key.doc,
        default,
        prior: prior.family,
        search,
        status: prior.status,
        source: prior.source,
        note: prior.note,
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// Standard deviation of the logarithm, from quantiles: rounded ends of a uniform prior have no closed form.
    fn log_sd(prior: &Family) -> f64 {
        let values: Vec<f64> = (0..400).map(|k| ln(prior.quantile((f64::from(k) + 0.5) / 400.0))).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / values.len() as f64).sqrt()
    }

    #[test]
    fn search_priors_have_the_centre_of_the_physical_ones_and_four_times_their_spread() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let all = described(&folder).unwrap_or_else(|lacks| panic!("{lacks}"));
        for (m, p) in all.iter().flat_map(|m| m.parameters.iter().map(move |p| (m, p))) {
            let what = format!("{}.{}: {:?} and {:?}", m.name, p.key, p.prior, p.search);
            // Written with two digits.
            let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.08;
            match &p.search {
                Family::Constant { .. } => assert_eq!(p.prior, p.search, "{what}"),
                Family::TruncatedLognormal { median, log_sd: own, .. } => {
                    assert!(
                        near(*median, p.prior.quantile(0.5)) && near(*own, WIDER * log_sd(&p.prior)),
                        "{what}"
                    );
                }
                Family::TruncatedNormal { mean, sd, .. } | Family::Normal { mean, sd } => {
                    let centred = (mean - p.prior.mean()).abs() < 0.05 * p.prior.sd();
                    assert!(centred && near(*sd, WIDER * p.prior.sd()), "{what}");
                }
                // Of effects that are none at the mode.
                Family::Triangular { low, mode, .. } => {
                    assert_eq!((*low, *mode), (0.0, 0.0), "{what}");
                    assert!(near(p.search.sd(), WIDER * p.prior.sd()), "{what}");
                }
                other => panic!("{what}: {other:?}"),
            }
            // What the physical prior expects is searched.
            let (low, high) = p.search.support();
            assert!(p.prior.cdf(high) - p.prior.cdf(low) > 0.999 || p.prior == p.search, "{what}");
        }
    }

    #[test]
    fn how_far_out_a_value_lies_is_counted_in_spreads_of_the_physical_prior() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let all = described(&folder).unwrap_or_else(|lacks| panic!("{lacks}"));
        let of = |mechanism: &str, key: &str, value: f64| {
            let parameters = &all.iter().find(|m| m.name == mechanism).expect("known").parameters;
            parameters.iter().find(|p| p.key == key).expect("known").spreads_out(value)
        };
        assert_eq!(of("lean", "angle_deg", 1.5), Some(3.0));
        // Lognormal with a COV of 1: a standard deviation of the logarithm is the root of ln 2.
        let out =
            of("joint_closure", "initial_pa_per_m", 2e7 / (2.0_f64.sqrt() * 10.0)).expect("no constant");
        assert!((out + std::f64::consts::LN_10 / std::f64::consts::LN_2.sqrt()).abs() < 0.02, "{out}");
        assert_eq!(of("creep", "hold_every_deg", 5.0), None);
    }
    #[test]
    fn a_parameter_that_works_either_way_has_no_effect_within_its_prior() {
        let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let all = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        let mut both = 0;
        for (mechanism, p) in all.iter().flat_map(|m| m.parameters.iter().map(move |p| (m, p))) {
            let none = if p.unit == "1" { 1.0 } else { 0.0 };
            let is_within = (0.02..0.98).contains(&p.prior.cdf(none));
            let either = mechanism.stronger(p.key) == Stronger::EitherWay;
            assert_eq!(either, is_within, "{}.{}", mechanism.name, p.key);
            both += usize::from(either);
        }
        assert_eq!(both, CAUSES.iter().map(|cause| cause.either_way.len()).sum::<usize>());
    }

    #[test]
    fn every_parameter_that_works_downwards_or_either_way_is_one_of_the_keys() {
        for cause in CAUSES {
            for key in cause.stronger_below.iter().chain(cause.either_way) {
                assert!(cause.section.key(key, None).is_some(), "{}.{key}", cause.name);
            }
        }
    }
}
