//! Pulses against their integrals and closed forms.

use std::f64::consts::{E, PI};

use super::*;

fn all() -> Vec<Pulse> {
    let near = |gamma, phase| Pulse::MavroeidisPapageorgiou {
        velocity_amplitude: 0.7,
        frequency: 0.8,
        gamma,
        phase,
    };
    vec![
        Pulse::Rectangle { amplitude: 3.0, duration: 0.7 },
        Pulse::HalfSine { amplitude: -3.0, duration: 0.7 },
        Pulse::Sine { amplitude: 3.0, frequency: 1.5, cycles: 2 },
        Pulse::Cosine { amplitude: 3.0, frequency: 1.5, cycles: 1 },
        Pulse::Ricker { amplitude: 3.0, frequency: 1.5 },
        near(1.5, 0.0),
        near(2.0, 1.0),
        near(1.0 + 1e-9, 0.3),
    ]
}

/// Simpson's rule over 2000 steps of at least a hundredth of a radian errs by far less than 1e-9.
#[test]
fn velocity_and_displacement_are_the_integrals_and_meet_the_stated_ends() {
    for pulse in all() {
        let n = 2000;
        let h = pulse.duration() / f64::from(n);
        let (mut v, mut d) = (0.0, 0.0);
        for k in 0..n {
            let t = h * f64::from(k);
            let simpson = |f: &dyn Fn(f64) -> f64| {
                h / 6.0 * (f(t) + 4.0 * f(t + 0.5 * h) + f((t + h).min(pulse.duration())))
            };
            d += simpson(&|t| pulse.velocity(t));
            v += simpson(&|t| pulse.acceleration(t));
            let at = (t + h).min(pulse.duration());
            assert!((pulse.velocity(at) - v).abs() < 1e-9, "{pulse:?} at {at}: {v}");
            assert!((pulse.displacement(at) - d).abs() < 1e-9, "{pulse:?} at {at}: {d}");
        }
        assert!((pulse.end_velocity() - v).abs() < 1e-9, "{pulse:?}: {v}");
        assert!((pulse.net_displacement() - d).abs() < 1e-9, "{pulse:?}: {d}");
        let after = pulse.state(pulse.duration() + 2.0);
        assert_eq!(after.acceleration, 0.0);
        assert!((after.displacement - (d + 2.0 * v)).abs() < 1e-8, "{pulse:?}: {after:?}");
    }
}

#[test]
fn ricker_peaks_are_the_closed_forms() {
    let (a, f) = (2.0, 1.3);
    let pulse = Pulse::Ricker { amplitude: a, frequency: f };
    let times = (0..=400_000).map(|k| pulse.duration() * f64::from(k) / 400_000.0);
    let (mut pgv, mut pgd, mut low) = (0.0_f64, 0.0_f64, 0.0_f64);
    for t in times {
        let state = pulse.state(t);
        pgv = pgv.max(state.velocity.abs());
        pgd = pgd.max(state.displacement.abs());
        low = low.min(state.acceleration);
    }
    // A grid of 1e-5 periods misses a peak by 1e-9 of it.
    assert!((pgv * f / a - 1.0 / (PI * (2.0 * E).sqrt())).abs() < 1e-8);
    assert!((pgv * f / a - 0.136517).abs() < 5e-7);
    assert!((pgd * f * f / a - 1.0 / (2.0 * PI * PI)).abs() < 1e-8);
    // -2 exp(-3/2)
    assert!((low / a + 0.446260).abs() < 5e-7, "{low}");
}

#[test]
fn a_near_fault_pulse_of_whole_oscillations_or_odd_phase_comes_back() {
    let net = |gamma, phase| {
        Pulse::MavroeidisPapageorgiou { velocity_amplitude: 1.0, frequency: 2.0, gamma, phase }
            .net_displacement()
    };
    assert!((net(1.5, 0.0) - 0.1273 / 2.0).abs() < 3e-5);
    assert!(net(2.0, 0.4).abs() < 1e-15 && net(3.0, 0.0).abs() < 1e-15);
    assert!(net(1.5, 0.5 * PI).abs() < 1e-15);
}

#[test]
fn every_bad_parameter_is_named() {
    assert!(all().into_iter().all(|pulse| pulse.checked().is_ok()));
    let bad = Pulse::MavroeidisPapageorgiou {
        velocity_amplitude: 0.0,
        frequency: -1.0,
        gamma: 1.0,
        phase: f64::NAN,
    };
    let names: Vec<_> = bad.checked().unwrap_err().iter().map(|fault| fault.parameter).collect();
    assert_eq!(names, ["velocity_amplitude (m/s)", "frequency (Hz)", "gamma", "phase (rad)"]);
    let bad = Pulse::Sine { amplitude: f64::INFINITY, frequency: 1.0, cycles: 0 };
    assert_eq!(bad.checked().unwrap_err().len(), 2);
}
