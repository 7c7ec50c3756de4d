//! A heap turned into arrays: bodies, their spheres, and the planes around them.

use crate::law::Frictional;
use crate::math::{Mat3, Vec3};
use crate::model::{Filling, Heap};
use crate::shape::{Ball, Plane};
use crate::solve::STANDARD_GRAVITY;
use crate::solve::bodies::Body;
use crate::solve::grains::contacts::Contacts;

/// The spheres of all bodies, one array per quantity.
#[derive(Clone, Debug, Default)]
pub struct Spheres {
    /// Centres now, in world coordinates (m).
    pub centre: Vec<Vec3>,
    /// Centres in the axes of their bodies, from the centroid (m).
    pub local: Vec<Vec3>,
    /// Radii (m).
    pub radius: Vec<f64>,
    /// The body that each belongs to; ascending.
    pub body: Vec<u32>,
}

/// Bodies made of spheres, the contacts between them, and gravity.
#[derive(Clone, Debug)]
pub struct Grains {
    /// The bodies, by id of the clump.
    pub bodies: Vec<Body>,
    /// Gravity (m/s^2).
    pub gravity: Vec3,
    pub(super) spheres: Spheres,
    /// What each body is made of.
    pub(super) materials: Vec<Frictional>,
    /// Density of the spheres of each body (kg/m^3); `None` where its mass is that of a solid.
    pub(super) densities: Vec<Option<f64>>,
    pub(super) planes: Vec<Plane>,
    pub(super) plane_material: Frictional,
    pub(super) contacts: Contacts,
    /// Largest distance of a sphere's centre from its body's centroid (m), by body.
    arms: Vec<f64>,
    /// Where each body was when neighbours were last looked for.
    seen: Vec<(Vec3, Mat3)>,
    /// How far beyond touching neighbours are listed (m).
    pub(super) skin: f64,
}

impl Grains {
    /// Bodies at rest where the heap has its clumps, under gravity along -z; neighbours are listed up to `skin` (m)
    /// beyond touching.
    pub fn new(heap: &Heap, skin: f64) -> Self {
        let mut grains = Grains {
            bodies: Vec::with_capacity(heap.clumps.len()),
            gravity: Vec3::new(0.0, 0.0, -STANDARD_GRAVITY),
            spheres: Spheres::default(),
            materials: heap.clumps.iter().map(|c| c.material).collect(),
            densities: heap
                .clumps
                .iter()
                .map(|c| (c.filling == Filling::Spheres).then_some(c.density))
                .collect(),
            planes: heap.planes.clone(),
            plane_material: heap.plane_material,
            contacts: Contacts::default(),
            arms: Vec::with_capacity(heap.clumps.len()),
            seen: Vec::new(),
            skin,
        };
        for (clump, id) in heap.clumps.iter().zip(0u32..) {
            let properties = clump.mass_properties();
            let centroid = properties.centroid;
            let reach = |add: f64| move |ball: &Ball| (ball.centre - centroid).norm() + add * ball.radius;
            let radius = clump.spheres.iter().map(reach(1.0)).fold(0.0, f64::max);
            grains.arms.push(clump.spheres.iter().map(reach(0.0)).fold(0.0, f64::max));
            let body = Body::at_rest(&properties, clump.density, clump.support, radius);
            for ball in &clump.spheres {
                grains.spheres.local.push(body.rotation.tr_mul(&(ball.centre - body.position)));
                grains.spheres.radius.push(ball.radius);
                grains.spheres.body.push(id);
            }
            grains.bodies.push(body);
        }
        grains.spheres.centre = vec![Vec3::zeros(); grains.spheres.local.len()];
        grains.place_spheres();
        grains.refresh();
        grains
    }

    /// Number of spheres.
    pub fn sphere_count(&self) -> usize {
        self.spheres.radius.len()
    }

    /// Number of contacts that carry.
    pub fn contact_count(&self) -> usize {
        self.contacts.carrying().count()
    }

    /// The centres (m) and radii (m) of all spheres now, with the body that each belongs to.
    pub fn balls(&self) -> impl Iterator<Item = (u32, Ball)> + '_ {
        let Spheres { centre, radius, body, .. } = &self.spheres;
        (0..centre.len()).map(|k| (body[k], Ball { centre: centre[k], radius: radius[k] }))
    }

    /// Sets force and moment of every body to those of gravity.
    pub(super) fn apply_gravity(&mut self) {
        for body in &mut self.bodies {
            body.force = self.gravity * body.mass;
            body.torque = Vec3::zeros();
        }
    }

    /// Adds the forces of all contacts; `dt` is the length of the step (s) that led to the positions now.
    pub(super) fn apply_contacts(&mut self, dt: f64) {
        self.contacts.apply(&mut self.bodies, &self.spheres, &self.planes, dt);
    }

    /// Puts the spheres where their bodies are.
    pub(super) fn place_spheres(&mut self) {
        let Spheres { centre, local, body, .. } = &mut self.spheres;
        for ((centre, local), &id) in centre.iter_mut().zip(local).zip(body.iter()) {
            let body = &self.bodies[id as usize];
            *centre = body.position + body.rotation * *local;
        }
    }

    /// Whether a sphere may have moved by more than half the skin since neighbours were last looked for: then two of
    /// them may have come together that are on no list.
    pub(super) fn has_moved(&self) -> bool {
        let allowed = 0.25 * self.skin * self.skin;
        let moved = |body: &Body, (position, rotation): &(Vec3, Mat3), arm: f64| {
            let shift = (body.position - position).norm_squared();
            if arm == 0.0 {
                return shift > allowed;
            }
            // The Frobenius norm of the change of rotation bounds the path of a point at unit distance, and
            // (x + y)^2 <= 2 (x^2 + y^2).
            2.0 * (shift + (body.rotation - rotation).norm_squared() * arm * arm) > allowed
        };
        self.bodies.iter().zip(&self.seen).zip(&self.arms).any(|((body, seen), &arm)| moved(body, seen, arm))
    }

    /// Lists the neighbours anew; contacts that stay keep what they remember.
    pub fn refresh(&mut self) {
        self.contacts.refresh(&self.spheres, &self.materials, &self.planes, &self.plane_material, self.skin);
        self.seen.clear();
        self.seen.extend(self.bodies.iter().map(|b| (b.position, b.rotation)));
    }

    /// Whether all positions and forces are finite.
    pub fn is_finite(&self) -> bool {
        self.bodies.iter().all(|b| (b.position.sum() + b.force.sum() + b.torque.sum()).is_finite())
    }

    /// Mean unbalanced force of the bodies that move over the mean force of the contacts that carry, after the forces were last
    /// summed up (YADE's definition); an unbalanced moment counts as a force at the radius of gyration, as in
    /// [`crate::solve::Assembly::unbalanced_ratio`]. 1 when no contact carries.
    pub fn unbalanced_ratio(&self) -> f64 {
        let moving = || self.bodies.iter().filter(|body| body.moves());
        let unbalanced: f64 = moving().map(Body::unbalanced).sum();
        let (mut carried, mut carrying) = (0.0, 0u32);
        for force in self.contacts.carrying() {
            carried += force;
            carrying += 1;
        }
        match (moving().count(), carrying) {
            (0, _) => 0.0,
            (_, 0) => 1.0,
            (moving, _) => (unbalanced / moving as f64) / (carried / f64::from(carrying)),
        }
    }

    /// Kinetic energy (J).
    pub fn kinetic_energy(&self) -> f64 {
        self.bodies
            .iter()
            .map(|b| 0.5 * b.mass * b.velocity.norm_squared() + 0.5 * b.spin.dot(&b.angular_momentum))
            .sum()
    }

    /// Energy stored in the springs of the contacts, after the forces were last summed up (J).
    pub fn stored_energy(&self) -> f64 {
        self.contacts.stored_energy()
    }
}
