//! How the figure of a calibration looks: the collapse angle against kn, the angles measured, and the kn they speak for.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::critic::End;
use crate::report::draw::Figure;
use crate::report::marker::{colour, filled};
use crate::report::measured::panel::{Panel, PanelPoint};
use crate::report::number::{range, shortened};
use crate::report::plot::{
    BAND_ALPHA, Drawn, FONT_NAME, LEGEND_MARK, LEGEND_TEXT, LINE, WIDTH, decimals, left,
};

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
    title: &'c str,
    panels: Vec<&'c Panel>,
    scale: u32,
}

impl<'c> CalibrationPlot<'c> {
    /// A panel per arm.
    pub fn new(title: &'c str, panels: Vec<&'c Panel>, scale: u32) -> Self {
        CalibrationPlot { title, panels, scale }
    }

    fn panel<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, panel: &Panel) -> Drawn<DB> {
        let [low, high] = panel.ends();
        let [bottom, top] = heights(panel);
        let mut chart = ChartBuilder::on(area)
            .caption(format!("{}: {}", self.title, shortened(&panel.arm, LONGEST_NAME)), self.font(24))
            .margin(self.px(12))
            .margin_right(self.px(28))
            .x_label_area_size(self.px(62))
            .y_label_area_size(self.px(82))
            .build_cartesian_2d((0.9 * low..1.1 * high).log_scale(), bottom..top)?;
        let y_decimals = decimals(top - bottom);
        chart
            .configure_mesh()
            .disable_x_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(215, 215, 215).stroke_width(self.scale))
            .axis_style(BLACK.stroke_width(self.scale))
            .set_all_tick_mark_size(self.px(6))
            .x_labels(20)
            .y_labels(8)
            .label_style(self.font(18))
            .axis_desc_style(self.font(19))
            .x_label_formatter(&|value| format!("{value:e}"))
            .y_label_formatter(&|value| format!("{value:.y_decimals$}"))
            .x_desc("normal stiffness of the joints kn (Pa/m)")
            .y_desc("collapse angle (deg)")
            .draw()?;
        let ours = colour(0);
        let line = |of: fn(&PanelPoint) -> f64| panel.curve.iter().map(move |point| (point.kn, of(point)));
        let lower: Vec<(f64, f64)> = line(|p| p.mean - p.sigma).collect();
        let outline = line(|p| p.mean + p.sigma).chain(lower.into_iter().rev());
        chart.draw_series([Polygon::new(outline.collect::<Vec<_>>(), ours.mix(BAND_ALPHA).filled())])?;
        for angle in &panel.angles {
            let style = colour(MEASURED).mix(BAND_ALPHA).filled();
            let (from, to) = (angle.value - angle.half, angle.value + angle.half);
            chart.draw_series([Rectangle::new([(low, from), (high, to)], style)])?;
            let (ends, style) =
                ([(low, angle.value), (high, angle.value)], colour(MEASURED).stroke_width(2 * self.scale));
            if angle.bound {
                chart.draw_series(DashedLineSeries::new(ends, self.px(8), self.px(5), style))?;
            } else {
                chart.draw_series(LineSeries::new(ends, style))?;
            }
        }
        chart.draw_series(LineSeries::new(line(|p| p.mean), ours.stroke_width(2 * self.scale)))?;
        for [kn, mean, half] in &panel.points {
            let bar = [(*kn, mean - half), (*kn, mean + half)];
            chart.draw_series([PathElement::new(bar, ours.stroke_width(2 * self.scale))])?;
            chart.plotting_area().draw(&filled((*kn, *mean), 0, self.scale))?;
        }
        let foot = bottom + FOOT * (top - bottom);
        for (interval, width) in [(panel.within_95, 2), (panel.within_68, 6)] {
            let [from, to] = panel.cut(interval);
            let style = BLACK.stroke_width(width * self.scale);
            chart.draw_series([PathElement::new([(from, foot), (to, foot)], style)])?;
        }
        // An end that is open goes on: an arrow.
        for (end, kn, tip) in [(panel.within_95[0], low, -14), (panel.within_95[1], high, 14)] {
            if !matches!(end, End::At(_)) {
                let head = Polygon::new(
                    [(0, -6), (tip, 0), (0, 6)].map(|(x, y)| (self.px(x), self.px(y))),
                    BLACK.filled(),
                );
                chart.draw_series([EmptyElement::at((kn, foot)) + head])?;
            }
        }
        if let End::At(kn) = panel.best {
            let mark = Polygon::new(
                [(0, -8), (7, 0), (0, 8), (-7, 0)].map(|(x, y)| (self.px(x), self.px(y))),
                BLACK.filled(),
            );
            chart.draw_series([EmptyElement::at((kn, foot)) + mark])?;
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let [from, to] = LEGEND_MARK.map(|x| self.px(x));
        let text = self.font(18).pos(left());
        let (ours, measured) = (colour(0), colour(MEASURED));
        for (index, words) in LEGEND.iter().enumerate() {
            let y = self.px(LINE as i32) * index as i32 + self.px(LINE as i32 / 2);
            let band = [(from, y - self.px(8)), (to, y + self.px(8))];
            let line = [(from, y), (to, y)];
            match index {
                0 => {
                    area.draw(&Rectangle::new(band, ours.mix(BAND_ALPHA).filled()))?;
                    area.draw(&PathElement::new(line, ours.stroke_width(2 * self.scale)))?;
                    area.draw(&filled(((from + to) / 2, y), 0, self.scale))?;
                }
                1 => {
                    area.draw(&Rectangle::new(band, measured.mix(BAND_ALPHA).filled()))?;
                    area.draw(&PathElement::new(line, measured.stroke_width(2 * self.scale)))?;
                }
                _ => {
                    area.draw(&PathElement::new(line, BLACK.stroke_width(2 * self.scale)))?;
                    let inner = [(from + self.px(10), y), (to - self.px(10), y)];
                    area.draw(&PathElement::new(inner, BLACK.stroke_width(6 * self.scale)))?;
                }
            }
            area.draw(&Text::new(*words, (self.px(LEGEND_TEXT), y + self.px(2)), text.clone()))?;
        }
        Ok(())
    }

    fn px(&self, length: i32) -> i32 {
        length * self.scale as i32
    }

    fn font(&self, size: i32) -> TextStyle<'static> {
        TextStyle::from((FONT_NAME, self.px(size))).color(&BLACK)
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
        (WIDTH * self.scale, height * self.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (panels, legend) =
            root.split_vertically(self.px((PANEL_HEIGHT * self.panels.len() as u32) as i32));
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
