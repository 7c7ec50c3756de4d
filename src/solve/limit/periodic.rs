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

/// The strain of a cell as a body of six velocities, each of which is a strain rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strain {
    /// Its place among the bodies.
    pub body: usize,
    /// The strain rate of each unit velocity (1/m and 1/m^2), of a size that makes it comparable with those of stones; one that is
    /// zero has no part in anything.
    axes: [Six; 6],
    /// Area of the cell (m^2).
    area: f64,
}

impl Strain {
    /// What a force at a point of the image at `shift` does to the strain.
    pub fn felt(&self, shift: Vec3, at: Vec3, force: Vec3) -> Wrench {
        let motion = image_motion(shift, at);
        self.along(std::array::from_fn(|k| (0..3).map(|row| motion[row][k] * force[row]).sum()))
    }

    /// Velocity that the strain gives to a point of the image at `shift` (m/s).
    pub fn velocity(&self, rate: &Wrench, shift: Vec3, at: Vec3) -> Vec3 {
        let strain = self.rate(rate);
        let along = |row: &Six| row.iter().zip(&strain).map(|(a, b)| a * b).sum();
        let [x, y, z] = image_motion(shift, at);
        Vec3::new(along(&x), along(&y), along(&z))
    }

    /// Stresses of the plate as a load on the strain.
    fn load(&self, stresses: Six) -> Wrench {
        self.along(stresses.map(|stress| stress * self.area))
    }

    /// What has this work on unit strains has on unit velocities.
    fn along(&self, work: Six) -> Wrench {
        let [a, b, c, d, e, f] = self.axes.map(|axis| axis.iter().zip(&work).map(|(a, w)| a * w).sum());
        Wrench { force: Vec3::new(a, b, c), moment: Vec3::new(d, e, f) }
    }

    /// The strain rate of velocities.
    fn rate(&self, v: &Wrench) -> Six {
        let velocities = [v.force.x, v.force.y, v.force.z, v.moment.x, v.moment.y, v.moment.z];
        std::array::from_fn(|k| self.axes.iter().zip(velocities).map(|(axis, v)| axis[k] * v).sum())
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
    fn of_cell(cell: &Cell, laws: &dyn JointLaws, contact: &contact::Settings, unit: f64) -> Blocks {
        let mut rigid: Vec<Rigid> = cell.blocks.iter().map(Rigid::of).collect();
        rigid[0].pinned = true;
        let length = cell.area().sqrt();
        let axes = std::array::from_fn(|i| std::array::from_fn(|k| if i == k { 1.0 / length } else { 0.0 }));
        let strain = Strain { body: rigid.len(), axes, area: cell.area() };
        rigid.push(Rigid {
            centroid: Vec3::zeros(),
            mass: 0.0,
            radius: length,
            support: Support::Free,
            pinned: false,
        });
        let mut interfaces = Vec::new();
        for joint in periodic_joints(cell, contact) {
            let law = laws.of(joint.first as u32, joint.second as u32);
            let mut points = contact_points(&joint.patch, contact.closed, law.sampling);
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
        let blocks = Blocks::of_cell(cell, laws, &contact, unit);
        let strengths = blocks.points().map(|(joint, point)| Strength::of(&joint.law, point.area)).collect();
        Analysis { blocks, strengths, settings }
    }

    /// The largest multipliers of `live` stresses of the plate, each beside the `dead` ones: `(N11, N22, N12, M11, M22, M12)` as in
    /// [`Six`], in N/m and N.
    ///
    /// Empty for an analysis that is not of a cell.
    pub fn bears(&self, dead: Six, live: &[Six]) -> Vec<Bearing> {
        let Some(strain) = self.blocks.strain else { return Vec::new() };
        let mut applied = self.stressed(&strain, dead, [0.0; 6]);
        let spent = self.stands_at_rest(&applied, Level::Multiplier(0.0));
        let bears = |live: &Six| {
            applied.live = self.stressed(&strain, dead, *live).live;
            let limit = match &spent {
                Ok(spent) => self.multiplier_beside(&applied, *spent),
                Err(limit) => (**limit).clone(),
            };
            strain.bearing(limit, live)
        };
        live.iter().map(bears).collect()
    }

    /// How far the stresses that are borne beside `N22 = -pressure` (N/m) reach along a strain rate, and where: the multiplier is the
    /// largest work of stresses on `rate`, whatever stresses that takes. Of a cell without cohesion the plane that bounds all stresses
    /// there has the normal `rate` with that work over `pressure` in the place of `E22`, and goes through the origin.
    ///
    /// `rate` has no part in `E22`. `None` for an analysis that is not of a cell.
    pub fn reaches(&self, pressure: f64, rate: &Six) -> Option<Bearing> {
        let mut strain = self.blocks.strain?;
        let own = strain.axes[1];
        let size = own[1] / rate.iter().fold(f64::MIN_POSITIVE, |most: f64, x| most.max(x.abs()));
        strain.axes = [[0.0; 6]; 6];
        strain.axes[0] = rate.map(|x| x * size);
        strain.axes[1] = own;
        let mut analysis = self.clone();
        analysis.blocks.strain = Some(strain);
        // Stresses of which the work on the rate is 1: any other stress is free, as it has no equation.
        let unit = 1.0 / rate.iter().map(|x| x * x).sum::<f64>();
        let live = rate.map(|x| x * unit);
        let dead = [0.0, -pressure, 0.0, 0.0, 0.0, 0.0];
        let applied = analysis.stressed(&strain, dead, live);
        let limit = match analysis.stands_at_rest(&applied, Level::Multiplier(0.0)) {
            Ok(spent) => analysis.multiplier_beside(&applied, spent),
            Err(limit) => *limit,
        };
        Some(strain.bearing(limit, &live))
    }

    /// Stresses as loads.
    fn stressed(&self, strain: &Strain, dead: Six, live: Six) -> Applied {
        let of = |stresses: Six| {
            let mut wrenches = vec![Wrench::default(); self.blocks.rigid.len()];
            wrenches[strain.body] = strain.load(stresses);
            wrenches
        };
        let down = Vec3::new(0.0, 0.0, -STANDARD_GRAVITY);
        Applied { dead: of(dead), live: of(live), axes: axes(&self.blocks, [down, down]) }
    }
}

impl Strain {
    /// What is borne, with the strain rate of the mechanism.
    fn bearing(&self, limit: Limit, live: &Six) -> Bearing {
        let BlockMotion { velocity, spin } = limit.mechanism.get(self.body).copied().unwrap_or_default();
        let rate = self.rate(&Wrench { force: velocity, moment: spin });
        let power: f64 = rate.iter().zip(live).map(|(rate, live)| rate * live).sum();
        let scale = if power > 0.0 { 1.0 / power } else { 0.0 };
        Bearing { limit, rate: rate.map(|rate| rate * scale) }
    }
}
