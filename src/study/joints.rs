//! The law of every joint of one wall: constants as stated, families drawn once per joint.

use std::ops::Range;

use crate::law::{Coulomb, NormalLaw, Sampling};
use crate::math::{Vec3, radians, tan};
use crate::model::{JointLaws, Wall};
use crate::random::{Family, Streams};
use crate::study::cause::Mechanisms;
use crate::study::checked::{Joint, StatedLaw};

/// Gives the joints of one member at one kn their laws.
///
/// A random property is one uniform per joint, from a stream keyed by the quantity and the pair of blocks; so another
/// kn, or another property made random, leaves all other draws as they were.
#[derive(Clone, Debug)]
pub struct DrawnJoints<'s> {
    joint: &'s Joint,
    kn: f64,
    streams: Streams,
    mechanisms: Mechanisms,
    spans: Spans,
}

/// What lies where along a wall.
#[derive(Clone, Debug, Default)]
struct Spans {
    /// Extent of every stone along the wall (m).
    stones: Vec<[f64; 2]>,
    /// That of the wall (m).
    wall: [f64; 2],
    /// The numbers of the blocks that carry the wall: the base that it has, or the platform, which is the first behind it.
    base: Range<u32>,
}

/// Where a joint lies in its wall, for causes that change its law.
pub struct JointSite<'w> {
    /// The two blocks, the smaller number first.
    pub blocks: [u32; 2],
    /// The streams of the member.
    pub streams: &'w Streams,
    spans: &'w Spans,
}

impl JointSite<'_> {
    /// How far (m) the middle of what the two blocks share of the wall's length lies from the nearer end of the wall. What is not a
    /// stone is as long as the wall.
    pub fn to_end(&self) -> f64 {
        let Spans { stones, wall, .. } = self.spans;
        let [[a0, a1], [b0, b1]] = self.blocks.map(|id| stones.get(id as usize).copied().unwrap_or(*wall));
        let middle = 0.5 * (a0.max(b0) + a1.min(b1));
        (middle - wall[0]).min(wall[1] - middle)
    }

    /// Whether one of the two blocks carries the wall: the platform, or a base of the wall.
    pub fn is_under_the_wall(&self) -> bool {
        self.spans.base.contains(&self.blocks[1])
    }
}

impl<'s> DrawnJoints<'s> {
    /// The joints of the member whose streams are given, at a normal stiffness `kn` (Pa/m).
    pub fn new(joint: &'s Joint, kn: f64, streams: Streams) -> DrawnJoints<'s> {
        DrawnJoints { joint, kn, streams, mechanisms: Mechanisms::default(), spans: Spans::default() }
    }

    /// The same with what mechanisms make of the joints of a wall, as it stands before it is loaded.
    pub fn altered(self, mechanisms: &Mechanisms, wall: &Wall) -> DrawnJoints<'s> {
        let span = |(low, high): (Vec3, Vec3)| [low.x, high.x];
        let spans = Spans {
            stones: wall.blocks.iter().map(|block| span(block.shape.bounds())).collect(),
            wall: span(wall.bounds_of_stones()),
            base: {
                let first = wall.before_base();
                first as u32..wall.blocks.len().max(first + 1) as u32
            },
        };
        DrawnJoints { mechanisms: mechanisms.clone(), spans, ..self }
    }
}

impl JointLaws for DrawnJoints<'_> {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        let (a, b) = (a.min(b), a.max(b));
        let site = JointSite { blocks: [a, b], streams: &self.streams, spans: &self.spans };
        self.mechanisms.law(self.joint.law(self.kn, &self.streams, a, b), &site)
    }
}

impl Joint {
    /// Whether no joint can bear shear: neither friction nor cohesion, and none is drawn.
    pub fn is_smooth(&self) -> bool {
        [&self.phi_deg, &self.cohesion].iter().all(|family| family.support() == (0.0, 0.0))
    }

    /// The law of the joint between blocks `a` and `b` of a member at a normal stiffness `kn` (Pa/m); the order of
    /// the two does not matter.
    pub fn law(&self, kn: f64, streams: &Streams, a: u32, b: u32) -> Coulomb {
        let (a, b) = (a.min(b), a.max(b));
        let draw = |family: &Family, quantity: &str| match family {
            Family::Constant { value } => *value,
            _ => family.sample(&mut streams.of(&format!("joint {quantity} {a}-{b}"))),
        };
        let factor = draw(&self.kn_factor, "kn_factor");
        let kn = kn * factor;
        Coulomb {
            normal: match &self.normal_law {
                StatedLaw::Linear => NormalLaw::Linear { kn },
                StatedLaw::Table(table) => NormalLaw::Table(table.scaled(factor)),
            },
            ks: kn / self.kn_over_ks,
            tan_phi: tan(radians(draw(&self.phi_deg, "phi"))),
            cohesion: draw(&self.cohesion, "cohesion"),
            tension: self.tension,
            compressive_strength: self.compressive_strength,
            cohesion_after_slip: self.cohesion_after_slip,
            weakening: None,
            sampling: match &self.bearing {
                Some(bearing) => Sampling::Seats(bearing.seating(streams, a, b)),
                None => self.sampling,
            },
            bonded: false,
        }
    }
}
