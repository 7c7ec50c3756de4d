//! Stones under synthetic records, on perfect and imperfect bases, by the library's solvers and by the reference of `rocking_block.rs`.

use pirca::math::{Mat3, Vec3, atan, cos, degrees, exp, sin};
use pirca::model::Wall;
use pirca::motion::{Motion, RezaeianDerKiureghian};
use pirca::protocol::{Direction, InTime, LoadPath, Shaking, Verdict, shake};
use pirca::random::{Streams, standard_normal};
use pirca::shape::Plane;
use pirca::solve::nonsmooth;

use crate::fixture::{dry, on_floor, path, resting};
use crate::rocking_block::{Block, Impact, Rocked};

/// Seed of the records and, apart by their names, of the imperfections; a record and its base are one member.
pub const SEED: u64 = 2018;
/// Time followed after a record (s).
const AFTER: f64 = 3.0;
/// A turn below this share of alpha is none.
const RESTS: f64 = 1e-3;
/// Stiffness of joints (Pa/m); contact dynamics takes them for rigid.
pub const KN: f64 = 1e9;
/// What stands for the peak of a stone that overturned, above that of any that did not.
pub const OVERTURNED: f64 = 2.0;

/// How imperfect a base and a stone are; zeros are perfect. Assumed: no measurements stand behind the values in use.
#[derive(Clone, Copy, Debug, Default)]
pub struct Imperfection {
    /// Standard deviation of the slope of the base (rad); stream `slope of the base`.
    pub slope: f64,
    /// Standard deviation of the logarithms of width and height; streams `width of the stone` and `height of the stone`.
    pub size: f64,
    /// Largest share of the half width that does not bear at either end, uniform from 0; streams `bearing in front` and `bearing behind`.
    pub worn: f64,
}

impl Imperfection {
    /// 5 mm/m, 2 %, and up to a tenth at either end.
    pub const ALL: Imperfection = Imperfection { slope: 5e-3, size: 0.02, worn: 0.1 };

    /// The block of a member.
    pub fn of(&self, [b, h]: [f64; 2], member: u64) -> Block {
        let streams = Streams::new(SEED, member);
        let normal = |name: &str| standard_normal::quantile(streams.of(name).uniform());
        let uniform = |name: &str| streams.of(name).uniform();
        let b = b * exp(self.size * normal("width of the stone"));
        let h = h * exp(self.size * normal("height of the stone"));
        let ends = ["bearing in front", "bearing behind"].map(|name| b * (1.0 - self.worn * uniform(name)));
        Block { half: [b, h], ends, slope: self.slope * normal("slope of the base") }
    }
}

/// Record of a member, along y, to a peak ground velocity (m/s). Strong shaking of 6 s about 4 Hz, which falls; the
/// parameters are assumed.
pub fn record(member: u64, pgv: f64) -> Motion {
    let process = RezaeianDerKiureghian {
        arias: 1.0,
        d5_95: 6.0,
        t_mid: 3.5,
        omega_mid: 25.0,
        omega_rate: -1.0,
        zeta: 0.3,
        corner_hz: 0.3,
        duration: 10.0,
        step: 0.01,
    };
    let process = process.process().expect("good parameters");
    let record = process.record(&Streams::new(SEED, member));
    record.along(&Vec3::y()).and_then(|record| record.scaled_to_pgv(pgv)).expect("it shakes")
}

/// The block as the library sees it: worn arrises are cut off at one in two, so that they touch nothing before the block has overturned.
pub fn wall(block: &Block) -> Wall {
    let [b, h] = block.half;
    let mut stone = resting([0.4, 2.0 * b, 2.0 * h], 2400.0);
    for (end, side) in [(0, -1.0), (1, 1.0)] {
        let arris = Plane::through(
            Vec3::new(0.0, side * block.ends[end], 0.0),
            Vec3::new(0.0, 0.5 * side, -1.0).normalize(),
        );
        stone.shape = stone.shape.cut(&arris, 1e-9).0.expect("most of it is left");
    }
    let (s, c) = (sin(block.slope), cos(block.slope));
    let inclined = Mat3::new(1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c);
    let mut wall = on_floor(vec![stone]);
    wall.blocks.iter_mut().for_each(|block| block.shape = block.shape.moved(&inclined, &Vec3::zeros()));
    wall
}

/// Contact dynamics with a step (s).
pub fn contact_dynamics(time_step: f64) -> InTime {
    InTime::Nonsmooth(nonsmooth::Settings { time_step, ..nonsmooth::Settings::default() })
}

/// The block under a motion by one of the library's solvers.
pub fn simulated(block: &Block, motion: &Motion, solver: InTime, kn: f64) -> Rocked {
    let wall = wall(block);
    // No sliding: tan(phi) 3.
    let law = dry(kn, degrees(atan(3.0)));
    let task = path(&wall, &law, LoadPath::tilt(Direction::YPlus, 0.01, 1.0, 1e-4));
    let shaking = Shaking { after: AFTER, ..Shaking::new(motion.clone()) };
    let seen = shake(&task, &shaking, solver);
    assert!(matches!(seen.verdict, Verdict::Stands | Verdict::Collapsed), "{:?}", seen.verdict);
    // One or two steps of a record, about an impact.
    let left = seen.largest_residual;
    assert!(300 * seen.unsolved_steps < seen.steps, "{} of {}: {left:e}", seen.unsolved_steps, seen.steps);
    Rocked { peak: seen.rotation.value, overturned: seen.verdict == Verdict::Collapsed }
}

/// The same by the reference.
pub fn reference(block: &Block, motion: &Motion, impact: Impact) -> Rocked {
    block.shaken(&motion.accelerogram(&Vec3::y()), AFTER, impact)
}

/// Peak turn over the slenderness `alpha = atan(b / h)` of the perfect stone; 0 where it rests, [`OVERTURNED`] where it overturned.
pub fn measure(rocked: Rocked, [b, h]: [f64; 2]) -> f64 {
    let share = rocked.peak / atan(b / h);
    if rocked.overturned {
        return OVERTURNED;
    }
    assert!(share < OVERTURNED, "{share}");
    if share < RESTS { 0.0 } else { share }
}

/// What one of the library's solvers, with joints of a stiffness (Pa/m), makes of members 0 to `n`.
pub fn seen(half: [f64; 2], pgv: f64, own: &Imperfection, (solver, kn): (InTime, f64), n: u64) -> Vec<f64> {
    let of = |member| measure(simulated(&own.of(half, member), &record(member, pgv), solver, kn), half);
    (0..n).map(of).collect()
}

/// What the reference makes of them.
pub fn referred(half: [f64; 2], pgv: f64, imperfection: &Imperfection, impact: Impact, n: u64) -> Vec<f64> {
    let of = |member| measure(reference(&imperfection.of(half, member), &record(member, pgv), impact), half);
    (0..n).map(of).collect()
}

/// Both: contact dynamics with a step (s) first.
pub fn paired(half: [f64; 2], pgv: f64, own: &Imperfection, time_step: f64, n: u64) -> Vec<[f64; 2]> {
    beside(
        &seen(half, pgv, own, (contact_dynamics(time_step), KN), n),
        &referred(half, pgv, own, Impact::Housner, n),
    )
}

/// Two samples as pairs.
pub fn beside(first: &[f64], second: &[f64]) -> Vec<[f64; 2]> {
    first.iter().zip(second).map(|(a, b)| [*a, *b]).collect()
}

/// Which of two measures are of stones that overturned.
pub fn overturned(pairs: &[[f64; 2]]) -> Vec<[bool; 2]> {
    pairs.iter().map(|pair| pair.map(|value| value == OVERTURNED)).collect()
}

/// Ratios of the measures of stones that rocked and did not overturn in either model.
pub fn ratios(pairs: &[[f64; 2]]) -> Vec<f64> {
    let rocked = |pair: &&[f64; 2]| pair.iter().all(|value| *value > 0.0 && *value < OVERTURNED);
    pairs.iter().filter(rocked).map(|[a, b]| a / b).collect()
}
