//! Slopes at points, of a smooth curve through them that rises where they rise and falls where they fall.

/// Slopes of Hermite's cubics through points, `x` strictly ascending, that keep them monotone between neighbours (Fritsch and
/// Carlson 1980; slopes of Fritsch and Butland 1984). One point has the slope 0, two have that of their chord.
pub fn monotone_slopes(x: &[f64], y: &[f64], slopes: &mut [f64]) {
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
