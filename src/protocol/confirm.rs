//! Is it a collapse? The explicit solver relaxes a wall from its last state at rest, or watches it fall.

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::Direction;
use crate::protocol::mechanism::{Failure, failure};
use crate::protocol::watch::Watch;
use crate::solve::explicit::{self, Simulation};
use crate::solve::{Assembly, Equilibrate, Status};

/// How a suspected collapse is confirmed: by dynamic relaxation from the last state at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Confirmation {
    /// The explicit solver's settings. Damping is low (0.3): at 0.8 a wall near its limit creeps so slowly that it seems
    /// to rest.
    pub explicit: explicit::Settings,
    /// A wall one of whose blocks moves by so much (m) runs away. The relaxation begins a bracket's width below the level
    /// in question, so a wall that stands there hardly moves.
    pub limit: f64,
    /// Number of times that a suspicion may prove wrong before the solver is called lost.
    pub at_most: u32,
}

impl Confirmation {
    /// For a wall of this thickness (m): a wall that moves by a fiftieth of it runs away. Near its limit an elastic block
    /// moves by some 0.4 % of its width from one bracket of 0.01 deg to the next at 2.5e7 Pa/m, and less on stiffer joints.
    pub fn for_thickness(thickness: f64) -> Confirmation {
        let explicit = explicit::Settings { damping: 0.3, ..explicit::Settings::default() };
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

/// Relaxes an assembly, from rest, under gravity and a factor on the dead loads; with the steps that it took.
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
    let mut simulation = Simulation::of(assembly, confirmation.explicit);
    simulation.set_loads(gravity, factor);
    let settled = simulation.settle(&mut |bodies| watch.moved(bodies) > confirmation.limit);
    let ratio = settled.unbalanced_ratio;
    let relaxed = match settled.status {
        Status::Equilibrium => Relaxed::Rest(simulation, ratio),
        Status::Stopped => Relaxed::Away(simulation, ratio),
        Status::StepsSpent | Status::NoEquilibrium => Relaxed::Neither(simulation, ratio),
        Status::NonFinite => Relaxed::NonFinite(simulation),
    };
    (relaxed, settled.steps)
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
