//! Unions of balls: volume, centroid and inertia.

use crate::math::{Mat3, Vec3};
use crate::shape::MassProperties;

/// Lines across the radius of the smallest ball by which a union of overlapping balls is integrated.
const LINES_PER_RADIUS: f64 = 40.0;

/// Overlap of two balls, as a share of the smaller radius, up to which they only touch.
const TOUCHING: f64 = 1e-9;

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Centre (m).
    pub centre: Vec3,
    /// Radius (m).
    pub radius: f64,
}

impl Ball {
    /// How deep it reaches into another one (m); negative for the gap between them.
    pub fn overlap(&self, other: &Ball) -> f64 {
        self.radius + other.radius - (self.centre - other.centre).norm()
    }

    /// Volume (m^3).
    pub fn volume(&self) -> f64 {
        4.0 / 3.0 * std::f64::consts::PI * self.radius * self.radius * self.radius
    }
}

/// Mass properties of the union of balls at unit density; what several balls share counts once.
///
/// Exact where no two balls overlap; balls that touch but for rounding, by less than 1e-9 of a radius, do not. Otherwise the union is cut into columns along z on a square grid of a fortieth of
/// the smallest radius: along a column's axis the union of intervals is exact, across it the axis stands for the column
/// (midpoint rule). The error falls at least as the spacing to the power 3/2, the rate that the vertical tangents at
/// the rims allow; volume and moments of inertia are right to 1e-3.
///
/// Undefined for no balls at all.
pub fn union_of_balls(balls: &[Ball]) -> MassProperties {
    let apart = |(i, a): (usize, &Ball)| {
        balls[i + 1..].iter().all(|b| a.overlap(b) <= TOUCHING * a.radius.min(b.radius))
    };
    if balls.iter().enumerate().all(apart) { sum(balls) } else { columns(balls, LINES_PER_RADIUS) }
}

/// Closed form for balls that do not overlap.
fn sum(balls: &[Ball]) -> MassProperties {
    let volume: f64 = balls.iter().map(Ball::volume).sum();
    let centroid = match balls {
        [only] => only.centre,
        _ => balls.iter().map(|b| b.centre * b.volume()).sum::<Vec3>() / volume,
    };
    let inertia = balls.iter().fold(Mat3::zeros(), |sum, ball| {
        let d = ball.centre - centroid;
        let own = Mat3::identity() * (0.4 * ball.radius * ball.radius);
        sum + (own + Mat3::identity() * d.norm_squared() - d * d.transpose()) * ball.volume()
    });
    MassProperties { volume, centroid, inertia }
}

/// Columns along z, `lines` of them to the smallest radius.
fn columns(balls: &[Ball], lines: f64) -> MassProperties {
    let smallest = balls.iter().map(|b| b.radius).fold(f64::INFINITY, f64::min);
    let low =
        balls.iter().fold(Vec3::repeat(f64::INFINITY), |low, b| low.inf(&b.centre.add_scalar(-b.radius)));
    let high = balls
        .iter()
        .fold(Vec3::repeat(f64::NEG_INFINITY), |high, b| high.sup(&b.centre.add_scalar(b.radius)));
    let h = smallest / lines;
    let count = |extent: f64| (extent / h).ceil() as u32;
    let (nx, ny) = (count(high.x - low.x), count(high.y - low.y));
    // Moments about the lower corner: volume, first, and second without those that symmetry gives.
    let (mut volume, mut first, mut second) = (0.0, Vec3::zeros(), Mat3::zeros());
    let mut parts: Vec<[f64; 2]> = Vec::with_capacity(balls.len());
    for i in 0..nx {
        let x = h * (f64::from(i) + 0.5);
        for j in 0..ny {
            let y = h * (f64::from(j) + 0.5);
            chords(balls, [low.x + x, low.y + y], &mut parts);
            for [from, to] in merged(&parts) {
                let (from, to) = (from - low.z, to - low.z);
                let (length, half) = (to - from, 0.5 * (to * to - from * from));
                volume += length;
                first += Vec3::new(x * length, y * length, half);
                // A column's own breadth adds h^2 / 12 to the squares of its axis' coordinates.
                let own = h * h / 12.0;
                second[(0, 0)] += (x * x + own) * length;
                second[(1, 1)] += (y * y + own) * length;
                second[(2, 2)] += (to * to * to - from * from * from) / 3.0;
                second[(0, 1)] += x * y * length;
                second[(0, 2)] += x * half;
                second[(1, 2)] += y * half;
            }
        }
    }
    for (r, c) in [(0, 1), (0, 2), (1, 2)] {
        second[(c, r)] = second[(r, c)];
    }
    let c = first / volume;
    let about_centroid = second - c * c.transpose() * volume;
    MassProperties {
        volume: volume * h * h,
        centroid: low + c,
        inertia: (Mat3::identity() * about_centroid.trace() - about_centroid) * (h * h),
    }
}

/// The parts of the line along z through (x, y) within each ball, from below.
fn chords(balls: &[Ball], [x, y]: [f64; 2], parts: &mut Vec<[f64; 2]>) {
    parts.clear();
    for ball in balls {
        let (dx, dy) = (x - ball.centre.x, y - ball.centre.y);
        let square = ball.radius * ball.radius - dx * dx - dy * dy;
        if square > 0.0 {
            let half = square.sqrt();
            parts.push([ball.centre.z - half, ball.centre.z + half]);
        }
    }
    parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
}

/// The union of intervals that are sorted by their lower ends.
fn merged(parts: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> + '_ {
    let mut rest = parts.iter().copied().peekable();
    std::iter::from_fn(move || {
        let [from, mut to] = rest.next()?;
        while let Some([_, end]) = rest.next_if(|next| next[0] <= to) {
            to = to.max(end);
        }
        Some([from, to])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    fn ball(x: f64, y: f64, z: f64, radius: f64) -> Ball {
        Ball { centre: Vec3::new(x, y, z), radius }
    }

    #[test]
    fn balls_apart_are_summed_exactly() {
        // A dumb-bell of two unit balls at +-2 on x: along the axis 2 x 2/5 m, across it 2 (2/5 + 4) m.
        let properties = union_of_balls(&[ball(1.0, 5.0, 7.0, 1.0), ball(5.0, 5.0, 7.0, 1.0)]);
        let m = 4.0 / 3.0 * PI;
        assert_relative_eq!(properties.volume, 2.0 * m, max_relative = 1e-14);
        assert_relative_eq!(properties.centroid, Vec3::new(3.0, 5.0, 7.0), max_relative = 1e-14);
        assert_relative_eq!(properties.inertia[(0, 0)], 0.8 * m, max_relative = 1e-14);
        assert_relative_eq!(properties.inertia[(1, 1)], 8.8 * m, max_relative = 1e-14);
        assert_relative_eq!(properties.inertia[(0, 1)], 0.0, epsilon = 1e-12);
    }

    #[test]
    fn balls_that_touch_but_for_rounding_are_summed_exactly() {
        // A row of three of radius r has 3 m and, across it, 3 x 2/5 m r^2 + 2 m (2 r)^2.
        let r = 0.4 / 6.0;
        let row: Vec<Ball> = (0..3).map(|k| ball(r * (2.0 * f64::from(k) + 1.0), r, r, r)).collect();
        let (properties, m) = (union_of_balls(&row), row[0].volume());
        assert_relative_eq!(properties.volume, 3.0 * m, max_relative = 1e-14);
        assert_relative_eq!(properties.inertia[(2, 2)], 9.2 * m * r * r, max_relative = 1e-12);
    }

    /// Two unit balls at +-1/2 on an axis: each is cut by the plane in the middle, where its part within the other
    /// half is missing. By discs of radius^2 1 - s^2 for s from -1 to 1/2 from its centre: volume 9 pi / 8, along the axis
    /// pi / 2 int (1 - s^2)^2, across it int (1 - s^2)^2 pi / 4 + (1 - s^2) pi x^2 with x = s - 1/2.
    fn lens(axis: usize) -> (f64, f64, f64) {
        let steps = 200_000;
        let (mut volume, mut along, mut across) = (0.0, 0.0, 0.0);
        for i in 0..steps {
            let ds = 1.5 / f64::from(steps);
            let s = -1.0 + ds * (f64::from(i) + 0.5);
            let (disc, x) = (1.0 - s * s, s - 0.5);
            volume += 2.0 * PI * disc * ds;
            along += PI * disc * disc * ds;
            across += 2.0 * PI * (disc * disc / 4.0 + disc * x * x) * ds;
        }
        assert_relative_eq!(volume, 2.25 * PI, max_relative = 1e-9);
        assert!(axis < 3);
        (volume, along, across)
    }

    #[test]
    fn what_two_balls_share_counts_once() {
        for axis in 0..3 {
            let mut shift = Vec3::zeros();
            shift[axis] = 0.5;
            let at = Vec3::new(3.0, -2.0, 1.0);
            let pair = [Ball { centre: at + shift, radius: 1.0 }, Ball { centre: at - shift, radius: 1.0 }];
            let properties = union_of_balls(&pair);
            let (volume, along, across) = lens(axis);
            // The stated accuracy of the columns.
            assert_relative_eq!(properties.volume, volume, max_relative = 1e-3);
            assert_relative_eq!(properties.centroid, at, epsilon = 1e-4);
            for k in 0..3 {
                let expected = if k == axis { along } else { across };
                assert_relative_eq!(properties.inertia[(k, k)], expected, max_relative = 1e-3);
            }
        }
    }

    #[test]
    fn the_columns_converge() {
        let pair = [ball(0.0, 0.0, 0.0, 1.0), ball(0.31, 0.42, 0.17, 0.8)];
        let fine = columns(&pair, 320.0);
        let errors: Vec<f64> = [10.0, 40.0, 160.0]
            .into_iter()
            .map(|lines| {
                let it = columns(&pair, lines);
                println!("{lines} lines: volume {:e}", it.volume / fine.volume - 1.0);
                (it.inertia - fine.inertia).norm() / fine.inertia.norm()
            })
            .collect();
        println!("errors of the inertia {errors:?}");
        // A quarter of the spacing is an eighth of the error at the rate of 3/2; a half is left for its ups and downs.
        assert!(errors[1] < errors[0] / 4.0 && errors[2] < errors[1] / 4.0, "{errors:?}");
    }

    #[test]
    fn a_ball_within_another_adds_nothing() {
        let big = ball(0.2, 0.1, 0.0, 1.0);
        let properties = union_of_balls(&[big, ball(0.3, 0.0, 0.1, 0.5)]);
        assert_relative_eq!(properties.volume, big.volume(), max_relative = 1e-3);
        assert_relative_eq!(properties.centroid, big.centre, epsilon = 1e-4);
    }
}
