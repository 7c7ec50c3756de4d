//! What the figure over kn shows, in the units of its axes, before anything is drawn.

use crate::ensemble::Quantity;
use crate::render::number::{range, shortened};
use crate::stats::EmpiricalStep;
use crate::verb::run::answer::summary::{ArmSummary, Summary};

/// Names longer than this are cut in the figure.
pub const LONGEST_NAME: usize = 24;

/// One arm in the figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What is shown.
    pub quantity: Quantity,
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
    /// Normal stiffness of the joints (Pa/m); over a swept key its value.
    pub kn: f64,
    /// Walls computed.
    pub members: u64,
    /// Walls in the mean.
    pub in_mean: u64,
    /// Mean, in the unit shown; `None` when no wall brings a value.
    pub mean: Option<f64>,
    /// Its 95 % interval.
    pub mean_ci: Option<[f64; 2]>,
    /// Standard deviation.
    pub sigma: Option<f64>,
    /// Mean less and plus one standard deviation.
    pub band: Option<[f64; 2]>,
}

impl Point {
    pub(crate) fn of(entry: &ArmSummary) -> Self {
        let shown = |x: f64| entry.shown.shown(x);
        let mean = entry.mean.map(shown);
        let sigma = entry.sigma.map(shown);
        Point {
            kn: entry.kn_pa_per_m,
            members: entry.computed(),
            in_mean: entry.in_mean,
            mean,
            mean_ci: entry.mean_ci.map(|ci| ci.map(shown)),
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
            (_, empty) if empty == all => Some(format!("{name}: no wall brings a value at any stiffness")),
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
            None => curves.push(Curve {
                quantity: entry.shown,
                arm: entry.arm.clone(),
                random: entry.random,
                points: vec![point],
            }),
        }
    }
    curves
}

/// The fragility curve of one arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    /// Name of the arm.
    pub arm: String,
    /// Its place among the arms of the study, which gives it its colour.
    pub place: usize,
    /// True for an arm of random walls, drawn with a band.
    pub random: bool,
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Walls that it rests on.
    pub walls: u64,
    /// Walls that say nothing about the capacity.
    pub lost: u64,
    /// Its steps, ascending.
    pub steps: Vec<EmpiricalStep>,
}

/// The middle of the stiffnesses (Pa/m), the lower of two; `None` where there are none.
pub(crate) fn middle_kn(summary: &Summary) -> Option<f64> {
    let mut kns: Vec<f64> = Vec::new();
    for arm in &summary.arms {
        if !kns.contains(&arm.kn_pa_per_m) {
            kns.push(arm.kn_pa_per_m);
        }
    }
    kns.get(kns.len().saturating_sub(1) / 2).copied()
}

/// The fragility curves at the middle kn (the lower of two), in the order of the arms; none where the quantity is no capacity.
pub fn ladders(summary: &Summary) -> Vec<Ladder> {
    let Some(kn) = middle_kn(summary) else { return Vec::new() };
    let capacity = summary.arms.iter().filter(|arm| arm.shown == Quantity::CollapseAngle);
    let mut names: Vec<&str> = summary.arms.iter().map(|arm| arm.arm.as_str()).collect();
    names.dedup();
    capacity
        .filter(|arm| arm.kn_pa_per_m == kn)
        .map(|arm| {
            let walls = arm.outcomes.get("collapsed").copied().unwrap_or(0) + arm.stood_to_the_end;
            Ladder {
                arm: arm.arm.clone(),
                place: names.iter().position(|name| *name == arm.arm).unwrap_or_default(),
                random: arm.random,
                kn,
                walls,
                lost: arm.members.saturating_sub(walls),
                steps: arm.fragility.clone(),
            }
        })
        .collect()
}

/// Title of the figure: the study and its variant.
pub fn title(summary: &Summary) -> String {
    match &summary.variant {
        Some(variant) => format!("{} \u{2013} variant {variant}", summary.study),
        None => summary.study.clone(),
    }
}
