//! How the shares look: a row per source, the first order filled, the total hollow, each on its interval.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::render::draw::Figure;
use crate::render::marker::{colour, filled, hollow};
use crate::render::pen::{Drawn, Pen, centred, left};
use crate::verb::sensitivity::answer::SensitivitySummary;

const LEFT: i32 = 330;
const RIGHT: i32 = 30;
const HEAD: i32 = 56;
const ROW: i32 = 44;
const WIDTH: i32 = 960;
/// Room for the axis and the legend below the rows.
const FOOT: i32 = 92;
/// So far above and below the middle of its row lie a source's two marks.
const APART: i32 = 9;
/// Number of the round marker.
const ROUND: usize = 2;

/// What is drawn, at which scale.
pub struct SharesPlot<'s> {
    summary: &'s SensitivitySummary,
    /// Shares at the ends of the axis.
    range: [f64; 2],
    pen: Pen,
}

impl<'s> SharesPlot<'s> {
    /// Prepares the figure: from 0 to 1, and as far beyond as estimates lie.
    pub fn new(summary: &'s SensitivitySummary, scale: u32) -> Self {
        let values = summary.groups.iter().flat_map(|group| [group.first[0], group.total[0]]).flatten();
        let range = values
            .fold([0.0, 1.0], |[low, high], x: f64| [f64::min(low, x - 0.05), f64::max(high, x + 0.05)]);
        SharesPlot { summary, range, pen: Pen { scale } }
    }

    fn x(&self, share: f64) -> i32 {
        let [low, high] = self.range;
        let place = ((share - low) / (high - low)).clamp(0.0, 1.0);
        LEFT + (place * f64::from(WIDTH - LEFT - RIGHT)).round() as i32
    }

    fn bottom(&self) -> i32 {
        HEAD + ROW * self.summary.groups.len() as i32
    }

    fn axis<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let grey = RGBColor(215, 215, 215).stroke_width(self.pen.scale);
        for percent in (0..=100).step_by(20) {
            let x = self.x(f64::from(percent) / 100.0);
            root.draw(&PathElement::new([self.pen.at(x, HEAD), self.pen.at(x, self.bottom())], grey))?;
            let font = self.pen.font(17).pos(centred());
            root.draw(&Text::new(percent.to_string(), self.pen.at(x, self.bottom() + 16), font))?;
        }
        let middle = (LEFT + WIDTH - RIGHT) / 2;
        let words =
            format!("share of the variance of the {} (%)", self.summary.shown.name().replace('_', " "));
        root.draw(&Text::new(
            words,
            self.pen.at(middle, self.bottom() + 42),
            self.pen.font(18).pos(centred()),
        ))
    }

    fn mark<DB: DrawingBackend>(
        &self,
        root: &DrawingArea<DB, Shift>,
        [value, low, high]: [Option<f64>; 3],
        y: i32,
        is_total: bool,
    ) -> Drawn<DB> {
        let Some(value) = value else { return Ok(()) };
        if let Some((low, high)) = low.zip(high) {
            let ends = [self.pen.at(self.x(low), y), self.pen.at(self.x(high), y)];
            root.draw(&PathElement::new(ends, colour(ROUND).stroke_width(2 * self.pen.scale)))?;
        }
        let at = self.pen.at(self.x(value), y);
        if !is_total {
            return root.draw(&filled(at, ROUND, self.pen.scale));
        }
        hollow(at, ROUND, self.pen.scale).into_iter().try_for_each(|edge| root.draw(&edge))
    }
}

impl Figure for SharesPlot<'_> {
    fn size(&self) -> (u32, u32) {
        (WIDTH as u32 * self.pen.scale, (self.bottom() + FOOT) as u32 * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let title = format!("{}, {}: where the scatter comes from", self.summary.study, self.summary.arm);
        root.draw(&Text::new(title, self.pen.at(16, 16), self.pen.font(21)))?;
        self.axis(root)?;
        for (row, group) in (0..).zip(&self.summary.groups) {
            let y = HEAD + ROW * row + ROW / 2;
            let font = self.pen.font(16).pos(Pos::new(HPos::Right, VPos::Center));
            let name = if group.is_in_layout {
                format!("of the layout: {}", group.name)
            } else {
                group.name.clone()
            };
            root.draw(&Text::new(name, self.pen.at(LEFT - 14, y), font))?;
            self.mark(root, group.first, y - APART, false)?;
            self.mark(root, group.total, y + APART, true)?;
        }
        let y = self.bottom() + 72;
        for (x, words, is_total) in
            [(LEFT, "first order", false), (LEFT + 180, "total, with interactions", true)]
        {
            let at = self.pen.at(x, y);
            match is_total {
                false => root.draw(&filled(at, ROUND, self.pen.scale))?,
                true => {
                    hollow(at, ROUND, self.pen.scale).into_iter().try_for_each(|edge| root.draw(&edge))?
                }
            }
            root.draw(&Text::new(words, self.pen.at(x + 16, y), self.pen.font(16).pos(left())))?;
        }
        Ok(())
    }
}
