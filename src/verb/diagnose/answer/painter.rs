//! How a family's readings are painted on the bands of a model: a quantity over the tilt or the drift, and the strip of collapse angles.
//!
//! The bands are greys of one colour with dashed edges, what was measured is black: the figure survives a print in grey.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::critic::Band;
use crate::render::axes::{Axes, Axis, BAND_ALPHA, Plane};
use crate::render::marker::colour;
use crate::render::number::range;
use crate::render::pen::{Drawn, Pen, left};
use crate::study::MeasuredKind;
use crate::verb::diagnose::answer::family::{Mark, Panel};
use crate::verb::diagnose::answer::signs::{dashes, reading};

/// Width of the labels on the left (pixels at scale 1).
pub const LEFT: i32 = 82;
/// Specimens at one tilt stand so far apart, and are spread no further than this (pixels at scale 1).
const APART: f64 = 9.0;
const SPREAD: f64 = 54.0;
/// Where the rows of the strip lie.
const SIMULATED: f64 = 0.77;
const MEASURED: f64 = 0.32;

/// Paints over one axis.
#[derive(Clone, Copy, Debug)]
pub struct Painter {
    /// Words of the axis.
    pub over: &'static str,
    /// Where it ends: tilt (deg) or drift (%).
    pub end: f64,
    /// How many labels it has, about.
    pub labels: usize,
    /// Width of a chart (pixels at scale 1).
    pub width: u32,
    /// The pen.
    pub pen: Pen,
}

/// The lowest and the highest number of some panels; 0 is among them.
pub fn ends<'p>(panels: impl IntoIterator<Item = &'p Panel>) -> [f64; 2] {
    let of = |panel: &'p Panel| {
        let bands = panel.bands.iter().flat_map(|(_, band)| band.most);
        let medians = panel.causes.iter().flatten().map(|(_, median)| *median);
        let marks = panel.marks.iter().flat_map(|mark| [mark.value - mark.error, mark.value + mark.error]);
        bands.chain(medians).chain(marks).collect::<Vec<f64>>()
    };
    range(panels.into_iter().flat_map(of).chain([0.0])).unwrap_or([0.0, 1.0])
}

impl Painter {
    /// A quantity, with its words above it, between these ends.
    pub fn panel<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        (panel, words): (&Panel, &str),
        [low, high]: [f64; 2],
    ) -> Drawn<DB> {
        let height = if high > low { high - low } else { 1.0 };
        let below = if low < 0.0 { 0.05 * height } else { 0.0 };
        let end = 1.04 * self.end;
        let upwards = Axis::new(panel.unit, [low - below, low + 1.06 * height], 6);
        let axes = Axes { x: Axis::new(self.over, [0.0, end], self.labels), y: upwards };
        let mut chart = axes.on(area, self.pen, (words, 20), LEFT)?;
        self.bands(&mut chart, panel)?;
        for (index, medians) in panel.causes.iter().enumerate() {
            self.dashed(&mut chart, medians.clone(), index)?;
        }
        let widest = panel.marks.iter().map(|mark| 2.0 * mark.place.abs()).fold(1.0, f64::max);
        let step = APART.min(SPREAD / widest) * end / f64::from(self.width - LEFT as u32);
        for mark in &panel.marks {
            let x = mark.at + step * mark.place;
            let bar = [(x, mark.value - mark.error), (x, mark.value + mark.error)];
            let towards = mark.bound.map(|kind| (0, if kind == MeasuredKind::Above { -1 } else { 1 }));
            self.reading(&mut chart, (x, mark.value), bar, towards)?;
        }
        Ok(())
    }

    /// Half and nine in ten of the walls, and their median.
    fn bands<DB: DrawingBackend>(&self, chart: &mut Plane<'_, DB>, panel: &Panel) -> Drawn<DB> {
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
        chart: &mut Plane<'_, DB>,
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
        chart: &mut Plane<'_, DB>,
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

    /// The collapse angles that were measured below those that were simulated; the medians under causes are dashed.
    pub fn strip<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        (band, causes): &(Band, Vec<f64>),
        angles: &[Mark],
    ) -> Drawn<DB> {
        let x = Axis::new(self.over, [0.0, 1.04 * self.end], self.labels);
        let mut chart =
            Axes { x, y: Axis::new("", [0.0, 1.0], 0) }.on(area, self.pen, ("collapse angle", 20), LEFT)?;
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
        let most = angles.iter().map(|mark| mark.place.abs()).fold(1.0, f64::max);
        for mark in angles {
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
}
