//! Where shear is followed on a sub-contact: four points that carry the area and the pressure of its compressed part.
//!
//! A quarter of the area at `c + i l1 + j l2`, `i, j = +-1`, with the centroid `c` and the columns `l1, l2` of the symmetric
//! square root of the part's second moments per area, has the part's moments up to the second: shear that is affine over it, as in
//! a joint that twists, is integrated exactly. On a square they are the points of Gauss's rule of 2 by 2. They never leave the
//! part: a convex body contains the ball of radius sqrt((n + 2) / n) of its own inertia (Kannan, Lovasz and Simonovits 1995),
//! and that is where they lie in the plane. The pressure is shared so that its force and both moments are those of the part.

use crate::law::{Pressed, PressedSlopes};
use crate::shape::Moments;
use crate::solve::joints::pressure::{PressureSlopes, PressureSum};

/// Points of a sub-contact.
pub(super) const POINTS: usize = 4;
/// Their signs along the two levers.
const SIGNS: [[f64; 2]; POINTS] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

/// How the integrals 1, s, t, s^2, s t, t^2 over a part change with the gap `g0, gs, gt`.
pub(super) type MomentSlopes = [[f64; 3]; 6];

/// Where the points of a part lie: its centroid, and the symmetric square root of its second moments per area. Cholesky's factor
/// would do, but its levers swing round where the part is a thin strip that turns a little.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spread {
    centre: [f64; 2],
    /// Second moments per area: ss, st, tt.
    second: [f64; 3],
    /// Root of their determinant, and of their trace and twice that.
    area: f64,
    size: f64,
    /// Entries ss, st, tt of the square root.
    root: [f64; 3],
}

fn over(x: f64, by: f64) -> f64 {
    if by > 0.0 { x / by } else { 0.0 }
}

impl Spread {
    /// Of a part that has an area.
    pub(super) fn new(part: &Moments) -> Spread {
        let centre = part.centroid();
        let ss = (part.ss / part.area - centre[0] * centre[0]).max(0.0);
        let st = part.st / part.area - centre[0] * centre[1];
        let tt = (part.tt / part.area - centre[1] * centre[1]).max(0.0);
        let area = (ss * tt - st * st).max(0.0).sqrt();
        let size = (ss + tt + 2.0 * area).sqrt();
        let root = [over(ss + area, size), over(st, size), over(tt + area, size)];
        Spread { centre, second: [ss, st, tt], area, size, root }
    }

    /// The points.
    pub(super) fn places(&self) -> [[f64; 2]; POINTS] {
        let Spread { centre, root: [ss, st, tt], .. } = self;
        SIGNS.map(|[i, j]| [centre[0] + i * ss + j * st, centre[1] + i * st + j * tt])
    }

    /// The root's inverse times a vector.
    fn solve(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [ss, st, tt] = self.root;
        [over(tt * x - st * y, self.area), over(ss * y - st * x, self.area)]
    }

    /// The pressure's moments about the centroid by the root's inverse: how it leans along the two levers.
    fn leaning(&self, share: &PressureSum) -> [f64; 2] {
        let [s, t] = self.centre;
        self.solve([share.by_s - share.force * s, share.by_t - share.force * t])
    }

    /// What presses at the points of a part of this area (m^2).
    pub(super) fn pressed(&self, area: f64, share: &PressureSum) -> [Pressed; POINTS] {
        let (at, [m, n]) = (self.places(), self.leaning(share));
        std::array::from_fn(|k| {
            let [i, j] = SIGNS[k];
            Pressed { at: at[k], area: 0.25 * area, force: 0.25 * (share.force + i * m + j * n) }
        })
    }

    /// How what presses at the points changes with the gap where the part does not: `stiffness` are the slopes of its pressure.
    pub(super) fn fixed_slopes(&self, stiffness: &PressureSlopes) -> [PressedSlopes; POINTS] {
        let mut slopes = [PressedSlopes::default(); POINTS];
        for g in 0..3 {
            let [force, by_s, by_t] = stiffness.map(|row| -row[g]);
            let [m, n] = self.leaning(&PressureSum { force, by_s, by_t });
            for (slope, [i, j]) in slopes.iter_mut().zip(SIGNS) {
                slope.force[g] = 0.25 * (force + i * m + j * n);
            }
        }
        slopes
    }

    /// The same where the part changes as well; `by_gap` are the slopes of its integrals.
    pub(super) fn slopes(
        &self,
        part: &Moments,
        share: &PressureSum,
        by_gap: &MomentSlopes,
        stiffness: &PressureSlopes,
    ) -> [PressedSlopes; POINTS] {
        let Spread { centre, second, area: root_area, size, root } = *self;
        let [m, n] = self.leaning(share);
        let mut slopes = [PressedSlopes::default(); POINTS];
        for g in 0..3 {
            let [area, s, t, ss, st, tt] = by_gap.map(|row| row[g]);
            let [force, by_s, by_t] = stiffness.map(|row| -row[g]);
            let c = [(s - centre[0] * area) / part.area, (t - centre[1] * area) / part.area];
            let per = |d: f64, second: f64| (d - second / part.area * area) / part.area;
            let ss = per(ss, part.ss) - 2.0 * centre[0] * c[0];
            let st = per(st, part.st) - centre[0] * c[1] - centre[1] * c[0];
            let tt = per(tt, part.tt) - 2.0 * centre[1] * c[1];
            let d_area = over(ss * second[2] + second[0] * tt - 2.0 * second[1] * st, 2.0 * root_area);
            let d_size = over(ss + tt + 2.0 * d_area, 2.0 * size);
            let entry = |k: usize, d: f64| over(d - root[k] * d_size, size);
            let [ss, st, tt] = [entry(0, ss + d_area), entry(1, st), entry(2, tt + d_area)];
            let [first, second] = self.solve([
                by_s - force * centre[0] - share.force * c[0] - ss * m - st * n,
                by_t - force * centre[1] - share.force * c[1] - st * m - tt * n,
            ]);
            for (slope, [i, j]) in slopes.iter_mut().zip(SIGNS) {
                slope.area[g] = 0.25 * area;
                slope.at[0][g] = c[0] + i * ss + j * st;
                slope.at[1][g] = c[1] + i * st + j * tt;
                slope.force[g] = 0.25 * (force + i * first + j * second);
            }
        }
        slopes
    }
}

/// The one point of a corner or a small patch, at the part's centroid, and how what presses there changes with the gap.
pub(super) fn centre_slopes(
    part: &Moments,
    share: &PressureSum,
    by_gap: &MomentSlopes,
    stiffness: &PressureSlopes,
) -> (Pressed, PressedSlopes) {
    let at = part.centroid();
    let moved = |k: usize| std::array::from_fn(|g| (by_gap[k + 1][g] - at[k] * by_gap[0][g]) / part.area);
    let slopes =
        PressedSlopes { at: [moved(0), moved(1)], area: by_gap[0], force: stiffness[0].map(|slope| -slope) };
    (Pressed { at, area: part.area, force: share.force }, slopes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{cos, sin};
    use crate::shape::Polygon;
    use crate::solve::joints::joint::Gap;
    use crate::solve::joints::pressure::linear;
    use approx::assert_relative_eq;

    /// A square cut along many lines; thin strips and small corners among its parts.
    fn parts() -> Vec<Polygon> {
        let square = Polygon { vertices: vec![[0.3, 0.1], [0.5, 0.1], [0.5, 0.3], [0.3, 0.3]] };
        let cut = |k: u32| {
            // Turned by the golden angle each time, 0 to 0.14 m from the centre.
            let turned = 2.399_963 * f64::from(k);
            let [s, t] = [cos(turned), sin(turned)];
            square.clip(-s * 0.4 - t * 0.2 - 0.14 * f64::from(k) / 500.0, s, t)
        };
        (0..500).map(cut).filter(|part| part.vertices.len() > 2 && part.moments().area > 1e-9).collect()
    }

    #[test]
    fn the_points_have_the_moments_of_the_part_and_lie_in_it() {
        for part in parts() {
            let m = part.moments();
            let places = Spread::new(&m).places();
            let sum =
                |of: &dyn Fn([f64; 2]) -> f64| places.iter().map(|&at| 0.25 * m.area * of(at)).sum::<f64>();
            assert_relative_eq!(sum(&|[s, _]| s), m.s, max_relative = 1e-12);
            assert_relative_eq!(sum(&|[_, t]| t), m.t, max_relative = 1e-12);
            assert_relative_eq!(sum(&|[s, _]| s * s), m.ss, max_relative = 1e-12);
            assert_relative_eq!(sum(&|[s, t]| s * t), m.st, max_relative = 1e-12);
            assert_relative_eq!(sum(&|[_, t]| t * t), m.tt, max_relative = 1e-12);
            for [s, t] in places {
                for (k, p) in part.vertices.iter().enumerate() {
                    let q = part.vertices[(k + 1) % part.vertices.len()];
                    let side = (q[0] - p[0]) * (t - p[1]) - (q[1] - p[1]) * (s - p[0]);
                    assert!(side > -1e-12, "{s} {t} outside {:?}", part.vertices);
                }
            }
        }
    }

    #[test]
    fn the_points_share_the_pressure_with_its_moments_and_none_pulls() {
        for part in parts() {
            let m = part.moments();
            // Pressed by a millimetre at one corner, by nothing at the one that is furthest from it.
            let [s, t] = part.vertices[0];
            let apart = |v: &[f64; 2]| ((v[0] - s) * (v[0] - s) + (v[1] - t) * (v[1] - t)).sqrt();
            let far = part.vertices.iter().map(apart).fold(0.0, f64::max);
            let to = part.vertices.iter().find(|v| apart(v) == far).expect("one of them");
            let (gs, gt) = ((to[0] - s) / (far * far), (to[1] - t) / (far * far));
            let highest = part.vertices.iter().map(|v| gs * v[0] + gt * v[1]).fold(f64::MIN, f64::max);
            let gap = Gap { g0: -1e-3 * highest, gs: 1e-3 * gs, gt: 1e-3 * gt };
            let share = linear(1e8, &m, &gap);
            let pressed = Spread::new(&m).pressed(m.area, &share);
            assert_relative_eq!(
                pressed.iter().map(|p| p.force).sum::<f64>(),
                share.force,
                max_relative = 1e-12
            );
            let by_s: f64 = pressed.iter().map(|p| p.force * p.at[0]).sum();
            let by_t: f64 = pressed.iter().map(|p| p.force * p.at[1]).sum();
            assert_relative_eq!(by_s, share.by_s, max_relative = 1e-9);
            assert_relative_eq!(by_t, share.by_t, max_relative = 1e-9);
            assert!(pressed.iter().all(|p| p.force > -1e-9 * share.force), "{pressed:?}");
        }
    }
}
