//! The capacity curve of a mechanism: what acceleration it bears when it has gone so far.

/// Spectral acceleration (m/s^2) against spectral displacement (m), in the order in which they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct CapacityCurve {
    points: Vec<[f64; 2]>,
}

impl CapacityCurve {
    /// Of displacements and accelerations, by rising displacement: what goes back along it, as the elastic rebound at a peak may, is left out.
    pub fn of(points: impl IntoIterator<Item = [f64; 2]>) -> CapacityCurve {
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for point in points {
            if kept.last().is_none_or(|last| point[0] > last[0]) {
                kept.push(point);
            }
        }
        CapacityCurve { points: kept }
    }

    /// Its points.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The displacement (m) at which nothing is borne any more, past the highest point; `None` where the curve ends above that.
    pub fn ends_at(&self) -> Option<f64> {
        let top = self.top()?;
        let pair = self.points[top..].windows(2).find(|pair| pair[0][1] > 0.0 && pair[1][1] <= 0.0)?;
        let ([d, a], [far, low]) = (pair[0], pair[1]);
        Some(d + (far - d) * a / (a - low))
    }

    /// How far it is known (m).
    pub fn known_to(&self) -> f64 {
        self.points.last().map_or(0.0, |last| last[0])
    }

    /// The acceleration (m/s^2) at a displacement within it, between its points in proportion.
    pub fn at(&self, displacement: f64) -> Option<f64> {
        let pair =
            self.points.windows(2).find(|pair| pair[0][0] <= displacement && displacement <= pair[1][0])?;
        let ([d, a], [far, end]) = (pair[0], pair[1]);
        Some(a + (end - a) * (displacement - d) / (far - d))
    }

    /// The place of the highest point.
    fn top(&self) -> Option<usize> {
        (0..self.points.len()).max_by(|a, b| self.points[*a][1].total_cmp(&self.points[*b][1]))
    }

    /// The largest acceleration (m/s^2).
    pub fn peak(&self) -> f64 {
        self.top().map_or(0.0, |top| self.points[top][1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_ends_where_it_comes_down_to_nothing() {
        let curve = CapacityCurve::of([[0.0, 0.0], [0.01, 3.0], [0.005, 3.1], [0.11, 1.0], [0.21, -1.0]]);
        assert_eq!(curve.points().len(), 4);
        assert!((curve.ends_at().expect("it ends") - 0.16).abs() < 1e-15);
        assert!((curve.at(0.06).expect("within it") - 2.0).abs() < 1e-15);
        assert_eq!(curve.at(0.3), None);
        assert_eq!(curve.peak(), 3.0);
    }

    #[test]
    fn a_curve_that_is_not_followed_to_its_end_has_none() {
        let curve = CapacityCurve::of([[0.0, 0.0], [0.01, 3.0], [0.11, 1.0]]);
        assert_eq!((curve.ends_at(), curve.known_to()), (None, 0.11));
    }
}
