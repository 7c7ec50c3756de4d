//! The tables of walls that are shaken.

use crate::render::csv::Csv;
use crate::verb::run::answer::shaken::entry::ShakenSummary;

/// A line per arm, kn and intensity: what was seen, and the isotonic curve with its band.
pub(crate) fn stripes_csv(summary: &ShakenSummary) -> Vec<u8> {
    let mut csv = Csv::new(format!(
        "arm,kn_pa_per_m,{},trials,share,isotonic,isotonic_low,isotonic_high,lognormal,rotation_rad,residual_m",
        summary.measure
    ));
    for curve in &summary.curves {
        for stripe in &curve.stripes {
            let step = &stripe.step;
            let lognormal = curve.lognormal.fit.curve.map(|curve| curve.probability(step.intensity));
            csv.line(&[
                &curve.arm,
                &curve.kn_pa_per_m,
                &step.intensity,
                &step.trials,
                &step.share,
                &step.probability.value,
                &step.probability.interval,
                &lognormal,
                &stripe.rotation_rad,
                &stripe.residual_m,
            ]);
        }
    }
    csv.bytes()
}

/// A line per arm, kn and measure of intensity: the lognormal curve with its intervals.
pub(crate) fn curves_csv(summary: &ShakenSummary) -> Vec<u8> {
    let mut csv = Csv::new(
        "arm,kn_pa_per_m,measure,walls,collapsed,stands,undecided,without_verdict,theta,theta_low,theta_high,beta,beta_low,beta_high",
    );
    for curve in &summary.curves {
        let first = (summary.measure, curve.lognormal);
        let other = curve.other.map(|other| (other.measure, other.lognormal));
        for (measure, lognormal) in [Some(first), other].into_iter().flatten() {
            let counts = curve.counts;
            let (theta, beta) = (lognormal.theta, lognormal.beta);
            csv.line(&[
                &curve.arm,
                &curve.kn_pa_per_m,
                &measure,
                &[curve.walls, counts.collapsed, counts.stands, counts.undecided, counts.without],
                &theta.value,
                &theta.interval,
                &beta.value,
                &beta.interval,
            ]);
        }
    }
    csv.bytes()
}

/// A line per record.
pub(crate) fn records_csv(summary: &ShakenSummary) -> Vec<u8> {
    let mut csv = Csv::new("record,name,pgv_over_pga_s,collapsed");
    for (number, record) in summary.records.iter().enumerate() {
        csv.line(&[&number, &record.name, &record.pgv_over_pga_s, &record.collapsed]);
    }
    csv.bytes()
}
