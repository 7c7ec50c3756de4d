//! Newton's method with line search at fixed loads.

use crate::math::Vec3;
use crate::solve::Assembly;
use crate::solve::bodies::{Body, Freedom};
use crate::solve::implicit::Settings;
use crate::solve::implicit::loose::is_singular;
use crate::solve::joints::Anchor;
use crate::solve::system::{DOF, Kind, System, held};

/// A residual that falls to less than this share in a step needs no new matrix.
pub(super) const GOOD_CONTRACTION: f64 = 0.3;
/// A residual that does not even fall to this share with a matrix of its own counts as stuck.
pub(super) const POOR_CONTRACTION: f64 = 0.9;
/// Steps in a row that may be stuck.
const MOST_STUCK: u32 = 3;
/// What is added to a block's diagonal is at most this share of the stiffness that its weight takes off a wall that leans.
const HELD_BY_WEIGHT: f64 = 1e-4;
/// Largest unbalanced force ratio that passes for rounding: the explicit solver's own limit.
const MOST_ROUNDING: f64 = 1e-5;
/// Trial steps of a line search.
const TRIALS: u32 = 8;
/// Longest displacement of a corner of a block in one step, in reaches of the contact search.
const LONGEST_STEP: f64 = 10.0;

/// What a solve did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Steps taken.
    pub steps: u64,
    /// Matrices assembled and factorised.
    pub factorisations: u64,
    /// Of these, by Cholesky's method.
    pub symmetric: u64,
    /// Evaluations of the forces.
    pub evaluations: u64,
}

/// Newton's method on an assembly.
pub(super) struct Newton<'s, 'a> {
    pub assembly: &'s mut Assembly<'a>,
    pub system: &'s mut System,
    pub anchors: &'s [Anchor],
    pub settings: &'s Settings,
    pub effort: &'s mut Effort,
    /// Blocks that some motion was left free for when the matrix was last assembled.
    pub loose: &'s mut Vec<u32>,
}

impl Newton<'_, '_> {
    /// Steps until the residual is below its limit. Says whether it got there, and the unbalanced force ratio.
    ///
    /// A stable state is asked for. Steps with an old matrix that bring the residual down well show that the matrix has
    /// changed little, and so has its sign; where there was none to begin with, or more than one was needed, it is made
    /// again at the end.
    pub fn solve(&mut self, mut fresh: bool) -> (bool, f64) {
        let from_scratch = !fresh;
        let softly = self.assembly.joints.close_softly();
        let mut residual = self.residual();
        let mut ratio = self.assembly.unbalanced_ratio();
        let (mut spent, mut stuck) = (0, 0);
        while ratio.is_nan() || ratio >= self.settings.unbalanced_ratio.max(self.rounding()) {
            let own = !fresh;
            if own {
                let lost = spent == self.settings.max_factorisations || stuck > MOST_STUCK;
                if lost || self.factorise().is_none() {
                    return (false, ratio);
                }
                spent += 1;
            }
            let before = norm(&residual, &self.assembly.bodies.all);
            let step = self.direction(&residual);
            if !step.iter().all(|x| x.is_finite()) {
                return (false, f64::NAN);
            }
            // At a corner of the law, where sub-contacts stick on one side and slip on the other, the search gets no
            // further; the whole step leaps over it. Where joints close softly it would leap over the closure as well.
            residual = if stuck == 1 && !softly { self.leap(&step) } else { self.search(&step, &residual) };
            let after = norm(&residual, &self.assembly.bodies.all);
            ratio = self.assembly.unbalanced_ratio();
            self.effort.steps += 1;
            fresh = after < GOOD_CONTRACTION * before;
            stuck = if own && after > POOR_CONTRACTION * before { stuck + 1 } else { 0 };
        }
        let in_doubt = from_scratch || spent > 1 || !self.system.is_stable();
        (!in_doubt || (self.factorise().is_some() && self.system.is_stable()), ratio)
    }

    /// The unbalanced force ratio that rounding alone may leave: positions are known to a unit in their last place, and
    /// stiff joints make forces of that.
    pub(super) fn rounding(&self) -> f64 {
        let Assembly { bodies, joints, .. } = &*self.assembly;
        let furthest = bodies.all.iter().fold(0.0, |m: f64, b| m.max(b.position.amax() + b.radius));
        let (mut noise, mut carried) = (0.0, 0.0);
        for joint in joints.all.iter().filter(|joint| joint.force > 0.0) {
            noise += joint.law.normal.largest_stiffness() * joint.area() * f64::EPSILON * furthest;
            carried += joint.force;
        }
        let springs = self.assembly.ties().iter().map(|tie| tie.tie.stiffness);
        let platform =
            self.assembly.mounted().map_or(0.0, |m| m.mount.settlement + m.mount.rotation / furthest);
        noise += (springs.fold(0.0, |sum, k| sum + k) + platform) * f64::EPSILON * furthest;
        if carried > 0.0 { (noise / carried).min(MOST_ROUNDING) } else { 0.0 }
    }

    /// Assembles and factorises the matrix at the positions now.
    pub(super) fn factorise(&mut self) -> Option<Kind> {
        self.system.clear();
        for tie in self.assembly.ties() {
            let body = &self.assembly.bodies.all[tie.tie.body];
            self.system.add_own(tie.tie.body, &tie.stiffness(body, self.assembly.load_factor));
        }
        if let Some(mounted) = self.assembly.mounted() {
            self.system.add_diagonal(mounted.mount.body, mounted.stiffness());
        }
        let Assembly { bodies, joints, gravity, contact, .. } = &mut *self.assembly;
        let bodies = &bodies.all;
        let (mut slips, mut opens) = (false, false);
        joints.each_slope(bodies, self.anchors, |joint, slopes| {
            slips |= slopes.slips;
            opens |= slopes.opens;
            self.system.add_joint(joint, bodies, &slopes.stiffness);
        });
        self.loose.clear();
        for (index, body) in bodies.iter().enumerate().filter(|(_, body)| body.moves()) {
            let block = self.system.own_block(index);
            if is_singular(&block, |unknown| !held(body).contains(&unknown)) {
                self.loose.push(index as u32);
            }
            let largest = (0..3).fold(0.0, |m: f64, k| m.max(block[k][k]));
            // A block that has lost all its joints moves by half the reach under its weight.
            let fall = body.mass * gravity.norm() / (0.5 * contact.reach);
            // Stiff joints make a share of their stiffness outweigh what the wall itself loses of it by leaning.
            let leaning = HELD_BY_WEIGHT * body.mass * gravity.norm() / body.radius;
            let k = match largest > 0.0 {
                true => (self.settings.stabilisation * largest).min(leaning),
                false => fall.max(1.0),
            };
            let turning = k * body.gyration() * body.gyration();
            self.system.add_diagonal(index, [k, k, k, turning, turning, turning]);
        }
        for (index, body) in bodies.iter().enumerate() {
            for &unknown in held(body) {
                self.system.hold(index, unknown, 1.0);
            }
        }
        let kind = self.system.factorise(!slips && !opens)?;
        self.effort.factorisations += 1;
        self.effort.symmetric += u64::from(kind == Kind::Symmetric);
        Some(kind)
    }

    /// Unbalanced force and moment of every body.
    pub(super) fn residual(&mut self) -> Vec<f64> {
        self.effort.evaluations += 1;
        self.assembly.apply_loads();
        let Assembly { bodies, joints, .. } = &mut *self.assembly;
        joints.apply_since(&mut bodies.all, self.anchors);
        let mut residual = Vec::with_capacity(DOF * bodies.all.len());
        for body in &mut bodies.all {
            let start = residual.len();
            residual.extend(body.force.iter().chain(body.torque.iter()));
            for &unknown in held(body) {
                residual[start + unknown] = 0.0;
                match unknown {
                    0..3 => body.force[unknown] = 0.0,
                    _ => body.torque[unknown - 3] = 0.0,
                }
            }
        }
        residual
    }

    /// The Newton step, shortened where a block would move too far.
    fn direction(&self, residual: &[f64]) -> Vec<f64> {
        let mut step = self.system.solve(residual);
        let allowed = self.allowed(&step);
        if allowed < 1.0 {
            step.iter_mut().for_each(|x| *x *= allowed);
        }
        step
    }

    /// The share of a step that moves no block too far.
    pub(super) fn allowed(&self, step: &[f64]) -> f64 {
        let longest = step.chunks_exact(DOF).zip(&self.assembly.bodies.all).fold(0.0, |m: f64, (u, body)| {
            m.max(
                Vec3::from_column_slice(&u[..3]).norm()
                    + Vec3::from_column_slice(&u[3..]).norm() * body.radius,
            )
        });
        let allowed = LONGEST_STEP * self.assembly.contact.reach;
        if longest > allowed { allowed / longest } else { 1.0 }
    }

    /// Goes along a step as far as the residual still points along it; the residual there.
    fn search(&mut self, step: &[f64], residual: &[f64]) -> Vec<f64> {
        let start = self.assembly.bodies.all.clone();
        let at_start = dot(step, residual);
        let (mut low, mut high) = ((0.0, at_start), None::<(f64, f64)>);
        let mut share = 1.0;
        let mut found = Vec::new();
        for _ in 0..TRIALS {
            self.place(&start, step, share);
            found = self.residual();
            let slope = dot(step, &found);
            // NaN goes on searching.
            if slope.abs() <= 0.5 * at_start.abs() {
                break;
            }
            if slope > 0.0 && at_start > 0.0 {
                if high.is_none() {
                    // Still downhill at the full step.
                    break;
                }
                low = (share, slope);
            } else {
                high = Some((share, slope));
            }
            let (to, at_high) = high.unwrap_or((share, 0.0));
            let guess = low.0 + (to - low.0) * low.1 / (low.1 - at_high);
            let (from, width) = (low.0, to - low.0);
            share = if guess.is_finite() {
                guess.clamp(from + 0.1 * width, to - 0.1 * width)
            } else {
                0.5 * (from + to)
            };
        }
        found
    }

    /// Takes the whole step; the residual there.
    fn leap(&mut self, step: &[f64]) -> Vec<f64> {
        let start = self.assembly.bodies.all.clone();
        self.place(&start, step, 1.0);
        self.residual()
    }

    /// Puts every body where a share of a step takes it: along a screw, so that bodies that turn about one axis do not part.
    /// Straight shifts would tear them apart by half the square of the turn, which stiff joints answer by many times the
    /// weight.
    pub(super) fn place(&mut self, start: &[Body], step: &[f64], share: f64) {
        for ((body, from), u) in self.assembly.bodies.all.iter_mut().zip(start).zip(step.chunks_exact(DOF)) {
            if from.moves() {
                let shift = Vec3::from_column_slice(&u[..3]) * share;
                let turn = Vec3::from_column_slice(&u[3..]) * share;
                // A platform goes up and down alone.
                let shift = if from.freedom == Freedom::Mounted { shift } else { screwed(&shift, &turn) };
                body.place(from, &shift, &turn);
            }
        }
    }
}

/// The shift of a body whose centroid begins with a shift and turns with it: Cayley's transform of the screw, as
/// [`Body::place`] takes that of the turn, `(1 - [turn / 2])^-1 shift`.
fn screwed(shift: &Vec3, turn: &Vec3) -> Vec3 {
    let half = turn * 0.5;
    (shift + half.cross(shift) + half * half.dot(shift)) / (1.0 + half.norm_squared())
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (x, y)| sum + x * y)
}

/// Size of a residual: moments count as forces at the radius of gyration.
pub(super) fn norm(residual: &[f64], bodies: &[Body]) -> f64 {
    let square = residual.chunks_exact(DOF).zip(bodies).fold(0.0, |sum, (r, body)| {
        let gyration = body.gyration();
        let (force, moment) = (Vec3::from_column_slice(&r[..3]), Vec3::from_column_slice(&r[3..]));
        sum + force.norm_squared() + moment.norm_squared() / (gyration * gyration)
    });
    square.sqrt()
}
