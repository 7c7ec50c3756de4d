//! Pairs of faces that are to be one plane: those that look at each other across a joint, and those of
//! neighbours that lie flush in a face of the wall.

use crate::contact::FACE_COSINE;
use crate::mend::face::{Face, farthest};
use crate::shape::{Frame, Hull, Polygon};

/// Two faces (their numbers), and the area (m^2) on which they see each other; 0 where they lie flush.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// The faces.
    pub faces: (usize, usize),
    /// How much area speaks for it.
    pub area: f64,
    /// Whether they see each other through a slit narrower than the tolerance: corners that are off let stones do so that never meet.
    pub is_slit: bool,
}

/// All pairs within the tolerance (m), of the pairs of blocks that are near each other; those with the largest joints first, flush ones last.
pub fn links(faces: &[Face], near: &[(u32, u32)], within: f64) -> Vec<Link> {
    let blocks = faces.last().map_or(0, |face| face.block + 1);
    let starts: Vec<usize> =
        (0..=blocks).map(|block| faces.partition_point(|face| face.block < block)).collect();
    let of = |block: u32| starts[block as usize]..starts[block as usize + 1];
    let pairs =
        near.iter().flat_map(|&(a, b)| of(a).flat_map(move |one| of(b).map(move |other| (one, other))));
    let pairs = pairs.filter(|(one, other)| !(faces[*one].is_fixed && faces[*other].is_fixed));
    let (mut links, mut same_way, mut met) = (Vec::new(), Vec::new(), vec![false; faces.len()]);
    for pair in pairs {
        let (one, other) = (&faces[pair.0], &faces[pair.1]);
        let cosine = one.plane.normal.dot(&other.plane.normal);
        if cosine >= FACE_COSINE {
            same_way.push(pair);
        } else if cosine <= -FACE_COSINE
            && let Some((area, is_slit)) = shared_area(one, other, within)
        {
            links.push(Link { faces: pair, area, is_slit });
            (met[pair.0], met[pair.1]) = (true, true);
        }
    }
    // Joints of two courses may lie nearly over each other by chance; what is flush is a face of the wall.
    let outer = same_way.into_iter().filter(|(one, other)| !met[*one] && !met[*other]);
    let flush = outer.filter(|(one, other)| is_flush(&faces[*one], &faces[*other], within));
    links.extend(flush.map(|faces| Link { faces, area: 0.0, is_slit: true }));
    links.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.faces.cmp(&b.faces)));
    links
}

/// The area on which two faces that look at each other meet, and whether it is a slit narrower than the tolerance; `None` where they do not
/// meet, or are further apart than the tolerance anywhere on it.
fn shared_area(one: &Face, other: &Face, within: f64) -> Option<(f64, bool)> {
    let frame = Frame::on_plane(one.corners[0], one.plane.normal);
    let outline =
        |face: &Face| Polygon { vertices: face.corners.iter().map(|corner| frame.project(corner)).collect() };
    let mut facing = outline(other);
    // Seen from the first face the other runs clockwise.
    facing.vertices.reverse();
    let shared = outline(one).intersection(&facing);
    if shared.vertices.len() < 3 {
        return None;
    }
    let normal = other.plane.normal;
    let gap = |st: &[f64; 2]| {
        let on_one = frame.lift(*st);
        // Square to the first face, as far as the other one's plane.
        other.plane.distance(&on_one) / -normal.dot(&frame.normal)
    };
    let is_near = shared.vertices.iter().all(|st| gap(st).abs() <= within);
    let area = shared.area();
    (is_near && area > 0.0).then(|| (area, Hull::of(shared.vertices).width() < within))
}

/// Whether each of two faces that look the same way lies in the other's plane.
fn is_flush(one: &Face, other: &Face, within: f64) -> bool {
    farthest(one, &other.plane) <= within && farthest(other, &one.plane) <= within
}
