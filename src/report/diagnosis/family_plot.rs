//! How the figure of a family looks: what was measured on the bands of the base model, over the tilt or the drift.
//!
//! The bands are greys of one colour with dashed edges, what was measured is black: the figure survives a print in grey.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::critic::Band;
use crate::report::diagnosis::family::{FamilyFigure, Panel};
use crate::report::diagnosis::signs::{dashes, reading};
use crate::report::draw::Figure;
use crate::report::marker::colour;
use crate::report::number::{range, shortened};
use crate::report::pen::{Drawn, LINE, Pen, left};
use crate::report::plot::{BAND_ALPHA, WIDTH, decimals};
use crate::study::MeasuredKind;

/// Heights of the title, of a panel and of the strip of collapse angles (pixels at scale 1).
const HEAD: u32 = 46;
const PANEL: u32 = 330;
const STRIP: u32 = 240;
/// Width of the labels on the left (pixels at scale 1).
const LEFT: i32 = 82;
/// Specimens at one tilt stand so far apart, and are spread no further than this (pixels at scale 1).
const APART: f64 = 9.0;
const SPREAD: f64 = 54.0;
/// Names longer than this are cut.
const LONGEST_NAME: usize = 30;
/// Where the rows of the strip lie.
const SIMULATED: f64 = 0.77;
const MEASURED: f64 = 0.32;

type Chart<'a, DB> = ChartContext<'a, DB, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// What is drawn, at which scale.
pub struct FamilyPlot<'f> {
    title: &'f str,
    figure: &'f FamilyFigure,
    pen: Pen,
}

impl<'f> FamilyPlot<'f> {
    /// Prepares the figure of a family.
    pub fn new(title: &'f str, figure: &'f FamilyFigure, scale: u32) -> Self {
        FamilyPlot { title, figure, pen: Pen { scale } }
    }

    fn panel<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, panel: &Panel) -> Drawn<DB> {
        let bands = panel.bands.iter().flat_map(|(_, band)| band.most);
        let medians = panel.causes.iter().flatten().map(|(_, median)| *median);
        let marks = panel.marks.iter().flat_map(|mark| [mark.value - mark.error, mark.value + mark.error]);
        let [low, high] = range(bands.chain(medians).chain(marks).chain([0.0])).unwrap_or([0.0, 1.0]);
        let height = if high > low { high - low } else { 1.0 };
        let below = if low < 0.0 { 0.05 * height } else { 0.0 };
        let end = 1.04 * self.figure.end();
        let mut chart = self
            .pen
            .frame(area, (panel.words, 20), LEFT)
            .build_cartesian_2d(0.0..end, low - below..low + 1.06 * height)?;
        let (x_decimals, y_decimals) = (decimals(end), decimals(height));
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .x_labels(10)
            .y_labels(6)
            .x_label_formatter(&|value| format!("{value:.x_decimals$}"))
            .y_label_formatter(&|value| format!("{value:.y_decimals$}"))
            .x_desc(self.figure.over)
            .y_desc(panel.unit)
            .draw()?;
        self.bands(&mut chart, panel)?;
        for (index, medians) in panel.causes.iter().enumerate() {
            self.dashed(&mut chart, medians.clone(), index)?;
        }
        let widest = panel.marks.iter().map(|mark| 2.0 * mark.place.abs()).fold(1.0, f64::max);
        let step = APART.min(SPREAD / widest) * end / f64::from(WIDTH - LEFT as u32);
        for mark in &panel.marks {
            let x = mark.at + step * mark.place;
            let bar = [(x, mark.value - mark.error), (x, mark.value + mark.error)];
            let towards = mark.bound.map(|kind| (0, if kind == MeasuredKind::Above { -1 } else { 1 }));
            self.reading(&mut chart, (x, mark.value), bar, towards)?;
        }
        Ok(())
    }

    /// Half and nine in ten of the walls, and their median.
    fn bands<DB: DrawingBackend>(&self, chart: &mut Chart<'_, DB>, panel: &Panel) -> Drawn<DB> {
        let ours = colour(0);
        let edge = |of: &dyn Fn(&Band) -> f64| -> Vec<(f64, f64)> {
            panel.bands.iter().map(|(tilt, band)| (*tilt, of(band))).collect()
        };
        for (low, high, dark) in [
            (edge(&|b| b.most[0]), edge(&|b| b.most[1]), 1.0),
            (edge(&|b| b.half[0]), edge(&|b| b.half[1]), 1.6),
        ] {
            let outline: Vec<(f64, f64)> = high.iter().copied().chain(low.iter().rev().copied()).collect();
            chart.draw_series([Polygon::new(outline, ours.mix(dark * BAND_ALPHA).filled())])?;
            for edge in [low, high].into_iter().filter(|_| dark == 1.0) {
                let style = ours.stroke_width(self.pen.scale);
                chart.draw_series(DashedLineSeries::new(edge, self.pen.px(3), self.pen.px(4), style))?;
            }
        }
        let median = edge(&|b| b.median);
        chart.draw_series(LineSeries::new(median, ours.stroke_width(2 * self.pen.scale)))?;
        Ok(())
    }

    /// A line of a cause.
    fn dashed<DB: DrawingBackend>(
        &self,
        chart: &mut Chart<'_, DB>,
        line: Vec<(f64, f64)>,
        cause: usize,
    ) -> Drawn<DB> {
        let ([dash, gap], style) = dashes(cause, self.pen);
        chart.draw_series(DashedLineSeries::new(line, dash, gap, style))?;
        Ok(())
    }

    /// A reading with the bar of its error, or a bound with an arrow.
    fn reading<DB: DrawingBackend>(
        &self,
        chart: &mut Chart<'_, DB>,
        at: (f64, f64),
        bar: [(f64, f64); 2],
        towards: Option<(i32, i32)>,
    ) -> Drawn<DB> {
        if towards.is_none() {
            chart.draw_series([PathElement::new(bar, BLACK.stroke_width(2 * self.pen.scale))])?;
        }
        for part in reading(at, towards, self.pen) {
            chart.plotting_area().draw(&part)?;
        }
        Ok(())
    }

    /// The collapse angles that were measured below those that were simulated.
    fn strip<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        (band, causes): &(Band, Vec<f64>),
    ) -> Drawn<DB> {
        let end = 1.04 * self.figure.end();
        let mut chart =
            self.pen.frame(area, ("collapse angle", 20), LEFT).build_cartesian_2d(0.0..end, 0.0..1.0)?;
        let x_decimals = decimals(end);
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .disable_y_mesh()
            .y_labels(0)
            .x_labels(10)
            .x_label_formatter(&|value| format!("{value:.x_decimals$}"))
            .x_desc("tilt (deg)")
            .draw()?;
        let ours = colour(0);
        for ([from, to], half, dark) in [(band.most, 0.1, 1.0), (band.half, 0.15, 1.6)] {
            let corners = [(from, SIMULATED - half), (to, SIMULATED + half)];
            chart.draw_series([Rectangle::new(corners, ours.mix(dark * BAND_ALPHA).filled())])?;
        }
        let upright = |x: f64| vec![(x, SIMULATED - 0.17), (x, SIMULATED + 0.17)];
        let style = ours.stroke_width(2 * self.pen.scale);
        chart.draw_series(LineSeries::new(upright(band.median), style))?;
        for (index, angle) in causes.iter().enumerate() {
            self.dashed(&mut chart, upright(*angle), index)?;
        }
        let most = self.figure.angles.iter().map(|mark| mark.place.abs()).fold(1.0, f64::max);
        for mark in &self.figure.angles {
            let y = MEASURED - 0.18 * mark.place / most;
            let bar = [(mark.value - mark.error, y), (mark.value + mark.error, y)];
            let towards = mark.bound.map(|kind| (if kind == MeasuredKind::Above { 1 } else { -1 }, 0));
            self.reading(&mut chart, (mark.value, y), bar, towards)?;
        }
        for (y, row) in [(SIMULATED, "simulated"), (MEASURED, "measured")] {
            let name = Text::new(row, (self.pen.px(12), 0), self.pen.font(18).pos(left()));
            chart.plotting_area().draw(&(EmptyElement::at((0.0, y)) + name))?;
        }
        Ok(())
    }

    /// Lines of the legend: what is simulated, what is measured, bounds, and a line per cause.
    fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            "base model: median, half and nine in ten of the walls that stand".to_string(),
            "measured: reading and one standard deviation of its error".to_string(),
        ];
        if self.figure.has_bounds() {
            lines.push("measured: only known to lie on the arrow's side".to_string());
        }
        lines.extend(self.figure.causes.iter().map(|cause| format!("median if the cause is {cause}")));
        lines
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let lines = self.lines();
        for (index, words) in lines.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            let (middle, ours) = ((from + to) / 2, colour(0));
            let cause = (index + self.figure.causes.len()).checked_sub(lines.len());
            match (index, cause) {
                (0, _) => {
                    for (half, inset, dark) in [(10, 0, 1.0), (10, 9, 1.6)] {
                        let corners = [
                            (from + self.pen.px(inset), y - self.pen.px(half)),
                            (to - self.pen.px(inset), y + self.pen.px(half)),
                        ];
                        area.draw(&Rectangle::new(corners, ours.mix(dark * BAND_ALPHA).filled()))?;
                    }
                    let style = ours.stroke_width(2 * self.pen.scale);
                    area.draw(&PathElement::new([(from, y), (to, y)], style))?;
                }
                (_, Some(cause)) => {
                    let ([dash, gap], style) = dashes(cause, self.pen);
                    for x in (0..).map(|k| from + k * (dash + gap)).take_while(|x| *x < to) {
                        let ends = [(x, y), ((x + dash).min(to), y)];
                        area.draw(&PathElement::new(ends, style))?;
                    }
                }
                (1, None) => {
                    let bar = [(middle, y - self.pen.px(10)), (middle, y + self.pen.px(10))];
                    area.draw(&PathElement::new(bar, BLACK.stroke_width(2 * self.pen.scale)))?;
                    for part in reading((middle, y), None, self.pen) {
                        area.draw(&part)?;
                    }
                }
                (_, None) => {
                    for part in reading((middle, y - self.pen.px(8)), Some((0, 1)), self.pen) {
                        area.draw(&part)?;
                    }
                }
            }
            self.pen.words(area, index, words)?;
        }
        Ok(())
    }

    fn heights(&self) -> [u32; 2] {
        let strip = if self.figure.collapse.is_some() { STRIP } else { 0 };
        [HEAD + PANEL * self.figure.panels.len() as u32 + strip, LINE * (self.lines().len() as u32 + 1)]
    }
}

impl Figure for FamilyPlot<'_> {
    /// The title, a panel per quantity, the strip, and the legend.
    fn size(&self) -> (u32, u32) {
        (WIDTH * self.pen.scale, self.heights().iter().sum::<u32>() * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let name = format!("{}: {}", self.title, shortened(&self.figure.family, LONGEST_NAME));
        root.draw(&Text::new(name, (self.pen.px(16), self.pen.px(14)), self.pen.font(24)))?;
        let (_, mut rest) = root.split_vertically(self.pen.px(HEAD as i32));
        for panel in &self.figure.panels {
            let (area, below) = rest.split_vertically(self.pen.px(PANEL as i32));
            self.panel(&area, panel)?;
            rest = below;
        }
        if let Some(collapse) = &self.figure.collapse {
            let (strip, legend) = rest.split_vertically(self.pen.px(STRIP as i32));
            self.strip(&strip, collapse)?;
            rest = legend;
        }
        self.legend(&rest)
    }
}
