//! One plane of the surface that bounds what a wall's section bears.

/// A half-space of stress resultants: `normal . (N11, N22, N12, M11, M22, M12) <= bound`.
///
/// Forces are per length (N/m), 1 along the wall and 2 up, tension positive. Moments are per length (N),
/// `M_ij = integral of -y sigma_ij dy` with y out of plane: M22 is positive where the face at negative y is pulled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// The outward normal: of no unit for forces, in 1/m for moments. As a direction of flow it is
    /// (E11, E22, 2 E12, chi11, chi22, 2 chi12).
    pub normal: [f64; 6],
    /// The greatest value (N/m); zero for a wall without bond, whose strength comes from its weight alone.
    pub bound: f64,
}

impl Facet {
    /// By how much (N/m) a state of stress goes beyond this plane; negative within.
    #[must_use]
    pub fn excess(&self, stress: &[f64; 6]) -> f64 {
        self.normal.iter().zip(stress).map(|(n, s)| n * s).sum::<f64>() - self.bound
    }

    /// Whether it is a half-space at all.
    pub(super) fn is_sound(&self) -> bool {
        let finite = self.bound.is_finite() && self.normal.iter().all(|n| n.is_finite());
        finite && self.normal.iter().any(|&n| n != 0.0)
    }
}

/// Units in which forces, moments and planes are all of the size of one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    /// Force per length (N/m).
    pub force: f64,
    /// Moment per length over force per length (m).
    pub arm: f64,
}

impl Units {
    /// Units for a wall whose own weight causes `pressure` (N/m) at its foot.
    pub fn of(pressure: f64, facets: &[Facet]) -> Self {
        let sum = |part: std::ops::Range<usize>| -> f64 {
            facets.iter().flat_map(|f| &f.normal[part.clone()]).map(|n| n.abs()).sum()
        };
        let (forces, moments) = (sum(0..3), sum(3..6));
        let arm = if forces > 0.0 && moments > 0.0 { forces / moments } else { 1.0 };
        let unscaled = Self { force: 1.0, arm };
        let greatest = facets.iter().map(|f| unscaled.plane(f).1.abs()).fold(pressure, f64::max);
        Self { force: if greatest > 0.0 { greatest } else { 1.0 }, arm }
    }

    /// A facet in these units, its normal of length one.
    pub fn plane(&self, facet: &Facet) -> ([f64; 6], f64) {
        let mut normal = facet.normal;
        normal[3..].iter_mut().for_each(|n| *n *= self.arm);
        let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
        (normal.map(|n| n / length), facet.bound / (length * self.force))
    }

    /// What one unit of each stress resultant is in N/m and N.
    pub fn stress(&self) -> [f64; 6] {
        let moment = self.force * self.arm;
        [self.force, self.force, self.force, moment, moment, moment]
    }
}
