//! What `run` prints of measured beside simulated.

use crate::render::number::{compact, from_to, or_dash, significant, stiffness, with_interval};
use crate::render::text::{aligned, wrapped};
use crate::stats::sigma_factors;
use crate::verb::run::answer::measured::{CalibrationEntry, ComparisonEntry, MeasuredSummary};

/// The section of the report; empty where nothing was measured.
pub fn text(measured: Option<&MeasuredSummary>) -> String {
    let Some(measured) = measured else { return String::new() };
    let mut text = "\nMeasured beside these numbers\n".to_string();
    let with_values: Vec<&ComparisonEntry> =
        measured.comparison.iter().filter(|e| e.measured.n > 0).collect();
    if !with_values.is_empty() {
        text.push_str(&wrapped("", EXPLANATION));
        text.push_str(&aligned(rows(&with_values)));
        text.push_str(&factors(&with_values));
    }
    text.push_str(&bounds(&measured.comparison));
    for entry in &measured.comparison {
        text.push_str(&remarks(entry));
    }
    for entry in &measured.calibration {
        text.push_str(&calibration(entry));
    }
    if let Some(first) = measured.calibration.first() {
        text.push_str(&wrapped("! ", first.note));
    }
    text
}

const EXPLANATION: &str = "Displacements in mm, angles in deg, pushes in kN. Numbers in brackets are 95 % intervals. ours - theirs: \
    difference of the means, and the same over its standard deviation (errors of the readings, scatter of the specimens \
    and sampling error of our mean together; where it is mostly the scatter of few specimens, this ratio follows Student's t \
    and not the normal law). comparison.csv has the parts.";

fn rows(entries: &[&ComparisonEntry]) -> Vec<Vec<String>> {
    let header = [
        "family",
        "measured",
        "kn Pa/m",
        "n",
        "mean",
        "sigma",
        "ours",
        "sigma",
        "ours - theirs",
        "over its sd",
    ];
    let mut rows = vec![header.map(String::from).to_vec()];
    for entry in entries {
        let shown = |x: f64| match entry.unit {
            "m" => 1e3 * x,
            "N" if entry.drift_percent.is_some() => 1e-3 * x,
            _ => x,
        };
        rows.push(vec![
            entry.family.clone(),
            what(entry),
            entry.kn_pa_per_m.map_or_else(|| "-".to_string(), compact),
            entry.measured.n.to_string(),
            or_dash(entry.measured.mean.map(shown), 3),
            with_interval(
                entry.measured.sigma.map(shown),
                entry.measured.sigma_ci.map(|ci| ci.map(shown)),
                2,
            ),
            or_dash(entry.simulated.mean.map(shown), 3),
            or_dash(entry.simulated.sigma.map(shown), 2),
            or_dash(entry.difference.map(shown), 3),
            or_dash(entry.difference_in_sd, 2),
        ]);
    }
    rows
}

/// The quantity and its tilt in few letters.
fn what(entry: &ComparisonEntry) -> String {
    let name = match entry.quantity {
        "displacement_centre_minus_ends" => "centre - ends".to_string(),
        name => name.replace("displacement_", "displ. ").replace('_', " "),
    };
    match (entry.tilt_deg, entry.drift_percent) {
        (Some(tilt), _) => format!("{name}, {tilt} deg"),
        (None, Some(drift)) => format!("{name}, {drift} %"),
        (None, None) => name,
    }
}

/// How uncertain a sigma of few values is.
fn factors(entries: &[&ComparisonEntry]) -> String {
    let mut counts: Vec<u64> = entries.iter().map(|e| e.measured.n).filter(|n| *n > 1).collect();
    counts.sort_unstable();
    counts.dedup();
    let words = counts.iter().map(|&n| {
        let [low, high] = sigma_factors(n as usize);
        format!("from {n} values it is {low:.2} to {high:.2} times the value")
    });
    let words: Vec<String> = words.collect();
    if words.is_empty() {
        return String::new();
    }
    wrapped("! ", &format!("The 95 % interval of a sigma is wide: {}.", words.join("; ")))
}

/// Where only bounds are known: the share of our walls that agree, a line per family, quantity and tilt.
fn bounds(entries: &[ComparisonEntry]) -> String {
    let mut lines: Vec<(String, Vec<String>)> = Vec::new();
    for entry in entries {
        let known = entry.measured_below + entry.measured_above;
        let Some((share, kn)) = entry.agreeing_share.zip(entry.kn_pa_per_m).filter(|_| known > 0) else {
            continue;
        };
        let head = format!(
            "{}, {}: only bounds are known of {known} specimen{}; walls that agree",
            entry.family,
            what(entry),
            if known == 1 { "" } else { "s" }
        );
        let part = format!("{:.0} % at kn {}", 100.0 * share, compact(kn));
        match lines.last_mut() {
            Some((last, parts)) if *last == head => parts.push(part),
            _ => lines.push((head, vec![part])),
        }
    }
    lines.iter().map(|(head, parts)| wrapped("", &format!("{head}: {}", parts.join(", ")))).collect()
}

/// Walls that bring no value, and why there is nothing of ours.
fn remarks(entry: &ComparisonEntry) -> String {
    let mut parts = Vec::new();
    for (count, words) in [
        (entry.fell_before, "fell before"),
        (entry.stood_to_the_end, "stood to the end of the load path"),
        (entry.lost, "bring no value"),
    ] {
        if count > 0 {
            parts.push(format!("{count} of our walls {words}"));
        }
    }
    parts.extend(entry.note.map(|why| format!("not compared: {why}")));
    if parts.is_empty() {
        return String::new();
    }
    let kn = entry.kn_pa_per_m.map_or_else(String::new, |kn| format!(" at kn {}", stiffness(kn)));
    wrapped("! ", &format!("{}, {}{kn}: {}", entry.family, what(entry), parts.join("; ")))
}

fn calibration(entry: &CalibrationEntry) -> String {
    let best = match (entry.kn_pa_per_m, entry.beyond()) {
        (Some(kn), _) => format!("kn = {} Pa/m", short(kn)),
        (None, beyond) => format!("kn is {}", beyond.unwrap_or("not found")),
    };
    let mut text = format!(
        "{}: {best} by {} measured collapse angles; 68 % {}, 95 % {}; phi {} deg held; the specimens scatter by {} deg beyond \
         our walls.",
        entry.arm,
        entry.specimens,
        interval(entry.kn_68_pa_per_m),
        interval(entry.kn_95_pa_per_m),
        entry.phi_deg,
        significant(entry.extra_scatter_deg, 2),
    );
    for other in &entry.other_friction {
        let kn = other.kn_pa_per_m.map_or_else(|| "beyond the points".to_string(), short);
        text.push_str(&format!(
            " With phi {} deg ({}): {kn}, 95 % {}.",
            other.phi_deg,
            other.arm,
            interval(other.kn_95_pa_per_m)
        ));
    }
    for point in &entry.left_out {
        text.push_str(&format!(" Without kn {}: {}.", stiffness(point.kn_pa_per_m), point.why));
    }
    wrapped("Calibration  ", &text)
}

fn interval(ends: [Option<f64>; 2]) -> String {
    if let [Some(low), Some(high)] = ends {
        return from_to([low, high], 2);
    }
    let end = |end: Option<f64>, open: &str| end.map_or_else(|| open.to_string(), short);
    format!("{} to {}", end(ends[0], "below the points"), end(ends[1], "above the points"))
}

/// Two digits.
fn short(kn: f64) -> String {
    format!("{kn:.1e}")
}
