//! Contact dynamics on named scenes: a tilting test, and steps on a base that shakes.
//!
//! `cargo bench --bench nonsmooth`; see `benches/README.md`.

mod record;

use std::f64::consts::PI;

use pirca::contact;
use pirca::generate::canonical;
use pirca::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use pirca::math::{Vec3, atan, degrees, radians, sin, tan};
use pirca::model::Outcome;
use pirca::protocol::{self, Ends, Protocol, Restraint, Tilting};
use pirca::solve::nonsmooth::{Settings, Simulation};
use pirca::solve::{Equilibrate, STANDARD_GRAVITY, Solver, Status};

use record::Bench;

/// Peak of the base's acceleration (m/s^2) and its frequency (Hz). The wall stands: rigid, it lifts at 0.3 g.
const PEAK: f64 = 0.2 * STANDARD_GRAVITY;
const FREQUENCY: f64 = 3.0;
/// Steps on the base: 0.4 s, more than a cycle.
const STEPS: u64 = 200;

/// Dry joints of 35 degrees: the wall topples long before it slides. Rigid joints have no stiffness.
fn law() -> Coulomb {
    Coulomb {
        normal: NormalLaw::Linear { kn: 1e9 },
        ks: 5e8,
        tan_phi: tan(radians(35.0)),
        cohesion: 0.0,
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    }
}

/// Tilts by half degrees until the wall collapses; the last tilt borne (deg).
fn tilt(law: &Coulomb) -> f64 {
    let protocol =
        Protocol::Tilting(Tilting { step: radians(0.5), bracket: radians(0.0625), ..Tilting::default() });
    let solver = Solver::Nonsmooth(Settings::default());
    let run = protocol::run(
        &canonical::wall_72(),
        law,
        &protocol,
        &Restraint::at_ends(Ends::Free),
        [2, 2],
        &solver,
    );
    let Outcome::Collapsed { at } = run.outcome else { panic!("{:?}", run.outcome) };
    degrees(at.value())
}

/// The wall at rest.
fn at_rest(law: &Coulomb) -> Simulation<'_> {
    let contact = contact::Settings::for_size(0.1, [2, 2]);
    let mut simulation =
        Simulation::new(&canonical::wall_72().with_base(), law, Settings::default(), contact);
    let settled = simulation.settle(&mut |_| false);
    assert_eq!(settled.status, Status::Equilibrium, "{settled:?}");
    simulation
}

/// Steps of 2 ms on a base that shakes out of plane.
fn shaken(simulation: &mut Simulation<'_>) {
    for step in 0..STEPS {
        let time = Settings::default().time_step * step as f64;
        simulation.assembly.gravity =
            Vec3::new(0.0, -PEAK * sin(2.0 * PI * FREQUENCY * time), -STANDARD_GRAVITY);
        let stepped = simulation.step_once();
        assert!(stepped.is_solved, "step {step}: {stepped:?}");
    }
}

fn main() {
    let mut bench = Bench::start();
    let law = law();
    let limit = degrees(atan(canonical::THICKNESS / (9.0 * canonical::COURSE_HEIGHT)));
    let quantity = "tilting test by contact dynamics";
    bench.scene(
        ["wall_72", quantity],
        None,
        || (),
        |()| {
            let angle = tilt(&law);
            assert!((angle - limit).abs() < 0.0625, "{quantity}: {angle} against {limit}");
        },
    );
    let quantity = "block-steps per second on a base that shakes";
    if bench.wants("wall_72", &[quantity]) {
        let simulation = at_rest(&law);
        let pieces = canonical::wall_72().blocks.len() as u64 * STEPS;
        bench.scene(["wall_72", quantity], Some(pieces), || simulation.clone(), shaken);
    }
    bench.finish();
}
