//! Ground motions of stochastic processes. A record is a pure function of the parameters and of the streams (seed and index) that it is
//! drawn from.
//!
//! White noise that is only filtered has a spectrum that does not vanish towards zero frequency, and the displacement of its base diverges.
//! So every process ends in a high-pass of a stated corner. It comes last, after the modulation in time, which would bring low
//! frequencies back. A record lasts longer than its shaking, until what the high-pass still moves has died away.

mod envelope;
mod gamma;
mod high_pass;
mod kanai_tajimi;
mod modulation;
mod rezaeian_der_kiureghian;

pub use envelope::Envelope;
pub use kanai_tajimi::{KanaiTajimi, KanaiTajimiProcess};
pub use rezaeian_der_kiureghian::{RezaeianDerKiureghian, RezaeianDerKiureghianProcess};

use crate::motion::fault::Faults;

/// Most samples of the shaking of a generated record.
const MOST_SAMPLES: f64 = 200_000.0;

/// Whether step and duration (s) make a record.
fn require_length(faults: &mut Faults, step: f64, duration: f64) -> bool {
    let good = faults.require((1e-4..=0.1).contains(&step), "step (s)", step, "1e-4 to 0.1 s");
    let most = duration.is_finite() && duration / step <= MOST_SAMPLES;
    good && faults.require(most && duration >= 1.0, "duration (s)", duration, "1 s to 200,000 steps")
}
