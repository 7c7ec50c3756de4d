//! The contact points of all joints, and what they remember from step to step.

use std::collections::{BTreeMap, BTreeSet};

use crate::contact::{Feature, area_shares, distinct, middle_line};
use crate::law::CohesionAfterSlip;
use crate::math::Vec3;
use crate::solve::bodies::Body;
use crate::solve::joints::{Joint, Joints, Place};
use crate::solve::nonsmooth::Normal;
use crate::solve::nonsmooth::point::{Bearing, Point, apart};
use crate::solve::nonsmooth::problem::{Inertia, inertia_along};

/// What a joint's points remember. They keep their places on the incident body for as long as the joint does.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    /// The two blocks of the joint.
    pair: (u32, u32),
    /// Where they lie, with their shares of the joint's area.
    places: Vec<Place>,
    /// Force of the last step (N), along normal and in-plane axes.
    pub forces: Vec<[f64; 3]>,
    /// Whether each has been torn off or, where cohesion is lost by it, has slipped.
    broken: Vec<bool>,
    slipped: Vec<bool>,
}

/// The contact points of an assembly.
#[derive(Clone, Debug, Default)]
pub(super) struct Contacts {
    /// By joint.
    pub memories: Vec<Memory>,
}

/// Where a point was, and what it remembered, in world coordinates.
struct Was {
    at: Vec3,
    force: Vec3,
    broken: bool,
    slipped: bool,
}

/// What a pair of blocks remembered: force on the body with this index.
pub(super) struct Past {
    incident: u32,
    points: Vec<Was>,
}

impl Contacts {
    /// What the joints remember, to be found again when contacts have been looked for anew.
    pub fn past(&self, joints: &Joints, bodies: &[Body]) -> BTreeMap<(u32, u32), Past> {
        let of = |(joint, memory): (&Joint, &Memory)| {
            let pose = joint.pose(bodies);
            let points = (0..memory.places.len())
                .map(|k| {
                    let [s, t] = memory.places[k].at;
                    let [n, a, b] = memory.forces[k];
                    Was {
                        at: pose.origin + pose.s * s + pose.t * t,
                        force: pose.world(n, [a, b]),
                        broken: memory.broken[k],
                        slipped: memory.slipped[k],
                    }
                })
                .collect();
            (joint.pair(), Past { incident: joint.incident, points })
        };
        joints.all.iter().zip(&self.memories).map(of).collect()
    }

    /// The points of the joints as they are. A point takes over what the nearest point of the same pair remembered.
    pub fn find(
        joints: &Joints,
        bodies: &[Body],
        normal: Normal,
        past: &BTreeMap<(u32, u32), Past>,
    ) -> Contacts {
        let of = |joint: &Joint| {
            let places = places(joint, normal);
            let n = places.len();
            let met = joint.is_met();
            // What was laid with a gap was never attached.
            let broken = places.iter().map(|place| met || place.recess > 0.0).collect();
            let mut memory = Memory {
                pair: joint.pair(),
                places,
                forces: vec![[0.0; 3]; n],
                broken,
                slipped: vec![false; n],
            };
            if let Some(past) = past.get(&joint.pair()) {
                memory.inherit(joint, bodies, past);
            }
            memory
        };
        Contacts { memories: joints.all.iter().map(of).collect() }
    }

    /// Forgets joints that are gone with blocks that were taken out.
    pub fn forget(&mut self, joints: &Joints) {
        if self.memories.len() > joints.all.len() {
            let left: BTreeSet<(u32, u32)> = joints.all.iter().map(Joint::pair).collect();
            self.memories.retain(|memory| left.contains(&memory.pair));
        }
    }

    /// How deep joints overlap at most where the bodies are (m).
    pub fn overlap(&self, joints: &Joints, bodies: &[Body]) -> f64 {
        let of = |(joint, memory): (&Joint, &Memory)| {
            let gap = joint.pose(bodies).gap;
            memory.places.iter().map(|place| -place.gap(&gap)).fold(0.0, f64::max)
        };
        joints.all.iter().zip(&self.memories).map(of).fold(0.0, f64::max)
    }

    /// The points of all joints in a step, where the bodies are now; by how much they turn until the bodies are half way. Joints bear for one
    /// time (s), and their gaps may close in another.
    pub fn points(
        &self,
        joints: &Joints,
        (now, half_way): (&[Body], &[Body]),
        inertias: &[Inertia],
        normal: Normal,
        (step, closes): (f64, f64),
    ) -> Vec<Point> {
        let mut points = Vec::new();
        for (index, (joint, memory)) in joints.all.iter().zip(&self.memories).enumerate() {
            let [pose, later] = [now, half_way].map(|bodies| joint.pose(bodies));
            let bodies = [joint.incident as usize, joint.reference as usize];
            let axes = [pose.push, pose.e1, pose.e2];
            let [i, r] = bodies.map(|body| now[body].twist());
            for (own, place) in memory.places.iter().enumerate() {
                let Place { at: [s, t], area, .. } = *place;
                let at = pose.origin + pose.s * s + pose.t * t;
                let arms = bodies.map(|body| at - now[body].position);
                let gap = place.gap(&pose.gap);
                let mut point = Point {
                    joint: index,
                    own,
                    bodies,
                    axes,
                    arms,
                    gap,
                    friction: 0.0,
                    cohesion: 0.0,
                    least: 0.0,
                    turns: [0.0; 3],
                    bearing: Bearing::Rigid { offset: 0.0 },
                    inertia: inertia_along(bodies.map(|body| &inertias[body]), &arms, &pose.push),
                };
                let moved = later.origin + later.s * s + later.t * t;
                let then = bodies.map(|body| moved - half_way[body].position);
                let [from, to] = [arms, then].map(|arms| apart(&arms, &i, &r));
                let turned = to - from;
                point.turns =
                    [later.push.dot(&to) - pose.push.dot(&from), pose.e1.dot(&turned), pose.e2.dot(&turned)];
                memory.strengthen(&mut point, joint, area, step);
                point.bearing = match normal {
                    Normal::Gap => Bearing::Rigid { offset: gap.max(0.0) / closes },
                    Normal::Velocity { restitution } => {
                        let closing = point.between(&i, &r)[0];
                        // Open now and half a step ahead: it does not touch in this step.
                        let is_open = gap > 0.0 && gap + 0.5 * step * closing > 0.0;
                        let offset = if is_open { f64::INFINITY } else { restitution * closing.min(0.0) };
                        Bearing::Rigid { offset }
                    }
                    Normal::Compliant => {
                        let [_, a, b] = memory.forces[own];
                        let shear_stiffness = joint.law.ks * area;
                        Bearing::Compliant {
                            law: joint.law.normal,
                            shear_stiffness,
                            shear: [a, b],
                            step,
                            gap,
                            area,
                        }
                    }
                };
                points.push(point);
            }
        }
        points
    }

    /// What the impulses (N s) of a step did to the points, which are in the order of [`points`](Contacts::points).
    pub fn remember(&mut self, joints: &mut Joints, points: &[Point], impulses: &[[f64; 3]], step: f64) {
        let mut sums = vec![Vec3::zeros(); joints.all.len()];
        for (point, impulse) in points.iter().zip(impulses) {
            let (joint, memory) = (&mut joints.all[point.joint], &mut self.memories[point.joint]);
            let force = impulse.map(|x| x / step);
            memory.forces[point.own] = force;
            (0..3).for_each(|k| sums[point.joint] += point.axes[k] * force[k]);
            if point.least < 0.0 && impulse[0] <= point.least {
                memory.broken[point.own] = true;
            }
            let shear = (impulse[1] * impulse[1] + impulse[2] * impulse[2]).sqrt();
            if impulse[0] > point.least && shear >= (point.cohesion + point.friction * impulse[0]) * SLIDES {
                memory.slipped[point.own] = true;
                joint.slips();
            }
        }
        for (joint, sum) in joints.all.iter_mut().zip(sums) {
            (joint.force, joint.given) = (sum.norm(), Some(sum));
        }
    }

    /// The impulses (N s) that the points start a step of length `step` (s) with.
    pub fn impulses(&self, points: &[Point], step: f64) -> Vec<[f64; 3]> {
        points
            .iter()
            .map(|point| self.memories[point.joint].forces[point.own].map(|force| force * step))
            .collect()
    }
}

/// A point that bears so much of what it can has slipped.
const SLIDES: f64 = 1.0 - 1e-9;

impl Memory {
    /// Takes over what the nearest points of the same pair remembered.
    fn inherit(&mut self, joint: &Joint, bodies: &[Body], past: &Past) {
        let pose = joint.pose(bodies);
        let sign = if past.incident == joint.incident { 1.0 } else { -1.0 };
        let mut taken = vec![0u32; past.points.len()];
        let nearest: Vec<Option<usize>> = self
            .places
            .iter()
            .map(|place| {
                let at = pose.origin + pose.s * place.at[0] + pose.t * place.at[1];
                let apart = |k: &usize| (past.points[*k].at - at).norm_squared();
                (0..past.points.len()).min_by(|a, b| apart(a).total_cmp(&apart(b)))
            })
            .collect();
        nearest.iter().flatten().for_each(|&k| taken[k] += 1);
        for (own, from) in nearest.into_iter().enumerate() {
            let Some(from) = from else { continue };
            let was = &past.points[from];
            // Points that share what one bore bear it together.
            let force = was.force * (sign / f64::from(taken[from]));
            self.forces[own] = [force.dot(&pose.push), force.dot(&pose.e1), force.dot(&pose.e2)];
            (self.broken[own], self.slipped[own]) = (was.broken, was.slipped);
        }
    }

    /// Sets what a point bears: friction, cohesion and tension of its share of the area.
    fn strengthen(&self, point: &mut Point, joint: &Joint, area: f64, step: f64) {
        let law = &joint.law;
        if law.bonded {
            (point.cohesion, point.least) = (f64::INFINITY, f64::NEG_INFINITY);
            return;
        }
        point.friction = law.tan_phi;
        let holds = !self.broken[point.own] && law.tension > 0.0;
        let lost = self.slipped[point.own] && law.cohesion_after_slip == CohesionAfterSlip::Lost;
        // A joint that is open has no area for cohesion to act on.
        let touches = point.gap <= 0.0 || holds;
        point.least = if holds { -step * law.tension * area } else { 0.0 };
        point.cohesion = if touches && !lost { step * law.cohesion * area } else { 0.0 };
    }
}

/// Where the points of a joint lie in its plane, and their shares of its area.
fn places(joint: &Joint, normal: Normal) -> Vec<Place> {
    if normal == Normal::Compliant {
        return joint.closed_points();
    }
    if let Some(corners) = joint.seat_corners() {
        return corners;
    }
    let (vertices, shares) = match joint.feature {
        Feature::Faces(..) => {
            let vertices = distinct(joint.polygon.vertices.clone());
            let shares = area_shares(&vertices);
            (vertices, shares)
        }
        // The strip or square that stands for a contact of edges and corners has a width for springs; rigid blocks touch along its
        // middle line or in its middle.
        Feature::Steep(..) | Feature::Edges(..) => {
            let vertices = distinct(middle_line(&joint.polygon).vertices);
            let shares = vec![joint.area() / vertices.len() as f64; vertices.len()];
            (vertices, shares)
        }
    };
    vertices.into_iter().zip(shares).map(|(at, area)| Place { at, area, recess: 0.0 }).collect()
}
