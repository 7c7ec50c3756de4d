//! An assembly without a wall's outline: gravity, then a horizontal acceleration; does it stand?

use crate::contact;
use crate::math::Vec3;
use crate::model::{Heap, JointLaws, Wall};
use crate::protocol::typical_size;
use crate::solve::bodies::Body;
use crate::solve::{Equilibrate, STANDARD_GRAVITY, Settled, Status, explicit, grains};

/// What is done to an assembly, and when it is at rest or gone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shove {
    /// Horizontal acceleration along y (m/s^2).
    pub acceleration: f64,
    /// Unbalanced force ratio whose first undershooting is counted.
    pub coarse_ratio: f64,
    /// Unbalanced force ratio below which it is at rest.
    pub fine_ratio: f64,
    /// Way of an element in the plane (m) at which the assembly has fallen.
    pub runaway: f64,
}

/// What became of an assembly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stand {
    /// At rest under gravity and under the horizontal acceleration.
    Stands,
    /// An element ran away under gravity.
    FallsUnderGravity,
    /// An element ran away under the horizontal acceleration.
    FallsSideways,
    /// The steps were spent under gravity, and it was not at rest.
    StirsUnderGravity,
    /// The steps were spent under the horizontal acceleration, and it was not at rest.
    StirsSideways,
    /// A position became NaN or infinite.
    NonFinite,
}

impl Stand {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Stand::Stands => "stands",
            Stand::FallsUnderGravity => "falls_under_gravity",
            Stand::FallsSideways => "falls_sideways",
            Stand::StirsUnderGravity => "stirs_under_gravity",
            Stand::StirsSideways => "stirs_sideways",
            Stand::NonFinite => "non_finite",
        }
    }
}

/// What happened under one load.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Phase {
    /// Cycles until the unbalanced force ratio first fell below the coarse one; `None` if it never did.
    #[serde(rename = "cycles_to_coarse")]
    pub to_coarse: Option<u64>,
    /// The same for the fine one.
    #[serde(rename = "cycles_to_fine")]
    pub to_fine: Option<u64>,
    /// Cycles taken.
    pub cycles: u64,
    /// Largest way of an element in the plane (m).
    #[serde(rename = "moved_m")]
    pub moved: f64,
    /// Unbalanced force ratio at the end; `None` where a position had become NaN or infinite.
    pub unbalanced_ratio: Option<f64>,
}

/// What happened to an assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Shoved {
    /// What became of it.
    pub stand: Stand,
    /// Under gravity, and under the horizontal acceleration if it came to that.
    pub phases: Vec<Phase>,
    /// Time step at the end of gravity (s).
    pub time_step: f64,
    /// Joints or contacts that carry at the end.
    pub contacts: usize,
}

/// Shoves bodies made of spheres.
pub fn shove_heap(heap: &Heap, settings: grains::Settings, shove: &Shove) -> Shoved {
    shoved(&mut grains::Simulation::new(heap, settings), shove)
}

/// Shoves polyhedra, with `sub_contacts` of a joint along its two in-plane axes.
pub fn shove_wall(
    wall: &Wall,
    laws: &dyn JointLaws,
    sub_contacts: [u32; 2],
    settings: explicit::Settings,
    shove: &Shove,
) -> Shoved {
    let contact = contact::Settings::for_size(typical_size(wall), sub_contacts);
    shoved(&mut explicit::Simulation::new(wall, laws, settings, contact), shove)
}

/// A simulation of either kind of elements.
trait Elements {
    fn set_gravity(&mut self, gravity: Vec3);
    fn settle_to(&mut self, ratio: f64, stop: &mut dyn FnMut(&[Body]) -> bool) -> Settled;
    fn bodies(&self) -> &[Body];
    fn time_step(&self) -> f64;
    fn contacts(&self) -> usize;
}

impl Elements for grains::Simulation {
    fn set_gravity(&mut self, gravity: Vec3) {
        self.grains.gravity = gravity;
    }

    fn settle_to(&mut self, ratio: f64, stop: &mut dyn FnMut(&[Body]) -> bool) -> Settled {
        self.settle(ratio, stop)
    }

    fn bodies(&self) -> &[Body] {
        &self.grains.bodies
    }

    fn time_step(&self) -> f64 {
        self.dt
    }

    fn contacts(&self) -> usize {
        self.grains.contact_count()
    }
}

impl Elements for explicit::Simulation<'_> {
    fn set_gravity(&mut self, gravity: Vec3) {
        self.set_loads(gravity, 1.0);
    }

    fn settle_to(&mut self, ratio: f64, stop: &mut dyn FnMut(&[Body]) -> bool) -> Settled {
        self.settle_below(ratio, &mut |bodies| stop(&bodies.all))
    }

    fn bodies(&self) -> &[Body] {
        &self.assembly.bodies.all
    }

    fn time_step(&self) -> f64 {
        self.dt
    }

    fn contacts(&self) -> usize {
        self.assembly.joints.all.iter().filter(|joint| joint.force > 0.0).count()
    }
}

fn shoved(elements: &mut impl Elements, shove: &Shove) -> Shoved {
    let down = Vec3::new(0.0, 0.0, -STANDARD_GRAVITY);
    let (resting, gravity) = under(elements, down, shove);
    let time_step = elements.time_step();
    let mut phases = vec![gravity];
    let stand = match resting {
        Status::Equilibrium => {
            let (resting, sideways) = under(elements, down + Vec3::y() * shove.acceleration, shove);
            phases.push(sideways);
            match resting {
                Status::Equilibrium => Stand::Stands,
                Status::Stopped => Stand::FallsSideways,
                Status::NonFinite => Stand::NonFinite,
                _ => Stand::StirsSideways,
            }
        }
        Status::Stopped => Stand::FallsUnderGravity,
        Status::NonFinite => Stand::NonFinite,
        _ => Stand::StirsUnderGravity,
    };
    Shoved { stand, phases, time_step, contacts: elements.contacts() }
}

/// One load until rest, runaway or the end of the steps.
fn under(elements: &mut impl Elements, gravity: Vec3, shove: &Shove) -> (Status, Phase) {
    elements.set_gravity(gravity);
    let from: Vec<Vec3> = elements.bodies().iter().map(|b| b.position).collect();
    let moved = |bodies: &[Body]| {
        let way = |(body, from): (&Body, &Vec3)| (body.position - from).xy().norm();
        bodies.iter().zip(&from).map(way).fold(0.0, f64::max)
    };
    let mut stop = |bodies: &[Body]| moved(bodies) > shove.runaway;
    let coarse = elements.settle_to(shove.coarse_ratio, &mut stop);
    let to_coarse = (coarse.status == Status::Equilibrium).then_some(coarse.steps);
    let mut ended = coarse;
    if to_coarse.is_some() {
        ended = elements.settle_to(shove.fine_ratio, &mut stop);
        ended.steps += coarse.steps;
    }
    let at_rest = to_coarse.is_some() && ended.status == Status::Equilibrium;
    let phase = Phase {
        to_coarse,
        to_fine: at_rest.then_some(ended.steps),
        cycles: ended.steps,
        moved: moved(elements.bodies()),
        unbalanced_ratio: Some(ended.unbalanced_ratio).filter(|ratio| ratio.is_finite()),
    };
    (ended.status, phase)
}
