//! The explicit solver on named scenes: time per block-step, and how it grows with the number of blocks.
//!
//! `cargo bench --bench explicit`; see `benches/README.md`.

mod record;

use pirca::contact;
use pirca::generate::canonical;
use pirca::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use pirca::math::{Vec3, cos, radians, sin, tan};
use pirca::model::Wall;
use pirca::solve::STANDARD_GRAVITY;
use pirca::solve::explicit::{Settings, Simulation};

use record::Bench;

/// Dry joints: kn 1e9 Pa/m, ks half of it, 30 degrees.
fn law() -> Coulomb {
    Coulomb {
        normal: NormalLaw::Linear { kn: 1e9 },
        ks: 5e8,
        tan_phi: tan(radians(30.0)),
        cohesion: 0.0,
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    }
}

/// A wall at rest on a tilted table: what a step costs in use.
fn tilted_at_rest<'a>(wall: Wall, tilt_deg: f64, law: &'a Coulomb) -> Simulation<'a> {
    let contact = contact::Settings::for_size(0.1, [2, 2]);
    let settings = Settings { unbalanced_ratio: 1e-4, max_steps: 20_000, ..Settings::default() };
    let mut simulation = Simulation::new(&wall.with_base(), law, settings, contact);
    let tilt = radians(tilt_deg);
    simulation.assembly.gravity = Vec3::new(0.0, STANDARD_GRAVITY * sin(tilt), -STANDARD_GRAVITY * cos(tilt));
    simulation.relax(|_| false);
    simulation
}

fn main() {
    let mut bench = Bench::start();
    let law = law();
    // At 8 degrees half of wall_72's bed joints are partly open; wall_4096 is 2.7 m high and falls at 2.4 degrees, so the
    // two scenes that are compared with each other stand at 0.5.
    for (scene, wall, tilt_deg, steps) in [
        ("wall_72", canonical::wall_72(), 8.0, 200),
        ("wall_64", canonical::wall_64(), 0.5, 200),
        ("wall_4096", canonical::wall_4096(), 0.5, 40),
    ] {
        let quantity = "block-steps per second";
        if !bench.wants(scene, &[quantity]) {
            continue;
        }
        let pieces = wall.blocks.len() as u64 * steps;
        let simulation = tilted_at_rest(wall, tilt_deg, &law);
        bench.scene(
            [scene, quantity],
            Some(pieces),
            || simulation.clone(),
            |simulation| (0..steps).for_each(|_| simulation.step()),
        );
    }
    bench.finish();
}
