//! Straight lines through points: those that joints follow in the face of a wall.

/// A straight line, and the side of it that counts: where `normal . point > offset` is beyond it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Unit normal.
    pub normal: [f64; 2],
    /// Its distance (m) from the origin along the normal.
    pub offset: f64,
}

impl Line {
    /// How far (m) a point lies beyond it.
    pub fn beyond(&self, point: [f64; 2]) -> f64 {
        dot(self.normal, point) - self.offset
    }

    /// The same line seen from the other side.
    pub fn flipped(&self) -> Line {
        Line { normal: self.normal.map(|c| -c), offset: -self.offset }
    }

    /// The same line with its normal along a direction rather than against it.
    pub fn towards(&self, direction: [f64; 2]) -> Line {
        if dot(self.normal, direction) < 0.0 { self.flipped() } else { *self }
    }

    /// The side of a counter-clockwise polygon from one corner to the next; beyond it is outside. `None` of corners in one place.
    pub fn side([from, to]: [[f64; 2]; 2]) -> Option<Line> {
        let along = minus(to, from);
        let length = dot(along, along).sqrt();
        if length == 0.0 {
            return None;
        }
        let normal = [along[1] / length, -along[0] / length];
        Some(Line { normal, offset: dot(normal, from) })
    }
}

/// Sums over points, of which the line nearest to them follows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fit {
    count: f64,
    sum: [f64; 2],
    products: [f64; 3],
}

impl Fit {
    /// Of some points.
    pub fn of(points: &[[f64; 2]]) -> Fit {
        points.iter().fold(Fit::default(), |fit, [x, z]| Fit {
            count: fit.count + 1.0,
            sum: [fit.sum[0] + x, fit.sum[1] + z],
            products: [fit.products[0] + x * x, fit.products[1] + x * z, fit.products[2] + z * z],
        })
    }

    /// Of the points of both.
    pub fn with(&self, other: &Fit) -> Fit {
        let [a, b] = [self, other];
        Fit {
            count: a.count + b.count,
            sum: [a.sum[0] + b.sum[0], a.sum[1] + b.sum[1]],
            products: [0, 1, 2].map(|k| a.products[k] + b.products[k]),
        }
    }

    /// The line with the least sum of squared distances from the points (Pearson 1901). `None` where they show no direction.
    pub fn line(&self) -> Option<Line> {
        let mean = self.sum.map(|sum| sum / self.count);
        let xx = self.products[0] / self.count - mean[0] * mean[0];
        let xz = self.products[1] / self.count - mean[0] * mean[1];
        let zz = self.products[2] / self.count - mean[1] * mean[1];
        // The larger eigenvalue of the covariance, and its direction.
        let half = 0.5 * (xx - zz);
        let root = (half * half + xz * xz).sqrt();
        let along = if half >= 0.0 { [half + root, xz] } else { [xz, root - half] };
        let length = dot(along, along).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let normal = [along[1] / length, -along[0] / length];
        Some(Line { normal, offset: dot(normal, mean) })
    }
}

/// Rounds of leaving out, and how many times the median distance from the line a point is off that is left out.
const ROUNDS: usize = 5;
const OUTLIERS: f64 = 3.0;

/// The line that most of some points follow, and the points that do: those around the ends of a joint belong to what lies beside it.
pub fn followed(points: &[[f64; 2]]) -> Option<(Line, Vec<[f64; 2]>)> {
    let mut kept = points.to_vec();
    for _ in 0..ROUNDS {
        let line = Fit::of(&kept).line()?;
        let mut off: Vec<f64> = kept.iter().map(|point| line.beyond(*point).abs()).collect();
        off.sort_by(f64::total_cmp);
        let most = OUTLIERS * off[off.len() / 2];
        let before = kept.len();
        kept.retain(|point| line.beyond(*point).abs() <= most);
        if kept.len() == before {
            break;
        }
    }
    Some((Fit::of(&kept).line()?, kept))
}

/// The inner product.
pub fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// `a - b`.
pub fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_goes_through_its_points_in_any_direction() {
        for direction in [[1.0, 0.0], [0.0, 1.0], [0.6, 0.8], [-0.8, 0.6]] {
            let points: Vec<[f64; 2]> =
                (0..9).map(|k| [3.0 + k as f64 * direction[0], -2.0 + k as f64 * direction[1]]).collect();
            let line = Fit::of(&points).line().unwrap();
            assert!(dot(line.normal, direction).abs() < 1e-12, "{line:?}");
            assert!(points.iter().all(|point| line.beyond(*point).abs() < 1e-12), "{line:?}");
        }
        assert_eq!(Fit::of(&[[1.0, 1.0], [1.0, 1.0]]).line(), None);
    }

    #[test]
    fn what_is_off_at_the_ends_does_not_turn_a_line() {
        let mut points: Vec<[f64; 2]> = (0..20).map(|k| [k as f64, 1.0]).collect();
        points.extend([[19.2, 0.8], [19.3, 0.5], [19.4, 0.1]]);
        let (line, kept) = followed(&points).unwrap();
        assert!((line.offset.abs() - 1.0).abs() < 1e-12 && line.normal[0].abs() < 1e-12, "{line:?}");
        assert_eq!(kept.len(), 20);
    }

    #[test]
    fn a_line_of_two_parts_is_that_of_all_points() {
        let points = [[0.0, 0.1], [1.0, -0.1], [2.0, 0.1], [3.0, 0.2]];
        let parts = Fit::of(&points[..2]).with(&Fit::of(&points[2..]));
        let (whole, parts) = (Fit::of(&points).line().unwrap(), parts.line().unwrap());
        assert!((whole.offset - parts.offset).abs() < 1e-12 && dot(whole.normal, parts.normal) > 1.0 - 1e-12);
    }
}
