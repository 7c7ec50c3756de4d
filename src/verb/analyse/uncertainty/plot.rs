//! How the answers look: one panel per parameter, each wall a point, the interval a band, the answer at the middle a line.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::math::{exp, ln};
use crate::render::axes::{Axes, Axis, BAND_ALPHA, PLOT_HEIGHT, over_key};
use crate::render::draw::Figure;
use crate::render::marker::colour;
use crate::render::number::range;
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::analyse::uncertainty::UncertaintySummary;
use crate::verb::analyse::uncertainty::entry::Asked;
use crate::verb::analyse::uncertainty::text::{falls, ranges};

/// Width of a panel, and of the whole at least (pixels at scale 1).
const PANEL: u32 = 460;
const NARROWEST: u32 = 980;
/// Radius of a point (pixels at scale 1).
const POINT: i32 = 4;
/// Room about the points, as a share of their range.
const ROOM: f64 = 0.08;
/// The axis of loads is at least so many times as long as what the solver tells apart.
const NARROWEST_LOADS: f64 = 20.0;

/// What is drawn, at which scale.
pub struct PointsPlot<'s> {
    summary: &'s UncertaintySummary,
    pen: Pen,
}

impl<'s> PointsPlot<'s> {
    /// Prepares the figure.
    pub fn new(summary: &'s UncertaintySummary, scale: u32) -> Self {
        PointsPlot { summary, pen: Pen { scale } }
    }

    fn panel<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        (number, own): (usize, &Asked),
    ) -> Drawn<DB> {
        let (summary, is_log) = (self.summary, own.unsure.spread.is_log());
        let walls = summary.points.iter().map(|(values, ended)| (values[number], ended.value()));
        let points: Vec<(f64, f64)> = walls.clone().filter_map(|(x, y)| Some((x, y?))).collect();
        // Room about powers of ten is a factor.
        let place = |x: f64| if is_log { ln(x) } else { x };
        let [from, to] = about(range(walls.map(|(x, _)| place(x))), 0.0);
        let [from, to] = [from, to].map(|x| if is_log { exp(x) } else { x });
        let shown = points.iter().map(|(_, y)| *y).chain(summary.answer.middle);
        let [low, high] = about(range(shown), NARROWEST_LOADS * summary.answered.resolution);
        let x = Axis { is_log, ..Axis::new(over_key(own.unsure.name), [from, to], 4) };
        let y = Axis::new(format!("load at collapse ({})", summary.answered.unit), [low, high], 8);
        let mut chart = Axes { x, y }.on(area, self.pen, (own.word, 22), 82)?;
        if let [Some(bottom), Some(top)] = summary.answer.interval {
            let corners = [(from, bottom.max(low)), (to, top.min(high))];
            chart.draw_series([Rectangle::new(corners, colour(0).mix(BAND_ALPHA).filled())])?;
        }
        if let Some(middle) = summary.answer.middle {
            let line = [(from, middle), (to, middle)];
            chart.draw_series(LineSeries::new(line, colour(1).stroke_width(2 * self.pen.scale)))?;
        }
        let dot = |at| Circle::new(at, self.pen.px(POINT), colour(0).filled());
        chart.draw_series(points.into_iter().map(dot))?;
        Ok(())
    }

    /// What is shown, and what is not.
    fn remarks(&self) -> [String; 4] {
        let answer = &self.summary.answer;
        let drawn = self.summary.points.iter().filter(|(_, ended)| ended.value().is_some()).count();
        let left = answer.walls - drawn;
        [
            ranges(self.summary),
            falls(self.summary),
            "band: that interval; line: the answer with all parameters at their middle".to_owned(),
            format!("points: {drawn} walls that fall; not drawn, without a load at collapse: {left}"),
        ]
    }
}

impl Figure for PointsPlot<'_> {
    fn size(&self) -> (u32, u32) {
        let width = (PANEL * self.summary.asked.len() as u32).max(NARROWEST);
        let height = PLOT_HEIGHT + LINE * (self.remarks().len() as u32 + 1);
        (width * self.pen.scale, height * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_vertically(self.pen.px(PLOT_HEIGHT as i32));
        let panels = plot.split_evenly((1, self.summary.asked.len()));
        for (panel, own) in panels.iter().zip(self.summary.asked.iter().enumerate()) {
            self.panel(panel, own)?;
        }
        for (line, remark) in self.remarks().iter().enumerate() {
            self.pen.remark(&legend, line, remark)?;
        }
        Ok(())
    }
}

/// A range with room on both sides, and at least as wide as `narrowest`.
fn about(range: Option<[f64; 2]>, narrowest: f64) -> [f64; 2] {
    let [low, high] = range.unwrap_or([0.0, 1.0]);
    let room = (ROOM * (high - low)).max(0.5 * narrowest);
    [low - room, high + room]
}
