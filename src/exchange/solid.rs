//! From the vertices and faces of a file to a convex solid: corners put together, coplanar faces merged, and where it is allowed
//! warped faces made plane.
//!
//! Programs for drawing write a plane face as triangles and a corner once per face. A joint is the overlap of two
//! whole faces, so the pieces are put together again before the solid is checked.

use std::collections::BTreeMap;

use crate::exchange::closing::{Closed, Face, close, edges};
use crate::exchange::fault::Fault;
use crate::exchange::flatten::flattened;
use crate::exchange::parts::convex_parts;
use crate::math::Vec3;
use crate::shape::{Polyhedron, ShapeFault};

/// Share of a block's size within which its faces must close, be plane and convex; rounded coordinates must pass.
pub const FLATNESS: f64 = 1e-4;
/// A face with less area than this share of `FLATNESS` squared of the block's size squared has no direction.
const SLIVER: f64 = 1e-3;
/// Faces of one plane look the same way: cosine of 60 degrees. Only faces of a very thin block come near it.
const SAME_SIDE: f64 = 0.5;
/// A dent of so many times the usual flatness, 2 % of the block's size, may be a warped face; a deeper one is a shape.
const NEARLY_CONVEX: f64 = 200.0;
/// Most that faces may be warped, as a share of the block's size: a stone that is more so has another shape.
const MOST_WARPED: f64 = 0.05;
/// Most corners of a block after merging; the time of an overlap check grows with the cube of it.
pub const MOST_CORNERS: usize = 200;

/// A solid, and what was done to the file's corners for it.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Its shape (m).
    pub shape: Polyhedron,
    /// How far apart (m) corners were that have been put together.
    pub apart: f64,
    /// How far (m) corners have been moved to make warped faces plane; `None` where they were plane.
    pub moved: Option<f64>,
}

/// The solid with these vertices (m) and faces, or everything that is wrong with it.
///
/// `faces` name existing vertices, each at most once per face. A solid in which nothing is repeated, in pieces or warped
/// comes back as it is, to the bit. `flatness` (m) allows more than the usual [`FLATNESS`].
pub fn solid(
    block: &str,
    vertices: &[Vec3],
    faces: &[Vec<u32>],
    flatness: Option<f64>,
) -> Result<Solid, Vec<Fault>> {
    let size = diagonal(vertices);
    let flat = FLATNESS * size;
    let allowed = flatness.map_or(flat, |asked| asked.min(MOST_WARPED * size).max(flat));
    let closed = close(block, vertices, faces, size, allowed)?;
    let apart = closed.apart;
    let plane = plane_faced(block, &closed, flat);
    let (shape, moved) = match (plane, warped(&closed, flat, allowed)) {
        (Ok(shape), None) => (shape, None),
        (Err(faults), None) => return Err(faults),
        (_, Some(faces)) => {
            let (shape, moved) = flattened(block, &closed.vertices, &faces, size, allowed)?;
            (shape, Some(moved))
        }
    };
    sound(block, &shape, size, flat)?;
    Ok(Solid { shape, apart, moved })
}

/// The convex parts of a closed solid with plane faces that is concave; `None` where there are none.
pub fn divided(block: &str, vertices: &[Vec3], faces: &[Vec<u32>]) -> Option<Vec<Polyhedron>> {
    let size = diagonal(vertices);
    let flat = FLATNESS * size;
    let closed = close(block, vertices, faces, size, flat).ok()?;
    if !bent_faces(block, &closed.vertices, &closed.faces, flat).is_empty() {
        return None;
    }
    let merged = merge(&closed.vertices, closed.faces.clone(), flat, flat);
    let parts = convex_parts(&closed.vertices, &merged, size)
        .or_else(|| convex_parts(&closed.vertices, &closed.faces, size))?;
    parts.iter().all(|part| sound(block, part, size, 0.0).is_ok()).then_some(parts)
}

/// The faces to be made plane; `None` where no more than the usual is allowed, or where that leaves them as they are: so a face
/// that two stones share becomes the same plane for both, whether it is convex or concave for a stone.
fn warped(closed: &Closed, flat: f64, allowed: f64) -> Option<Vec<Face>> {
    let vertices = &closed.vertices;
    let usual = merge(vertices, closed.faces.clone(), flat, flat);
    let pieces = usual.len();
    let bent = |faces: &[Face]| !bent_faces("", vertices, faces, flat).is_empty();
    let merged = (allowed > flat).then(|| merge(vertices, usual, allowed, flat))?;
    let is_warped = merged.len() < pieces || bent(&merged) || plane_faced("", closed, flat).is_err();
    is_warped.then(|| without_straight_corners(vertices, merged, flat))
}

/// The solid whose faces are plane as they are.
fn plane_faced(block: &str, closed: &Closed, flat: f64) -> Result<Polyhedron, Vec<Fault>> {
    let vertices = &closed.vertices;
    let faults = bent_faces(block, vertices, &closed.faces, flat);
    if !faults.is_empty() {
        return Err(faults);
    }
    let merged = without_straight_corners(vertices, merge(vertices, closed.faces.clone(), flat, flat), flat);
    let (shape, of_file) = compact(vertices, &merged);
    let numbers: Vec<usize> = merged.iter().map(|face| face.number).collect();
    if shape.vertices.len() <= MOST_CORNERS {
        shape.validate(flat).map_err(|fault| vec![told(block, &shape, &numbers, &of_file, &fault, flat)])?;
    }
    Ok(shape)
}

/// Not too many corners and thick enough.
fn sound(block: &str, shape: &Polyhedron, size: f64, flat: f64) -> Result<(), Vec<Fault>> {
    if shape.vertices.len() > MOST_CORNERS {
        return Err(vec![Fault::of(
            block,
            format!("{} corners", shape.vertices.len()),
            format!("at most {MOST_CORNERS} corners of a block"),
            "simplify the stone's surface",
        )]);
    }
    let width = shape.smallest_width();
    if width <= 2.0 * flat {
        return Err(vec![Fault::of(
            block,
            format!("the solid is only {width:.3e} m thick and {size:.3e} m large"),
            format!("a thickness above {:e} of the block's size", 2.0 * FLATNESS),
            "give it a thickness, or remove it",
        )]);
    }
    Ok(())
}

/// Diagonal of the box around the vertices (m).
pub fn diagonal(vertices: &[Vec3]) -> f64 {
    let (low, high) = Polyhedron { vertices: vertices.to_vec(), faces: Vec::new() }.bounds();
    (high - low).norm()
}

/// The surface of all vertices and these faces.
pub fn polyhedron(vertices: &[Vec3], faces: &[Face]) -> Polyhedron {
    Polyhedron { vertices: vertices.to_vec(), faces: faces.iter().map(|face| face.corners.clone()).collect() }
}

/// Faces whose vertices do not lie in a plane, to so much (m).
pub fn bent_faces(block: &str, vertices: &[Vec3], faces: &[Face], flat: f64) -> Vec<Fault> {
    let whole = polyhedron(vertices, faces);
    let mut faults = Vec::new();
    for (f, face) in faces.iter().enumerate().filter(|(_, face)| face.corners.len() > 3) {
        let plane = whole.face_plane(f);
        let off = |v: u32| plane.distance(&vertices[v as usize]).abs();
        let worst = face
            .corners
            .iter()
            .copied()
            .fold((0, 0.0), |worst, v| if off(v) > worst.1 { (v, off(v)) } else { worst });
        if worst.1 > flat {
            faults.push(Fault::of(
                block,
                format!(
                    "face {} is not plane: vertex {} lies {:.3e} m off it",
                    face.number, worst.0, worst.1
                ),
                format!("at most {flat:.1e} m ({FLATNESS:e} of the block's size, or what --flatness allows)"),
                format!(
                    "move the vertex into the plane, or let warped faces be made plane: --flatness {:.3}mm",
                    1.1e3 * worst.1
                ),
            ));
        }
    }
    faults
}

/// Faces of one plane that share edges, put together; a group whose outline is no single loop stays in pieces. Within more than
/// the usual flatness only triangles are, a polygon being a face as its maker wants it, and only where all of their corners lie
/// within that of their common plane: in a warped square, whose corners lie off its plane by turns above and below, one of them
/// lies four times as far from the plane of the other three.
fn merge(vertices: &[Vec3], faces: Vec<Face>, within: f64, flat: f64) -> Vec<Face> {
    let whole = polyhedron(vertices, &faces);
    let reach = if within > flat { 4.0 * within } else { within };
    let areas: Vec<Vec3> = (0..faces.len()).map(|f| whole.face_area_vector(f)).collect();
    let owner: BTreeMap<(u32, u32), usize> =
        faces.iter().enumerate().flat_map(|(f, face)| edges(&face.corners).map(move |e| (e, f))).collect();
    // The largest face of a group gives its plane: slivers have none worth the name.
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by(|&a, &b| areas[b].norm_squared().total_cmp(&areas[a].norm_squared()).then(a.cmp(&b)));
    let mut group: Vec<Option<usize>> = vec![None; faces.len()];
    let mut merged = Vec::new();
    for seed in order {
        if group[seed].is_some() {
            continue;
        }
        let plane = whole.face_plane(seed);
        let fits = |f: usize| {
            let (area, sliver) = (areas[f].norm(), SLIVER * flat * flat);
            let same_side = areas[f].dot(&plane.normal) > SAME_SIDE * area || area < sliver;
            let a_piece = within <= flat || (faces[f].corners.len() == 3 && faces[seed].corners.len() == 3);
            a_piece && same_side && whole.face_vertices(f).all(|v| plane.distance(&v).abs() <= reach)
        };
        group[seed] = Some(seed);
        let (mut members, mut next) = (vec![seed], 0);
        while let Some(&face) = members.get(next) {
            next += 1;
            for (from, to) in edges(&faces[face].corners) {
                let Some(&beyond) = owner.get(&(to, from)) else { continue };
                if group[beyond].is_none() && fits(beyond) {
                    group[beyond] = Some(seed);
                    members.push(beyond);
                }
            }
        }
        members.sort_unstable();
        let one = outline(&faces, &members)
            .map(|corners| Face { number: faces[members[0]].number, corners })
            .filter(|face| {
                within <= flat || bent_faces("", vertices, std::slice::from_ref(face), within).is_empty()
            });
        match one {
            Some(face) => merged.push(face),
            None => merged.extend(
                members.iter().map(|&f| Face { number: faces[f].number, corners: faces[f].corners.clone() }),
            ),
        }
    }
    merged.sort_by_key(|face| face.number);
    merged
}

/// The loop around a group of faces; `None` when there are several, or one that touches itself.
fn outline(faces: &[Face], members: &[usize]) -> Option<Vec<u32>> {
    if let [only] = members {
        return Some(faces[*only].corners.clone());
    }
    let all: std::collections::BTreeSet<(u32, u32)> =
        members.iter().flat_map(|&f| edges(&faces[f].corners)).collect();
    let border: Vec<(u32, u32)> = all.iter().copied().filter(|&(a, b)| !all.contains(&(b, a))).collect();
    let next: BTreeMap<u32, u32> = border.iter().copied().collect();
    let start = border.first()?.0;
    let (mut corners, mut at) = (vec![start], *next.get(&start)?);
    while at != start && corners.len() < border.len() {
        corners.push(at);
        at = *next.get(&at)?;
    }
    (at == start && corners.len() == border.len() && next.len() == border.len()).then_some(corners)
}

/// Drops vertices in the middle of a straight edge: they belong to two faces only and bend neither.
fn without_straight_corners(vertices: &[Vec3], mut faces: Vec<Face>, flat: f64) -> Vec<Face> {
    let mut uses: BTreeMap<u32, (u32, bool)> = BTreeMap::new();
    for face in &faces {
        let n = face.corners.len();
        for (i, &v) in face.corners.iter().enumerate() {
            let at = |k: usize| vertices[face.corners[k % n] as usize];
            let (before, here, after) = (at(i + n - 1), at(i), at(i + 1));
            let along = after - before;
            let off = (here - before).cross(&along).norm();
            let straight = off <= flat * along.norm() && (here - before).dot(&(after - here)) > 0.0;
            let use_ = uses.entry(v).or_insert((0, true));
            *use_ = (use_.0 + 1, use_.1 && straight);
        }
    }
    let needed = |v: &u32| uses[v] != (2, true);
    if faces.iter().all(|face| face.corners.iter().filter(|v| needed(v)).count() >= 3) {
        for face in &mut faces {
            face.corners.retain(needed);
        }
    }
    faces
}

/// The solid with the vertices in use only, and the number of each in the file.
fn compact(vertices: &[Vec3], faces: &[Face]) -> (Polyhedron, Vec<u32>) {
    let mut of_file: Vec<u32> = faces.iter().flat_map(|face| face.corners.iter().copied()).collect();
    of_file.sort_unstable();
    of_file.dedup();
    let place: BTreeMap<u32, u32> = of_file.iter().enumerate().map(|(i, &v)| (v, i as u32)).collect();
    let shape = Polyhedron {
        vertices: of_file.iter().map(|&v| vertices[v as usize]).collect(),
        faces: faces.iter().map(|face| face.corners.iter().map(|v| place[v]).collect()).collect(),
    };
    (shape, of_file)
}

/// A fault of the merged shape, in the numbers of the file.
fn told(
    block: &str,
    shape: &Polyhedron,
    numbers: &[usize],
    of_file: &[u32],
    fault: &ShapeFault,
    flat: f64,
) -> Fault {
    let faces = "faces counter-clockwise seen from outside, and a volume above 0";
    match *fault {
        ShapeFault::NoVolume { volume } if volume < 0.0 => Fault::of(
            block,
            format!("the solid is inside out: its volume is {volume:.3e} m^3"),
            faces,
            "reverse the order of the vertices in every face",
        ),
        ShapeFault::NoVolume { volume } => Fault::of(
            block,
            format!("the solid has no volume ({volume:.3e} m^3)"),
            faces,
            "give it a thickness",
        ),
        // Merging has left too little of a solid that was large enough in the file.
        ShapeFault::TooFew => Fault::of(
            block,
            format!("the solid has no volume: its faces lie in one plane, to {flat:.1e} m"),
            faces,
            "give it a thickness",
        ),
        ShapeFault::NotPlane { face, .. } => Fault::of(
            block,
            format!("face {} has no area, or is not plane", numbers[face]),
            "plane faces with an area",
            "remove or repair the face",
        ),
        ShapeFault::NotConvex { face, vertex, distance } => {
            let p = shape.vertices[vertex];
            Fault::of(
                block,
                format!(
                    "the solid is not convex: vertex {} at ({}, {}, {}) m lies {distance:.3e} m outside face {}",
                    of_file[vertex], p.x, p.y, p.z, numbers[face]
                ),
                format!("convex solids, to {flat:.1e} m ({FLATNESS:e} of the block's size)"),
                if distance < NEARLY_CONVEX * flat {
                    format!("let warped faces be made plane: --flatness {:.3}mm", 1.1e3 * distance)
                } else {
                    "--parts divides it into convex parts of one stone; by hand: parts of one \"group\" in a wall.json, objects name.part1, name.part2 in OBJ".to_owned()
                },
            )
        }
        ref other => Fault::of(
            block,
            format!("the solid is degenerate: {other}"),
            "a convex solid with at least 4 corners and 4 faces",
            "repair or remove the block",
        ),
    }
}
