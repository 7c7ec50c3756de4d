//! Joints: the one place where `contact` meets `law`. Persistent, with the shear history of every sub-contact.

use std::collections::BTreeMap;

use crate::contact::{self, Cell, Patch, candidate_pairs, corners, divide, find_patch};
use crate::law::{Coulomb, Motion, NormalLaw, Pressed, Sampling, SubContact};
use crate::math::Vec3;
use crate::model::JointLaws;
use crate::shape::{Moments, Polygon};
use crate::solve::bodies::{Bodies, Body};

/// A joint between two bodies, its geometry stored in the bodies' own axes.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Body whose face carries the polygon.
    pub incident: u32,
    /// Body whose plane gives the direction of the pressure.
    pub reference: u32,
    /// The law.
    pub law: Coulomb,
    /// Origin and in-plane axes of the polygon in the incident body's axes.
    origin: Vec3,
    s: Vec3,
    t: Vec3,
    /// A point of the reference plane and its outward normal in the reference body's axes.
    plane_point: Vec3,
    plane_normal: Vec3,
    /// Gap (m) up to which the faces touch; see [`contact::Settings::touch`].
    touch: f64,
    /// The polygon, and its integrals.
    polygon: Polygon,
    whole: Moments,
    /// Sub-contacts, and what they remember.
    cells: Vec<Cell>,
    states: Vec<SubContact>,
    /// Size of the force at the last evaluation (N).
    pub force: f64,
}

/// The gap between incident face and reference plane at plane coordinates (s, t): `g0 + gs s + gt t` (m).
#[derive(Clone, Copy, Debug)]
struct Gap {
    g0: f64,
    gs: f64,
    gt: f64,
}

impl Gap {
    fn at(&self, v: &[f64; 2]) -> f64 {
        self.g0 + self.gs * v[0] + self.gt * v[1]
    }
}

/// Pressure integrated over a joint: the force and its first moments in the plane.
#[derive(Clone, Copy, Debug, Default)]
struct PressureSum {
    force: f64,
    by_s: f64,
    by_t: f64,
}

/// Where the joint is in the world, at this step.
struct Pose {
    origin: Vec3,
    s: Vec3,
    t: Vec3,
    /// Outward normal of the reference plane: the direction in which it pushes the incident body.
    push: Vec3,
    /// In-plane axes of the shear traction: s projected onto the reference plane, and the one across.
    e1: Vec3,
    e2: Vec3,
    gap: Gap,
}

/// All joints of an assembly.
#[derive(Clone, Debug, Default)]
pub struct Joints {
    /// Sorted by pair of bodies.
    pub all: Vec<Joint>,
    /// Joints whose blocks have come apart beyond the reach: what they remember must not heal when they meet again.
    parted: BTreeMap<(u32, u32), Joint>,
    /// Whether contacts have been looked for before: only joints that were there at the start can hold.
    begun: bool,
    scratch: Vec<Pressed>,
}

impl Joints {
    /// Finds all joints of the bodies where they are now. Joints that were there before keep their law and their
    /// history: each new sub-contact takes the state of the nearest old one of the same pair.
    pub fn refresh(&mut self, bodies: &Bodies, laws: &dyn JointLaws, settings: &contact::Settings) {
        let shapes: Vec<_> = (0..bodies.all.len()).map(|i| bodies.world_shape(i)).collect();
        let mut old: BTreeMap<(u32, u32), Joint> = self.all.drain(..).map(|j| (j.pair(), j)).collect();
        for (a, b) in candidate_pairs(&shapes, 2.0 * settings.reach) {
            if !bodies.all[a as usize].moves() && !bodies.all[b as usize].moves() {
                continue;
            }
            // What is fixed is the preferred reference: the pressure then acts along the normal of the ground.
            let (first, second) = if bodies.all[b as usize].moves() { (a, b) } else { (b, a) };
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
                None => {}
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

    /// Adds every joint's force to its two bodies; `dt` (s) is the length of the step that led here.
    pub fn apply(&mut self, bodies: &mut [Body], dt: f64) {
        for joint in &mut self.all {
            joint.apply(bodies, dt, &mut self.scratch);
        }
    }

    /// Elastic energy stored in the closure of all joints (J), for linear joints that are in contact or not as they
    /// stand now.
    pub fn closure_energy(&self, bodies: &[Body]) -> f64 {
        self.all.iter().map(|j| j.closure_energy(bodies)).sum()
    }
}

impl Joint {
    fn new(
        patch: &Patch,
        first: u32,
        second: u32,
        law: Coulomb,
        bodies: &Bodies,
        settings: &contact::Settings,
    ) -> Self {
        let (incident, reference) = if patch.reference_is_second { (first, second) } else { (second, first) };
        let (i, r) = (&bodies.all[incident as usize], &bodies.all[reference as usize]);
        let cells = match law.sampling {
            Sampling::Area => divide(&patch.polygon, settings.sub_contacts),
            Sampling::Vertices => corners(&patch.polygon),
        };
        let on_plane = patch.frame.origin - patch.plane.normal * patch.plane.distance(&patch.frame.origin);
        Joint {
            incident,
            reference,
            law,
            origin: i.rotation.tr_mul(&(patch.frame.origin - i.position)),
            s: i.rotation.tr_mul(&patch.frame.s),
            t: i.rotation.tr_mul(&patch.frame.t),
            plane_point: r.rotation.tr_mul(&(on_plane - r.position)),
            plane_normal: r.rotation.tr_mul(&patch.plane.normal),
            touch: settings.touch,
            whole: patch.polygon.moments(),
            polygon: patch.polygon.clone(),
            states: vec![SubContact::default(); cells.len()],
            cells,
            force: 0.0,
        }
    }

    /// A joint between blocks that met on the way: they touch, but nothing ever attached them.
    fn meet(&mut self) {
        self.law.bonded = false;
        for state in &mut self.states {
            state.broken = self.law.tension > 0.0;
        }
    }

    /// The two bodies, lower id first.
    pub fn pair(&self) -> (u32, u32) {
        (self.incident.min(self.reference), self.incident.max(self.reference))
    }

    /// Takes over the history of the same pair's former joint, by nearness of the sub-contacts.
    fn inherit(&mut self, before: &Joint, bodies: &Bodies) {
        self.force = before.force;
        let (now, then) = (self.pose(&bodies.all), before.pose(&bodies.all));
        // Traction is kept for the incident body; when the roles have changed, its reaction acts there.
        let sign = if self.incident == before.incident { 1.0 } else { -1.0 };
        let place = |pose: &Pose, cell: &Cell| {
            let [s, t] = cell.moments.centroid();
            pose.origin + pose.s * s + pose.t * t
        };
        let old: Vec<Vec3> = before.cells.iter().map(|c| place(&then, c)).collect();
        for (cell, state) in self.cells.iter().zip(&mut self.states) {
            let here = place(&now, cell);
            let nearest = old
                .iter()
                .enumerate()
                .map(|(k, p)| (k, (p - here).norm_squared()))
                .fold((0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
                .0;
            if let Some(from) = before.states.get(nearest) {
                let traction = (then.e1 * from.tau[0] + then.e2 * from.tau[1]) * sign;
                let area = if from.area > 0.0 { cell.moments.area } else { 0.0 };
                *state = SubContact { tau: [traction.dot(&now.e1), traction.dot(&now.e2)], area, ..*from };
            }
        }
    }

    fn pose(&self, bodies: &[Body]) -> Pose {
        let (i, r) = (&bodies[self.incident as usize], &bodies[self.reference as usize]);
        let origin = i.position + i.rotation * self.origin;
        let (s, t) = (i.rotation * self.s, i.rotation * self.t);
        let push = r.rotation * self.plane_normal;
        let plane_point = r.position + r.rotation * self.plane_point;
        let e1 = (s - push * push.dot(&s)).normalize();
        let gap = Gap { g0: (origin - plane_point).dot(&push), gs: s.dot(&push), gt: t.dot(&push) };
        Pose { origin, s, t, push, e1, e2: e1.cross(&push), gap }
    }

    fn apply(&mut self, bodies: &mut [Body], dt: f64, scratch: &mut Vec<Pressed>) {
        let pose = self.pose(bodies);
        let highest = self.polygon.vertices.iter().map(|v| pose.gap.at(v)).fold(f64::NEG_INFINITY, f64::max);
        let lowest = self.polygon.vertices.iter().map(|v| pose.gap.at(v)).fold(f64::INFINITY, f64::min);
        if lowest > self.touch && !self.states.iter().any(|s| self.law.holds(s)) {
            // Wide open: forget the shear, no force.
            if self.force != 0.0 {
                self.states.iter_mut().for_each(SubContact::forget_shear);
                self.force = 0.0;
            }
            return;
        }
        let pressure = self.press(&pose.gap, highest <= self.touch, scratch);
        let (i, r) = (&bodies[self.incident as usize], &bodies[self.reference as usize]);
        let motion = relative_motion(i, r, &pose, dt);
        let shear = self.law.shear(&mut self.states, scratch, &motion);
        let world = |n: f64, f: [f64; 2]| pose.push * n + pose.e1 * f[0] + pose.e2 * f[1];
        let force = world(pressure.force, shear.force);
        let moment =
            pose.s.cross(&world(pressure.by_s, shear.by_s)) + pose.t.cross(&world(pressure.by_t, shear.by_t));
        self.force = force.norm();
        let i = &mut bodies[self.incident as usize];
        i.torque += moment + (pose.origin - i.position).cross(&force);
        i.force += force;
        let r = &mut bodies[self.reference as usize];
        r.torque -= moment + (pose.origin - r.position).cross(&force);
        r.force -= force;
    }

    /// Integrates the pressure, and lists what presses on each sub-contact.
    fn press(&mut self, gap: &Gap, closed: bool, pressed: &mut Vec<Pressed>) -> PressureSum {
        pressed.clear();
        let mut sum = PressureSum::default();
        if closed && self.law.sampling == Sampling::Area {
            // All in compression: the whole polygon at once, and each cell's share.
            sum = pressure(&self.law.normal, &self.whole, gap);
            for cell in &self.cells {
                let at = cell.moments.centroid();
                let force = self.law.normal.stress(-gap.at(&at)) * cell.moments.area;
                pressed.push(Pressed { at, area: cell.moments.area, force });
            }
            return sum;
        }
        for (cell, state) in self.cells.iter().zip(&mut self.states) {
            if self.law.holds(state) && !self.law.bonded && tears(&self.law, cell, gap) {
                state.broken = true;
            }
            let part = if self.law.holds(state) { cell.moments } else { compressed(cell, gap, self.touch) };
            let share = pressure(&self.law.normal, &part, gap);
            pressed.push(Pressed { at: part.centroid(), area: part.area, force: share.force });
            sum.force += share.force;
            sum.by_s += share.by_s;
            sum.by_t += share.by_t;
        }
        sum
    }

    fn closure_energy(&self, bodies: &[Body]) -> f64 {
        let gap = self.pose(bodies).gap;
        let NormalLaw::Linear { kn } = self.law.normal;
        self.cells
            .iter()
            .zip(&self.states)
            .map(|(cell, state)| {
                let m = if self.law.holds(state) { cell.moments } else { compressed(cell, &gap, self.touch) };
                let Gap { g0, gs, gt } = gap;
                let square = g0 * g0 * m.area
                    + 2.0 * g0 * (gs * m.s + gt * m.t)
                    + gs * gs * m.ss
                    + 2.0 * gs * gt * m.st
                    + gt * gt * m.tt;
                0.5 * kn * square
            })
            .sum()
    }

    /// Largest gap over the joint (m); negative where all of it is pressed together.
    pub fn largest_gap(&self, bodies: &[Body]) -> f64 {
        let gap = self.pose(bodies).gap;
        self.polygon.vertices.iter().map(|v| gap.at(v)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Share of the sub-contacts that have slipped at any time.
    pub fn slipped_share(&self) -> f64 {
        let slipped = self.states.iter().filter(|state| state.slipped).count();
        slipped as f64 / self.states.len().max(1) as f64
    }

    /// The area of the joint's polygon (m^2).
    pub fn area(&self) -> f64 {
        self.whole.area
    }

    /// Centroid of the polygon in world coordinates (m), and the direction of the pressure on the incident body.
    pub fn place(&self, bodies: &[Body]) -> (Vec3, Vec3) {
        let pose = self.pose(bodies);
        let [s, t] = self.whole.centroid();
        (pose.origin + pose.s * s + pose.t * t, pose.push)
    }

    /// Two levers in the joint's plane (m), in world coordinates: an area lumped in quarters at plus and minus each sum
    /// and difference of them has the second moments of the joint's sub-contacts about its centroid, which is where
    /// its rotational stiffness comes from. With them the two in-plane axes.
    pub fn levers(&self, bodies: &[Body]) -> [(Vec3, Vec3); 2] {
        let pose = self.pose(bodies);
        let m = match self.law.sampling {
            Sampling::Area => self.whole,
            Sampling::Vertices => total(&self.cells),
        };
        let (ss, st, tt) = (m.ss - m.s * m.s / m.area, m.st - m.s * m.t / m.area, m.tt - m.t * m.t / m.area);
        // Columns of the Cholesky factor of the second moments per area.
        let first = (ss / m.area).sqrt();
        let across = if first > 0.0 { st / m.area / first } else { 0.0 };
        let second = (tt / m.area - across * across).max(0.0).sqrt();
        [(pose.s * first + pose.t * across, pose.e1), (pose.t * second, pose.e2)]
    }
}

/// Integrals over all sub-contacts.
fn total(cells: &[Cell]) -> Moments {
    cells.iter().fold(Moments::default(), |sum, cell| {
        let m = &cell.moments;
        Moments {
            area: sum.area + m.area,
            s: sum.s + m.s,
            t: sum.t + m.t,
            ss: sum.ss + m.ss,
            st: sum.st + m.st,
            tt: sum.tt + m.tt,
        }
    })
}

/// Integrates the normal law over an area with the given integrals; exact for the linear law.
fn pressure(law: &NormalLaw, m: &Moments, gap: &Gap) -> PressureSum {
    let Gap { g0, gs, gt } = *gap;
    match law {
        NormalLaw::Linear { kn } => PressureSum {
            force: -kn * (g0 * m.area + gs * m.s + gt * m.t),
            by_s: -kn * (g0 * m.s + gs * m.ss + gt * m.st),
            by_t: -kn * (g0 * m.t + gs * m.st + gt * m.tt),
        },
    }
}

/// The part of a sub-contact in compression, by clipping it at zero gap (at `touch`, which is zero but for rounding);
/// a point is in or out as a whole.
fn compressed(cell: &Cell, gap: &Gap, touch: f64) -> Moments {
    if cell.outline.vertices.is_empty() {
        return if gap.at(&cell.moments.centroid()) <= touch { cell.moments } else { Moments::default() };
    }
    let open = cell.outline.vertices.iter().filter(|v| gap.at(v) > touch).count();
    if open == 0 {
        cell.moments
    } else if open == cell.outline.vertices.len() {
        Moments::default()
    } else {
        cell.outline.clip(gap.g0 - touch, gap.gs, gap.gt).moments()
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

/// Shear displacement increments of the incident against the reference body over a step.
fn relative_motion(i: &Body, r: &Body, pose: &Pose, dt: f64) -> Motion {
    let slip = i.velocity + i.spin.cross(&(pose.origin - i.position))
        - r.velocity
        - r.spin.cross(&(pose.origin - r.position));
    let turn = i.spin - r.spin;
    let in_plane = |v: Vec3| [v.dot(&pose.e1) * dt, v.dot(&pose.e2) * dt];
    Motion { base: in_plane(slip), by_s: in_plane(turn.cross(&pose.s)), by_t: in_plane(turn.cross(&pose.t)) }
}
