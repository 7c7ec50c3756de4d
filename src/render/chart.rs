//! A chart: series of lines, bands, bars and marks over one pair of axes, with a legend below. Bands are edged with dashes and arms have
//! markers of their own, so that it survives a print in grey.

use std::rc::Rc;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::axes::{Axes, BAND_ALPHA, PLOT_HEIGHT, Plane, WIDTH};
use crate::render::draw::Figure;
use crate::render::marker::{colour, filled, hollow};
use crate::render::pen::{Drawn, LINE, Pen, centred};

/// Width of the labels on the left (pixels at scale 1).
const LEFT: i32 = 92;

/// A chart.
pub(crate) struct Chart {
    /// Its caption.
    pub caption: String,
    /// Its axes.
    pub axes: Axes,
    /// What is drawn, the last on top.
    pub series: Vec<Series>,
    /// Lines below the legend.
    pub remarks: Vec<String>,
}

/// What is drawn in one colour and has one line of the legend.
pub(crate) struct Series {
    /// Number of its colour and its marker.
    pub index: usize,
    /// Its words in the legend.
    pub label: String,
    /// What it consists of.
    pub marks: Vec<Mark>,
}

/// One kind of mark, by the values at which it lies.
pub(crate) enum Mark {
    /// A line through points.
    Line(Vec<(f64, f64)>),
    /// A faint one, one of many.
    Faint(Vec<(f64, f64)>),
    /// A band between two edges; of a single point a short bar.
    Band(Vec<(f64, [f64; 2])>),
    /// A band by steps, each from one value to another.
    Flats(Vec<(f64, f64, [f64; 2])>),
    /// Bars upwards.
    Bars(Vec<(f64, [f64; 2])>),
    /// Dots.
    Dots(Vec<(f64, f64)>),
    /// The markers of its arm.
    Markers(Vec<(f64, f64)>),
    /// Their outlines.
    Outlines(Vec<(f64, f64)>),
}

impl Chart {
    /// The chart at a scale.
    pub fn at(self: Rc<Chart>, scale: u32) -> ScaledChart {
        ScaledChart { chart: self, pen: Pen { scale } }
    }
}

/// A chart at a scale.
pub(crate) struct ScaledChart {
    chart: Rc<Chart>,
    pen: Pen,
}

/// Neighbours for which `value` is defined: no line is drawn across a gap.
pub(crate) fn runs<P, T>(points: &[P], value: impl Fn(&P) -> Option<T>) -> Vec<Vec<T>> {
    let mut runs = vec![Vec::new()];
    for point in points {
        match (value(point), runs.last_mut()) {
            (Some(value), Some(run)) => run.push(value),
            _ => runs.push(Vec::new()),
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

impl Mark {
    fn is_empty(&self) -> bool {
        match self {
            Mark::Line(at) | Mark::Faint(at) | Mark::Dots(at) | Mark::Markers(at) | Mark::Outlines(at) => {
                at.is_empty()
            }
            Mark::Band(at) | Mark::Bars(at) => at.is_empty(),
            Mark::Flats(at) => at.is_empty(),
        }
    }

    fn is_band(&self) -> bool {
        matches!(self, Mark::Band(_) | Mark::Flats(_))
    }
}

impl ScaledChart {
    fn plane<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let chart = &self.chart;
        let mut plane = chart.axes.on(area, self.pen, (&chart.caption, 26), LEFT)?;
        for is_band in [true, false] {
            for series in &chart.series {
                for mark in series.marks.iter().filter(|mark| mark.is_band() == is_band) {
                    match is_band {
                        true => self.band(&mut plane, series.index, mark)?,
                        false => self.mark(&mut plane, series.index, mark)?,
                    }
                }
            }
        }
        if chart.series.iter().flat_map(|series| &series.marks).all(Mark::is_empty) {
            let (x, y) = (plane.x_range(), plane.y_range());
            let middle = ((x.start + x.end) / 2.0, (y.start + y.end) / 2.0);
            let words = "no wall brings a value: there is nothing to draw";
            plane.draw_series([Text::new(words, middle, self.pen.font(22).pos(centred()))])?;
        }
        Ok(())
    }

    fn band<DB: DrawingBackend>(&self, plane: &mut Plane<'_, DB>, index: usize, mark: &Mark) -> Drawn<DB> {
        let style = colour(index).mix(BAND_ALPHA).filled();
        match mark {
            Mark::Flats(flats) => {
                let corners = |(from, to, [low, high]): &(f64, f64, [f64; 2])| {
                    Rectangle::new([(*from, *low), (*to, *high)], style)
                };
                plane.draw_series(flats.iter().map(corners))?;
            }
            Mark::Band(points) => {
                if let [(x, [low, high])] = points[..] {
                    let (top, half) = ((x, high), self.pen.px(14));
                    let pixels = plane.backend_coord(&top).1 - plane.backend_coord(&(x, low)).1;
                    let bar = EmptyElement::at(top) + Rectangle::new([(-half, 0), (half, -pixels)], style);
                    plane.draw_series([bar])?;
                    return Ok(());
                }
                let edge = |end: usize| points.iter().map(move |(x, ends)| (*x, ends[end]));
                let outline: Vec<(f64, f64)> = edge(1).chain(edge(0).rev()).collect();
                plane.draw_series((outline.len() > 2).then(|| Polygon::new(outline, style)))?;
                for end in [1, 0] {
                    let style = colour(index).stroke_width(self.pen.scale);
                    let (dash, gap) = (self.pen.px(8), self.pen.px(5));
                    plane.draw_series(DashedLineSeries::new(edge(end), dash, gap, style))?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn mark<DB: DrawingBackend>(&self, plane: &mut Plane<'_, DB>, index: usize, mark: &Mark) -> Drawn<DB> {
        let (colour, scale) = (colour(index), self.pen.scale);
        let line = colour.stroke_width(2 * scale);
        match mark {
            Mark::Line(points) => {
                plane.draw_series(LineSeries::new(points.iter().copied(), line))?;
            }
            Mark::Faint(points) => {
                let style = colour.mix(3.0 * BAND_ALPHA).stroke_width(scale);
                plane.draw_series(LineSeries::new(points.iter().copied(), style))?;
            }
            Mark::Bars(bars) => {
                let cap = self.pen.px(5);
                for (x, ends) in bars {
                    let ends = ends.map(|y| (*x, y));
                    plane.draw_series([PathElement::new(ends, line)])?;
                    let caps =
                        ends.map(|end| EmptyElement::at(end) + PathElement::new([(-cap, 0), (cap, 0)], line));
                    plane.draw_series(caps)?;
                }
            }
            Mark::Dots(points) => {
                let dot = |at: &(f64, f64)| Circle::new(*at, self.pen.px(4), colour.filled());
                plane.draw_series(points.iter().map(dot))?;
            }
            Mark::Markers(points) => {
                for at in points {
                    plane.plotting_area().draw(&filled(*at, index, scale))?;
                }
            }
            Mark::Outlines(points) => {
                for edge in points.iter().flat_map(|at| hollow(*at, index, scale)) {
                    plane.plotting_area().draw(&edge)?;
                }
            }
            Mark::Band(_) | Mark::Flats(_) => {}
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        for (line, series) in self.chart.series.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(line);
            let (colour, middle) = (colour(series.index), (from + to) / 2);
            let is = |of: fn(&Mark) -> bool| series.marks.iter().any(of);
            if is(|mark| matches!(mark, Mark::Line(_))) {
                let style = colour.stroke_width(2 * self.pen.scale);
                area.draw(&PathElement::new([(from, y), (to, y)], style))?;
            } else if is(Mark::is_band) {
                let half = self.pen.px(8);
                let corners = [(from, y - half), (to, y + half)];
                area.draw(&Rectangle::new(corners, colour.mix(BAND_ALPHA).filled()))?;
            }
            if is(|mark| matches!(mark, Mark::Markers(at) if !at.is_empty())) {
                area.draw(&filled((middle, y), series.index, self.pen.scale))?;
            }
            if is(|mark| matches!(mark, Mark::Outlines(_))) {
                for edge in hollow((middle, y), series.index, self.pen.scale) {
                    area.draw(&edge)?;
                }
            }
            self.pen.words(area, line, &series.label)?;
        }
        for (line, remark) in (self.chart.series.len()..).zip(&self.chart.remarks) {
            self.pen.remark(area, line, remark)?;
        }
        Ok(())
    }
}

impl Figure for ScaledChart {
    /// The plot, a line per series and per remark.
    fn size(&self) -> (u32, u32) {
        let lines = (self.chart.series.len() + self.chart.remarks.len()) as u32;
        (WIDTH * self.pen.scale, (PLOT_HEIGHT + LINE * (lines + 1)) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_vertically(self.pen.px(PLOT_HEIGHT as i32));
        self.plane(&plot)?;
        self.legend(&legend)
    }
}
