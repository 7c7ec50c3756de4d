//! What is known of each mechanism that the base model leaves out: where it acts, what it is confounded with, whether its
//! effect goes when the wall is unloaded, and how limit analysis takes it.

use crate::study::keys::MECHANISM;
use crate::study::schema::{Kind, Section};

/// What is known of a mechanism besides its keys.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name, that of its table of keys.
    pub name: &'static str,
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
    acts: Acts,
    unloading: Unloading,
    limit: InLimitAnalysis,
    confounded: &'static [&'static str],
) -> Entry {
    Entry { name, acts, unloading, confounded, limit }
}

/// All mechanisms, in the order of their keys.
#[rustfmt::skip]
pub static INVENTORY: [Entry; 16] = {
    use Acts::{Joints, Loading, Readings, Restraint, Wall};
    use InLimitAnalysis::{Honoured, NoBearing, Refused};
    use Unloading::{AsWithout, Irreversible, Reversible};
    [
        entry("contact_inset", Joints, AsWithout, Honoured, &["joint.kn_pa_per_m", "lean", "contact_area", "restraint.strip_height_m"]),
        entry("joint_closure", Joints, Reversible, Refused, &["joint.kn_pa_per_m", "contact_area", "base_compliance", "gauge_scale"]),
        entry("contact_area", Joints, AsWithout, Honoured, &["joint.kn_pa_per_m", "contact_inset", "joint_closure", "size_scatter"]),
        entry("friction", Joints, Irreversible, Honoured, &["joint.phi_deg", "cohesion", "end_release"]),
        entry("cohesion", Joints, AsWithout, Honoured, &["friction", "density"]),
        entry("lean", Wall, AsWithout, Honoured, &["contact_inset", "base_compliance", "wall.battered_face"]),
        entry("base_compliance", Restraint, Reversible, Refused, &["joint.kn_pa_per_m", "joint_closure", "gauge_scale"]),
        entry("wedge_loss", Loading, Irreversible, Refused, &["creep", "contact_area", "size_scatter"]),
        entry("rope_slack", Restraint, Reversible, NoBearing, &["restraint.rope.stiffness_n_per_m", "end_release"]),
        entry("size_scatter", Wall, AsWithout, Honoured, &["specimen_scatter", "wedge_loss", "contact_area"]),
        entry("density", Wall, AsWithout, Honoured, &["joint.kn_pa_per_m", "cohesion"]),
        entry("gauge_offset", Readings, Irreversible, NoBearing, &["creep", "joint_closure"]),
        entry("gauge_scale", Readings, Reversible, NoBearing, &["joint.kn_pa_per_m", "joint_closure", "base_compliance"]),
        entry("creep", Loading, Irreversible, Refused, &["gauge_offset", "friction", "joint.kn_over_ks"]),
        entry("specimen_scatter", Joints, AsWithout, Honoured, &["size_scatter", "contact_area"]),
        entry("end_release", Joints, Irreversible, Honoured, &["rope_slack", "friction"]),
    ]
};

impl Entry {
    /// Its table of keys.
    pub fn section(&self) -> Option<&'static Section> {
        match MECHANISM.key(self.name, None)?.kind {
            Kind::Table(section) => Some(section),
            _ => None,
        }
    }
}
