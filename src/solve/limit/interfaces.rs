//! Blocks and the points at which they touch: the joint polygons' vertices.

use crate::contact::{self, Feature, Patch, area_shares, candidate_pairs, distinct, find_patch, middle_line};
use crate::law::{Coulomb, PATCHES_ALONG, Sampling};
use crate::math::Vec3;
use crate::model::{Block, JointLaws, Support, Wall};
use crate::shape::{MassProperties, Polygon, Polyhedron, convex_union};
use crate::solve::limit::loads::{Loads, When, Wrench};
use crate::solve::limit::periodic::Strain;

/// A block as limit analysis sees it.
#[derive(Clone, Debug)]
pub(crate) struct Rigid {
    pub centroid: Vec3,
    /// Mass (kg).
    pub mass: f64,
    /// Largest distance of a vertex from the centroid (m): the lever that makes moments comparable with forces.
    pub radius: f64,
    pub support: Support,
    /// Whether its centroid stays where it is: of stones that are repeated one does, or all could drift together.
    pub pinned: bool,
}

/// A joint: who presses on whom, and where.
#[derive(Clone, Debug)]
pub(crate) struct Interface {
    /// Block whose face carries the polygon; here and in the next the first part of a stone for all of its parts.
    pub incident: usize,
    /// Block whose plane gives the direction of the pressure.
    pub reference: usize,
    /// The image of the reference block that is meant: where it is from the block itself (m). Zero but in a cell.
    pub shift: Vec3,
    /// Unit normal in which the reference block pushes the incident one.
    pub normal: Vec3,
    pub law: Coulomb,
    pub points: Vec<ContactPoint>,
}

/// A point of a joint at which forces act.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactPoint {
    pub at: Vec3,
    /// Share of the joint's area (m^2).
    pub area: f64,
}

/// A tie as rigid blocks see it: its point cannot go along the direction, nor against it if it is two-sided. What it pulls
/// with as built, its stiffness and its slack play no part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rope {
    pub block: usize,
    pub at: Vec3,
    pub direction: Vec3,
    pub two_sided: bool,
}

/// Those that feel a force at a joint: the incident block, the reference block and the strain.
pub(crate) type Felt = [Option<(usize, Wrench)>; 3];

/// The blocks of a wall, their joints and their ropes.
#[derive(Clone, Debug)]
pub(crate) struct Blocks {
    /// Where positions count from (m, in the wall's coordinates), see [`Wall::local_origin`].
    pub origin: Vec3,
    /// By block. The first part of a stone of several is the whole of it; the others are fixed and have no part in anything.
    pub rigid: Vec<Rigid>,
    /// For every block the one that stands for its body, see [`Wall::leads`].
    pub leads: Vec<usize>,
    pub interfaces: Vec<Interface>,
    /// Ropes: a pull of any size.
    pub ties: Vec<Rope>,
    /// What deforms where the blocks are those of a cell.
    pub strain: Option<Strain>,
    /// Mean weight of the blocks that move under standard gravity (N): the unit of force.
    pub unit: f64,
}

impl Rigid {
    pub fn of(block: &Block) -> Rigid {
        let mass = block.mass_properties();
        let radius = block.shape.vertices.iter().map(|v| (v - mass.centroid).norm()).fold(0.0, f64::max);
        Rigid {
            centroid: mass.centroid,
            mass: block.density * mass.volume,
            radius,
            support: block.support,
            pinned: false,
        }
    }

    pub fn moves(&self) -> bool {
        !matches!(self.support, Support::Fixed | Support::Absent)
    }
}

impl Blocks {
    /// The blocks where the wall has them, and the joints between those that touch.
    pub fn of(wall: &Wall, laws: &dyn JointLaws, contact: &contact::Settings) -> Self {
        let (origin, wall) = wall.about_local_origin();
        let mut rigid: Vec<Rigid> = wall.blocks.iter().map(Rigid::of).collect();
        let leads = wall.leads();
        let mut shapes: Vec<Polyhedron> = wall.blocks.iter().map(|b| b.shape.clone()).collect();
        let mut merged = vec![false; shapes.len()];
        for (lead, parts) in wall.parts() {
            rigid[lead] = whole(&wall, &parts);
            let solids: Vec<&Polyhedron> = parts.iter().map(|&part| &wall.blocks[part].shape).collect();
            // As in the other solvers, a stone that is convex as a whole touches as one.
            let solid = convex_union(&solids);
            for &part in parts.iter().filter(|&&part| part != lead) {
                rigid[part].support = Support::Fixed;
                merged[part] = solid.is_some();
            }
            shapes[lead] = solid.unwrap_or_else(|| wall.blocks[lead].shape.clone());
        }
        let mut interfaces = Vec::new();
        for (a, b) in candidate_pairs(&shapes, 2.0 * contact.reach) {
            let (a, b) = (a as usize, b as usize);
            let moves = |block: usize| rigid[leads[block]].moves();
            let is_absent = [a, b].iter().any(|&block| rigid[block].support == Support::Absent);
            let is_one = leads[a] == leads[b] || merged[a] || merged[b];
            if is_absent || is_one || (!moves(a) && !moves(b)) {
                continue;
            }
            // As in the other solvers, what is fixed is the preferred reference.
            let (first, second) = if moves(b) { (a, b) } else { (b, a) };
            let Some(patch) = find_patch(&shapes[first], &shapes[second], contact) else { continue };
            let law = laws.of(a as u32, b as u32);
            let points = contact_points(&patch, contact.closed, law.sampling);
            if points.is_empty() {
                continue;
            }
            let (incident, reference) =
                if patch.reference_is_second { (first, second) } else { (second, first) };
            let (incident, reference) = (leads[incident], leads[reference]);
            let shift = Vec3::zeros();
            interfaces.push(Interface {
                incident,
                reference,
                shift,
                normal: patch.plane.normal,
                law,
                points,
            });
        }
        let moving: Vec<f64> = rigid.iter().filter(|r| r.moves()).map(|r| r.mass).collect();
        let mean = moving.iter().sum::<f64>() / moving.len().max(1) as f64;
        let unit = if mean > 0.0 { mean * crate::solve::STANDARD_GRAVITY } else { 1.0 };
        Blocks { origin, rigid, leads, interfaces, ties: Vec::new(), strain: None, unit }
    }

    /// The dead or the live loads on every block.
    pub fn wrenches(&self, loads: &Loads, when: When) -> Vec<Wrench> {
        let acceleration = if when == When::Dead { loads.dead } else { loads.live };
        let mut wrenches: Vec<Wrench> = self
            .rigid
            .iter()
            .map(|r| Wrench { force: acceleration * r.mass, moment: Vec3::zeros() })
            .collect();
        for load in loads.points.iter().filter(|p| p.when == when) {
            let body = self.leads[load.block];
            wrenches[body].add(load.point - self.origin - self.rigid[body].centroid, load.force);
        }
        wrenches
    }

    /// What a force on the incident block at a point of a joint does, with its reaction, to all that feel it.
    pub fn felt(&self, joint: &Interface, at: Vec3, force: Vec3) -> Felt {
        let (incident, reference) = (joint.incident, joint.reference);
        let lever = |block: usize, at: Vec3| at - self.rigid[block].centroid;
        let mut own = Wrench::default();
        own.add(lever(incident, at), force);
        let mut other = Wrench::default();
        other.add(lever(reference, at - joint.shift), -force);
        let strain = self.strain.filter(|_| joint.shift != Vec3::zeros());
        let strained = strain.map(|strain| (strain.body, strain.felt(joint.shift, at, -force)));
        if incident == reference {
            return [Some((incident, own.plus(&other))), None, strained];
        }
        [Some((incident, own)), Some((reference, other)), strained]
    }

    /// Velocity of a block at a point (m/s).
    pub fn velocity(&self, velocities: &[Wrench], block: usize, at: Vec3) -> Vec3 {
        let v = &velocities[block];
        v.force + v.moment.cross(&(at - self.rigid[block].centroid))
    }

    /// Velocity of the incident block past the reference block at a point of a joint (m/s).
    pub fn parting(&self, velocities: &[Wrench], joint: &Interface, at: Vec3) -> Vec3 {
        let strained = self
            .strain
            .map_or_else(Vec3::zeros, |strain| strain.velocity(&velocities[strain.body], joint.shift, at));
        self.velocity(velocities, joint.incident, at)
            - self.velocity(velocities, joint.reference, at - joint.shift)
            - strained
    }

    /// Every contact point with its joint, in the order in which all per-point numbers are kept.
    pub fn points(&self) -> impl Iterator<Item = (&Interface, &ContactPoint)> {
        self.interfaces.iter().flat_map(|joint| joint.points.iter().map(move |point| (joint, point)))
    }
}

/// The parts of a stone as one.
fn whole(wall: &Wall, parts: &[usize]) -> Rigid {
    let blocks = || parts.iter().map(|&part| &wall.blocks[part]);
    let masses: Vec<MassProperties> =
        blocks().map(|block| block.mass_properties().times(block.density)).collect();
    let MassProperties { volume: mass, centroid, .. } = MassProperties::together(&masses);
    let corners = blocks().flat_map(|block| &block.shape.vertices);
    let radius = corners.map(|v| (v - centroid).norm()).fold(0.0, f64::max);
    Rigid { centroid, mass, radius, support: wall.blocks[parts[0]].support, pinned: false }
}

/// The vertices of the part of a patch where the gap is at most `closed`, with their shares of its area.
///
/// What touches in pieces touches at the corners of the polygon around them: a force between is one of the cone there. The
/// strip or square that stands for a contact of edges and corners has a width for the springs of the other solvers; rigid
/// blocks touch along its middle line or in its middle.
pub(super) fn contact_points(patch: &Patch, closed: f64, sampling: Sampling) -> Vec<ContactPoint> {
    let frame = &patch.frame;
    let touching = |outline: &Polygon| patch.touching(outline, closed);
    let cells = match sampling {
        Sampling::Patches(mask) => Some(patch.pieces(PATCHES_ALONG, mask)),
        // What lies behind the face bears once it has closed, and that is a displacement.
        Sampling::Seats(seating) => patch.seats(seating.share, seating.laid(), closed),
        Sampling::Area | Sampling::Vertices => None,
    };
    let (vertices, area) = match (patch.feature, cells) {
        (Feature::Faces(..), Some(cells)) => {
            let pieces: Vec<Polygon> = cells.iter().map(|cell| touching(&cell.outline)).collect();
            let corners = pieces.iter().flat_map(|piece| &piece.vertices).copied().collect();
            let area = pieces.iter().map(Polygon::area).sum();
            (distinct(Polygon::around(corners).vertices), Some(area))
        }
        (Feature::Faces(..), None) => (distinct(touching(&patch.polygon).vertices), None),
        (Feature::Steep(..) | Feature::Edges(..), _) => {
            let vertices = distinct(touching(&middle_line(&patch.polygon)).vertices);
            let share = patch.polygon.area() / vertices.len() as f64;
            return vertices.iter().map(|&v| ContactPoint { at: frame.lift(v), area: share }).collect();
        }
    };
    let shares = area_shares(&vertices);
    let whole: f64 = shares.iter().sum();
    let scale = area.map_or(1.0, |area: f64| if whole > 0.0 { area / whole } else { 0.0 });
    let point = |(&v, share): (&[f64; 2], f64)| ContactPoint { at: frame.lift(v), area: scale * share };
    vertices.iter().zip(shares).map(point).collect()
}
