//! How the heat map looks: a row per mechanism, a column per observable, the number in each cell.
//!
//! Blue below 0, orange above, the ends of Okabe and Ito's palette: told apart with the common colour vision deficiencies, and
//! the number is there for a print in grey.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::render::draw::Figure;
use crate::render::pen::{Drawn, LINE, Pen, centred, left};
use crate::verb::detectability::answer::DetectabilitySummary;
use crate::verb::detectability::answer::document::heading;

const LEFT: i32 = 180;
const HEAD: i32 = 122;
const CELL: [i32; 2] = [84, 27];
const RIGHT: i32 = 20;
/// Change (errors) at which a colour is full.
const FULL: f64 = 6.0;
const BELOW: [f64; 3] = [0.0, 114.0, 178.0];
const ABOVE: [f64; 3] = [213.0, 94.0, 0.0];
/// Grey of a cell without a number.
const NAMED: RGBColor = RGBColor(226, 226, 226);
/// Lines of text below the cells.
const NOTES: i32 = 5;

/// What is drawn, at which scale.
pub struct HeatMap<'s> {
    summary: &'s DetectabilitySummary,
    pen: Pen,
}

impl<'s> HeatMap<'s> {
    /// Prepares the map.
    pub fn new(summary: &'s DetectabilitySummary, scale: u32) -> Self {
        HeatMap { summary, pen: Pen { scale } }
    }

    fn heads<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let variant = self.summary.variant.as_ref().map(|v| format!(", variant {v}")).unwrap_or_default();
        let title = format!("{}{variant}: change per mechanism in errors of the data", self.summary.study);
        root.draw(&Text::new(title, self.pen.at(16, 14), self.pen.font(22)))?;
        let middle = self.pen.font(15).pos(centred());
        let mut last: Option<&str> = None;
        for (column, observable) in self.summary.observables.iter().enumerate() {
            let x = LEFT + CELL[0] * column as i32 + CELL[0] / 2;
            if last != Some(observable.family.as_str()) {
                let family = self.pen.font(17).pos(left());
                let name = observable.family.clone();
                root.draw(&Text::new(name, self.pen.at(x - CELL[0] / 2 + 4, 60), family))?;
                last = Some(&observable.family);
            }
            for (line, text) in heading(observable).into_iter().enumerate() {
                root.draw(&Text::new(text, self.pen.at(x, 84 + 20 * line as i32), middle.clone()))?;
            }
        }
        Ok(())
    }

    fn cells<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let name = self.pen.font(16).pos(Pos::new(HPos::Right, VPos::Center));
        let middle = centred();
        for (line, row) in self.summary.mechanisms.iter().enumerate() {
            let y = HEAD + CELL[1] * line as i32;
            root.draw(&Text::new(row.mechanism, self.pen.at(LEFT - 8, y + CELL[1] / 2), name.clone()))?;
            for (column, cell) in row.cells.iter().enumerate() {
                let x = LEFT + CELL[0] * column as i32;
                let colour = cell.in_errors.map_or(NAMED, shade);
                let corners = [self.pen.at(x, y), self.pen.at(x + CELL[0] - 1, y + CELL[1] - 1)];
                root.draw(&Rectangle::new(corners, colour.filled()))?;
                let strong = cell.in_errors.is_some_and(|errors| errors.abs() > 0.7 * FULL);
                let ink = if strong { &WHITE } else { &BLACK };
                let style = self.pen.font(15).color(ink).pos(middle);
                root.draw(&Text::new(cell.shown(), self.pen.at(x + CELL[0] / 2, y + CELL[1] / 2), style))?;
            }
        }
        Ok(())
    }

    /// The colours with their numbers, and what the numbers are.
    fn legend<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let top = HEAD + CELL[1] * self.summary.mechanisms.len() as i32 + 18;
        let middle = self.pen.font(14).pos(centred());
        for step in -6..=6 {
            let x = LEFT + 36 * (step + 6);
            let corners = [self.pen.at(x, top), self.pen.at(x + 36, top + 18)];
            root.draw(&Rectangle::new(corners, shade(f64::from(step) * FULL / 6.0).filled()))?;
            if step % 2 == 0 {
                let number = format!("{:+.0}", f64::from(step) * FULL / 6.0).replace("+0", "0");
                root.draw(&Text::new(number, self.pen.at(x + 18, top + 28), middle.clone()))?;
            }
        }
        let beside = format!("errors; full colour from {FULL} on; the data can see 2 and more");
        root.draw(&Text::new(
            beside,
            self.pen.at(LEFT + 36 * 13 + 12, top + 9),
            self.pen.font(15).pos(left()),
        ))?;
        for (line, text) in self.notes().into_iter().enumerate() {
            let y = top + 52 + (LINE as i32 - 4) * line as i32;
            root.draw(&Text::new(text, self.pen.at(16, y), self.pen.font(14).pos(left())))?;
        }
        Ok(())
    }

    fn notes(&self) -> [String; NOTES as usize] {
        let (quantile, members) = (self.summary.quantile, self.summary.members);
        [
            format!("Each mechanism at the {quantile} quantile of its priors, from the weak end; mean of {members} walls per family, the same with and without it."),
            "Error: standard deviation of the measured mean, readings and scatter between specimens together.".to_string(),
            "*: the readings are only known to be below a bound; what lies beyond it counts.".to_string(),
            "~: 95 % interval of the paired change includes 0. falls: collapsed before the reading. fallen: also without it.".to_string(),
            "stands: reaches the reading only with it. n/a: cannot act on these walls. end: stood to the end. lost: not solved. -: no error is known.".to_string(),
        ]
    }
}

impl Figure for HeatMap<'_> {
    fn size(&self) -> (u32, u32) {
        let columns = (self.summary.observables.len() as i32).max(10);
        let width = LEFT + CELL[0] * columns + RIGHT;
        let rows = self.summary.mechanisms.len() as i32;
        let height = HEAD + CELL[1] * rows + 18 + 46 + (LINE as i32 - 4) * NOTES + 8;
        (width as u32 * self.pen.scale, height as u32 * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        self.heads(root)?;
        self.cells(root)?;
        self.legend(root)
    }
}

/// From white at 0 to the full colour at [`FULL`].
fn shade(errors: f64) -> RGBColor {
    let share = (errors.abs() / FULL).min(1.0);
    let end = if errors < 0.0 { BELOW } else { ABOVE };
    let [r, g, b] = end.map(|c| (255.0 + share * (c - 255.0)).round() as u8);
    RGBColor(r, g, b)
}
