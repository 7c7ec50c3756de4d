//! The joint stiffness that measured collapse angles speak for: a profile likelihood over simulations at several kn.
//!
//! Model: the angle of specimen i is normal about the mean of the simulated walls at kn, with the walls' own standard
//! deviation and an extra scatter between specimens that is profiled out; reading error, rounding and bounds as measured;
//! an error common to all readings and the sampling error of the simulated mean are integrated over. Mean and standard
//! deviation over ln kn are monotone curves through the points simulated.
//!
//! Intervals are likelihood-ratio intervals. With the scatter profiled out of few specimens the deviance of the mean is not
//! chi-square; it is compared with n ln(1 + t^2 / (n - 1)), t the quantile of Student's t with n - 1 degrees of freedom,
//! which is exact for n normal values of unknown scatter and tends to chi-square as n grows. It is on the safe side where the
//! simulated walls account for the scatter. One specimen says nothing of a scatter: that of the walls is then taken, and
//! chi-square. Friction, restraint and geometry are those of the arm, not part of the interval; kn is confounded with them.

use crate::critic::calibrate::points::{AnglePoint, LeftOut, angles_of, points_of};
use crate::critic::calibrate::profile::{Profiled, Said, profiled};
use crate::ensemble::Row;
use crate::math::{Monotone, exp, ln};
use crate::random::standard_normal::quantile;
use crate::stats::student_quantile;
use crate::study::{Measurement, Study};

/// Least number of usable points in kn.
pub const LEAST_POINTS: usize = 4;
/// Points of the curve over ln kn.
const GRID: usize = 121;

/// An end of an interval in kn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// Here (Pa/m).
    At(f64),
    /// Below the lowest kn simulated: open.
    BelowGrid,
    /// Above the largest kn simulated: open.
    AboveGrid,
}

/// The curve at one kn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Mean of the walls (rad).
    pub mean: f64,
    /// Standard deviation between walls (rad).
    pub sigma: f64,
    /// Twice the log likelihood lost against the best kn.
    pub deviance: f64,
}

/// What the measured angles of a family say of kn.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// The points simulated, kn ascending.
    pub points: Vec<AnglePoint>,
    /// Number of specimens, those with a bound only included.
    pub specimens: usize,
    /// The most likely kn (Pa/m), or the end of the grid towards which the likelihood still rises.
    pub best: End,
    /// Extra scatter between specimens at the most likely kn (rad).
    pub extra_scatter: f64,
    /// The 68 % interval.
    pub within_68: [End; 2],
    /// The 95 % interval.
    pub within_95: [End; 2],
    /// Deviances at which the two intervals end.
    pub thresholds: [f64; 2],
    /// The curve, kn ascending.
    pub curve: Vec<CurvePoint>,
    /// How far the curve misses an inner point when it is drawn without it, at most (rad): a generous bound of its error.
    pub interpolation_error: f64,
}

/// Calibrates kn for one arm of a study; `None` without measured angles or with fewer than [`LEAST_POINTS`] usable points.
pub fn calibrate_family(study: &Study, index: usize, rows: &[Row]) -> Option<(Calibration, Vec<LeftOut>)> {
    let arm = study.arms.get(index)?;
    let (points, left_out) = points_of(arm, index, rows);
    Some((calibrate(&points, &angles_of(study, &arm.name))?, left_out))
}

/// Profile likelihood of kn from measured collapse angles (one per specimen); `None` without any, or with fewer than
/// [`LEAST_POINTS`] points.
pub fn calibrate(points: &[AnglePoint], readings: &[&Measurement]) -> Option<Calibration> {
    if readings.is_empty() || points.len() < LEAST_POINTS {
        return None;
    }
    let curves = Curves::through(points);
    let [low, high] = [points[0].kn, points[points.len() - 1].kn].map(ln);
    let known = readings.iter().filter(|m| !m.kind.is_censored()).count();
    let at = |x: f64| profiled(readings, curves.at(x), known > 1);
    let xs: Vec<f64> = (0..GRID).map(|k| low + (high - low) * k as f64 / (GRID - 1) as f64).collect();
    let found: Vec<Profiled> = xs.iter().map(|&x| at(x)).collect();
    let place = (1..GRID)
        .fold(0, |best, k| if found[k].log_likelihood > found[best].log_likelihood { k } else { best });
    let (mut top, mut best) = (found[place], End::BelowGrid);
    if place == GRID - 1 {
        best = End::AboveGrid;
    } else if place > 0 {
        let x = xs[place]
            + (xs[1] - xs[0])
                * vertex([-1, 0, 1].map(|k| found[place.wrapping_add_signed(k)].log_likelihood));
        let between = at(x);
        let better = between.log_likelihood > top.log_likelihood;
        (top, best) = if better { (between, End::At(exp(x))) } else { (top, End::At(exp(xs[place]))) };
    }
    if !top.log_likelihood.is_finite() {
        return None;
    }
    let deviances: Vec<f64> =
        found.iter().map(|one| 2.0 * (top.log_likelihood - one.log_likelihood)).collect();
    let thresholds = [0.68, 0.95].map(|level| threshold(level, known));
    let interval = |threshold: f64| ends(&xs, &deviances, place, threshold);
    let curve = xs.iter().zip(&deviances).map(|(&x, &deviance)| {
        let said = curves.at(x);
        CurvePoint { kn: exp(x), mean: said.mean, sigma: said.sigma, deviance }
    });
    Some(Calibration {
        points: points.to_vec(),
        specimens: readings.len(),
        best,
        extra_scatter: top.extra,
        within_68: interval(thresholds[0]),
        within_95: interval(thresholds[1]),
        thresholds,
        curve: curve.collect(),
        interpolation_error: left_one_out(points),
    })
}

/// Mean, sigma and standard error over ln kn.
struct Curves {
    mean: Monotone,
    sigma: Monotone,
    error: Monotone,
}

impl Curves {
    fn through(points: &[AnglePoint]) -> Curves {
        let x: Vec<f64> = points.iter().map(|point| ln(point.kn)).collect();
        let curve =
            |of: fn(&AnglePoint) -> f64| Monotone::through(x.clone(), points.iter().map(of).collect());
        Curves {
            mean: curve(|point| point.mean),
            sigma: curve(|point| point.sigma),
            error: curve(
                |point| if point.walls > 0 { point.sigma / (point.walls as f64).sqrt() } else { 0.0 },
            ),
        }
    }

    fn at(&self, x: f64) -> Said {
        Said { mean: self.mean.at(x), sigma: self.sigma.at(x), error: self.error.at(x) }
    }
}

/// See [`Calibration::interpolation_error`].
fn left_one_out(points: &[AnglePoint]) -> f64 {
    (1..points.len() - 1).fold(0.0, |most, skipped| {
        let rest: Vec<AnglePoint> = [&points[..skipped], &points[skipped + 1..]].concat();
        let missed = Curves::through(&rest).at(ln(points[skipped].kn)).mean - points[skipped].mean;
        f64::max(most, missed.abs())
    })
}

/// Deviance up to which a kn belongs to the interval of this level; `known` specimens have a value.
fn threshold(level: f64, known: usize) -> f64 {
    let upper = 0.5 + 0.5 * level;
    if known < 2 {
        let z = quantile(upper);
        return z * z;
    }
    let n = known as f64;
    let t = student_quantile(upper, n - 1.0);
    n * ln(1.0 + t * t / (n - 1.0))
}

/// Where a parabola through three values has its top, in steps from the middle one, which is the largest.
fn vertex(values: [f64; 3]) -> f64 {
    let curvature = values[0] - 2.0 * values[1] + values[2];
    let shift = 0.5 * (values[0] - values[2]) / curvature;
    // Between flat or infinite neighbours there is none to speak of.
    if shift.is_finite() { shift } else { 0.0 }
}

/// From the best place outwards to where the deviance first exceeds the threshold, linear between grid points.
fn ends(xs: &[f64], deviances: &[f64], best: usize, threshold: f64) -> [End; 2] {
    let crossing = |inner: usize, outer: usize| {
        let share = (threshold - deviances[inner]) / (deviances[outer] - deviances[inner]);
        // A deviance that jumps to infinity is crossed at its last finite place.
        End::At(exp(xs[inner] + share.clamp(0.0, 1.0) * (xs[outer] - xs[inner])))
    };
    let low = (0..best).rev().find(|&k| deviances[k] > threshold).map(|k| crossing(k + 1, k));
    let high = (best + 1..xs.len()).find(|&k| deviances[k] > threshold).map(|k| crossing(k - 1, k));
    [low.unwrap_or(End::BelowGrid), high.unwrap_or(End::AboveGrid)]
}
