//! A floor, a block, a law, a simulation: each in one line.

use pirca::contact;
use pirca::generate::{
    Arrangement, BatteredFace, DipAbout, Layout, Limits, Outline, Sizes, Wedges, Wythes, generate,
};
use pirca::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use pirca::math::{Vec3, cos, radians, sin, tan};
use pirca::model::{Block, Wall};
use pirca::protocol::{Changes, Confirmation, Criterion, LoadPath, Task};
use pirca::random::{Family, Streams};
use pirca::shape::Polyhedron;
use pirca::solve::explicit::{Settings, Simulation};
use pirca::solve::{STANDARD_GRAVITY, Solver, Status, implicit};

/// Standard gravity (m/s^2).
pub const G: f64 = STANDARD_GRAVITY;

/// A dry joint: no cohesion, no tension, ks = kn / 2.
pub fn dry(kn: f64, phi_deg: f64) -> Coulomb {
    Coulomb {
        normal: NormalLaw::Linear { kn },
        ks: 0.5 * kn,
        tan_phi: tan(radians(phi_deg)),
        cohesion: 0.0,
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    }
}

/// A free stone.
pub fn stone(shape: Polyhedron, density: f64) -> Block {
    Block::stone(shape, density)
}

/// A box of the given size resting on z = 0, centred on x = y = 0.
pub fn resting(size: [f64; 3], density: f64) -> Block {
    let [x, y, z] = size;
    stone(Polyhedron::cuboid(Vec3::new(-x / 2.0, -y / 2.0, 0.0), Vec3::new(x / 2.0, y / 2.0, z)), density)
}

/// The blocks on a fixed floor.
pub fn on_floor(blocks: Vec<Block>) -> Wall {
    Wall { blocks }.with_base()
}

/// Gravity on a table tilted by `tilt_deg` towards +y: out-of-plane force W sin(alpha).
pub fn tilted(tilt_deg: f64) -> Vec3 {
    let a = radians(tilt_deg);
    Vec3::new(0.0, G * sin(a), -G * cos(a))
}

/// A simulation with the contact tolerances of stones of the given size and 2 x 2 sub-contacts.
pub fn simulation<'a>(wall: &Wall, law: &'a Coulomb, settings: Settings, size: f64) -> Simulation<'a> {
    Simulation::new(wall, law, settings, contact::Settings::for_size(size, [2, 2]))
}

/// A path of any kind for blocks as they are, supports included.
pub fn path<'t>(wall: &'t Wall, law: &'t Coulomb, path: LoadPath) -> Task<'t> {
    Task {
        wall,
        laws: law,
        contact: contact::Settings::for_size(0.2, [2, 2]),
        loads: Vec::new(),
        ties: Vec::new(),
        platform: None,
        changes: Changes::default(),
        path,
        piles: Vec::new(),
        criterion: Criterion::AnyBlock(0.04),
        confirmation: Confirmation::for_thickness(0.4),
    }
}

/// Undamped motion in true time, at a share of the critical step.
pub fn in_time(step_safety: f64) -> Settings {
    Settings { damping: 0.0, scaled_inertia: false, step_safety, ..Settings::default() }
}

/// Tilts slowly in steps until some block moves on by more than `limit` (m), then brackets the angle (deg) to
/// `bracket` by going back to the last stable state with half the step. Gives the last stable and the first unstable angle.
pub fn collapse_angle(
    mut stable: Simulation,
    from_deg: f64,
    step_deg: f64,
    bracket: f64,
    limit: f64,
) -> [f64; 2] {
    let at_rest: Vec<Vec3> = stable.assembly.bodies.all.iter().map(|b| b.position).collect();
    let (mut angle, mut step) = (from_deg, step_deg);
    loop {
        let mut next = stable.clone();
        next.assembly.gravity = tilted(angle + step);
        let (status, _) = next.relax(|bodies| {
            bodies.all.iter().zip(&at_rest).any(|(b, rest)| (b.position - rest).norm() > limit)
        });
        if status == Status::Equilibrium {
            stable = next;
            angle += step;
        } else if step <= bracket {
            return [angle, angle + step];
        } else {
            step *= 0.5;
        }
        assert!(angle < 89.0, "nothing collapses");
    }
}

/// An irregular wall on its base, beds leaning both ways, with wedges in it; 2 x 1 m are some thirty stones.
pub fn irregular(member: u64, length: f64, height: f64) -> Wall {
    cut(member, [length, height], Family::Uniform { low: radians(-10.0), high: radians(10.0) }, true)
}

/// The same with another dip of its joints (rad), with or without wedges.
pub fn cut(member: u64, size: [f64; 2], dip: Family, wedges: bool) -> Wall {
    built(member, &layout(size, dip, wedges))
}

/// A wall of a layout, on its base.
pub fn built(member: u64, layout: &Layout) -> Wall {
    generate(layout, &Streams::new(7, member)).expect("a wall comes out").wall.with_base()
}

/// How such walls are laid out.
pub fn layout([length, height]: [f64; 2], dip: Family, wedges: bool) -> Layout {
    Layout {
        outline: Outline {
            length,
            height,
            base_thickness: 0.45,
            top_thickness: 0.25,
            battered_face: BatteredFace::Front,
        },
        arrangement: Arrangement::Cut {
            sizes: Sizes::Apart {
                length: Family::TruncatedNormal { mean: 0.4, sd: 0.08, low: 0.2, high: 0.6 },
                height: Family::TruncatedNormal { mean: 0.2, sd: 0.03, low: 0.1, high: 0.3 },
            },
            wall_size_factor: Family::Lognormal { mean: 1.0, sd: 0.1 },
            dip,
            dip_about: DipAbout::Both,
        },
        density: Family::Normal { mean: 2400.0, sd: 50.0 },
        wythes: Wythes { count: 1, header_share: 0.0 },
        head_joint_gap: 0.0,
        wedges: wedges.then_some(Wedges {
            share: 0.2,
            height: Family::Uniform { low: 0.02, high: 0.05 },
            depth: Family::Uniform { low: 0.05, high: 0.12 },
        }),
        limits: Limits {
            min_size: 0.03,
            max_aspect: 8.0,
            min_volume: 1e-6,
            max_redraws: 100,
            max_attempts: 20,
        },
    }
}

/// Size (m) of a block of 2400 kg/m3, the area (m2) it stands on and its weight (N).
pub const SIZE: [f64; 3] = [0.3, 0.4, 0.2];
pub const AREA: f64 = 0.3 * 0.4;
pub const WEIGHT: f64 = AREA * 0.2 * 2400.0 * G;

/// Both elastic solvers, as exact as closed forms are checked by.
pub fn solvers() -> [Solver; 2] {
    let exact = implicit::Settings { unbalanced_ratio: 1e-10, ..implicit::Settings::default() };
    let slow = Settings { unbalanced_ratio: 1e-9, ..Settings::default() };
    [Solver::Implicit(exact), Solver::Explicit(slow)]
}
