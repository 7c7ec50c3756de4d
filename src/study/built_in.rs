//! What is built into the program: the distributions, and the studies that `pirca init` copies.

/// A text of the repository with its path there.
macro_rules! texts {
    ($($path:literal,)+) => {
        &[$(($path, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/", $path))),)+]
    };
}

/// The files below `distributions`, in the order of their paths.
pub(super) const DISTRIBUTIONS: &[(&str, &str)] = texts![
    "distributions/block/density.toml",
    "distributions/block/dip.toml",
    "distributions/block/size.toml",
    "distributions/block/size_factor.toml",
    "distributions/block/wedge.toml",
    "distributions/joint/cohesion.toml",
    "distributions/joint/friction.toml",
    "distributions/joint/stiffness.toml",
    "distributions/mechanism/base_compliance/rotation_n_m_per_rad.toml",
    "distributions/mechanism/base_compliance/settlement_n_per_m.toml",
    "distributions/mechanism/cohesion/added_pa.toml",
    "distributions/mechanism/contact_area/share.toml",
    "distributions/mechanism/contact_inset/radius_m.toml",
    "distributions/mechanism/creep/hold_every_deg.toml",
    "distributions/mechanism/creep/hold_share.toml",
    "distributions/mechanism/creep/rate_per_deg.toml",
    "distributions/mechanism/density/factor.toml",
    "distributions/mechanism/end_release/friction_share.toml",
    "distributions/mechanism/end_release/stiffness_share.toml",
    "distributions/mechanism/end_release/within_m.toml",
    "distributions/mechanism/friction/factor.toml",
    "distributions/mechanism/friction/residual_share.toml",
    "distributions/mechanism/friction/slip_distance_m.toml",
    "distributions/mechanism/gauge_offset/offset_m.toml",
    "distributions/mechanism/gauge_scale/factor.toml",
    "distributions/mechanism/joint_closure/closure_m.toml",
    "distributions/mechanism/joint_closure/initial_pa_per_m.toml",
    "distributions/mechanism/lean/angle_deg.toml",
    "distributions/mechanism/platform_friction/phi_deg.toml",
    "distributions/mechanism/rope_slack/added_m.toml",
    "distributions/mechanism/size_scatter/factor.toml",
    "distributions/mechanism/specimen_scatter/friction_cov.toml",
    "distributions/mechanism/specimen_scatter/kn_cov.toml",
    "distributions/mechanism/stress_stiffening/at_1_mpa_pa_per_m.toml",
    "distributions/mechanism/stress_stiffening/exponent.toml",
    "distributions/mechanism/stress_stiffening/floor_pa_per_m.toml",
    "distributions/mechanism/wedge_loss/beyond_deg.toml",
    "distributions/mechanism/wedge_loss/share.toml",
    "distributions/nuisance/kn_factor.toml",
    "distributions/nuisance/kn_over_ks_factor.toml",
    "distributions/nuisance/phi_factor.toml",
];

/// What the studies read, in the order of their paths. Their banks are left out: they are large, and computed anew.
const STUDIES: &[(&str, &str)] = texts![
    "studies/arrangements/study.toml",
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
