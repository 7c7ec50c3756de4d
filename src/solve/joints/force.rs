//! The forces of a joint: pressure integrated over the compressed part, shear by the law, both on the two bodies.

use crate::contact::Cell;
use crate::law::{Coulomb, Motion, NormalLaw, Pressed, Sampling, ShearSum, SubContact};
use crate::math::Vec3;
use crate::shape::Moments;
use crate::solve::bodies::Body;
use crate::solve::joints::joint::{Gap, Pose};
use crate::solve::joints::points::{POINTS, Spread};
use crate::solve::joints::pressure::{Bearing, PressureSum, closure_energy, compressed, linear, pressure};
use crate::solve::joints::{Anchor, Joint};

/// Pressure and shear summed over a joint: forces and their first moments in the plane.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub pressure: PressureSum,
    pub shear: ShearSum,
}

impl Joint {
    /// Adds the joint's force to its two bodies; `dt` (s) is the length of the step that led here.
    pub(super) fn apply(&mut self, bodies: &mut [Body], dt: f64, scratch: &mut Vec<Pressed>) {
        let pose = self.pose(bodies);
        if self.is_wide_open(&pose.gap) {
            if self.force != 0.0 {
                self.let_go();
            }
            return;
        }
        let (i, r) = (&bodies[self.incident as usize], &bodies[self.reference as usize]);
        let motion = relative_motion(i, r, &pose, dt);
        let sums = self.sums(&pose.gap, &motion, scratch);
        self.add(bodies, &pose, &sums);
    }

    /// Adds the joint's force to its two bodies for a step that started at the anchor.
    pub(super) fn apply_since(&mut self, bodies: &mut [Body], anchor: &Anchor, scratch: &mut Vec<Pressed>) {
        self.states.clone_from(&anchor.states);
        let pose = self.pose(bodies);
        if self.is_wide_open(&pose.gap) {
            self.let_go();
            return;
        }
        let motion = pose.motion_since(anchor, &bodies[self.reference as usize]);
        let sums = self.sums(&pose.gap, &motion, scratch);
        self.add(bodies, &pose, &sums);
    }

    /// The force (N, world axes) on the incident body as the joint stands, with the shear that it remembers; or as a solver of rigid
    /// blocks found it.
    pub fn carried(&self, bodies: &[Body]) -> Vec3 {
        if let Some(force) = self.given {
            return force;
        }
        let pose = self.pose(bodies);
        if self.is_wide_open(&pose.gap) {
            return Vec3::zeros();
        }
        // What is summed is remembered, and nothing that is only looked at may change.
        let sums = self.clone().sums(&pose.gap, &Motion::default(), &mut Vec::new());
        pose.world(sums.pressure.force, sums.shear.force)
    }

    /// What the next step starts from.
    pub(super) fn anchor(&self, bodies: &[Body]) -> Anchor {
        let pose = self.pose(bodies);
        let r = &bodies[self.reference as usize];
        Anchor {
            origin: r.rotation.tr_mul(&(pose.origin - r.position)),
            s: r.rotation.tr_mul(&pose.s),
            t: r.rotation.tr_mul(&pose.t),
            states: self.states.clone(),
        }
    }

    /// Whether no part of the joint touches or holds.
    pub(super) fn is_wide_open(&self, gap: &Gap) -> bool {
        let lowest = |vertices: &[[f64; 2]], gap: &Gap| {
            vertices.iter().map(|v| gap.at(v)).fold(f64::INFINITY, f64::min)
        };
        let lowest = if self.seated {
            let each = self.cells.iter().map(|cell| lowest(&cell.outline.vertices, &gap.of(cell)));
            each.fold(f64::INFINITY, f64::min)
        } else {
            lowest(&self.polygon.vertices, gap)
        };
        lowest > 0.0 && !self.states.iter().any(|s| self.law.holds(s))
    }

    /// An open joint forgets its shear and has no force.
    pub(super) fn let_go(&mut self) {
        self.states.iter_mut().for_each(SubContact::forget_shear);
        self.force = 0.0;
        self.given = None;
    }

    /// Pressure and shear over the joint; its sub-contacts remember the shear from now on.
    pub(super) fn sums(&mut self, gap: &Gap, motion: &Motion, scratch: &mut Vec<Pressed>) -> Sums {
        let pressure = self.press(gap, scratch);
        let shear = self.law.shear(&mut self.states, scratch, motion);
        Sums { pressure, shear }
    }

    /// Adds the force to both bodies.
    pub(super) fn add(&mut self, bodies: &mut [Body], pose: &Pose, sums: &Sums) {
        let force = pose.world(sums.pressure.force, sums.shear.force);
        let moment = pose.moment(sums);
        self.force = force.norm();
        let i = &mut bodies[self.incident as usize];
        i.torque += moment + (pose.origin - i.position).cross(&force);
        i.force += force;
        let r = &mut bodies[self.reference as usize];
        r.torque -= moment + (pose.origin - r.position).cross(&force);
        r.force -= force;
    }

    /// Integrates the pressure, and lists what presses on each sub-contact.
    pub(super) fn press(&mut self, gap: &Gap, pressed: &mut Vec<Pressed>) -> PressureSum {
        pressed.clear();
        let each = self.points_each();
        let highest = self.polygon.vertices.iter().map(|v| gap.at(v)).fold(f64::NEG_INFINITY, f64::max);
        let closed = highest <= 0.0 && self.cells.iter().all(|cell| cell.recess == 0.0);
        let mut sum = PressureSum::default();
        let bearing = Bearing::of(&self.law, &self.polygon, gap);
        if let (true, NormalLaw::Linear { kn }, None) =
            (closed && self.law.sampling != Sampling::Vertices, self.law.normal, bearing.crushing)
        {
            // All in compression: the whole polygon at once, and each cell's share.
            sum = linear(kn, &self.whole, gap);
            for (index, cell) in self.cells.iter().enumerate() {
                self.spread(index, &cell.moments, &linear(kn, &cell.moments, gap), pressed);
            }
            return sum;
        }
        for (index, cell) in self.cells.iter().enumerate() {
            let gap = &gap.of(cell);
            let states = &mut self.states[each * index..each * (index + 1)];
            if self.law.holds(&states[0]) && !self.law.bonded && tears(&self.law, cell, gap) {
                states.iter_mut().for_each(|state| state.broken = true);
            }
            let holds = self.law.holds(&states[0]);
            let part = if holds { cell.moments } else { compressed(cell, gap) };
            let share = pressure(&bearing, cell, &part, gap, holds);
            self.spread(index, &part, &share, pressed);
            sum.add(&share);
        }
        sum
    }

    /// Lists what presses at the points of a part of a sub-contact.
    fn spread(&self, index: usize, part: &Moments, share: &PressureSum, pressed: &mut Vec<Pressed>) {
        match self.points_each() {
            POINTS if part.area <= 0.0 => pressed.extend([Pressed::default(); POINTS]),
            POINTS => pressed.extend(self.spread_of(index, part).pressed(part.area, share)),
            _ => pressed.push(Pressed { at: part.centroid(), area: part.area, force: share.force }),
        }
    }

    /// Where the points of a part of a sub-contact lie; for all of it that is known.
    pub(super) fn spread_of(&self, index: usize, part: &Moments) -> Spread {
        match part.area < self.cells[index].moments.area {
            true => Spread::new(part),
            false => self.spreads[index],
        }
    }

    /// Share of the area in which it is crushed.
    pub fn crushed_share(&self, bodies: &[Body]) -> f64 {
        let gap = self.pose(bodies).gap;
        let bearing = Bearing::of(&self.law, &self.polygon, &gap);
        let crushed = self.cells.iter().filter_map(|cell| bearing.crushed(cell, &gap.of(cell)));
        crushed.map(|outline| outline.moments().area).sum::<f64>() / self.area()
    }

    pub(super) fn closure_energy(&self, bodies: &[Body]) -> f64 {
        let gap = self.pose(bodies).gap;
        let bearing = Bearing::of(&self.law, &self.polygon, &gap);
        let of = |(cell, states): (&Cell, &[SubContact])| {
            let holds = self.law.holds(&states[0]);
            let gap = gap.of(cell);
            let part = if holds { cell.moments } else { compressed(cell, &gap) };
            closure_energy(&bearing, cell, &part, &gap, holds)
        };
        self.cells.iter().zip(self.states.chunks_exact(self.points_each())).map(of).sum()
    }
}

/// Whether the largest tension on a sub-contact exceeds the tensile strength.
fn tears(law: &Coulomb, cell: &Cell, gap: &Gap) -> bool {
    let widest = if cell.outline.vertices.is_empty() {
        gap.at(&cell.moments.centroid())
    } else {
        cell.outline.vertices.iter().map(|v| gap.at(v)).fold(f64::NEG_INFINITY, f64::max)
    };
    -law.normal.stress(-widest) > law.tension
}

impl Pose {
    /// A force in world coordinates from its components along the pressure and the two axes of shear.
    pub(in crate::solve) fn world(&self, normal: f64, shear: [f64; 2]) -> Vec3 {
        self.push * normal + self.e1 * shear[0] + self.e2 * shear[1]
    }

    /// Moment of the joint's forces on the incident body about the origin of the polygon.
    pub(super) fn moment(&self, sums: &Sums) -> Vec3 {
        let Sums { pressure, shear } = sums;
        self.s.cross(&self.world(pressure.by_s, shear.by_s))
            + self.t.cross(&self.world(pressure.by_t, shear.by_t))
    }

    /// How the polygon has moved against the reference body since the anchor: points that lay on one another there
    /// are compared, so a pair that turns as a whole does not shear.
    pub(super) fn motion_since(&self, anchor: &Anchor, reference: &Body) -> Motion {
        let in_plane = |v: Vec3| [v.dot(&self.e1), v.dot(&self.e2)];
        let origin = reference.position + reference.rotation * anchor.origin;
        Motion {
            base: in_plane(self.origin - origin),
            by_s: in_plane(self.s - reference.rotation * anchor.s),
            by_t: in_plane(self.t - reference.rotation * anchor.t),
        }
    }
}

/// Shear displacement increments of the incident against the reference body over a step.
pub(super) fn relative_motion(i: &Body, r: &Body, pose: &Pose, dt: f64) -> Motion {
    let slip = i.velocity + i.spin.cross(&(pose.origin - i.position))
        - r.velocity
        - r.spin.cross(&(pose.origin - r.position));
    let turn = i.spin - r.spin;
    let in_plane = |v: Vec3| [v.dot(&pose.e1) * dt, v.dot(&pose.e2) * dt];
    Motion { base: in_plane(slip), by_s: in_plane(turn.cross(&pose.s)), by_t: in_plane(turn.cross(&pose.t)) }
}
