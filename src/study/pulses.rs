//! Records of a study that are pulses in closed form.

use std::f64::consts::PI;

use crate::math::radians;
use crate::motion::{Motion, Pulse};
use crate::study::reader::Reader;

/// The pulses of `[load.records]`, one for each frequency. Their amplitude is 1: records are scaled to the intensities of the study.
///
/// A half sine and a rectangle last half of a period.
pub(super) fn pulses(t: &mut Reader<'_>) -> Option<Vec<Motion>> {
    let kind = t.choice_name("pulse");
    let frequencies = t.list("frequency_hz");
    let kind = kind?;
    let of_kind: [(&str, &[&str]); 3] = [
        ("cycles", &["sine", "cosine"]),
        ("gamma", &["mavroeidis_papageorgiou"]),
        ("phase_deg", &["mavroeidis_papageorgiou"]),
    ];
    let before = t.notes.faults.len();
    for (key, kinds) in of_kind {
        if t.has(key) && !kinds.contains(&kind) {
            let allowed = format!("only with pulse = \"{}\"", kinds.join("\" or \""));
            t.fault(key, allowed, format!("remove it: it means nothing to a {kind} pulse"));
        }
    }
    let (cycles, gamma, phase) = (t.whole32("cycles"), t.real("gamma"), t.real("phase_deg"));
    if t.notes.faults.len() > before {
        return None;
    }
    let (cycles, gamma, phase) = (cycles?, gamma?, radians(phase?));
    let pulse = |frequency: f64| match kind {
        "rectangle" => Pulse::Rectangle { amplitude: 1.0, duration: 0.5 / frequency },
        "half_sine" => Pulse::HalfSine { amplitude: 1.0, duration: 0.5 / frequency },
        "sine" => Pulse::Sine { amplitude: 1.0, frequency, cycles },
        "cosine" => Pulse::Cosine { amplitude: 1.0, frequency, cycles },
        "ricker" => Pulse::Ricker { amplitude: 1.0, frequency },
        _ => Pulse::MavroeidisPapageorgiou {
            // Whatever it is, the record is scaled.
            velocity_amplitude: 1.0 / (2.0 * PI * frequency),
            frequency,
            gamma,
            phase,
        },
    };
    let motion = |frequency: f64| {
        let mut motion = Motion::of_pulse(pulse(frequency)).expect("the ranges of the keys make a pulse");
        motion.name = format!("{} of {frequency} Hz", motion.name);
        motion
    };
    Some(frequencies?.into_iter().map(motion).collect())
}
