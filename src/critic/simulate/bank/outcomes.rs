//! What a shaken wall does under the records that specimens met, in numbers that hang smoothly on what it is made of: of an outcome the
//! logarithm of the scale of the record at which the wall would just fall, of a displacement its own logarithm.

use crate::critic::simulate::bank::path::{NUMBERS, Path};
use crate::ensemble::{Row, ShakenRow};
use crate::math::ln;
use crate::model::Outcome;
use crate::protocol::Verdict;
use crate::study::{Earthquakes, Measure, MeasuredQuantity};

/// Motions that specimens may have met, each once; displacements under them count as well.
pub const MOST_SOUGHT: usize = NUMBERS - 1;
/// Of a wall that stands under the strongest motion that it met, or falls under the weakest, the scale lies so far beyond (logarithm).
const BEYOND: f64 = 0.2;
/// A wall that does not stand at rest any more when it meets a motion falls at a scale that lies so far below (logarithm): beyond the end of
/// the search.
const AT_REST: f64 = 1.6;
/// No wall moves less (m).
const LEAST: f64 = 1e-6;

impl Path {
    /// The path of a wall that was shaken by all that is sought: a number for each, behind a first one that says nothing. `None` where it
    /// does not stand at rest, or a run has no verdict.
    pub fn shaken(row: &Row, earthquakes: &Earthquakes) -> Option<Path> {
        let Outcome::Equilibrium = row.outcome else { return None };
        let mut numbers = [0.0; NUMBERS];
        for (k, own) in earthquakes.sought.iter().enumerate().take(MOST_SOUGHT) {
            let runs = row.runs().filter(|run| run.stripe as usize == k);
            let record = &earthquakes.records[own.record];
            let recorded = record.peak(Measure::Pga, record.recorded);
            let scale = |run: &ShakenRow| ln(run.pga_m_per_s2 / recorded);
            numbers[1 + k] = match own.quantity {
                MeasuredQuantity::Outcome => just_falls(runs, scale)?,
                MeasuredQuantity::PeakDisplacement => ln(runs.last()?.displacement_m.max(LEAST)),
                _ => ln(runs.last()?.residual_m?.max(LEAST)),
            };
        }
        Some(Path { numbers })
    }
}

/// Logarithm of the scale at which a wall would just fall, from the runs in their order.
fn just_falls<'r>(
    runs: impl Iterator<Item = &'r ShakenRow>,
    scale: impl Fn(&ShakenRow) -> f64,
) -> Option<f64> {
    let (mut stood, mut fallen) = (None, None);
    for run in runs {
        if run.verdict == Verdict::UnstableAtRest {
            // Wear has gone so far that it falls under any motion.
            return Some(scale(run) - AT_REST);
        }
        match run.collapse?.collapses() > 0.0 {
            true => fallen = Some(scale(run)),
            false => stood = Some(scale(run)),
        }
    }
    match (stood, fallen) {
        (Some(low), Some(high)) => Some(0.5 * (low + high)),
        (Some(strongest), None) => Some(strongest + BEYOND),
        (None, Some(weakest)) => Some(weakest - BEYOND),
        (None, None) => None,
    }
}
