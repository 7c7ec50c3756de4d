//! Coulomb's law with cohesion and a tension cut-off, per sub-contact (source paper Eq. 2 and 3, Fig. 8).

use crate::law::NormalLaw;

/// The law of one joint. Stresses are per joint area; compression positive.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Coulomb {
    /// Compressive stress from closure.
    pub normal: NormalLaw,
    /// Shear stiffness per joint area (Pa/m).
    pub ks: f64,
    /// tan of the friction angle.
    pub tan_phi: f64,
    /// Cohesion (Pa).
    pub cohesion: f64,
    /// Tensile strength (Pa): a sub-contact that has been pulled harder than this is open for good and carries
    /// compression and friction only.
    pub tension: f64,
    /// What happens to the cohesion of a sub-contact once it has slipped.
    pub cohesion_after_slip: CohesionAfterSlip,
    /// Where the joint's stress is sampled.
    pub sampling: Sampling,
    /// Linear springs that neither open nor slip (an idealised attachment), instead of a joint.
    pub bonded: bool,
}

/// What happens to the cohesion of a sub-contact once it has slipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CohesionAfterSlip {
    /// It stays: the envelope of the source paper's Eq. 3.
    Kept,
    /// It is gone: brittle bond.
    Lost,
}

/// Where the joint's stress is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampling {
    /// Integrated over the compressed area of the joint.
    Area,
    /// At the joint's corners only, as older block codes do: a tilting wall then loses its dependence on kn.
    Vertices,
}
