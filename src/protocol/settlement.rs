//! Supports that go down under a wall at rest, before its load grows.

use crate::protocol::Task;
use crate::protocol::confirm::{Judge, Told};
use crate::protocol::fallen::has_fallen;
use crate::protocol::watch::Watch;
use crate::solve::bodies::Bodies;
use crate::solve::explicit::{self, Simulation};
use crate::solve::{Assembly, Equilibrate, Status};

/// A support goes down by this share of the reach of the contact search at a time: what stands on it comes after it softly.
const AT_A_TIME: f64 = 0.1;

/// A fixed block that goes down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settlement {
    /// The block; all parts of a stone go with it.
    pub block: usize,
    /// How far (m).
    pub down: f64,
}

/// How far the supports have gone under a wall.
pub(super) struct Settled<'a, S> {
    /// The last state at rest.
    pub rest: S,
    /// The share of the way to there.
    pub share: f64,
    /// What became of the wall on the way to the next share, and which that is; `None` where it came to rest at the end.
    pub ended: Option<(f64, Told<'a>)>,
    /// Steps of the solver.
    pub spent: u64,
}

/// Lets the supports of a wall at rest down, all in the same steps, to rest after each. Where Newton's method finds no rest, the
/// explicit solver goes that step.
pub(super) fn settle_supports<'a, S: Equilibrate<'a>>(
    task: &Task<'a>,
    (of, judge): (&dyn Fn(Assembly<'a>) -> S, &Judge<'_, 'a>),
    watch: &mut Watch,
    mut rest: S,
) -> Settled<'a, S> {
    let settlements = &task.changes.settlements;
    let furthest = settlements.iter().map(|of| of.down).fold(0.0, f64::max);
    let steps = (furthest / (AT_A_TIME * task.contact.reach)).ceil() as u32;
    let (mut share, mut spent) = (0.0, 0);
    for step in 1..=steps {
        let next = f64::from(step) / f64::from(steps);
        let down: Vec<(usize, f64)> =
            settlements.iter().map(|of| (of.block, (next - share) * of.down)).collect();
        let mut stop = |bodies: &Bodies| watch.runs_away(bodies);
        let mut tried = rest.clone();
        let mut settled = tried.lower(&down, &mut stop);
        spent += settled.steps;
        if settled.status == Status::NoEquilibrium {
            let mut assembly = rest.assembly().clone();
            assembly.bodies.stop();
            let mut relaxed = Simulation::of(assembly, explicit::Settings::default());
            settled = relaxed.lower(&down, &mut stop);
            spent += settled.steps;
            tried = of(relaxed.assembly);
        }
        let is_at_rest = settled.status == Status::Equilibrium;
        if is_at_rest && has_fallen(task.wall, rest.assembly(), tried.assembly()) {
            settled.status = Status::Stopped;
        }
        let told = match settled.status {
            Status::Equilibrium => {
                (rest, share) = (tried, next);
                watch.rests(&rest.assembly().bodies);
                continue;
            }
            Status::Stopped => {
                let away = tried.assembly().clone();
                Told::Falls(Box::new(judge.fall(rest.assembly(), away, watch, 0.0, settled.unbalanced_ratio)))
            }
            Status::NonFinite => Told::NonFinite(Box::new(tried.assembly().clone())),
            Status::StepsSpent | Status::NoEquilibrium => Told::Nothing,
        };
        return Settled { rest, share, ended: Some((next, told)), spent };
    }
    Settled { rest, share, ended: None, spent }
}
