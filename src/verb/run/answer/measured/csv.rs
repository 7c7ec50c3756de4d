//! The numbers of the comparison and of the calibration's curves. They read back to the same bits.

use crate::render::csv::{cell, ends, quoted};
use crate::verb::run::answer::measured::comparison::MomentsEntry;
use crate::verb::run::answer::measured::{CalibrationEntry, ComparisonEntry};

const MOMENTS: [&str; 10] =
    ["n", "mean", "mean_low", "mean_high", "sigma", "sigma_low", "sigma_high", "cov", "cov_low", "cov_high"];

/// `comparison.csv`: one line per family, quantity, tilt and kn; empty where not defined.
pub fn comparison_csv(entries: &[ComparisonEntry]) -> String {
    let moments = |side: &str| MOMENTS.map(|name| format!("{side}_{name}"));
    let mut header = ["family", "quantity", "tilt_deg", "unit", "kn_pa_per_m"].map(String::from).to_vec();
    // Only walls that are sheared have drifts.
    let drifts = entries.iter().any(|entry| entry.drift_percent.is_some());
    if drifts {
        header.insert(3, "drift_percent".to_string());
    }
    header.extend(moments("measured"));
    header.extend(["measured_below", "measured_above", "measured_mean_error"].map(String::from));
    header.extend(moments("simulated"));
    header.extend(
        [
            "fell_before",
            "stood_to_the_end",
            "lost",
            "difference",
            "difference_sd",
            "difference_sd_measurement",
            "difference_sd_scatter",
            "difference_sd_ensemble",
            "difference_in_sd",
            "agreeing_share",
            "note",
        ]
        .map(String::from),
    );
    let mut text = header.join(",") + "\n";
    for entry in entries {
        let mut cells = vec![
            quoted(&entry.family),
            entry.quantity.to_string(),
            cell(entry.tilt_deg),
            entry.unit.to_string(),
            cell(entry.kn_pa_per_m),
        ];
        if drifts {
            cells.insert(3, cell(entry.drift_percent));
        }
        cells.extend(moments_cells(&entry.measured));
        cells.extend([entry.measured_below.to_string(), entry.measured_above.to_string()]);
        cells.push(cell(entry.measured_mean_error));
        cells.extend(moments_cells(&entry.simulated));
        cells.extend([entry.fell_before, entry.stood_to_the_end, entry.lost].map(|count| count.to_string()));
        cells.extend(
            [
                entry.difference,
                entry.difference_sd,
                entry.difference_sd_measurement,
                entry.difference_sd_scatter,
                entry.difference_sd_ensemble,
                entry.difference_in_sd,
                entry.agreeing_share,
            ]
            .map(cell),
        );
        cells.push(quoted(entry.note.unwrap_or("")));
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

fn moments_cells(moments: &MomentsEntry) -> Vec<String> {
    let mut cells = vec![moments.n.to_string()];
    for (value, interval) in
        [(moments.mean, moments.mean_ci), (moments.sigma, moments.sigma_ci), (moments.cov, moments.cov_ci)]
    {
        cells.push(cell(value));
        cells.extend(ends(interval));
    }
    cells
}

/// `calibration.csv`: one line per arm and place of its curve over kn.
pub fn calibration_csv(entries: &[CalibrationEntry]) -> String {
    let mut text = "arm,kn_pa_per_m,mean_deg,sigma_deg,deviance\n".to_string();
    for entry in entries {
        for point in &entry.panel.curve {
            let numbers = [point.kn, point.mean, point.sigma, point.deviance].map(|x| x.to_string());
            text.push_str(&format!("{},{}\n", quoted(&entry.arm), numbers.join(",")));
        }
    }
    text
}
