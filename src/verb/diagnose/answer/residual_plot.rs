//! How the figure of all readings looks: their residuals against tilt, position, order of the tests, collapse
//! angle, and what families differ in: how their ends are held, and how large their stones are.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::axes::{WIDTH, decimals};
use crate::render::draw::Figure;
use crate::render::marker::filled;
use crate::render::number::{range, shortened};
use crate::render::pen::{Drawn, LINE, Pen, centred};
use crate::verb::diagnose::answer::residual::ResidualEntry;

/// Heights of the title and of a panel (pixels at scale 1).
const HEAD: u32 = 46;
const PANEL: u32 = 270;
/// Width of the labels on the left (pixels at scale 1).
const LEFT: i32 = 92;
/// Specimens that share a place are spread so far (pixels at scale 1).
const SPREAD: f64 = 36.0;
/// Readings at one position are spread so far, by their tilts.
const SPREAD_BY_TILT: f64 = 0.5;
/// Names longer than this are cut.
const LONGEST_NAME: usize = 30;
/// The axis reaches at least so far either way.
const LEAST: f64 = 2.5;
/// Nineteen in twenty residuals lie within.
const USUAL: f64 = 1.96;
/// Where on a wall was read: quantity, and the word for it.
const POSITIONS: [(&str, &str); 5] = [
    ("displacement_left", "left"),
    ("displacement_centre", "centre"),
    ("displacement_right", "right"),
    ("displacement_mean", "mean"),
    ("displacement_centre_minus_ends", "difference"),
];
/// How the ends of walls are held.
const ENDS: [&str; 2] = ["free", "held"];

/// What is drawn, at which scale.
pub struct ResidualPlot<'r> {
    title: &'r str,
    readings: &'r [ResidualEntry],
    families: Vec<&'r str>,
    specimens: Vec<(&'r str, &'r str)>,
    pen: Pen,
}

/// A panel: what the readings are drawn against.
struct Against {
    words: &'static str,
    /// Labels of whole numbers, where these are places that have names.
    labels: Vec<&'static str>,
    /// Whether specimens share places, and are spread about them.
    shared: bool,
    points: Vec<Spot>,
}

/// A reading in a panel.
struct Spot {
    at: f64,
    in_sd: f64,
    /// Number of the family.
    family: usize,
    /// Place of the specimen among all, from -1/2 to 1/2.
    beside: f64,
}

impl<'r> ResidualPlot<'r> {
    /// Prepares the readings.
    pub fn new(title: &'r str, readings: &'r [ResidualEntry], scale: u32) -> Self {
        let (mut families, mut specimens): (Vec<&str>, Vec<(&str, &str)>) = (Vec::new(), Vec::new());
        for reading in readings {
            let own = (reading.family.as_str(), reading.specimen.as_str());
            if !families.contains(&own.0) {
                families.push(own.0);
            }
            if !specimens.contains(&own) {
                specimens.push(own);
            }
        }
        ResidualPlot { title, readings, families, specimens, pen: Pen { scale } }
    }

    /// The panels that some reading has a place in.
    fn panels(&self) -> Vec<Against> {
        let places: Vec<(&str, &'static str)> = POSITIONS
            .into_iter()
            .filter(|(name, _)| self.readings.iter().any(|r| r.quantity == *name))
            .collect();
        let last = self.readings.iter().filter_map(|r| r.tilt_deg).fold(0.0, f64::max);
        let position = |r: &ResidualEntry| {
            let place = places.iter().position(|(name, _)| r.quantity == *name)? as f64;
            Some(place + SPREAD_BY_TILT * (r.tilt_deg? / last - 0.5))
        };
        let fell = |r: &ResidualEntry| {
            let angle = |a: &&ResidualEntry| {
                a.quantity == "collapse_angle"
                    && !a.kind.is_censored()
                    && (&a.specimen, &a.family) == (&r.specimen, &r.family)
            };
            self.readings.iter().find(angle).map(|a| a.measured)
        };
        let against = |words, labels, place: &dyn Fn(&ResidualEntry) -> Option<f64>| {
            let spot = |r: &ResidualEntry| {
                let family = self.families.iter().position(|name| *name == r.family)?;
                let one = self.specimens.iter().position(|own| *own == (&r.family, &r.specimen))?;
                let beside = (one as f64 + 0.5) / self.specimens.len() as f64 - 0.5;
                Some(Spot { at: place(r)?, in_sd: r.in_sd?, family, beside })
            };
            Against { words, labels, shared: false, points: self.readings.iter().filter_map(spot).collect() }
        };
        let labels = places.iter().map(|(_, word)| *word).collect();
        let panels = [
            Against { shared: true, ..against("tilt of the reading (deg)", Vec::new(), &|r| r.tilt_deg) },
            Against { shared: true, ..against("drift of the reading (%)", Vec::new(), &|r| r.drift_percent) },
            against(
                "position (each from low tilts to high; difference: centre less mean of the ends)",
                labels,
                &position,
            ),
            against("place in the order of the tests", Vec::new(), &|r| r.order.map(f64::from)),
            against("measured collapse angle of the specimen (deg)", Vec::new(), &fell),
        ];
        // Where families do not differ in it there is nothing to see.
        let across = [
            Against {
                shared: true,
                ..against("ends of the walls", ENDS.to_vec(), &|r| Some(f64::from(u8::from(r.ends_held))))
            },
            Against {
                shared: true,
                ..against("weight of a stone (N), in the mean", Vec::new(), &|r| Some(r.stone_weight_n))
            },
        ];
        let across =
            across.into_iter().filter(|panel| panel.points.iter().any(|spot| spot.at != panel.points[0].at));
        panels.into_iter().filter(|panel| !panel.points.is_empty()).chain(across).collect()
    }

    fn panel<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, panel: &Against) -> Drawn<DB> {
        let residuals = self.readings.iter().filter_map(|r| r.in_sd);
        let [bottom, top] = range(residuals.chain([-LEAST, LEAST])).unwrap_or([-LEAST, LEAST]);
        let [bottom, top] = [bottom - 0.08 * (top - bottom), top + 0.08 * (top - bottom)];
        let [low, high] = match panel.labels.len() {
            0 => range(panel.points.iter().map(|spot| spot.at)).unwrap_or([0.0, 1.0]),
            n => [0.0, (n - 1) as f64],
        };
        let room = match panel.labels.is_empty() {
            true => 0.06 * (high - low).max(1.0),
            false => 0.6,
        };
        let ends = [low - room, high + room];
        let mut chart = ChartBuilder::on(area)
            .margin(self.pen.px(8))
            .margin_right(self.pen.px(28))
            .x_label_area_size(self.pen.px(62))
            .y_label_area_size(self.pen.px(LEFT))
            .build_cartesian_2d(ends[0]..ends[1], bottom..top)?;
        let (x_decimals, y_decimals) = (decimals(ends[1] - ends[0]), decimals(top - bottom));
        let whole = panel.labels.is_empty() && panel.points.iter().all(|spot| spot.at.fract() == 0.0);
        let label = |value: &f64| match panel.labels.get(value.round() as usize) {
            _ if value.fract() != 0.0 && (whole || !panel.labels.is_empty()) => String::new(),
            _ if whole => format!("{value:.0}"),
            _ if panel.labels.is_empty() => format!("{value:.x_decimals$}"),
            Some(label) if *value >= 0.0 => (*label).to_string(),
            _ => String::new(),
        };
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .x_labels(if panel.labels.is_empty() { 10 } else { panel.labels.len() + 1 })
            .y_labels(6)
            .x_label_formatter(&label)
            .y_label_formatter(&|value| format!("{value:.y_decimals$}"))
            .x_desc(panel.words)
            .y_desc("residual (sd)")
            .draw()?;
        let line = |y: f64| [(ends[0], y), (ends[1], y)];
        chart.draw_series(LineSeries::new(line(0.0), BLACK.stroke_width(self.pen.scale)))?;
        for y in [-USUAL, USUAL] {
            let style = BLACK.stroke_width(self.pen.scale);
            chart.draw_series(DashedLineSeries::new(line(y), self.pen.px(6), self.pen.px(5), style))?;
        }
        let spread = SPREAD * (ends[1] - ends[0]) / f64::from(WIDTH - LEFT as u32);
        for spot in &panel.points {
            let x = spot.at + if panel.shared { spread * spot.beside } else { 0.0 };
            chart.plotting_area().draw(&filled((x, spot.in_sd), spot.family, self.pen.scale))?;
        }
        Ok(())
    }

    /// What the dashes are, and what is not drawn.
    fn remarks(&self) -> Vec<String> {
        let mut remarks = vec![
            "measured less simulated in standard deviations of errors, scatter and joints; dashes: 19 in 20"
                .to_string(),
        ];
        let absent = self.readings.iter().filter(|r| r.in_sd.is_none()).count();
        if absent > 0 {
            remarks.push(format!(
                "{absent} readings are not drawn: bounds, or hardly any simulated wall stands"
            ));
        }
        remarks
    }
}

impl Figure for ResidualPlot<'_> {
    /// The title, the panels, a line of legend per family, and remarks.
    fn size(&self) -> (u32, u32) {
        let lines = (self.families.len() + self.remarks().len()) as u32 + 1;
        let height = HEAD + PANEL * self.panels().len().max(1) as u32 + LINE * lines;
        (WIDTH * self.pen.scale, height * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let name = format!("{}: residuals of all readings", self.title);
        root.draw(&Text::new(name, (self.pen.px(16), self.pen.px(14)), self.pen.font(24)))?;
        let (_, mut rest) = root.split_vertically(self.pen.px(HEAD as i32));
        let panels = self.panels();
        if panels.is_empty() {
            let place = (self.pen.px(WIDTH as i32 / 2), self.pen.px(PANEL as i32 / 2));
            let style = self.pen.font(20).pos(centred());
            rest.draw(&Text::new("no reading has a residual: there is nothing to draw", place, style))?;
            rest = rest.split_vertically(self.pen.px(PANEL as i32)).1;
        }
        for panel in &panels {
            let (area, below) = rest.split_vertically(self.pen.px(PANEL as i32));
            self.panel(&area, panel)?;
            rest = below;
        }
        for (index, family) in self.families.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            rest.draw(&filled(((from + to) / 2, y), index, self.pen.scale))?;
            self.pen.words(&rest, index, &shortened(family, LONGEST_NAME))?;
        }
        for (line, remark) in self.remarks().iter().enumerate() {
            self.pen.remark(&rest, self.families.len() + line, remark)?;
        }
        Ok(())
    }
}
