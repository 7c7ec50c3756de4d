//! Is it a collapse? Limit analysis says whether the wall can stand at all; the explicit solver relaxes it from its last
//! state at rest, and watches it fall.

use std::cell::OnceCell;

use crate::protocol::mechanism::{Failure, failure};
use crate::protocol::undecided::loads;
use crate::protocol::watch::{LoadStep, Watch};
use crate::protocol::{Changes, Task};
use crate::solve::bodies::Bodies;
use crate::solve::explicit::{self, Simulation};
use crate::solve::limit::{self, Analysis};
use crate::solve::{Assembly, Equilibrate, Status, nonsmooth};

/// A wall that has come back to this share of how far it had gone swings about an equilibrium.
const SWINGS_BACK: f64 = 0.5;

/// How a suspected collapse is confirmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Confirmation {
    /// The explicit solver's settings. Damping is low (0.3): at 0.8 a wall near its limit creeps so slowly that it seems
    /// to rest.
    pub explicit: explicit::Settings,
    /// A wall one of whose blocks moves by so much (m) runs away; of thicker [piles](Task::piles) by as much more.
    pub limit: f64,
}

impl Confirmation {
    /// For a wall of this thickness (m): a wall that moves by a fifth of it runs away, twice as far as a wall is let go by
    /// the criterion of a tilting table. Undamped, a wall that stands swings twice as far as it would move at rest.
    pub fn for_thickness(thickness: f64) -> Confirmation {
        let explicit = explicit::Settings {
            damping: 0.3,
            step_safety: 0.9,
            max_steps: 20_000,
            ..explicit::Settings::default()
        };
        Confirmation { explicit, limit: 0.2 * thickness }
    }
}

/// A wall that falls at a level. How it does is [asked](Judge::failure) of the fall that ends the test alone: it takes longer
/// to watch a wall fall than to tell that it does.
pub struct Fall<'a> {
    /// The level (SI units).
    pub level: f64,
    /// Whether limit analysis says so: an upper bound, where a relaxation may have been thrown off its balance by the step.
    pub by_bound: bool,
    /// What was read while it fell.
    pub step: LoadStep,
    /// The last state at rest.
    at_rest: Assembly<'a>,
    /// The wall when it had run away.
    pub away: Assembly<'a>,
}

/// What could be told of a level.
pub enum Told<'a> {
    /// The wall falls.
    Falls(Box<Fall<'a>>),
    /// It comes to rest, with the unbalanced force ratio reached.
    Rests(Box<Assembly<'a>>, f64),
    /// The numbers went bad.
    NonFinite(Box<Assembly<'a>>),
    /// Neither.
    Nothing,
}

/// Tells walls that fall from solvers that have lost their way.
pub struct Judge<'t, 'a> {
    task: &'t Task<'a>,
    /// Limit analysis of the wall as built; `None` where it says nothing, as it does not stand as built.
    rigid: OnceCell<Option<Analysis>>,
}

impl<'t, 'a> Judge<'t, 'a> {
    /// Of a wall's task.
    pub fn new(task: &'t Task<'a>) -> Self {
        Judge { task, rigid: OnceCell::new() }
    }

    /// Whether the wall stands at a level, coming from a state at rest at another one, `since`. Limit analysis of the wall as built can say no: an
    /// upper bound on what it bears, so that no arrangement of forces keeps it up. Else the explicit solver lets it go: first
    /// without damping, and if it swings back instead of running away, with damping from the same state.
    ///
    /// Local damping takes its force from the rattling of single blocks, and so makes a wall near its limit creep: on the
    /// canonical wall of 72 stones at 1e9 Pa/m, 0.008 deg above the limit, 2 % of the thickness take 6,000 steps without
    /// damping, 33,000 at 0.1 and over 60,000 at 0.3. An undamped wall overshoots by at most the step that led there.
    ///
    /// Without damping friction can also set a wall swinging that stands when it is damped. When it matters (`is_final`)
    /// a damped run may therefore contradict; one that creeps to the end of its steps does not.
    pub fn told(
        &self,
        from: &Assembly<'a>,
        (since, level): (f64, f64),
        watch: &Watch,
        is_final: bool,
        spent: &mut u64,
    ) -> Told<'a> {
        if let Some(fall) = self.cannot_stand(from, level, watch) {
            return Told::Falls(Box::new(fall));
        }
        let Confirmation { explicit, limit } = self.task.confirmation;
        let mut assembly = from.clone();
        assembly.bodies.stop();
        self.task.changes.apply(&mut assembly, since, level);
        let released = |damping| {
            let mut simulation = Simulation::of(assembly.clone(), explicit::Settings { damping, ..explicit });
            let (gravity, factor) = self.task.path.loads(level);
            simulation.set_loads(gravity, factor);
            simulation
        };
        let mut thrown = None;
        // Under gravity alone a soft wall sinks by as much as counts as running away, and without damping by twice that.
        if level > 0.0 {
            let mut free = released(0.0);
            let mut furthest: f64 = 0.0;
            let swung = free.settle(&mut |bodies| {
                let moved = watch.strayed(bodies);
                furthest = furthest.max(moved);
                moved > limit || moved < SWINGS_BACK * furthest
            });
            *spent += swung.steps;
            if swung.status == Status::Stopped && watch.strayed(&free.assembly.bodies) > limit {
                let ratio = swung.unbalanced_ratio;
                let fall = Box::new(self.fall(from, free.assembly, watch, level, ratio));
                if !is_final {
                    return Told::Falls(fall);
                }
                thrown = Some(fall);
            }
        }
        let mut simulation = released(explicit.damping);
        let settled = simulation.settle(&mut |bodies| watch.strayed(bodies) > limit);
        *spent += settled.steps;
        let ratio = settled.unbalanced_ratio;
        match settled.status {
            Status::Equilibrium => Told::Rests(Box::new(simulation.assembly), ratio),
            Status::Stopped => {
                Told::Falls(Box::new(self.fall(from, simulation.assembly, watch, level, ratio)))
            }
            Status::StepsSpent | Status::NoEquilibrium => {
                let fall = thrown.or_else(|| self.falls_rigid(from, (&assembly, level), watch));
                fall.map_or(Told::Nothing, Told::Falls)
            }
            Status::NonFinite => Told::NonFinite(Box::new(simulation.assembly)),
        }
    }

    /// How the wall falls at a level as rigid blocks that do not dilate, if they run away there. Where joints are stiff relaxation goes by steps so
    /// short that a slow fall takes a million of them; contact dynamics goes by some milliseconds. Joints that give way bear no more than
    /// rigid ones. That rigid blocks come to rest, or that steps are not solved, says nothing.
    fn falls_rigid(
        &self,
        from: &Assembly<'a>,
        (assembly, level): (&Assembly<'a>, f64),
        watch: &Watch,
    ) -> Option<Box<Fall<'a>>> {
        let mut rigid = assembly.clone();
        rigid.bodies.all.iter_mut().for_each(|body| body.rescale(1.0));
        rigid.bodies.stop();
        let mut simulation = nonsmooth::Simulation::of(rigid, nonsmooth::Settings::default());
        let (gravity, factor) = self.task.path.loads(level);
        simulation.set_loads(gravity, factor);
        let limit = self.task.confirmation.limit;
        let settled = simulation.settle(&mut |bodies| watch.moved(bodies) > limit);
        if settled.status != Status::Stopped {
            return None;
        }
        let away = simulation.assembly;
        Some(Box::new(self.fall(from, away, watch, level, settled.unbalanced_ratio)))
    }

    /// How the wall falls at a level where limit analysis finds that it cannot stand.
    pub(super) fn cannot_stand(&self, from: &Assembly<'a>, level: f64, watch: &Watch) -> Option<Fall<'a>> {
        let stands = |analysis: &Analysis, level: f64| analysis.stands(&loads(self.task, level));
        let rigid = self.rigid.get_or_init(|| {
            let Task { wall, laws, contact, .. } = *self.task;
            // The bound is that of the wall with all its blocks where they were built.
            let Changes { loss, settlements, .. } = &self.task.changes;
            if loss.is_some() || !settlements.is_empty() {
                return None;
            }
            let analysis = Analysis::new(wall, laws, contact, limit::Settings::default());
            let analysis = analysis.with_ties(&self.task.ties);
            (stands(&analysis, 0.0).stands == Some(true)).then_some(analysis)
        });
        let standing = stands(rigid.as_ref()?, level);
        if standing.stands != Some(false) {
            return None;
        }
        let mut away = from.clone();
        for (body, motion) in away.bodies.all.iter_mut().zip(&standing.mechanism) {
            // The mechanism comes as velocities, the fastest 1 m/s: as far as a wall that runs away.
            let limit = self.task.confirmation.limit;
            let here = body.clone();
            body.place(&here, &(motion.velocity * limit), &(motion.spin * limit));
        }
        Some(Fall { by_bound: true, ..self.fall(from, away, watch, level, f64::NAN) })
    }

    /// A wall that has run away since it was at rest.
    pub fn fall(
        &self,
        at_rest: &Assembly<'a>,
        away: Assembly<'a>,
        watch: &Watch,
        level: f64,
        ratio: f64,
    ) -> Fall<'a> {
        let step = watch.read(&away.bodies, self.task.path.level(level), ratio, 0);
        Fall { level, by_bound: false, step, at_rest: at_rest.clone(), away }
    }

    /// How a wall falls: by the mechanism of limit analysis, or as it is [seen](watch_fall) to.
    pub fn failure(&self, fall: &Fall<'a>, watch: &Watch) -> Failure {
        let Fall { at_rest, away, .. } = fall;
        if fall.by_bound {
            let towards = self.task.path.direction();
            return failure(self.task.wall, at_rest, &at_rest.bodies.all, &away.bodies, towards);
        }
        let simulation = Simulation::of(away.clone(), self.task.confirmation.explicit);
        watch_fall(self.task, at_rest, simulation, watch)
    }
}

/// Lets a wall that runs away go as far again, and reads the mechanism off that motion: by then the elastic rebound of what
/// stays has died away. If it is caught on the way, the whole motion since the last state at rest counts.
pub fn watch_fall<'a>(
    task: &Task<'_>,
    at_rest: &Assembly<'_>,
    mut falling: impl Equilibrate<'a>,
    watch: &Watch,
) -> Failure {
    let before = falling.assembly().bodies.all.clone();
    let moved = |bodies: &Bodies| watch.strayed_between(&at_rest.bodies, bodies);
    let far = 2.0 * moved(&falling.assembly().bodies);
    let settled = falling.settle(&mut |bodies| moved(bodies) > far);
    let after = &falling.assembly().bodies;
    let from = if settled.status == Status::Stopped { &before } else { &at_rest.bodies.all };
    failure(task.wall, at_rest, from, after, task.path.direction())
}
