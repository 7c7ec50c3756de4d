//! How the first figure of a verdict looks: the readings on the base model at its best fit, and beside it on the best cause.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::axes::WIDTH;
use crate::render::draw::Figure;
use crate::render::number::shortened;
use crate::render::pen::{Drawn, LINE, Pen, left};
use crate::verb::diagnose::answer::family::FamilyFigure;
use crate::verb::diagnose::answer::fit::{FitFigure, FitRow};
use crate::verb::diagnose::answer::painter::{Painter, ends};

/// Heights of the heads, of a row's quantity and of its strip of collapse angles (pixels at scale 1).
const HEAD: u32 = 78;
const PANEL: u32 = 280;
const STRIP: u32 = 190;
/// Longer names and titles are cut.
const LONGEST_NAME: usize = 24;
const LONGEST_TITLE: usize = 52;

/// What is drawn, at which scale.
pub struct FitPlot<'f> {
    title: &'f str,
    figure: &'f FitFigure,
    pen: Pen,
}

impl<'f> FitPlot<'f> {
    /// Prepares the figure.
    pub fn new(title: &'f str, figure: &'f FitFigure, scale: u32) -> Self {
        FitPlot { title, figure, pen: Pen { scale } }
    }

    /// What stands above the right column, in two lines; `None` where there is no cause.
    fn cause(&self) -> Option<[String; 2]> {
        let titles: Vec<&str> = self.figure.causes.iter().map(|(_, title)| *title).collect();
        let first = match self.figure.in_verdict {
            true => "with the cause",
            false => "with the cause that fits best, which does not explain them",
        };
        (!titles.is_empty()).then(|| [first.to_owned(), shortened(&titles.join("; and "), LONGEST_TITLE)])
    }

    fn row<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, row: &FitRow) -> Drawn<DB> {
        let cause = row.cause.as_ref();
        let (own, other) = area.split_horizontally(self.pen.px(WIDTH as i32 / 2));
        let end = cause.map_or(0.0, FamilyFigure::end).max(row.base.end());
        let painter = Painter { over: row.base.over, end, labels: 6, width: WIDTH / 2, pen: self.pen };
        let shared = ends(row.base.panels.iter().chain(cause.into_iter().flat_map(|own| &own.panels)));
        for (area, figure) in [(own, Some(&row.base)), (other, cause)] {
            let Some(figure) = figure else { continue };
            let mut rest = area;
            if let Some(panel) = figure.panels.first() {
                let (above, below) = rest.split_vertically(self.pen.px(PANEL as i32));
                let words = format!("{}: {}", shortened(&figure.family, LONGEST_NAME), panel.words);
                painter.panel(&above, (panel, &shortened(&words, LONGEST_TITLE)), shared)?;
                rest = below;
            }
            if let Some(collapse) = figure.collapse.as_ref().filter(|_| has_strip(row)) {
                painter.strip(&rest, collapse, &figure.angles)?;
            }
        }
        Ok(())
    }

    fn remarks(&self) -> [&'static str; 2] {
        [
            "shaded: median, half and nine in ten of the walls; they end where half of the walls have fallen",
            "black: measured, with one standard deviation of its error; an arrow points to where a bound's value lies",
        ]
    }
}

/// Whether collapse angles are drawn.
fn has_strip(row: &FitRow) -> bool {
    row.base.collapse.is_some() && !row.base.angles.is_empty()
}

fn height(row: &FitRow) -> u32 {
    let panel = if row.base.panels.is_empty() { 0 } else { PANEL };
    panel + if has_strip(row) { STRIP } else { 0 }
}

impl Figure for FitPlot<'_> {
    /// The title, the heads of both columns, a row per family, and two remarks.
    fn size(&self) -> (u32, u32) {
        let rows: u32 = self.figure.rows.iter().map(height).sum();
        (WIDTH * self.pen.scale, (HEAD + rows + 3 * LINE) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let words = |x: u32, y: i32, size: i32, text: &str| {
            let at = (self.pen.px(x as i32), self.pen.px(y));
            root.draw(&Text::new(text.to_owned(), at, self.pen.font(size).pos(left())))
        };
        words(16, 22, 22, self.title)?;
        words(16, 48, 18, "base model, joints fitted to the readings")?;
        if let Some([first, second]) = self.cause() {
            words(WIDTH / 2 + 16, 48, 18, &first)?;
            words(WIDTH / 2 + 16, 70, 18, &second)?;
        }
        let (_, mut rest) = root.split_vertically(self.pen.px(HEAD as i32));
        for row in &self.figure.rows {
            let (area, below) = rest.split_vertically(self.pen.px(height(row) as i32));
            self.row(&area, row)?;
            rest = below;
        }
        for (line, remark) in self.remarks().iter().enumerate() {
            let (_, y) = self.pen.mark(line);
            rest.draw(&Text::new(*remark, (self.pen.px(16), y), self.pen.font(17).pos(left())))?;
        }
        Ok(())
    }
}
