//! How masonry looks as a plate: sections of its surface, and its scatter against the size of the cells.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::homogenise::{Direction, Method};
use crate::render::axes::{Axes, Axis, WIDTH};
use crate::render::document::Captioned;
use crate::render::draw::Figure;
use crate::render::marker::colour;
use crate::render::number::{range, shortened};
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::homogenise::answer::document::{ALIKE, MODULI, STRESSES};
use crate::verb::homogenise::answer::entry::{HomogenisedSummary, PlateArm, PlateValue};

/// Height of a row of panels (pixels at scale 1).
const PANEL: u32 = 360;
/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 32;
/// The sections: what is drawn to the right and upwards.
const SECTIONS: [[usize; 2]; 4] = [[0, 2], [3, 4], [3, 5], [4, 5]];
const NAMES: [&str; 6] = ["N11 / p", "N22 / p", "N12 / p", "M11 / (p t)", "M22 / (p t)", "M12 / (p t)"];

/// Which of the two figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum What {
    /// Sections of the surface.
    Surface,
    /// COV against the size of the cells.
    Scatter,
}

/// What is drawn, at which scale.
pub(crate) struct CellPlot<'s> {
    pub summary: &'s HomogenisedSummary,
    pub what: What,
    pub pen: Pen,
}

/// A line of a panel: its arm, the method, and its points.
struct Line {
    arm: usize,
    method: Method,
    points: Vec<(f64, f64)>,
}

/// A panel.
struct Panel {
    title: String,
    x: String,
    y: String,
    lines: Vec<Line>,
    /// Whether the axes hold the origin and are of one scale of their own (a section), or begin at 0 (a scatter).
    is_section: bool,
}

impl<'s> CellPlot<'s> {
    /// The figures that show anything.
    pub fn all(summary: &'s HomogenisedSummary) -> Vec<Captioned<'s>> {
        let of = |(what, file, title, caption)| {
            let at = move |scale| CellPlot { summary, what, pen: Pen { scale } };
            (!at(1).panels().is_empty()).then(|| Captioned::new(file, title, caption, at))
        };
        let surface = "Sections of the surface of strength: the stresses that the plate bears at most, over p and the thickness t.";
        let scatter =
            "The coefficient of variation between cells of a size, over the number of stones along a side.";
        let both = [
            (What::Surface, "surface", "Sections of the surface of strength", surface),
            (What::Scatter, "scatter", "Scatter over the size of the cells", scatter),
        ];
        both.into_iter().filter_map(of).collect()
    }

    fn panels(&self) -> Vec<Panel> {
        let all = match self.what {
            What::Surface => SECTIONS.iter().map(|axes| self.section(*axes)).collect::<Vec<_>>(),
            What::Scatter => self.scatter(),
        };
        all.into_iter().filter(|panel| panel.lines.iter().any(|line| line.points.len() > 1)).collect()
    }

    /// A section of the surface: the points whose directions have these two stresses alone, in the order of their angle.
    fn section(&self, [right, up]: [usize; 2]) -> Panel {
        let inside = |direction: &Direction| (0..6).all(|k| k == right || k == up || direction[k] == 0.0);
        let mut lines = Vec::new();
        for (arm, own) in self.summary.arms.iter().enumerate() {
            for method in Method::ALL {
                let found = own.surface.iter().filter(|at| at.method == method && inside(&at.direction));
                let mut points: Vec<(f64, f64)> = found
                    .filter_map(|at| {
                        let value = at.value.mean?;
                        Some((value * at.direction[right], value * at.direction[up]))
                    })
                    .collect();
                points.sort_by(|a, b| angle(*a).total_cmp(&angle(*b)));
                if points.len() == 8 {
                    points.push(points[0]);
                }
                lines.push(Line { arm, method, points });
            }
        }
        let title = format!("{} and {}", &NAMES[right][..3], &NAMES[up][..3]);
        Panel { title, x: NAMES[right].to_owned(), y: NAMES[up].to_owned(), lines, is_section: true }
    }

    fn scatter(&self) -> Vec<Panel> {
        let of_modulus = |name: &'static str| {
            let value = move |arm: &PlateArm, method: Method| match method {
                Method::Associative => arm.moduli.get(name).cloned(),
                _ => None,
            };
            self.against_size(name, value)
        };
        let of_stress = |(name, direction): &(&'static str, Direction)| {
            let value = |arm: &PlateArm, method: Method| {
                let own = arm.surface.iter().find(|at| at.method == method && at.direction == *direction);
                own.map(|own| own.value.clone())
            };
            self.against_size(name, value)
        };
        MODULI.iter().map(|name| of_modulus(name)).chain(STRESSES.iter().map(of_stress)).collect()
    }

    fn against_size(&self, name: &str, value: impl Fn(&PlateArm, Method) -> Option<PlateValue>) -> Panel {
        let mut lines = Vec::new();
        for (arm, own) in self.summary.arms.iter().enumerate() {
            for method in Method::ALL {
                let Some(by_size) = value(own, method).and_then(|value| value.by_size) else { continue };
                let stones = by_size.stones.iter().map(|[x, z]| (f64::from(*x) * f64::from(*z)).sqrt());
                let points = stones.zip(&by_size.cov).filter_map(|(n, cov)| {
                    let cov = (*cov)?;
                    Some((n, if cov > ALIKE { 100.0 * cov } else { 0.0 }))
                });
                lines.push(Line { arm, method, points: points.collect() });
            }
        }
        let (x, y) = ("stones along a side".to_owned(), "COV (%)".to_owned());
        Panel { title: name.to_owned(), x, y, lines, is_section: false }
    }

    fn panel<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>, panel: &Panel) -> Drawn<DB> {
        let points = || panel.lines.iter().flat_map(|line| &line.points);
        let [x, y] = [range(points().map(|p| p.0)), range(points().map(|p| p.1))]
            .map(|found| found.unwrap_or([0.0, 1.0]))
            .map(|[low, high]| {
                let low = low.min(0.0);
                let room = 0.08 * (high - low).max(1e-9);
                [if panel.is_section { low - room } else { low }, high.max(0.0) + room]
            });
        let axes = Axes { x: Axis::new(&panel.x, x, 5), y: Axis::new(&panel.y, y, 5) };
        let mut chart = axes.on(area, self.pen, (&panel.title, 20), 70)?;
        for line in &panel.lines {
            let style = colour(line.arm).stroke_width(2 * self.pen.scale);
            let points = line.points.iter().copied();
            if let Some(dashes) = dashes(line.method) {
                let [dash, gap] = dashes.map(|length| self.pen.px(length));
                chart.draw_series(DashedLineSeries::new(points, dash as u32, gap as u32, style))?;
            } else {
                chart.draw_series(LineSeries::new(points, style))?;
            }
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        for (index, arm) in self.summary.arms.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            let style = colour(index).stroke_width(2 * self.pen.scale);
            area.draw(&PathElement::new([(from, y), (to, y)], style))?;
            self.pen.words(area, index, &shortened(&arm.arm, LONGEST_NAME))?;
        }
        let said = match self.what {
            What::Surface => {
                "means beside N22 = -p; solid: associative, dashed: non-associative, dotted: elastic"
            }
            What::Scatter => {
                "between cells of a size; solid: moduli, associative; dashed: non-associative, dotted: elastic"
            }
        };
        self.pen.words(area, self.summary.arms.len(), said)
    }
}

/// Length of the dashes of a method's lines, and of the gaps between (pixels at scale 1); `None` for a whole line.
fn dashes(method: Method) -> Option<[i32; 2]> {
    match method {
        Method::Associative => None,
        Method::NonAssociative => Some([8, 5]),
        Method::Elastic => Some([2, 4]),
    }
}

/// Angle of a point about the origin.
fn angle((x, y): (f64, f64)) -> f64 {
    crate::math::atan2(y, x)
}

impl Figure for CellPlot<'_> {
    /// Two panels to a row, a line of legend per arm, and one that explains.
    fn size(&self) -> (u32, u32) {
        let rows = self.panels().len().div_ceil(2) as u32;
        let lines = self.summary.arms.len() as u32 + 2;
        (WIDTH * self.pen.scale, (PANEL * rows + LINE * lines) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let panels = self.panels();
        let rows = panels.len().div_ceil(2);
        let (plots, legend) = root.split_vertically(self.pen.px(PANEL as i32 * rows as i32));
        for (area, panel) in plots.split_evenly((rows, 2)).iter().zip(&panels) {
            self.panel(area, panel)?;
        }
        self.legend(&legend)
    }
}
