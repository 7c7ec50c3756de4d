//! When a block has fallen: one rule for every solver and every load.
//!
//! A block has fallen where one of these holds, and does not come back:
//!
//! ```text
//! toppled   the vertical through its centroid misses the base on which it stood at rest: it has turned past its own unstable equilibrium.
//!           About an edge at b beside and h below the centroid that is a turn of atan(b / h).
//! left      it is lower, and what of its bearing is left is not under its centroid: it slid off, falls freely, or lies on something else.
//! ```
//!
//! Lower is counted from where its bearing would have it: what carries it may have sunk, and a soft joint closes. A thin wedge between soft joints
//! goes down by a good part of its height and has not fallen.
//!
//! The base is the hull of the joints that carried the body at rest, in its own axes: those that push upwards, or where it does not stand on these
//! alone, as in an arch or where a slab leans on a wall, all. Nothing here depends on the axes of the wall, on stones
//! elsewhere, or on the numbers of the stones. What rocks and comes back, and what slides without leaving its bearing, has not fallen.

use std::collections::BTreeMap;

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::observe::movable;
use crate::shape::{Frame, Hull};
use crate::solve::Assembly;
use crate::solve::bodies::{Bodies, Body};

/// A body that is lower by this share of the height of its centroid over its base has gone down a step: stones of one course differ by less, and
/// so does what elastic joints give way.
const STEP: f64 = 0.1;
/// A joint holds up where so much of its push is upwards: up to 84 deg from level.
const UPWARDS: f64 = 0.1;
/// A body stands on joints where it does so leant by this angle (rad) to any side. One that does not has no equilibrium of its own.
const STANDS: f64 = 1e-3;
/// What lies further round than a quarter turn (cosine of 96 deg against upright) does not turn back.
const ROLLED: f64 = -0.1;

/// What has become of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// Its bearing carries it.
    Carried,
    /// It has fallen if it does not come back.
    Falls,
    /// It has fallen for good: it is lower than it was at rest, which takes more than it had to rise to topple.
    Lies,
}

/// How the bodies of a wall were carried at rest.
pub struct Bearings {
    all: Vec<Carried>,
    up: Vec3,
    bodies: usize,
}

/// A body that was carried.
struct Carried {
    body: usize,
    bearings: Vec<Bearing>,
    /// Upwards at rest, in its own axes.
    up: Vec3,
    /// Height of its centroid at rest, and that over its base (m).
    height: f64,
    above: f64,
    /// Whether it stands on these.
    stands: bool,
}

/// A joint that carried a body.
struct Bearing {
    /// The body that carries.
    by: usize,
    /// The corners of the joint from the centroid (m), in the axes of the body that is carried.
    corners: Vec<Vec3>,
    /// A point and the normal of the face that carries, in the axes of its body.
    point: Vec3,
    normal: Vec3,
    /// Height of that point at rest (m).
    height: f64,
    /// By how much (m) the joint was pressed together at rest.
    pressed: f64,
    /// Axes in that face, and from where to where the body that carries reaches along them (m).
    along: [(Vec3, [f64; 2]); 2],
    /// Whether its push is upwards, so that its weight brings a body back that has parted from it.
    holds_up: bool,
}

impl Bearings {
    /// Of a wall at rest; `up` is the direction against gravity.
    pub fn of(wall: &Wall, at_rest: &Assembly<'_>, up: Vec3) -> Bearings {
        let bodies = &at_rest.bodies;
        let mut joints: BTreeMap<usize, Vec<Bearing>> =
            movable(wall).map(|(block, _)| (bodies.carriers[block], Vec::new())).collect();
        let closures = Now::of(at_rest);
        for joint in &at_rest.joints.all {
            let both = [joint.incident as usize, joint.reference as usize];
            let (_, push) = joint.place(&bodies.all);
            let corners: Vec<Vec3> = joint.corners(&bodies.all).into_iter().map(|(at, _)| at).collect();
            for ([body, by], normal) in [(both, push), ([both[1], both[0]], -push)] {
                if let Some(own) = joints.get_mut(&body) {
                    let pressed = closures.closure(body, by);
                    own.push(Bearing { pressed, ..Bearing::new(bodies, [body, by], &corners, normal, &up) });
                }
            }
        }
        let of = |(body, joints)| Carried::new(&bodies.all[body], body, joints, &up);
        Bearings { all: joints.into_iter().map(of).collect(), up, bodies: bodies.all.len() }
    }

    /// What has become of every body, by its id.
    pub fn fates(&self, wall: &Assembly<'_>) -> Vec<Fate> {
        let now = Now::of(wall);
        let mut fates = vec![Fate::Carried; self.bodies];
        // What a fallen body carried may have lost its bearing with it.
        loop {
            let mut more = false;
            for own in &self.all {
                if fates[own.body] == Fate::Carried && own.has_fallen(&now, &self.up, &fates) {
                    let lies = own.lies(&now, &self.up, &fates);
                    fates[own.body] = if lies { Fate::Lies } else { Fate::Falls };
                    more = true;
                }
            }
            if !more {
                return fates;
            }
        }
    }

    /// Whether a body has fallen of a wall that has come to rest again. What has moved by no more than the reach of the contact search rattles in
    /// its place.
    pub fn any_fell(&self, at_rest: &Assembly<'_>, again: &Assembly<'_>) -> bool {
        let strayed = |body: usize| {
            (again.bodies.all[body].position - at_rest.bodies.all[body].position).norm()
                > at_rest.contact.reach
        };
        self.fates(again).iter().enumerate().any(|(body, fate)| *fate != Fate::Carried && strayed(body))
    }
}

/// Whether a block of a wall has fallen that has come to rest again, on a platform whose axes are the wall's.
pub fn has_fallen(wall: &Wall, at_rest: &Assembly<'_>, again: &Assembly<'_>) -> bool {
    Bearings::of(wall, at_rest, Vec3::z()).any_fell(at_rest, again)
}

/// A wall at the time of a look.
struct Now<'n> {
    bodies: &'n Bodies,
    /// By how much (m) the joint of two bodies, the first one first, is pressed together where it is most.
    closures: BTreeMap<(usize, usize), f64>,
}

impl<'n> Now<'n> {
    fn of(wall: &'n Assembly<'_>) -> Now<'n> {
        let mut closures = BTreeMap::new();
        for joint in &wall.joints.all {
            let gaps = joint.corners(&wall.bodies.all).into_iter().map(|(_, gap)| -gap);
            let [a, b] = [joint.incident as usize, joint.reference as usize];
            let most: &mut f64 = closures.entry((a.min(b), a.max(b))).or_default();
            *most = gaps.fold(*most, f64::max);
        }
        Now { bodies: &wall.bodies, closures }
    }

    fn closure(&self, a: usize, b: usize) -> f64 {
        self.closures.get(&(a.min(b), a.max(b))).copied().unwrap_or(0.0)
    }
}

impl Carried {
    fn new(now: &Body, body: usize, joints: Vec<Bearing>, up: &Vec3) -> Carried {
        let lowest = joints.iter().flat_map(|joint| &joint.corners);
        let below = lowest.map(|corner| -(now.rotation * corner).dot(up)).fold(0.0, f64::max);
        let above = below.max(STEP * now.radius);
        let (height, own) = (now.position.dot(up), now.rotation.tr_mul(up));
        let mut carried = Carried { body, bearings: joints, up: own, height, above, stands: false };
        let stands = |which: fn(&Bearing) -> bool| carried.over(now, up, which) > STANDS * above;
        let [alone, held] = [stands(|joint| joint.holds_up), stands(|_| true)];
        // What stands on neither is kept by what holds it up, as far as there is any.
        let some = carried.bearings.iter().any(|joint| joint.holds_up);
        if alone || (!held && some) {
            carried.bearings.retain(|joint| joint.holds_up);
        }
        carried.stands = alone || held;
        carried
    }

    /// Distance (m) of the vertical through its centroid from the nearest side of its base, of such bearings; below 0 outside.
    fn over(&self, now: &Body, up: &Vec3, which: impl Fn(&Bearing) -> bool) -> f64 {
        let level = Frame::on_plane(Vec3::zeros(), *up);
        let corners = self.bearings.iter().filter(|bearing| which(bearing)).flat_map(|own| &own.corners);
        let seen = corners.map(|corner| {
            let from = now.rotation * corner;
            level.project(&from)
        });
        Hull::of(seen.collect()).depth([0.0, 0.0])
    }

    /// How far it has gone down (m) from where what carries it still would have it.
    fn down(&self, now: &Now<'_>, up: &Vec3, fates: &[Fate]) -> f64 {
        let carriers = self.bearings.iter().filter(|own| fates[own.by] == Fate::Carried);
        let sunk = carriers.map(|own| own.sunk(&now.bodies.all[own.by], up) + self.closed(own, now));
        self.height - now.bodies.all[self.body].position.dot(up) - sunk.fold(0.0, f64::max)
    }

    /// How far (m) its joint with what carries it has closed since it was at rest.
    fn closed(&self, bearing: &Bearing, now: &Now<'_>) -> f64 {
        (now.closure(self.body, bearing.by) - bearing.pressed).max(0.0)
    }

    /// Cosine of its turn from upright.
    fn upright(&self, now: &Body, up: &Vec3) -> f64 {
        (now.rotation * self.up).dot(up)
    }

    /// Whether it will not come back, if it has fallen.
    fn lies(&self, now: &Now<'_>, up: &Vec3, fates: &[Fate]) -> bool {
        self.down(now, up, fates) > STEP * self.above || self.upright(&now.bodies.all[self.body], up) < ROLLED
    }

    fn has_fallen(&self, wall: &Now<'_>, up: &Vec3, fates: &[Fate]) -> bool {
        let now = &wall.bodies.all[self.body];
        if self.stands && (self.upright(now, up) <= 0.0 || self.over(now, up, |_| true) < 0.0) {
            return true;
        }
        if self.down(wall, up, fates) <= STEP * self.above {
            return false;
        }
        let carries = |own: &Bearing| {
            let step = STEP * self.above + self.closed(own, wall);
            fates[own.by] == Fate::Carried && own.carries(now, &wall.bodies.all[own.by], step)
        };
        let left = self.bearings.iter().filter(|own| carries(own)).count();
        let has_lost = left < self.bearings.len() || !self.stands;
        left == 0 || (has_lost && self.over(now, up, carries) < 0.0)
    }
}

impl Bearing {
    fn new(bodies: &Bodies, [body, by]: [usize; 2], corners: &[Vec3], normal: Vec3, up: &Vec3) -> Bearing {
        let (own, other) = (&bodies.all[body], &bodies.all[by]);
        let into = |at: &Vec3, of: &Body| of.rotation.tr_mul(&(at - of.position));
        // Along the longest side of the joint and across, so that the axes turn with the wall.
        let sides = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(from, to)| to - from);
        let longest =
            sides.fold(Vec3::zeros(), |a, b| if b.norm_squared() > a.norm_squared() { b } else { a });
        let side = longest - normal * normal.dot(&longest);
        let first =
            if side.norm() > 0.0 { side.normalize() } else { Frame::on_plane(Vec3::zeros(), normal).s };
        let along = [first, normal.cross(&first)].map(|axis| {
            let axis = other.rotation.tr_mul(&axis);
            let parts = (0..bodies.shapes.len()).filter(|part| bodies.carriers[*part] == by);
            let reach = parts.flat_map(|part| &bodies.shapes[part].vertices).map(|vertex| vertex.dot(&axis));
            (axis, range(reach))
        });
        Bearing {
            by,
            point: corners.first().map_or_else(Vec3::zeros, |corner| into(corner, other)),
            height: corners.first().unwrap_or(&other.position).dot(up),
            pressed: 0.0,
            corners: corners.iter().map(|corner| into(corner, own)).collect(),
            normal: other.rotation.tr_mul(&normal),
            along,
            holds_up: normal.dot(up) > UPWARDS,
        }
    }

    /// How far (m) the face that carries has gone down.
    fn sunk(&self, by: &Body, up: &Vec3) -> f64 {
        self.height - (by.position + by.rotation * self.point).dot(up)
    }

    /// Whether the joint may carry still: over the body that carries, some of it is not below the face by more than a step; or at the face within a
    /// step, where it does not hold up.
    fn carries(&self, now: &Body, by: &Body, step: f64) -> bool {
        let corners: Vec<Vec3> = self
            .corners
            .iter()
            .map(|corner| by.rotation.tr_mul(&(now.position + now.rotation * corner - by.position)))
            .collect();
        let [nearest, furthest] = range(corners.iter().map(|at| (at - self.point).dot(&self.normal)));
        let over = |(axis, reach): &(Vec3, [f64; 2])| {
            let [low, high] = range(corners.iter().map(|at| at.dot(axis)));
            low < reach[1] && high > reach[0]
        };
        furthest >= -step && (self.holds_up || nearest <= step) && self.along.iter().all(over)
    }
}

/// Lowest and highest of numbers.
fn range(of: impl Iterator<Item = f64>) -> [f64; 2] {
    of.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}
