//! Mechanisms that act on joints, written another way.

use pirca::law::{Coulomb, NormalLaw, PATCHES_ALONG, Sampling, Weakening};
use pirca::math::{atan, exp, tan};
use pirca::random::{Stream, Streams};
use pirca::solve::STANDARD_GRAVITY;

use crate::truth::effect::{Effect, Place};

/// Joints that are linear, each with the slope that an exponential closure has under the stones above it.
pub struct ClosureByDepth {
    pub initial: f64,
    pub closure: f64,
}

impl Effect for ClosureByDepth {
    fn law(&self, law: Coulomb, place: &Place, _: &Streams) -> Coulomb {
        const DENSITY: f64 = 2150.0;
        let depth = place.wall[1].z - place.middle().z;
        let stress = if place.is_head() { 0.0 } else { DENSITY * STANDARD_GRAVITY * depth.max(0.0) };
        let opened = exp(-stress / (self.initial * self.closure)) / self.initial;
        let kn = 1.0 / (1.0 / law.normal.largest_stiffness() + opened);
        Coulomb { normal: NormalLaw::Linear { kn }, ..law }
    }
}

/// Joints that touch in few patches, each four times as large. The quarters of a joint take turns, or stones would not stand.
pub struct LargePatches {
    pub share: f64,
}

impl Effect for LargePatches {
    fn law(&self, law: Coulomb, place: &Place, streams: &Streams) -> Coulomb {
        let [a, b] = place.blocks;
        let mut stream = streams.of(&format!("hidden large patches {a}-{b}"));
        let within: [[u32; 4]; 4] = std::array::from_fn(|_| shuffled(&mut stream));
        let order =
            (0..4).flat_map(|round| shuffled(&mut stream).map(|part| (part, within[part as usize][round])));
        let count = ((16.0 * self.share).round() as usize).max(1);
        // Part and patch count along the rows of two by two: of quarters, and of patches in a quarter.
        let corner = |(part, patch): (u32, u32)| {
            let (row, column) = (2 * (part / 2) + patch / 2, 2 * (part % 2) + patch % 2);
            2 * (row * PATCHES_ALONG + column)
        };
        let patch = |at: u32| (0b11 << at) | (0b11 << (at + PATCHES_ALONG));
        let mask = order.take(count).fold(0_u64, |mask, place| mask | patch(corner(place)));
        Coulomb { sampling: Sampling::Patches(mask), ..law }
    }

    fn differs(&self) -> bool {
        true
    }
}

/// 0 to 3 in random order.
fn shuffled(stream: &mut Stream) -> [u32; 4] {
    let mut order = [0, 1, 2, 3];
    (0..4).for_each(|k| order.swap(k, k + stream.below(4 - k)));
    order
}

/// A factor on the friction angle, instead of on its tangent, and a loss that comes in half the slip.
pub struct FrictionAngle {
    pub factor: f64,
    pub residual: f64,
    pub distance: f64,
}

impl Effect for FrictionAngle {
    fn law(&self, law: Coulomb, _: &Place, _: &Streams) -> Coulomb {
        let weakening = Weakening { residual: self.residual, distance: 0.5 * self.distance };
        Coulomb { tan_phi: tan(self.factor * atan(law.tan_phi)), weakening: Some(weakening), ..law }
    }
}

/// Every second joint has twice the cohesion, the others none.
pub struct CohesionOfSome {
    pub mean: f64,
}

impl Effect for CohesionOfSome {
    fn law(&self, law: Coulomb, place: &Place, streams: &Streams) -> Coulomb {
        let has = place.uniform(streams, "cohesion") < 0.5;
        Coulomb { cohesion: law.cohesion + if has { 2.0 * self.mean } else { 0.0 }, ..law }
    }

    fn differs(&self) -> bool {
        true
    }
}

/// A soft bed under the wall that turns as easily as the springs under the platform, instead of these.
pub struct SoftBed {
    pub rotation: f64,
}

impl Effect for SoftBed {
    fn law(&self, law: Coulomb, place: &Place, _: &Streams) -> Coulomb {
        if !place.on_platform {
            return law;
        }
        let extent = place.wall[1] - place.wall[0];
        let bed = 12.0 * self.rotation / (extent.x * extent.y * extent.y * extent.y);
        let kn = 1.0 / (1.0 / law.normal.largest_stiffness() + 1.0 / bed);
        Coulomb { normal: NormalLaw::Linear { kn }, ..law }
    }
}

/// Factors of a specimen that are uniform, with the COV asked for.
pub struct UniformScatter {
    pub kn: f64,
    pub friction: f64,
}

impl UniformScatter {
    fn factor(cov: f64, stream: &mut Stream) -> f64 {
        1.0 + cov * 3_f64.sqrt() * (2.0 * stream.uniform() - 1.0)
    }
}

impl Effect for UniformScatter {
    fn law(&self, law: Coulomb, _: &Place, streams: &Streams) -> Coulomb {
        let mut stream = streams.of("hidden specimen");
        let [kn, friction] = [self.kn, self.friction].map(|cov| Self::factor(cov, &mut stream));
        let normal = NormalLaw::Linear { kn: kn * law.normal.largest_stiffness() };
        Coulomb { normal, ks: kn * law.ks, tan_phi: friction * law.tan_phi, ..law }
    }

    fn differs(&self) -> bool {
        true
    }
}

/// Ends that fall off towards the wall's own strength over twice the length, instead of all at once.
pub struct GradedEnds {
    pub within: f64,
    pub friction: f64,
    pub stiffness: f64,
}

impl Effect for GradedEnds {
    fn law(&self, law: Coulomb, place: &Place, _: &Streams) -> Coulomb {
        let near = (1.0 - place.to_nearer_end() / (2.0 * self.within)).clamp(0.0, 1.0);
        let share = |least: f64| 1.0 - near * (1.0 - least);
        Coulomb { tan_phi: law.tan_phi * share(self.friction), ks: law.ks * share(self.stiffness), ..law }
    }
}

#[cfg(test)]
mod tests {
    use pirca::law::{CohesionAfterSlip, NormalLaw};
    use pirca::math::Vec3;

    use super::*;

    #[test]
    fn large_patches_are_two_by_two_and_lie_in_all_quarters() {
        let law = Coulomb {
            normal: NormalLaw::Linear { kn: 1e8 },
            ks: 5e7,
            tan_phi: 0.6,
            cohesion: 0.0,
            tension: 0.0,
            compressive_strength: None,
            cohesion_after_slip: CohesionAfterSlip::Kept,
            weakening: None,
            sampling: Sampling::Area,
            bonded: false,
        };
        for joint in 0..50 {
            let place = Place {
                blocks: [joint, joint + 1],
                shared: [Vec3::zeros(); 2],
                wall: [Vec3::zeros(); 2],
                on_platform: false,
            };
            for (share, patches) in [(0.25, 4), (0.5, 8), (0.8, 13), (1.0, 16)] {
                let altered = LargePatches { share }.law(law, &place, &Streams::new(1, 1));
                let Sampling::Patches(mask) = altered.sampling else { panic!("{altered:?}") };
                assert_eq!(mask.count_ones(), 4 * patches, "{mask:064b}");
                // The corner of every two by two decides on all four.
                let corners = mask & 0x0055_0055_0055_0055;
                assert_eq!(corners | corners << 1 | corners << 8 | corners << 9, mask);
                for quarter in [0, 4, 32, 36] {
                    assert!(mask >> quarter & 0x0f0f_0f0f != 0, "{mask:064b}");
                }
            }
        }
    }
}
