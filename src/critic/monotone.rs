//! A smooth curve through points that rises where they rise and falls where they fall.

/// Piecewise cubic through given points, monotone between neighbours and once continuously differentiable (Fritsch and
/// Carlson 1980, with the slopes of Fritsch and Butland 1984). Constant beyond the first and the last point.
///
/// The points are held as they are given, in a `Vec` or in an array: of the latter many may be made without a heap.
#[derive(Clone, Debug, PartialEq)]
pub struct Monotone<S = Vec<f64>> {
    x: S,
    y: S,
    slopes: S,
}

impl<S: AsRef<[f64]> + AsMut<[f64]> + Clone> Monotone<S> {
    /// Through these points, at least one, `x` strictly ascending.
    pub fn through(x: S, y: S) -> Monotone<S> {
        let mut slopes = y.clone();
        {
            let (x, y) = (x.as_ref(), y.as_ref());
            crate::check!(!x.is_empty() && x.len() == y.len(), "{} places for {} values", x.len(), y.len());
            crate::check!(x.windows(2).all(|pair| pair[0] < pair[1]), "the places are not ascending: {x:?}");
            write_slopes(x, y, slopes.as_mut());
        }
        Monotone { x, y, slopes }
    }

    /// Value at a place.
    pub fn at(&self, place: f64) -> f64 {
        let (x, y, slopes) = (self.x.as_ref(), self.y.as_ref(), self.slopes.as_ref());
        let last = x.len() - 1;
        if place <= x[0] {
            return y[0];
        }
        if place >= x[last] {
            return y[last];
        }
        let i = x.partition_point(|&known| known <= place) - 1;
        let h = x[i + 1] - x[i];
        let t = (place - x[i]) / h;
        // Hermite's cubics.
        let (s, tt) = (1.0 - t, t * t);
        let (value, slope) = ((1.0 + 2.0 * t) * s * s, t * s * s);
        let (next_value, next_slope) = (tt * (3.0 - 2.0 * t), -tt * s);
        value * y[i] + next_value * y[i + 1] + h * (slope * slopes[i] + next_slope * slopes[i + 1])
    }
}

fn write_slopes(x: &[f64], y: &[f64], slopes: &mut [f64]) {
    let n = x.len();
    // Width of an interval, and the slope of the chord over it.
    let chord = |i: usize| {
        let h = x[i + 1] - x[i];
        (h, (y[i + 1] - y[i]) / h)
    };
    if n < 3 {
        slopes.fill(if n == 2 { chord(0).1 } else { 0.0 });
        return;
    }
    let mut before = chord(0);
    slopes[0] = end_slope(before, chord(1));
    for (i, slope) in slopes.iter_mut().enumerate().take(n - 1).skip(1) {
        let after = chord(i);
        let ((h0, d0), (h1, d1)) = (before, after);
        *slope = if d0 * d1 <= 0.0 {
            0.0
        } else {
            let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
            (w0 + w1) / (w0 / d0 + w1 / d1)
        };
        before = after;
    }
    slopes[n - 1] = end_slope(before, chord(n - 3));
}

/// Slope at an end, from the chords of the last interval and of the next one inwards: of the parabola through three points, kept
/// within what keeps the cubic monotone.
fn end_slope((h, d): (f64, f64), (next_h, next_d): (f64, f64)) -> f64 {
    let slope = ((2.0 * h + next_h) * d - h * next_d) / (h + next_h);
    if slope * d <= 0.0 {
        0.0
    } else if d * next_d <= 0.0 && slope.abs() > 3.0 * d.abs() {
        3.0 * d
    } else {
        slope
    }
}
