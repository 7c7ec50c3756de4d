//! A verdict as people read it on a terminal, and the sentences that the page has as well.

use crate::critic::{Counted, Limits, MOST_AMBIGUOUS};
use crate::report::diagnosis::summary::{DiagnosisSummary, LooksEntry, OffEntry, SelfTestEntry};
use crate::report::diagnosis::words::{lines, reading};
use crate::report::gain::GainSummary;
use crate::report::number::significant;
use crate::report::table::wrapped;
use crate::stats;
use crate::study::listed;

/// What is off by less than this many standard deviations is not worth a line.
const WORTH_SAYING: f64 = 2.0;
/// So many causes are shown.
pub(super) const CAUSES: usize = 6;

/// The verdict for a terminal.
pub fn diagnosis_text(summary: &DiagnosisSummary) -> String {
    let mut text = format!("Study {}, seed {}\n\n{}\n", summary.study, summary.seed, verdict(summary));
    text.push_str(&by_chance(summary).map_or_else(String::new, |words| wrapped("", &words)));
    text.push_str(&format!("\n{OFF}\n"));
    let worth = worth_saying(summary);
    for off in &worth {
        text.push_str(&format!("  {:+6.1}  {}\n", off.in_sd, off.what));
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
    text.push_str(&format!("\nCauses\n{}", wrapped("  ", CAUSE)));
    for cause in summary.causes.iter().take(CAUSES) {
        let mark = if cause.in_verdict { "*" } else { " " };
        let [evidence, guard] = [cause.evidence, cause.guard_p_value].map(or_dash);
        text.push_str(&format!(
            "{mark} {:<18} {:>6.3}   evidence {evidence}   guard {guard}\n",
            cause.id, cause.probability
        ));
        for parameter in cause.parameters.iter().filter(|_| cause.in_verdict) {
            text.push_str(&format!("      {}\n", parameter.words()));
        }
    }
    for (what, probability) in others(summary) {
        text.push_str(&format!("  {what:<18} {probability:>6.3}\n"));
    }
    text.push_str(&pairs(summary).map_or_else(String::new, |words| wrapped("", &words)));
    if summary.verdict == "unexplained" {
        text.push_str(&format!("\n{FORM}\n"));
        summary.form.iter().for_each(|bent| text.push_str(&wrapped("  - ", &bent.sentence())));
        if summary.form.is_empty() {
            text.push_str(&format!("  {NO_FORM}\n"));
        }
    }
    excluded(summary).iter().for_each(|words| text.push_str(&wrapped("  - ", words)));
    text.push_str(&summary.gain.as_ref().map_or_else(String::new, GainSummary::text));
    text.push_str(&summary.advice.text());
    text.push_str(&format!("\n{}", wrapped("", &reliability(summary))));
    text.push_str(&not_used(summary).map_or_else(String::new, |words| format!("\n{}", wrapped("", &words))));
    text
}

/// What the numbers of what is off are.
pub(super) const OFF: &str =
    "What is off (measured less simulated, in standard deviations of campaigns without any effect)";
/// What the numbers of the causes are.
pub(super) const CAUSE: &str = "Probability if all were equally likely before, by how each one's campaigns look and by the evidence together. \
    Something else: random forms of what walls do and gauges show, which are no cause's. \
    Evidence: its share of that of the causes looked at closely, which knows every reading, and is too sure of itself to be taken alone. \
    Guard: share of the cause's own campaigns that fit worse, in the worse of two looks and doubled for these. A dash: not asked";
/// What the numbers of a form are.
pub(super) const FORM: &str = "Form of what is not explained (measured less base model with fitted joints, if it is smooth over the tilt, or goes with the order of the tests; in brackets 95 %, if these joints and its size were known)";

/// What is said where nothing of it is sure.
pub(super) const NO_FORM: &str = "none that is sure";

/// What is likely besides the causes.
pub(super) fn others(summary: &DiagnosisSummary) -> [(&'static str, f64); 2] {
    [("something else", summary.nameless_probability), ("nothing", summary.base_probability)]
}

/// A share, or a dash where there is none.
pub(super) fn or_dash(share: Option<f64>) -> String {
    share.map_or("-".to_string(), |share| significant(share, 2))
}

/// The verdict in a sentence.
pub(super) fn verdict(summary: &DiagnosisSummary) -> String {
    match summary.verdict {
        "nothing_found" => format!(
            "NOTHING FOUND: what is off is no more than errors, scatter and joints within their priors make of it (p {}).",
            significant(summary.p_value, 2)
        ),
        "named" if summary.pairs.iter().any(|pair| pair.in_verdict) => {
            "NAMED: something is wrong, and two causes together explain it.".to_string()
        }
        "named" => "NAMED: something is wrong, and one cause explains it.".to_string(),
        "ambiguous" if summary.causes.iter().filter(|cause| cause.in_verdict).count() == 1 => {
            "AMBIGUOUS: something is wrong, and this cause explains it, but not surely enough to be named."
                .to_string()
        }
        "ambiguous" => {
            "AMBIGUOUS: something is wrong, and the data cannot tell between these causes.".to_string()
        }
        _ => match summary.causes.iter().filter(|cause| cause.excluded_by.is_none()).count() {
            0 => {
                "UNEXPLAINED: something is wrong, and no one cause of the catalogue explains it; no pair is named."
                    .to_string()
            }
            open => {
                let many = if open > MOST_AMBIGUOUS { ": more than these data can tell apart" } else { "" };
                format!(
                    "UNEXPLAINED: something is wrong, and no cause explains it surely; {open} of the catalogue cannot be excluded{many}."
                )
            }
        },
    }
}

/// How often campaigns without any effect are as far off, where something is wrong.
pub(super) fn by_chance(summary: &DiagnosisSummary) -> Option<String> {
    let number = |p: f64| significant(p, 2);
    let LooksEntry { furthest, together, likeness } = summary.looks;
    (summary.verdict != "nothing_found").then(|| {
        format!(
            "Campaigns without any effect are as far off in a share of {} of cases (by the number that is furthest off alone {}, by all \
             numbers together {}, by how much they look like a cause or something else {}).",
            number(summary.p_value),
            number(furthest),
            number(together),
            number(likeness)
        )
    })
}

/// What is off enough for a line, the furthest first.
pub(super) fn worth_saying(summary: &DiagnosisSummary) -> Vec<&OffEntry> {
    summary.off.iter().filter(|off| off.in_sd.abs() >= WORTH_SAYING).collect()
}

/// The pair with most of the evidence, where pairs were looked at.
pub(super) fn pairs(summary: &DiagnosisSummary) -> Option<String> {
    let (pair, limits) = (summary.pairs.first()?, Limits::default());
    Some(format!(
        "Of {} pairs looked at closely {} and {} have most of the evidence: a share of {}, guard {}; a pair is named from {} \
         and {} on, where something else has {} or less and what is off is so by chance in less than {} of cases.",
        summary.pairs.len(),
        pair.ids[0],
        pair.ids[1],
        significant(pair.evidence, 2),
        or_dash(pair.guard_p_value),
        limits.pair.named,
        limits.pair.guard,
        limits.pair.nameless,
        limits.sure
    ))
}

/// Where no cause is named, though something is wrong: which causes are put aside and why, and which are not.
pub(super) fn excluded(summary: &DiagnosisSummary) -> Vec<String> {
    if !["ambiguous", "unexplained"].contains(&summary.verdict) {
        return Vec::new();
    }
    let by = |why: Option<&str>| -> Vec<&str> {
        summary.causes.iter().filter(|cause| cause.excluded_by == why).map(|cause| cause.id).collect()
    };
    [
        ("Excluded, as nearly all of their own campaigns fit single readings better", by(Some("readings"))),
        ("Excluded, as nine in ten of their own campaigns look more like them", by(Some("looks"))),
        (
            "Excluded, as the evidence over all readings leaves them less than one in a hundred",
            by(Some("evidence")),
        ),
        ("Not excluded", by(None)),
    ]
    .into_iter()
    .filter(|(_, causes)| !causes.is_empty())
    .map(|(why, causes)| format!("{why}: {}.", causes.join(", ")))
    .collect()
}

/// What was not used of the measurements.
pub(super) fn not_used(summary: &DiagnosisSummary) -> Option<String> {
    let reasons = summary.unused.iter().map(|own| format!("{} ({})", listed(&own.lines), own.why));
    let reasons: Vec<String> = reasons.collect();
    (!reasons.is_empty()).then(|| format!("Not used of the measurements: {}", reasons.join("; ")))
}

/// What the self-test says.
pub(super) fn reliability(summary: &DiagnosisSummary) -> String {
    let (nothing, hidden): (Vec<_>, Vec<_>) =
        summary.self_test.iter().partition(|row| row.hidden == "nothing");
    let sum = |rows: &[&SelfTestEntry], of: fn(&SelfTestEntry) -> Counted| {
        rows.iter().map(|row| of(row)).sum::<Counted>()
    };
    let (all, strong) = (sum(&hidden, |row| row.all), sum(&hidden, |row| row.strong));
    let (judged, closely) = (sum(&hidden, |row| row.judged), sum(&nothing, |row| row.judged));
    let (still, nameless) = (sum(&nothing, |row| row.all), summary.self_test_nameless.judged);
    let seeming = format!(
        "With data like these, by simulation from the bank (95 % intervals): an effect drawn from its prior is found in {} of campaigns, \
         one of the third that moves most of what is read in {}; where nothing is hidden, something is found in {}. By looks alone, \
         before evidence and guard, it is named in {}, one of that third in {}, a name is wrong in {} of cases, and where nothing is \
         hidden one is given in {}.",
        share(all.found, all.campaigns),
        share(strong.found, strong.campaigns),
        share(still.found, still.campaigns),
        share(all.named, all.campaigns),
        share(strong.named, strong.campaigns),
        share(all.misnamed, all.named + all.misnamed),
        share(still.misnamed, still.campaigns),
    );
    let counted = |part: u64, whole: u64| format!("{part} of {whole}, {}", share(part, whole));
    match judged.campaigns {
        0 => format!(
            "{seeming} How often by all that a diagnosis does, `pirca bank` finds out, with the same measurements (--measured) and the \
             bank's folder (--out), and keeps it beside the walls."
        ),
        _ => format!(
            "{seeming} By all that a diagnosis does such effects are named in {}, and given another name in {}; one is given in {} with \
             nothing hidden, and in {} with something in no catalogue.",
            counted(judged.named, judged.campaigns),
            counted(judged.misnamed, judged.campaigns),
            counted(closely.misnamed, closely.campaigns),
            counted(nameless.misnamed, nameless.campaigns)
        ),
    }
}

/// A share with its 95 % interval; a dash of nothing.
fn share(part: u64, whole: u64) -> String {
    if whole == 0 {
        return "-".to_owned();
    }
    let percent = |x: f64| format!("{:.0}", 100.0 * x);
    let [low, high] = stats::clopper_pearson(part as usize, whole as usize).map(percent);
    format!("{} % [{low}, {high}]", percent(part as f64 / whole as f64))
}
