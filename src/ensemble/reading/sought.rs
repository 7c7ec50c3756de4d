//! What is looked for under the records that shook a specimen: the scale at which a wall would just fall, or how far it moves.
//!
//! Whether a wall falls is no smooth function of anything; the scale at which it begins to is nearly one. A wall that rocks may fall under a
//! motion and stand under a stronger one: what is looked for is the change next to the scale that the specimen met.

use crate::ensemble::reading::StepRow;
use crate::ensemble::reading::base_motion::{Shake, Table};
use crate::stats::fragility::Outcome;
use crate::study::{MeasuredQuantity, Sought};

/// Factors by which the scale goes up from one at which the wall stands, or down from one at which it falls, step after step; then the
/// search ends.
const STEPS: [f64; 4] = [1.35, 1.35, 1.5, 1.5];
/// The scale is found to this ratio: verdicts of walls that rock hang on more than that by chance.
const WITHIN: f64 = 1.1;

/// The runs of everything that is looked for, in its order; and the number of joints.
pub(super) fn sought(table: &Table<'_>) -> (Vec<StepRow>, usize) {
    let all = &table.earthquakes.sought;
    let places: Vec<u32> = all.iter().map(|own| own.nth).collect();
    table.each_from_rest(&places, |number, shake| runs(table, (number, &all[number]), shake))
}

/// The runs of what is looked for, the last that stood and the last that fell being next to each other.
fn runs(table: &Table<'_>, (number, own): (usize, &Sought), shake: Shake<'_>) -> Vec<StepRow> {
    let record = &table.earthquakes.records[own.record];
    let mut runs = Vec::new();
    let mut falls = |scale: f64| {
        let step = shake(own.record, scale * record.recorded, number);
        let collapse = step.shaken.as_ref().and_then(|run| run.collapse);
        runs.push(step);
        // A run that chance decides has fallen: what is unsafe needs more proof.
        collapse.map(|collapse| collapse != Outcome::Stands)
    };
    let first = falls(own.scale);
    let (Some(fell), MeasuredQuantity::Outcome) = (first, own.quantity) else { return runs };
    let (mut stood, mut fallen) = if fell { (None, Some(own.scale)) } else { (Some(own.scale), None) };
    let mut scale = own.scale;
    for factor in STEPS {
        scale = if fell { scale / factor } else { scale * factor };
        match falls(scale) {
            None => return runs,
            Some(true) => fallen = Some(scale),
            Some(false) => stood = Some(scale),
        }
        if stood.is_some() && fallen.is_some() {
            break;
        }
    }
    while let (Some(low), Some(high)) = (stood, fallen)
        && high > WITHIN * low
    {
        let middle = (low * high).sqrt();
        match falls(middle) {
            None => return runs,
            Some(true) => fallen = Some(middle),
            Some(false) => stood = Some(middle),
        }
    }
    runs
}
