//! Joints: the one place where `contact` meets `law`. Persistent, with the shear history of every sub-contact.

mod force;
mod joint;
mod points;
mod pressure;
mod slopes;
#[cfg(test)]
mod tests;
mod viscous;

use std::collections::{BTreeMap, BTreeSet};

use crate::contact::{self, candidate_pairs, find_patch};
use crate::interrupt;
use crate::law::{Pressed, SubContact};
use crate::math::Vec3;
use crate::model::JointLaws;
use crate::solve::bodies::{Bodies, Body, Freedom};

pub use joint::Joint;
pub(in crate::solve) use joint::Place;
pub use slopes::Slopes;

/// What a joint starts a step from: what its sub-contacts remembered, and where its polygon lay on the reference body.
#[derive(Clone, Debug)]
pub struct Anchor {
    /// Origin and in-plane axes of the polygon in the reference body's axes.
    origin: Vec3,
    s: Vec3,
    t: Vec3,
    states: Vec<SubContact>,
}

/// All joints of an assembly.
#[derive(Clone, Debug, Default)]
pub struct Joints {
    /// Sorted by pair of bodies.
    pub all: Vec<Joint>,
    /// Joints whose blocks have come apart beyond the reach: what they remember must not heal when they meet again.
    parted: BTreeMap<(u32, u32), Joint>,
    /// Blocks that are gone.
    removed: BTreeSet<u32>,
    /// Whether contacts have been looked for before: only joints that were there at the start can hold.
    begun: bool,
    scratch: Vec<Pressed>,
}

impl Joints {
    /// Finds the joints of the bodies that have moved where they are now; those between two that have not stay as they are.
    /// Joints that were there before keep their law and their history: each new sub-contact takes the state of the nearest
    /// old one of the same pair.
    pub fn refresh(
        &mut self,
        bodies: &Bodies,
        laws: &dyn JointLaws,
        settings: &contact::Settings,
        moved: &[bool],
    ) {
        let shapes: Vec<_> = (0..bodies.all.len()).map(|i| bodies.touching_shape(i)).collect();
        let mut old: BTreeMap<(u32, u32), Joint> = self.all.drain(..).map(|j| (j.pair(), j)).collect();
        for (a, b) in candidate_pairs(&shapes, 2.0 * settings.reach) {
            let carrier = |block: u32| bodies.carriers[block as usize];
            let moves = |block: u32| bodies.all[carrier(block)].moves();
            let gone = |block: u32| self.removed.contains(&block) || bodies.is_merged(block as usize);
            let gone = gone(a) || gone(b);
            if gone || carrier(a) == carrier(b) || !(moves(a) || moves(b)) {
                continue;
            }
            if !moved[carrier(a)] && !moved[carrier(b)] {
                self.all.extend(old.remove(&(a, b)));
                continue;
            }
            // The ground is the preferred reference: the pressure then acts along its normal.
            let (first, second) = if is_ground(b, bodies) { (b, a) } else { (a, b) };
            let Some(patch) = find_patch(&shapes[first as usize], &shapes[second as usize], settings) else {
                continue;
            };
            let before = old.remove(&(a, b));
            let apart = self.parted.remove(&(a, b));
            let known = before.as_ref().or(apart.as_ref());
            let law = known.map_or_else(|| laws.of(a, b), |j| j.law);
            let mut joint = Joint::new(&patch, first, second, law, bodies, settings);
            match known {
                Some(known) => joint.inherit(known, bodies),
                None if self.begun => joint.meet(),
                None => joint.built(bodies, settings.closed),
            }
            if before.is_none() {
                joint.states.iter_mut().for_each(SubContact::forget_shear);
            }
            self.all.push(joint);
        }
        self.begun = true;
        // What holds does not end because its faces have come apart; the rest is kept in mind.
        for (pair, joint) in old {
            if joint.states.iter().any(|state| joint.law.holds(state)) {
                self.all.push(joint);
            } else {
                self.parted.insert(pair, joint);
            }
        }
        self.all.sort_by_key(Joint::pair);
    }

    /// Takes a block's joints away, and finds none for it from now on.
    pub fn remove(&mut self, block: u32) {
        let apart = |(a, b): (u32, u32)| a != block && b != block;
        self.all.retain(|joint| apart(joint.pair()));
        self.parted.retain(|pair, _| apart(*pair));
        self.removed.insert(block);
    }

    /// Leaves a share of the shear traction that sub-contacts remember; attachments by springs keep all.
    pub fn relax(&mut self, kept: f64) {
        for joint in self.all.iter_mut().filter(|joint| !joint.law.bonded) {
            for state in &mut joint.states {
                state.tau = state.tau.map(|tau| tau * kept);
            }
        }
    }

    /// Adds every joint's force to its two bodies; `dt` (s) is the length of the step that led here.
    pub fn apply(&mut self, bodies: &mut [Body], dt: f64) {
        interrupt::look();
        for joint in &mut self.all {
            joint.apply(bodies, dt, &mut self.scratch);
        }
    }

    /// The same with damping of `beta` (s) times the stiffness of each joint that touches.
    pub fn apply_damped(&mut self, bodies: &mut [Body], dt: f64, beta: f64) {
        interrupt::look();
        for joint in &mut self.all {
            joint.apply_damped(bodies, (dt, beta), &mut self.scratch);
        }
    }

    /// Whether no joint has borne anything yet.
    pub fn are_unloaded(&self) -> bool {
        self.all.iter().all(Joint::is_unloaded)
    }

    /// Whether a joint is soft until it has closed.
    pub fn close_softly(&self) -> bool {
        self.all.iter().any(|joint| joint.law.normal.softened(1.0).is_some())
    }

    /// What every joint starts its next step from.
    pub fn anchors(&self, bodies: &[Body]) -> Vec<Anchor> {
        self.all.iter().map(|joint| joint.anchor(bodies)).collect()
    }

    /// Adds every joint's force to its two bodies for a step of any length that started at the anchors, one per joint:
    /// each joint goes back to what it remembered there first, so that a step can be tried again and again.
    pub fn apply_since(&mut self, bodies: &mut [Body], anchors: &[Anchor]) {
        interrupt::look();
        for (joint, anchor) in self.all.iter_mut().zip(anchors) {
            joint.apply_since(bodies, anchor, &mut self.scratch);
        }
    }

    /// Hands out every joint's [`Slopes`] for a step that started at the anchors, by index; a joint without force has
    /// none. What the joints remember stays as it is.
    pub fn each_slope(&mut self, bodies: &[Body], anchors: &[Anchor], mut take: impl FnMut(usize, &Slopes)) {
        let unloaded = self.are_unloaded();
        for (index, (joint, anchor)) in self.all.iter().zip(anchors).enumerate() {
            if let Some(slopes) = joint.slopes(bodies, anchor, unloaded, &mut self.scratch) {
                take(index, &slopes);
            }
        }
    }

    /// Elastic energy stored in the closure of all joints (J) that are in contact or not as they stand now; with it the work that
    /// crushed them.
    pub fn closure_energy(&self, bodies: &[Body]) -> f64 {
        self.all.iter().map(|j| j.closure_energy(bodies)).sum()
    }
}

/// Whether a block is fixed, or fixed to a platform on springs.
fn is_ground(block: u32, bodies: &Bodies) -> bool {
    matches!(bodies.all[bodies.carriers[block as usize]].freedom, Freedom::Fixed | Freedom::Mounted)
}
