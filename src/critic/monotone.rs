//! A smooth curve through points that rises where they rise and falls where they fall.

/// Piecewise cubic through given points, monotone between neighbours and once continuously differentiable (Fritsch and
/// Carlson 1980, with the slopes of Fritsch and Butland 1984). Constant beyond the first and the last point.
#[derive(Clone, Debug, PartialEq)]
pub struct Monotone {
    x: Vec<f64>,
    y: Vec<f64>,
    slopes: Vec<f64>,
}

impl Monotone {
    /// Through these points, at least one, `x` strictly ascending.
    pub fn through(x: &[f64], y: &[f64]) -> Monotone {
        crate::check!(!x.is_empty() && x.len() == y.len(), "{} places for {} values", x.len(), y.len());
        crate::check!(x.windows(2).all(|pair| pair[0] < pair[1]), "the places are not ascending: {x:?}");
        Monotone { x: x.to_vec(), y: y.to_vec(), slopes: slopes(x, y) }
    }

    /// Value at a place.
    pub fn at(&self, x: f64) -> f64 {
        let last = self.x.len() - 1;
        if x <= self.x[0] {
            return self.y[0];
        }
        if x >= self.x[last] {
            return self.y[last];
        }
        let i = self.x.partition_point(|&known| known <= x) - 1;
        let h = self.x[i + 1] - self.x[i];
        let t = (x - self.x[i]) / h;
        // Hermite's cubics.
        let (s, tt) = (1.0 - t, t * t);
        let (value, slope) = ((1.0 + 2.0 * t) * s * s, t * s * s);
        let (next_value, next_slope) = (tt * (3.0 - 2.0 * t), -tt * s);
        value * self.y[i]
            + next_value * self.y[i + 1]
            + h * (slope * self.slopes[i] + next_slope * self.slopes[i + 1])
    }
}

fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    if n == 1 {
        return vec![0.0];
    }
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let d: Vec<f64> = y.windows(2).zip(&h).map(|(pair, h)| (pair[1] - pair[0]) / h).collect();
    if n == 2 {
        return vec![d[0]; 2];
    }
    let mut slopes = vec![end_slope(h[0], h[1], d[0], d[1])];
    for i in 1..n - 1 {
        slopes.push(if d[i - 1] * d[i] <= 0.0 {
            0.0
        } else {
            let (before, after) = (2.0 * h[i] + h[i - 1], h[i] + 2.0 * h[i - 1]);
            (before + after) / (before / d[i - 1] + after / d[i])
        });
    }
    slopes.push(end_slope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]));
    slopes
}

/// Slope at an end: of the parabola through three points, kept within what keeps the cubic monotone.
fn end_slope(h: f64, next_h: f64, d: f64, next_d: f64) -> f64 {
    let slope = ((2.0 * h + next_h) * d - h * next_d) / (h + next_h);
    if slope * d <= 0.0 {
        0.0
    } else if d * next_d <= 0.0 && slope.abs() > 3.0 * d.abs() {
        3.0 * d
    } else {
        slope
    }
}
