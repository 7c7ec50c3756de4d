//! What Figure 10 shows, in the units of its axes, before anything is drawn.

use crate::report::number::range;
use crate::report::summary::{ArmSummary, Summary};

/// One arm in the figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name of the arm.
    pub arm: String,
    /// True for an arm of random walls, drawn with band and error bars.
    pub random: bool,
    /// Its points, kn ascending.
    pub points: Vec<Point>,
}

/// One arm at one kn.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Walls planned.
    pub members: u64,
    /// Walls in the mean.
    pub in_mean: u64,
    /// Mean displacement (mm); `None` when no wall stands.
    pub mean: Option<f64>,
    /// 95 % interval of the mean (mm).
    pub mean_ci: Option<[f64; 2]>,
    /// Standard deviation (mm).
    pub sigma: Option<f64>,
    /// Mean less and plus one standard deviation (mm).
    pub band: Option<[f64; 2]>,
}

impl Point {
    fn of(entry: &ArmSummary) -> Self {
        let mean = entry.mean.map(millimetres);
        let sigma = entry.sigma.map(millimetres);
        Point {
            kn: entry.kn_pa_per_m,
            members: entry.members,
            in_mean: entry.in_mean,
            mean,
            mean_ci: entry.mean_ci.map(|ci| ci.map(millimetres)),
            sigma,
            band: mean.zip(sigma).map(|(mean, sigma)| [mean - sigma, mean + sigma]),
        }
    }
}

impl Curve {
    /// Text of the legend for the curve itself.
    pub fn label(&self) -> String {
        let walls = range(self.points.iter().map(|point| point.in_mean as f64));
        let walls = match walls {
            Some([low, high]) if low != high => format!("{low} to {high} walls"),
            Some([1.0, _]) => "1 wall".to_string(),
            Some([n, _]) => format!("{n} walls"),
            None => "no wall".to_string(),
        };
        match (self.random, self.points.iter().any(|point| point.mean_ci.is_some())) {
            (true, true) => format!("{}: mean of {walls}, bars: 95 % interval of the mean", self.arm),
            (true, false) => format!("{}: {walls}, no interval", self.arm),
            (false, _) => format!("{}: {walls}, nothing random", self.arm),
        }
    }

    /// True when a band of one standard deviation can be drawn.
    pub fn has_band(&self) -> bool {
        self.random && self.points.iter().any(|point| point.band.is_some())
    }

    /// What the curve leaves out, in one line; `None` when every wall is in.
    pub fn remark(&self) -> Option<String> {
        let empty = self.points.iter().filter(|point| point.mean.is_none()).count();
        let lost: u64 =
            self.points.iter().map(|point| point.members - point.in_mean.min(point.members)).sum();
        let planned: u64 = self.points.iter().map(|point| point.members).sum();
        match (lost, empty) {
            (0, 0) => None,
            (_, n) if n == self.points.len() => {
                Some(format!("{}: no wall reached equilibrium, nothing to draw", self.arm))
            }
            (_, 0) => {
                Some(format!("{}: {lost} of {planned} walls failed and are not in the means", self.arm))
            }
            (_, n) => Some(format!(
                "{}: {lost} of {planned} walls failed and are not in the means; none is left at {n} of {} stiffnesses",
                self.arm,
                self.points.len()
            )),
        }
    }
}

/// The curves of a summary, in the order of its arms.
pub fn curves(summary: &Summary) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for entry in &summary.arms {
        let point = Point::of(entry);
        match curves.iter_mut().find(|curve| curve.arm == entry.arm) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve { arm: entry.arm.clone(), random: entry.random, points: vec![point] }),
        }
    }
    curves
}

/// Title of the figure: the study and its variant.
pub fn title(summary: &Summary) -> String {
    match &summary.variant {
        Some(variant) => format!("{} \u{2013} variant {variant}", summary.study),
        None => summary.study.clone(),
    }
}

/// A displacement in mm from one in m.
pub fn millimetres(metres: f64) -> f64 {
    metres * 1e3
}
