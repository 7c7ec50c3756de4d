//! Is it a collapse? The explicit solver lets a wall go from its last state at rest, and watches it fall.

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::Direction;
use crate::protocol::mechanism::{Failure, failure};
use crate::protocol::watch::Watch;
use crate::solve::explicit::{self, Simulation};
use crate::solve::{Assembly, Equilibrate, Status};

/// A wall that has come back to this share of how far it had gone swings about an equilibrium.
const SWINGS_BACK: f64 = 0.5;

/// How a suspected collapse is confirmed: by the explicit solver from the last state at rest.
///
/// First without damping: local damping takes its force from the rattling of single blocks and so makes a wall near its
/// limit creep (on the canonical wall of 72 stones at 1e9 Pa/m, 0.008 deg above the limit, 2 % of the thickness take 6,000
/// steps without damping, 33,000 at 0.1 and over 60,000 at 0.3). An undamped wall that starts a bracket's width below the
/// level in question overshoots by at most as much again. If it swings back instead of running away, it is relaxed with
/// damping from the same state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Confirmation {
    /// Settings of the damped relaxation.
    pub explicit: explicit::Settings,
    /// A wall one of whose blocks moves by so much (m) runs away; on stiff joints by twice of what the wall has moved since
    /// gravity alone, but not below a tenth of this; on its way to rest under gravity alone, by five times this.
    pub limit: f64,
    /// Number of times that a suspicion may prove wrong before the solver is called lost.
    pub at_most: u32,
}

impl Confirmation {
    /// For a wall of this thickness (m): a wall that moves by a fiftieth of it runs away. Near its limit an elastic block
    /// moves by some 0.3 % of its width from one bracket of 0.01 deg to the next at 2.5e7 Pa/m, and less on stiffer joints.
    /// Damping 0.3, nine tenths of the critical step.
    pub fn for_thickness(thickness: f64) -> Confirmation {
        let explicit = explicit::Settings { damping: 0.3, step_safety: 0.9, ..explicit::Settings::default() };
        Confirmation { explicit, limit: 0.02 * thickness, at_most: 20 }
    }
}

/// What came of a relaxation, with the unbalanced force ratio reached.
pub enum Relaxed<'a> {
    /// It came to rest.
    Rest(Simulation<'a>, f64),
    /// It ran away.
    Away(Simulation<'a>, f64),
    /// The steps ran out.
    Neither(Simulation<'a>, f64),
    /// The numbers went bad.
    NonFinite(Simulation<'a>),
}

/// Finds out what becomes of an assembly, from rest, under gravity and a factor on the dead loads; with the steps that it
/// took.
pub fn relax<'a>(
    from: &Assembly<'a>,
    (gravity, factor): (Vec3, f64),
    confirmation: &Confirmation,
    watch: &Watch,
) -> (Relaxed<'a>, u64) {
    let mut assembly = from.clone();
    for body in &mut assembly.bodies.all {
        body.velocity = Vec3::zeros();
        body.set_spin(Vec3::zeros());
    }
    let released = |damping| {
        let settings = explicit::Settings { damping, ..confirmation.explicit };
        let mut simulation = Simulation::of(assembly.clone(), settings);
        simulation.set_loads(gravity, factor);
        simulation
    };
    let limit = match watch.moved_since_gravity() {
        Some(moved) => (2.0 * moved).clamp(0.1 * confirmation.limit, confirmation.limit),
        None => 5.0 * confirmation.limit,
    };
    let mut free = released(0.0);
    let mut furthest: f64 = 0.0;
    let swung = free.settle(&mut |bodies| {
        let moved = watch.moved(bodies);
        furthest = furthest.max(moved);
        moved > limit || moved < SWINGS_BACK * furthest
    });
    if swung.status == Status::Stopped && watch.moved(&free.assembly.bodies) > limit {
        return (Relaxed::Away(free, swung.unbalanced_ratio), swung.steps);
    }
    let mut damped = released(confirmation.explicit.damping);
    let settled = damped.settle(&mut |bodies| watch.moved(bodies) > limit);
    let ratio = settled.unbalanced_ratio;
    let relaxed = match settled.status {
        Status::Equilibrium => Relaxed::Rest(damped, ratio),
        Status::Stopped => Relaxed::Away(damped, ratio),
        Status::StepsSpent | Status::NoEquilibrium => Relaxed::Neither(damped, ratio),
        Status::NonFinite => Relaxed::NonFinite(damped),
    };
    (relaxed, swung.steps + settled.steps)
}

/// Lets a wall that runs away go as far again, and reads the mechanism off that motion: by then the elastic rebound of what
/// stays has died away. If it is caught on the way, the whole motion since the last state at rest counts.
pub fn watch_fall(
    wall: &Wall,
    at_rest: &Assembly<'_>,
    mut falling: Simulation<'_>,
    watch: &Watch,
    towards: Direction,
) -> Failure {
    let before = falling.assembly.bodies.all.clone();
    let far = 2.0 * watch.moved(&falling.assembly.bodies);
    let settled = falling.settle(&mut |bodies| watch.moved(bodies) > far);
    let after = &falling.assembly.bodies;
    let from = if settled.status == Status::Stopped { &before } else { &at_rest.bodies.all };
    failure(wall, at_rest, from, after, towards)
}
