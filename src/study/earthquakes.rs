//! The records of a study whose walls are shaken, and the intensities that they are scaled to.

use std::f64::consts::TAU;

use crate::math::ln;
use crate::motion::{Envelope, KanaiTajimi, Motion, RezaeianDerKiureghian};
use crate::protocol::Direction;
use crate::random::{Family, Streams};
use crate::study::catalogue::Catalogue;
use crate::study::cause::Meeting;
use crate::study::checked::Study;
use crate::study::fault::{Fault, Found};
use crate::study::measured::{MeasuredQuantity, Under};
use crate::study::pulses::pulses;
use crate::study::quantity::quantity;
use crate::study::reader::Reader;

/// What an intensity is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Peak ground acceleration (m/s^2).
    Pga,
    /// Peak ground velocity (m/s).
    Pgv,
}

impl Measure {
    /// The key of a study that states intensities, and the column that holds them.
    pub fn key(self) -> &'static str {
        match self {
            Measure::Pga => "pga_m_per_s2",
            Measure::Pgv => "pgv_m_per_s",
        }
    }

    /// Its name in text.
    pub fn name(self) -> &'static str {
        match self {
            Measure::Pga => "PGA",
            Measure::Pgv => "PGV",
        }
    }

    /// Its unit in text.
    pub fn unit(self) -> &'static str {
        match self {
            Measure::Pga => "m/s2",
            Measure::Pgv => "m/s",
        }
    }

    /// The other one.
    pub fn other(self) -> Measure {
        match self {
            Measure::Pga => Measure::Pgv,
            Measure::Pgv => Measure::Pga,
        }
    }
}

/// Records and intensities. Every wall meets every record at every intensity.
#[derive(Clone, Debug, PartialEq)]
pub struct Earthquakes {
    /// What intensities are.
    pub measure: Measure,
    /// Ascending, in the unit of the measure.
    pub intensities: Vec<f64>,
    /// The records, in the order of the study.
    pub records: Vec<Record>,
    /// Where their y axis points in plan, or their only component.
    towards: Direction,
    /// What generates them; `None` of those from files and of pulses.
    generator: Option<Generator>,
    /// What is looked for in the place of the intensities; empty in a study from files.
    pub sought: Vec<Sought>,
}

/// What is looked for under a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Sought {
    /// Index of the record.
    pub record: usize,
    /// What was measured under it: of an outcome the scale is looked for at which the wall would just fall, of anything else the wall
    /// is shaken once.
    pub quantity: MeasuredQuantity,
    /// Factor on the record as it was recorded: at which the wall is shaken, or from which on the scale is looked for.
    pub scale: f64,
    /// Place of the motion in the sequence that walls meet, from 0.
    pub nth: u32,
}

/// A record.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// At an intensity of 1, turned as the study says.
    motion: Motion,
    /// Its peak ground acceleration (m/s^2) and velocity (m/s) there.
    peaks: [f64; 2],
    /// The intensity at which it was recorded; 1 of one that is generated, whose strength is nothing but scaled.
    pub recorded: f64,
}

/// How records are generated.
#[derive(Clone, Debug, PartialEq)]
struct Generator {
    count: u64,
    /// Longest step (s).
    step: f64,
    process: Process,
}

/// A stochastic process, with the families of its parameters.
#[derive(Clone, Debug, PartialEq)]
enum Process {
    KanaiTajimi([Family; KANAI_TAJIMI.len()]),
    Rezaeian([Family; REZAEIAN.len()]),
}

/// Keys of the families of generated records; also the names of their streams behind "record".
const KANAI_TAJIMI: [&str; 7] =
    ["ground_hz", "ground_damping", "corner_hz", "corner_damping", "rise_s", "strong_s", "decay_per_s"];
const REZAEIAN: [&str; 6] =
    ["middle_hz", "hz_per_s", "filter_damping", "d5_95_s", "middle_over_d5_95", "corner_hz"];
/// A period has at least so many samples: more than either process asks for.
const SAMPLES_A_PERIOD: f64 = 13.0;
/// Shortest step (s) that a process takes.
const SHORTEST: f64 = 1e-4;
/// The envelope of Kanai and Tajimi is left at this.
const FADED: f64 = 0.01;

impl Record {
    /// What it is called: a file, a pulse, or a generator with its seed and number.
    pub fn name(&self) -> &str {
        &self.motion.name
    }

    /// Its peak at an intensity in another measure, or the same.
    pub fn peak(&self, measure: Measure, intensity: f64) -> f64 {
        let [pga, pgv] = self.peaks;
        intensity
            * match measure {
                Measure::Pga => pga,
                Measure::Pgv => pgv,
            }
    }

    /// Its motion at an intensity.
    pub fn at(&self, intensity: f64) -> Motion {
        self.motion.scaled(intensity)
    }
}

impl Record {
    /// Its motion at an intensity, as a wall meets it.
    pub fn met(&self, intensity: f64, meeting: &Meeting) -> Motion {
        let motion = self.at(intensity);
        let motion = if meeting.factor == 1.0 { motion } else { motion.scaled(meeting.factor) };
        if meeting.turn == 0.0 { motion } else { motion.turned(meeting.turn) }
    }
}

impl Study {
    /// The study that looks, in the place of its intensities, for what was measured under its records: each scale at which a wall just falls
    /// once for a record, whatever the scales under which it fell or stood. Unchanged where no base moves.
    pub fn seeking_what_was_measured(mut self) -> Study {
        let Some(earthquakes) = &mut self.earthquakes else { return self };
        let mut sought: Vec<Sought> = Vec::new();
        for m in &self.measured {
            let Some(under) = &m.under else { continue };
            let named = |record: &Record| record.name() == under.record;
            let Some(record) = earthquakes.records.iter().position(named) else { continue };
            let (quantity, scale) = (m.quantity, under.scale);
            let is_same = |own: &Sought| own.is_of(record, quantity, scale);
            if !sought.iter().any(is_same) {
                sought.push(Sought { record, quantity, scale, nth: m.stage });
            }
        }
        earthquakes.sought = sought;
        let told: Vec<String> = earthquakes.sought.iter().map(|own| own.name(&earthquakes.records)).collect();
        self.stating([("load.sought", told.join(", "))])
    }
}

impl Sought {
    /// Whether a reading of a quantity under a record at a scale asks for this.
    pub fn is_of(&self, record: usize, quantity: MeasuredQuantity, scale: f64) -> bool {
        let is_outcome = quantity == MeasuredQuantity::Outcome;
        self.record == record && self.quantity == quantity && (is_outcome || self.scale == scale)
    }

    /// Its name among the others.
    pub fn name(&self, records: &[Record]) -> String {
        format!("{} {} x {} as {}", self.quantity.name(), records[self.record].name(), self.scale, self.nth)
    }
}

impl Earthquakes {
    /// The place, among what is sought, of a quantity under a record at a scale.
    pub fn place_of(&self, quantity: MeasuredQuantity, under: &Under) -> Option<usize> {
        let record = self.records.iter().position(|record| record.name() == under.record)?;
        self.sought.iter().position(|own| own.is_of(record, quantity, under.scale))
    }

    /// Reads them from the table of the load. Generated ones are drawn when the seed is known, see [`Earthquakes::seeded`].
    pub fn read(
        t: &mut Reader<'_>,
        towards: Option<Direction>,
        catalogue: &mut Catalogue,
    ) -> Option<Earthquakes> {
        let both = t.has("pga_m_per_s2") && t.has("pgv_m_per_s");
        let measure = if t.has("pgv_m_per_s") { Measure::Pgv } else { Measure::Pga };
        if both {
            t.fault("pgv_m_per_s", "one of pga_m_per_s2 and pgv_m_per_s", "remove one of the two");
        }
        let intensities = t.list(measure.key());
        let mut records = t.table("records")?;
        let (generator, motions) = match records.chosen()? {
            "files" => (None, catalogue.records(&mut records)?),
            "pulses" => {
                let place = records.place_of("pulse").clone();
                (None, pulses(&mut records)?.into_iter().map(|motion| (motion, place.clone())).collect())
            }
            model => {
                let (count, step) = (records.whole("count"), records.real("step_s"));
                let process = match model {
                    "kanai_tajimi" => {
                        families(&mut records, KANAI_TAJIMI, catalogue).map(Process::KanaiTajimi)
                    }
                    _ => families(&mut records, REZAEIAN, catalogue).map(Process::Rezaeian),
                };
                (Some(Generator { count: count?, step: step?, process: process? }), Vec::new())
            }
        };
        let towards = towards?;
        let mut read = Vec::new();
        for (motion, place) in motions {
            match scaled(&motion, measure, towards) {
                Ok(record) => read.push(record),
                Err(why) => {
                    let allowed = "a record with a horizontal component that moves";
                    let fault =
                        Fault::at(&place, "load.records.files", Found::Words(why), allowed, "take another");
                    records.notes.faults.push(fault);
                }
            }
        }
        let intensities = intensities.filter(|_| !both)?;
        Some(Earthquakes { measure, intensities, records: read, towards, generator, sought: Vec::new() })
    }

    /// With the records that a seed gives, where they are generated.
    pub fn seeded(self, seed: u64) -> Earthquakes {
        let Some(Generator { count, step, process }) = &self.generator else { return self };
        let drawn = (0..*count).map(|index| {
            let streams = Streams::new(seed, index);
            match process {
                Process::KanaiTajimi(families) => kanai_tajimi(&streams, *step, families),
                Process::Rezaeian(families) => rezaeian(&streams, *step, families),
            }
        });
        let record = |motion: Motion| {
            let record = scaled(&motion, self.measure, self.towards);
            let record = record.expect("a generated record moves horizontally");
            Record { recorded: 1.0, ..record }
        };
        Earthquakes { records: drawn.map(record).collect(), ..self }
    }
}

/// The families of the keys; all are read before any is missed.
fn families<const N: usize>(
    t: &mut Reader<'_>,
    keys: [&'static str; N],
    catalogue: &mut Catalogue,
) -> Option<[Family; N]> {
    let read: Option<Vec<Family>> = keys.map(|key| quantity(t, key, catalogue)).into_iter().collect();
    read?.try_into().ok()
}

/// A record turned as asked for, at an intensity of 1.
fn scaled(motion: &Motion, measure: Measure, towards: Direction) -> Result<Record, String> {
    if !motion.is_horizontal() {
        return Err(format!("holds {}, which moves the ground up and down alone", motion.name));
    }
    let turned = motion.towards(&towards.unit()).map_err(|fault| fault.to_string())?;
    let (motion, recorded) = match measure {
        Measure::Pga => (turned.scaled_to_pga(1.0), turned.pga()),
        Measure::Pgv => (turned.scaled_to_pgv(1.0), turned.pgv()),
    };
    let motion = motion.map_err(|fault| format!("holds {}: {fault}", turned.name))?;
    let peaks = [motion.pga(), motion.pgv()];
    Ok(Record { motion, peaks, recorded })
}

/// What a record draws of its families, each from a stream of its own.
fn drawn<const N: usize>(streams: &Streams, keys: [&str; N], families: &[Family; N]) -> [f64; N] {
    let mut values = [0.0; N];
    for ((value, key), family) in values.iter_mut().zip(keys).zip(families) {
        *value = family.sample(&mut streams.of(&format!("record {key}")));
    }
    values
}

/// The step (s) that a frequency (Hz) needs, at most as long as asked for.
fn step_for(hz: f64, asked: f64) -> f64 {
    asked.min(1.0 / (SAMPLES_A_PERIOD * hz)).max(SHORTEST)
}

fn kanai_tajimi(streams: &Streams, step: f64, families: &[Family; KANAI_TAJIMI.len()]) -> Motion {
    let [ground_hz, zeta_g, corner_hz, zeta_f, rise, strong, decay] = drawn(streams, KANAI_TAJIMI, families);
    let step = step_for(ground_hz, step);
    let fall = rise + strong;
    let duration = whole_steps((fall - ln(FADED) / decay).max(1.0), step);
    let process = KanaiTajimi {
        // Whatever it is, the record is scaled.
        s0: 1.0,
        omega_g: TAU * ground_hz,
        zeta_g,
        omega_f: TAU * corner_hz,
        zeta_f,
        envelope: Envelope::RiseAndDecay { rise, fall, decay },
        duration,
        step,
    };
    process.process().expect("the ranges of the keys make a process").record(streams)
}

fn rezaeian(streams: &Streams, step: f64, families: &[Family; REZAEIAN.len()]) -> Motion {
    let [middle_hz, hz_per_s, zeta, d5_95, middle, corner_hz] = drawn(streams, REZAEIAN, families);
    let process = RezaeianDerKiureghian {
        // Whatever it is, the record is scaled.
        arias: 1.0,
        d5_95,
        t_mid: middle * d5_95,
        omega_mid: TAU * middle_hz,
        omega_rate: TAU * hz_per_s,
        zeta,
        corner_hz,
        duration: 0.0,
        step,
    };
    let duration = process.lasting().max(1.0);
    let highest = process.omega(0.0).max(process.omega(duration + step)) / TAU;
    let step = step_for(highest, step);
    let process = RezaeianDerKiureghian { duration: whole_steps(duration, step), step, ..process };
    process.process().expect("the ranges of the keys make a process").record(streams)
}

/// A duration (s) of whole steps, at least so long.
fn whole_steps(duration: f64, step: f64) -> f64 {
    step * (duration / step).ceil()
}
