//! What a periodic cell bears: limit analysis of stones that repeat themselves, under the stresses of a plate.
//!
//! A wall of many stones is a plate with membrane stresses `N` and moments `M` per length. In a cell of it, the image of a
//! stone at the translation `s` moves as the stone does, and with the plate's strain (Sab 2003, thin periodic plates):
//!
//! ```text
//! v(x + s) = v(x) + E s - y K s   in the plane,      w(x + s) = w(x) + (x + s/2) . K s   out of it
//! ```
//!
//! with the strain rate `E` and the curvature rate `K = grad grad w`. All stones may move besides, alike in every cell. The strain is
//! a body of its own to the program: its six velocities are those of `E` and `K`, and its equilibrium says that the forces across
//! the cell's border have `N` and `M` for their mean,
//!
//! ```text
//! area N = sum of sym(f x s),      area M = sum of sym((f_y (x - s/2) - y f) x s)
//! ```
//!
//! where `f` is the force from the image on the stone. So one block with the images of itself is a cell as well as sixteen by
//! sixteen. The weight of the cell's own stones is left out: it is small beside the stresses of a wall of many courses.

use crate::contact::{self, periodic_joints};
use crate::math::{STANDARD_GRAVITY, Vec3};
use crate::model::{Cell, JointLaws, Level, Six, Support, image_motion};
use crate::solve::limit::analysis::Applied;
use crate::solve::limit::interfaces::{Blocks, Interface, Rigid, contact_points};
use crate::solve::limit::loads::Wrench;
use crate::solve::limit::program::axes;
use crate::solve::limit::strength::Strength;
use crate::solve::limit::{Analysis, BlockMotion, Limit, Settings};

/// The strain of a cell as a body: its velocity is `(E11, E22, 2 E12)` and its spin `(K11, K22, 2 K12)`, both times `length`, with 1
/// along x and 2 along z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strain {
    /// Its place among the bodies.
    pub body: usize,
    /// A length of the size of the cell (m), which makes its velocities comparable with those of stones.
    pub length: f64,
    /// Area of the cell (m^2).
    area: f64,
}

impl Strain {
    /// What a force at a point of the image at `shift` does to the strain.
    pub fn felt(&self, shift: Vec3, at: Vec3, force: Vec3) -> Wrench {
        let motion = image_motion(shift, at);
        let along = |k: usize| (0..3).map(|row| motion[row][k] * force[row]).sum::<f64>() / self.length;
        Wrench {
            force: Vec3::new(along(0), along(1), along(2)),
            moment: Vec3::new(along(3), along(4), along(5)),
        }
    }

    /// Velocity that the strain gives to a point of the image at `shift` (m/s).
    pub fn velocity(&self, rate: &Wrench, shift: Vec3, at: Vec3) -> Vec3 {
        let (e, k) = (rate.force / self.length, rate.moment / self.length);
        let strain = [e.x, e.y, e.z, k.x, k.y, k.z];
        let along = |row: &Six| row.iter().zip(&strain).map(|(a, b)| a * b).sum();
        let [x, y, z] = image_motion(shift, at);
        Vec3::new(along(&x), along(&y), along(&z))
    }

    /// Stresses of the plate as a load on the strain.
    fn load(&self, [n11, n22, n12, m11, m22, m12]: Six) -> Wrench {
        let scale = self.area / self.length;
        Wrench { force: Vec3::new(n11, n22, n12) * scale, moment: Vec3::new(m11, m22, m12) * scale }
    }
}

/// What a cell bears of some stresses.
#[derive(Clone, Debug, PartialEq)]
pub struct Bearing {
    /// The multiplier of the live stresses, and how it was found. The mechanism has one more body than the cell has stones.
    pub limit: Limit,
    /// The plate's strain rate at collapse, `(E11, E22, 2 E12, K11, K22, 2 K12)` in 1/s and 1/(m s), such that the live stresses have
    /// the power of 1 W/m^2: the outward normal of the surface where it was reached. Zero where there is no mechanism.
    pub rate: Six,
}

impl Blocks {
    /// The stones of a cell, and its strain as the last body. `unit` is the force that others are compared with (N).
    fn of_cell(
        cell: &Cell,
        laws: &dyn JointLaws,
        contact: &contact::Settings,
        closed_gap: f64,
        unit: f64,
    ) -> Blocks {
        let mut rigid: Vec<Rigid> = cell.blocks.iter().map(Rigid::of).collect();
        rigid[0].pinned = true;
        let length = cell.area().sqrt();
        let strain = Strain { body: rigid.len(), length, area: cell.area() };
        rigid.push(Rigid {
            centroid: Vec3::zeros(),
            mass: 0.0,
            radius: length,
            support: Support::Free,
            pinned: false,
        });
        let closed = closed_gap.max(contact.touch);
        let mut interfaces = Vec::new();
        for joint in periodic_joints(cell, contact) {
            let law = laws.of(joint.first as u32, joint.second as u32);
            let mut points = contact_points(&joint.patch, closed, law.sampling);
            if points.is_empty() {
                continue;
            }
            let normal = joint.patch.plane.normal;
            interfaces.push(if joint.patch.reference_is_second {
                let (incident, reference) = (joint.first, joint.second);
                Interface { incident, reference, shift: joint.shift, normal, law, points }
            } else {
                // Seen from the stone whose image was found.
                points.iter_mut().for_each(|point| point.at -= joint.shift);
                let (incident, reference) = (joint.second, joint.first);
                Interface { incident, reference, shift: -joint.shift, normal, law, points }
            });
        }
        let leads = (0..rigid.len()).collect();
        Blocks {
            origin: Vec3::zeros(),
            rigid,
            leads,
            interfaces,
            ties: Vec::new(),
            strain: Some(strain),
            unit,
        }
    }
}

impl Analysis {
    /// Finds the joints of a cell, inside it and across its border. `laws` is asked with the stones' numbers, for an image with that
    /// of its stone. `pressure` is the vertical stress resultant (N/m, positive) that the answers are wanted at: nothing but
    /// the unit in which they are computed.
    pub fn of_cell(
        cell: &Cell,
        laws: &dyn JointLaws,
        contact: contact::Settings,
        settings: Settings,
        pressure: f64,
    ) -> Self {
        let stones = cell.blocks.len() as f64;
        let unit = pressure * (cell.area() / stones).sqrt();
        let blocks = Blocks::of_cell(cell, laws, &contact, settings.closed_gap, unit);
        let strengths = blocks.points().map(|(joint, point)| Strength::of(&joint.law, point.area)).collect();
        Analysis { blocks, strengths, settings }
    }

    /// The largest multipliers of `live` stresses of the plate, each beside the `dead` ones: `(N11, N22, N12, M11, M22, M12)` as in
    /// [`Six`], in N/m and N.
    ///
    /// Empty for an analysis that is not of a cell.
    pub fn bears(&self, dead: Six, live: &[Six]) -> Vec<Bearing> {
        let Some(strain) = self.blocks.strain else { return Vec::new() };
        let of = |stresses: Six| {
            let mut wrenches = vec![Wrench::default(); self.blocks.rigid.len()];
            wrenches[strain.body] = strain.load(stresses);
            wrenches
        };
        let down = Vec3::new(0.0, 0.0, -STANDARD_GRAVITY);
        let mut applied =
            Applied { dead: of(dead), live: of([0.0; 6]), axes: axes(&self.blocks, [down, down]) };
        let spent = self.stands_at_rest(&applied, Level::Multiplier(0.0));
        let bears = |live: &Six| {
            applied.live = of(*live);
            let limit = match &spent {
                Ok(spent) => self.multiplier_beside(&applied, *spent),
                Err(limit) => (**limit).clone(),
            };
            let BlockMotion { velocity, spin } =
                limit.mechanism.get(strain.body).copied().unwrap_or_default();
            let load = strain.load(*live);
            let power = load.force.dot(&velocity) + load.moment.dot(&spin);
            let scale = if power > 0.0 { strain.area / (power * strain.length) } else { 0.0 };
            let rate = [velocity.x, velocity.y, velocity.z, spin.x, spin.y, spin.z].map(|v| v * scale);
            Bearing { limit, rate }
        };
        live.iter().map(bears).collect()
    }
}
