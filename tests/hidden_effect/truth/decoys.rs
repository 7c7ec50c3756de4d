//! Blunders of a test, which are no mechanism.

use pirca::random::Stream;

use super::effect::{Effect, Specimen, normal};
use super::readings::{Entry, Series};

/// All of them.
pub const DECOYS: [&str; 4] = ["one_bad_specimen", "heavy_tailed_errors", "left_for_right", "wrong_unit"];

/// Specimens of a campaign.
const SPECIMENS: f64 = 9.0;

/// A decoy; `uniform` chooses the specimen that it befalls.
pub fn decoy(name: &str, uniform: f64) -> Box<dyn Effect> {
    let number = (uniform * SPECIMENS) as u64;
    match name {
        "one_bad_specimen" => Box::new(OneBadSpecimen { number }),
        "heavy_tailed_errors" => Box::new(HeavyTailedErrors),
        "left_for_right" => Box::new(LeftForRight { number }),
        "wrong_unit" => Box::new(WrongUnit),
        other => panic!("{other} is no decoy"),
    }
}

/// A specimen that moves three times as far and falls at three quarters of its tilt.
struct OneBadSpecimen {
    number: u64,
}

impl Effect for OneBadSpecimen {
    fn read(&self, series: &mut Series, specimen: &Specimen) {
        if specimen.number == self.number {
            series.fall_at(0.75 * series.collapse);
            series.points.iter_mut().flatten().for_each(|point| *point *= 3.0);
        }
    }
}

/// Errors by Student's t with three degrees of freedom, as large on average (root mean square) as they are said to be.
struct HeavyTailedErrors;

impl Effect for HeavyTailedErrors {
    fn error(&self, stream: &mut Stream) -> Option<f64> {
        let above = normal(stream);
        let squares = (0..3).map(|_| normal(stream)).fold(0.0, |sum, z| sum + z * z);
        // Its variance is three before it is divided.
        Some(above / (squares / 3.0).sqrt() / 3_f64.sqrt())
    }
}

/// A specimen whose ends were taken for each other.
struct LeftForRight {
    number: u64,
}

impl Effect for LeftForRight {
    fn read(&self, series: &mut Series, specimen: &Specimen) {
        if specimen.number == self.number {
            series.points.iter_mut().for_each(|points| points.swap(0, 2));
        }
    }
}

/// A row in millimetres under the heading of centimetres.
struct WrongUnit;

impl Effect for WrongUnit {
    fn rows(&self, rows: &mut [Entry], stream: &mut Stream) {
        let told: Vec<usize> =
            (0..rows.len()).filter(|&k| rows[k].tilt_deg.is_some() && rows[k].kind != "below").collect();
        if !told.is_empty() {
            rows[told[stream.below(told.len())]].value *= 10.0;
        }
    }
}
