//! What is printed: the interval, what did not fall, and a line per parameter.

use crate::render::number::{compact, ends, significant, within};
use crate::verb::analyse::uncertainty::UncertaintySummary;
use crate::verb::analyse::uncertainty::entry::InfluenceEntry;

/// The answer in at most five lines.
pub fn uncertainty_text(summary: &UncertaintySummary) -> String {
    let mut text = format!("  how sure: {}\n", interval(summary));
    let others = summary.answer.outcomes.iter().filter(|(outcome, _)| **outcome != "collapsed");
    let others: Vec<String> =
        others.map(|(outcome, count)| format!("{count} {}", outcome.replace('_', " "))).collect();
    if !others.is_empty() {
        text.push_str(&format!("  of these walls {} (counted, none left out)\n", others.join(", ")));
    }
    let alone = if summary.asked.len() > 1 { " (the others at their middle)" } else { "" };
    for entry in &summary.influence {
        text.push_str(&format!("  {}{alone}\n", influence(summary, entry)));
    }
    text
}

/// Over what, where the wall falls, and how many walls that rests on.
fn interval(summary: &UncertaintySummary) -> String {
    let answer = &summary.answer;
    let apart = answer.max.zip(answer.min).map_or(0.0, |(most, least)| most - least);
    // Of least and most as many digits as of the interval between them.
    let shown = |x: f64| if apart > 0.0 { within(x, apart) } else { load(x) };
    let most = answer.max.map(|most| format!(", most {}", shown(most))).unwrap_or_default();
    let ends = answer.min.filter(|_| !is_one_load(summary));
    let ends = ends.map(|least| format!("; least {}{most}", shown(least))).unwrap_or_default();
    format!("{} {} ({} walls solved{ends})", ranges(summary), falls(summary), answer.walls)
}

/// What the parameters were said to be.
pub(crate) fn ranges(summary: &UncertaintySummary) -> String {
    let over: Vec<String> = summary.asked.iter().map(|own| format!("{} {}", own.word, own.stated)).collect();
    format!("with {}", over.join(" and "))
}

/// Where the wall falls, and how likely.
pub(crate) fn falls(summary: &UncertaintySummary) -> String {
    let (answer, unit) = (&summary.answer, summary.answered.unit);
    let level = 100.0 * answer.level;
    match answer.interval {
        [Some(low), _] if is_one_load(summary) => format!("it falls at {} {unit} throughout", load(low)),
        [Some(low), Some(high)] => match ends([low, high]) {
            None => format!("it falls at {} {unit} in {level} % of cases", load(low)),
            Some([low, high]) => {
                format!("it falls between {low} and {high} {unit} in {level} % of cases, 5 to 95 % point")
            }
        },
        [Some(low), None] => {
            format!("it bears {} {unit} in 95 % of cases; how much more is not known", load(low))
        }
        [None, _] => "it stands, or where it falls is not known".to_owned(),
    }
}

/// Whether all walls fall at a load that is the same to the solver.
fn is_one_load(summary: &UncertaintySummary) -> bool {
    let ends = summary.answer.min.zip(summary.answer.max);
    summary.answer.failed.is_empty()
        && ends.is_some_and(|(least, most)| most - least < summary.answered.resolution)
}

/// What a parameter does.
fn influence(summary: &UncertaintySummary, entry: &InfluenceEntry) -> String {
    let (unit, resolution) = (summary.answered.unit, summary.answered.resolution);
    let own = summary.asked.iter().find(|own| own.unsure.name == entry.parameter);
    let (word, own_unit) = own.map_or((entry.parameter, ""), |own| (own.word, own.unit));
    let [low, middle, high] = entry.at.map(parameter);
    if !entry.matters {
        let told = format!("the answer changes by less than {resolution} {unit}");
        let why = entry.why.as_deref().unwrap_or(&told);
        return format!("{word} does not matter from {low} to {high} {own_unit}: {why}");
    }
    let said = |k: usize| entry.answers[k].map_or_else(|| entry.outcomes[k].replace('_', " "), load);
    format!(
        "{word} at {low}, {middle} and {high} {own_unit}: {}, {} and {} {unit}",
        said(0),
        said(1),
        said(2)
    )
}

/// A load with the digits that solvers tell apart.
fn load(value: f64) -> String {
    format!("{value:.3}")
}

/// A value of a parameter.
fn parameter(value: f64) -> String {
    let rounded = significant(value, 4).parse().unwrap_or(value);
    if (0.01..1e5).contains(&rounded) { rounded.to_string() } else { compact(value) }
}
