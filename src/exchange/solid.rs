//! From the vertices and faces of a file to a convex solid: repeated vertices welded, coplanar faces merged.
//!
//! Programs for drawing write a plane face as triangles and a corner once per face. A joint is the overlap of two
//! whole faces, so the pieces are put together again before the solid is checked.

use std::collections::BTreeMap;

use crate::exchange::fault::Fault;
use crate::math::Vec3;
use crate::shape::{Polyhedron, ShapeFault};

/// Share of a block's size within which its faces must be plane and convex; rounded coordinates must pass.
pub const FLATNESS: f64 = 1e-4;
/// Share of a block's size within which vertices are one and the same.
const WELD: f64 = 1e-7;
/// Faces of one plane look the same way: cosine of 60 degrees. Only faces of a very thin block come near it.
const SAME_SIDE: f64 = 0.5;
/// Most corners of a block after merging; the time of an overlap check grows with the cube of it.
pub const MOST_CORNERS: usize = 200;

/// A face under construction, with its number in the file.
struct Face {
    number: usize,
    corners: Vec<u32>,
}

/// The solid with these vertices (m) and faces, or everything that is wrong with it.
///
/// `faces` name existing vertices, each at most once per face. A solid in which nothing is repeated or in pieces
/// comes back as it is, to the bit.
pub fn solid(block: &str, vertices: &[Vec3], faces: &[Vec<u32>]) -> Result<Polyhedron, Vec<Fault>> {
    let size = diagonal(vertices);
    let flat = FLATNESS * size;
    let welded = weld(vertices, WELD * size);
    let faces: Vec<Face> = faces
        .iter()
        .enumerate()
        .map(|(number, face)| Face { number, corners: without_repeats(face, &welded) })
        .filter(|face| face.corners.len() >= 3)
        .collect();
    let mut faults = unpaired_edges(block, vertices, &faces);
    faults.extend(bent_faces(block, vertices, &faces, flat));
    if !faults.is_empty() {
        return Err(faults);
    }
    let merged = without_straight_corners(vertices, merge(vertices, faces, flat), flat);
    let (shape, of_file) = compact(vertices, &merged);
    if shape.vertices.len() > MOST_CORNERS {
        return Err(vec![Fault::of(
            block,
            format!("{} corners", shape.vertices.len()),
            format!("at most {MOST_CORNERS} corners of a block"),
            "simplify the stone's surface",
        )]);
    }
    let numbers: Vec<usize> = merged.iter().map(|face| face.number).collect();
    shape.validate(flat).map_err(|fault| vec![told(block, &shape, &numbers, &of_file, &fault, flat)])?;
    let width = shape.smallest_width();
    if width <= 2.0 * flat {
        return Err(vec![Fault::of(
            block,
            format!("the solid is only {width:.3e} m thick and {size:.3e} m large"),
            format!("a thickness above {:e} of the block's size", 2.0 * FLATNESS),
            "give it a thickness, or remove it",
        )]);
    }
    Ok(shape)
}

/// Diagonal of the box around the vertices (m).
pub fn diagonal(vertices: &[Vec3]) -> f64 {
    let (low, high) = Polyhedron { vertices: vertices.to_vec(), faces: Vec::new() }.bounds();
    (high - low).norm()
}

/// For every vertex the one that stands for it: itself, or one of lower number in the same place.
fn weld(vertices: &[Vec3], tolerance: f64) -> Vec<u32> {
    let mut stands: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut order: Vec<usize> = (0..vertices.len()).collect();
    order.sort_by(|&a, &b| vertices[a].x.total_cmp(&vertices[b].x).then(a.cmp(&b)));
    for (k, &a) in order.iter().enumerate() {
        for &b in order[k + 1..].iter().take_while(|&&b| vertices[b].x - vertices[a].x <= tolerance) {
            if (vertices[b] - vertices[a]).norm() <= tolerance {
                let lowest = stands[a].min(stands[b]);
                stands[a] = lowest;
                stands[b] = lowest;
            }
        }
    }
    // Those that stand for others come first, so that one pass leads everyone to the last of the chain.
    for v in 0..stands.len() {
        stands[v] = stands[stands[v] as usize];
    }
    stands
}

/// The face by the vertices that stand for its own; an edge that has shrunk to nothing is gone.
fn without_repeats(face: &[u32], stands: &[u32]) -> Vec<u32> {
    let mut corners: Vec<u32> = face.iter().map(|&v| stands[v as usize]).collect();
    corners.dedup();
    while corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    corners
}

fn edges(corners: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]))
}

fn polyhedron(vertices: &[Vec3], faces: &[Face]) -> Polyhedron {
    Polyhedron { vertices: vertices.to_vec(), faces: faces.iter().map(|face| face.corners.clone()).collect() }
}

/// Edges that do not have exactly one neighbour running the other way: the solid is open or a face is turned over.
fn unpaired_edges(block: &str, vertices: &[Vec3], faces: &[Face]) -> Vec<Fault> {
    let mut users: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for face in faces {
        for edge in edges(&face.corners) {
            users.entry(edge).or_default().push(face.number);
        }
    }
    let place = |v: u32| {
        let p = vertices[v as usize];
        format!("({}, {}, {}) m", p.x, p.y, p.z)
    };
    let (mut open, mut turned) = (Vec::new(), Vec::new());
    for (&(from, to), own) in &users {
        if own.len() > 1 {
            turned.push((from, to, own.clone()));
        } else if !users.contains_key(&(to, from)) {
            open.push((from, to, own[0]));
        }
    }
    let allowed = "a closed solid: every edge shared by two faces that run it in opposite ways";
    let mut faults = Vec::new();
    let severalfold = turned
        .iter()
        .find(|(from, to, own)| users.get(&(*to, *from)).is_some_and(|other| other.len() == own.len()));
    if let Some((from, to, own)) = severalfold {
        faults.push(Fault::of(
            block,
            format!("{} faces meet at the edge {from}-{to}", 2 * own.len()),
            allowed,
            "several solids in one block? Write one block (in OBJ: one object) per solid",
        ));
    } else if let Some((from, to, own)) = turned.first() {
        faults.push(Fault::of(
            block,
            format!("faces {} and {} run the edge {from}-{to} the same way", own[0], own[1]),
            allowed,
            format!("face {} or {} is inside out (or there twice): list its vertices counter-clockwise seen from outside", own[0], own[1]),
        ));
    } else if let Some(&(from, to, face)) = open.first() {
        faults.push(Fault::of(
            block,
            format!(
                "the solid is open: {} edges have no neighbour, first the edge {from}-{to} of face {face} from {} to {}",
                open.len(),
                place(from),
                place(to)
            ),
            allowed,
            "add the missing face, or let both faces use the same two vertices",
        ));
    }
    faults
}

/// Faces of the file whose vertices do not lie in a plane.
fn bent_faces(block: &str, vertices: &[Vec3], faces: &[Face], flat: f64) -> Vec<Fault> {
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
                format!("at most {flat:.1e} m, {FLATNESS:e} of the block's size"),
                "move the vertex into the plane, or split the face into triangles if the solid stays convex",
            ));
        }
    }
    faults
}

/// Faces of one plane that share edges, put together; a group whose outline is no single loop stays in pieces.
fn merge(vertices: &[Vec3], faces: Vec<Face>, flat: f64) -> Vec<Face> {
    let whole = polyhedron(vertices, &faces);
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
            let (area, sliver) = (areas[f].norm(), WELD / FLATNESS * flat * flat);
            let same_side = areas[f].dot(&plane.normal) > SAME_SIDE * area || area < sliver;
            same_side && whole.face_vertices(f).all(|v| plane.distance(&v).abs() <= flat)
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
        match outline(&faces, &members) {
            Some(corners) => merged.push(Face { number: faces[members[0]].number, corners }),
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
                "divide the block into convex ones, one per object",
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
