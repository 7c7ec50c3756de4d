//! What Figure 10 shows, in the units of its axes, before anything is drawn.

use crate::report::number::{range, shortened};
use crate::report::summary::{ArmSummary, Summary};

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 24;

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
    /// Name of the arm, cut where it would run out of the figure.
    pub fn name(&self) -> String {
        shortened(&self.arm, LONGEST_NAME)
    }

    /// Text of the legend for the curve itself.
    pub fn label(&self) -> String {
        let name = self.name();
        if self.points.iter().all(|point| point.mean.is_none()) {
            return format!("{name}: no wall");
        }
        let walls = match range(self.points.iter().map(|point| point.in_mean as f64)) {
            Some([low, high]) if low != high => format!("{low} to {high} walls"),
            Some([n, _]) if n > 1.0 => format!("{n} walls"),
            _ => "1 wall".to_string(),
        };
        match (self.random, self.points.iter().any(|point| point.mean_ci.is_some())) {
            (true, true) => format!("{name}: mean of {walls}, bars: 95 % interval of the mean"),
            (true, false) => format!("{name}: {walls}, no interval"),
            (false, _) => format!("{name}: {walls}, nothing random"),
        }
    }

    /// True when a band of one standard deviation can be drawn.
    pub fn has_band(&self) -> bool {
        self.random && self.points.iter().any(|point| point.band.is_some())
    }

    /// What the curve leaves out, in one line; `None` when every wall is in.
    pub fn remark(&self) -> Option<String> {
        let name = self.name();
        let all = self.points.len();
        let empty = self.points.iter().filter(|point| point.mean.is_none()).count();
        let lost: u64 = self.points.iter().map(|point| point.members.saturating_sub(point.in_mean)).sum();
        let planned: u64 = self.points.iter().map(|point| point.members).sum();
        let failed = format!("{name}: {lost} of {planned} analyses failed; they are not in the means");
        match (lost, empty) {
            (0, 0) => None,
            (_, empty) if empty == all => {
                Some(format!("{name}: no wall reached equilibrium at any stiffness"))
            }
            (_, 0) => Some(failed),
            (_, empty) => Some(format!("{failed}; none is left at {empty} of {all} stiffnesses")),
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
