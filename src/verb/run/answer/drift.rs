//! Drift against the wall's length over its height: arms that belong to one curve, and how the figure looks.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::ensemble::Quantity;
use crate::render::axes::{PLOT_HEIGHT, WIDTH, decimals};
use crate::render::draw::Figure;
use crate::render::marker::colour;
use crate::render::number::{range, shortened, stiffness};
use crate::render::pen::{Drawn, LINE, Pen};
use crate::verb::run::answer::summary::{ArmSummary, Summary};

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 24;

/// One curve: arms of one name at one kn, by growing length.
#[derive(Clone, Debug, PartialEq)]
pub struct DriftCurve {
    /// Name of the curve.
    pub curve: String,
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Its points.
    pub points: Vec<DriftPoint>,
}

/// One arm.
#[derive(Clone, Debug, PartialEq)]
pub struct DriftPoint {
    /// Name of the arm.
    pub arm: String,
    /// Length over height.
    pub slenderness: f64,
    /// Mean displacement at the top over the height (mm/m); `None` when no wall brings a value.
    pub drift: Option<f64>,
    /// Its 95 % interval.
    pub interval: Option<[f64; 2]>,
}

/// The curves of a study whose arms belong to some, in the order of their first arms.
pub fn drift_curves(summary: &Summary) -> Vec<DriftCurve> {
    let mut curves: Vec<DriftCurve> = Vec::new();
    for arm in summary.arms.iter().filter(|arm| arm.shown == Quantity::TopDisplacement) {
        let Some((curve, point)) = point(arm) else { continue };
        let kn = arm.kn_pa_per_m;
        match curves.iter_mut().find(|c| c.curve == curve && c.kn == kn) {
            Some(known) => known.points.push(point),
            None => curves.push(DriftCurve { curve, kn, points: vec![point] }),
        }
    }
    for curve in &mut curves {
        curve.points.sort_by(|a, b| a.slenderness.total_cmp(&b.slenderness));
    }
    curves
}

fn point(arm: &ArmSummary) -> Option<(String, DriftPoint)> {
    let number = |key: &str| arm.parameters.get(key).and_then(serde_json::Value::as_f64);
    let curve = arm.parameters.get("curve")?.as_str()?.to_string();
    let (length, height) = (number("length_m")?, number("height_m")?);
    let drift = |x: f64| 1e3 * x / height;
    let point = DriftPoint {
        arm: arm.arm.clone(),
        slenderness: length / height,
        drift: arm.mean.map(drift),
        interval: arm.mean_ci.map(|ci| ci.map(drift)),
    };
    Some((curve, point))
}

/// The curves as CSV.
pub fn drift_csv(curves: &[DriftCurve]) -> String {
    let mut text = "curve,kn_pa_per_m,arm,length_over_height,drift_mm_per_m,low,high\n".to_string();
    let shown = |x: Option<f64>| x.map_or(String::new(), |x| x.to_string());
    for curve in curves {
        for p in &curve.points {
            let [low, high] = [0, 1].map(|k| shown(p.interval.map(|ci| ci[k])));
            let (name, kn, drift) = (&curve.curve, curve.kn, shown(p.drift));
            text += &format!("{name},{kn:e},{},{},{drift},{low},{high}\n", p.arm, p.slenderness);
        }
    }
    text
}

/// What is drawn, at which scale.
pub struct DriftPlot<'c> {
    title: &'c str,
    curves: &'c [DriftCurve],
    pen: Pen,
}

impl<'c> DriftPlot<'c> {
    /// Prepares the curves.
    pub fn new(title: &'c str, curves: &'c [DriftCurve], scale: u32) -> Self {
        DriftPlot { title, curves, pen: Pen { scale } }
    }

    fn chart<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let [from, to] = range(points().map(|p| p.slenderness)).unwrap_or([0.0, 1.0]);
        let tops = points().filter_map(|p| p.interval.map(|ci| ci[1]).or(p.drift));
        let top = range(tops).map_or(1.0, |[_, top]| 1.1 * top);
        let room = 0.05 * (to - from).max(1.0);
        let mut chart = self
            .pen
            .frame(area, (self.title, 26), 92)
            .build_cartesian_2d(from - room..to + room, 0.0..top)?;
        let y_decimals = decimals(top);
        let mut mesh = chart.configure_mesh();
        self.pen
            .grid(&mut mesh)
            .x_labels(12)
            .y_labels(8)
            .x_label_formatter(&|value| format!("{value:.1}"))
            .y_label_formatter(&|value| format!("{value:.y_decimals$}"))
            .x_desc("length over height")
            .y_desc("drift: displacement of the top over height (mm/m)")
            .draw()?;
        for (index, curve) in self.curves.iter().enumerate() {
            let style = colour(index).stroke_width(2 * self.pen.scale);
            let line = curve.points.iter().filter_map(|p| p.drift.map(|drift| (p.slenderness, drift)));
            chart.draw_series(LineSeries::new(line.clone(), style))?;
            chart.draw_series(line.map(|at| Circle::new(at, self.pen.px(4), colour(index).filled())))?;
            let bars =
                curve.points.iter().filter_map(|p| p.interval.map(|[low, high]| (p.slenderness, low, high)));
            chart.draw_series(bars.map(|(x, low, high)| PathElement::new([(x, low), (x, high)], style)))?;
        }
        Ok(())
    }

    fn legend<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        for (index, curve) in self.curves.iter().enumerate() {
            let ([from, to], y) = self.pen.mark(index);
            let style = colour(index).stroke_width(2 * self.pen.scale);
            area.draw(&PathElement::new([(from, y), (to, y)], style))?;
            let name = shortened(&curve.curve, LONGEST_NAME);
            let random = curve.points.iter().any(|point| point.interval.is_some());
            let bars = if random { "; bars: 95 % interval of the mean" } else { "; nothing random" };
            let label = format!("{name}, kn = {}{bars}", stiffness(curve.kn));
            self.pen.words(area, index, &label)?;
        }
        Ok(())
    }
}

impl Figure for DriftPlot<'_> {
    /// The plot, and a line of legend per curve.
    fn size(&self) -> (u32, u32) {
        (WIDTH * self.pen.scale, (PLOT_HEIGHT + LINE * (self.curves.len() as u32 + 1)) * self.pen.scale)
    }

    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_vertically(self.pen.px(PLOT_HEIGHT as i32));
        self.chart(&plot)?;
        self.legend(&legend)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verb::tests::{fixed_arm, summary_of};

    #[test]
    fn arms_of_a_curve_are_its_points_by_growing_length() {
        let populations =
            [fixed_arm("long", &[1e-3]), fixed_arm("short", &[4e-4]), fixed_arm("lone", &[9.0])];
        let mut summary = summary_of(&populations.concat(), &[]);
        for (arm, length) in summary.arms.iter_mut().zip([6.0, 2.0]) {
            for (key, value) in [("length_m", length), ("height_m", 2.0)] {
                arm.parameters.insert(key.to_string(), serde_json::json!(value));
            }
            arm.parameters.insert("curve".to_string(), serde_json::json!("bond"));
        }
        let curves = drift_curves(&summary);
        assert_eq!((curves.len(), curves[0].curve.as_str()), (1, "bond"));
        let points: Vec<_> = curves[0].points.iter().map(|p| (p.slenderness, p.drift)).collect();
        // 0.4 mm and 1 mm on a wall of 2 m.
        assert_eq!(points, [(1.0, Some(0.2)), (3.0, Some(0.5))]);
        let text = drift_csv(&curves);
        assert!(
            text.lines().nth(1).is_some_and(|line| line.starts_with("bond,7.5e7,short,1,0.2,")),
            "{text}"
        );
    }
}
