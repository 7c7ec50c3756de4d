//! The faces of a wall's blocks, as they were read.

use crate::math::{Mat3, Vec3};
use crate::model::{Support, Wall};
use crate::shape::Plane;

/// A face of a block.
#[derive(Clone, Debug)]
pub struct Face {
    /// The block.
    pub block: usize,
    /// Whether the block is fixed: its faces are where they are.
    pub is_fixed: bool,
    /// Its plane, looking out of the block.
    pub plane: Plane,
    /// Its corners (m), counter-clockwise seen from outside.
    pub corners: Vec<Vec3>,
    /// Its area (m^2).
    pub area: f64,
}

/// All faces, block by block in their order.
pub fn faces(wall: &Wall) -> Vec<Face> {
    let of_block = |(block, own): (usize, &crate::model::Block)| {
        let shape = &own.shape;
        let face = |number: usize| Face {
            block,
            is_fixed: own.support == Support::Fixed,
            plane: shape.face_plane(number),
            corners: shape.face_vertices(number).collect(),
            area: shape.face_area_vector(number).norm(),
        };
        (0..shape.faces.len()).map(face).collect::<Vec<_>>()
    };
    wall.blocks.iter().enumerate().flat_map(of_block).collect()
}

/// The plane nearest to some faces by least squares over their areas, looking as the largest does. `None` where they span none.
pub fn nearest_plane(faces: &[&Face]) -> Option<Plane> {
    let largest =
        faces.iter().fold(faces.first()?, |best, face| if face.area > best.area { face } else { best });
    let triangles = || {
        faces.iter().flat_map(|face| {
            let first = face.corners[0];
            face.corners[1..].windows(2).map(move |pair| [first, pair[0], pair[1]])
        })
    };
    let area = |[a, b, c]: &[Vec3; 3]| 0.5 * (b - a).cross(&(c - a)).norm();
    let total: f64 = triangles().map(|triangle| area(&triangle)).sum();
    let middle = triangles().map(|t| (t[0] + t[1] + t[2]) * (area(&t) / 3.0)).sum::<Vec3>() / total;
    // Integral of x x^T over a triangle about the middle of all.
    let spread = triangles().fold(Mat3::zeros(), |sum, triangle| {
        let [a, b, c] = triangle.map(|corner| corner - middle);
        let all = a + b + c;
        let squares = a * a.transpose() + b * b.transpose() + c * c.transpose() + all * all.transpose();
        sum + squares * (area(&triangle) / 12.0)
    });
    let eigen = spread.symmetric_eigen();
    let least = eigen.eigenvalues.imin();
    let normal: Vec3 = eigen.eigenvectors.column(least).into();
    let normal = if normal.dot(&largest.plane.normal) < 0.0 { -normal } else { normal };
    let plane = Plane::through(middle, normal);
    plane.offset.is_finite().then_some(plane)
}

/// The farthest (m) that a corner of the face lies from a plane.
pub fn farthest(face: &Face, plane: &Plane) -> f64 {
    face.corners.iter().map(|corner| plane.distance(corner).abs()).fold(0.0, f64::max)
}
