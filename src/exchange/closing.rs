//! Puts the faces of a solid together: corners written once per face, and corners of one face on the edge of another.
//!
//! A convex block is known by its corners. Programs for drawing write each of them once per face, rounded to single precision,
//! and let a corner of one face lie on the edge of another (a T-junction). Neither is a fault as long as the faces close
//! within the tolerance that plane and convex faces have.

use std::collections::{BTreeMap, BTreeSet};

use crate::exchange::fault::Fault;
use crate::math::Vec3;

/// Shares of a block's size within which corners are one, tried from the narrowest: small features of a solid that closes
/// without stay as they are.
const WELDS: [f64; 3] = [1e-7, 1e-6, 1e-5];
/// Faces that pass each other by less than this share of the block's size belong together, but for their rounding; a
/// missing face leaves a wider hole.
const NEARLY: f64 = 0.05;
/// Ends of open edges that are looked at to say so; a surface in shreds has thousands.
const ENDS_LOOKED_AT: usize = 200;

/// A face under construction, with its number in the file.
#[derive(Clone, Debug)]
pub struct Face {
    /// Its number in the file.
    pub number: usize,
    /// Vertex numbers of the file, counter-clockwise seen from outside.
    pub corners: Vec<u32>,
}

/// A closed surface.
#[derive(Clone, Debug)]
pub struct Closed {
    /// The file's vertices; those that others stand for are not used.
    pub vertices: Vec<Vec3>,
    /// The faces that are left.
    pub faces: Vec<Face>,
    /// How far apart (m) corners were that have been put together.
    pub apart: f64,
}

/// Puts the faces together within the narrowest tolerance that closes them, at most `widest` (m), for a block of a size (m).
///
/// # Errors
/// Why they do not close.
pub fn close(
    block: &str,
    vertices: &[Vec3],
    faces: &[Vec<u32>],
    size: f64,
    widest: f64,
) -> Result<Closed, Vec<Fault>> {
    let mut last = None;
    for tolerance in WELDS.map(|share| share * size).into_iter().chain([widest]) {
        let mut tried = welded(vertices, faces, tolerance);
        if !is_paired(&tried.faces) {
            split(&mut tried, tolerance);
        }
        if is_paired(&tried.faces) {
            return Ok(tried);
        }
        last = Some(tried);
    }
    let tried = last.expect("there is a tolerance");
    Err(unpaired_edges(block, &tried, size, widest))
}

/// Whether faces close by themselves; see [`close`].
pub fn closes(vertices: &[Vec3], faces: &[Vec<u32>], size: f64, widest: f64) -> bool {
    close("", vertices, faces, size, widest).is_ok()
}

/// The edges of a face, in its own way round.
pub fn edges(corners: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]))
}

/// The faces by the corners that stand for their own; faces that have shrunk to nothing are gone.
fn welded(vertices: &[Vec3], faces: &[Vec<u32>], tolerance: f64) -> Closed {
    let stands = weld(vertices, tolerance);
    let mut places = vertices.to_vec();
    let mut of: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (v, &root) in stands.iter().enumerate() {
        of.entry(root).or_default().push(v);
    }
    let mut apart: f64 = 0.0;
    for (&root, own) in of.iter().filter(|(_, own)| own.len() > 1) {
        let first = vertices[root as usize];
        // Copies that are the same to the bit leave it as it is.
        if own.iter().any(|&v| vertices[v] != first) {
            places[root as usize] = own.iter().map(|&v| vertices[v]).sum::<Vec3>() / own.len() as f64;
            apart = own.iter().map(|&v| (vertices[v] - first).norm()).fold(apart, f64::max);
        }
    }
    let faces = faces
        .iter()
        .enumerate()
        .map(|(number, face)| Face { number, corners: without_repeats(face, &stands) })
        .filter(|face| face.corners.len() >= 3)
        .collect();
    Closed { vertices: places, faces, apart }
}

/// For every vertex the one that stands for it: the one of lowest number in the same place.
pub fn weld(vertices: &[Vec3], tolerance: f64) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..vertices.len() as u32).collect();
    fn root(parent: &mut [u32], mut v: u32) -> u32 {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    }
    let mut order: Vec<usize> = (0..vertices.len()).collect();
    order.sort_by(|&a, &b| vertices[a].x.total_cmp(&vertices[b].x).then(a.cmp(&b)));
    for (k, &a) in order.iter().enumerate() {
        for &b in order[k + 1..].iter().take_while(|&&b| vertices[b].x - vertices[a].x <= tolerance) {
            if (vertices[b] - vertices[a]).norm() <= tolerance {
                let (p, q) = (root(&mut parent, a as u32), root(&mut parent, b as u32));
                parent[p.max(q) as usize] = p.min(q);
            }
        }
    }
    (0..vertices.len() as u32).map(|v| root(&mut parent, v)).collect()
}

/// The face by the vertices that stand for its own; an edge that has shrunk to nothing is gone.
pub fn without_repeats(face: &[u32], stands: &[u32]) -> Vec<u32> {
    let mut corners: Vec<u32> = face.iter().map(|&v| stands[v as usize]).collect();
    corners.dedup();
    while corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    corners
}

/// The faces that run each edge.
fn users(faces: &[Face]) -> BTreeMap<(u32, u32), Vec<usize>> {
    let mut users: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (f, face) in faces.iter().enumerate() {
        for edge in edges(&face.corners) {
            users.entry(edge).or_default().push(f);
        }
    }
    users
}

/// Whether every edge is run once each way.
fn is_paired(faces: &[Face]) -> bool {
    let users = users(faces);
    users.iter().all(|(&(a, b), own)| own.len() == 1 && users.contains_key(&(b, a)))
}

/// Edges that no face runs the other way, with their face.
fn open_edges(faces: &[Face]) -> Vec<(u32, u32, usize)> {
    let users = users(faces);
    let open = users.iter().filter(|((a, b), _)| !users.contains_key(&(*b, *a)));
    open.map(|(&(a, b), own)| (a, b, own[0])).collect()
}

/// Lets edges without a neighbour run through the corners that lie on them.
fn split(closed: &mut Closed, tolerance: f64) {
    let open = open_edges(&closed.faces);
    let place = |v: u32| closed.vertices[v as usize];
    let ends: BTreeSet<u32> = open.iter().flat_map(|&(a, b, _)| [a, b]).collect();
    let mut ends: Vec<u32> = ends.into_iter().collect();
    ends.sort_by(|&a, &b| place(a).x.total_cmp(&place(b).x));
    let open: BTreeSet<(u32, u32)> = open.iter().map(|&(a, b, _)| (a, b)).collect();
    for face in &mut closed.faces {
        let mut corners = Vec::with_capacity(face.corners.len());
        for (a, b) in edges(&face.corners) {
            corners.push(a);
            if !open.contains(&(a, b)) {
                continue;
            }
            let (from, along) = (place(a), place(b) - place(a));
            let low = from.x.min(from.x + along.x) - tolerance;
            let high = from.x.max(from.x + along.x) + tolerance;
            let mut between: Vec<(f64, u32)> = ends[ends.partition_point(|&v| place(v).x < low)..]
                .iter()
                .take_while(|&&v| place(v).x <= high)
                .filter(|v| !face.corners.contains(v))
                .map(|&v| ((place(v) - from).dot(&along) / along.norm_squared(), v))
                .filter(|&(t, v)| t > 0.0 && t < 1.0 && (place(v) - from - along * t).norm() <= tolerance)
                .collect();
            between.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
            corners.extend(between.into_iter().map(|(_, v)| v));
        }
        face.corners = corners;
    }
}

/// Why edges do not have exactly one neighbour running the other way: the solid is open, a face is turned over, or there are
/// several solids.
fn unpaired_edges(block: &str, tried: &Closed, size: f64, widest: f64) -> Vec<Fault> {
    let users = users(&tried.faces);
    let number = |f: usize| tried.faces[f].number;
    let allowed = "a closed solid: every edge shared by two faces that run it in opposite ways";
    let mut turned = users.iter().filter(|(_, own)| own.len() > 1);
    let severalfold = turned
        .clone()
        .find(|((from, to), own)| users.get(&(*to, *from)).is_some_and(|other| other.len() == own.len()));
    if let Some(((from, to), own)) = severalfold {
        return vec![Fault::of(
            block,
            format!("{} faces meet at the edge {from}-{to}", 2 * own.len()),
            allowed,
            "several solids in one block? Write one block (in OBJ: one object) per solid",
        )];
    }
    if let Some(((from, to), own)) = turned.next() {
        let (a, b) = (number(own[0]), number(own[1]));
        return vec![Fault::of(
            block,
            format!("faces {a} and {b} run the edge {from}-{to} the same way"),
            allowed,
            format!(
                "face {a} or {b} is inside out (or there twice): list its vertices counter-clockwise seen from outside"
            ),
        )];
    }
    let open = open_edges(&tried.faces);
    let Some(&(from, to, face)) = open.first() else { return Vec::new() };
    let place = |v: u32| {
        let p = tried.vertices[v as usize];
        format!("({}, {}, {}) m", p.x, p.y, p.z)
    };
    let first = format!(
        "{} edges have no neighbour, first the edge {from}-{to} of face {} from {} to {}",
        open.len(),
        number(face),
        place(from),
        place(to)
    );
    let apart = apart(tried, &open);
    if apart <= NEARLY * size {
        return vec![Fault::of(
            block,
            format!("faces that belong together lie up to {apart:.2e} m apart: {first}"),
            format!("at most {widest:.1e} m between the corners of neighbouring faces"),
            format!("give both faces the same corner, or allow it with --flatness {:.3}mm", 1.1e3 * apart),
        )];
    }
    vec![Fault::of(
        block,
        format!("the solid is open: {first}"),
        allowed,
        "add the missing face, or let both faces use the same two vertices",
    )]
}

/// The farthest (m) that the end of an open edge lies from the open edges of other faces.
fn apart(tried: &Closed, open: &[(u32, u32, usize)]) -> f64 {
    let place = |v: u32| tried.vertices[v as usize];
    let ends: BTreeSet<u32> = open.iter().flat_map(|&(a, b, _)| [a, b]).collect();
    let nearest = |&v: &u32| {
        open.iter()
            .filter(|(.., f)| !tried.faces[*f].corners.contains(&v))
            .map(|&(a, b, _)| {
                let (from, along) = (place(a), place(b) - place(a));
                let t = ((place(v) - from).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                (place(v) - from - along * t).norm()
            })
            .fold(f64::INFINITY, f64::min)
    };
    ends.iter().take(ENDS_LOOKED_AT).map(nearest).fold(0.0, f64::max)
}
