//! What the figure of a calibration shows of one arm, in the units of its axes, before anything is drawn.

use crate::critic::{Calibration, End};
use crate::math::degrees;
use crate::stats::student_quantile;
use crate::study::{MeasuredKind, Measurement};
use crate::verb::run::answer::measured::comparison::tidy_degrees;

/// One arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Its name.
    pub arm: String,
    /// The curve over kn.
    pub curve: Vec<PanelPoint>,
    /// The points simulated: kn (Pa/m), mean angle (deg) and half the 95 % interval of that mean (deg).
    pub points: Vec<[f64; 3]>,
    /// The angles measured.
    pub angles: Vec<Angle>,
    /// The most likely kn.
    pub best: End,
    /// The 68 % interval.
    pub within_68: [End; 2],
    /// The 95 % interval.
    pub within_95: [End; 2],
}

/// The curve at one kn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelPoint {
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Mean angle (deg).
    pub mean: f64,
    /// Standard deviation between walls (deg).
    pub sigma: f64,
    /// Deviance.
    pub deviance: f64,
}

/// A measured angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// The angle, or its bound (deg).
    pub value: f64,
    /// Half the width of its band: the resolution's half and the error (deg).
    pub half: f64,
    /// Whether it is a bound.
    pub bound: bool,
}

impl Angle {
    /// Of a measurement of a collapse angle.
    pub fn of(m: &Measurement) -> Angle {
        let error = (m.error * m.error + m.common_error * m.common_error).sqrt();
        let bound = matches!(m.kind, MeasuredKind::Below | MeasuredKind::Above);
        Angle { value: tidy_degrees(m.value), half: degrees(0.5 * m.resolution + error), bound }
    }
}

impl Panel {
    /// Of a calibration.
    pub fn of(arm: &str, found: &Calibration, angles: Vec<Angle>) -> Panel {
        let curve = found.curve.iter().map(|point| PanelPoint {
            kn: point.kn,
            mean: degrees(point.mean),
            sigma: degrees(point.sigma),
            deviance: point.deviance,
        });
        let points = found.points.iter().map(|point| {
            let n = point.walls as f64;
            let half =
                if point.walls > 1 { student_quantile(0.975, n - 1.0) * point.sigma / n.sqrt() } else { 0.0 };
            [point.kn, degrees(point.mean), degrees(half)]
        });
        Panel {
            arm: arm.to_string(),
            curve: curve.collect(),
            points: points.collect(),
            angles,
            best: found.best,
            within_68: found.within_68,
            within_95: found.within_95,
        }
    }

    /// Lowest and largest kn (Pa/m).
    pub fn ends(&self) -> [f64; 2] {
        let at = |point: Option<&PanelPoint>| point.map_or(1.0, |point| point.kn);
        [at(self.curve.first()), at(self.curve.last())]
    }

    /// An interval cut to the points simulated.
    pub fn cut(&self, interval: [End; 2]) -> [f64; 2] {
        let [low, high] = self.ends();
        interval.map(|end| match end {
            End::At(kn) => kn,
            End::BelowGrid => low,
            End::AboveGrid => high,
        })
    }
}
