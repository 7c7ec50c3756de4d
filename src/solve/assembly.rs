//! What every solver works on: bodies, their joints and ties, and the loads that act on them.

use crate::contact;
use crate::math::{Mat3, STANDARD_GRAVITY, Vec3};
use crate::model::{JointLaws, Support, Wall};
use crate::solve::bodies::{Bodies, Freedom};
use crate::solve::joints::Joints;
use crate::solve::mount::{Mount, Mounted};
use crate::solve::ties::{Held, Tie};

/// A body that has moved by less than this share of what makes contacts be looked for keeps those it has, where the other
/// has not moved either.
const SETTLED: f64 = 0.25;

/// A dead load: a force of fixed direction at a point that moves with a body.
#[derive(Clone, Copy, Debug)]
struct DeadLoad {
    body: usize,
    /// In the body's axes, from its centroid (m).
    lever: Vec3,
    force: Vec3,
}

/// Blocks, joints and loads. Solvers hand an assembly to one another, with all that its joints remember.
#[derive(Clone)]
pub struct Assembly<'a> {
    /// The bodies, by block id.
    pub bodies: Bodies,
    /// The joints.
    pub joints: Joints,
    /// Gravity (m/s^2).
    pub gravity: Vec3,
    /// Factor on all dead loads; 1 unless it is changed.
    pub load_factor: f64,
    /// Tolerances of contact detection.
    pub contact: contact::Settings,
    laws: &'a dyn JointLaws,
    loads: Vec<DeadLoad>,
    ties: Vec<Held>,
    mounted: Option<Mounted>,
    /// Where each body was when its contacts were last looked for; none before the first time.
    seen: Vec<(Vec3, Mat3)>,
}

impl<'a> Assembly<'a> {
    /// Blocks at rest in the positions of the wall, their joints found, under gravity along -z.
    pub fn new(wall: &Wall, laws: &'a dyn JointLaws, contact: contact::Settings) -> Self {
        let mut assembly = Assembly {
            bodies: Bodies::from_wall(wall),
            joints: Joints::default(),
            gravity: Vec3::new(0.0, 0.0, -STANDARD_GRAVITY),
            load_factor: 1.0,
            contact,
            laws,
            loads: Vec::new(),
            ties: Vec::new(),
            mounted: None,
            seen: Vec::new(),
        };
        // Joints that are found from now on have none of these.
        for (id, block) in wall.blocks.iter().enumerate() {
            if block.support == Support::Absent {
                assembly.joints.remove(id as u32);
            }
        }
        assembly.refresh();
        assembly
    }

    /// Adds a force (N), at load factor 1, of fixed direction at a point (m, in the wall's coordinates) that from now on moves with the block.
    pub fn add_load(&mut self, body: usize, point: Vec3, force: Vec3) {
        let body = self.bodies.carriers[body];
        let b = &self.bodies.all[body];
        let lever = b.rotation.tr_mul(&(point - self.bodies.origin - b.position));
        self.loads.push(DeadLoad { body, lever, force });
    }

    /// Ties a body to its surroundings, at a point in the wall's coordinates. It is where the body is now: bodies must not have moved yet.
    pub fn add_tie(&mut self, tie: Tie) {
        let (body, point) = (self.bodies.carriers[tie.body], tie.point - self.bodies.origin);
        let tie = Tie { body, point, ..tie };
        self.ties.push(Held::new(tie, &self.bodies.all[tie.body]));
    }

    /// The ties.
    pub fn ties(&self) -> &[Held] {
        &self.ties
    }

    /// The pull (N) of every tie as the bodies stand; negative where it pushes.
    pub fn pulls(&self) -> impl Iterator<Item = f64> {
        self.ties.iter().map(|tie| tie.force(&self.bodies.all[tie.tie.body], self.load_factor))
    }

    /// Puts a fixed body, which has not moved yet, on springs, and fixes others to it.
    pub fn mount(&mut self, mount: Mount, fixed_to_it: &[usize]) {
        self.mounted = Some(Mounted::new(mount, &self.bodies.all[mount.body]));
        self.bodies.all[mount.body].freedom = Freedom::Mounted;
        for body in fixed_to_it {
            self.bodies.fix_to(*body, mount.body);
        }
        self.seen.clear();
        self.refresh();
    }

    /// The platform on springs, if there is one.
    pub fn mounted(&self) -> Option<&Mounted> {
        self.mounted.as_ref()
    }

    /// Takes a body out: it stays where it is, without joints, loads and motion.
    pub fn remove(&mut self, body: usize) {
        self.joints.remove(body as u32);
        self.loads.retain(|load| load.body != body);
        self.ties.retain(|tie| tie.tie.body != body);
        let gone = &mut self.bodies.all[body];
        gone.freedom = Freedom::Fixed;
        gone.velocity = Vec3::zeros();
        gone.set_spin(Vec3::zeros());
        // How far it had moved asks for no new contacts any more.
        self.seen[body] = (gone.position, gone.rotation);
    }

    /// Lets fixed bodies down by so much (m) each; what stands on them stays where it is.
    pub fn lower(&mut self, down: &[(usize, f64)]) {
        for (body, way) in down {
            self.bodies.all[self.bodies.carriers[*body]].position.z -= way;
        }
    }

    /// Sets force and moment of every body to those of gravity, the dead loads, the ties and the springs of a platform.
    pub fn apply_loads(&mut self) {
        for body in &mut self.bodies.all {
            body.force = match body.freedom {
                Freedom::Mounted => Vec3::zeros(),
                Freedom::Free | Freedom::Fixed | Freedom::InPlane | Freedom::Upright | Freedom::Led => {
                    self.gravity * body.mass
                }
            };
            body.torque = Vec3::zeros();
        }
        for load in &self.loads {
            let body = &mut self.bodies.all[load.body];
            let force = load.force * self.load_factor;
            body.force += force;
            body.torque += (body.rotation * load.lever).cross(&force);
        }
        for tie in &self.ties {
            tie.apply(&mut self.bodies.all[tie.tie.body], self.load_factor);
        }
        if let Some(mounted) = &self.mounted {
            mounted.apply(&mut self.bodies.all[mounted.mount.body]);
        }
    }

    /// Whether a block has moved so far that a new joint might exist: half the reach of the contact search.
    pub fn has_moved(&self) -> bool {
        let allowed = 0.5 * self.contact.reach;
        (0..self.bodies.all.len()).any(|body| self.moved_further(body, allowed))
    }

    /// Whether a body has moved further (m) since its contacts were last looked for.
    fn moved_further(&self, index: usize, allowed: f64) -> bool {
        let (body, (position, rotation)) = (&self.bodies.all[index], &self.seen[index]);
        let shift = (body.position - position).norm_squared();
        // The Frobenius norm of the change of rotation bounds the path of a vertex at unit distance.
        let turn = (body.rotation - rotation).norm_squared() * body.radius * body.radius;
        // (x + y)^2 <= 2 (x^2 + y^2)
        2.0 * (shift + turn) > allowed * allowed
    }

    /// Looks for contacts anew where a block has moved; joints that stay keep their history.
    pub fn refresh(&mut self) {
        let allowed = SETTLED * 0.5 * self.contact.reach;
        let all = 0..self.bodies.all.len();
        let moved: Vec<bool> =
            all.clone().map(|body| self.seen.is_empty() || self.moved_further(body, allowed)).collect();
        self.joints.refresh(&self.bodies, self.laws, &self.contact, &moved);
        let pose = |body: usize| (self.bodies.all[body].position, self.bodies.all[body].rotation);
        self.seen = all.map(|body| if moved[body] { pose(body) } else { self.seen[body] }).collect();
    }

    /// Whether all positions and forces are finite.
    pub fn is_finite(&self) -> bool {
        self.bodies.all.iter().all(|b| (b.position.sum() + b.force.sum() + b.torque.sum()).is_finite())
    }

    /// Mean unbalanced force of the blocks that move over the mean force of the joints that carry, after the forces
    /// were last summed up (YADE's definition); an unbalanced moment counts as a force at the radius of gyration. 1
    /// when no joint carries.
    pub fn unbalanced_ratio(&self) -> f64 {
        let (mut unbalanced, mut moving) = (0.0, 0u32);
        for body in self.bodies.all.iter().filter(|b| b.moves()) {
            unbalanced += body.unbalanced();
            moving += 1;
        }
        let (mut carried, mut carrying) = (0.0, 0u32);
        for joint in self.joints.all.iter().filter(|j| j.force > 0.0) {
            carried += joint.force;
            carrying += 1;
        }
        match (moving, carrying) {
            (0, _) => 0.0,
            (_, 0) => 1.0,
            _ => (unbalanced / f64::from(moving)) / (carried / f64::from(carrying)),
        }
    }

    /// The block with the largest unbalanced force (N) after the forces were last summed up, and that force; an
    /// unbalanced moment counts as a force at the radius of gyration. `None` without blocks that move.
    pub fn most_unbalanced(&self) -> Option<(usize, f64)> {
        let moving = self.bodies.all.iter().enumerate().filter(|(_, b)| b.moves());
        moving.map(|(id, b)| (id, b.unbalanced())).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}
