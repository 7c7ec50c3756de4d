//! Largest values over time, and what is followed of a joint.

use crate::math::Vec3;
use crate::protocol::base_motion::observe::Extreme;
use crate::solve::bodies::Bodies;
use crate::solve::joints::Joint;

/// Faces within this share of a joint's size (edge of the square of its area) touch, as far as slip is concerned.
const TOUCHES: f64 = 1e-4;

/// A largest value of what may fall: while it is on its way down only those from before count, unless it comes back.
#[derive(Clone, Copy, Default)]
pub(super) struct Tracked {
    seen: Extreme,
    kept: Extreme,
}

impl Tracked {
    pub fn grow(&mut self, value: f64, block: usize, at_s: f64) {
        if value > self.seen.value {
            self.seen = Extreme { value, block, at_s };
        }
    }

    pub fn is_carried(&mut self) {
        self.kept = self.seen;
    }
}

/// A joint as it was at rest: the two bodies; where its corners lie in their axes, and the normal in those of the second.
pub(super) struct Seam {
    pub bodies: [usize; 2],
    corners: Vec<[Vec3; 2]>,
    normal: Vec3,
    /// Gap (m) up to which it touches.
    touches: f64,
    pub uplift: Tracked,
    pub slip: Tracked,
}

impl Seam {
    /// As it is at rest.
    pub fn of(joint: &Joint, bodies: &Bodies) -> Seam {
        let both = [joint.incident as usize, joint.reference as usize];
        let own = |at: Vec3, body: usize| {
            let body = &bodies.all[body];
            body.rotation.tr_mul(&(at - body.position))
        };
        let corners = joint.corners(&bodies.all);
        let (_, normal) = joint.place(&bodies.all);
        Seam {
            bodies: both,
            corners: corners.into_iter().map(|(at, _)| both.map(|body| own(at, body))).collect(),
            normal: bodies.all[both[1]].rotation.tr_mul(&normal),
            touches: TOUCHES * joint.area().sqrt(),
            uplift: Tracked::default(),
            slip: Tracked::default(),
        }
    }

    /// Reads it at a time (s).
    pub fn read(&mut self, bodies: &Bodies, time: f64) {
        let [first, second] = self.bodies.map(|body| &bodies.all[body]);
        let normal = second.rotation * self.normal;
        for [own, other] in &self.corners {
            let apart = first.position + first.rotation * own - (second.position + second.rotation * other);
            let opening = apart.dot(&normal);
            self.uplift.grow(opening, self.bodies[0], time);
            if opening <= self.touches {
                self.slip.grow((apart - normal * opening).norm(), self.bodies[0], time);
            }
        }
    }
}

/// The largest of all values that count, the first of equal ones.
pub(super) fn largest<'t>(all: impl Iterator<Item = &'t Tracked>) -> Extreme {
    let larger = |a: Extreme, b: &Tracked| if b.kept.value > a.value { b.kept } else { a };
    all.fold(Extreme::default(), larger)
}
