//! Walls cut by random joint planes, one after another, until the pieces have their target sizes: the analogue of
//! 3DEC's random joint sets.

use crate::generate::course::MAX_STONES;
use crate::generate::draft::{CUT_TOLERANCE, CutFault, Draft, Extent, Fault, Stone};
use crate::generate::outline::StoneFault;
use crate::generate::{DipAbout, Sizes};
use crate::math::{Vec3, tan};
use crate::random::{Family, Stream};
use crate::shape::{Plane, Polyhedron};

/// A face whose normal is steeper than 45 degrees belongs to a bed.
const BED_NORMAL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// What a cut wall asks for: see [`crate::generate::Arrangement::Cut`].
pub(crate) struct Cuts<'a> {
    pub(crate) sizes: &'a Sizes,
    pub(crate) factor: f64,
    pub(crate) dip: &'a Family,
    pub(crate) dip_about: DipAbout,
}

/// Cuts the outline into stones and sorts them from the base up, then from x = 0, then from the back.
pub(crate) fn lay(draft: &mut Draft, ask: &Cuts) -> Result<Vec<Stone>, Fault> {
    let piece = whole(draft)?;
    let mut streams = NodeStreams::new(draft, 1);
    let plan = plan(draft, ask, &piece, &mut streams)?;
    let mut stones = Vec::new();
    grow(draft, ask, Node { piece, id: 1, streams, plan }, &mut stones)?;
    stones.sort_by(|a, b| {
        let (p, q) = (a.shape.bounds().0, b.shape.bounds().0);
        p.z.total_cmp(&q.z).then(p.x.total_cmp(&q.x)).then(p.y.total_cmp(&q.y))
    });
    Ok(stones)
}

/// The solid to cut: the outline, in a cell less half a slot at either end, which together are one head joint.
fn whole(draft: &mut Draft) -> Result<Polyhedron, Fault> {
    let (solid, gap) = (draft.layout.outline.solid(), draft.layout.head_joint_gap);
    if draft.extent == Extent::Wall {
        return Ok(solid);
    }
    let at = |offset| Plane { normal: Vec3::x(), offset };
    let length = draft.layout.outline.length;
    let rest = solid.cut(&at(0.5 * gap), CUT_TOLERANCE).1;
    let rest = rest.and_then(|rest| rest.cut(&at(length - 0.5 * gap), CUT_TOLERANCE).0);
    draft.gaps += gap * draft.layout.outline.section_area();
    rest.ok_or(Fault::Cut { node: 1, draws: 1, fault: CutFault::Stone(StoneFault::Vanished) })
}

/// A piece of the wall and where it is to be cut.
struct Node {
    piece: Polyhedron,
    /// 1 for the whole wall, 2 i and 2 i + 1 for the parts of i: the key of the streams.
    id: u64,
    streams: NodeStreams,
    plan: Plan,
}

/// The streams of one node, so that a redraw in one part of the wall moves nothing in another.
struct NodeStreams {
    length: Stream,
    height: Stream,
    dip: Stream,
    planned: bool,
    dipped: bool,
}

impl NodeStreams {
    fn new(draft: &Draft, id: u64) -> Self {
        NodeStreams {
            length: draft.stream("stone length", id),
            height: draft.stream("stone height", id),
            dip: draft.stream("joint dip", id),
            planned: false,
            dipped: false,
        }
    }
}

/// Where a piece may be cut, each with the number of targets that its size holds; both `None` when it has its size.
#[derive(Clone, Copy)]
struct Plan {
    head: Option<(Vec3, f64)>,
    bed: Option<(Vec3, f64)>,
    /// Length and height of the piece, measured through its centroid (m).
    size: [f64; 2],
}

#[derive(Clone, Copy)]
enum Joint {
    Head(Vec3),
    Bed(Vec3),
}

impl Plan {
    /// The cut to make: across the size that exceeds its target more, or across the `other` one where both do.
    fn joint(&self, other: bool) -> Option<Joint> {
        match (self.head, self.bed) {
            (Some((at, by)), Some((bed, bed_by))) => {
                Some(if (by >= bed_by) != other { Joint::Head(at) } else { Joint::Bed(bed) })
            }
            (Some((at, _)), None) => Some(Joint::Head(at)),
            (None, Some((at, _))) => Some(Joint::Bed(at)),
            (None, None) => None,
        }
    }
}

/// Draws the targets of a piece. A size of n targets (rounded, n at least 2) is to be cut n / 2 (rounded down)
/// targets from its lower end.
fn plan(draft: &mut Draft, ask: &Cuts, piece: &Polyhedron, streams: &mut NodeStreams) -> Result<Plan, Fault> {
    let least = draft.layout.limits.min_size;
    let [length, height] = match ask.sizes {
        Sizes::Apart { length, height } => [
            draft.draw("stone length", length, ask.factor, least, &mut streams.length)?,
            draft.draw("stone height", height, ask.factor, least, &mut streams.height)?,
        ],
        Sizes::Together { stones } => draft.draw_several("stone length and height", least, || {
            stones.sample(&mut streams.length).map(|size| ask.factor * size)
        })?,
    };
    if !streams.planned {
        streams.planned = true;
        draft.tally.first_lengths.push(length);
        draft.tally.first_heights.push(height);
    }
    let centroid = piece.mass_properties().centroid;
    let along = |axis: Vec3, target: f64| {
        let (from, to) = chord(piece, &centroid, &axis);
        let count = ((to - from) / target).round();
        let at = centroid + axis * (from + (0.5 * count).floor() * target);
        ((count >= 2.0).then_some((at, (to - from) / target)), to - from)
    };
    let (head, along_wall) = along(Vec3::x(), length);
    let (bed, upwards) = along(Vec3::z(), height);
    Ok(Plan { head, bed, size: [along_wall, upwards] })
}

/// Cuts a node and its parts until all have their sizes.
fn grow(draft: &mut Draft, ask: &Cuts, mut node: Node, stones: &mut Vec<Stone>) -> Result<(), Fault> {
    if stones.len() > MAX_STONES || node.id > u64::MAX / 4 {
        return Err(Fault::TooMany { limit: MAX_STONES });
    }
    let draws = draft.layout.limits.max_redraws + 1;
    let ids = [2 * node.id, 2 * node.id + 1];
    let mut parts_streams = ids.map(|id| NodeStreams::new(draft, id));
    let mut draw = 0;
    loop {
        let fault = match node.plan.joint(2 * draw >= draws) {
            None => match dress(draft, &node.piece, node.id) {
                Ok(parts) => {
                    draft.realised.lengths.push(node.plan.size[0]);
                    draft.realised.heights.push(node.plan.size[1]);
                    stones.extend(parts);
                    return Ok(());
                }
                Err(fault) => fault.into(),
            },
            Some(joint) => match cut(draft, ask, &mut node, joint) {
                Ok(cut) => match plan_parts(draft, ask, &cut.parts, ids, &mut parts_streams)? {
                    Ok(plans) => {
                        draft.gaps += cut.gap;
                        draft.realised.dips.extend(cut.dips);
                        for (((piece, plan), id), streams) in
                            cut.parts.into_iter().zip(plans).zip(ids).zip(parts_streams)
                        {
                            grow(draft, ask, Node { piece, id, streams, plan }, stones)?;
                        }
                        return Ok(());
                    }
                    Err(fault) => fault.into(),
                },
                Err(fault) => fault,
            },
        };
        draft.tally.redraws += 1;
        draw += 1;
        if draw == draws {
            return Err(Fault::Cut { node: node.id, draws, fault });
        }
        node.plan = plan(draft, ask, &node.piece, &mut node.streams)?;
    }
}

/// The plans of both parts of a cut; refused when a part that has its size is no stone, or a part is too thin.
fn plan_parts(
    draft: &mut Draft,
    ask: &Cuts,
    parts: &[Polyhedron; 2],
    ids: [u64; 2],
    streams: &mut [NodeStreams; 2],
) -> Result<Result<[Plan; 2], StoneFault>, Fault> {
    let limit = draft.layout.limits.min_size;
    let mut plans = [Plan { head: None, bed: None, size: [0.0; 2] }; 2];
    for i in 0..2 {
        let width = parts[i].smallest_width();
        if width < limit {
            return Ok(Err(StoneFault::Thin { width, limit }));
        }
        plans[i] = plan(draft, ask, &parts[i], &mut streams[i])?;
        if plans[i].joint(false).is_none()
            && let Err(fault) = dress(draft, &parts[i], ids[i])
        {
            return Ok(Err(fault));
        }
    }
    Ok(Ok(plans))
}

/// The stones of a piece that has its size.
fn dress(draft: &Draft, piece: &Polyhedron, id: u64) -> Result<Vec<Stone>, StoneFault> {
    let header = draft.is_header(&mut draft.stream("header", id));
    draft.dress(piece.clone(), header, 0, id)
}

/// What one joint plane makes of a piece.
struct Cut {
    parts: [Polyhedron; 2],
    /// Volume of the open slot between them (m^3).
    gap: f64,
    /// Dips drawn for it (rad).
    dips: Vec<f64>,
}

fn cut(draft: &mut Draft, ask: &Cuts, node: &mut Node, joint: Joint) -> Result<Cut, CutFault> {
    match joint {
        Joint::Head(at) => cut_head(draft, &node.piece, at.x),
        Joint::Bed(at) => cut_bed(draft, ask, node, at),
    }
}

/// A vertical plane across the wall, opened to a slot.
fn cut_head(draft: &Draft, piece: &Polyhedron, x: f64) -> Result<Cut, CutFault> {
    let gap = draft.layout.head_joint_gap;
    let at = |offset| Plane { normal: Vec3::x(), offset };
    let vanished = CutFault::Stone(StoneFault::Vanished);
    let (left, rest) = piece.cut(&at(x - 0.5 * gap), CUT_TOLERANCE);
    let (left, rest) = (left.ok_or(vanished)?, rest.ok_or(vanished)?);
    if gap <= CUT_TOLERANCE {
        return Ok(Cut { parts: [left, rest], gap: 0.0, dips: Vec::new() });
    }
    let (slot, right) = rest.cut(&at(x + 0.5 * gap), CUT_TOLERANCE);
    let parts = [left, right.ok_or(vanished)?];
    Ok(Cut { parts, gap: slot.ok_or(vanished)?.volume(), dips: Vec::new() })
}

/// A bed with random dips. It may cross no other bed of the piece, nor come closer to one than the smallest size.
fn cut_bed(draft: &mut Draft, ask: &Cuts, node: &mut Node, at: Vec3) -> Result<Cut, CutFault> {
    let dips: Vec<f64> = match ask.dip_about {
        DipAbout::Both => vec![ask.dip.sample(&mut node.streams.dip), ask.dip.sample(&mut node.streams.dip)],
        _ => vec![ask.dip.sample(&mut node.streams.dip)],
    };
    if !node.streams.dipped {
        node.streams.dipped = true;
        draft.tally.first_dips.extend(&dips);
    }
    let [about_x, about_y] = match ask.dip_about {
        DipAbout::LongAxis => [dips[0], 0.0],
        DipAbout::ThicknessAxis => [0.0, dips[0]],
        DipAbout::Both => [dips[0], dips[1]],
    };
    let plane = Plane::through(at, Vec3::new(-tan(about_y), -tan(about_x), 1.0));
    let limit = draft.layout.limits.min_size;
    for face in 0..node.piece.faces.len() {
        let up = node.piece.face_plane(face).normal.z;
        let clears = |v: Vec3| plane.distance(&v) * up.signum() >= limit;
        if up.abs() > BED_NORMAL && !node.piece.face_vertices(face).all(clears) {
            return Err(CutFault::Crosses { limit });
        }
    }
    match node.piece.cut(&plane, CUT_TOLERANCE) {
        (Some(below), Some(above)) => Ok(Cut { parts: [below, above], gap: 0.0, dips }),
        _ => Err(CutFault::Stone(StoneFault::Vanished)),
    }
}

/// Where the line through `point` along the unit vector `axis` enters and leaves a solid that contains the point,
/// as distances from it (m).
fn chord(solid: &Polyhedron, point: &Vec3, axis: &Vec3) -> (f64, f64) {
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for face in 0..solid.faces.len() {
        let plane = solid.face_plane(face);
        let (distance, rate) = (plane.distance(point), plane.normal.dot(axis));
        if rate > 0.0 {
            to = to.min(-distance / rate);
        } else if rate < 0.0 {
            from = from.max(-distance / rate);
        }
    }
    (from, to)
}
