//! How the fragility figure looks: P(collapse | tilt) as steps, with the pointwise band of Clopper and Pearson.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::ensemble::Quantity;
use crate::render::axes::{BAND_ALPHA, PLOT_HEIGHT, WIDTH, decimals};
use crate::render::draw::Figure;
use crate::render::marker::colour;
use crate::render::number::{range, shortened, stiffness};
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::run::answer::figure::Ladder;

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 24;

/// What is drawn, at which scale.
pub struct FragilityPlot<'c> {
    title: &'c str,
    ladders: &'c [Ladder],
    axes: [&'static str; 2],
    pen: Pen,
}

impl<'c> FragilityPlot<'c> {
    /// Prepares the curves.
    pub fn new(title: &'c str, ladders: &'c [Ladder], scale: u32) -> Self {
        let axes = ["tilt (deg)", "share of walls that have collapsed"];
        FragilityPlot { title, ladders, axes, pen: Pen { scale } }
    }

    /// Says what the steps are of, where it need not be a tilt.
    pub fn of(mut self, quantity: Quantity) -> Self {
        if quantity != Quantity::CollapseAngle {
            self.axes = [quantity.axis(), "share of walls with less"];
        }
        self
    }

    fn chart<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let values = self.ladders.iter().flat_map(|ladder| &ladder.steps).map(|step| step.value);
        let [low, high] = range(values).unwrap_or([0.0, 1.0]);
        let room = if high > low { 0.1 * (high - low) } else { 0.1 * high.abs().max(1.0) };
        let ends = [low - room, high + room];
        let kn = self.ladders.first().map_or(String::new(), |ladder| stiffness(ladder.kn));
        let mut chart = self
            .pen
            .frame(area, (&format!("{}, kn = {kn}", self.title), 26), 82)
            .build_cartesian_2d(ends[0]..ends[1], 0.0..1.02)?;
        let x_decimals = decimals(ends[1] - ends[0]);
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .x_labels(10)
            .y_labels(6)
            .x_label_formatter(&|value| format!("{value:.x_decimals$}"))
            .y_label_formatter(&|value| format!("{value:.1}"))
            .x_desc(self.axes[0])
            .y_desc(self.axes[1])
            .draw()?;
        for (index, ladder) in self.ladders.iter().enumerate() {
            let colour = colour(index);
            if ladder.random {
                // Between two steps the probability does not change, and nor does its interval; before the first it is
                // that of no collapse, which the first step's lower end does not exceed.
                for (from, to, step) in ladder.flats(ends[1]) {
                    let [low, high] = step.pointwise;
                    let style = colour.mix(BAND_ALPHA).filled();
                    chart.draw_series([Rectangle::new([(from, low), (to, high)], style)])?;
                }
            }
            chart.draw_series(LineSeries::new(ladder.line(ends), colour.stroke_width(2 * self.pen.scale)))?;
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        for (index, ladder) in self.ladders.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            let colour = colour(index);
            area.draw(&PathElement::new([(from, y), (to, y)], colour.stroke_width(2 * self.pen.scale)))?;
            self.pen.words(area, index, &ladder.label())?;
        }
        Ok(())
    }
}

impl Figure for FragilityPlot<'_> {
    /// The plot, and a line of legend per curve.
    fn size(&self) -> (u32, u32) {
        (WIDTH * self.pen.scale, (PLOT_HEIGHT + LINE * (self.ladders.len() as u32 + 1)) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_vertically(self.pen.px(PLOT_HEIGHT as i32));
        self.chart(&plot)?;
        self.legend(&legend)
    }
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

    /// From each step to the next, and from the last to the end of the axis.
    fn flats(&self, end: f64) -> Vec<(f64, f64, crate::stats::EmpiricalStep)> {
        let ends = self.steps.iter().skip(1).map(|step| step.value).chain([end]);
        self.steps.iter().zip(ends).map(|(step, to)| (step.value, to, *step)).collect()
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
