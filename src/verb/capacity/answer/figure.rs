//! How probable a failure is, over the level: the figure of a capacity and the table behind it.

use crate::render::axes::{Axes, Axis};
use crate::render::chart::{Chart, Mark, Series};
use crate::render::csv::Csv;
use crate::render::number::{compact, range, shortened};
use crate::verb::capacity::answer::text::method;
use crate::verb::capacity::answer::{CapacityGroup, CapacitySummary};
use crate::verb::question::{Answer, Question};

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 24;
/// The axis of probabilities reaches so much further down than what is drawn.
const BELOW: f64 = 0.5;

/// The probability that a wall's value lies on the worse side of a level, that level included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rung {
    /// The independent run that found it; `None` where all walls count alike.
    pub run: Option<usize>,
    /// The level, in the unit of the quantity.
    pub level: f64,
    /// The probability.
    pub probability: f64,
    /// Its 95 % interval at this level alone; a run has none.
    pub interval: Option<[f64; 2]>,
}

/// The rungs of all groups, and their answers in the last lines of each.
pub(crate) fn capacity_csv(summary: &CapacitySummary) -> Vec<u8> {
    let mut csv = Csv::new(format!("name,kn_pa_per_m,of,run,level_{},probability,low,high", summary.unit));
    for group in &summary.groups {
        let mut line =
            |of: &str, run: Option<usize>, level: f64, probability: f64, ends: Option<[f64; 2]>| {
                csv.line(&[&group.name, &group.kn_pa_per_m, &of, &run, &level, &probability, &ends]);
            };
        for rung in &group.rungs {
            let of = if rung.run.is_some() { "run" } else { "walls" };
            line(of, rung.run, rung.level, rung.probability, rung.interval);
        }
        match (summary.question, group.answer) {
            (Question::Below(level) | Question::Above(level), Answer::Probability(Some(probability))) => {
                line("answer", None, level, probability, group.interval);
            }
            // The interval of a quantile is one of levels: its ends are two lines.
            (Question::Quantile(share), Answer::Quantile(Some(value))) => {
                line("answer", None, value, share, None);
                for end in group.interval.into_iter().flatten() {
                    line("end of its interval", None, end, share, None);
                }
            }
            _ => {}
        }
    }
    csv.bytes()
}

/// The walls that are drawn: those of each arm that differ, at the middle of its stiffnesses (the lower of two), so that an arm is one line in its
/// own colour.
pub(crate) fn drawn(summary: &CapacitySummary) -> Vec<&CapacityGroup> {
    let groups: Vec<&CapacityGroup> = summary.spread().collect();
    groups.chunk_by(|a, b| a.name == b.name).map(|own| own[(own.len() - 1) / 2]).collect()
}

/// The chart of the walls that differ; `None` where there is nothing to draw.
pub(crate) fn capacity_chart(summary: &CapacitySummary) -> Option<Chart> {
    let groups = drawn(summary);
    let rungs = || groups.iter().flat_map(|group| &group.rungs);
    let shown = |level: f64| summary.shown.shown(level);
    let [first, last] = range(rungs().map(|rung| shown(rung.level)))?;
    let asked = match summary.question {
        Question::Below(level) | Question::Above(level) => Some(shown(level)),
        Question::Quantile(_) => None,
    };
    let [low, high] = range([first, last].into_iter().chain(asked))?;
    let room = if high > low { 0.05 * (high - low) } else { 0.1 * high.abs().max(1.0) };
    let answers = groups.iter().filter(|_| asked.is_some());
    let answers =
        answers.flat_map(|group| group.answer.value().into_iter().chain(group.interval.map(|[low, _]| low)));
    let seen = rungs().map(|rung| rung.probability).chain(answers).filter(|p| *p > 0.0);
    let bottom = BELOW * range(seen).map_or(0.1, |[low, _]| low);
    let series = groups.iter().map(|group| {
        let line = |run: Option<usize>| {
            let own = group.rungs.iter().filter(move |rung| rung.run == run && rung.probability > 0.0);
            own.map(|rung| (shown(rung.level), rung.probability)).collect::<Vec<_>>()
        };
        let runs = group.rungs.iter().filter_map(|rung| rung.run).max().map_or(0, |last| last + 1);
        let mut marks: Vec<Mark> = (0..runs).map(|run| Mark::Faint(line(Some(run)))).collect();
        marks.push(Mark::Line(line(None)));
        // The interval of a quantile is one of levels.
        let bar = match (summary.question, group.interval) {
            (Question::Quantile(share), Some(ends)) => {
                Some(Mark::Line(ends.map(|end| (shown(end), share)).to_vec()))
            }
            (_, Some([low, high])) => asked.map(|at| Mark::Bars(vec![(at, [low.max(bottom), high])])),
            _ => None,
        };
        marks.extend(bar);
        let point = match summary.question {
            Question::Quantile(share) => group.answer.value().map(|value| (shown(value), share)),
            _ => asked.zip(group.answer.value().filter(|p| *p > 0.0)),
        };
        marks.push(Mark::Dots(point.into_iter().collect()));
        Series { index: group.place, label: label(group), marks }
    });
    let side = if matches!(summary.question, Question::Above(_)) { "above" } else { "below" };
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", {variant}"));
    let level = Axis::new(format!("level ({})", summary.shown.shown_unit()), [low - room, high + room], 10);
    Some(Chart {
        caption: format!("{}{variant}", summary.study),
        axes: Axes {
            x: level,
            y: Axis::by_powers(format!("probability of a wall {side} the level"), [bottom, 1.0], 8),
        },
        series: series.collect(),
        remarks: Vec::new(),
    })
}

/// Text of the legend for a group.
fn label(group: &CapacityGroup) -> String {
    let kn = group.kn_pa_per_m.map_or(String::new(), |kn| format!(", kn = {}", compact(kn)));
    let runs = match &group.repeats {
        Some(repeats) => format!("; faint: {} runs of {}", repeats.probabilities.len(), method(group)),
        None => String::new(),
    };
    let (walls, name) = (group.walls, shortened(&group.name, LONGEST_NAME));
    format!("{name}{kn}: {walls} walls{runs}; bar: 95 % interval")
}
