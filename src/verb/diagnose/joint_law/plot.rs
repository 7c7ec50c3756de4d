//! How the figure of a law looks: closure over stress with its band, what was seen, and the bracket beyond.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::axes::{Axes, Axis};
use crate::render::draw::Figure;
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::diagnose::joint_law::LawSummary;

const SIZE: [u32; 2] = [900, 560];
const LINES: usize = 3;
const BLUE: RGBColor = RGBColor(0, 114, 178);
const ORANGE: RGBColor = RGBColor(213, 94, 0);

/// What is drawn, at which scale.
pub struct LawPlot<'s> {
    summary: &'s LawSummary,
    pen: Pen,
}

impl<'s> LawPlot<'s> {
    /// Prepares the figure.
    pub fn new(summary: &'s LawSummary, scale: u32) -> Self {
        LawPlot { summary, pen: Pen { scale } }
    }

    fn chart<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let summary = self.summary;
        let seen = summary.seen_pa[1];
        // Closures in mm over stresses in kPa, from the first knot that is pressed to where the bracket ends.
        let inside = |stress: f64| stress >= summary.seen_pa[0] && stress <= summary.beyond_pa;
        let knots: Vec<(f64, f64, [f64; 2])> = summary
            .knots
            .iter()
            .filter(|knot| inside(knot.stress_pa))
            .map(|knot| {
                let closure = knot.closure_m;
                (knot.stress_pa / 1e3, 1e3 * closure.median, closure.interval.map(|x| 1e3 * x))
            })
            .collect();
        let ends = summary.beyond_closure_m.map(|closure| 1e3 * closure);
        let most = knots.iter().map(|(_, _, band)| band[1]).chain(ends).fold(0.0, f64::max);
        let right = summary.beyond_pa / 1e3;
        let title = format!("{}: law of the joints, learnt", summary.study);
        let x = Axis::new("stress (kPa)", [0.0, 1.02 * right], 10);
        let y = Axis::new("closure since the first knot (mm)", [0.0, 1.08 * most], 10);
        let mut chart = Axes { x, y }.on(area, self.pen, (&title, 24), 82)?;
        let upper = knots.iter().map(|(x, _, band)| (*x, band[1]));
        let lower = knots.iter().rev().map(|(x, _, band)| (*x, band[0]));
        chart.draw_series([Polygon::new(upper.chain(lower).collect::<Vec<_>>(), BLUE.mix(0.2).filled())])?;
        let line = knots.iter().map(|(x, y, _)| (*x, *y));
        chart.draw_series(LineSeries::new(line, BLUE.stroke_width(2 * self.pen.scale)))?;
        let edge = [(seen / 1e3, 0.0), (seen / 1e3, 1.08 * most)];
        let dashed = BLACK.stroke_width(self.pen.scale);
        chart.draw_series(DashedLineSeries::new(edge, self.pen.px(6), self.pen.px(5), dashed))?;
        let bracket =
            PathElement::new([(right, ends[0]), (right, ends[1])], ORANGE.stroke_width(4 * self.pen.scale));
        chart.draw_series([bracket])?;
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        for (line, (colour, words)) in [
            (BLUE, "the law, with its 90 % interval"),
            (BLACK, "largest stress that presses on these walls (dashed)"),
            (ORANGE, "beyond: from a stiffness that stays to one that goes on changing"),
        ]
        .into_iter()
        .enumerate()
        {
            let ([from, to], y) = self.pen.mark(line);
            area.draw(&PathElement::new([(from, y), (to, y)], colour.stroke_width(2 * self.pen.scale)))?;
            self.pen.words(area, line, words)?;
        }
        Ok(())
    }
}

impl Figure for LawPlot<'_> {
    fn size(&self) -> (u32, u32) {
        (SIZE[0] * self.pen.scale, (SIZE[1] + LINE * LINES as u32) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (chart, legend) = root.split_vertically((SIZE[1] * self.pen.scale) as i32);
        self.chart(&chart)?;
        self.legend(&legend)
    }
}
