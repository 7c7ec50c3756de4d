//! The fragility figure: P(collapse | tilt) as steps, with the pointwise band of Clopper and Pearson.

use crate::ensemble::Quantity;
use crate::render::axes::{Axes, Axis};
use crate::render::chart::{Chart, Mark, Series};
use crate::render::document::{ReadOff, Scale, Trace};
use crate::render::number::{range, shortened, stiffness};
use crate::verb::run::answer::figure::Ladder;

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 24;

/// The chart of curves over a quantity.
pub(crate) fn fragility(title: &str, ladders: &[Ladder], quantity: Quantity) -> Chart {
    let values = ladders.iter().flat_map(|ladder| &ladder.steps).map(|step| step.value);
    let [low, high] = range(values).unwrap_or([0.0, 1.0]);
    let room = if high > low { 0.1 * (high - low) } else { 0.1 * high.abs().max(1.0) };
    let ends = [low - room, high + room];
    let kn = ladders.first().map_or(String::new(), |ladder| stiffness(ladder.kn));
    let [over, share] = match quantity {
        Quantity::CollapseAngle => ["tilt (deg)", "share of walls that have collapsed"],
        _ => [quantity.axis(), "share of walls with less"],
    };
    let series = ladders.iter().map(|ladder| {
        let flats = if ladder.random { ladder.flats(ends[1]) } else { Vec::new() };
        let marks = vec![Mark::Flats(flats), Mark::Line(ladder.line(ends))];
        Series { index: ladder.place, label: ladder.label(), marks }
    });
    Chart {
        caption: format!("{title}, kn = {kn}"),
        axes: Axes { x: Axis::new(over, ends, 10), y: Axis::new(share, [0.0, 1.02], 6) },
        series: series.collect(),
        remarks: Vec::new(),
    }
}

/// Shares of walls that have failed over the level, with the interval at each level alone.
pub(crate) fn shares(ladders: &[Ladder], quantity: Quantity) -> Option<ReadOff> {
    let trace = |ladder: &Ladder| {
        let band = |ends: [f64; 2]| ladder.random.then_some(ends);
        let steps =
            ladder.steps.iter().map(|step| (step.value, Some(step.probability), band(step.pointwise)));
        Trace { steps: true, colour: Some(ladder.place), ..Trace::through(&ladder.arm, steps) }
    };
    ReadOff::with(Scale::of(quantity.axis()), Scale::of("share of walls"), ladders.iter().map(trace))
}

impl Ladder {
    /// The step function, drawn from one end of the axis to the other.
    fn line(&self, [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
        let (mut line, mut height) = (vec![(from, 0.0)], 0.0);
        for step in &self.steps {
            line.push((step.value, height));
            height = step.probability;
            line.push((step.value, height));
        }
        line.push((to, height));
        line
    }

    /// The band from each step to the next, and from the last to the end of the axis. Between two steps the probability does not change,
    /// and nor does its interval; before the first it is that of no collapse, which the first step's lower end does not exceed.
    fn flats(&self, end: f64) -> Vec<(f64, f64, [f64; 2])> {
        let ends = self.steps.iter().skip(1).map(|step| step.value).chain([end]);
        self.steps.iter().zip(ends).map(|(step, to)| (step.value, to, step.pointwise)).collect()
    }

    fn label(&self) -> String {
        let name = shortened(&self.arm, LONGEST_NAME);
        let lost = if self.lost > 0 { format!("; {} failed otherwise", self.lost) } else { String::new() };
        match (self.random, self.steps.is_empty()) {
            (_, true) => format!("{name}: no wall collapsed{lost}"),
            (false, _) => format!("{name}: one wall, nothing random{lost}"),
            (true, _) => {
                format!("{name}: {} walls, band: 95 % pointwise (Clopper and Pearson){lost}", self.walls)
            }
        }
    }
}
