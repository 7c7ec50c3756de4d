//! What is known of each mechanism that the base model leaves out: where it acts, what it is confounded with, whether its
//! effect goes when the wall is unloaded, and how limit analysis takes it.

use std::collections::BTreeMap;

use crate::math::ln;
use crate::random::Family;
use crate::study::catalogue::{DistributionFile, read_distributions};
use crate::study::distributions::Distributions;
use crate::study::keys::MECHANISM;
use crate::study::schema::{Key, Kind, Presence, Section};

/// What is known of a mechanism besides its keys.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name, that of its table of keys.
    pub name: &'static str,
    /// Its name in plain words.
    pub title: &'static str,
    /// What would be true of the wall or of the test, with what looks the same and has no entry of its own.
    pub means: &'static str,
    /// Where it acts.
    pub acts: Acts,
    /// What becomes of its effect when the wall is unloaded.
    pub unloading: Unloading,
    /// Mechanisms, and keys of the base model, whose effect on a tilting test looks alike.
    pub confounded: &'static [&'static str],
    /// How limit analysis takes it.
    pub limit: InLimitAnalysis,
}

/// Where a mechanism acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Acts {
    /// On the wall as it is built.
    Wall,
    /// On the joints.
    Joints,
    /// On what holds the wall.
    Restraint,
    /// On the wall while it is loaded.
    Loading,
    /// On the readings alone.
    Readings,
}

/// What becomes of a mechanism's effect when the wall is unloaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Unloading {
    /// It goes: elastic, or a factor on what is read.
    Reversible,
    /// It stays.
    Irreversible,
    /// It changes the wall for good, and no law: what comes back is what comes back without it.
    AsWithout,
}

/// How limit analysis takes a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum InLimitAnalysis {
    /// It counts.
    Honoured,
    /// It has no bearing on rigid blocks and their loads, by what limit analysis is.
    NoBearing,
    /// A study that asks for both is refused.
    Refused,
}

const fn entry(
    name: &'static str,
    title: &'static str,
    means: &'static str,
    acts: Acts,
    unloading: Unloading,
    limit: InLimitAnalysis,
    confounded: &'static [&'static str],
) -> Entry {
    Entry { name, title, means, acts, unloading, confounded, limit }
}

/// All mechanisms, in the order of their keys.
#[rustfmt::skip]
pub static INVENTORY: [Entry; 18] = {
    use Acts::{Joints, Loading, Readings, Restraint, Wall};
    use InLimitAnalysis::{Honoured, NoBearing, Refused};
    use Unloading::{AsWithout, Irreversible, Reversible};
    [
        entry("contact_inset", "rounded arrises: joints that begin behind the faces", "joints begin behind the stated faces; rounded arrises, a soft bed that may open and a wall thinner than stated look the same", Joints, AsWithout, Honoured, &["joint.kn_pa_per_m", "restraint.strip_height_m", "lean", "contact_area"]),
        entry("joint_closure", "joints that are soft until they close", "joints touch by rough points and are soft until they have closed", Joints, Reversible, Refused, &["joint.kn_pa_per_m", "stress_stiffening", "contact_area", "base_compliance", "gauge_scale", "gauge_offset"]),
        entry("stress_stiffening", "joints that stiffen as they are pressed", "joints become stiffer as they are pressed together", Joints, Reversible, Refused, &["joint.kn_pa_per_m", "joint_closure"]),
        entry("contact_area", "stones that touch on a part of their faces", "stones touch on a part of their faces only", Joints, AsWithout, Honoured, &["joint.kn_pa_per_m", "contact_inset", "joint_closure", "size_scatter", "specimen_scatter", "wedge_loss"]),
        entry("friction", "joints with another friction than stated", "joints are smoother or rougher than stated, or lose friction as they slip", Joints, Irreversible, Honoured, &["joint.phi_deg", "cohesion", "end_release", "creep"]),
        entry("cohesion", "something that holds the stones together", "something holds the stones together, as earth in the joints or suction does", Joints, AsWithout, Honoured, &["friction", "density"]),
        entry("lean", "a wall or a platform out of plumb", "the wall leaned before the test, or the platform was not level", Wall, AsWithout, Honoured, &["wall.battered_face", "contact_inset", "base_compliance", "platform_friction"]),
        entry("base_compliance", "a base that gives way", "what carries the wall gives way, the platform or the ground under it", Restraint, Reversible, Refused, &["joint.kn_pa_per_m", "joint_closure", "lean", "gauge_scale"]),
        entry("wedge_loss", "pinning stones that fall out", "pinning stones fall out as the wall tilts", Loading, Irreversible, Refused, &["creep", "contact_area", "size_scatter"]),
        entry("rope_slack", "ropes that hold late", "the ropes let the wall move before they hold", Restraint, Reversible, NoBearing, &["restraint.rope.stiffness_n_per_m", "end_release"]),
        entry("size_scatter", "stones that differ more in size", "stones differ in size more than stated", Wall, AsWithout, Honoured, &["specimen_scatter", "wedge_loss", "contact_area"]),
        entry("density", "stones of another weight", "stones are heavier or lighter than stated", Wall, AsWithout, Honoured, &["joint.kn_pa_per_m", "cohesion"]),
        entry("gauge_offset", "a gauge that moved, or a wrong zero", "the gauges moved, or their zero is wrong", Readings, Irreversible, NoBearing, &["creep", "joint_closure"]),
        entry("gauge_scale", "a gauge with a wrong scale", "the gauges show too much or too little by a factor", Readings, Reversible, NoBearing, &["joint.kn_pa_per_m", "joint_closure", "base_compliance"]),
        entry("creep", "joints that go on moving under load", "joints go on moving under load, and what they moved stays", Loading, Irreversible, Refused, &["joint.kn_over_ks", "gauge_offset", "friction", "wedge_loss"]),
        entry("specimen_scatter", "joints that differ from specimen to specimen", "joints differ from specimen to specimen", Joints, AsWithout, Honoured, &["size_scatter", "contact_area"]),
        entry("end_release", "end stones that are held less", "the stones near the ends are held less than the others", Joints, Irreversible, Honoured, &["rope_slack", "friction", "platform_friction"]),
        entry("platform_friction", "a wall that slides on its platform", "the wall slides on its platform", Restraint, Irreversible, Honoured, &["restraint.platform_phi_deg", "restraint.strip_height_m", "end_release", "lean"]),
    ]
};

/// The plain words of a mechanism, with its name behind them; the name alone of one that is not known.
pub fn in_plain_words(name: &str) -> String {
    let own = INVENTORY.iter().find(|entry| entry.name == name);
    own.map_or_else(|| name.to_owned(), |entry| format!("{} ({name})", entry.title))
}

impl Acts {
    /// In words.
    pub fn words(&self) -> &'static str {
        match self {
            Acts::Wall => "the wall as it is built",
            Acts::Joints => "the joints",
            Acts::Restraint => "what holds the wall",
            Acts::Loading => "the wall while it is loaded",
            Acts::Readings => "the readings alone",
        }
    }
}

impl Unloading {
    /// In words.
    pub fn words(&self) -> &'static str {
        match self {
            Unloading::Reversible => "its effect goes",
            Unloading::Irreversible => "its effect stays",
            Unloading::AsWithout => "as without it",
        }
    }
}

impl InLimitAnalysis {
    /// In words.
    pub fn words(&self) -> &'static str {
        match self {
            InLimitAnalysis::Honoured => "honoured",
            InLimitAnalysis::NoBearing => "has no bearing on it",
            InLimitAnalysis::Refused => "refused",
        }
    }
}

impl Entry {
    /// Its table of keys.
    pub fn section(&self) -> Option<&'static Section> {
        match MECHANISM.key(self.name, None)?.kind {
            Kind::Table(section) => Some(section),
            _ => None,
        }
    }
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

/// The keys of all mechanisms, as the name of the mechanism and the key.
fn keys() -> impl Iterator<Item = (&'static str, &'static Key)> {
    let of = |entry: &'static Entry| entry.section().into_iter().flat_map(Section::all);
    INVENTORY.iter().flat_map(move |entry| of(entry).map(move |key| (entry.name, key)))
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
    let names: Vec<String> = keys().map(|(mechanism, key)| prior_file(mechanism, key)).collect();
    let files = read_distributions(&distributions, &names).map_err(|faults| faults.to_string())?;
    let mut missing = Vec::new();
    let described = INVENTORY
        .iter()
        .map(|entry| {
            let section = entry.section();
            let keys = section.into_iter().flat_map(Section::all);
            let parameters = keys.filter_map(|key| {
                let found = parameter(entry.name, key, &files);
                if found.is_none() {
                    missing.push(format!("{}.toml: [prior] and [search]", prior_file(entry.name, key)));
                }
                found
            });
            Described {
                parameters: parameters.collect(),
                name: entry.name,
                title: entry.title,
                what: section.map_or("", |section| section.doc),
                means: entry.means,
                acts: entry.acts,
                unloading: entry.unloading,
                limit_analysis: entry.limit,
                confounded_with: entry.confounded,
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
}
