//! Importance sampling with shifted standard normals: values on the worse side are made likely, and each counts by how much.

use crate::math::exp;

/// One in so many points is drawn as it is, so that no point counts more than that (Hesterberg 1995): a shift that led the wrong way
/// costs values, not the answer.
pub const DEFENCE: u64 = 10;

/// Whether the k-th point is shifted.
pub fn is_shifted(k: u64) -> bool {
    !k.is_multiple_of(DEFENCE)
}

/// The share of so many points that are drawn as they are: a tenth, or a little more where their number is no multiple of ten. Its inverse
/// is the most that a point can count.
pub fn defended(points: usize) -> f64 {
    (points as u64).div_ceil(DEFENCE) as f64 / points as f64
}

/// What a point counts: the density that its normals have over that of the mixture that it was drawn from, of which the share `defended` is
/// not shifted. `normals` are those of the point, shifted or not, and `shift` what those of most points were shifted by.
pub fn weight(normals: &[f64], shift: &[f64], defended: f64) -> f64 {
    let tilt: f64 = normals.iter().zip(shift).map(|(z, s)| s * z - 0.5 * s * s).sum();
    1.0 / (defended + (1.0 - defended) * exp(tilt))
}
