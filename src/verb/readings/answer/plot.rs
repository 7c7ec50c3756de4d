//! How the readings look: a row per reading, a column per statement, the verdict in each cell.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::render::draw::Figure;
use crate::render::pen::{Drawn, LINE, Pen, centred, left};
use crate::verb::readings::answer::entry::{ReadingEntry, ReadingsSummary};
use crate::verb::run::answer::published::Verdict;

/// So many readings are drawn at most.
const MOST: usize = 20;
const LEFT: i32 = 420;
const HEAD: i32 = 84;
const CELL: [i32; 2] = [96, 27];
const RIGHT: i32 = 320;
/// Blue, orange and grey: told apart with the common colour vision deficiencies, and in print by the words.
const REPRODUCED: RGBColor = RGBColor(0, 114, 178);
const REFUTED: RGBColor = RGBColor(235, 170, 120);
const OPEN: RGBColor = RGBColor(226, 226, 226);

/// What is drawn, at which scale.
pub struct Grid<'s> {
    summary: &'s ReadingsSummary,
    rows: Vec<&'s ReadingEntry>,
    pen: Pen,
}

impl<'s> Grid<'s> {
    /// Prepares the figure: the best readings, and the main one.
    pub fn new(summary: &'s ReadingsSummary, scale: u32) -> Self {
        let mut rows: Vec<&ReadingEntry> = summary.in_full().take(MOST).collect();
        let main = summary.in_full().find(|one| one.variants.is_empty());
        if let Some(main) = main.filter(|_| !rows.iter().any(|one| one.variants.is_empty())) {
            rows.push(main);
        }
        Grid { summary, rows, pen: Pen { scale } }
    }

    fn heads<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let title = format!("{}: which reading explains what was published", self.summary.study);
        root.draw(&Text::new(title, self.pen.at(16, 14), self.pen.font(22)))?;
        for column in 0..self.summary.statements.len() as i32 {
            let style = self.pen.font(17).pos(centred());
            let x = LEFT + CELL[0] * column + CELL[0] / 2;
            root.draw(&Text::new((column + 1).to_string(), self.pen.at(x, HEAD - 16), style))?;
        }
        Ok(())
    }

    fn cells<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let name = self.pen.font(15).pos(Pos::new(HPos::Right, VPos::Center));
        for (line, row) in self.rows.iter().enumerate() {
            let y = HEAD + CELL[1] * line as i32;
            root.draw(&Text::new(row.name(), self.pen.at(LEFT - 8, y + CELL[1] / 2), name.clone()))?;
            for (column, statement) in row.statements.iter().enumerate() {
                let x = LEFT + CELL[0] * column as i32;
                let (colour, ink, word) = match statement.verdict {
                    Verdict::Reproduced => (REPRODUCED, &WHITE, "yes"),
                    Verdict::NotReproduced => (REFUTED, &BLACK, "no"),
                    Verdict::CannotJudge => (OPEN, &BLACK, "open"),
                };
                let corners = [self.pen.at(x, y), self.pen.at(x + CELL[0] - 1, y + CELL[1] - 1)];
                root.draw(&Rectangle::new(corners, colour.filled()))?;
                let style = self.pen.font(15).color(ink).pos(centred());
                root.draw(&Text::new(word, self.pen.at(x + CELL[0] / 2, y + CELL[1] / 2), style))?;
            }
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let top = HEAD + CELL[1] * self.rows.len() as i32 + 24;
        for (line, statement) in self.summary.statements.iter().enumerate() {
            let text = format!("{}  {statement}", line + 1);
            let at = self.pen.at(16, top + (LINE as i32 - 4) * line as i32);
            root.draw(&Text::new(text, at, self.pen.font(15).pos(left())))?;
        }
        Ok(())
    }
}

impl Figure for Grid<'_> {
    fn size(&self) -> (u32, u32) {
        let statements = self.summary.statements.len() as i32;
        let width = (LEFT + CELL[0] * statements + 20).max(LEFT + RIGHT);
        let height = HEAD + CELL[1] * self.rows.len() as i32 + 24 + (LINE as i32 - 4) * statements + 8;
        (width as u32 * self.pen.scale, height as u32 * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        self.heads(root)?;
        self.cells(root)?;
        self.legend(root)
    }
}
