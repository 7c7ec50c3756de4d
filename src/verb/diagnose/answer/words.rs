//! Groups in words: what was measured, what was simulated, and how the two stand to each other.

use crate::render::number::{significant, with_interval};
use crate::study::MeasuredQuantity;
use crate::verb::diagnose::answer::residual::{ExpectedEntry, GroupEntry};

/// Ratios nearer to one than this are said as differences.
const LEAST_RATIO: f64 = 1.1;
/// A share of fallen walls that is worth saying.
const FALLEN: f64 = 0.05;

/// A line of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Family, quantity and tilt.
    pub what: String,
    /// What was measured; at the first and the last of the tilts that share the line.
    pub measured: String,
    /// What was simulated; the same.
    pub simulated: String,
    /// How they stand.
    pub finding: String,
}

impl Line {
    /// In one sentence.
    pub fn sentence(&self) -> String {
        let Line { what, measured, simulated, finding } = self;
        format!("{what}: {measured} measured, {simulated} simulated: {finding}")
    }
}

/// What is to be known before single lines are read.
pub fn reading(groups: &[GroupEntry]) -> String {
    format!(
        "The mean over the specimens; in brackets what nine in ten simulated campaigns show, with joints anywhere in their priors, \
         not fitted as they are for what is off; sd: standard deviations of errors, scatter and joints together; p: share of \
         simulated campaigns that are as far off. Single lines are not corrected for their number (of {}, one in ten disagrees \
         by chance); the p-value of the verdict is.",
        groups.len()
    )
}

/// A line per group, or per family and quantity where all tilts agree.
pub fn lines(groups: &[GroupEntry]) -> Vec<Line> {
    let same = |a: &GroupEntry, b: &GroupEntry| a.family == b.family && a.quantity == b.quantity;
    groups
        .chunk_by(same)
        .flat_map(|tilts| match tilts.len() > 1 && tilts.iter().all(agrees) {
            true => vec![together(tilts)],
            false => tilts.iter().map(line).collect(),
        })
        .collect()
}

fn agrees(group: &GroupEntry) -> bool {
    group.p_value.is_some() && group.stands == "within"
}

/// Tilts that all agree.
fn together(groups: &[GroupEntry]) -> Line {
    let places = groups.iter().filter_map(|g| g.tilt_deg.or(g.drift_percent));
    let tilts: Vec<String> = places.map(|place| place.to_string()).collect();
    let unit = if groups[0].drift_percent.is_some() { "% of drift" } else { "deg" };
    let (last, others) = tilts.split_last().map_or(("", &[][..]), |(last, others)| (last.as_str(), others));
    let least = groups.iter().filter_map(|group| group.p_value).fold(1.0, f64::min);
    let agreeing = groups.iter().filter_map(|group| group.agreeing_share).reduce(f64::min);
    let fallen = groups.iter().map(|group| group.fallen_share).fold(0.0, f64::max);
    Line {
        what: format!(
            "{} {} {} and {last} {unit}",
            name(&groups[0]),
            at(groups[0].quantity),
            others.join(", ")
        ),
        measured: from_to(groups, measured),
        simulated: from_to(groups, simulated),
        finding: match least < 1.0 {
            true => format!("agrees (p {} or more)", significant(least, 2)),
            false => "agrees".to_string(),
        } + &agreeing.map_or_else(String::new, |share| kept(share, " or more"))
            + &gone(fallen, "up to "),
    }
}

/// What is said of the first tilt and of the last, once if it is the same.
fn from_to(groups: &[GroupEntry], said: fn(&GroupEntry) -> String) -> String {
    let mut ends: Vec<String> = groups.first().into_iter().chain(groups.last()).map(said).collect();
    ends.dedup();
    ends.join(" to ")
}

fn line(group: &GroupEntry) -> Line {
    Line {
        what: format!("{}{}", name(group), place(group.quantity, group.tilt_deg, group.drift_percent)),
        measured: measured(group),
        simulated: simulated(group),
        finding: finding(group),
    }
}

/// Where a quantity of that name was read, with a space before it; nothing where it has no such place.
pub(crate) fn place(quantity: &str, tilt_deg: Option<f64>, drift_percent: Option<f64>) -> String {
    match (tilt_deg, drift_percent) {
        (Some(tilt), _) => format!(" {} {tilt} deg", at(quantity)),
        (None, Some(drift)) => format!(" of {drift} %"),
        (None, None) => String::new(),
    }
}

/// How the quantity of that name stands to its tilt.
fn at(quantity: &str) -> &'static str {
    MeasuredQuantity::named(quantity).map_or("at", MeasuredQuantity::at_or_after)
}

fn name(group: &GroupEntry) -> String {
    format!("{}: {}", group.family, group.quantity.replace('_', " "))
}

fn measured(group: &GroupEntry) -> String {
    let Some(mean) = group.measured else { return "nothing".to_string() };
    if is_outcome(group) {
        return format!("{:.0} of {} stood", scale(group) * mean, group.readings);
    }
    let mean = format!("{} {}", shown(group, mean), shown_unit(group));
    let all = |bounds: usize| bounds == group.readings;
    let number = match group.readings {
        1 => String::new(),
        n => format!(" in all {n}"),
    };
    match group.below + group.above {
        0 => mean,
        _ if all(group.below) => format!("below {mean}{number}"),
        _ if all(group.above) => format!("above {mean}{number}"),
        bounds => format!("{mean} ({bounds} of {} only bounds)", group.readings),
    }
}

fn simulated(group: &GroupEntry) -> String {
    let Some(expected) = &group.simulated else { return "nothing".to_string() };
    let scale = scale(group);
    with_interval(Some(scale * expected.median), Some(expected.band_90.map(|x| scale * x)), 3)
}

fn finding(group: &GroupEntry) -> String {
    let Some((p, simulated)) = group.p_value.zip(group.simulated.as_ref()) else {
        return format!(
            "nothing can be said: {:.0} % of the simulated walls had fallen",
            100.0 * group.fallen_share
        );
    };
    let sd = group.in_sd.map_or_else(String::new, |sd| format!("{:.1} sd, ", sd.abs()));
    let p = format!("p {}", significant(p, 2));
    let mut finding = match group.stands {
        "within" => format!("agrees ({p})"),
        side => format!("{} ({sd}{p})", amount(group, simulated, side == "above")),
    };
    let bounds = group.agreeing_share.filter(|_| !is_outcome(group));
    finding.push_str(&bounds.map_or_else(String::new, |share| kept(share, "")));
    finding.push_str(&gone(group.fallen_share, ""));
    finding
}

/// How many simulated readings lie on the bound's side.
fn kept(share: f64, or_more: &str) -> String {
    format!("; {:.0} %{or_more} of simulated readings keep the bound", 100.0 * share)
}

/// How many simulated walls show nothing, where that is worth saying.
fn gone(share: f64, up_to: &str) -> String {
    match share > FALLEN {
        true => format!("; {up_to}{:.0} % of the simulated walls had fallen", 100.0 * share),
        false => String::new(),
    }
}

/// By how much a mean is off: as a ratio where both are surely positive, else as a difference; of bounds neither.
fn amount(group: &GroupEntry, simulated: &ExpectedEntry, above: bool) -> String {
    let words = match (group.unit, above) {
        ("m", true) => "too far",
        ("m", false) => "too little",
        _ if is_outcome(group) && above => "too many stood",
        _ if is_outcome(group) => "too few stood",
        (_, true) => "too high",
        (_, false) => "too low",
    };
    let Some(measured) = group.measured.filter(|_| group.below + group.above == 0) else {
        return words.to_string();
    };
    let ratio = if above { measured / simulated.median } else { simulated.median / measured };
    if group.unit != "deg" && measured > 0.0 && simulated.band_90[0] > 0.0 && ratio >= LEAST_RATIO {
        return format!("{} times {words}", significant(ratio, 2));
    }
    let off = (measured - simulated.median).abs();
    format!("{} {} {words}", shown(group, off), shown_unit(group))
}

/// Whether the group is of walls that fell or stood under a motion of their base.
fn is_outcome(group: &GroupEntry) -> bool {
    group.quantity == MeasuredQuantity::Outcome.name()
}

/// A number in the unit of text and figures.
fn shown(group: &GroupEntry, x: f64) -> String {
    significant(scale(group) * x, 3)
}

/// How many of the unit of text and figures one of the group's unit is.
fn scale(group: &GroupEntry) -> f64 {
    match (group.unit, group.drift_percent) {
        // Of outcomes the share that stood, told as their number.
        _ if is_outcome(group) => group.readings as f64,
        ("m", _) => 1e3,
        ("N", Some(_)) => 1e-3,
        _ => 1.0,
    }
}

fn shown_unit(group: &GroupEntry) -> &'static str {
    match (group.unit, group.drift_percent) {
        ("m", _) => "mm",
        ("N", Some(_)) => "kN",
        (unit, _) => unit,
    }
}

#[cfg(test)]
mod tests {
    use super::at;

    #[test]
    fn what_remains_is_read_after_its_tilt() {
        assert_eq!(["displacement_mean", "remainder_mean"].map(at), ["at", "after"]);
    }
}
