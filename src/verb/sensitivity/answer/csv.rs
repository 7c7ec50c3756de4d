//! The numbers of the map. They read back to the same bits.

use crate::render::csv::{cell, ends, quoted};
use crate::verb::sensitivity::answer::SensitivitySummary;

const HEADER: [&str; 22] = [
    "mechanism",
    "parameters",
    "family",
    "quantity",
    "tilt_deg",
    "unit",
    "outcome",
    "note",
    "without",
    "change",
    "change_low",
    "change_high",
    "measurement_error",
    "scatter",
    "error",
    "bounds_only",
    "in_measurement_errors",
    "in_errors",
    "in_errors_low",
    "in_errors_high",
    "pairs",
    "fell_before",
];

/// `sensitivity.csv`: one line per mechanism and observable; empty where not defined.
pub fn csv(summary: &SensitivitySummary) -> String {
    let mut text = HEADER.join(",") + "\n";
    for row in &summary.mechanisms {
        let parameters: Vec<String> =
            row.parameters.iter().map(|p| format!("{} = {:?}", p.key, p.value)).collect();
        for (one, observable) in row.cells.iter().zip(&summary.observables) {
            let [low, high] = ends(one.change_ci);
            let [errors_low, errors_high] = ends(one.in_errors_ci);
            let cells = [
                row.mechanism.to_string(),
                quoted(&parameters.join("; ")),
                quoted(&observable.family),
                observable.quantity.to_string(),
                cell(observable.tilt_deg),
                observable.unit.to_string(),
                one.outcome.to_string(),
                quoted(one.note.unwrap_or("")),
                cell(observable.without),
                cell(one.change),
                low,
                high,
                observable.measurement_error.to_string(),
                observable.scatter.to_string(),
                observable.error.to_string(),
                observable.bounds_only.to_string(),
                cell(one.in_measurement_errors),
                cell(one.in_errors),
                errors_low,
                errors_high,
                one.pairs.to_string(),
                one.fell_before.to_string(),
            ];
            text.push_str(&cells.join(","));
            text.push('\n');
        }
    }
    text
}
