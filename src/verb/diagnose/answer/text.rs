//! A verdict as people read it on a terminal, and the sentences that the page has as well.

use crate::critic::{Counted, Limits};
use crate::render::number::{how_often, significant, within};
use crate::render::text::{aligned, wrapped};
use crate::stats;
use crate::study::listed;
use crate::verb::diagnose::answer::conclusion::conclusion;
use crate::verb::diagnose::answer::summary::{
    CauseEntry, DiagnosisSummary, LooksEntry, OffEntry, SelfTestEntry,
};
use crate::verb::diagnose::answer::words::{lines, reading};
use crate::verb::diagnose::gain::GainSummary;
use crate::verb::run::answer::conclusion::MOST_LINES;

/// What is off by less than this many standard deviations is not worth a line.
const WORTH_SAYING: f64 = 2.0;
/// Shares are shown in whole per cents where their intervals are wider than this (%).
const WHOLE: f64 = 2.0;
/// So many causes are shown.
pub(crate) const CAUSES: usize = 6;

/// The verdict for a terminal: the conclusion, then what it rests on under headings.
pub fn diagnosis_text(summary: &DiagnosisSummary) -> String {
    // At most five lines: what would make more stands below as well.
    let mut text = String::new();
    for sentence in conclusion(summary).iter().map(|sentence| wrapped("", sentence)) {
        if text.lines().count() + sentence.lines().count() > MOST_LINES {
            break;
        }
        text.push_str(&sentence);
    }
    text.push_str(&format!("\n{OFF}\n"));
    text.push_str(&by_chance(summary).map_or_else(String::new, |words| wrapped("  ", &words)));
    let worth = worth_saying(summary);
    for off in &worth {
        text.push_str(&wrapped(&format!("  {:+6.1}  ", off.in_sd), &off.what));
    }
    if worth.is_empty() {
        text.push_str("  nothing by two or more\n");
    }
    if !summary.groups.is_empty() {
        text.push_str("\nMeasured beside simulated\n");
        text.push_str(&wrapped("  ", &reading(&summary.groups)));
        for line in lines(&summary.groups) {
            text.push_str(&wrapped("  - ", &line.sentence()));
        }
    }
    text.push_str(&causes(summary));
    if summary.verdict == "unexplained" {
        text.push_str(&format!("\n{}", wrapped("", FORM)));
        summary.form.iter().for_each(|own| text.push_str(&wrapped("  - ", &own.sentence())));
        if summary.form.is_empty() {
            text.push_str(&format!("  {NO_FORM}\n"));
        }
    }
    text.push_str(&summary.gain.as_ref().map_or_else(String::new, GainSummary::text));
    text.push_str(&summary.advice.text());
    text.push_str("\nHow often such verdicts are right\n");
    reliability(summary).iter().for_each(|sentence| text.push_str(&wrapped("  - ", sentence)));
    text.push_str(&not_used(summary).map_or_else(String::new, |words| format!("\n{}", wrapped("", &words))));
    text
}

/// The table of causes, the best pair, and why others are excluded.
fn causes(summary: &DiagnosisSummary) -> String {
    let row = |cells: [String; 5]| cells.to_vec();
    let head = ["cause", "", "probability", "evidence", "predictive p"].map(String::from);
    let mut rows = vec![row(head)];
    for cause in summary.causes.iter().take(CAUSES) {
        let mark = if cause.in_verdict { "*" } else { "" };
        let [evidence, check] = [cause.evidence, cause.guard_p_value].map(or_dash);
        let [name, mark] = [cause.id, mark].map(String::from);
        rows.push(row([name, mark, format!("{:.3}", cause.probability), evidence, check]));
    }
    for (what, probability) in others(summary) {
        let dash = || "-".to_string();
        rows.push(row([what.to_string(), String::new(), format!("{probability:.3}"), dash(), dash()]));
    }
    let mut text = format!("\nCauses (*: in the verdict)\n{}\n{}", wrapped("  ", CAUSE), aligned(rows));
    for cause in summary.causes.iter().filter(|cause| cause.in_verdict) {
        let scope = cause.scope.as_ref().map(|scope| format!("{}: acts on {}", cause.id, scope.with_share()));
        text.push_str(&scope.map_or_else(String::new, |words| wrapped("  ", &words)));
        for parameter in &cause.parameters {
            text.push_str(&wrapped("  ", &format!("{}: {}", cause.id, parameter.words())));
        }
        beside_prior(cause).iter().for_each(|words| text.push_str(&wrapped("  ", words)));
    }
    text.push_str(&pairs(summary).map_or_else(String::new, |words| wrapped("  ", &words)));
    excluded(summary).iter().for_each(|words| text.push_str(&wrapped("  - ", words)));
    text
}

/// Whether a cause acts as its physical prior expects, and where each parameter lies in it.
pub(crate) fn beside_prior(cause: &CauseEntry) -> Vec<String> {
    let Some(p) = cause.conflict_p_value else { return Vec::new() };
    let verdict = match p < Limits::default().conflict {
        true => "it acts outside its physical prior",
        false => "it may act within its physical prior",
    };
    let first = format!(
        "{}: {verdict}. Of the campaigns that it predicts there, {} % lie as far out as the measurements.",
        cause.id,
        significant(100.0 * p, 2)
    );
    let parameters = cause.parameters.iter().filter_map(|own| own.beside_prior());
    std::iter::once(first).chain(parameters).collect()
}

/// What the numbers of what is off are.
pub(crate) const OFF: &str =
    "What is off (measured less simulated, in standard deviations of campaigns without any effect)";
/// What the numbers of the causes are.
pub(crate) const CAUSE: &str = "probability: posterior, all causes equally likely beforehand. \
    evidence: share of the marginal likelihood among the causes looked at closely; it is too sure of itself to be taken alone. \
    predictive p: share of the campaigns that the cause predicts, as the readings have it act, that fit worse. A dash: not computed. \
    search prior: four times the spread of the documented prior. \
    not in catalogue: smooth random effects that no cause here describes";
/// What the numbers of a form are.
pub(crate) const FORM: &str = "Form of what is not explained (measured less base model with fitted joints, if it is smooth over tilt or drift or goes with the order of the tests; brackets: 95 %, for these joints)";

/// What is said where nothing of it is sure.
pub(crate) const NO_FORM: &str = "none that is sure";

/// What is likely besides the causes.
pub(crate) fn others(summary: &DiagnosisSummary) -> [(&'static str, f64); 2] {
    [("not in catalogue", summary.nameless_probability), ("base model", summary.base_probability)]
}

/// A share, or a dash where there is none.
pub(crate) fn or_dash(share: Option<f64>) -> String {
    share.map_or("-".to_string(), |share| significant(share, 2))
}

/// How often campaigns without any effect are as far off, where something is wrong.
pub(crate) fn by_chance(summary: &DiagnosisSummary) -> Option<String> {
    let often = |p: f64| how_often(p, summary.p_value_campaigns);
    let LooksEntry { furthest, together, likeness } = summary.looks;
    (summary.verdict != "nothing_found").then(|| {
        format!(
            "Simulated campaigns without any effect that are as far off: {} in all; by the furthest single number {}, by all numbers \
             together {}, by the ranking of causes {}.",
            often(summary.p_value),
            often(furthest),
            often(together),
            often(likeness)
        )
    })
}

/// What is off enough for a line, the furthest first.
pub(crate) fn worth_saying(summary: &DiagnosisSummary) -> Vec<&OffEntry> {
    summary.off.iter().filter(|off| off.in_sd.abs() >= WORTH_SAYING).collect()
}

/// The pair with most of the evidence, where pairs were examined.
pub(crate) fn pairs(summary: &DiagnosisSummary) -> Option<String> {
    let (pair, limits) = (summary.pairs.first()?, Limits::default());
    Some(format!(
        "Of {} pairs {} and {} have the largest share of the evidence: {}, predictive p {}. A pair is named from {} and {} on, if \
         the probability of something outside the catalogue is at most {} and the p-value below {}.",
        summary.pairs.len(),
        pair.ids[0],
        pair.ids[1],
        significant(pair.evidence, 2),
        or_dash(pair.guard_p_value),
        limits.pair.named,
        limits.pair.check,
        limits.pair.unmodelled,
        limits.sure
    ))
}

/// Where no cause is named, though something is wrong: which causes are put aside and why, and which are not.
pub(crate) fn excluded(summary: &DiagnosisSummary) -> Vec<String> {
    if !["ambiguous", "unexplained"].contains(&summary.verdict) {
        return Vec::new();
    }
    let by = |why: Option<&str>| -> Vec<&str> {
        summary.causes.iter().filter(|cause| cause.excluded_by == why).map(|cause| cause.id).collect()
    };
    [
        ("Excluded within its search prior by the posterior predictive check", by(Some("readings"))),
        (
            "Excluded within its search prior by the ranking (nine in ten of its own campaigns rank it higher)",
            by(Some("looks")),
        ),
        ("Excluded within its search prior by the evidence (20 to 1 or more against it)", by(Some("evidence"))),
        ("Not excluded", by(None)),
    ]
    .into_iter()
    .filter(|(_, causes)| !causes.is_empty())
    .map(|(why, causes)| format!("{why}: {}.", causes.join(", ")))
    .collect()
}

/// What was not used of the measurements.
pub(crate) fn not_used(summary: &DiagnosisSummary) -> Option<String> {
    let reasons = summary.unused.iter().map(|own| format!("{} ({})", listed(&own.lines), own.why));
    let reasons: Vec<String> = reasons.collect();
    (!reasons.is_empty()).then(|| format!("Not used of the measurements: {}", reasons.join("; ")))
}

/// What the self-test says, a sentence each.
pub(crate) fn reliability(summary: &DiagnosisSummary) -> Vec<String> {
    let (nothing, hidden): (Vec<_>, Vec<_>) =
        summary.self_test.iter().partition(|row| row.hidden == "nothing");
    let sum = |rows: &[&SelfTestEntry], of: fn(&SelfTestEntry) -> Counted| {
        rows.iter().map(|row| of(row)).sum::<Counted>()
    };
    let (all, strong) = (sum(&hidden, |row| row.all), sum(&hidden, |row| row.strong));
    let (judged, nothing_judged) = (sum(&hidden, |row| row.judged), sum(&nothing, |row| row.judged));
    let (still, unmodelled) = (sum(&nothing, |row| row.all), summary.self_test_nameless.judged);
    let wrong_scope = hidden.iter().map(|row| row.wrong_scope).sum::<u64>();
    let counted = |part: u64, whole: u64| format!("{part} of {whole}, {}", share(part, whole));
    let mut sentences = vec![
        format!(
            "Power (simulated campaigns read like these, 95 % intervals): an effect drawn from its search prior is found in {}, \
             one of the third that moves the readings most in {}.",
            share(all.found, all.campaigns),
            share(strong.found, strong.campaigns),
        ),
        format!(
            "False alarms: something is found in {} of campaigns without an effect, and a cause is named by the ranking in {}.",
            share(still.found, still.campaigns),
            share(still.misnamed, still.campaigns),
        ),
        format!(
            "Named by the ranking alone: {}, of the strongest third {}; such a name is wrong in {}.",
            share(all.named, all.campaigns),
            share(strong.named, strong.campaigns),
            share(all.misnamed, all.named + all.misnamed),
        ),
    ];
    sentences.push(match judged.campaigns {
        0 => "Named by the whole diagnosis: not counted yet. pirca diagnose --prepare does, with the same measurements (--measured) and the \
              bank's folder (--out)."
            .to_string(),
        _ => format!(
            "Named by the whole diagnosis: {}, {wrong_scope} of these on wrong joints; another cause in {}; with nothing hidden a cause in {}, with something outside the \
             catalogue in {}.",
            counted(judged.named, judged.campaigns),
            counted(judged.misnamed, judged.campaigns),
            counted(nothing_judged.misnamed, nothing_judged.campaigns),
            counted(unmodelled.misnamed, unmodelled.campaigns)
        ),
    });
    sentences
}

/// A share with its 95 % interval; a dash of nothing.
fn share(part: u64, whole: u64) -> String {
    if whole == 0 {
        return "-".to_owned();
    }
    let value = 100.0 * part as f64 / whole as f64;
    let interval = stats::clopper_pearson(part as usize, whole as usize).map(|end| 100.0 * end);
    let width = interval[1] - interval[0];
    // A count of a few hundred tells whole per cents.
    let shown = |x: f64| if width > WHOLE { format!("{x:.0}") } else { within(x, width) };
    let [low, high] = interval.map(shown);
    format!("{} % [{low}, {high}]", shown(value))
}
