//! Assembly: blocks turned into bodies, the arrays that the solvers work on.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Quaternion, Rotation3, UnitQuaternion};

use crate::math::{Mat3, Vec3, atan2};
use crate::model::{Support, Wall};
use crate::shape::{MassProperties, Polyhedron, convex_union};

/// What a body can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Everything.
    Free,
    /// Nothing.
    Fixed,
    /// It cannot move out of plane (y) nor turn about x or z.
    InPlane,
    /// It moves in the plane (x and z) without turning.
    Upright,
    /// It goes along x and y at the velocity that it has, whatever pushes it there; it moves up and down, and does not turn.
    Led,
    /// It moves up and down and turns about x, on springs; its own weight does not act.
    Mounted,
}

/// A rigid body: state, accumulated loads, and constants in its principal axes.
#[derive(Clone, Debug)]
pub struct Body {
    /// Centroid (m), from the [origin](Bodies::origin) of the bodies.
    pub position: Vec3,
    /// Attitude: principal axes to world axes.
    pub attitude: UnitQuaternion<f64>,
    /// The same as a matrix, kept beside it because every joint needs it.
    pub rotation: Mat3,
    /// Velocity of the centroid (m/s).
    pub velocity: Vec3,
    /// Angular momentum about the centroid in world axes (kg m^2/s), with the inertia that the solver uses.
    pub angular_momentum: Vec3,
    /// Angular velocity in world axes (rad/s).
    pub spin: Vec3,
    /// Sum of forces (N).
    pub force: Vec3,
    /// Sum of moments about the centroid (N m).
    pub torque: Vec3,
    /// Mass (kg).
    pub mass: f64,
    /// Principal moments of inertia (kg m^2).
    pub inertia: Vec3,
    /// Factor on mass and inertia that a quasi-static run may use; 1 otherwise.
    pub inertia_scale: f64,
    /// What it can do.
    pub freedom: Freedom,
    /// Largest distance of a vertex from the centroid (m).
    pub radius: f64,
}

/// A body with its shape in principal axes, centroid at the origin.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// State of each body, by block id.
    pub all: Vec<Body>,
    /// The shapes in the axes of what carries them.
    pub shapes: Vec<Polyhedron>,
    /// The body that carries each shape: itself, the first part of its stone, or a platform that it is fixed to.
    pub carriers: Vec<usize>,
    /// Where positions count from (m, in the wall's coordinates), see [`Wall::local_origin`].
    pub origin: Vec3,
    /// The solids that the parts of a stone make up where that is convex, by the first part, in the axes of the body: the stone
    /// touches others as that solid, as if it had not been divided.
    wholes: BTreeMap<usize, Polyhedron>,
    /// The other parts of such stones.
    merged: BTreeSet<usize>,
    /// Where each block's own centroid is in the axes of what carries it (m).
    centroids: Vec<Vec3>,
}

impl Bodies {
    /// Stops all bodies where they are.
    pub fn stop(&mut self) {
        for body in &mut self.all {
            body.velocity = Vec3::zeros();
            body.set_spin(Vec3::zeros());
        }
    }

    /// Bodies at rest from the blocks of a wall. The first part of a stone of several carries the others: its body has the mass
    /// of all, and theirs stay behind, fixed and without a part in anything.
    pub fn from_wall(wall: &Wall) -> Self {
        let mut all = Vec::with_capacity(wall.blocks.len());
        let mut shapes = Vec::with_capacity(wall.blocks.len());
        let (origin, wall) = wall.about_local_origin();
        for block in &wall.blocks {
            let properties = block.mass_properties();
            let centred = block.shape.translated(&-properties.centroid);
            let radius = centred.vertices.iter().map(|v| v.norm()).fold(0.0, f64::max);
            let body = Body::at_rest(&properties, block.density, block.support, radius);
            shapes.push(centred.moved(&body.rotation.transpose(), &Vec3::zeros()));
            all.push(body);
        }
        let (carriers, centroids) = ((0..all.len()).collect(), vec![Vec3::zeros(); all.len()]);
        let (wholes, merged) = (BTreeMap::new(), BTreeSet::new());
        let mut bodies = Bodies { all, shapes, carriers, origin, wholes, merged, centroids };
        for (block, properties) in wall.blocks.iter().enumerate().filter_map(|(id, b)| Some((id, b.scan?))) {
            let off = wall.blocks[block].shape.mass_properties().centroid - properties.centroid;
            bodies.centroids[block] = bodies.all[block].rotation.tr_mul(&off);
        }
        for (lead, parts) in wall.parts() {
            bodies.unite(&wall, lead, &parts);
        }
        bodies
    }

    /// Makes one body of the parts of a stone, the first of which is `lead`.
    fn unite(&mut self, wall: &Wall, lead: usize, parts: &[usize]) {
        let own: Vec<MassProperties> = parts
            .iter()
            .map(|&part| wall.blocks[part].mass_properties().times(wall.blocks[part].density))
            .collect();
        let whole = MassProperties::together(&own);
        let far = |part: &usize| {
            let vertices = wall.blocks[*part].shape.vertices.iter();
            vertices.map(|v| (v - whole.centroid).norm()).fold(0.0, f64::max)
        };
        let radius = parts.iter().map(far).fold(0.0, f64::max);
        // The masses are in the properties: the density is 1.
        let body = Body::at_rest(&whole, 1.0, wall.blocks[lead].support, radius);
        for &part in parts {
            let shape = wall.blocks[part].shape.translated(&-body.position);
            self.shapes[part] = shape.moved(&body.rotation.transpose(), &Vec3::zeros());
            let middle = wall.blocks[part].shape.mass_properties().centroid;
            self.centroids[part] = body.rotation.tr_mul(&(middle - body.position));
            self.carriers[part] = lead;
            self.all[part].freedom = Freedom::Fixed;
        }
        let shapes: Vec<&Polyhedron> = parts.iter().map(|&part| &wall.blocks[part].shape).collect();
        if let Some(solid) = convex_union(&shapes) {
            let solid = solid.translated(&-body.position).moved(&body.rotation.transpose(), &Vec3::zeros());
            self.wholes.insert(lead, solid);
            self.merged.extend(parts.iter().filter(|&&part| part != lead));
        }
        self.all[lead] = body;
    }

    /// The solid in which a block touches others, where it is now, in world coordinates.
    pub fn touching_shape(&self, block: usize) -> Polyhedron {
        let carrier = &self.all[self.carriers[block]];
        let shape = self.wholes.get(&block).unwrap_or(&self.shapes[block]);
        shape.moved(&carrier.rotation, &carrier.position)
    }

    /// Whether a block touches others as a part of the solid of its stone's first part only.
    pub fn is_merged(&self, block: usize) -> bool {
        self.merged.contains(&block)
    }

    /// Where a block's centroid is now (m).
    pub fn centroid(&self, block: usize) -> Vec3 {
        self.centroid_in(&self.all, block)
    }

    /// Where a block's centroid is in another state of these bodies (m).
    pub fn centroid_in(&self, state: &[Body], block: usize) -> Vec3 {
        let carrier = &state[self.carriers[block]];
        carrier.position + carrier.rotation * self.centroids[block]
    }

    /// The body that carries a block.
    pub fn carrier(&self, block: usize) -> &Body {
        &self.all[self.carriers[block]]
    }

    /// The shape of a body where it is now, from the origin of the bodies.
    pub fn world_shape(&self, body: usize) -> Polyhedron {
        let carrier = &self.all[self.carriers[body]];
        self.shapes[body].moved(&carrier.rotation, &carrier.position)
    }

    /// Fixes a body to another one, which carries its shape from now on.
    pub fn fix_to(&mut self, body: usize, carrier: usize) {
        let by = &self.all[carrier];
        let shape = self.world_shape(body).translated(&-by.position);
        let centroid = by.rotation.tr_mul(&(self.centroid(body) - by.position));
        self.shapes[body] = shape.moved(&by.rotation.transpose(), &Vec3::zeros());
        self.centroids[body] = centroid;
        self.carriers[body] = carrier;
    }

    /// Largest speed of a body (m/s): of its centroid, or of its turning at its radius.
    pub fn fastest(&self) -> f64 {
        let of = |body: &Body| body.velocity.norm().max(body.spin.norm() * body.radius);
        self.all.iter().map(of).fold(0.0, f64::max)
    }

    /// Kinetic energy of all bodies (J).
    pub fn kinetic_energy(&self) -> f64 {
        self.all
            .iter()
            .map(|b| {
                0.5 * b.inertia_scale * b.mass * b.velocity.norm_squared()
                    + 0.5 * b.spin.dot(&b.angular_momentum)
            })
            .sum()
    }
}

impl Freedom {
    fn of(support: Support) -> Freedom {
        match support {
            Support::Free => Freedom::Free,
            Support::Fixed | Support::Absent => Freedom::Fixed,
            Support::OutOfPlane => Freedom::InPlane,
            Support::Upright => Freedom::Upright,
        }
    }
}

impl Body {
    /// A body at rest from its mass properties at unit density; `radius` is the largest distance (m) of a point of it
    /// from the centroid.
    pub fn at_rest(properties: &MassProperties, density: f64, support: Support, radius: f64) -> Body {
        let (inertia, axes) = principal_axes(properties.inertia);
        // The matrix is made from the quaternion, as every later one is.
        let attitude = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        Body {
            position: properties.centroid,
            attitude,
            rotation: attitude.to_rotation_matrix().into_inner(),
            velocity: Vec3::zeros(),
            angular_momentum: Vec3::zeros(),
            spin: Vec3::zeros(),
            force: Vec3::zeros(),
            torque: Vec3::zeros(),
            mass: density * properties.volume,
            inertia: inertia * density,
            inertia_scale: 1.0,
            freedom: Freedom::of(support),
            radius,
        }
    }

    /// Whether it can move at all.
    pub fn moves(&self) -> bool {
        self.freedom != Freedom::Fixed
    }

    /// Radius of gyration (m), the mean over all axes.
    pub fn gyration(&self) -> f64 {
        (0.5 * self.inertia.sum() / self.mass).sqrt()
    }

    /// Its velocity (m/s) and its spin (rad/s).
    pub fn twist(&self) -> [f64; 6] {
        let (v, w) = (self.velocity, self.spin);
        [v.x, v.y, v.z, w.x, w.y, w.z]
    }

    /// Size of the force that is left on it (N); a moment counts as a force at the radius of gyration.
    pub fn unbalanced(&self) -> f64 {
        self.force.norm() + self.torque.norm() / self.gyration()
    }

    /// Angular velocity (rad/s) of an attitude with this body's angular momentum.
    fn spin_at(&self, rotation: &Mat3) -> Vec3 {
        match self.freedom {
            Freedom::Fixed | Freedom::Upright | Freedom::Led => Vec3::zeros(),
            Freedom::Free => {
                let local = rotation.tr_mul(&self.angular_momentum);
                rotation * (local.component_div(&self.inertia) / self.inertia_scale)
            }
            // Turns about y or x only.
            Freedom::InPlane => {
                Vec3::new(0.0, self.angular_momentum.y / self.inertia_about(rotation, 1), 0.0)
            }
            Freedom::Mounted => {
                Vec3::new(self.angular_momentum.x / self.inertia_about(rotation, 0), 0.0, 0.0)
            }
        }
    }

    /// Moment of inertia (kg m^2) about a world axis.
    fn inertia_about(&self, rotation: &Mat3, axis: usize) -> f64 {
        let unit = rotation.row(axis);
        (0..3).map(|k| unit[k] * unit[k] * self.inertia[k]).sum::<f64>() * self.inertia_scale
    }

    /// Sets the angular velocity (rad/s, world axes), and the angular momentum that belongs to it.
    pub fn set_spin(&mut self, spin: Vec3) {
        let local = self.rotation.tr_mul(&spin).component_mul(&self.inertia) * self.inertia_scale;
        self.angular_momentum = self.rotation * local;
        self.spin = self.spin_at(&self.rotation);
    }

    /// Rescales inertia; velocity and spin stay.
    pub fn rescale(&mut self, scale: f64) {
        self.angular_momentum *= scale / self.inertia_scale;
        self.inertia_scale = scale;
    }

    /// How it has turned since an earlier state of its own: the rotation vector (rad, world axes), of at most half a turn.
    pub fn turn_since(&self, from: &Body) -> Vec3 {
        let turn = (self.attitude * from.attitude.inverse()).into_inner();
        // A quaternion and its negative are the same turn; the one with the positive real part is the shorter way.
        let (axis, real) = if turn.w < 0.0 { (-turn.imag(), -turn.w) } else { (turn.imag(), turn.w) };
        let sine = axis.norm();
        if sine > 0.0 { axis * (2.0 * atan2(sine, real) / sine) } else { Vec3::zeros() }
    }

    /// Puts the body where a shift (m) and a turn (rad, world axes about its centroid) take it from a state of its own.
    pub fn place(&mut self, from: &Body, shift: &Vec3, turn: &Vec3) {
        self.position = from.position + shift;
        self.attitude = turned(&from.attitude, turn);
        self.rotation = self.attitude.to_rotation_matrix().into_inner();
    }

    /// Central differences: velocity at the half step from the forces now, then position and attitude at the next
    /// step. The attitude turns with the spin at the half step (midpoint rule, second order), so a free body keeps
    /// its angular momentum to round-off.
    pub fn advance(&mut self, dt: f64, damping: f64) {
        if !self.moves() {
            return;
        }
        match self.freedom {
            Freedom::Free | Freedom::Fixed | Freedom::Led => {}
            Freedom::InPlane => {
                self.force.y = 0.0;
                self.torque = Vec3::new(0.0, self.torque.y, 0.0);
            }
            Freedom::Upright => {
                self.force.y = 0.0;
                self.torque = Vec3::zeros();
            }
            Freedom::Mounted => {
                self.force = Vec3::new(0.0, 0.0, self.force.z);
                self.torque = Vec3::new(self.torque.x, 0.0, 0.0);
            }
        }
        if self.freedom == Freedom::Led {
            let (force, speed) = (Vec3::z() * self.force.z, Vec3::z() * self.velocity.z);
            let damped = force + crate::law::local_damping(damping, &force, &speed);
            self.velocity.z += damped.z * (dt / (self.mass * self.inertia_scale));
            self.position += self.velocity * dt;
            return;
        }
        let (mut force, mut torque) = (self.force, self.torque);
        if damping > 0.0 {
            force += crate::law::local_damping(damping, &force, &self.velocity);
            torque += crate::law::local_damping(damping, &torque, &self.spin);
        }
        self.velocity += force * (dt / (self.mass * self.inertia_scale));
        self.position += self.velocity * dt;
        self.angular_momentum += torque * dt;
        let half_way = turned(&self.attitude, &(self.spin_at(&self.rotation) * (0.5 * dt)));
        self.spin = self.spin_at(&half_way.to_rotation_matrix().into_inner());
        self.attitude = turned(&self.attitude, &(self.spin * dt));
        self.rotation = self.attitude.to_rotation_matrix().into_inner();
    }
}

/// The attitude after a small turn (rad, world axes), to second order (Cayley) and exactly orthogonal.
fn turned(attitude: &UnitQuaternion<f64>, turn: &Vec3) -> UnitQuaternion<f64> {
    let step = Quaternion::new(1.0, 0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z);
    UnitQuaternion::new_normalize(step * attitude.into_inner())
}

/// Principal moments (ascending) and axes as the columns of a proper rotation.
fn principal_axes(inertia: Mat3) -> (Vec3, Mat3) {
    let eigen = inertia.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let moments = Vec3::from_fn(|k, _| eigen.eigenvalues[order[k]]);
    let mut axes = Mat3::from_fn(|r, c| eigen.eigenvectors[(r, order[c])]);
    if axes.determinant() < 0.0 {
        axes.set_column(2, &-axes.column(2));
    }
    (moments, axes)
}
