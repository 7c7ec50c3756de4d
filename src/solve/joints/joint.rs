//! One joint: its geometry in its bodies' own axes, where it is now, and what it takes over from its past.

use crate::contact::{self, Cell, Feature, Patch, area_shares, corners, distinct, divide};
use crate::law::{Coulomb, PATCHES_ALONG, Sampling, SubContact};
use crate::math::Vec3;
use crate::shape::{Moments, Polygon};
use crate::solve::bodies::{Bodies, Body};
use crate::solve::joints::points::{POINTS, Spread};
use crate::solve::joints::viscous::Branch;

/// A joint between two bodies, its geometry stored in the bodies' own axes.
#[derive(Clone, Debug)]
pub struct Joint {
    /// The two blocks, lower id first.
    blocks: (u32, u32),
    /// Body of the block whose face carries the polygon.
    pub incident: u32,
    /// Body of the block whose plane gives the direction of the pressure.
    pub reference: u32,
    /// The law.
    pub law: Coulomb,
    /// Origin and in-plane axes of the polygon in the incident body's axes.
    pub(super) origin: Vec3,
    pub(super) s: Vec3,
    pub(super) t: Vec3,
    /// A point of the reference plane and its outward normal in the reference body's axes.
    plane_point: Vec3,
    plane_normal: Vec3,
    /// Which features of the two blocks meet.
    pub feature: Feature,
    /// Distance (m) at which the faces begin to press; see [`contact::Settings::touch`].
    pub(super) touch: f64,
    /// Gap (m) with which they were built and count as touching; see [`contact::Settings::closed`].
    filled: f64,
    /// The polygon, and the integrals over it or over the patches of it that can touch.
    pub(in crate::solve) polygon: Polygon,
    pub(super) whole: Moments,
    /// Whether it bears on a few seats.
    pub(super) seated: bool,
    /// Sub-contacts.
    pub(super) cells: Vec<Cell>,
    /// Where the points of each lie when it is closed.
    pub(super) spreads: Vec<Spread>,
    /// What the points remember: [`Joint::points_each`] in a row for each sub-contact.
    pub(super) states: Vec<SubContact>,
    /// Size of the force at the last evaluation (N).
    pub force: f64,
    /// What damps it, if anything does and it touches.
    pub(super) branch: Option<Box<Branch>>,
    /// The force (N, world axes) on the incident body, where a solver found it that does not go by the joint's own law.
    pub(in crate::solve) given: Option<Vec3>,
}

/// A point at which a joint presses: where it lies in the joint's plane (m), its share of the area (m^2), how far it lies behind the face (m).
#[derive(Clone, Copy, Debug)]
pub(in crate::solve) struct Place {
    pub at: [f64; 2],
    pub area: f64,
    pub recess: f64,
}

impl Place {
    /// The gap there (m), where that of the faces is given.
    pub fn gap(&self, faces: &Gap) -> f64 {
        faces.at(&self.at) + self.recess
    }
}

/// The gap between incident face and reference plane, less the distance at which they begin to press, at plane
/// coordinates (s, t): `g0 + gs s + gt t` (m).
#[derive(Clone, Copy, Debug)]
pub(in crate::solve) struct Gap {
    pub g0: f64,
    pub gs: f64,
    pub gt: f64,
}

impl Gap {
    pub fn at(&self, v: &[f64; 2]) -> f64 {
        self.g0 + self.gs * v[0] + self.gt * v[1]
    }

    /// That of a sub-contact, which may lie behind the face.
    pub fn of(&self, cell: &Cell) -> Gap {
        Gap { g0: self.g0 + cell.recess, ..*self }
    }
}

/// Where the joint is in the world, at this step.
pub(in crate::solve) struct Pose {
    pub origin: Vec3,
    pub s: Vec3,
    pub t: Vec3,
    /// Outward normal of the reference plane: the direction in which it pushes the incident body.
    pub push: Vec3,
    /// In-plane axes of the shear traction: s projected onto the reference plane, and the one across.
    pub e1: Vec3,
    pub e2: Vec3,
    pub gap: Gap,
}

impl Joint {
    pub(super) fn new(
        patch: &Patch,
        first: u32,
        second: u32,
        law: Coulomb,
        bodies: &Bodies,
        settings: &contact::Settings,
    ) -> Self {
        let carrier = |block: u32| bodies.carriers[block as usize] as u32;
        let (incident, reference) = match patch.reference_is_second {
            true => (carrier(first), carrier(second)),
            false => (carrier(second), carrier(first)),
        };
        let (i, r) = (&bodies.all[incident as usize], &bodies.all[reference as usize]);
        let seats = match law.sampling {
            Sampling::Seats(seating) => patch.seats(seating.share, seating.laid(), f64::INFINITY),
            _ => None,
        };
        let seated = seats.is_some();
        let cells = seats.unwrap_or_else(|| match law.sampling {
            Sampling::Area | Sampling::Seats(_) => divide(&patch.polygon, settings.sub_contacts),
            Sampling::Vertices => corners(&patch.polygon),
            Sampling::Patches(mask) => patch.pieces(PATCHES_ALONG, mask),
        });
        let whole = match law.sampling {
            Sampling::Patches(_) => total(&cells),
            _ if seated => total(&cells),
            _ => patch.polygon.moments(),
        };
        let on_plane = patch.frame.origin - patch.plane.normal * patch.plane.distance(&patch.frame.origin);
        Joint {
            blocks: (first.min(second), first.max(second)),
            incident,
            reference,
            law,
            origin: i.rotation.tr_mul(&(patch.frame.origin - i.position)),
            s: i.rotation.tr_mul(&patch.frame.s),
            t: i.rotation.tr_mul(&patch.frame.t),
            plane_point: r.rotation.tr_mul(&(on_plane - r.position)),
            plane_normal: r.rotation.tr_mul(&patch.plane.normal),
            feature: patch.feature,
            touch: settings.touch,
            filled: 0.0,
            whole,
            polygon: patch.polygon.clone(),
            seated,
            states: vec![SubContact::default(); cells.len() * points_of(&law)],
            spreads: cells.iter().map(|cell| Spread::new(&cell.moments)).collect(),
            cells,
            force: 0.0,
            branch: None,
            given: None,
        }
    }

    /// A joint between blocks as they were built: a gap up to `closed` (m) is none, and across a wider one nothing ever attached them.
    pub(super) fn built(&mut self, bodies: &Bodies, closed: f64) {
        let gap = self.pose(&bodies.all).gap;
        let narrowest = self.polygon.vertices.iter().map(|v| gap.at(v)).fold(f64::INFINITY, f64::min);
        if narrowest > 0.0 {
            match narrowest + self.touch {
                apart if apart <= closed => self.filled = apart,
                _ => self.meet(),
            }
        }
        // What lies behind the face was never attached either.
        let each = self.points_each();
        if self.law.tension > 0.0 {
            for (cell, states) in self.cells.iter().zip(self.states.chunks_exact_mut(each)) {
                states.iter_mut().for_each(|state| state.broken |= cell.recess > closed);
            }
        }
    }

    /// A joint between blocks that met on the way: they touch, but nothing ever attached them.
    pub(super) fn meet(&mut self) {
        self.law.bonded = false;
        for state in &mut self.states {
            state.broken = self.law.tension > 0.0;
        }
    }

    /// Whether its blocks met on the way, so that what would hold them was never there.
    pub(in crate::solve) fn is_met(&self) -> bool {
        !self.states.is_empty() && self.states.iter().all(|state| state.broken)
    }

    /// Notes that it slips, all of it.
    pub(in crate::solve) fn slips(&mut self) {
        self.states.iter_mut().for_each(|state| state.slipped = true);
    }

    /// The two blocks, lower id first.
    pub fn pair(&self) -> (u32, u32) {
        self.blocks
    }

    /// Points of each sub-contact.
    pub(super) fn points_each(&self) -> usize {
        points_of(&self.law)
    }

    /// The points of all sub-contacts when they are closed.
    pub(in crate::solve) fn closed_points(&self) -> Vec<Place> {
        let mut all = Vec::with_capacity(self.states.len());
        for (cell, spread) in self.cells.iter().zip(&self.spreads) {
            let (area, recess) = (cell.moments.area, cell.recess);
            match self.points_each() {
                POINTS => all.extend(spread.places().map(|at| Place { at, area: 0.25 * area, recess })),
                _ => all.push(Place { at: cell.moments.centroid(), area, recess }),
            }
        }
        all
    }

    /// The corners of its patches with their shares of the area, where it bears on seats.
    pub(in crate::solve) fn seat_corners(&self) -> Option<Vec<Place>> {
        if !self.seated {
            return None;
        }
        let corners = self.cells.iter().flat_map(|cell| {
            let vertices = distinct(cell.outline.vertices.clone());
            let shares = area_shares(&vertices);
            vertices.into_iter().zip(shares).map(|(at, area)| Place { at, area, recess: cell.recess })
        });
        Some(corners.collect())
    }

    /// Takes over the history of the same pair's former joint, by nearness of the points.
    pub(super) fn inherit(&mut self, before: &Joint, bodies: &Bodies) {
        (self.force, self.filled) = (before.force, before.filled);
        let (now, then) = (self.pose(&bodies.all), before.pose(&bodies.all));
        // Traction is kept for the incident body; when the roles have changed, its reaction acts there.
        let sign = if self.incident == before.incident { 1.0 } else { -1.0 };
        self.given = before.given.map(|force| force * sign);
        let place = |pose: &Pose, [s, t]: [f64; 2]| pose.origin + pose.s * s + pose.t * t;
        let old: Vec<Vec3> = before.closed_points().into_iter().map(|point| place(&then, point.at)).collect();
        for (Place { at, area: whole, .. }, state) in self.closed_points().into_iter().zip(&mut self.states) {
            let here = place(&now, at);
            let nearest = old
                .iter()
                .enumerate()
                .map(|(k, p)| (k, (p - here).norm_squared()))
                .fold((0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
                .0;
            if let Some(from) = before.states.get(nearest) {
                let traction = (then.e1 * from.tau[0] + then.e2 * from.tau[1]) * sign;
                let area = if from.area > 0.0 { whole } else { 0.0 };
                *state = SubContact { tau: [traction.dot(&now.e1), traction.dot(&now.e2)], area, ..*from };
            }
        }
    }

    pub(in crate::solve) fn pose(&self, bodies: &[Body]) -> Pose {
        let (i, r) = (&bodies[self.incident as usize], &bodies[self.reference as usize]);
        let origin = i.position + i.rotation * self.origin;
        let (s, t) = (i.rotation * self.s, i.rotation * self.t);
        let push = r.rotation * self.plane_normal;
        let plane_point = r.position + r.rotation * self.plane_point;
        let e1 = (s - push * push.dot(&s)).normalize();
        let begins = self.touch + self.filled;
        let gap = Gap { g0: (origin - plane_point).dot(&push) - begins, gs: s.dot(&push), gt: t.dot(&push) };
        Pose { origin, s, t, push, e1, e2: e1.cross(&push), gap }
    }

    /// Largest gap over the joint (m); negative where all of it is pressed together.
    pub fn largest_gap(&self, bodies: &[Body]) -> f64 {
        let gap = self.pose(bodies).gap;
        self.polygon.vertices.iter().map(|v| gap.at(v)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The corners of the joint in world coordinates (m), each with its gap (m): negative where it is pressed.
    pub fn corners(&self, bodies: &[Body]) -> Vec<(Vec3, f64)> {
        let pose = self.pose(bodies);
        let corner = |v: &[f64; 2]| (pose.origin + pose.s * v[0] + pose.t * v[1], pose.gap.at(v));
        self.polygon.vertices.iter().map(corner).collect()
    }

    /// Share of the sub-contacts that have slipped at any time.
    pub fn slipped_share(&self) -> f64 {
        let slipped = self.states.iter().filter(|state| state.slipped).count();
        slipped as f64 / self.states.len().max(1) as f64
    }

    /// Whether some part of the joint touches, or holds.
    pub fn touches(&self, bodies: &[Body]) -> bool {
        !self.is_wide_open(&self.pose(bodies).gap)
    }

    /// Whether it carries no more than the trace of pressure with which faces that just touch begin.
    pub(super) fn is_unloaded(&self) -> bool {
        self.force <= 2.0 * self.law.normal.first_stiffness() * self.touch * self.whole.area
    }

    /// The area of the joint (m^2): of its polygon, or of the patches that can touch.
    pub fn area(&self) -> f64 {
        self.whole.area
    }

    /// Centroid of its area in world coordinates (m), and the direction of the pressure on the incident body.
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
            Sampling::Area | Sampling::Patches(_) | Sampling::Seats(_) => self.whole,
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

/// Points of a sub-contact at which shear is followed: small patches and corners have one.
fn points_of(law: &Coulomb) -> usize {
    match law.sampling {
        Sampling::Area | Sampling::Seats(_) => POINTS,
        Sampling::Vertices | Sampling::Patches(_) => 1,
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
