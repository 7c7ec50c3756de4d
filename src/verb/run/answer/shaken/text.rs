//! What `run` prints of walls that are shaken: the answer, the curves, what scatters, and the arms compared. At most 100 columns wide.

use crate::render::number::{
    compact, from_to, or_dash, shortened, significant, stiffness, with_interval, with_interval_against,
};
use crate::render::text::{LONGEST_NAME, aligned, wrapped};
use crate::stats::Estimate;
use crate::stats::fragility::Told;
use crate::verb::run::answer::shaken::entry::{RatioEntry, ShakenCurve, ShakenSummary};
use crate::verb::run::answer::summary::Summary;

/// The summary as text for a terminal.
pub(crate) fn text(summary: &Summary, shaken: &ShakenSummary) -> String {
    let mut text = wrapped("", &summary.question);
    text.push_str(&wrapped("", &answer(summary, shaken)));
    text.push_str(&format!("\nFragility ({} solver, seed {})\n", summary.solver, summary.seed));
    text.push_str(&wrapped("", &explanation(shaken)));
    text.push('\n');
    text.push_str(&curves(shaken));
    text.push_str(&shares(shaken));
    text.push_str(&ratios(shaken));
    text.push_str(&measures(shaken));
    text
}

fn shown(estimate: Estimate, digits: usize) -> String {
    with_interval(estimate.value, estimate.interval, digits)
}

/// How many runs there were and how they ended, and the strongest arm.
fn answer(summary: &Summary, shaken: &ShakenSummary) -> String {
    let sum = |of: fn(&ShakenCurve) -> usize| shaken.curves.iter().map(of).sum::<usize>();
    let walls = sum(|curve| curve.walls);
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let mut said = format!(
        "{}{variant}: {walls} walls under {} records at {} intensities: {} runs collapsed, {} did not, {} undecided, {} without a verdict.",
        summary.study,
        shaken.records.len(),
        shaken.intensities.len(),
        sum(|curve| curve.counts.collapsed),
        sum(|curve| curve.counts.stands),
        sum(|curve| curve.counts.undecided),
        sum(|curve| curve.counts.without),
    );
    said += &strongest(shaken);
    said
}

/// Which arm needs the strongest shaking, where the records show it of one.
fn strongest(shaken: &ShakenSummary) -> String {
    let theta = |curve: &ShakenCurve| curve.lognormal.theta.value.unwrap_or(0.0);
    let known = shaken.curves.iter().filter(|curve| curve.lognormal.theta.value.is_some());
    let Some(best) = known.max_by(|a, b| theta(a).total_cmp(&theta(b))) else { return String::new() };
    let median =
        format!("{} of {} {}", shaken.shown.name(), shown(best.lognormal.theta, 3), shaken.shown.unit());
    // A ratio is that of the arm that comes first in the study over the other.
    let beats = |own: &RatioEntry| {
        let [low, high] = own.theta.interval.unwrap_or([0.0, f64::INFINITY]);
        if own.arm == best.arm { low > 1.0 } else { high < 1.0 }
    };
    let of_best =
        |own: &&RatioEntry| own.kn_pa_per_m == best.kn_pa_per_m && [&own.arm, &own.over].contains(&&best.arm);
    let ratios: Vec<&RatioEntry> = shaken.ratios.iter().filter(of_best).collect();
    match (ratios.is_empty(), ratios.iter().all(|own| beats(own))) {
        (true, _) => format!(" Half of the runs of {} collapse at a {median}.", best.arm),
        (false, true) => {
            format!(" The strongest arm is {}: half of its runs collapse at a {median}.", best.arm)
        }
        (false, false) => format!(
            " No arm is shown to be the strongest; the largest median is that of {}, a {median}.",
            best.arm
        ),
    }
}

fn explanation(shaken: &ShakenSummary) -> String {
    let undecided = match shaken.twice {
        true => {
            "Undecided are runs that a start 1e-9 m/s off rest ends otherwise; each counts as half a collapse. "
        }
        false => "",
    };
    let measure = shaken.shown.name();
    format!(
        "Each line is one arm at one normal stiffness kn of the joints. A wall has collapsed when {}. The curve is \
         P(collapse) = Phi(ln({measure}/theta)/beta); theta is the median in {}. Brackets hold 95 % intervals for other \
         records and walls of the same kinds. {undecided}A dash: not defined.",
        shaken.collapse_words,
        shaken.shown.unit()
    )
}

fn curves(shaken: &ShakenSummary) -> String {
    let heads = ["arm", "kn Pa/m", "walls", "collapsed", "stands", "undecided", "no verdict"];
    let mut runs = vec![heads.map(String::from).to_vec()];
    let mut fits = vec![["arm", "kn Pa/m", "theta", "beta"].map(String::from).to_vec()];
    for curve in &shaken.curves {
        let counts = curve.counts;
        let counted = [curve.walls, counts.collapsed, counts.stands, counts.undecided, counts.without];
        let head = [curve.arm.clone(), compact(curve.kn_pa_per_m)];
        runs.push(head.iter().cloned().chain(counted.map(|count| count.to_string())).collect());
        let fit = [shown(curve.lognormal.theta, 3), shown(curve.lognormal.beta, 2)];
        fits.push(head.into_iter().chain(fit).collect());
    }
    let mut text = format!("{}\n{}", aligned(runs), aligned(fits));
    for curve in &shaken.curves {
        let notes = [told(shaken, curve), unlike(curve), not_monotone(curve), unsolved(curve)];
        for note in notes.into_iter().flatten() {
            let whose = format!("{} at kn {}: ", curve.arm, stiffness(curve.kn_pa_per_m));
            text.push_str(&wrapped("! ", &(whose + &note)));
        }
    }
    text
}

/// Why there is no curve.
fn told(shaken: &ShakenSummary, curve: &ShakenCurve) -> Option<String> {
    let (measure, unit) = (shaken.shown.name(), shaken.shown.unit());
    match curve.lognormal.fit.told {
        Told::Curve => None,
        Told::NoTrial => Some("no run has a verdict".to_owned()),
        Told::OneIntensity { .. } => Some("one intensity makes no curve; add others".to_owned()),
        Told::NoneCollapsed { highest } => Some(format!(
            "no run collapsed up to a {measure} of {} {unit}; go higher",
            significant(highest, 3)
        )),
        Told::AllCollapsed { lowest } => Some(format!(
            "every run collapsed from a {measure} of {} {unit} on; go lower",
            significant(lowest, 3)
        )),
        Told::BetaNotIdentified { theta: [low, high] } => Some(format!(
            "beta is not identified, as no run stands above one that collapses; theta lies within {} {unit} if beta is \
             small; add intensities between them",
            from_to([low, high], 3)
        )),
        Told::NotRising => {
            Some(format!("collapses do not grow with {measure}, which is no measure of what topples"))
        }
    }
}

/// That the curve is not lognormal.
fn unlike(curve: &ShakenCurve) -> Option<String> {
    let own = curve.agreement?;
    let p_value = own.p_value.filter(|p| *p < 0.05)?;
    Some(format!(
        "the curve is not lognormal (p = {}, {} campaigns drawn): trust the isotonic one in fragility.csv",
        significant(p_value, 2),
        own.drawn
    ))
}

fn not_monotone(curve: &ShakenCurve) -> Option<String> {
    let counts = curve.counts;
    (counts.not_monotone > 0).then(|| {
        format!(
            "in {} of {} pairs of record and wall ({} %) the wall stands at an intensity above one at which it collapses",
            counts.not_monotone,
            counts.pairs,
            with_interval(
                counts.share_not_monotone.value.map(|x| 100.0 * x),
                counts.share_not_monotone.interval.map(|ends| ends.map(|x| 100.0 * x)),
                2
            )
        )
    })
}

fn unsolved(curve: &ShakenCurve) -> Option<String> {
    let runs = curve.runs_with_unsolved_steps;
    (runs > 0).then(|| {
        format!(
            "runs with time steps that were not solved to the tolerance: {runs}; a shorter solver.time_step_s may solve them"
        )
    })
}

/// A share in per cent.
fn percent(share: Estimate) -> String {
    let interval = share.interval.map(|ends| ends.map(|x| 100.0 * x));
    with_interval(share.value.map(|value| 100.0 * value), interval, 2)
}

/// Where the scatter of capacities comes from.
fn shares(shaken: &ShakenSummary) -> String {
    let mut rows = vec![["arm", "kn Pa/m", "record", "wall", "pair", "rest"].map(String::from).to_vec()];
    for curve in &shaken.curves {
        let Some(own) = curve.shares.filter(|own| own.record.value.is_some()) else { continue };
        let mut row = vec![curve.arm.clone(), compact(curve.kn_pa_per_m)];
        row.extend([own.record, own.wall, own.interaction, own.rest].map(percent));
        rows.push(row);
    }
    if rows.len() == 1 {
        return String::new();
    }
    format!("\nShares of the variance of the logarithm of capacity (%)\n{}", aligned(rows))
}

fn ratios(shaken: &ShakenSummary) -> String {
    let mut rows = vec![["arms", "kn Pa/m", "ratio of theta", "ratio of beta"].map(String::from).to_vec()];
    for own in &shaken.ratios {
        let against = |ratio: Estimate| with_interval_against(ratio.value, ratio.interval, 3, 1.0);
        let half = LONGEST_NAME / 2 - 2;
        let arms = format!("{} / {}", shortened(&own.arm, half), shortened(&own.over, half));
        rows.push(vec![arms, compact(own.kn_pa_per_m), against(own.theta), against(own.beta)]);
    }
    if rows.len() == 1 {
        return String::new();
    }
    format!(
        "\nRatios of arms under the same records (theta above 1: the first is the stronger)\n{}",
        aligned(rows)
    )
}

/// Which measure predicts better, and what a slow tilt tells.
fn measures(shaken: &ShakenSummary) -> String {
    let own = shaken.shown;
    let mut rows = vec![vec![
        "arm".to_owned(),
        "kn Pa/m".to_owned(),
        format!("beta in {}", own.name()),
        format!("beta in {}", own.other().name()),
        "difference".to_owned(),
        "tilt capacity deg".to_owned(),
    ]];
    for curve in &shaken.curves {
        let Some(other) = curve.other.filter(|other| other.lognormal.beta.value.is_some()) else { continue };
        rows.push(vec![
            curve.arm.clone(),
            compact(curve.kn_pa_per_m),
            or_dash(curve.lognormal.beta.value, 2),
            or_dash(other.lognormal.beta.value, 2),
            with_interval_against(other.own_less_this.beta.value, other.own_less_this.beta.interval, 2, 0.0),
            shown(curve.tilt_capacity_deg, 3),
        ]);
    }
    let mut text = String::new();
    if rows.len() > 1 {
        text += &format!(
            "\nPredictors (difference of betas below 0: {} predicts better than {})\n{}",
            own.name(),
            own.other().name(),
            aligned(rows)
        );
    }
    if let Some(tilt) = shaken.tilt.filter(|tilt| tilt.correlation.value.is_some()) {
        text += &wrapped(
            "",
            &format!(
                "Correlation of a wall's tilt capacity with the share of its runs that collapsed, over {} walls of all arms: {}.",
                tilt.walls,
                shown(tilt.correlation, 2)
            ),
        );
    }
    text
}
