//! How the figure of a calibration looks: the collapse angle against kn, the angles measured, and the kn they speak for.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::critic::End;
use crate::render::axes::{Axes, Axis, BAND_ALPHA, WIDTH};
use crate::render::draw::Figure;
use crate::render::marker::{colour, filled};
use crate::render::number::{range, shortened};
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::run::answer::measured::panel::{Panel, PanelPoint};

/// Height of a panel (pixels at scale 1).
const PANEL_HEIGHT: u32 = 420;
/// Where the marks of the likelihood lie, as a share of the height.
const FOOT: f64 = 0.04;
/// Names longer than this are cut.
const LONGEST_NAME: usize = 24;
/// Number of the colour of what was measured.
const MEASURED: usize = 1;

/// What is drawn, at which scale.
pub struct CalibrationPlot<'c> {
    title: String,
    panels: Vec<&'c Panel>,
    pen: Pen,
}

impl<'c> CalibrationPlot<'c> {
    /// A panel per arm.
    pub fn new(title: String, panels: Vec<&'c Panel>, scale: u32) -> Self {
        CalibrationPlot { title, panels, pen: Pen { scale } }
    }

    fn panel<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, panel: &Panel) -> Drawn<DB> {
        let [low, high] = panel.ends();
        let [bottom, top] = heights(panel);
        let caption = format!("{}: {}", self.title, shortened(&panel.arm, LONGEST_NAME));
        let kn = Axis::by_powers("normal stiffness of the joints kn (Pa/m)", [0.9 * low, 1.1 * high], 20);
        let axes = Axes { x: kn, y: Axis::new("collapse angle (deg)", [bottom, top], 8) };
        let mut chart = axes.on(area, self.pen, (&caption, 24), 82)?;
        let ours = colour(0);
        let line = |of: fn(&PanelPoint) -> f64| panel.curve.iter().map(move |point| (point.kn, of(point)));
        let lower: Vec<(f64, f64)> = line(|p| p.mean - p.sigma).collect();
        let outline = line(|p| p.mean + p.sigma).chain(lower.into_iter().rev());
        chart.draw_series([Polygon::new(outline.collect::<Vec<_>>(), ours.mix(BAND_ALPHA).filled())])?;
        for angle in &panel.angles {
            let style = colour(MEASURED).mix(BAND_ALPHA).filled();
            let (from, to) = (angle.value - angle.half, angle.value + angle.half);
            chart.draw_series([Rectangle::new([(low, from), (high, to)], style)])?;
            let (ends, style) = (
                [(low, angle.value), (high, angle.value)],
                colour(MEASURED).stroke_width(2 * self.pen.scale),
            );
            if angle.bound {
                chart.draw_series(DashedLineSeries::new(ends, self.pen.px(8), self.pen.px(5), style))?;
            } else {
                chart.draw_series(LineSeries::new(ends, style))?;
            }
        }
        chart.draw_series(LineSeries::new(line(|p| p.mean), ours.stroke_width(2 * self.pen.scale)))?;
        for [kn, mean, half] in &panel.points {
            let bar = [(*kn, mean - half), (*kn, mean + half)];
            chart.draw_series([PathElement::new(bar, ours.stroke_width(2 * self.pen.scale))])?;
            chart.plotting_area().draw(&filled((*kn, *mean), 0, self.pen.scale))?;
        }
        let foot = bottom + FOOT * (top - bottom);
        for (interval, width) in [(panel.within_95, 2), (panel.within_68, 6)] {
            let [from, to] = panel.cut(interval);
            let style = BLACK.stroke_width(width * self.pen.scale);
            chart.draw_series([PathElement::new([(from, foot), (to, foot)], style)])?;
        }
        // An end that is open goes on: an arrow.
        for (end, kn, tip) in [(panel.within_95[0], low, -14), (panel.within_95[1], high, 14)] {
            if !matches!(end, End::At(_)) {
                let head =
                    Polygon::new([(0, -6), (tip, 0), (0, 6)].map(|(x, y)| self.pen.at(x, y)), BLACK.filled());
                chart.draw_series([EmptyElement::at((kn, foot)) + head])?;
            }
        }
        if let End::At(kn) = panel.best {
            let mark = Polygon::new(
                [(0, -8), (7, 0), (0, 8), (-7, 0)].map(|(x, y)| self.pen.at(x, y)),
                BLACK.filled(),
            );
            chart.draw_series([EmptyElement::at((kn, foot)) + mark])?;
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let (ours, measured) = (colour(0), colour(MEASURED));
        for (index, words) in LEGEND.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            let band = [(from, y - self.pen.px(8)), (to, y + self.pen.px(8))];
            let line = [(from, y), (to, y)];
            match index {
                0 => {
                    area.draw(&Rectangle::new(band, ours.mix(BAND_ALPHA).filled()))?;
                    area.draw(&PathElement::new(line, ours.stroke_width(2 * self.pen.scale)))?;
                    area.draw(&filled(((from + to) / 2, y), 0, self.pen.scale))?;
                }
                1 => {
                    area.draw(&Rectangle::new(band, measured.mix(BAND_ALPHA).filled()))?;
                    area.draw(&PathElement::new(line, measured.stroke_width(2 * self.pen.scale)))?;
                }
                _ => {
                    area.draw(&PathElement::new(line, BLACK.stroke_width(2 * self.pen.scale)))?;
                    let inner = [(from + self.pen.px(10), y), (to - self.pen.px(10), y)];
                    area.draw(&PathElement::new(inner, BLACK.stroke_width(6 * self.pen.scale)))?;
                }
            }
            self.pen.words(area, index, words)?;
        }
        Ok(())
    }
}

const LEGEND: [&str; 3] = [
    "our walls: mean and 95 % interval, band: \u{b1} one standard deviation",
    "measured, band: half the resolution and the error (dashed: only a bound)",
    "kn by profile likelihood: 95 % (thin; arrow: goes on) and 68 % (thick) interval, best",
];

impl Figure for CalibrationPlot<'_> {
    /// The panels, and three lines of legend.
    fn size(&self) -> (u32, u32) {
        let height = PANEL_HEIGHT * self.panels.len() as u32 + LINE * (LEGEND.len() as u32 + 1);
        (WIDTH * self.pen.scale, height * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (panels, legend) =
            root.split_vertically(self.pen.px((PANEL_HEIGHT * self.panels.len() as u32) as i32));
        for (area, panel) in panels.split_evenly((self.panels.len(), 1)).iter().zip(&self.panels) {
            self.panel(area, panel)?;
        }
        self.legend(&legend)
    }
}

/// Ends of the vertical axis: all that is drawn, with some room, and more at the foot for the likelihood's marks.
fn heights(panel: &Panel) -> [f64; 2] {
    let curve = panel.curve.iter().flat_map(|point| [point.mean - point.sigma, point.mean + point.sigma]);
    let angles = panel.angles.iter().flat_map(|angle| [angle.value - angle.half, angle.value + angle.half]);
    let [low, high] = range(curve.chain(angles)).unwrap_or([0.0, 1.0]);
    let height = (high - low).max(0.1);
    [low - 0.15 * height, high + 0.08 * height]
}
