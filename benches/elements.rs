//! Types of elements on named scenes: cycles per second of the solver of grains and of the explicit solver of polyhedra,
//! and the time to rest.
//!
//! `cargo bench --bench elements`; see `benches/README.md`.

mod record;

use pirca::contact;
use pirca::generate::elements::{Elements, Shapes};
use pirca::law::{CohesionAfterSlip, Coulomb, Frictional, NormalLaw, Sampling};
use pirca::math::{radians, tan};
use pirca::model::{Block, Heap, Wall};
use pirca::random::Streams;
use pirca::solve::explicit;
use pirca::solve::grains::{Settings, Simulation};

use record::Bench;

/// Side of the cube that the elements fill (m).
const SIDE: f64 = 0.4;
const DENSITY: f64 = 2400.0;
/// Cycles of one iteration.
const CYCLES: u64 = 1000;
const CYCLES_PER_SECOND: &str = "cycles per second";

fn fill(elements: &Elements) -> Shapes {
    elements.fill(SIDE, &Streams::new(1, 0)).expect("nothing here is random")
}

/// The first `count` grains of an assembly, lowest layer first, at rest and then pushed sideways by 1 m/s^2.
fn pushed(elements: &Elements, count: usize) -> Simulation {
    let Shapes::Balls(mut clumps) = fill(elements) else { panic!("these scenes are made of balls") };
    clumps.truncate(count);
    let material = Frictional { young: 3.07e10, ks_over_kn: 0.5, phi: radians(30.0) };
    let mut simulation = Simulation::new(&Heap::on_ground(clumps, DENSITY, material), Settings::default());
    simulation.settle(1e-3, &mut |_| false);
    simulation.grains.gravity.y = 1.0;
    (0..CYCLES).for_each(|_| simulation.step());
    simulation
}

/// Polyhedra as they are laid, in true time.
fn laid<'a>(elements: &Elements, law: &'a Coulomb) -> explicit::Simulation<'a> {
    let Shapes::Polyhedra(solids) = fill(elements) else { panic!("these scenes are made of polyhedra") };
    let block = |shape| Block::stone(shape, DENSITY);
    let wall = Wall { blocks: solids.into_iter().map(block).collect() }.with_base();
    let settings = explicit::Settings {
        unbalanced_ratio: 1e-3,
        scaled_inertia: false,
        longest_step: 1e-4,
        ..explicit::Settings::default()
    };
    explicit::Simulation::new(&wall, law, settings, contact::Settings::for_size(0.16, [2, 2]))
}

/// Dry joints as stiff per area as spheres of 3.07e10 Pa with a radius of 0.067 m.
fn law() -> Coulomb {
    Coulomb {
        normal: NormalLaw::Linear { kn: 1.15e11 },
        ks: 5.75e10,
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

fn cycles_of_grains(bench: &mut Bench) {
    for (scene, elements, count) in [
        ("16 spheres", Elements::AlignedSpheres { along: [2, 2, 4] }, 16),
        ("16 clumps of 4", Elements::MeshClumps { along: [2, 2, 4], across: 2 }, 16),
        ("72 clumps of 8", Elements::CompactClumps { along: [6, 6, 6], across: 2 }, 72),
    ] {
        if !bench.wants(scene, &[CYCLES_PER_SECOND]) {
            continue;
        }
        let simulation = pushed(&elements, count);
        assert_eq!(simulation.grains.bodies.len(), count);
        bench.scene(
            [scene, CYCLES_PER_SECOND],
            Some(CYCLES),
            || simulation.clone(),
            |simulation| (0..CYCLES).for_each(|_| simulation.step()),
        );
    }
}

fn polyhedra(bench: &mut Bench) {
    let law = law();
    let simulation = laid(&Elements::Blocks { along: [2, 2, 4] }, &law);
    let scene = "16 polyhedra";
    bench.scene(
        [scene, "time to 0.1 % unbalanced force under gravity"],
        None,
        || simulation.clone(),
        |simulation| simulation.relax(|_| false),
    );
    let mut pushed = simulation.clone();
    pushed.relax(|_| false);
    pushed.assembly.gravity.y = 1.0;
    bench.scene(
        [scene, CYCLES_PER_SECOND],
        Some(CYCLES),
        || pushed.clone(),
        |simulation| (0..CYCLES).for_each(|_| simulation.step()),
    );
}

fn main() {
    let mut bench = Bench::start();
    cycles_of_grains(&mut bench);
    polyhedra(&mut bench);
    bench.finish();
}
