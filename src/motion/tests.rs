//! Sliding of a rigid block on a moving base, by pulses: closed forms of what a solver is to find.

use crate::motion::{Motion, Pulse};

/// Gravity of the reference numbers (m/s^2).
const G: f64 = 9.81;
/// Step of the explicit integration (s), and the share that it may err by.
const STEP: f64 = 1e-5;

/// Of a block with friction `mu`: its largest slip (m), when it begins and when it first ends (s), and the slip that is left. Coulomb's law in
/// the frame of the base; a slip against the acceleration of the base is positive.
fn slip(motion: &Motion, mu: f64) -> [f64; 4] {
    let (mut u, mut v, mut largest, mut begin, mut end) = (0.0_f64, 0.0_f64, 0.0_f64, -1.0, -1.0);
    let limit = mu * G;
    for k in 0..(4.0 / STEP) as usize {
        let t = STEP * k as f64;
        let push = motion.acceleration(t).x;
        if v == 0.0 && push.abs() <= limit {
            continue;
        }
        if begin < 0.0 {
            begin = t;
        }
        let direction = if v == 0.0 { push.signum() } else { v.signum() };
        let next = v + STEP * (push - limit * direction);
        // Friction stops, and does not turn.
        let next = if v != 0.0 && next * v <= 0.0 { 0.0 } else { next };
        u += 0.5 * STEP * (v + next);
        v = next;
        if v == 0.0 && end < 0.0 {
            end = t;
        }
        largest = largest.max(u.abs());
    }
    [largest, begin, end, u]
}

fn of(pulse: Pulse) -> Motion {
    Motion::of_pulse(pulse).expect("good parameters")
}

fn near(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 1e-3 * expected.abs()
}

#[test]
fn a_block_slides_under_a_rectangle_by_the_closed_form() {
    for (a, mu, t, expected) in [(0.6, 0.3, 0.4, 0.470880), (0.5, 0.4, 0.5, 0.153281)] {
        let closed = (a * G * t) * (a * G * t) / (2.0 * mu * G) * (1.0 - mu / a);
        assert!((closed / expected - 1.0_f64).abs() < 1e-5);
        let found = slip(&of(Pulse::Rectangle { amplitude: a * G, duration: t }), mu);
        assert!(near(found[0], closed) && near(found[3], closed), "{found:?} {closed}");
    }
}

#[test]
fn a_block_slides_and_comes_back_under_a_sine_and_stays_after_half_of_one() {
    let whole = of(Pulse::Sine { amplitude: 0.5 * G, frequency: 1.0, cycles: 1 });
    let found = slip(&whole, 0.4);
    assert!(near(found[0], 0.023333) && near(found[1], 0.14758) && near(found[2], 0.45948), "{found:?}");
    assert!(found[3].abs() < 1e-3 * found[0], "{found:?}");
    let half = of(Pulse::HalfSine { amplitude: 0.8 * G, duration: 1.0 / 6.0 });
    let found = slip(&half, 0.3);
    assert!(near(found[0], 0.056745) && near(found[1], 0.02039) && near(found[2], 0.29301), "{found:?}");
}
