//! How the figure of the push over the drift looks: arm by arm the mean, the band of one more wall, and what was measured.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::axes::{BAND_ALPHA, PLOT_HEIGHT, WIDTH, decimals};
use crate::render::draw::Figure;
use crate::render::marker::{colour, filled};
use crate::render::number::{range, shortened, stiffness};
use crate::render::pen::{Drawn, LINE, Pen};
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};
use crate::verb::run::answer::force_drift::curve::{ForceCurve, ForcePoint};

/// Names longer than this are cut.
const LONGEST_NAME: usize = 24;

/// What is drawn, at which scale.
pub struct ForceDriftPlot<'c> {
    title: &'c str,
    curves: &'c [ForceCurve],
    /// What was measured: the curve it belongs to by its arm, drift (%) and force (kN).
    measured: Vec<(usize, (f64, f64))>,
    pen: Pen,
}

impl<'c> ForceDriftPlot<'c> {
    /// Prepares curves, with the readings of their arms.
    pub fn new(title: &'c str, curves: &'c [ForceCurve], measured: &[Measurement], scale: u32) -> Self {
        let read = measured.iter().filter(|m| {
            m.quantity == MeasuredQuantity::ForceAtDrift
                && matches!(m.kind, MeasuredKind::Exact | MeasuredKind::Rounded)
        });
        let placed = read.filter_map(|m| {
            let own = curves.iter().position(|curve| curve.arm == m.family)?;
            Some((own, (100.0 * m.drift?, 1e-3 * m.value)))
        });
        ForceDriftPlot { title, curves, measured: placed.collect(), pen: Pen { scale } }
    }

    fn chart<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let read = || self.measured.iter().map(|(_, at)| *at);
        let forces = points().flat_map(|p| [p.mean.value, p.high.value]).flatten().map(|x| 1e-3 * x);
        let top = range(forces.chain(read().map(|at| at.1))).map_or(1.0, |[_, top]| 1.1 * top);
        let drifts = points().map(|p| p.drift_percent).chain(read().map(|at| at.0));
        let end = range(drifts).map_or(1.0, |[_, end]| 1.03 * end);
        let mut chart =
            self.pen.frame(area, (self.title, 26), 82).build_cartesian_2d(0.0..end, 0.0..top.max(1e-9))?;
        let (x_decimals, y_decimals) = (decimals(end), decimals(top));
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .x_labels(10)
            .y_labels(8)
            .x_label_formatter(&|value| format!("{value:.x_decimals$}"))
            .y_label_formatter(&|value| format!("{value:.y_decimals$}"))
            .x_desc("drift (%)")
            .y_desc("push (kN)")
            .draw()?;
        for (index, curve) in self.curves.iter().enumerate() {
            let line = |of: fn(&ForcePoint) -> Option<f64>| -> Vec<(f64, f64)> {
                curve.points.iter().filter_map(|p| Some((p.drift_percent, 1e-3 * of(p)?))).collect()
            };
            let mut outline = line(|p| p.high.value);
            outline.extend(line(|p| p.low.value).into_iter().rev());
            if !outline.is_empty() {
                chart.draw_series([Polygon::new(outline, colour(index).mix(BAND_ALPHA).filled())])?;
            }
            let style = colour(index).stroke_width(2 * self.pen.scale);
            chart.draw_series(LineSeries::new(line(|p| p.mean.value), style))?;
        }
        for (own, at) in &self.measured {
            chart.plotting_area().draw(&filled(*at, *own, self.pen.scale))?;
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        for (index, curve) in self.curves.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            area.draw(&PathElement::new(
                [(from, y), (to, y)],
                colour(index).stroke_width(2 * self.pen.scale),
            ))?;
            let is_measured = self.measured.iter().any(|(own, _)| *own == index);
            if is_measured {
                area.draw(&filled(((from + to) / 2, y), index, self.pen.scale))?;
            }
            self.pen.words(area, index, &label(curve, is_measured))?;
        }
        Ok(())
    }
}

/// Text of the legend for a curve.
fn label(curve: &ForceCurve, is_measured: bool) -> String {
    let walls = match range(curve.points.iter().map(|p| p.walls as f64)) {
        Some([low, high]) if low != high => format!("{low} to {high} walls"),
        Some([1.0, _]) => "1 wall".to_string(),
        Some([n, _]) => format!("{n} walls"),
        None => "no wall".to_string(),
    };
    let has_band = curve.points.iter().any(|p| p.low.value.is_some());
    let band = match (curve.random, has_band) {
        (true, true) => ", band: 5 to 95 %",
        (true, false) => ", too few for a band",
        (false, _) => ", nothing random",
    };
    let marks = if is_measured { "; marks: measured" } else { "" };
    let name = shortened(&curve.arm, LONGEST_NAME);
    format!("{name}, kn = {}: {walls}{band}{marks}", stiffness(curve.kn))
}

impl Figure for ForceDriftPlot<'_> {
    /// The plot, and a line of legend per curve.
    fn size(&self) -> (u32, u32) {
        (WIDTH * self.pen.scale, (PLOT_HEIGHT + LINE * (self.curves.len() as u32 + 1)) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_vertically(self.pen.px(PLOT_HEIGHT as i32));
        self.chart(&plot)?;
        self.legend(&legend)
    }
}
