//! An empty table of measurements for a study, to be filled in with a spreadsheet.

use std::fmt::Write;

use crate::math::degrees;
use crate::protocol::{Observes, Protocol, Tilting};
use crate::study::checked::Study;
use crate::study::measured::measurement::MeasuredQuantity;
use crate::study::schema::Short;

/// At most so many tilts: a table that a person fills in.
const TILTS: usize = 12;

/// Which table is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// Specimens of each arm, at least 1.
    pub specimens: u32,
    /// Whether a row holds all quantities of a tilt.
    pub wide: bool,
}

/// An empty table for the arms that a study evaluates; `None` where it tilts no platform, as nothing else is measured on walls.
///
/// It begins with `sep=,`, so that a spreadsheet that expects semicolons opens it in columns.
pub fn template(study: &Study, wanted: Template) -> Option<String> {
    let Protocol::Tilting(tilting) = &study.protocol else { return None };
    let tilts = tilts(study, tilting);
    let mut text = String::from("sep=,\n");
    for line in comments(study, wanted.wide) {
        let _ = writeln!(text, "# {line}");
    }
    let has_fall = tilting.observes == Observes::CollapseAngle;
    let points: &[MeasuredQuantity] = match tilting.remainders {
        true => &MOVED,
        false => &MOVED[..3],
    };
    text.push_str(&if wanted.wide { wide_header(points, has_fall) } else { LONG_HEADER.to_owned() });
    let specimens = study.arms.iter().flat_map(|arm| (1..=wanted.specimens).map(move |k| (&arm.name, k)));
    for (arm, k) in specimens {
        // Of `mar-1` a spreadsheet would make the first of March.
        let own = format!("{arm}_{k},{arm}");
        if wanted.wide {
            let empty = ",".repeat(points.len() + 2 + 2 * usize::from(has_fall));
            text.extend(tilts.iter().map(|tilt| format!("{own},{}{empty}\n", Short(*tilt))));
            continue;
        }
        if has_fall {
            let _ = writeln!(text, "{own},,{},,deg,,exact,,,", MeasuredQuantity::CollapseAngle.name());
        }
        for (tilt, point) in tilts.iter().flat_map(|tilt| points.iter().map(move |point| (tilt, point))) {
            let _ = writeln!(text, "{own},{},{},,mm,,exact,,,", Short(*tilt), point.name());
        }
    }
    Some(text)
}

/// What is read at three points of a wall's top, and what is left of it there.
const MOVED: [MeasuredQuantity; 6] = [
    MeasuredQuantity::DisplacementLeft,
    MeasuredQuantity::DisplacementCentre,
    MeasuredQuantity::DisplacementRight,
    MeasuredQuantity::RemainderLeft,
    MeasuredQuantity::RemainderCentre,
    MeasuredQuantity::RemainderRight,
];
const LONG_HEADER: &str =
    "specimen,family,tilt_deg,quantity,value,unit,error,kind,common_error,resolution,order\n";

fn wide_header(points: &[MeasuredQuantity], has_fall: bool) -> String {
    let points: String = points.iter().map(|point| format!("{}_mm,", point.name())).collect();
    let fall = if has_fall { ",collapse_angle_deg,collapse_angle_error" } else { "" };
    format!("specimen,family,tilt_deg,{points}error_mm{fall},order\n")
}

/// What whoever fills it in must know; without separators and quotes, which a spreadsheet would take for its own.
fn comments(study: &Study, wide: bool) -> Vec<String> {
    let mut lines = vec![
        format!("Measurements for the study {}. Fill it in with a spreadsheet and save it as CSV (UTF-8).", study.name),
        "Lines that begin with # and rows without a value are read over. Decimals: all with a point or all with a comma.".to_owned(),
        "specimen: rename as you like. tilt_deg: the tilt of the platform at the reading. Add and remove rows and tilts as you need.".to_owned(),
        "error: random error of the value (one standard deviation) in the unit of the value.".to_owned(),
    ];
    lines.push(match wide {
        true => "A bound: write <5 or >30. The collapse angle: in any one row of its specimen. order: of the tests from 1 or empty.",
        false => {
            "kind: exact or below or above (only a bound is known) or rounded (then state the resolution). order: of the tests from 1 or empty."
        }
    }.to_owned());
    lines.push(
        "Displacements: along the platform at the top of the wall towards the side that goes down relative to the reading at 0 deg."
            .to_owned(),
    );
    lines.push("All columns and quantities: pirca reference keys".to_owned());
    lines
}

/// The tilts to read at (deg): the study's own steps, or every so manieth, up to where a wall of the arms would overturn as a whole.
fn tilts(study: &Study, tilting: &Tilting) -> Vec<f64> {
    let overturns = study.arms.iter().map(|arm| arm.overturning_angle(tilting.towards)).fold(0.0, f64::max);
    // A last step that is reached but for rounding is one.
    let steps = (overturns.min(tilting.end) / tilting.step + 1e-9).floor().max(1.0) as usize;
    let each = steps.div_ceil(TILTS);
    let tilt = |k: usize| (degrees(k as f64 * tilting.step) * 1e6).round() / 1e6;
    (each..=steps).step_by(each).map(tilt).collect()
}
