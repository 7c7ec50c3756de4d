//! The numbers of the comparison and of the calibration's curves. They read back to the same bits.

use crate::render::csv::Csv;
use crate::verb::run::answer::measured::comparison::MomentsEntry;
use crate::verb::run::answer::measured::{CalibrationEntry, ComparisonEntry};

const MOMENTS: [&str; 10] =
    ["n", "mean", "mean_low", "mean_high", "sigma", "sigma_low", "sigma_high", "cov", "cov_low", "cov_high"];

/// `comparison.csv`: one line per family, quantity, tilt and kn; empty where not defined.
pub fn comparison_csv(entries: &[ComparisonEntry]) -> Vec<u8> {
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
    let mut csv = Csv::new(header.join(","));
    for entry in entries {
        let drift = if drifts { vec![entry.drift_percent] } else { Vec::new() };
        let [measured, simulated] = [&entry.measured, &entry.simulated].map(moments_cells);
        csv.line(&[
            &entry.family,
            &entry.quantity,
            &entry.tilt_deg,
            &drift,
            &entry.unit,
            &entry.kn_pa_per_m,
            &entry.measured.n,
            &measured,
            &entry.measured_below,
            &entry.measured_above,
            &entry.measured_mean_error,
            &entry.simulated.n,
            &simulated,
            &[entry.fell_before, entry.stood_to_the_end, entry.lost],
            &entry.difference,
            &entry.difference_sd,
            &entry.difference_sd_measurement,
            &entry.difference_sd_scatter,
            &entry.difference_sd_ensemble,
            &entry.difference_in_sd,
            &entry.agreeing_share,
            &entry.note.unwrap_or(""),
        ]);
    }
    csv.bytes()
}

/// Mean, sigma and coefficient of variation, each with the ends of its interval.
fn moments_cells(moments: &MomentsEntry) -> Vec<Option<f64>> {
    let estimates =
        [(moments.mean, moments.mean_ci), (moments.sigma, moments.sigma_ci), (moments.cov, moments.cov_ci)];
    estimates.into_iter().flat_map(|(value, ends)| [value, ends.map(|e| e[0]), ends.map(|e| e[1])]).collect()
}

/// `calibration.csv`: one line per arm and place of its curve over kn.
pub fn calibration_csv(entries: &[CalibrationEntry]) -> Vec<u8> {
    let mut csv = Csv::new("arm,kn_pa_per_m,mean_deg,sigma_deg,deviance");
    for entry in entries {
        for point in &entry.panel.curve {
            csv.line(&[&entry.arm, &[point.kn, point.mean, point.sigma, point.deviance]]);
        }
    }
    csv.bytes()
}
