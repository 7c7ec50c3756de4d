//! How the figure of a family looks: what was measured on the bands of the base model, over the tilt or the drift.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::axes::{BAND_ALPHA, WIDTH};
use crate::render::draw::Figure;
use crate::render::marker::colour;
use crate::render::number::shortened;
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::diagnose::answer::family::FamilyFigure;
use crate::verb::diagnose::answer::painter::{Painter, ends};
use crate::verb::diagnose::answer::signs::{dashes, reading};

/// Heights of the title, of a panel and of the strip of collapse angles (pixels at scale 1).
const HEAD: u32 = 46;
const PANEL: u32 = 330;
const STRIP: u32 = 240;
/// Names longer than this are cut.
const LONGEST_NAME: usize = 30;
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
        let (over, end) = (self.figure.over, self.figure.end());
        let painter = Painter { over, end, labels: 10, width: WIDTH, pen: self.pen };
        for panel in &self.figure.panels {
            let (area, below) = rest.split_vertically(self.pen.px(PANEL as i32));
            painter.panel(&area, (panel, panel.words), ends([panel]))?;
            rest = below;
        }
        if let Some(collapse) = &self.figure.collapse {
            let (strip, legend) = rest.split_vertically(self.pen.px(STRIP as i32));
            painter.strip(&strip, collapse, &self.figure.angles)?;
            rest = legend;
        }
        self.legend(&rest)
    }
}
