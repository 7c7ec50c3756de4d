//! Keys of the records that a base moves by.

use crate::study::keys::{quantity, real};
use crate::study::schema::Presence::{Default, Required};
use crate::study::schema::{Interval, Key, Kind, Section};

const FILES: &[&str] = &["files"];
const PULSES: &[&str] = &["pulses"];
const KANAI_TAJIMI: &[&str] = &["kanai_tajimi"];
const REZAEIAN: &[&str] = &["rezaeian_der_kiureghian"];
const GENERATED: &[&str] = &["kanai_tajimi", "rezaeian_der_kiureghian"];
/// More records than any campaign can pay for.
pub const MOST_RECORDS: usize = 1000;

pub static RECORDS: Section = Section {
    title: "[load.records]",
    doc: "Records of ground motion: read from files, pulses, or generated. A generated record is decided by the study's seed and its own number. \
          What is a quantity may be a distribution, drawn once per record.",
    chooser: Some("from"),
    keys: &[&[
        Key::new(
            "from",
            Kind::Choice(&["files", "pulses", "kanai_tajimi", "rezaeian_der_kiureghian"]),
            Required,
            "Files; pulses in closed form; stationary noise through a layer of soil, with an envelope (Kanai and Tajimi); or noise whose strength and frequency \
             change over time (Rezaeian and Der Kiureghian).",
        ),
        Key::new(
            "files",
            Kind::Files { at_most: MOST_RECORDS },
            Required,
            "Records as .AT2 (PEER), ESM, ITACA or K-NET ASCII, COSMOS or CSMIP V2, or CSV with units in its heads, in the study's folder.",
        )
        .only(FILES),
        Key::new(
            "pulse",
            Kind::Choice(&["rectangle", "half_sine", "sine", "cosine", "ricker", "mavroeidis_papageorgiou"]),
            Required,
            "Its shape. A rectangle and a half sine last half of a period and leave the base moving; the others leave it at rest.",
        )
        .only(PULSES),
        Key::new(
            "frequency_hz",
            Kind::Reals { unit: "Hz", within: Interval::closed(0.01, 100.0), at_most: MOST_RECORDS, ascending: true },
            Required,
            "Frequencies, each a record of its own.",
        )
        .only(PULSES),
        Key::new(
            "cycles",
            Kind::Whole { low: 1, high: 1000 },
            Default("1"),
            "Number of cycles of a sine or a cosine.",
        )
        .only(PULSES),
        Key::new(
            "gamma",
            real("1", Interval::closed(1.001, 100.0)),
            Default("2"),
            "Number of oscillations of a near-fault pulse (Mavroeidis and Papageorgiou 2003).",
        )
        .only(PULSES),
        Key::new(
            "phase_deg",
            real("deg", Interval::closed(-180.0, 180.0)),
            Default("0"),
            "Phase of a near-fault pulse.",
        )
        .only(PULSES),
        Key::new(
            "count",
            Kind::Whole { low: 1, high: MOST_RECORDS as u64 },
            Required,
            "How many records are generated.",
        )
        .only(GENERATED),
        Key::new(
            "step_s",
            real("s", Interval::closed(1e-3, 0.05)),
            Default("0.01"),
            "Time between samples; shorter where the frequency needs it.",
        )
        .only(GENERATED),
        Key::new("ground_hz", quantity("Hz", Interval::closed(0.5, 10.0)), Default("2.5"), "Frequency of the ground.")
            .only(KANAI_TAJIMI),
        Key::new(
            "ground_damping",
            quantity("1", Interval::closed(0.05, 1.0)),
            Default("0.6"),
            "Damping ratio of the ground.",
        )
        .only(KANAI_TAJIMI),
        Key::new(
            "corner_hz",
            quantity("Hz", Interval::closed(0.02, 0.4)),
            Default("0.15"),
            "Corner of the high-pass of Clough and Penzien; long periods, and with them rocking, depend on it.",
        )
        .only(KANAI_TAJIMI),
        Key::new(
            "corner_damping",
            quantity("1", Interval::closed(0.2, 1.0)),
            Default("0.6"),
            "Damping ratio of the high-pass.",
        )
        .only(KANAI_TAJIMI),
        Key::new(
            "rise_s",
            quantity("s", Interval::closed(0.1, 60.0)),
            Default("2"),
            "Time in which the shaking rises to its full strength.",
        )
        .only(KANAI_TAJIMI),
        Key::new(
            "strong_s",
            quantity("s", Interval::closed(0.0, 60.0)),
            Default("6"),
            "How long it keeps it.",
        )
        .only(KANAI_TAJIMI),
        Key::new(
            "decay_per_s",
            quantity("1/s", Interval::closed(0.05, 10.0)),
            Default("0.5"),
            "Rate at which it then decays; the shaking ends at a hundredth.",
        )
        .only(KANAI_TAJIMI),
        Key::new(
            "middle_hz",
            quantity("Hz", Interval::closed(0.5, 10.0)),
            Default("4"),
            "Frequency in the middle of the strong shaking.",
        )
        .only(REZAEIAN),
        Key::new(
            "hz_per_s",
            quantity("Hz/s", Interval::closed(-0.5, 0.5)),
            Default("-0.1"),
            "Its change over time.",
        )
        .only(REZAEIAN),
        Key::new(
            "filter_damping",
            quantity("1", Interval::closed(0.02, 0.95)),
            Default("0.3"),
            "Damping ratio of the filter: how broad the spectrum is.",
        )
        .only(REZAEIAN),
        Key::new(
            "d5_95_s",
            quantity("s", Interval::closed(0.5, 40.0)),
            Default("8"),
            "Time from 5 to 95 % of the Arias intensity.",
        )
        .only(REZAEIAN),
        Key::new(
            "middle_over_d5_95",
            quantity("1", Interval::closed(0.3, 2.0)),
            Default("0.6"),
            "Time until 45 % of the Arias intensity over d5_95_s.",
        )
        .only(REZAEIAN),
        Key::new(
            "corner_hz",
            quantity("Hz", Interval::closed(0.02, 0.4)),
            Default("0.15"),
            "Corner of the high-pass, critically damped; long periods, and with them rocking, depend on it.",
        )
        .only(REZAEIAN),
    ]],
};
