//! What is built into the program: the distributions, and the studies that `pirca init` copies.

use crate::study::cause::CAUSES;

/// A text of the repository with its path there.
macro_rules! texts {
    ($($path:literal,)+) => {
        &[$(($path, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/", $path))),)+]
    };
}

/// The files below `distributions` beside the priors of the causes, which stand with these.
const DISTRIBUTIONS: &[(&str, &str)] = texts![
    "distributions/block/density.toml",
    "distributions/block/dip.toml",
    "distributions/block/size.toml",
    "distributions/block/size_factor.toml",
    "distributions/block/wedge.toml",
    "distributions/joint/cohesion.toml",
    "distributions/joint/friction.toml",
    "distributions/joint/stiffness.toml",
    "distributions/nuisance/kn_factor.toml",
    "distributions/nuisance/kn_over_ks_factor.toml",
    "distributions/nuisance/phi_factor.toml",
];

/// All files below `distributions`: path and text.
pub(super) fn distributions() -> impl Iterator<Item = (&'static str, &'static str)> {
    DISTRIBUTIONS.iter().chain(CAUSES.iter().flat_map(|cause| cause.priors)).copied()
}

/// What the studies read, in the order of their paths. Their banks are left out: they are large, and computed anew.
const STUDIES: &[(&str, &str)] = texts![
    "studies/arrangements/study.toml",
    "studies/bearing/published.toml",
    "studies/bearing/study.toml",
    "studies/dry-shear-walls/distributions/mechanism/joint_closure/initial_pa_per_m.toml",
    "studies/dry-shear-walls/distributions/mechanism/stress_stiffening/at_1_mpa_pa_per_m.toml",
    "studies/dry-shear-walls/distributions/nuisance/kn_factor.toml",
    "studies/dry-shear-walls/measured.csv",
    "studies/dry-shear-walls/study.toml",
    "studies/earthquake/study.toml",
    "studies/edge-restraint/published.toml",
    "studies/edge-restraint/study.toml",
    "studies/element-types/published.toml",
    "studies/element-types/study.toml",
    "studies/homogenisation/study.toml",
    "studies/joint-arrangement/published.toml",
    "studies/joint-arrangement/study.toml",
    "studies/retaining/study.toml",
    "studies/sources-of-scatter/study.toml",
    "studies/tilting-block/published.toml",
    "studies/tilting-block/study.toml",
    "studies/tilting-table/measured.csv",
    "studies/tilting-table/published.toml",
    "studies/tilting-table/study.toml",
];

/// A study that is built in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BuiltInStudy {
    /// Its name.
    pub name: &'static str,
    /// Its files: name in its folder, and text.
    pub files: Vec<(&'static str, &'static str)>,
}

/// The studies that are built in, by name.
pub fn built_in_studies() -> Vec<BuiltInStudy> {
    let mut studies: Vec<BuiltInStudy> = Vec::new();
    for (path, text) in STUDIES {
        let Some((name, file)) = path.strip_prefix("studies/").and_then(|path| path.split_once('/')) else {
            continue;
        };
        match studies.last_mut().filter(|study| study.name == name) {
            Some(study) => study.files.push((file, text)),
            None => studies.push(BuiltInStudy { name, files: vec![(file, text)] }),
        }
    }
    studies
}
