//! The tables of walls that are shaken.

use crate::render::csv::{cell, ends, quoted};
use crate::stats::Estimate;
use crate::verb::run::answer::shaken::entry::ShakenSummary;

fn cells(estimate: Estimate) -> [String; 3] {
    let [low, high] = ends(estimate.interval);
    [cell(estimate.value), low, high]
}

/// A line per arm, kn and intensity: what was seen, and the isotonic curve with its band.
pub(crate) fn stripes_csv(summary: &ShakenSummary) -> String {
    let mut text = format!(
        "arm,kn_pa_per_m,{},trials,share,isotonic,isotonic_low,isotonic_high,lognormal,rotation_rad,residual_m\n",
        summary.measure
    );
    for curve in &summary.curves {
        for stripe in &curve.stripes {
            let step = &stripe.step;
            let lognormal = curve.lognormal.fit.curve.map(|own| own.probability(step.intensity));
            let [isotonic, low, high] = cells(step.probability);
            let own = [
                quoted(&curve.arm),
                curve.kn_pa_per_m.to_string(),
                step.intensity.to_string(),
                step.trials.to_string(),
                step.share.to_string(),
                isotonic,
                low,
                high,
                cell(lognormal),
                cell(stripe.rotation_rad),
                cell(stripe.residual_m),
            ];
            text.push_str(&(own.join(",") + "\n"));
        }
    }
    text
}

/// A line per arm, kn and measure of intensity: the lognormal curve with its intervals.
pub(crate) fn curves_csv(summary: &ShakenSummary) -> String {
    let mut text = "arm,kn_pa_per_m,measure,walls,collapsed,stands,undecided,without_verdict,theta,theta_low,theta_high,beta,beta_low,\
                    beta_high\n"
        .to_owned();
    for curve in &summary.curves {
        let own = (summary.measure, curve.lognormal);
        let other = curve.other.map(|other| (other.measure, other.lognormal));
        for (measure, lognormal) in [Some(own), other].into_iter().flatten() {
            let counts = curve.counts;
            let head = [quoted(&curve.arm), curve.kn_pa_per_m.to_string(), measure.to_owned()];
            let counted = [curve.walls, counts.collapsed, counts.stands, counts.undecided, counts.without];
            let counted = counted.map(|count| count.to_string());
            let all: Vec<String> =
                [&head[..], &counted, &cells(lognormal.theta), &cells(lognormal.beta)].concat();
            text.push_str(&(all.join(",") + "\n"));
        }
    }
    text
}

/// A line per record.
pub(crate) fn records_csv(summary: &ShakenSummary) -> String {
    let mut text = "record,name,pgv_over_pga_s,collapsed\n".to_owned();
    for (number, record) in summary.records.iter().enumerate() {
        let name = quoted(&record.name);
        text.push_str(&format!("{number},{name},{},{}\n", record.pgv_over_pga_s, cell(record.collapsed)));
    }
    text
}
