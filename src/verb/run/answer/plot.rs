//! How the figure over kn looks: the quantity against joint stiffness, legend and remarks below.
//!
//! Bands are edged with dashes, so that the figure survives a print in grey.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::render::axes::{BAND_ALPHA, PLOT_HEIGHT, WIDTH, decimals, exponent};
use crate::render::draw::Figure;
use crate::render::marker::{colour, filled, hollow};
use crate::render::number::{range, shortened};
use crate::render::pen::{Drawn, LINE, Pen, centred};
use crate::verb::run::answer::beside::{Earlier, Mean};
use crate::verb::run::answer::figure::{Curve, LONGEST_NAME, Point};

type Chart<'a, DB> = ChartContext<'a, DB, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// What is drawn, at which scale.
pub struct Plot<'c> {
    title: &'c str,
    curves: &'c [Curve],
    beside: Option<&'c Earlier>,
    remarks: Vec<String>,
    pen: Pen,
    /// kn is shown in units of ten to this power.
    exponent: i32,
}

/// An arm of the earlier run.
struct EarlierArm<'c> {
    /// Number of its colour and marker.
    index: usize,
    arm: &'c str,
    means: &'c [Mean],
    run: &'c str,
}

impl EarlierArm<'_> {
    fn label(&self) -> String {
        format!("{}: mean of an earlier run ({})", shortened(self.arm, LONGEST_NAME), self.run)
    }
}

impl<'c> Plot<'c> {
    /// Prepares the curves.
    pub fn new(title: &'c str, curves: &'c [Curve], scale: u32) -> Self {
        let remarks = curves.iter().filter_map(Curve::remark).collect();
        let kn = range(curves.iter().flat_map(|curve| &curve.points).map(|point| point.kn));
        Plot {
            title,
            curves,
            beside: None,
            remarks,
            pen: Pen { scale },
            exponent: kn.map_or(0, |[low, _]| exponent(low)),
        }
    }

    /// Shows the means of an earlier run as well.
    pub fn beside(mut self, earlier: Option<&'c Earlier>) -> Self {
        self.beside = earlier;
        self
    }

    fn chart<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let [x, y] = self.axes();
        let mut chart =
            self.pen.frame(area, (self.title, 26), 82).build_cartesian_2d(x[0]..x[1], y[0]..y[1])?;
        let (x_decimals, y_decimals) = (decimals(x[1] - x[0]), decimals(y[1] - y[0]));
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .x_labels(10)
            .y_labels(8)
            .x_label_formatter(&|value| format!("{value:.x_decimals$}"))
            .y_label_formatter(&|value| format!("{value:.y_decimals$}"))
            .x_desc(format!("normal stiffness of the joints kn (10{} Pa/m)", superscript(self.exponent)))
            .y_desc(self.curves.first().map_or("", |curve| curve.quantity.axis()))
            .draw()?;
        for (index, curve) in self.curves.iter().enumerate() {
            self.band(&mut chart, curve, index)?;
        }
        for (index, curve) in self.curves.iter().enumerate() {
            self.curve(&mut chart, curve, index)?;
        }
        for earlier in self.earlier() {
            for mean in earlier.means {
                let place = (self.kn(mean.kn), mean.shown);
                for edge in hollow(place, earlier.index, self.pen.scale) {
                    chart.plotting_area().draw(&edge)?;
                }
            }
        }
        if self.curves.iter().flat_map(|curve| &curve.points).all(|point| point.mean.is_none()) {
            let place = ((x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0);
            let style = self.pen.font(22).pos(centred());
            chart.draw_series([Text::new(
                "no wall brings a value: there is nothing to draw",
                place,
                style,
            )])?;
        }
        Ok(())
    }

    /// Ends of the axes: kn with some room at both sides; displacement from zero (or below) to above the highest mark.
    fn axes(&self) -> [[f64; 2]; 2] {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let earlier = || self.earlier().into_iter().flat_map(|arm| arm.means);
        let kn = points().map(|point| point.kn).chain(earlier().map(|mean| mean.kn));
        let [low, high] = range(kn.map(|kn| self.kn(kn))).unwrap_or([0.0, 1.0]);
        let room = if high > low { 0.06 * (high - low) } else { 0.1 * high.abs() };
        let heights = points().flat_map(|point| {
            point
                .mean
                .into_iter()
                .chain(point.mean_ci.into_iter().flatten())
                .chain(point.band.into_iter().flatten())
        });
        let [bottom, top] =
            range(heights.chain(earlier().map(|mean| mean.shown)).chain([0.0])).unwrap_or([0.0, 0.0]);
        let height = if top > bottom { top - bottom } else { 1.0 };
        let below = if bottom < 0.0 { 0.05 * height } else { 0.0 };
        [[low - room, high + room], [bottom - below, bottom + 1.08 * height]]
    }

    /// Mean -+ sigma. A point without defined neighbours gets a short bar instead of a band.
    fn band<DB: DrawingBackend>(&self, chart: &mut Chart<'_, DB>, curve: &Curve, index: usize) -> Drawn<DB> {
        if !curve.has_band() {
            return Ok(());
        }
        let colour = colour(index);
        for run in runs(&curve.points, |point| point.band.map(|band| (self.kn(point.kn), band))) {
            if let [(x, [low, high])] = run[..] {
                let (half, style) = (self.pen.px(14), colour.mix(BAND_ALPHA).filled());
                let pixels = chart.backend_coord(&(x, high)).1 - chart.backend_coord(&(x, low)).1;
                let bar = EmptyElement::at((x, high)) + Rectangle::new([(-half, 0), (half, -pixels)], style);
                chart.draw_series([bar])?;
                continue;
            }
            let upper: Vec<(f64, f64)> = run.iter().map(|(x, band)| (*x, band[1])).collect();
            let lower: Vec<(f64, f64)> = run.iter().map(|(x, band)| (*x, band[0])).collect();
            let outline: Vec<(f64, f64)> = upper.iter().copied().chain(lower.iter().rev().copied()).collect();
            chart.draw_series([Polygon::new(outline, colour.mix(BAND_ALPHA).filled())])?;
            for edge in [upper, lower] {
                let style = colour.stroke_width(self.pen.scale);
                chart.draw_series(DashedLineSeries::new(edge, self.pen.px(8), self.pen.px(5), style))?;
            }
        }
        Ok(())
    }

    /// Lines between neighbouring means, error bars, markers.
    fn curve<DB: DrawingBackend>(&self, chart: &mut Chart<'_, DB>, curve: &Curve, index: usize) -> Drawn<DB> {
        let colour = colour(index);
        let line = colour.stroke_width(2 * self.pen.scale);
        for run in runs(&curve.points, |point| point.mean.map(|mean| (self.kn(point.kn), mean))) {
            chart.draw_series(LineSeries::new(run, line))?;
        }
        let cap = self.pen.px(5);
        for point in curve.points.iter().filter(|_| curve.random) {
            let Some([low, high]) = point.mean_ci else { continue };
            let x = self.kn(point.kn);
            chart.draw_series([PathElement::new([(x, low), (x, high)], line)])?;
            for end in [low, high] {
                chart.draw_series([
                    EmptyElement::at((x, end)) + PathElement::new([(-cap, 0), (cap, 0)], line)
                ])?;
            }
        }
        for point in &curve.points {
            if let Some(mean) = point.mean {
                chart.plotting_area().draw(&filled((self.kn(point.kn), mean), index, self.pen.scale))?;
            }
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let mut lines = 0..;
        let mut next = || lines.next().unwrap_or_default();
        for (index, curve) in self.curves.iter().enumerate() {
            let colour = colour(index);
            let line = next();
            let ([from, to], y) = self.pen.mark(line);
            area.draw(&PathElement::new([(from, y), (to, y)], colour.stroke_width(2 * self.pen.scale)))?;
            area.draw(&filled(((from + to) / 2, y), index, self.pen.scale))?;
            self.pen.words(area, line, &curve.label())?;
            if curve.has_band() {
                let (line, half) = (next(), self.pen.px(8));
                let (_, y) = self.pen.mark(line);
                area.draw(&Rectangle::new(
                    [(from, y - half), (to, y + half)],
                    colour.mix(BAND_ALPHA).filled(),
                ))?;
                let label = format!("{}: mean \u{b1} one standard deviation of the walls", curve.name());
                self.pen.words(area, line, &label)?;
            }
        }
        for earlier in self.earlier() {
            let line = next();
            let ([from, to], y) = self.pen.mark(line);
            for edge in hollow(((from + to) / 2, y), earlier.index, self.pen.scale) {
                area.draw(&edge)?;
            }
            self.pen.words(area, line, &earlier.label())?;
        }
        for remark in &self.remarks {
            self.pen.remark(area, next(), &format!("! {remark}"))?;
        }
        Ok(())
    }

    /// The arms of the earlier run. One that is not in this figure has a colour of its own.
    fn earlier(&self) -> Vec<EarlierArm<'c>> {
        let Some(beside) = self.beside else { return Vec::new() };
        let mut more = self.curves.len()..;
        let arms = beside.arms.iter().filter_map(|(arm, means)| {
            let place = self.curves.iter().position(|curve| curve.arm == *arm);
            let index = place.or_else(|| more.next())?;
            Some(EarlierArm { index, arm, means, run: &beside.label })
        });
        arms.collect()
    }

    /// kn in the units of the axis.
    fn kn(&self, kn: f64) -> f64 {
        kn / power_of_ten(self.exponent)
    }
}

impl Figure for Plot<'_> {
    /// The plot, a line of legend per curve, per band and per arm of the earlier run, a line per remark.
    fn size(&self) -> (u32, u32) {
        let bands = self.curves.iter().filter(|curve| curve.has_band()).count();
        let earlier = self.earlier().len();
        let lines = (self.curves.len() + bands + earlier + self.remarks.len()) as u32;
        (WIDTH * self.pen.scale, (PLOT_HEIGHT + LINE * (lines + 1)) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_vertically(self.pen.px(PLOT_HEIGHT as i32));
        self.chart(&plot)?;
        self.legend(&legend)
    }
}

/// Cuts points into runs of neighbours for which `value` is defined: no line is drawn across a gap.
fn runs<T>(points: &[Point], value: impl Fn(&Point) -> Option<T>) -> Vec<Vec<T>> {
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

fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(1.0)
}

/// An integer in superscript digits.
fn superscript(number: i32) -> String {
    number
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '\u{207b}',
            '1' => '\u{b9}',
            '2' => '\u{b2}',
            '3' => '\u{b3}',
            digit => char::from_u32(0x2070 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
        })
        .collect()
}
