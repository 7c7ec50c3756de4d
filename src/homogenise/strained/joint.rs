//! A joint of a periodic cell: how its faces move against each other, and what that makes it carry.
//!
//! The faces are parts of rigid bodies, whatever the strain of the plate does to the image. So the second one moves past the first by a
//! displacement that is affine over the joint: nine numbers `q`, its opening and its shear along two axes, each with its growth
//! along both coordinates of the joint. What the joint carries are nine sums, the loads that go with them.

use crate::contact::PeriodicJoint;
use crate::homogenise::springs::{outward, points};
use crate::law::{Coulomb, Crushing, Motion, Pressed, PressedSlopes, Sampling, SubContact};
use crate::math::Vec3;
use crate::model::{Six, image_motion, image_turn};
use crate::shape::Polygon;

/// Unknowns that a joint depends on: six of either stone and the plate's strain.
pub(super) const UNKNOWNS: usize = 18;

/// Opening `1, s, t` and shear `(1, s, t)` by its two components, or what goes with them: the order of [`crate::law::ShearSlopes`].
type Nine = [f64; 9];

/// A joint at the beginning of an increment.
pub(super) struct Joint {
    pub first: usize,
    pub second: usize,
    /// `q` by the [`UNKNOWNS`].
    motion: [[f64; UNKNOWNS]; 9],
    law: Coulomb,
    crushing: Option<Crushing>,
    /// Where the joint is sampled, in its coordinates from its middle (m), and the area that each point stands for (m^2).
    points: Vec<([f64; 2], f64)>,
    /// What the points remember of the increments before.
    states: Vec<SubContact>,
    /// `q` at the beginning of the increment.
    before: Nine,
}

/// Lengths by which turns, strains and curvatures are multiplied, so that all unknowns are displacements (m) and all loads forces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lengths {
    /// Of a stone (m).
    pub stone: f64,
    /// Of the cell (m).
    pub cell: f64,
}

impl Lengths {
    /// What a unit of the unknowns of a strain is in strains and curvatures.
    pub fn strain(&self) -> Six {
        let (e, k) = (1.0 / self.cell, 1.0 / (self.cell * self.cell));
        [e, e, e, k, k, k]
    }
}

impl Joint {
    /// The joint between two stones with their centroids; `None` where they do not touch over an area before anything moves: faces that
    /// are built further apart than `closed` (m), edges and corners. Along either axis of a joint with four corners there are `panels`
    /// panels of three points.
    pub fn of(
        joint: &PeriodicJoint,
        closed: f64,
        law: Coulomb,
        centroids: [Vec3; 2],
        lengths: Lengths,
        panels: u32,
    ) -> Option<Joint> {
        let patch = &joint.patch;
        let panels = if matches!(law.sampling, Sampling::Patches(_)) { 1 } else { panels };
        let points = points(patch, closed, law.sampling, |outline| grid(outline, panels));
        if points.is_empty() {
            return None;
        }
        let area = points.iter().map(|(_, weight)| weight).sum::<f64>();
        let middle = points.iter().fold(Vec3::zeros(), |sum, (at, weight)| sum + at * *weight) / area;
        let (s, t, n) = (patch.frame.s, patch.frame.t, outward(patch));
        let along = (s - n * n.dot(&s)).normalize();
        let points: Vec<_> = points
            .iter()
            .map(|(at, weight)| ([s, t].map(|axis| axis.dot(&(at - middle))), *weight))
            .collect();
        let centroids = [centroids[0], centroids[1] + joint.shift];
        Some(Joint {
            first: joint.first,
            second: joint.second,
            motion: motion([n, along, n.cross(&along)], [s, t], middle, centroids, joint.shift, lengths),
            crushing: law.crushing(),
            law,
            states: vec![SubContact::default(); points.len()],
            points,
            before: [0.0; 9],
        })
    }

    /// Largest stiffness of the joint (N/m).
    pub fn stiffness(&self) -> f64 {
        let area: f64 = self.points.iter().map(|(_, weight)| weight).sum();
        area * self.law.normal.largest_stiffness().max(self.law.ks)
    }

    /// The forces that resist the unknowns.
    pub fn forces(&self, unknowns: &[f64; UNKNOWNS]) -> [f64; UNKNOWNS] {
        let (carried, _) = self.carried(&self.q(unknowns));
        std::array::from_fn(|j| (0..9).map(|i| self.motion[i][j] * carried[i]).sum())
    }

    /// The derivatives of the forces. As `glued` all points are closed and none slips. A share `least` of the stiffness of closed
    /// points that do not slip comes on top.
    pub fn tangent(
        &self,
        unknowns: &[f64; UNKNOWNS],
        glued: bool,
        least: f64,
    ) -> [[f64; UNKNOWNS]; UNKNOWNS] {
        let q = self.q(unknowns);
        let mut slopes = if glued { [[0.0; 9]; 9] } else { self.slopes(&q) };
        let share = if glued { 1.0 } else { least };
        for (at, weight) in &self.points {
            let kn = self.law.normal.stiffness((-opening(&q, at)).max(0.0));
            let of = [1.0, at[0], at[1]];
            for (i, a) in of.iter().enumerate() {
                for (j, b) in of.iter().enumerate() {
                    let area = share * weight * a * b;
                    slopes[i][j] += kn * area;
                    slopes[3 + 2 * i][3 + 2 * j] += self.law.ks * area;
                    slopes[4 + 2 * i][4 + 2 * j] += self.law.ks * area;
                }
            }
        }
        let times = slopes.map(|row| {
            std::array::from_fn::<f64, UNKNOWNS, _>(|j| (0..9).map(|k| row[k] * self.motion[k][j]).sum())
        });
        std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..9).map(|k| self.motion[k][i] * times[k][j]).sum())
        })
    }

    /// Ends an increment at these unknowns.
    pub fn settle(&mut self, unknowns: &[f64; UNKNOWNS]) {
        let q = self.q(unknowns);
        self.states = self.carried(&q).1;
        self.before = q;
    }

    fn q(&self, unknowns: &[f64; UNKNOWNS]) -> Nine {
        self.motion.map(|row| row.iter().zip(unknowns).map(|(by, x)| by * x).sum())
    }

    /// Shear displacement in this increment.
    fn slip(&self, q: &Nine) -> Motion {
        let since = |k: usize| q[k] - self.before[k];
        Motion { base: [since(3), since(4)], by_s: [since(5), since(6)], by_t: [since(7), since(8)] }
    }

    /// What presses on a point, and its slope by the opening (N/m); no area where it is open. A point that is torn is marked.
    fn pressed(&self, q: &Nine, (at, weight): &([f64; 2], f64), state: &mut SubContact) -> (Pressed, f64) {
        let closure = -opening(q, at);
        let stress = self.law.normal.stress(closure);
        if self.law.holds(state) && !self.law.bonded && -stress > self.law.tension {
            state.broken = true;
        }
        if closure <= 0.0 && !self.law.holds(state) {
            return (Pressed { at: *at, ..Pressed::default() }, 0.0);
        }
        let pressed = |stress: f64| Pressed { at: *at, area: *weight, force: stress * weight };
        match self.crushing {
            Some(crushing) if closure > crushing.closure => (pressed(crushing.strength), 0.0),
            _ => (pressed(stress), -self.law.normal.stiffness(closure) * weight),
        }
    }

    /// The sums that go with `q`, resisting it, and the states of the points.
    fn carried(&self, q: &Nine) -> (Nine, Vec<SubContact>) {
        let mut states = self.states.clone();
        let all = self.points.iter().zip(&mut states);
        let pressed: Vec<Pressed> = all.map(|(point, state)| self.pressed(q, point, state).0).collect();
        let shear = self.law.shear(&mut states, &pressed, &self.slip(q));
        let [force, by_s, by_t] = [shear.force, shear.by_s, shear.by_t];
        let mut sum = [0.0, 0.0, 0.0, -force[0], -force[1], -by_s[0], -by_s[1], -by_t[0], -by_t[1]];
        for Pressed { at, force, .. } in pressed {
            sum[0] -= force;
            sum[1] -= at[0] * force;
            sum[2] -= at[1] * force;
        }
        (sum, states)
    }

    /// The derivatives of the sums by `q`.
    fn slopes(&self, q: &Nine) -> [Nine; 9] {
        let mut slopes = [[0.0; 9]; 9];
        let (mut shear, slip) = (Default::default(), self.slip(q));
        for (point, state) in self.points.iter().zip(&self.states) {
            let mut state = *state;
            let (pressed, by_opening) = self.pressed(q, point, &mut state);
            let of = [1.0, pressed.at[0], pressed.at[1]];
            let by_gap = PressedSlopes { force: of.map(|x| x * by_opening), ..PressedSlopes::default() };
            for (row, x) in slopes.iter_mut().zip(of) {
                row.iter_mut().zip(by_gap.force).for_each(|(sum, slope)| *sum -= x * slope);
            }
            self.law.add_shear_slopes(&state, &pressed, &by_gap, &slip, false, &mut shear);
        }
        slopes[3..].iter_mut().zip(shear).for_each(|(row, slope)| *row = slope.map(|x| -x));
        slopes
    }
}

fn opening(q: &Nine, [s, t]: &[f64; 2]) -> f64 {
    q[0] + s * q[1] + t * q[2]
}

/// How the faces move against each other by the unknowns of the first stone, the second one and the strain: along the normal and the
/// axes of shear, at the middle and past it along the coordinates of the joint.
fn motion(
    axes: [Vec3; 3],
    coordinates: [Vec3; 2],
    middle: Vec3,
    centroids: [Vec3; 2],
    shift: Vec3,
    lengths: Lengths,
) -> [[f64; UNKNOWNS]; 9] {
    let mut motion = [[0.0; UNKNOWNS]; 9];
    let unit = lengths.strain();
    let (shifts, turns) = (image_motion(shift, middle), image_turn(shift));
    for (k, axis) in axes.iter().enumerate() {
        // Of the opening and either shear: at the middle, and past it.
        let [at, past @ ..] = if k == 0 { [0, 1, 2] } else { [2 + k, 4 + k, 6 + k] };
        // Along an axis a turn moves a lever by their triple product.
        let by_turn = coordinates.map(|lever| lever.cross(axis));
        for (stone, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let here = (middle - centroids[stone]).cross(axis);
            for i in 0..3 {
                motion[at][6 * stone + i] = sign * axis[i];
                motion[at][6 * stone + 3 + i] = sign * here[i] / lengths.stone;
                for (row, turned) in past.iter().zip(by_turn) {
                    motion[*row][6 * stone + 3 + i] = sign * turned[i] / lengths.stone;
                }
            }
        }
        for j in 0..6 {
            let along =
                |of: &Vec3, rows: &[Six; 3]| (0..3).map(|i| of[i] * rows[i][j]).sum::<f64>() * unit[j];
            motion[at][12 + j] = along(axis, &shifts);
            for (row, turned) in past.iter().zip(by_turn) {
                motion[*row][12 + j] = along(&turned, &turns);
            }
        }
    }
    motion
}

/// Points with weights over a convex polygon: Simpson's rule in panels along both axes of a quadrilateral.
///
/// The rule has points on the border, so that a joint can open up to its edge: what turns about that edge is borne as by a rigid
/// stone. Other polygons are cut into quadrilaterals from their middle.
fn grid(polygon: &Polygon, panels: u32) -> Vec<([f64; 2], f64)> {
    let vertices = &polygon.vertices;
    if let [a, b, c, d] = vertices[..] {
        return quadrilateral([a, b, c, d], panels).collect();
    }
    let n = vertices.len();
    let half = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| 0.5 * (a[k] + b[k]));
    let middle = [0, 1].map(|k| vertices.iter().map(|v| v[k]).sum::<f64>() / n as f64);
    let at_corner = |i: usize| {
        let (before, here, after) = (vertices[(i + n - 1) % n], vertices[i], vertices[(i + 1) % n]);
        quadrilateral([here, half(here, after), middle, half(before, here)], panels.div_ceil(2))
    };
    (0..n).flat_map(at_corner).collect()
}

fn quadrilateral([a, b, c, d]: [[f64; 2]; 4], panels: u32) -> impl Iterator<Item = ([f64; 2], f64)> {
    let steps = 2 * panels;
    let along = f64::from(steps);
    let share = move |i: u32| {
        let third = if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
        third / (3.0 * along)
    };
    (0..=steps).flat_map(move |i| (0..=steps).map(move |j| (i, j))).map(move |(i, j)| {
        let (u, v) = (f64::from(i) / along, f64::from(j) / along);
        let between = |from: f64, to: f64, share: f64| (1.0 - share) * from + share * to;
        let at = |k: usize| between(between(a[k], b[k], u), between(d[k], c[k], u), v);
        let by_u = |k: usize| between(b[k] - a[k], c[k] - d[k], v);
        let by_v = |k: usize| between(d[k] - a[k], c[k] - b[k], u);
        let jacobian = by_u(0) * by_v(1) - by_u(1) * by_v(0);
        ([at(0), at(1)], share(i) * share(j) * jacobian)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadratics_are_integrated_exactly() {
        // Moments of a pentagon from its own formula.
        let pentagon = vec![[0.0, 0.0], [2.0, -0.5], [2.5, 1.0], [1.0, 2.0], [-0.3, 1.2]];
        let quadrilateral = pentagon[..4].to_vec();
        for vertices in [quadrilateral, pentagon] {
            let polygon = Polygon { vertices };
            let exact = polygon.moments();
            for panels in [1, 4] {
                let mut found = [0.0; 6];
                for ([s, t], weight) in grid(&polygon, panels) {
                    let all = [1.0, s, t, s * s, s * t, t * t];
                    found.iter_mut().zip(all).for_each(|(sum, x)| *sum += x * weight);
                }
                let exact = [exact.area, exact.s, exact.t, exact.ss, exact.st, exact.tt];
                for (found, exact) in found.iter().zip(exact) {
                    // Sums of a few dozen numbers near 1.
                    assert!((found - exact).abs() < 1e-12, "{found} {exact}");
                }
            }
        }
    }
}
