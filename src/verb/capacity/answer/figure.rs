//! How probable a failure is, over the level: the figure of a capacity and the table behind it.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::axes::{BAND_ALPHA, PLOT_HEIGHT, WIDTH, decimals};
use crate::render::csv::{cell, ends, quoted};
use crate::render::draw::Figure;
use crate::render::marker::colour;
use crate::render::number::{compact, range, shortened};
use crate::render::pen::{Drawn, LINE, Pen};
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
pub(crate) fn capacity_csv(summary: &CapacitySummary) -> String {
    let mut text = format!("name,kn_pa_per_m,of,run,level_{},probability,low,high\n", summary.unit);
    let mut line =
        |group: &CapacityGroup, of: &str, run: Option<usize>, level: f64, probability: f64, interval| {
            let kn = group.kn_pa_per_m.map_or(String::new(), |kn| kn.to_string());
            let run = run.map_or(String::new(), |run| run.to_string());
            let [low, high] = ends(interval);
            let name = quoted(&group.name);
            text.push_str(&format!(
                "{name},{kn},{of},{run},{level},{},{low},{high}\n",
                cell(Some(probability))
            ));
        };
    for group in &summary.groups {
        for rung in &group.rungs {
            let of = if rung.run.is_some() { "run" } else { "walls" };
            line(group, of, rung.run, rung.level, rung.probability, rung.interval);
        }
        match (summary.question, group.answer) {
            (Question::Below(level) | Question::Above(level), Answer::Probability(Some(probability))) => {
                line(group, "answer", None, level, probability, group.interval);
            }
            // The interval of a quantile is one of levels: its ends are two lines.
            (Question::Quantile(share), Answer::Quantile(Some(value))) => {
                line(group, "answer", None, value, share, None);
                for end in group.interval.into_iter().flatten() {
                    line(group, "end of its interval", None, end, share, None);
                }
            }
            _ => {}
        }
    }
    text
}

/// What is drawn, at which scale.
pub(crate) struct CapacityPlot<'c> {
    title: String,
    summary: &'c CapacitySummary,
    groups: Vec<&'c CapacityGroup>,
    pen: Pen,
}

impl<'c> CapacityPlot<'c> {
    /// Of the walls that differ.
    pub fn new(summary: &'c CapacitySummary, scale: u32) -> Self {
        let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", {variant}"));
        let groups = summary.groups.iter().filter(|group| group.random).collect();
        CapacityPlot { title: format!("{}{variant}", summary.study), summary, groups, pen: Pen { scale } }
    }

    /// Whether there is anything to draw.
    pub fn is_empty(&self) -> bool {
        self.groups.iter().all(|group| group.rungs.is_empty())
    }

    fn chart<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let quantity = self.summary.shown;
        let shown = |level: f64| quantity.shown(level);
        let rungs = || self.groups.iter().flat_map(|group| &group.rungs);
        let asked = match self.summary.question {
            Question::Below(level) | Question::Above(level) => Some(shown(level)),
            Question::Quantile(_) => None,
        };
        let [low, high] = range(rungs().map(|rung| shown(rung.level)).chain(asked)).unwrap_or([0.0, 1.0]);
        let room = if high > low { 0.05 * (high - low) } else { 0.1 * high.abs().max(1.0) };
        let answers = self
            .groups
            .iter()
            .filter(|_| asked.is_some())
            .flat_map(|group| group.answer.value().into_iter().chain(group.interval.map(|[low, _]| low)));
        let seen = rungs().map(|rung| rung.probability).chain(answers).filter(|p| *p > 0.0);
        let bottom = BELOW * range(seen).map_or(0.1, |[low, _]| low);
        let mut chart = self
            .pen
            .frame(area, (&self.title, 26), 96)
            .build_cartesian_2d(low - room..high + room, (bottom..1.0).log_scale())?;
        let x_decimals = decimals(high - low + 2.0 * room);
        let side = if matches!(self.summary.question, Question::Above(_)) { "above" } else { "below" };
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .x_labels(10)
            .y_labels(8)
            .x_label_formatter(&|value| format!("{value:.x_decimals$}"))
            .y_label_formatter(&|value| compact(*value))
            .x_desc(format!("level ({})", quantity.shown_unit()))
            .y_desc(format!("probability of a wall {side} the level"))
            .draw()?;
        for (index, group) in self.groups.iter().enumerate() {
            let colour = colour(index);
            let line = |run: Option<usize>| {
                let own = group.rungs.iter().filter(move |rung| rung.run == run);
                own.map(|rung| (shown(rung.level), rung.probability)).collect::<Vec<_>>()
            };
            let runs = group.rungs.iter().filter_map(|rung| rung.run).max().map_or(0, |last| last + 1);
            for run in 0..runs {
                let style = colour.mix(3.0 * BAND_ALPHA).stroke_width(self.pen.scale);
                chart.draw_series(LineSeries::new(line(Some(run)), style))?;
            }
            chart.draw_series(LineSeries::new(line(None), colour.stroke_width(2 * self.pen.scale)))?;
            let style = colour.stroke_width(2 * self.pen.scale);
            let bar = match (self.summary.question, group.interval) {
                (Question::Quantile(share), Some(ends)) => Some(ends.map(|end| (shown(end), share))),
                (_, Some([low, high])) => asked.map(|at| [(at, low.max(bottom)), (at, high)]),
                _ => None,
            };
            chart.draw_series(bar.map(|bar| PathElement::new(bar, style)))?;
            let point = match self.summary.question {
                Question::Quantile(share) => group.answer.value().map(|value| (shown(value), share)),
                _ => asked.zip(group.answer.value().filter(|p| *p > 0.0)),
            };
            chart.draw_series(point.map(|at| Circle::new(at, self.pen.px(4), colour.filled())))?;
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        for (index, group) in self.groups.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            area.draw(&PathElement::new(
                [(from, y), (to, y)],
                colour(index).stroke_width(2 * self.pen.scale),
            ))?;
            let kn = group.kn_pa_per_m.map_or(String::new(), |kn| format!(", kn = {}", compact(kn)));
            let runs = match &group.repeats {
                Some(repeats) => {
                    format!("; faint: {} runs of {}", repeats.probabilities.len(), method(group))
                }
                None => String::new(),
            };
            let walls = group.walls;
            let name = shortened(&group.name, LONGEST_NAME);
            self.pen.words(area, index, &format!("{name}{kn}: {walls} walls{runs}; bar: 95 % interval"))?;
        }
        Ok(())
    }
}

impl Figure for CapacityPlot<'_> {
    /// The plot, and a line of legend per group.
    fn size(&self) -> (u32, u32) {
        (WIDTH * self.pen.scale, (PLOT_HEIGHT + LINE * (self.groups.len() as u32 + 1)) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_vertically(self.pen.px(PLOT_HEIGHT as i32));
        self.chart(&plot)?;
        self.legend(&legend)
    }
}
