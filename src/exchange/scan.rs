//! A stone from its scan: the convex hull by which it touches others, with what the scan itself holds.
//!
//! A scan is a closed mesh of thousands of triangles and of any shape. Solvers need a convex solid with few corners. The hull has more volume
//! than the stone where that is hollow, so volume, centroid and inertia stay those of the scan ([`crate::model::Block::scan`]). A rough
//! underside would stand on three points: what lies within the bearing depth of the lowest point bears, as one plane face.

use std::collections::{BTreeMap, BTreeSet};

use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

use crate::exchange::closing::{close, edges};
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
    let hull = hull(&raised(vertices, bearing)).filter(|hull| hull.validate(FLATNESS * size).is_ok());
    Ok(Scanned { hull: hull.ok_or_else(|| no_hull(block, bearing))?, holds })
}

/// A stone of any shape as its hull.
#[derive(Clone, Debug)]
pub struct Hulled {
    /// The hull (m).
    pub hull: Polyhedron,
    /// What the mesh holds, at unit density; `None` where it does not close.
    pub holds: Option<MassProperties>,
}

impl Hulled {
    /// What became of the stone.
    pub fn told(&self) -> String {
        match &self.holds {
            Some(holds) => format!(
                "touches as its convex hull, which has {:.1} % more volume, and weighs as its mesh",
                100.0 * (self.hull.volume() / holds.volume - 1.0)
            ),
            None => "its surface does not close: touches and weighs as its convex hull".to_owned(),
        }
    }
}

/// The hull of a mesh with these vertices (m) and faces, or of a cloud of points, which has none; faces that lie within `flatness` (m) of one
/// plane are one.
///
/// # Errors
/// Points that lie in a plane.
pub fn hulled(
    block: &str,
    vertices: &[Vec3],
    faces: &[Vec<u32>],
    flatness: Option<f64>,
) -> Result<Hulled, Vec<Fault>> {
    let size = diagonal(vertices);
    let closed = close(block, vertices, faces, size, FLATNESS * size).ok();
    let holds = closed.map(|closed| {
        let faces = closed.faces.into_iter().map(|face| face.corners).collect();
        Polyhedron { vertices: closed.vertices, faces }.mass_properties()
    });
    let holds = holds.map(|own| if own.volume < 0.0 { own.times(-1.0) } else { own });
    let whole = triangulated(vertices);
    let merged = |(vertices, triangles): &(Vec<Vec3>, Vec<Vec<u32>>)| {
        solid(block, vertices, triangles, flatness).ok().map(|solid| solid.shape)
    };
    // A hull with more corners than a block may have reaches as far as the stone in many directions.
    let hull = whole.as_ref().and_then(merged).or_else(|| {
        let fewer = triangulated(&farthest(vertices, std::iter::empty()))?;
        let plain = || {
            let (vertices, faces) = fewer.clone();
            Some(Polyhedron { vertices, faces }).filter(|hull| hull.validate(FLATNESS * size).is_ok())
        };
        merged(&fewer).or_else(plain)
    });
    let refused = || {
        let fix = "look at the file: a stone has a volume";
        vec![Fault::of(
            block,
            "its points have no convex hull: they lie in a plane or on a line",
            "a body",
            fix,
        )]
    };
    Ok(Hulled { hull: hull.ok_or_else(refused)?, holds })
}

/// The hull of a scan as a file has it: no faces are put together, see [`hull`].
///
/// # Errors
/// Why it is no convex solid.
pub fn stated(block: &str, vertices: &[Vec3], faces: &[Vec<u32>]) -> Result<Polyhedron, Vec<Fault>> {
    let hull = Polyhedron { vertices: vertices.to_vec(), faces: faces.to_vec() };
    match hull.validate(FLATNESS * diagonal(vertices)) {
        Ok(()) => Ok(hull),
        Err(fault) => {
            let fix =
                "write the hull as pirca does, or leave out \"scan\" where the faces are those of the stone";
            let allowed = "a convex solid with plane faces, each corner once: the hull of the scan";
            Err(vec![Fault::of(block, format!("with \"scan\" {fault}"), allowed, fix)])
        }
    }
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
        (Vec3::new(cos(angle), sin(angle), 0.0), &bearing[..])
    });
    farthest(&all, around)
}

/// Of points the farthest in every direction, and of others those along directions of their own.
fn farthest<'p>(all: &'p [Vec3], others: impl Iterator<Item = (Vec3, &'p [Vec3])>) -> Vec<Vec3> {
    let last = |(direction, points): (Vec3, &[Vec3])| {
        points.iter().copied().max_by(|a, b| a.dot(&direction).total_cmp(&b.dot(&direction)))
    };
    let mut kept: Vec<Vec3> = directions().map(|way| (way, all)).chain(others).filter_map(last).collect();
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

/// The hull: triangles, and one face of all that lie lowest. `None` where none does, or where the points lie in a plane. Faces that are
/// nearly in a plane stay apart: put together with what bears, they would tilt it.
fn hull(points: &[Vec3]) -> Option<Polyhedron> {
    let (vertices, triangles) = triangulated(points)?;
    let low = vertices.iter().map(|v| v.z).fold(f64::INFINITY, f64::min);
    let is_low = |triangle: &Vec<u32>| triangle.iter().all(|&v| vertices[v as usize].z == low);
    let (foot, others): (Vec<Vec<u32>>, Vec<Vec<u32>>) = triangles.into_iter().partition(is_low);
    let faces = std::iter::once(around(&foot)?).chain(others).collect();
    Some(Polyhedron { vertices, faces })
}

/// The corners of the hull of points, and its triangles; `None` of points in a plane.
fn triangulated(points: &[Vec3]) -> Option<(Vec<Vec3>, Vec<Vec<u32>>)> {
    let points: Vec<Vector> = points.iter().map(|v| Vector::new(v.x, v.y, v.z)).collect();
    let (corners, triangles) = try_convex_hull(&points).ok()?;
    let vertices = corners.iter().map(|v| Vec3::new(v.x, v.y, v.z)).collect();
    Some((vertices, triangles.iter().map(|triangle| triangle.to_vec()).collect()))
}

/// The corners around triangles of a plane, in their way round; `None` of no triangle, or where they do not hang together.
fn around(triangles: &[Vec<u32>]) -> Option<Vec<u32>> {
    let edges: BTreeSet<(u32, u32)> = triangles.iter().flat_map(|t| edges(t).collect::<Vec<_>>()).collect();
    let next: BTreeMap<u32, u32> =
        edges.iter().filter(|(a, b)| !edges.contains(&(*b, *a))).copied().collect();
    let (first, _) = next.first_key_value()?;
    let mut corners = vec![*first];
    while let Some(corner) = next.get(corners.last()?).filter(|corner| *corner != first) {
        if corners.len() == next.len() {
            return None;
        }
        corners.push(*corner);
    }
    (corners.len() == next.len()).then_some(corners)
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
    fn a_rough_underside_bears_on_what_lies_within_the_depth() {
        // A pebble: a ball of 0.2 m whose radius goes up and down by 5 %, with many corners near each other at the poles.
        let (rings, around) = (40, 80);
        let point = |i: usize, j: usize| {
            let (up, way) = (
                std::f64::consts::PI * i as f64 / rings as f64,
                std::f64::consts::TAU * j as f64 / around as f64,
            );
            let radius = 0.2 * (1.0 + 0.05 * sin(3.0 * way) * sin(5.0 * up));
            Vec3::new(sin(up) * cos(way), sin(up) * sin(way), cos(up)) * radius
        };
        let mut vertices = vec![point(0, 0)];
        vertices.extend((1..rings).flat_map(|i| (0..around).map(move |j| point(i, j))));
        vertices.push(point(rings, 0));
        let (at, last) =
            (|i: usize, j: usize| (1 + (i - 1) * around + j % around) as u32, vertices.len() as u32 - 1);
        let mut faces: Vec<Vec<u32>> = Vec::new();
        for j in 0..around {
            faces.push(vec![0, at(1, j), at(1, j + 1)]);
            faces.push(vec![last, at(rings - 1, j + 1), at(rings - 1, j)]);
            faces
                .extend((1..rings - 1).map(|i| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
        }
        let mut before = 0.0;
        for bearing in [1e-3, 2e-3, 5e-3, 1e-2, 2e-2] {
            let stone = scanned("block 0", &vertices, &faces, bearing).expect("it stands");
            let low = stone.hull.bounds().0.z;
            let bears = |face: &usize| stone.hull.face_vertices(*face).all(|v| v.z < low + 1e-9);
            let foot = (0..stone.hull.faces.len()).find(bears).expect("a foot");
            let area = stone.hull.face_area_vector(foot).norm();
            assert!(area > before, "{bearing}: {area}");
            before = area;
        }
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
