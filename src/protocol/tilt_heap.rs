//! A tilting table under bodies made of spheres.

use crate::math::Vec3;
use crate::model::{Heap, Level, Outcome};
use crate::protocol::path::LoadPath;
use crate::protocol::route::Route;
use crate::solve::bodies::Body;
use crate::solve::grains::{self, Simulation};
use crate::solve::{Settled, Status};

/// A reading at rest.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct HeapStep {
    /// Tilt (rad).
    pub tilt: f64,
    /// Largest way of a body since rest on the level table (m).
    pub moved: f64,
    /// Cycles that it took from the last tilt borne.
    pub cycles: u64,
    /// Contacts that carry.
    pub contacts: usize,
}

/// What came of a heap on a tilting table.
#[derive(Clone, Debug, PartialEq)]
pub struct TiltedHeap {
    /// How it ended. [`Outcome::NotConverged`]: it stirred without going away, and would not come to rest.
    pub outcome: Outcome,
    /// Last tilt borne and first one not borne (rad), where it fell.
    pub bracket: Option<[f64; 2]>,
    /// The states at rest, by tilt.
    pub steps: Vec<HeapStep>,
    /// Cycles in all, those of tilts that were not borne included.
    pub cycles: u64,
}

/// Lets a heap come to rest under gravity, and turns gravity in steps as [`run`](crate::protocol::run) does with a wall of
/// polyhedra: after a failure back to the last tilt borne and half the step, until the angle is bracketed.
///
/// The path is that of a tilt, see [`LoadPath::tilt`](crate::protocol::LoadPath::tilt); the load is not let back on the way. A heap has fallen when a body has moved by
/// `runaway` (m) since the last state at rest; it is at rest when the unbalanced force ratio is below `rest_ratio`.
pub fn tilt_heap(
    heap: &Heap,
    settings: grains::Settings,
    path: &LoadPath,
    rest_ratio: f64,
    runaway: f64,
) -> TiltedHeap {
    let mut route = Route::new(*path);
    let mut rest = Simulation::new(heap, settings);
    let mut tilted =
        TiltedHeap { outcome: Outcome::Equilibrium, bracket: None, steps: Vec::new(), cycles: 0 };
    let settled = settle(&mut rest, path, 0.0, rest_ratio, runaway);
    tilted.cycles += settled.steps;
    if settled.status != Status::Equilibrium {
        tilted.outcome = match settled.status {
            Status::Stopped => Outcome::UnstableAtRest,
            _ => unsettled(&settled, path.level(0.0)),
        };
        return tilted;
    }
    let level: Vec<Vec3> = rest.grains.bodies.iter().map(|body| body.position).collect();
    let read = |simulation: &Simulation, tilt: f64, cycles: u64| HeapStep {
        tilt,
        moved: farthest(&simulation.grains.bodies, &level),
        cycles,
        contacts: simulation.grains.contact_count(),
    };
    tilted.steps.push(read(&rest, 0.0, settled.steps));
    let mut borne = 0.0;
    while let Some(place) = route.next() {
        let tilt = path.after(place);
        let mut next = rest.clone();
        let settled = settle(&mut next, path, tilt, rest_ratio, runaway);
        tilted.cycles += settled.steps;
        match settled.status {
            Status::Equilibrium => {
                tilted.steps.push(read(&next, tilt, settled.steps));
                rest = next;
                borne = tilt;
                route.borne(place);
            }
            Status::Stopped => {
                if route.failed(place) {
                    tilted.outcome = Outcome::Collapsed { at: path.level(borne) };
                    tilted.bracket = Some([borne, tilt]);
                    break;
                }
            }
            _ => {
                tilted.outcome = unsettled(&settled, path.level(tilt));
                break;
            }
        }
    }
    tilted
}

/// Steps at a tilt from where the bodies are, until rest, runaway or the end of the steps.
fn settle(simulation: &mut Simulation, path: &LoadPath, tilt: f64, rest_ratio: f64, runaway: f64) -> Settled {
    simulation.grains.gravity = path.loads(tilt).0;
    for body in &mut simulation.grains.bodies {
        body.velocity = Vec3::zeros();
        body.set_spin(Vec3::zeros());
    }
    let from: Vec<Vec3> = simulation.grains.bodies.iter().map(|body| body.position).collect();
    simulation.settle(rest_ratio, &mut |bodies| farthest(bodies, &from) > runaway)
}

/// Largest distance of a body from where it was (m).
fn farthest(bodies: &[Body], from: &[Vec3]) -> f64 {
    bodies.iter().zip(from).map(|(body, from)| (body.position - from).norm()).fold(0.0, f64::max)
}

fn unsettled(settled: &Settled, at: Level) -> Outcome {
    match settled.status {
        Status::NonFinite => Outcome::NonFinite { at },
        _ => Outcome::NotConverged {
            at,
            unbalanced_ratio: settled.unbalanced_ratio,
            why: "the heap neither fell nor came to rest in the steps that it had".to_owned(),
        },
    }
}
