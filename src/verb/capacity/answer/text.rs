//! The words of a capacity.

use crate::render::number::{bracketed, compact, or_dash, significant, with_interval};
use crate::stats::{Scatter, Shape};
use crate::verb::capacity::answer::group::{CapacityGroup, Repeats, Screen};
use crate::verb::capacity::answer::{CapacitySummary, Question, SupportedValue};
use crate::verb::run::answer::stated_cov::StatedCov;

/// Fewer walls than this support no design value that anybody should use.
const FEW: u64 = 10;

/// What the table of values is.
pub(crate) const SUPPORTED: &str = "Values that these walls support";
/// What the values of it mean.
pub(crate) const VALUES: &str = "characteristic: the next wall lies below it with a probability of 5 % (EN 1990 D7.2); 95/95: no more than \
     5 % of all walls lie below it, with a confidence of 95 %; design: the next wall lies below it with a probability of 0.1 % (D7.3).";

/// What each group answers; behind them a sentence for each arm whose walls cannot.
pub(crate) fn conclusions(summary: &CapacitySummary) -> Vec<String> {
    let of = |group: &CapacityGroup| {
        let stated = group.stated_cov.as_ref().map(|own| format!(" {}", of_stated(own, group)));
        conclusion(summary, group) + &left_open(summary, group) + &stated.unwrap_or_default()
    };
    let others: Vec<&CapacityGroup> = summary.groups.iter().filter(|group| !group.is_spread()).collect();
    let alike = others.chunk_by(|a, b| a.name == b.name).map(|groups| without_scatter(summary, groups));
    summary.spread().map(of).chain(alike).collect()
}

/// What is known of an arm whose walls are all alike, or of which there is one: at each stiffness its value, or on which side it lies.
fn without_scatter(summary: &CapacitySummary, groups: &[&CapacityGroup]) -> String {
    let [first, ..] = groups else { return String::new() };
    let name = &first.name;
    if first.random {
        return format!("{name}: one wall alone shows no scatter; ask for more with --members.");
    }
    let at = |group: &CapacityGroup| match group.kn_pa_per_m {
        Some(kn) if groups.len() > 1 => format!(" at kn {}", compact(kn)),
        _ => String::new(),
    };
    let said = |group: &&CapacityGroup| match summary.question {
        Question::Quantile(_) => {
            // One wall shows no quantile, and has a value.
            let value = summary.shown.shown(group.rungs.first()?.level);
            Some(format!("{} {}{}", significant(value, 3), summary.shown.shown_unit(), at(group)))
        }
        // A share of walls that are all alike is 0 or 1.
        _ => Some(format!("{}{}", if group.answer.value()? > 0.5 { "yes" } else { "no" }, at(group))),
    };
    let said: Vec<String> = groups.iter().filter_map(said).collect();
    let said = if said.is_empty() { String::new() } else { format!(": {}", said.join(", ")) };
    let open: String = groups.iter().map(|group| left_open(summary, group)).collect();
    match summary.question {
        Question::Quantile(_) => format!("{name}: nothing is drawn, so its walls are all alike{said}.{open}"),
        Question::Below(level) | Question::Above(level) => {
            let side = if matches!(summary.question, Question::Below(_)) { "below" } else { "above" };
            let (level, unit) = (significant(summary.shown.shown(level), 3), summary.shown.shown_unit());
            format!(
                "{name}: nothing is drawn, so its walls are all alike; {side} {level} {unit}{said}.{open}"
            )
        }
    }
}

/// The answer with what stiff joints bear, where rigid blocks leave values open.
fn left_open(summary: &CapacitySummary, group: &CapacityGroup) -> String {
    let Some(open) = &group.left_open else { return String::new() };
    let shown = |x: f64| match summary.question {
        Question::Quantile(_) => summary.shown.shown(x),
        Question::Below(_) | Question::Above(_) => x,
    };
    format!(
        " Rigid blocks leave {} of these walls open, which need thrust that their weight does not bring about: with what stiff joints bear it is {}.",
        open.walls,
        with_interval(open.answer.value().map(shown), open.interval.map(|ends| ends.map(shown)), 3)
    )
}

fn name(group: &CapacityGroup) -> String {
    match group.kn_pa_per_m {
        Some(kn) => format!("{} at kn {}", group.name, compact(kn)),
        None => group.name.clone(),
    }
}

fn conclusion(summary: &CapacitySummary, group: &CapacityGroup) -> String {
    let unit = summary.shown.shown_unit();
    let shown = |x: f64| summary.shown.shown(x);
    let name = name(group);
    if let Some(repeats) = &group.repeats {
        return by_repeats(summary, group, repeats);
    }
    let lost = group.failed.walls;
    let counted = if lost > 0 {
        format!("{} walls, {lost} without a value", group.walls)
    } else {
        format!("{} walls", group.walls)
    };
    let mut text = match summary.question {
        Question::Below(level) | Question::Above(level) => {
            let side = if matches!(summary.question, Question::Below(_)) { "below" } else { "above" };
            format!(
                "{name}: {side} {} {unit} with a probability of {} ({counted}).",
                significant(shown(level), 3),
                probability(group)
            )
        }
        Question::Quantile(share) if group.answer.value().is_none() => {
            format!(
                "{name}: {counted} are too few to show a {} % quantile by themselves.",
                significant(100.0 * share, 2)
            )
        }
        Question::Quantile(share) => format!(
            "{name}: {} % of walls lie below {} {unit} ({counted}).",
            significant(100.0 * share, 2),
            with_interval(group.answer.value().map(shown), group.interval.map(|ends| ends.map(shown)), 3)
        ),
    };
    if let Some(enough) = &group.enough {
        let half = or_dash(enough.half_width.map(|half| 100.0 * half), 2);
        let below = significant(100.0 * enough.below, 2);
        let more = if enough.reached { "" } else { ", not reached: give --walls more" };
        text.push_str(&format!(" Half width {half} % (asked: below {below} %{more})."));
    }
    if let Some(ends) = group.failed.whatever() {
        let ends = match summary.question {
            Question::Quantile(_) => ends.map(shown),
            _ => ends,
        };
        let ends = bracketed(ends, 2);
        text.push_str(&format!(" Whatever those without a value would have borne: {ends}."));
    }
    if group.method == "measured" && group.walls < FEW {
        text.push_str(&few(summary, group));
    }
    text
}

/// A probability with its interval. Where none was found it is what it lies below: 0 is no answer.
pub(crate) fn probability(group: &CapacityGroup) -> String {
    match (group.answer.value(), group.interval) {
        (Some(0.0), Some([_, high])) => format!("at most {} (none found)", significant(high, 2)),
        (Some(0.0), None) => "- (none found, and nothing bounds it)".to_owned(),
        (value, interval) => with_interval(value, interval, 2),
    }
}

/// How a stated coefficient of variation agrees with the walls, and what is given where it does not.
fn of_stated(stated: &StatedCov, group: &CapacityGroup) -> String {
    let sentence = stated.sentence(if group.method == "measured" { "specimens" } else { "walls" });
    match stated.doubted {
        None => sentence,
        Some(Scatter::Larger) => format!(
            "{sentence} The values below are given with the stated COV and with their own; rely on those with their own."
        ),
        Some(Scatter::Smaller) => {
            format!("{sentence} The values below are given with the stated COV and with their own.")
        }
    }
}

/// What looks wrong: a stated coefficient of variation that the values contradict.
pub fn capacity_warnings(summary: &CapacitySummary) -> Vec<String> {
    let doubted = |group: &CapacityGroup| {
        let stated = group.stated_cov.as_ref().filter(|own| own.doubted.is_some())?;
        Some(format!("--known-cov: {}: {}", name(group), of_stated(stated, group)))
    };
    summary.groups.iter().filter_map(doubted).collect()
}

/// How an answer was found, in words.
pub(crate) fn method(group: &CapacityGroup) -> &'static str {
    match group.method {
        "stratified" => "walls stratified by limit analysis",
        "importance" => "importance sampling of parameters",
        "subset" => "subset simulation",
        "measured" => "specimens alone",
        _ => "plain sampling",
    }
}

/// What independent runs found.
fn by_repeats(summary: &CapacitySummary, group: &CapacityGroup, repeats: &Repeats) -> String {
    let (side, level) = match summary.question {
        Question::Above(level) => ("above", level),
        Question::Below(level) | Question::Quantile(level) => ("below", level),
    };
    let unit = summary.shown.shown_unit();
    let method = method(group);
    let limits = match repeats.screen {
        Some(_) => format!(" after {} limit analyses", repeats.limit_evaluations),
        None => String::new(),
    };
    let mut text = format!(
        "{}: {side} {} {unit} with a probability of {} ({method}, {} independent runs, {} walls{limits}).",
        name(group),
        significant(summary.shown.shown(level), 3),
        probability(group),
        repeats.probabilities.len(),
        repeats.evaluations
    );
    if let Some(screen) = &repeats.screen {
        text.push_str(&sorted_by(summary, screen));
    }
    if let Some(stuck) = repeats.stuck.filter(|stuck| *stuck > 0) {
        text.push_str(&format!(
            " The moves of {stuck} runs hardly changed a wall's numbers, so that they may all miss the same walls: the interval is that of the \
             walls drawn first, which count alike.",
        ));
    }
    if let Some(explained) = repeats.explained {
        let share = significant(100.0 * explained, 2);
        text.push_str(&format!(
            " Parameters drawn once per wall explain {share} % of the variance of values."
        ));
    }
    if let Some(at_most) = repeats.at_most {
        text.push_str(&format!(" {} it is {} at most.", unless(group), significant(at_most, 2)));
    }
    if let (Some((_, value)), Some(number)) = (&repeats.weakest, repeats.weakest_draw) {
        let value = significant(summary.shown.shown(*value), 3);
        text.push_str(&format!(" The weakest wall found has {value} {unit}: draw {number}"));
        let first =
            repeats.first_failed_draw.map(|first| format!("; the first {side} the level: draw {first}"));
        text.push_str(&format!("{}.", first.unwrap_or_default()));
    }
    if let Some(target) = group.target {
        let cov = or_dash(group.cov.map(|cov| 100.0 * cov), 2);
        let asked = significant(100.0 * target.cov, 2);
        let more = if target.reached { "" } else { ", not reached: give --walls more" };
        text.push_str(&format!(" COV {cov} % (asked: {asked} %{more})."));
    }
    if let Some([_, high]) = group.failed.interval_if_failed {
        text.push_str(&format!(
            " {} walls brought no value and count as on the better side; had they failed, it is {} at most.",
            group.failed.walls,
            significant(high, 2)
        ));
    }
    text
}

/// What an interval rests on besides how walls were drawn.
fn unless(group: &CapacityGroup) -> &'static str {
    match group.method {
        "stratified" => "Whatever limit analysis expects of walls beyond its bound,",
        "importance" => "Wherever else than the shift leads walls may be weak,",
        _ => "By the walls alone that were drawn first and not moved,",
    }
}

/// How limit analysis sorted the walls, and what is known of those beyond its bound.
fn sorted_by(summary: &CapacitySummary, screen: &Screen) -> String {
    let shown = |x: f64| format!("{} {}", significant(summary.shown.shown(x), 3), summary.shown.shown_unit());
    let beyond = match (screen.goes_down, screen.beyond) {
        (true, _) => "were taken to be on the better side".to_owned(),
        (false, [solved, worse]) => {
            format!("are expected on the better side: {worse} of {solved} solved were not")
        }
    };
    format!(
        " Limit and value of {} other walls have a correlation of {}. Walls with a limit above {} {beyond}; those found on the worse \
         side have {} at most.",
        screen.pilot_walls,
        significant(screen.rho, 2),
        shown(screen.bound),
        screen.largest_on_worse_side.map_or_else(|| "-".to_owned(), shown)
    )
}

/// What few tests can and cannot carry.
fn few(summary: &CapacitySummary, group: &CapacityGroup) -> String {
    let normal = group.supported.iter().find(|own| own.shape == Shape::Normal);
    match normal.and_then(|own| own.design) {
        Some(design) if design.value <= 0.0 => format!(
            " {} specimens carry no design value: a normal one is {} {}, which says nothing. State a known coefficient of variation.",
            group.walls,
            significant(summary.shown.shown(design.value), 3),
            summary.shown.shown_unit()
        ),
        Some(_) => " So few specimens carry a characteristic value at best.".to_owned(),
        None => " So few specimens carry no value unless the coefficient of variation is known.".to_owned(),
    }
}

/// The values that walls support, with their heads in the first row.
pub(crate) fn supported(summary: &CapacitySummary) -> Vec<Vec<String>> {
    let unit = summary.shown.shown_unit();
    let header =
        ["walls of", "kn Pa/m", "n", "COV %", "shape", "characteristic", "95/95", "design"].map(|head| {
            match head {
                "characteristic" | "95/95" | "design" => format!("{head} {unit}"),
                head => head.to_owned(),
            }
        });
    let mut rows = vec![header.to_vec()];
    // With a stated variation a column says by which one a row is.
    let stated = |cells: &mut Vec<String>, cell: &str| {
        if summary.known_cov.is_some() {
            cells.insert(4, cell.to_owned());
        }
    };
    stated(&mut rows[0], "taken %");
    for group in summary.spread() {
        for own in &group.supported {
            let value = |of: Option<SupportedValue>| or_dash(of.map(|of| summary.shown.shown(of.value)), 3);
            let mut row = vec![
                group.name.clone(),
                group.kn_pa_per_m.map_or_else(|| "-".to_owned(), compact),
                group.walls.to_string(),
                or_dash(group.walls_cov.map(|cov| 100.0 * cov), 2),
                match own.shape {
                    Shape::Normal => "normal".to_owned(),
                    Shape::Lognormal => "lognormal".to_owned(),
                },
                value(own.characteristic),
                value(own.tolerance_95_95),
                value(own.design),
            ];
            stated(&mut row, &or_dash(own.known_cov.or(group.walls_cov).map(|cov| 100.0 * cov), 2));
            rows.push(row);
        }
    }
    rows
}
