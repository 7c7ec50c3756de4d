//! Single stones against closed forms by both solvers in time, as the table of `studies/rocking/README.md`:
//!
//!     cargo test --release --test physics -- --ignored --nocapture --test-threads 1 rocking_closed_forms

use std::f64::consts::PI;

use crate::base_motion::{across, block, frequency, let_go, nonsmooth, shaken};
use crate::fixture::{G, dry, on_floor, resting};
use pirca::contact;
use pirca::math::{acos, atan, cos, degrees, exp};
use pirca::motion::Pulse;
use pirca::protocol::{InTime, Shaking, Verdict};
use pirca::solve::explicit::{self, Rayleigh};
use pirca::solve::nonsmooth::{Settings, Simulation};

/// Elastic joints so stiff (Pa/m) that a stone turns about its edge.
const STIFF: f64 = 1e12;

fn elastic() -> InTime {
    InTime::Explicit(explicit::Settings::default(), Rayleigh::default())
}

/// The least amplitude (m/s^2) about the one that is wanted at which a pulse overturns a block.
fn overturns_at([b, h]: [f64; 2], wanted: f64, pulse: impl Fn(f64) -> Pulse, solver: InTime) -> f64 {
    let wall = block(b, h);
    let law = dry(STIFF, degrees(atan(3.0)));
    let [mut low, mut high] = [0.8 * wanted, 1.02 * wanted];
    while high - low > 1e-4 * wanted {
        let middle = 0.5 * (low + high);
        let shaking = Shaking { after: 4.0, ..Shaking::new(across(pulse(middle))) };
        let has_fallen = shaken(&wall, &law, &shaking, solver).verdict == Verdict::Collapsed;
        if has_fallen { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

#[test]
#[ignore = "slow: half a minute, prints a table of a study"]
fn amplitudes_that_overturn() {
    println!("| pulse | asked (m/s^2) | contact dynamics | less asked (%) | explicit | less asked (%) |");
    let told = |name: &str, half: [f64; 2], wanted: f64, pulse: &dyn Fn(f64) -> Pulse, step: f64| {
        let found = [nonsmooth(step), elastic()].map(|solver| overturns_at(half, wanted, pulse, solver));
        let apart = found.map(|amplitude| 100.0 * (amplitude / wanted - 1.0));
        let ([rigid, soft], [one, other]) = (found, apart);
        println!("| {name} | {wanted:.4} | {rigid:.4} | {one:.3} | {soft:.4} | {other:.3} |");
    };
    let half_sine = |w: f64| move |amplitude| Pulse::HalfSine { amplitude, duration: PI / w };
    // A block of 1 in 50, of which second-order terms are 4e-4, by the linear equation.
    let slender = [0.02, 1.0];
    let (p, unit) = (frequency(0.02, 1.0), G * atan(0.02));
    for (ratio, wanted) in [
        (1.0, 1.322_397),
        (2.0, 1.800_724),
        (3.0, 2.293_872),
        (4.0, 2.790_798),
        (6.0, 3.788_155),
        (8.0, 4.787_071),
    ] {
        let pulse = half_sine(ratio * p);
        told(&format!("half sine, w/p {ratio}, slender"), slender, wanted * unit, &pulse, 4e-4);
    }
    for long in [0.25, 0.5, 1.0, 2.0] {
        let pulse = |amplitude| Pulse::Rectangle { amplitude, duration: long / p };
        let wanted = unit / (1.0 - exp(-long));
        told(&format!("rectangle, p d {long}, slender"), slender, wanted, &pulse, 4e-4);
    }
    let p = frequency(0.2, 0.6);
    for (ratio, wanted) in [(2.0, 5.892_17), (4.0, 9.161_96)] {
        let pulse = half_sine(ratio * p);
        told(&format!("half sine, w/p {ratio}, 0.4 m x 1.2 m"), [0.2, 0.6], wanted * G / 9.81, &pulse, 2e-4);
    }
    // With an impact before it overturns.
    for (ratio, wanted) in [(2.0, 4.025), (4.0, 6.413)] {
        let frequency = ratio * p / (2.0 * PI);
        let pulse = |amplitude| Pulse::Sine { amplitude, frequency, cycles: 1 };
        told(&format!("whole sine, w/p {ratio}, 0.4 m x 1.2 m"), [0.2, 0.6], wanted * G / 9.81, &pulse, 2e-4);
    }
}

/// Largest turns (rad) of the swings after each of the first `N` impacts, of a block let go from an angle.
fn apexes<const N: usize>([b, h]: [f64; 2], start: f64, time_step: f64) -> [f64; N] {
    let wall = on_floor(vec![resting([0.4, 2.0 * b, 2.0 * h], 2400.0)]);
    let law = dry(1e9, degrees(atan(3.0)));
    let settings = Settings { time_step, ..Settings::default() };
    let mut rocking = Simulation::new(&wall, &law, settings, contact::Settings::for_size(0.2, [2, 2]));
    let from = let_go(&mut rocking, [b, h], start);
    let (mut before, mut impacts, mut apexes) = (0.0f64, 0, [0.0; N]);
    while impacts < N {
        rocking.step_once();
        let body = &rocking.assembly.bodies.all[0];
        let turn = body.turn_since(&from).norm();
        // It turns back far from its face.
        if before * body.spin.x < 0.0 && turn > 0.01 * start {
            apexes[impacts] = turn;
            impacts += 1;
        }
        before = body.spin.x;
    }
    apexes
}

/// Shares of the spin that the first impacts keep: from the heights of its swings.
fn kept(half: [f64; 2], start: f64, time_step: f64) -> [f64; 3] {
    let alpha = atan(half[0] / half[1]);
    let energy = |turn: f64| cos(alpha - turn) - cos(alpha);
    let apexes: [f64; 3] = apexes(half, start, time_step);
    [0, 1, 2].map(|k| (energy(apexes[k]) / energy(if k == 0 { start } else { apexes[k - 1] })).sqrt())
}

#[test]
#[ignore = "slow: 30 s, prints a table of a study"]
fn spin_that_impacts_keep_over_the_time_step() {
    println!("| stone | step (ms) | first impact | second | third |");
    for half in [[0.2, 0.6], [0.05, 0.2]] {
        let alpha = atan(half[0] / half[1]);
        for step in [5e-3, 2e-3, 1e-3, 5e-4] {
            // Where in a step an impact falls is chance: 40 starts about 0.6 alpha.
            let n = 40;
            let all: Vec<[f64; 3]> =
                (0..n).map(|k| kept(half, alpha * (0.5 + 0.005 * f64::from(k)), step)).collect();
            let told = [0, 1, 2].map(|impact| {
                let mean = all.iter().map(|shares| shares[impact]).sum::<f64>() / f64::from(n);
                let squares: f64 =
                    all.iter().map(|shares| (shares[impact] - mean) * (shares[impact] - mean)).sum();
                format!("{mean:.4} (sd {:.4})", (squares / f64::from(n - 1)).sqrt())
            });
            println!("| {half:?} | {} | {} |", 1e3 * step, told.join(" | "));
        }
    }
}

#[test]
#[ignore = "slow: 10 s, prints a table of a study"]
fn free_rocking_for_ten_half_cycles() {
    println!("| step (ms) | largest difference of the first ten apexes (%) |");
    let (b, h) = (0.1, 0.6);
    let alpha: f64 = atan(b / h);
    let share = crate::rocking_block::Block::perfect(b, h).kept(0);
    for step in [5e-3, 2e-3, 1e-3] {
        let found: [f64; 10] = apexes([b, h], 0.5 * alpha, step);
        let mut wanted = 0.5 * alpha;
        let mut largest = 0.0f64;
        for apex in found {
            wanted = alpha - acos(cos(alpha) + share * share * (cos(alpha - wanted) - cos(alpha)));
            largest = largest.max((apex / wanted - 1.0).abs());
        }
        println!("| {} | {:.3} |", 1e3 * step, 100.0 * largest);
    }
}
