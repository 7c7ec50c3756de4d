//! How fragility under records looks: shares at each intensity, the lognormal curve, and the band of the isotonic one.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::axes::{BAND_ALPHA, PLOT_HEIGHT, WIDTH, decimals};
use crate::render::draw::Figure;
use crate::render::marker::colour;
use crate::render::number::{or_dash, range, shortened, stiffness};
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::run::answer::shaken::entry::{ShakenCurve, ShakenSummary};

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 24;
/// Points of a curve.
const POINTS: usize = 200;

/// What is drawn, at which scale.
pub(crate) struct ShakenPlot<'s> {
    title: &'s str,
    summary: &'s ShakenSummary,
    pen: Pen,
}

impl<'s> ShakenPlot<'s> {
    /// Prepares the curves.
    pub fn new(title: &'s str, summary: &'s ShakenSummary, scale: u32) -> Self {
        ShakenPlot { title, summary, pen: Pen { scale } }
    }

    fn chart<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let [_, high] = range(self.summary.intensities.iter().copied()).unwrap_or([0.0, 1.0]);
        let (end, shown) = (1.08 * high, self.summary.shown);
        let mut chart = self.pen.frame(area, (self.title, 26), 82).build_cartesian_2d(0.0..end, 0.0..1.02)?;
        let x_decimals = decimals(end);
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .x_labels(10)
            .y_labels(6)
            .x_label_formatter(&|value| format!("{value:.x_decimals$}"))
            .y_label_formatter(&|value| format!("{value:.1}"))
            .x_desc(format!("{} ({})", shown.name(), shown.unit()))
            .y_desc("probability of collapse")
            .draw()?;
        for (index, curve) in self.summary.curves.iter().enumerate() {
            let colour = colour(index);
            let bands = curve.stripes.iter().filter_map(|stripe| {
                stripe.step.probability.interval.map(|ends| (stripe.step.intensity, ends))
            });
            let bands: Vec<(f64, [f64; 2])> = bands.collect();
            let upper = bands.iter().map(|(x, [_, high])| (*x, *high));
            let lower = bands.iter().rev().map(|(x, [low, _])| (*x, *low));
            let outline: Vec<(f64, f64)> = upper.chain(lower).collect();
            if outline.len() > 2 {
                chart.draw_series([Polygon::new(outline, colour.mix(BAND_ALPHA).filled())])?;
            }
            if let Some(lognormal) = curve.lognormal.fit.curve {
                let at = |k: usize| {
                    let x = end * k as f64 / POINTS as f64;
                    (x, lognormal.probability(x))
                };
                chart.draw_series(LineSeries::new(
                    (1..=POINTS).map(at),
                    colour.stroke_width(2 * self.pen.scale),
                ))?;
            }
            let seen = curve.stripes.iter().map(|stripe| (stripe.step.intensity, stripe.step.share));
            chart.draw_series(seen.map(|at| Circle::new(at, self.pen.px(5), colour.filled())))?;
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        for (index, curve) in self.summary.curves.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            let style = colour(index).stroke_width(2 * self.pen.scale);
            area.draw(&PathElement::new([(from, y), (to, y)], style))?;
            self.pen.words(area, index, &self.label(curve))?;
        }
        let last = self.summary.curves.len();
        let said = "points: share of runs; line: lognormal; band: 95 % about the isotonic curve, over records and walls";
        self.pen.words(area, last, said)
    }

    fn label(&self, curve: &ShakenCurve) -> String {
        let unit = self.summary.shown.unit();
        let (theta, beta) = (or_dash(curve.lognormal.theta.value, 3), or_dash(curve.lognormal.beta.value, 2));
        format!(
            "{}, kn = {}: theta {theta} {unit}, beta {beta}",
            shortened(&curve.arm, LONGEST_NAME),
            stiffness(curve.kn_pa_per_m)
        )
    }
}

impl Figure for ShakenPlot<'_> {
    /// The plot, a line of legend per curve, and one that explains.
    fn size(&self) -> (u32, u32) {
        let lines = self.summary.curves.len() as u32 + 2;
        (WIDTH * self.pen.scale, (PLOT_HEIGHT + LINE * lines) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_vertically(self.pen.px(PLOT_HEIGHT as i32));
        self.chart(&plot)?;
        self.legend(&legend)
    }
}
