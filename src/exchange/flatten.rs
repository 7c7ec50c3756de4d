//! Warped faces made plane: stones of vaults, and corners that were rounded to a millimetre.
//!
//! Every face becomes the plane through the mean of its corners, square to its vector area; the stone is what lies behind all of
//! these planes. Two stones that share the corners of a face share its plane, so that they meet on all of it. Corners move to
//! where the planes meet.

use crate::exchange::closing::Face;
use crate::exchange::fault::Fault;
use crate::exchange::solid::{bent_faces, polyhedron};
use crate::math::Vec3;
use crate::shape::{Plane, Polyhedron, corners_apart};

/// Planes within the allowed flatness of their corners meet near these, unless they meet at a very sharp angle: corners that
/// would move by so many times the flatness are refused.
const MOST_MOVED: f64 = 10.0;
/// Share of a block's size within which a corner lies on a plane that cuts it: rounding alone.
const ON_PLANE: f64 = 1e-9;
/// Share of a block's size within which the result must be plane and convex: some planes through nearly one point may each be off by
/// [`ON_PLANE`].
const SOUND: f64 = 1e-7;

/// The convex solid behind the planes of the faces, and how far the farthest corner has moved (m).
///
/// # Errors
/// Corners that lie further (m) than allowed off their own faces or outside of others.
pub fn flattened(
    block: &str,
    vertices: &[Vec3],
    faces: &[Face],
    size: f64,
    allowed: f64,
) -> Result<(Polyhedron, f64), Vec<Fault>> {
    let faults = bent_faces(block, vertices, faces, allowed);
    if !faults.is_empty() {
        return Err(faults);
    }
    let whole = polyhedron(vertices, faces);
    let refused = |found: String, fix: &str| {
        let allowed = format!("faces plane and convex to {allowed:.1e} m, as --flatness allows");
        Err(vec![Fault::of(block, found, allowed, fix)])
    };
    let mut corners: Vec<u32> = faces.iter().flat_map(|face| face.corners.iter().copied()).collect();
    corners.sort_unstable();
    corners.dedup();
    let planes: Vec<Plane> = (0..faces.len()).map(|f| whole.face_plane(f)).collect();
    for (plane, face) in planes.iter().zip(faces) {
        let outside = |v: &u32| plane.distance(&vertices[*v as usize]);
        let Some(&worst) = corners.iter().max_by(|a, b| outside(a).total_cmp(&outside(b))) else { continue };
        // A face without area has no plane, and compares as NaN.
        if outside(&worst).is_nan() {
            return refused(format!("face {} has no area", face.number), "remove or repair the face");
        }
        if outside(&worst) > allowed {
            let found = format!(
                "the solid is not convex: vertex {worst} lies {:.3e} m outside face {}",
                outside(&worst),
                face.number
            );
            return refused(
                found,
                "--parts divides it into convex parts of one stone; by hand: parts of one \"group\" in a wall.json, objects name.part1, name.part2 in OBJ",
            );
        }
    }
    let used: Vec<Vec3> = corners.iter().map(|&v| vertices[v as usize]).collect();
    let Some(shape) = Polyhedron::behind(&planes, &used, size, ON_PLANE * size) else {
        return refused("the planes of its faces enclose nothing".to_owned(), "repair the block");
    };
    if let Err(fault) = shape.validate(SOUND * size) {
        return refused(format!("with plane faces the solid is degenerate: {fault}"), "repair the block");
    }
    let moved = corners_apart(&used, &shape.vertices);
    if moved > MOST_MOVED * allowed {
        return refused(
            format!("making its faces plane would move a corner by {moved:.3e} m"),
            "its faces meet at too sharp an angle: repair the block, or divide it",
        );
    }
    Ok((shape, moved))
}
