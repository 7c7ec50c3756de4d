//! Wedge stones: cut off the underside of a stone, at the face of the wall.

use crate::generate::Limits;
use crate::generate::draft::{CUT_TOLERANCE, Draft, Extent, Stone};
use crate::math::Vec3;
use crate::model::Tag;
use crate::shape::{Plane, Polyhedron};

/// Stones of a wall whose lowest corner is not higher than this rest on the ground (m).
const ON_GROUND: f64 = 1e-6;

/// Gives the stated share of the stones above the ground, all those of a cell, a wedge each; the wedge comes before its stone.
///
/// Whether, on which face (as likely front as back where the stone shows on both), how high and how deep has its own
/// stream per stone. A wedge that would leave less than a stone above it, or less than the smallest wedge volume, is
/// redrawn; when the draws are spent the stone keeps its underside, and the wish stays in `wedges_wanted`.
pub(crate) fn insert(draft: &mut Draft, stones: Vec<Stone>) -> Vec<Stone> {
    let Some(wedges) = &draft.layout.wedges else { return stones };
    let mut all = Vec::with_capacity(2 * stones.len());
    for mut stone in stones {
        let wanted = draft.stream("wedge", stone.place).uniform() < wedges.share;
        let has_bed = draft.extent == Extent::Cell || stone.shape.bounds().0.z > ON_GROUND;
        let may = has_bed && (stone.shows[0] || stone.shows[1]);
        if !(wanted && may) {
            all.push(stone);
            continue;
        }
        draft.realised.wedges_wanted += 1;
        let mut faces = draft.stream("wedge face", stone.place);
        let mut heights = draft.stream("wedge height", stone.place);
        let mut depths = draft.stream("wedge depth", stone.place);
        let front = stone.shows[1] && (faces.uniform() < 0.5 || !stone.shows[0]);
        for _ in 0..=draft.layout.limits.max_redraws {
            let (height, depth) = (wedges.height.sample(&mut heights), wedges.depth.sample(&mut depths));
            let Some((wedge, rest)) = split(&stone.shape, front, height, depth, &draft.layout.limits) else {
                draft.tally.redraws += 1;
                continue;
            };
            draft.realised.wedge_sizes.push([height, depth]);
            all.push(Stone { shape: wedge, tag: Tag::Wedge, place: stone.place, shows: [!front, front] });
            stone.shape = rest;
            break;
        }
        all.push(stone);
    }
    all
}

/// Cuts a wedge off the underside of a stone: its thick end is `height` tall on the front or back face, its thin edge
/// lies on the stone's bed `depth` inside the wall, both parallel to the edge between bed and face.
///
/// `None` when bed and face do not meet, when the wedge would be no triangular prism or smaller than the limit, or
/// when bed, face or the rest of the stone would be left smaller than a stone may be.
fn split(
    stone: &Polyhedron,
    front: bool,
    height: f64,
    depth: f64,
    limits: &Limits,
) -> Option<(Polyhedron, Polyhedron)> {
    let positive = height > 0.0 && depth > 0.0;
    if !positive {
        return None;
    }
    let outwards = if front { Vec3::y() } else { -Vec3::y() };
    let (bed, face) = (facing(stone, &-Vec3::z())?, facing(stone, &outwards)?);
    let (from, to) = shared_edge(stone, bed, face)?;
    let (edge, middle) = (to - from, 0.5 * (from + to));
    // Seen from outside, a face lies to the left of its edges; the face runs the shared edge the other way.
    let inwards = stone.face_plane(bed).normal.cross(&edge);
    let upwards = stone.face_plane(face).normal.cross(&-edge);
    let (into_wall, rise) = (-inwards.dot(&outwards), upwards.z);
    if into_wall <= 0.0 || rise <= 0.0 {
        return None;
    }
    let deepest = least_but_edge(stone, bed, |v| (middle - v).dot(&outwards));
    let highest = least_but_edge(stone, face, |v| v.z - middle.z);
    if depth + limits.min_size > deepest || height + limits.min_size > highest {
        return None;
    }
    let (thin, thick) = (middle + inwards * (depth / into_wall), middle + upwards * (height / rise));
    let mut plane = Plane::through(thin, edge.cross(&(thick - thin)));
    if plane.distance(&middle) > 0.0 {
        plane = plane.flipped();
    }
    let (Some(wedge), Some(rest)) = stone.cut(&plane, CUT_TOLERANCE) else { return None };
    let is_prism = wedge.vertices.len() == 6 && wedge.faces.len() == 5;
    (is_prism && wedge.volume() > limits.min_volume && limits.check(&rest).is_ok()).then_some((wedge, rest))
}

/// The face whose outward normal is nearest to `direction`, within 45 degrees of it.
fn facing(stone: &Polyhedron, direction: &Vec3) -> Option<usize> {
    let along = |face: usize| stone.face_plane(face).normal.dot(direction);
    let face = (0..stone.faces.len()).max_by(|&a, &b| along(a).total_cmp(&along(b)))?;
    (along(face) > std::f64::consts::FRAC_1_SQRT_2).then_some(face)
}

/// The edge shared by two faces, in the direction in which the first one runs it.
fn shared_edge(stone: &Polyhedron, face: usize, other: usize) -> Option<(Vec3, Vec3)> {
    let edges = |f: usize| {
        let vertices = &stone.faces[f];
        (0..vertices.len()).map(move |i| (vertices[i], vertices[(i + 1) % vertices.len()]))
    };
    edges(face)
        .find(|&(a, b)| edges(other).any(|edge| edge == (b, a)))
        .map(|(a, b)| (stone.vertices[a as usize], stone.vertices[b as usize]))
}

/// The least `measure` among the vertices of a face, without the two nearest to 0: those of the shared edge.
fn least_but_edge(stone: &Polyhedron, face: usize, measure: impl Fn(Vec3) -> f64) -> f64 {
    let mut measures: Vec<f64> = stone.face_vertices(face).map(measure).collect();
    measures.sort_by(f64::total_cmp);
    measures.get(2).copied().unwrap_or(0.0)
}
