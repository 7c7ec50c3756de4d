//! Damping in proportion to a joint's stiffness, by a Maxwell branch beside the joint.
//!
//! A dashpot `beta K du/dt` alone would cut the explicit time step to a few hundredths: its force grows with the frequency, and joints ring
//! thousands of times faster than a wall sways. In series with a spring as stiff as the joint it is the same dashpot well below `1 / beta`,
//! and above that a spring; the critical step falls by the root of two (a Maxwell element; in the discrete element method tuned by the
//! frequencies that matter). With `F` the force of the joint, which is `K u` wherever it touches,
//!
//! ```text
//! dq/dt = dF/dt - q / beta        q(n) = q(n-1) e^-x + (F(n) - F(n-1)) (1 - e^-x) / x,    x = dt / beta
//! ```
//!
//! An open joint has no force and no branch. A joint that slides has none in its plane. The branch never pulls: with it the pressure is at
//! least zero.

use crate::law::Pressed;
use crate::math::exp;
use crate::solve::bodies::Body;
use crate::solve::joints::Joint;
use crate::solve::joints::force::{Sums, relative_motion};

/// A joint that bears so much of what friction and cohesion allow slides.
const SLIDES: f64 = 1.0 - 1e-6;

/// What the branch of a joint remembers: the joint's sums at the last step, and its own.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    before: Numbers,
    held: Numbers,
}

/// Pressure and its two moments; shear along both axes and its moments.
type Numbers = [f64; 9];

impl Joint {
    /// [`apply`](Joint::apply), with damping of `beta` (s) times the joint's stiffness.
    pub(super) fn apply_damped(
        &mut self,
        bodies: &mut [Body],
        (dt, beta): (f64, f64),
        scratch: &mut Vec<Pressed>,
    ) {
        let pose = self.pose(bodies);
        if self.is_wide_open(&pose.gap) {
            if self.force != 0.0 {
                self.let_go();
            }
            self.branch = None;
            return;
        }
        let (i, r) = (&bodies[self.incident as usize], &bodies[self.reference as usize]);
        let motion = relative_motion(i, r, &pose, dt);
        let mut sums = self.sums(&pose.gap, &motion, scratch);
        let [x, y] = sums.shear.force;
        let limit = self.law.cohesion * self.area() + self.law.tan_phi * sums.pressure.force.max(0.0);
        let slides = !self.law.bonded && (x * x + y * y).sqrt() >= SLIDES * limit;
        let now = numbers(&sums);
        // A joint that has just come to touch, or was looked for anew, begins without.
        let branch = self.branch.get_or_insert_with(|| Box::new(Branch { before: now, held: [0.0; 9] }));
        let x = dt / beta;
        let kept = exp(-x);
        let taken = if x > 0.0 { (1.0 - kept) / x } else { 1.0 };
        for (held, (now, before)) in branch.held.iter_mut().zip(now.iter().zip(&branch.before)) {
            *held = *held * kept + (now - before) * taken;
        }
        if slides {
            branch.held[3..].fill(0.0);
        }
        branch.before = now;
        // Where the branch would pull more than the joint presses it pulls as much.
        let pulls = -branch.held[0] > sums.pressure.force.max(0.0);
        if pulls && !self.law.bonded {
            let share = sums.pressure.force.max(0.0) / -branch.held[0];
            branch.held[..3].iter_mut().for_each(|held| *held *= share);
        }
        add_to(&mut sums, &branch.held);
        self.add(bodies, &pose, &sums);
    }
}

fn numbers(Sums { pressure, shear }: &Sums) -> Numbers {
    let [a, b] = shear.force;
    let ([c, d], [e, f]) = (shear.by_s, shear.by_t);
    [pressure.force, pressure.by_s, pressure.by_t, a, b, c, d, e, f]
}

fn add_to(Sums { pressure, shear }: &mut Sums, held: &Numbers) {
    pressure.force += held[0];
    pressure.by_s += held[1];
    pressure.by_t += held[2];
    for k in 0..2 {
        shear.force[k] += held[3 + k];
        shear.by_s[k] += held[5 + k];
        shear.by_t[k] += held[7 + k];
    }
}
