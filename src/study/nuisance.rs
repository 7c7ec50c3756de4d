//! What nobody knows exactly of the base model itself, mechanisms aside: the properties of a family's joints.

use crate::random::Family;
use crate::study::catalogue::read_distributions;
use crate::study::distributions::Distributions;
use crate::study::{Arm, Joint};

/// An uncertain property of the joints: a factor on what the study states.
#[derive(Clone, Debug, PartialEq)]
pub struct Nuisance {
    /// Name of its file below `nuisance`.
    pub name: &'static str,
    /// What it may be, before anything has been measured.
    pub prior: Family,
}

/// Factors on kn, on the friction angle, and on kn over ks, in this order.
pub const NUISANCES: [&str; 3] = ["kn_factor", "phi_factor", "kn_over_ks_factor"];

/// The priors, the entries `prior` of `nuisance/<name>.toml` in a folder or where a study looks.
///
/// # Errors
/// The faults of these files, or the priors that are not there, in words.
pub fn nuisances(distributions: impl Into<Distributions>) -> Result<[Nuisance; 3], String> {
    let distributions = distributions.into();
    let named = |name: &str| format!("nuisance/{name}");
    let files =
        read_distributions(&distributions, &NUISANCES.map(named)).map_err(|faults| faults.to_string())?;
    let prior = |name: &'static str| {
        let file = files.get(&named(name)).filter(|file| file.unit == "1");
        let entry = file.and_then(|file| file.entries.get("prior"));
        let prior = entry.map(|entry| entry.family.clone());
        prior.map(|prior| Nuisance { name, prior }).ok_or(name)
    };
    let [kn, phi, ratio] = NUISANCES.map(prior);
    let lacks = |name| format!("{distributions} lacks nuisance/{name}.toml: [prior] with the unit \"1\"");
    Ok([kn.map_err(lacks)?, phi.map_err(lacks)?, ratio.map_err(lacks)?])
}

impl Arm {
    /// The arm at one stiffness with other joints: factors in the order of [`NUISANCES`].
    pub fn with_joints(&self, kn: f64, [kn_factor, phi_factor, ratio_factor]: [f64; 3]) -> Arm {
        let joint = Joint {
            phi_deg: self.joint.phi_deg.clone().scaled(phi_factor),
            kn_over_ks: self.joint.kn_over_ks * ratio_factor,
            normal_law: self.joint.normal_law.scaled(kn_factor),
            ..self.joint.clone()
        };
        Arm { kn_points: vec![kn * kn_factor], joint, ..self.clone() }
    }
}
