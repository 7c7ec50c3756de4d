//! What a diagnosis comes to, in at most five sentences.

use crate::critic::MOST_AMBIGUOUS;
use crate::render::number::{capital, how_often, significant};
use crate::verb::diagnose::answer::parameter::ParameterEntry;
use crate::verb::diagnose::answer::summary::{CauseEntry, DiagnosisSummary};
use crate::verb::diagnose::answer::text::worth_saying;

/// The verdict, how surely something is wrong, what the causes would mean and their parameters, the gain, and what to measure next.
pub(crate) fn conclusion(summary: &DiagnosisSummary) -> Vec<String> {
    let sentences = [Some(verdict(summary)), wrong(summary), meaning(summary), gain(summary), next(summary)];
    sentences.into_iter().flatten().collect()
}

/// What a page says below its headline: how surely something is wrong, the gain, and what to measure next.
pub(crate) fn below_headline(summary: &DiagnosisSummary) -> Vec<String> {
    let is_off = summary.verdict != "nothing_found";
    let wrong = Some(chance(summary)).into_iter().chain(is_off.then(|| furthest(summary)));
    wrong.chain(gain(summary)).chain(next(summary)).collect()
}

/// The verdict in a sentence, with the causes that it speaks of.
pub(crate) fn verdict(summary: &DiagnosisSummary) -> String {
    let spoken: Vec<String> = summary
        .causes
        .iter()
        .filter(|cause| cause.in_verdict)
        .map(|cause| format!("{} ({:.3})", cause.id, cause.probability))
        .collect();
    let spoken = spoken.join(", ");
    match summary.verdict {
        "nothing_found" => "NOTHING FOUND: errors, scatter and joints within their priors account for the readings.".to_string(),
        "named" if summary.pairs.iter().any(|pair| pair.in_verdict) => {
            format!("NAMED: two causes together explain the readings: {spoken}.")
        }
        "named" => format!("NAMED: one cause explains the readings, with this probability: {spoken}."),
        "named_outside_prior" => format!(
            "NAMED, OUTSIDE ITS PRIOR: one cause explains the readings, at a strength that its prior does not expect: {spoken}."
        ),
        "ambiguous" if summary.causes.iter().filter(|cause| cause.in_verdict).count() == 1 => {
            format!("AMBIGUOUS: this cause explains the readings, but not surely enough to be named: {spoken}.")
        }
        "ambiguous" => format!("AMBIGUOUS: the readings cannot tell between these causes: {spoken}."),
        _ => match summary.causes.iter().filter(|cause| cause.excluded_by.is_none()).count() {
            0 => "UNEXPLAINED: something is wrong, and no cause of the catalogue explains it, even at four times \
                  the spread of its prior; no pair is named."
                .to_string(),
            open => {
                let many = if open > MOST_AMBIGUOUS { ": more than these data can tell apart" } else { "" };
                format!(
                    "UNEXPLAINED: something is wrong, and no cause explains it surely; {open} of the catalogue cannot be excluded{many}."
                )
            }
        },
    }
}

/// That the base model is off, and where most; or how likely what is seen is by chance. In a line of a terminal.
fn wrong(summary: &DiagnosisSummary) -> Option<String> {
    if summary.verdict == "nothing_found" {
        return Some(chance(summary));
    }
    let often = how_often(summary.p_value, summary.p_value_campaigns);
    Some(format!("Off beyond chance ({often}). {}", furthest(summary)))
}

/// Where it is off most.
fn furthest(summary: &DiagnosisSummary) -> String {
    worth_saying(summary).first().map_or_else(
        || "No single number is off by two standard deviations; the readings together are.".to_string(),
        |off| format!("Furthest off: {} ({:+.1} sd).", off.what, off.in_sd),
    )
}

/// How many campaigns without any effect are as far off.
fn chance(summary: &DiagnosisSummary) -> String {
    let often = capital(&how_often(summary.p_value, summary.p_value_campaigns));
    format!("{often} simulated campaigns without any effect are as far off.")
}

/// The verdict in plain words, as a page begins with it; it is not said without what its own tables hold against it.
pub fn headline(summary: &DiagnosisSummary) -> String {
    let spoken: Vec<&CauseEntry> = summary.causes.iter().filter(|cause| cause.in_verdict).collect();
    let titles: Vec<String> = spoken.iter().map(|cause| sized(cause)).collect();
    let (one, all) = (titles.first().cloned().unwrap_or_default(), titles.join("; "));
    let verdict = match (summary.verdict, titles.len()) {
        ("nothing_found", _) => {
            "Nothing is wrong that these readings could show: errors, scatter and joints within their priors account for them."
                .to_owned()
        }
        ("named", 1) => format!("Something is wrong with the base model, and one cause explains the readings: {one}."),
        ("named", _) => format!("Something is wrong with the base model, and two causes together explain the readings: {all}."),
        ("named_outside_prior", _) => format!(
            "Something is wrong with the base model. One cause explains the readings, but at a strength that its prior does not \
             expect: {one}."
        ),
        ("ambiguous", 1) => format!(
            "Something is wrong with the base model. One cause explains the readings, but not surely enough to be named: {one}."
        ),
        ("ambiguous", _) => {
            format!("Something is wrong with the base model, and these readings cannot tell which of these it is: {all}.")
        }
        _ => "Something is wrong with the base model, and no cause of the catalogue explains it surely.".to_owned(),
    };
    match predicted(summary) {
        Some(but) if !spoken.is_empty() => format!("{verdict} {but}"),
        _ => verdict,
    }
}

/// A cause in plain words, with the joints that it acts on, its probability and its size.
fn sized(cause: &CauseEntry) -> String {
    // What nothing is known to differ in has no size.
    let sizes = cause.parameters.iter().filter(|own| own.prior_sd.is_some());
    let sizes: Vec<String> = sizes.map(ParameterEntry::words).collect();
    let sizes = if sizes.is_empty() { String::new() } else { format!("; {}", sizes.join(", ")) };
    let joints = cause.scope.as_ref().map_or_else(String::new, |scope| format!(", in {}", scope.words));
    format!("{}{joints} (probability {}{sizes})", cause.title, significant(cause.probability, 2))
}

/// Where the extended model does not predict better than the base model, though the verdict speaks of a cause.
fn predicted(summary: &DiagnosisSummary) -> Option<&'static str> {
    match summary.gain.as_ref()?.specimens_left_out.as_ref()?.log_score.claim() {
        "better" => None,
        "worse" => Some("Yet with it specimens that were left out are predicted worse."),
        _ => Some("Yet it is not shown to predict specimens that were left out any better."),
    }
}

/// What the causes in the verdict would mean, with their parameters.
fn meaning(summary: &DiagnosisSummary) -> Option<String> {
    let spoken: Vec<&CauseEntry> = summary.causes.iter().filter(|cause| cause.in_verdict).collect();
    let by_name = |cause: &&CauseEntry| match spoken.len() {
        1 => cause.meaning(),
        _ => format!("{}: {}", cause.id, cause.meaning()),
    };
    let means: Vec<String> = spoken.iter().map(by_name).collect();
    let means = (!means.is_empty()).then(|| format!("It would mean: {}.", means.join("; ")))?;
    Some(parameters(&spoken).map_or(means.clone(), |found| format!("{means} {found}")))
}

/// The parameters of causes.
fn parameters(spoken: &[&CauseEntry]) -> Option<String> {
    // Of one cause the verdict has just told the name.
    let named = |cause: &CauseEntry, words: String| match spoken.len() {
        1 => words,
        _ => format!("{}.{words}", cause.id),
    };
    let all: Vec<String> = spoken
        .iter()
        .flat_map(|cause| cause.parameters.iter().map(|own| named(cause, own.words())))
        .collect();
    (!all.is_empty()).then(|| format!("Found (median, 90 % interval): {}.", all.join("; ")))
}

/// Whether the extended model predicts specimens better that it has not seen.
fn gain(summary: &DiagnosisSummary) -> Option<String> {
    let entry = summary.gain.as_ref()?.specimens_left_out.as_ref()?;
    let errors = entry.base.rmse.zip(entry.extended.rmse).map_or_else(String::new, |(base, extended)| {
        format!("; errors {} to {} sd", significant(base, 2), significant(extended, 2))
    });
    Some(format!("Held-out specimens: gain in log score {}{errors}.", entry.log_score.text()))
}

/// The measurement that would tell most per hour.
fn next(summary: &DiagnosisSummary) -> Option<String> {
    let rate = |bits: f64, hours: f64| bits / hours.max(1e-3);
    let best =
        summary.advice.next.iter().max_by(|a, b| rate(a.bits, a.hours).total_cmp(&rate(b.bits, b.hours)))?;
    Some(format!(
        "Next, what would tell most per hour: {} ({} h; it would settle the cause in {}).",
        best.what,
        significant(best.hours, 2),
        best.cases()
    ))
}
