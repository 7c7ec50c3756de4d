//! Convex polygons in a plane: area, first and second moments, clipping by half-planes and by one another.
//!
//! Clipping is plain Sutherland-Hodgman on convex polygons.

use crate::shape::hull::Hull;

/// A convex polygon in plane coordinates (m), counter-clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygon {
    /// Vertices in counter-clockwise order.
    pub vertices: Vec<[f64; 2]>,
}

/// Integrals over a polygon of 1, s, t, s^2, s t, t^2 about the plane's origin (m^2, m^3, m^4).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Area (m^2).
    pub area: f64,
    /// Integral of s (m^3).
    pub s: f64,
    /// Integral of t (m^3).
    pub t: f64,
    /// Integral of s^2 (m^4).
    pub ss: f64,
    /// Integral of s t (m^4).
    pub st: f64,
    /// Integral of t^2 (m^4).
    pub tt: f64,
}

impl Moments {
    /// Centroid in plane coordinates; the origin for an empty polygon.
    pub fn centroid(&self) -> [f64; 2] {
        if self.area > 0.0 { [self.s / self.area, self.t / self.area] } else { [0.0, 0.0] }
    }
}

impl Polygon {
    /// Integrals of 1, s, t, s^2, s t, t^2 by Green's theorem, exact for a polygon.
    pub fn moments(&self) -> Moments {
        moments(&self.vertices)
    }

    /// The convex polygon around some points, without points on its sides.
    pub fn around(points: Vec<[f64; 2]>) -> Polygon {
        Polygon { vertices: Hull::of(points).corners }
    }

    /// Its sides in order, each from corner to corner.
    pub fn sides(&self) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
        sides(&self.vertices)
    }

    /// Area (m^2).
    pub fn area(&self) -> f64 {
        self.moments().area
    }

    /// The part where `g0 + gs s + gt t <= 0`.
    pub fn clip(&self, g0: f64, gs: f64, gt: f64) -> Polygon {
        let mut out = Vec::with_capacity(self.vertices.len() + 1);
        clip_into(&self.vertices, |v| g0 + gs * v[0] + gt * v[1], &mut out);
        Polygon { vertices: out }
    }

    /// The part shared with another counter-clockwise convex polygon in the same plane.
    pub fn intersection(&self, other: &Polygon) -> Polygon {
        let mut current = self.clone();
        let n = other.vertices.len();
        for i in 0..n {
            let (a, b) = (other.vertices[i], other.vertices[(i + 1) % n]);
            // Outside of the edge a -> b is on its right: cross(b - a, v - a) < 0.
            let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
            current = current.clip(ex * a[1] - ey * a[0], ey, -ex);
            if current.vertices.len() < 3 {
                return Polygon::default();
            }
        }
        current
    }

    /// What is left of it outside another counter-clockwise convex polygon in the same plane: convex polygons that do not overlap.
    pub fn without(&self, other: &Polygon) -> Vec<Polygon> {
        let (mut rest, mut outside) = (self.clone(), Vec::new());
        for [a, b] in other.sides() {
            // As in `intersection`: what lies on the right of a side is outside.
            let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
            let g0 = ex * a[1] - ey * a[0];
            outside.push(rest.clip(-g0, -ey, ex));
            rest = rest.clip(g0, ey, -ex);
        }
        outside.retain(|part| part.vertices.len() >= 3 && part.area() > 0.0);
        outside
    }
}

/// The sides of a closed line in order, each from corner to corner.
pub fn sides(corners: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(from, to)| [*from, *to])
}

/// The distance (m) between two points.
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    let [s, t] = [a[0] - b[0], a[1] - b[1]];
    (s * s + t * t).sqrt()
}

/// Whether a point lies within a closed line, convex or not: a line from it to the right crosses an odd number of sides.
pub fn encloses(corners: &[[f64; 2]], point: [f64; 2]) -> bool {
    let crossed = sides(corners).filter(|[from, to]| {
        (from[1] > point[1]) != (to[1] > point[1]) && {
            let share = (point[1] - from[1]) / (to[1] - from[1]);
            from[0] + share * (to[0] - from[0]) > point[0]
        }
    });
    crossed.count() % 2 == 1
}

/// The least and greatest coordinates of points: of s, of t, then the greatest ones.
pub fn bounds<'p>(points: impl IntoIterator<Item = &'p [f64; 2]>) -> [f64; 4] {
    let start = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    points.into_iter().fold(start, |b, [s, t]| [b[0].min(*s), b[1].min(*t), b[2].max(*s), b[3].max(*t)])
}

/// Appends to `out` the part of the convex polygon `vertices` on which the affine function `value` is not positive.
pub fn clip_into(vertices: &[[f64; 2]], value: impl Fn(&[f64; 2]) -> f64, out: &mut Vec<[f64; 2]>) {
    let n = vertices.len();
    if n == 0 {
        return;
    }
    let mut previous = vertices[n - 1];
    let mut previous_value = value(&previous);
    for vertex in vertices {
        let v = value(vertex);
        if (v <= 0.0) != (previous_value <= 0.0) {
            let w = previous_value / (previous_value - v);
            out.push([
                previous[0] + w * (vertex[0] - previous[0]),
                previous[1] + w * (vertex[1] - previous[1]),
            ]);
        }
        if v <= 0.0 {
            out.push(*vertex);
        }
        previous = *vertex;
        previous_value = v;
    }
}

/// Integrals over the counter-clockwise polygon `vertices`, exact.
pub fn moments(vertices: &[[f64; 2]]) -> Moments {
    let mut m = Moments::default();
    let n = vertices.len();
    if n < 3 {
        return m;
    }
    // Relative to the first vertex: a small polygon far from the origin keeps its digits.
    let o = vertices[0];
    for i in 1..n - 1 {
        let (x1, y1) = (vertices[i][0] - o[0], vertices[i][1] - o[1]);
        let (x2, y2) = (vertices[i + 1][0] - o[0], vertices[i + 1][1] - o[1]);
        let cross = x1 * y2 - x2 * y1;
        m.area += cross / 2.0;
        m.s += cross * (x1 + x2) / 6.0;
        m.t += cross * (y1 + y2) / 6.0;
        m.ss += cross * (x1 * x1 + x1 * x2 + x2 * x2) / 12.0;
        m.tt += cross * (y1 * y1 + y1 * y2 + y2 * y2) / 12.0;
        m.st += cross * (2.0 * x1 * y1 + x1 * y2 + x2 * y1 + 2.0 * x2 * y2) / 24.0;
    }
    Moments {
        area: m.area,
        s: m.s + o[0] * m.area,
        t: m.t + o[1] * m.area,
        ss: m.ss + 2.0 * o[0] * m.s + o[0] * o[0] * m.area,
        tt: m.tt + 2.0 * o[1] * m.t + o[1] * o[1] * m.area,
        st: m.st + o[0] * m.t + o[1] * m.s + o[0] * o[1] * m.area,
    }
}
