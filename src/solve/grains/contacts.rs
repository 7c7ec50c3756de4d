//! The contacts: sorted lists of neighbours, each with the springs and the shear that it remembers.

use crate::interrupt;
use crate::law::{Frictional, SphereSpring};
use crate::math::Vec3;
use crate::shape::Plane;
use crate::solve::bodies::Body;
use crate::solve::grains::heap::Spheres;
use crate::solve::grains::neighbours::Neighbours;

/// A sphere beside another sphere or a plane.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// The sphere; the first one of a pair.
    pub sphere: u32,
    /// The second sphere of a pair, or the plane.
    pub other: u32,
    /// Stiffnesses and friction.
    pub spring: SphereSpring,
    /// Shear force on the second sphere, or on the sphere at a plane (N); none while open.
    shear: Vec3,
    /// Closure (m), 0 while open.
    closure: f64,
    /// Size of the force (N), 0 while open.
    force: f64,
}

/// All contacts that there may be until neighbours are looked for anew.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    /// Between spheres of different bodies, sorted by the two spheres; the smaller number first.
    pub pairs: Vec<Contact>,
    /// Of spheres with planes, sorted by sphere and plane.
    pub seats: Vec<Contact>,
    neighbours: Neighbours,
    /// The lists of before, kept for their memory.
    before: Vec<Contact>,
}

impl Contact {
    fn new([sphere, other]: [u32; 2], spring: SphereSpring) -> Contact {
        Contact { sphere, other, spring, shear: Vec3::zeros(), closure: 0.0, force: 0.0 }
    }

    /// An open contact forgets its shear, and starts from none when it closes again.
    fn open(&mut self) {
        (self.shear, self.closure, self.force) = (Vec3::zeros(), 0.0, 0.0);
    }

    /// The force (N) on the second sphere, or on the sphere at a plane, for a closure (m) along `normal` towards it.
    fn close(&mut self, closure: f64, normal: &Vec3, slip: &Vec3, twist: f64) -> Vec3 {
        let force = self.spring.force(&mut self.shear, closure, normal, slip, twist);
        self.closure = closure;
        self.force = force.norm();
        force
    }
}

impl Contacts {
    /// Sizes of the forces (N) of the contacts that carry.
    pub fn carrying(&self) -> impl Iterator<Item = f64> + '_ {
        self.pairs.iter().chain(&self.seats).map(|c| c.force).filter(|force| *force > 0.0)
    }

    /// Energy stored in the springs (J).
    pub fn stored_energy(&self) -> f64 {
        self.pairs.iter().chain(&self.seats).map(|c| c.spring.energy(&c.shear, c.closure)).sum()
    }

    /// Adds the forces of all contacts to the bodies; `dt` is the length of the step (s) that led to the positions now.
    pub fn apply(&mut self, bodies: &mut [Body], spheres: &Spheres, planes: &[Plane], dt: f64) {
        interrupt::look();
        for contact in &mut self.pairs {
            let (i, j) = (contact.sphere as usize, contact.other as usize);
            let from = spheres.centre[i];
            let along = spheres.centre[j] - from;
            let reach = spheres.radius[i] + spheres.radius[j];
            let square = along.norm_squared();
            if square >= reach * reach {
                if contact.force > 0.0 {
                    contact.open();
                }
                continue;
            }
            let distance = square.sqrt();
            let (closure, normal) = (reach - distance, along / distance);
            let at = from + normal * (spheres.radius[i] - 0.5 * closure);
            let (a, b) = (&bodies[spheres.body[i] as usize], &bodies[spheres.body[j] as usize]);
            let (lever_a, lever_b) = (at - a.position, at - b.position);
            let slip = (b.velocity + b.spin.cross(&lever_b) - a.velocity - a.spin.cross(&lever_a)) * dt;
            let twist = 0.5 * dt * (a.spin + b.spin).dot(&normal);
            let force = contact.close(closure, &normal, &slip, twist);
            let b = &mut bodies[spheres.body[j] as usize];
            b.force += force;
            b.torque += lever_b.cross(&force);
            let a = &mut bodies[spheres.body[i] as usize];
            a.force -= force;
            a.torque -= lever_a.cross(&force);
        }
        for contact in &mut self.seats {
            let (i, plane) = (contact.sphere as usize, &planes[contact.other as usize]);
            let closure = spheres.radius[i] - plane.distance(&spheres.centre[i]);
            if closure <= 0.0 {
                contact.open();
                continue;
            }
            let normal = plane.normal;
            let body = &mut bodies[spheres.body[i] as usize];
            let at = spheres.centre[i] - normal * (spheres.radius[i] - 0.5 * closure);
            let lever = at - body.position;
            let slip = (body.velocity + body.spin.cross(&lever)) * dt;
            let force = contact.close(closure, &normal, &slip, 0.5 * dt * body.spin.dot(&normal));
            body.force += force;
            body.torque += lever.cross(&force);
        }
    }

    /// Lists the neighbours that are up to `skin` (m) beyond touching; those listed before keep what they remember.
    pub fn refresh(
        &mut self,
        spheres: &Spheres,
        materials: &[Frictional],
        planes: &[Plane],
        plane_material: &Frictional,
        skin: f64,
    ) {
        let material = |sphere: u32| &materials[spheres.body[sphere as usize] as usize];
        let radius = |sphere: u32| spheres.radius[sphere as usize];
        self.neighbours.look(spheres, planes, skin);
        relist(&mut self.pairs, &mut self.before, &self.neighbours.pairs, |[i, j]| {
            material(i).spring(radius(i), material(j), radius(j))
        });
        relist(&mut self.seats, &mut self.before, &self.neighbours.seats, |[i, _]| {
            material(i).spring(radius(i), plane_material, radius(i))
        });
    }
}

/// Replaces a sorted list by another one; what stands in both stays as it is.
fn relist(
    list: &mut Vec<Contact>,
    before: &mut Vec<Contact>,
    keys: &[[u32; 2]],
    spring: impl Fn([u32; 2]) -> SphereSpring,
) {
    std::mem::swap(list, before);
    list.clear();
    let mut old = before.iter().peekable();
    for &key in keys {
        while old.next_if(|c| [c.sphere, c.other] < key).is_some() {}
        let kept = old.next_if(|c| [c.sphere, c.other] == key);
        list.push(kept.copied().unwrap_or_else(|| Contact::new(key, spring(key))));
    }
}
