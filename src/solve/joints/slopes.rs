//! The tangent of a joint: how its forces on the two bodies change as they move.
//!
//! The forces depend on the bodies through nine numbers, the gap `g0, gs, gt` and the motion since the anchor
//! (`base, by_s, by_t`), and through the pose that turns them into vectors. Both are differentiated exactly, in the
//! direction of each of the six velocities of the incident body; where both bodies move as one, forces and moments turn
//! with them, which gives those of the reference body. Pressure over the compressed part of a cell: its
//! boundary moves with the gap, but no pressure acts there, so `d(N, Ns, Nt) = -kn M d(g0, gs, gt)` with the second
//! moments `M` of the part, weighted by the law's slope where that varies; the area in contact itself changes by the
//! moments of the cut.

use crate::contact::Cell;
use crate::law::{Motion, Pressed, PressedSlopes, ShearSlopes, SubContact};
use crate::math::Vec3;
use crate::shape::Moments;
use crate::solve::bodies::Body;
use crate::solve::joints::force::Sums;
use crate::solve::joints::joint::{Gap, Pose};
use crate::solve::joints::points::{MomentSlopes, POINTS, centre_slopes};
use crate::solve::joints::pressure::{Bearing, compressed, pressure, pressure_slopes};
use crate::solve::joints::{Anchor, Joint};

/// The negative derivatives of force and moment on the incident body and on the reference body (rows) with respect
/// to the displacement and the turn (rad, world axes) of the incident body and of the reference body (columns): a
/// stiffness, in N/m, N and N m.
#[derive(Clone, Debug)]
pub struct Slopes {
    /// By row and column.
    pub stiffness: [[f64; 12]; 12],
    /// Whether a sub-contact slips, which makes the stiffness unsymmetric.
    pub slips: bool,
    /// Whether a sub-contact is open in part, which with shear on it makes the stiffness unsymmetric.
    pub opens: bool,
}

/// The derivatives of pressure (rows force, by_s, by_t) and shear (rows force, by_s, by_t, two components each).
#[derive(Default)]
struct SumSlopes {
    pressure: [[f64; 3]; 3],
    shear: ShearSlopes,
    slips: bool,
    opens: bool,
}

/// The axes of the world.
const AXES: [Vec3; 3] = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];

/// A twist of one body.
#[derive(Clone, Copy)]
struct Twist {
    shift: Vec3,
    turn: Vec3,
}

impl Twist {
    const NONE: Twist = Twist { shift: Vec3::new(0.0, 0.0, 0.0), turn: Vec3::new(0.0, 0.0, 0.0) };

    /// The velocity of a point of the body.
    fn at(&self, point: &Vec3, body: &Body) -> Vec3 {
        self.shift + self.turn.cross(&(point - body.position))
    }
}

impl Joint {
    /// The tangent at the bodies' positions for a step that started at the anchor, after the forces have been
    /// applied there; `None` where the joint has no force. In an assembly that is `unloaded` every joint sticks.
    pub(super) fn slopes(
        &self,
        bodies: &[Body],
        anchor: &Anchor,
        unloaded: bool,
        pressed: &mut Vec<Pressed>,
    ) -> Option<Slopes> {
        let pose = self.pose(bodies);
        if self.is_wide_open(&pose.gap) {
            return None;
        }
        let (i, r) = (&bodies[self.incident as usize], &bodies[self.reference as usize]);
        let motion = pose.motion_since(anchor, r);
        let (sums, slopes) = self.sum_slopes(&pose.gap, &motion, anchor, unloaded, pressed);
        let carried = [anchor.origin, anchor.s, anchor.t].map(|v| r.rotation * v);
        let geometry = Geometry { pose: &pose, incident: i, reference: r, carried, sums: &sums };
        let shifts = AXES.map(|shift| geometry.change(&Twist { shift, ..Twist::NONE }, &slopes));
        let turns = AXES.map(|turn| geometry.change(&Twist { turn, ..Twist::NONE }, &slopes));
        // Both bodies may move as one: then the forces turn with them, and the reference body's part is what the incident
        // body's lacks of that.
        let [force, on_incident, on_reference] = geometry.loads();
        let apart = i.position - r.position;
        let columns: [[Vec3; 4]; 12] = std::array::from_fn(|column| {
            let k = column % 3;
            match column / 3 {
                0 => shifts[k],
                1 => turns[k],
                2 => shifts[k].map(|change| -change),
                _ => {
                    let turn = AXES[k];
                    let swept = turn.cross(&apart);
                    let turned = [force, on_incident, -force, on_reference].map(|load| turn.cross(&load));
                    std::array::from_fn(|row| {
                        let by_sweep =
                            shifts[0][row] * swept.x + shifts[1][row] * swept.y + shifts[2][row] * swept.z;
                        turned[row] - turns[k][row] - by_sweep
                    })
                }
            }
        });
        let entry = |row: usize, column: usize| -columns[column][row / 3][row % 3];
        let stiffness = std::array::from_fn(|row| std::array::from_fn(|column| entry(row, column)));
        Some(Slopes { stiffness, slips: slopes.slips, opens: slopes.opens })
    }

    /// Pressure and shear with their derivatives.
    fn sum_slopes(
        &self,
        gap: &Gap,
        motion: &Motion,
        anchor: &Anchor,
        unloaded: bool,
        pressed: &mut Vec<Pressed>,
    ) -> (Sums, SumSlopes) {
        let (mut sums, mut slopes) = (Sums::default(), SumSlopes::default());
        pressed.clear();
        let each = self.points_each();
        let bearing = Bearing::of(&self.law, &self.polygon, gap);
        let mut before = Vec::with_capacity(self.states.len());
        let histories = self.states.chunks_exact(each).zip(anchor.states.chunks_exact(each));
        for (index, (cell, (states, earlier))) in self.cells.iter().zip(histories).enumerate() {
            let gap = &gap.of(cell);
            let holds = self.law.holds(&states[0]);
            let part = if holds { cell.moments } else { compressed(cell, gap) };
            let share = pressure(&bearing, cell, &part, gap, holds);
            sums.pressure.add(&share);
            let rows = pressure_slopes(&bearing, cell, &part, gap, holds);
            for (total, row) in slopes.pressure.iter_mut().zip(rows) {
                total.iter_mut().zip(row).for_each(|(sum, slope)| *sum -= slope);
            }
            let first = before.len();
            before.extend(
                earlier.iter().zip(states).map(|(was, now)| SubContact { broken: now.broken, ..*was }),
            );
            let was = &before[first..];
            if part.area <= 0.0 {
                pressed.extend(was.iter().map(|_| Pressed::default()));
                continue;
            }
            let cut = part.area < cell.moments.area;
            slopes.opens |= cut;
            let by_gap = if cut { cut_moments(cell, gap) } else { MomentSlopes::default() };
            let mut add = |was: &SubContact, load: Pressed, by_gap: &PressedSlopes| {
                slopes.slips |=
                    self.law.add_shear_slopes(was, &load, by_gap, motion, unloaded, &mut slopes.shear);
                pressed.push(load);
            };
            if each < POINTS {
                let (load, by_gap) = centre_slopes(&part, &share, &by_gap, &rows);
                add(&was[0], load, &by_gap);
                continue;
            }
            let spread = self.spread_of(index, &part);
            let loads = spread.pressed(part.area, &share);
            if !cut
                && (unloaded || was.iter().zip(&loads).all(|(was, load)| self.law.sticks(was, load, motion)))
            {
                add_sticking(self.law.ks, &part, &mut slopes.shear);
                pressed.extend(loads);
                continue;
            }
            let by_gap = match cut {
                true => spread.slopes(&part, &share, &by_gap, &rows),
                false => spread.fixed_slopes(&rows),
            };
            for ((was, load), by_gap) in was.iter().zip(loads).zip(&by_gap) {
                add(was, load, by_gap);
            }
        }
        sums.shear = self.law.shear(&mut before, pressed, motion);
        (sums, slopes)
    }
}

/// A joint as it stands, to be differentiated.
struct Geometry<'a> {
    pose: &'a Pose,
    incident: &'a Body,
    reference: &'a Body,
    /// The anchor's origin (from the reference body's centroid) and axes in world axes.
    carried: [Vec3; 3],
    sums: &'a Sums,
}

impl Geometry<'_> {
    /// The force on the incident body, and the moments on the incident and on the reference body.
    fn loads(&self) -> [Vec3; 3] {
        let Sums { pressure, shear } = self.sums;
        let force = self.pose.world(pressure.force, shear.force);
        let moment = self.pose.moment(self.sums);
        let about = |body: &Body| moment + (self.pose.origin - body.position).cross(&force);
        [force, about(self.incident), -about(self.reference)]
    }

    /// The change of force and moment on the incident and on the reference body as the incident body moves.
    fn change(&self, twist: &Twist, slopes: &SumSlopes) -> [Vec3; 4] {
        let (pose, sums) = (self.pose, self.sums);
        let Pose { origin, s, t, push, e1, e2, gap } = pose;
        let d_origin = twist.at(origin, self.incident);
        let (d_s, d_t) = (twist.turn.cross(s), twist.turn.cross(t));
        let d_gap = Gap { g0: d_origin.dot(push), gs: d_s.dot(push), gt: d_t.dot(push) };
        let q = s - push * gap.gs;
        let d_q = d_s - push * d_gap.gs;
        let d_e1 = (d_q - e1 * e1.dot(&d_q)) / q.norm();
        let d_e2 = d_e1.cross(push);
        let [carried_origin, carried_s, carried_t] = &self.carried;
        let since =
            |moved: Vec3, d_now: Vec3| [d_now.dot(e1) + moved.dot(&d_e1), d_now.dot(e2) + moved.dot(&d_e2)];
        let base = since(origin - self.reference.position - carried_origin, d_origin);
        let by_s = since(s - carried_s, d_s);
        let by_t = since(t - carried_t, d_t);
        let inputs = [d_gap.g0, d_gap.gs, d_gap.gt, base[0], base[1], by_s[0], by_s[1], by_t[0], by_t[1]];
        let normal = |row: usize| dot(&slopes.pressure[row], &inputs[..3]);
        let shear = |row: usize| [dot(&slopes.shear[row], &inputs), dot(&slopes.shear[row + 1], &inputs)];
        let turned = |f: [f64; 2]| d_e1 * f[0] + d_e2 * f[1];
        let Sums { pressure, shear: forces } = sums;
        let force = pose.world(pressure.force, forces.force);
        let d_force = turned(forces.force) + pose.world(normal(0), shear(0));
        let (along_s, along_t) =
            (pose.world(pressure.by_s, forces.by_s), pose.world(pressure.by_t, forces.by_t));
        let d_along_s = turned(forces.by_s) + pose.world(normal(1), shear(2));
        let d_along_t = turned(forces.by_t) + pose.world(normal(2), shear(4));
        let d_moment = d_s.cross(&along_s) + s.cross(&d_along_s) + d_t.cross(&along_t) + t.cross(&d_along_t);
        let about = |body: &Body, d_body: &Vec3| {
            d_moment + (d_origin - d_body).cross(&force) + (origin - body.position).cross(&d_force)
        };
        [d_force, about(self.incident, &twist.shift), -d_force, -about(self.reference, &Vec3::zeros())]
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (x, y)| sum + x * y)
}

/// Adds the slopes of points that all stick on a part that does not change with the gap: they have its moments.
fn add_sticking(ks: f64, part: &Moments, sum: &mut ShearSlopes) {
    let Moments { area, s, t, ss, st, tt } = *part;
    for (moment, row) in [[area, s, t], [s, ss, st], [t, st, tt]].into_iter().enumerate() {
        for (m, x) in row.into_iter().enumerate() {
            for k in 0..2 {
                sum[2 * moment + k][3 + 2 * m + k] -= ks * x;
            }
        }
    }
}

/// How the integrals 1, s, t, s^2, s t, t^2 over the compressed part of a cell change with the gap: minus those of them times
/// (1, s, t) along the cut, over the size of the gap's gradient.
fn cut_moments(cell: &Cell, gap: &Gap) -> MomentSlopes {
    let mut ends = [[0.0; 2]; 2];
    let mut found = 0;
    let corners = &cell.outline.vertices;
    for (k, to) in corners.iter().enumerate() {
        let from = &corners[(k + corners.len() - 1) % corners.len()];
        let (a, b) = (gap.at(from), gap.at(to));
        if (a <= 0.0) != (b <= 0.0) && found < 2 {
            let w = a / (a - b);
            ends[found] = [from[0] + w * (to[0] - from[0]), from[1] + w * (to[1] - from[1])];
            found += 1;
        }
    }
    if found < 2 {
        return MomentSlopes::default();
    }
    let [p, q] = ends;
    let length = ((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1])).sqrt();
    let weight = -length / (6.0 * (gap.gs * gap.gs + gap.gt * gap.gt).sqrt());
    let of = |[s, t]: [f64; 2]| [1.0, s, t, s * s, s * t, t * t];
    let middle = of([0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]);
    let (p, q) = (of(p), of(q));
    // Simpson's rule is exact for cubic functions.
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            weight * (p[row] * p[column] + 4.0 * middle[row] * middle[column] + q[row] * q[column])
        })
    })
}
