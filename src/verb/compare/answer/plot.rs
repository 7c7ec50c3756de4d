//! How a comparison looks: how far each arm is behind the best one, with its interval, beside the zone of indifference.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::render::axes::{Axes, Axis, BAND_ALPHA, WIDTH};
use crate::render::draw::Figure;
use crate::render::marker::{colour, filled};
use crate::render::number::{range, shortened, significant};
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::compare::answer::{ArmShown, SelectionSummary, title};

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 22;
/// Room for names, and the height of a row (pixels at scale 1).
const LEFT: i32 = 250;
const ROW: u32 = 44;
/// Title, axis and its words.
const AROUND: u32 = 130;

/// What is drawn, at which scale.
pub struct Forest<'s> {
    summary: &'s SelectionSummary,
    title: String,
    rows: Vec<Row>,
    pen: Pen,
}

/// An arm: how far it is behind the best one.
struct Row {
    name: String,
    /// Number of its colour and its marker.
    place: usize,
    value: Option<f64>,
    interval: Option<[f64; 2]>,
    is_open: bool,
}

impl<'s> Forest<'s> {
    /// Prepares the figure.
    pub fn new(summary: &'s SelectionSummary, scale: u32) -> Self {
        let shown = |x: f64| summary.shown_difference(x);
        let row = |arm: &crate::verb::compare::answer::SelectedArm| {
            let rival = summary.of_best().find(|own| own.over == arm.name);
            let interval = rival.map(|own| own.interval_whatever_failed.or(own.interval));
            Row {
                name: format!("{} ({})", shortened(&arm.name, LONGEST_NAME), arm.walls),
                place: arm.place,
                value: rival.map_or(Some(0.0), |own| own.better_by).map(shown),
                interval: interval.flatten().map(|ends| ends.map(shown)),
                is_open: rival.is_some_and(|own| own.shown == ArmShown::Open),
            }
        };
        let title = format!("{}: behind {}", title(summary), shortened(&summary.best, LONGEST_NAME));
        Forest { summary, title, rows: summary.arms.iter().map(row).collect(), pen: Pen { scale } }
    }

    fn chart<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let zone = self.summary.shown_difference(self.summary.same_within);
        let values =
            self.rows.iter().flat_map(|row| row.value.into_iter().chain(row.interval.into_iter().flatten()));
        let [low, high] = range(values.chain([-zone, zone])).unwrap_or([-1.0, 1.0]);
        let room = 0.06 * (high - low);
        let (x, count) = ([low - room, high + room], self.rows.len() as f64);
        let unit = match self.summary.shown_unit() {
            "" => "probability of failure",
            unit => unit,
        };
        let behind = Axis::new(format!("behind the best arm ({unit})"), x, 8);
        let mut chart = Axes { x: behind, y: Axis::new("", [count, 0.0], 0) }.on(
            area,
            self.pen,
            (&self.title, 26),
            LEFT,
        )?;
        let band = RGBColor(120, 120, 120).mix(BAND_ALPHA).filled();
        chart.draw_series([Rectangle::new([(-zone, 0.0), (zone, count)], band)])?;
        let line = BLACK.stroke_width(self.pen.scale);
        chart.draw_series([PathElement::new([(0.0, 0.0), (0.0, count)], line)])?;
        for (index, row) in self.rows.iter().enumerate() {
            let y = index as f64 + 0.5;
            let own = colour(row.place).stroke_width(2 * self.pen.scale);
            if let Some([low, high]) = row.interval {
                match row.is_open {
                    true => drop(chart.draw_series(DashedLineSeries::new(
                        [(low, y), (high, y)],
                        self.pen.px(8),
                        self.pen.px(5),
                        own,
                    ))?),
                    false => drop(chart.draw_series([PathElement::new([(low, y), (high, y)], own)])?),
                }
            }
            if let Some(value) = row.value {
                chart.plotting_area().draw(&filled((value, y), row.place, self.pen.scale))?;
            }
            let (_, pixel) = chart.backend_coord(&(x[0], y));
            let style = self.pen.font(17).pos(Pos::new(HPos::Right, VPos::Center));
            area.draw(&Text::new(row.name.clone(), (self.pen.px(LEFT), pixel), style))?;
        }
        Ok(())
    }

    fn legend(&self) -> [String; 2] {
        let zone = significant(self.summary.shown_difference(self.summary.same_within), 2);
        [
            format!(
                "bars: hold together with a confidence of {}; dashed: not settled; in brackets: walls",
                self.summary.confidence
            ),
            format!("grey: differences below {zone} {} do not matter", self.summary.shown_unit()),
        ]
    }
}

impl Figure for Forest<'_> {
    fn size(&self) -> (u32, u32) {
        let height = AROUND + ROW * self.rows.len() as u32 + LINE * 3;
        (WIDTH * self.pen.scale, height * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let height = AROUND + ROW * self.rows.len() as u32;
        let (chart, legend) = root.split_vertically(self.pen.px(height as i32));
        self.chart(&chart)?;
        for (line, words) in self.legend().iter().enumerate() {
            self.pen.remark(&legend, line, words)?;
        }
        Ok(())
    }
}
