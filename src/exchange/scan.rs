//! A stone from its scan: the convex hull by which it touches others, with what the scan itself holds.
//!
//! A scan is a closed mesh of thousands of triangles and of any shape. Solvers need a convex solid with few corners. The hull has more volume
//! than the stone where that is hollow, so volume, centroid and inertia stay those of the scan ([`crate::model::Block::scan`]). A rough
//! underside would stand on three points: what lies within the bearing depth of the lowest point bears, as one plane face.

use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

use crate::exchange::closing::close;
use crate::exchange::fault::Fault;
use crate::exchange::solid::{FLATNESS, diagonal, solid};
use crate::math::{Vec3, cos, sin};
use crate::shape::{MassProperties, Polyhedron};

/// Directions, evenly over all, in which the hull reaches as far as the scan; with [`AROUND`] fewer than the corners that a block may have.
const DIRECTIONS: usize = 120;
/// Directions in the plane in which the face that bears reaches as far as the points that bear.
const AROUND: usize = 48;

/// A stone that was scanned.
#[derive(Clone, Debug)]
pub struct Scanned {
    /// Its hull (m).
    pub hull: Polyhedron,
    /// What the scan holds, at unit density.
    pub holds: MassProperties,
}

/// The stone whose scan has these vertices (m) and faces, in any of the two ways round. Points up to `bearing` (m) above the lowest one bear.
///
/// # Errors
/// Why the mesh does not close, or has no hull that could bear.
pub fn scanned(
    block: &str,
    vertices: &[Vec3],
    faces: &[Vec<u32>],
    bearing: f64,
) -> Result<Scanned, Vec<Fault>> {
    let size = diagonal(vertices);
    let closed = close(block, vertices, faces, size, FLATNESS * size)?;
    let mesh = Polyhedron {
        vertices: closed.vertices,
        faces: closed.faces.into_iter().map(|face| face.corners).collect(),
    };
    let holds = mesh.mass_properties();
    // A mesh that is inside out encloses a negative volume, around the same centroid.
    let holds = if holds.volume < 0.0 { holds.times(-1.0) } else { holds };
    let (triangles, corners) = hull(&raised(vertices, bearing)).ok_or_else(|| no_hull(block, bearing))?;
    let hull = solid(block, &corners, &triangles, None)?.shape;
    if !bears(&hull) {
        return Err(no_hull(block, bearing));
    }
    Ok(Scanned { hull, holds })
}

fn no_hull(block: &str, bearing: f64) -> Vec<Fault> {
    let found = format!("what lies within {bearing} m of its lowest point spans no area to stand on");
    let fix = "allow more: --scan-bearing is how far above the lowest point a rough underside still bears";
    vec![Fault::of(block, found, "three points or more that are not in line", fix)]
}

/// The points that the hull is made of: those that bear at one height, and of all the farthest in every direction.
fn raised(vertices: &[Vec3], bearing: f64) -> Vec<Vec3> {
    let low = vertices.iter().map(|v| v.z).fold(f64::INFINITY, f64::min) + bearing;
    let all: Vec<Vec3> = vertices.iter().map(|v| Vec3::new(v.x, v.y, v.z.max(low))).collect();
    let bearing: Vec<Vec3> = all.iter().filter(|v| v.z == low).copied().collect();
    let around = (0..AROUND).map(|k| {
        let angle = std::f64::consts::TAU * k as f64 / AROUND as f64;
        (Vec3::new(cos(angle), sin(angle), 0.0), &bearing)
    });
    let farthest = |(direction, points): (Vec3, &Vec<Vec3>)| {
        points.iter().copied().max_by(|a, b| a.dot(&direction).total_cmp(&b.dot(&direction)))
    };
    let mut kept: Vec<Vec3> =
        directions().map(|way| (way, &all)).chain(around).filter_map(farthest).collect();
    kept.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    kept.dedup();
    kept
}

/// Directions on a spiral from pole to pole, each with as much of the sphere as the others (Fibonacci).
fn directions() -> impl Iterator<Item = Vec3> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..DIRECTIONS).map(move |k| {
        let z = 1.0 - (2 * k + 1) as f64 / DIRECTIONS as f64;
        let (across, angle) = ((1.0 - z * z).sqrt(), golden * k as f64);
        Vec3::new(across * cos(angle), across * sin(angle), z)
    })
}

/// Triangles and corners of the hull; `None` of points in a plane.
fn hull(points: &[Vec3]) -> Option<(Vec<Vec<u32>>, Vec<Vec3>)> {
    let points: Vec<Vector> = points.iter().map(|v| Vector::new(v.x, v.y, v.z)).collect();
    let (corners, triangles) = try_convex_hull(&points).ok()?;
    let corners = corners.iter().map(|v| Vec3::new(v.x, v.y, v.z)).collect();
    Some((triangles.iter().map(|triangle| triangle.to_vec()).collect(), corners))
}

/// Whether it has a face to stand on: one that looks straight down from its lowest corners.
fn bears(hull: &Polyhedron) -> bool {
    let low = hull.bounds().0.z;
    (0..hull.faces.len()).any(|face| hull.face_vertices(face).all(|v| v.z == low))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 0.4 x 0.3 x 0.6 m whose top is dented down to half its height in the middle, as triangles that look inwards.
    fn dented() -> (Vec<Vec3>, Vec<Vec<u32>>) {
        let cuboid = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(0.4, 0.3, 0.6));
        let mut vertices = cuboid.vertices.clone();
        vertices.push(Vec3::new(0.2, 0.15, 0.3));
        let top = [4, 5, 6, 7];
        let mut faces: Vec<Vec<u32>> = cuboid.faces.into_iter().filter(|face| face[..] != top).collect();
        faces.extend((0..4).map(|k| vec![top[k], top[(k + 1) % 4], 8]));
        (vertices, faces.into_iter().map(|face| face.into_iter().rev().collect()).collect())
    }

    #[test]
    fn a_dented_box_touches_as_its_hull_and_weighs_as_itself() {
        let (vertices, faces) = dented();
        let stone = scanned("block 0", &vertices, &faces, 1e-3).expect("a closed mesh");
        // The dent is a pyramid with a third of its base times its depth; its centroid is a quarter of its depth below the top.
        let (whole, dent) = (0.4 * 0.3 * 0.6, 0.4 * 0.3 * 0.3 / 3.0);
        assert!((stone.holds.volume - (whole - dent)).abs() < 1e-12, "{:?}", stone.holds);
        let height = (whole * 0.3 - dent * (0.6 - 0.3 / 4.0)) / (whole - dent);
        assert!((stone.holds.centroid - Vec3::new(0.2, 0.15, height)).norm() < 1e-12, "{:?}", stone.holds);
        assert!(stone.holds.inertia.trace() > 0.0);
        // The hull is the box without what lies below the plane that bears.
        assert!((stone.hull.volume() - 0.4 * 0.3 * 0.599).abs() < 1e-12, "{}", stone.hull.volume());
        assert_eq!(stone.hull.bounds().0.z, 1e-3);
    }

    #[test]
    fn an_open_mesh_and_a_point_to_stand_on_are_refused() {
        let (vertices, mut faces) = dented();
        faces.pop();
        assert!(scanned("block 0", &vertices, &faces, 1e-3).is_err());
        let spike = [(0.0, 0.0, 0.0), (0.1, 0.0, 0.1), (-0.1, 0.1, 0.1), (0.0, -0.1, 0.1)];
        let spike = spike.map(|(x, y, z)| Vec3::new(x, y, z));
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|face| face.to_vec());
        let faults = scanned("block 0", &spike, &faces, 1e-3).expect_err("it stands on a point");
        assert!(faults[0].found.contains("spans no area"), "{}", faults[0].found);
    }
}
