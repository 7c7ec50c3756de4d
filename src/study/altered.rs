//! What mechanisms make of a wall: of its layout, its stones, its joints, its restraint, its way along the load path, and
//! what is read off it.

use crate::generate::Layout;
use crate::law::{Coulomb, NormalLaw, PATCHES_ALONG, Sampling, Stiffening, Weakening};
use crate::math::tan;
use crate::model::{Tag, Wall};
use crate::protocol::{Changes, Contacts, Ends, Loss, Protocol, Restraint};
use crate::random::{Family, Stream, Streams};
use crate::study::mechanism::{EndRelease, Mechanisms, StressStiffening};

/// Patches along each side of a joint, see [`Sampling::Patches`], and parts of four patches each.
const SIDE: u32 = PATCHES_ALONG;
const PARTS: usize = (SIDE * SIDE / 4) as usize;

impl Mechanisms {
    /// The layout that walls are drawn from.
    pub fn layout(&self, mut layout: Layout) -> Layout {
        if let Some(factor) = self.size_scatter {
            layout = layout.widened(factor);
        }
        if let Some(factor) = self.density {
            layout.density = layout.density.scaled(factor);
        }
        layout
    }

    /// What holds the walls.
    pub fn restraint(&self, mut restraint: Restraint) -> Restraint {
        if let (Some(added), Ends::Ropes(rope)) = (self.rope_slack, &mut restraint.ends) {
            rope.slack += added;
        }
        restraint.base.compliance = self.base_compliance.or(restraint.base.compliance);
        restraint.base.tan_phi = self.platform_friction.or(restraint.base.tan_phi);
        restraint
    }

    /// A wall as it stands before it is loaded.
    pub fn built(&self, wall: Wall, protocol: &Protocol) -> Wall {
        match (self.lean, protocol) {
            (None, _) => wall,
            (Some(angle), Protocol::Tilting(tilting)) if tilting.towards.is_backwards() => {
                wall.leaning(-tan(angle))
            }
            (Some(angle), _) => wall.leaning(tan(angle)),
        }
    }

    /// How the joints of a wall are found and divided.
    pub fn contacts(&self, sub_contacts: [u32; 2]) -> Contacts {
        Contacts { inset: self.contact_inset.unwrap_or(0.0), ..Contacts::from(sub_contacts) }
    }

    /// What changes a wall on its way. Every wedge has a uniform of its own: a larger share takes more wedges, and the same.
    pub fn changes(&self, wall: &Wall, streams: &Streams) -> Changes {
        let loss = self.wedge_loss.map(|loss| {
            let wedges = wall.blocks.iter().enumerate().filter(|(_, block)| block.tag == Tag::Wedge);
            let lost = |id: &usize| streams.of(&format!("wedge loss {id}")).uniform() < loss.share;
            Loss { blocks: wedges.map(|(id, _)| id).filter(lost).collect(), beyond: loss.beyond }
        });
        Changes { creep: self.creep, loss, ..Changes::default() }
    }

    /// What a gauge shows of a displacement (m) since its zero reading.
    pub fn reading(&self, displacement: f64) -> f64 {
        let scaled = self.gauge_scale.map_or(displacement, |factor| factor * displacement);
        self.gauge_offset.map_or(scaled, |offset| scaled + offset)
    }
}

/// The mechanisms that act on the joints of one wall.
#[derive(Clone, Debug, Default)]
pub(super) struct AlteredJoints {
    mechanisms: Mechanisms,
    /// Factors of this specimen on stiffness and friction.
    specimen: [f64; 2],
    /// Extent of every stone along the wall (m), and of the wall.
    spans: Vec<[f64; 2]>,
    ends: [f64; 2],
}

impl AlteredJoints {
    pub fn new(mechanisms: &Mechanisms, wall: &Wall, streams: &Streams) -> AlteredJoints {
        let factor = |cov: f64, quantity: &str| match cov {
            0.0 => 1.0,
            _ => Family::Lognormal { mean: 1.0, sd: cov }
                .sample(&mut streams.of(&format!("specimen {quantity}"))),
        };
        let specimen = mechanisms
            .specimen_scatter
            .map_or([1.0; 2], |scatter| [factor(scatter.kn, "kn"), factor(scatter.friction, "tan_phi")]);
        let span = |(low, high): (crate::math::Vec3, crate::math::Vec3)| [low.x, high.x];
        AlteredJoints {
            mechanisms: mechanisms.clone(),
            specimen,
            spans: wall.blocks.iter().map(|block| span(block.shape.bounds())).collect(),
            ends: span(wall.bounds_of_stones()),
        }
    }

    /// The law of the joint of two blocks, from that of the base model.
    pub fn law(&self, mut law: Coulomb, streams: &Streams, a: u32, b: u32) -> Coulomb {
        let Mechanisms {
            joint_closure,
            stress_stiffening,
            contact_area,
            friction,
            cohesion,
            specimen_scatter,
            end_release,
            ..
        } = &self.mechanisms;
        if specimen_scatter.is_some() {
            let [stiffness, tan_phi] = self.specimen;
            (law.ks, law.tan_phi) = (law.ks * stiffness, law.tan_phi * tan_phi);
            law.normal = law.normal.scaled(stiffness);
        }
        let kn = law.normal.largest_stiffness();
        if let Some(StressStiffening { at_1_mpa, exponent, floor }) = *stress_stiffening {
            law.normal = NormalLaw::Stiffening(Stiffening::new(kn, at_1_mpa, exponent, floor));
        }
        if let Some(joint) = joint_closure {
            law.normal = NormalLaw::Hyperbolic { kn, initial: joint.initial, closure: joint.closure };
        }
        if let Some(friction) = friction {
            law.tan_phi *= friction.factor;
            law.weakening = (friction.residual < 1.0)
                .then_some(Weakening { residual: friction.residual, distance: friction.distance });
        }
        if let Some(cohesion) = cohesion {
            law.cohesion += cohesion;
        }
        if let Some(share) = contact_area {
            let mut stream = streams.of(&format!("joint contact_area {a}-{b}"));
            law.sampling = Sampling::Patches(patches(*share, &mut stream));
        }
        if let Some(release) = end_release.filter(|release| self.is_near_an_end(release, a, b)) {
            law.tan_phi *= release.friction;
            law.ks *= release.stiffness;
        }
        law
    }

    /// Whether the middle of what two blocks share of the wall's length lies near one of its ends. What is not a stone is as
    /// long as the wall.
    fn is_near_an_end(&self, release: &EndRelease, a: u32, b: u32) -> bool {
        let span = |id: u32| self.spans.get(id as usize).copied().unwrap_or(self.ends);
        let ([a0, a1], [b0, b1]) = (span(a), span(b));
        let middle = 0.5 * (a0.max(b0) + a1.min(b1));
        middle - self.ends[0] < release.within || self.ends[1] - middle < release.within
    }
}

/// A mask of the patches nearest to a share, at least one. A stone settles until it is carried on all sides, so the parts of
/// a joint, four patches each, take turns: in each of four rounds each has one more of its patches, in random order.
fn patches(share: f64, stream: &mut Stream) -> u64 {
    let count = ((f64::from(SIDE * SIDE) * share).round() as usize).clamp(1, 4 * PARTS);
    let within: [[usize; 4]; PARTS] = std::array::from_fn(|_| shuffled(stream));
    // The uniforms of the first patches do not depend on how many there are: a larger share adds to a smaller one.
    let order = (0..4).flat_map(|round| shuffled::<PARTS>(stream).map(|part| (part, within[part][round])));
    order.take(count).fold(0, |mask, (part, patch)| {
        let side = SIDE as usize;
        let (row, column) = (2 * (part / (side / 2)) + patch / 2, 2 * (part % (side / 2)) + patch % 2);
        mask | 1 << (side * row + column)
    })
}

/// The first numbers in random order.
fn shuffled<const N: usize>(stream: &mut Stream) -> [usize; N] {
    let mut order = std::array::from_fn(|k| k);
    (0..N).for_each(|k| order.swap(k, k + stream.below(N - k)));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_are_as_many_as_asked_for_and_grow_with_the_share() {
        let of = |share: f64, name: &str| patches(share, &mut Streams::new(3, 1).of(name));
        for (share, count) in [(0.001, 1), (0.25, 16), (0.5, 32), (0.53, 34), (0.9, 58), (1.0, 64)] {
            assert_eq!(of(share, "a").count_ones(), count, "{share}");
        }
        assert_eq!(of(0.25, "a") & of(0.75, "a"), of(0.25, "a"));
        assert_ne!(of(0.5, "a"), of(0.5, "b"));
        // A quarter is one patch in each part: bits 0, 1, 8, 9 are the first.
        for k in 0..100 {
            let mask = of(0.25, &format!("{k}"));
            for part in [0, 2, 16, 34, 54] {
                assert_eq!((mask >> part & 0x0303).count_ones(), 1, "{mask:064b}");
            }
        }
        // Every patch comes up as often: 16 x 1000 draws of a quarter, 4000 +- 5 sigma of a binomial of 3/4 x 1/4.
        let mut seen = [0u32; 64];
        for k in 0..16_000 {
            let mask = of(0.25, &k.to_string());
            (0..64).for_each(|bit| seen[bit] += u32::from(mask >> bit & 1 == 1));
        }
        assert!(seen.iter().all(|n| n.abs_diff(4000) < 274), "{seen:?}");
    }
}
