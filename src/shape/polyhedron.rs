//! Convex polyhedra: mass properties, cutting by a plane, and the validity that every block must have.

use std::collections::BTreeMap;

use crate::math::{Mat3, Vec3};
use crate::shape::Plane;

/// A convex polyhedron: vertices (m) and faces, each a list of vertex indices, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Polyhedron {
    /// Vertices (m).
    pub vertices: Vec<Vec3>,
    /// Faces as vertex indices, counter-clockwise seen from outside.
    pub faces: Vec<Vec<u32>>,
}

/// Mass properties at unit density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Volume (m^3).
    pub volume: f64,
    /// Centroid (m).
    pub centroid: Vec3,
    /// Inertia about the centroid in world axes, per unit density (m^5).
    pub inertia: Mat3,
}

impl MassProperties {
    /// The same at another density (kg/m^3): volume becomes mass, and inertia kg m^2.
    pub fn times(&self, density: f64) -> MassProperties {
        MassProperties {
            volume: self.volume * density,
            centroid: self.centroid,
            inertia: self.inertia * density,
        }
    }

    /// Those of the solid that a linear map about the origin, which turns nothing inside out, makes of it.
    pub fn mapped(&self, map: &Mat3) -> MassProperties {
        let scale = map.determinant();
        let second = Mat3::identity() * (0.5 * self.inertia.trace()) - self.inertia;
        let second = map * second * map.transpose() * scale;
        MassProperties {
            volume: self.volume * scale,
            centroid: map * self.centroid,
            inertia: Mat3::identity() * second.trace() - second,
        }
    }

    /// Those of several solids as one; where two of them share a place it counts twice. Undefined for none.
    pub fn together(parts: &[MassProperties]) -> MassProperties {
        let volume: f64 = parts.iter().map(|part| part.volume).sum();
        let centroid = parts.iter().map(|part| part.centroid * part.volume).sum::<Vec3>() / volume;
        let inertia = parts.iter().fold(Mat3::zeros(), |sum, part| {
            // Huygens and Steiner.
            let d = part.centroid - centroid;
            sum + part.inertia + (Mat3::identity() * d.norm_squared() - d * d.transpose()) * part.volume
        });
        MassProperties { volume, centroid, inertia }
    }
}

/// What makes a polyhedron unfit to be a block.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShapeFault {
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} is not finite")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
    },
    /// Fewer than four vertices or faces, or a face with fewer than three vertices.
    #[error("fewer than 4 vertices, 4 faces, or 3 vertices in a face")]
    TooFew,
    /// A face names a vertex that does not exist, or names one twice.
    #[error("face {face} names vertex {vertex}, which does not exist or occurs twice in it")]
    BadIndex {
        /// Index of the face.
        face: usize,
        /// The vertex index it names.
        vertex: u32,
    },
    /// An edge without exactly one neighbour running the other way: the surface is open or a face is turned over.
    #[error("the surface is open or a face is inside out at the edge {from}-{to}")]
    Open {
        /// First vertex of the edge.
        from: u32,
        /// Second vertex of the edge.
        to: u32,
    },
    /// The vertices of a face do not lie in one plane.
    #[error("face {face} is not plane: a vertex lies {distance:e} m off it")]
    NotPlane {
        /// Index of the face.
        face: usize,
        /// Largest distance of a vertex from the face's plane (m).
        distance: f64,
    },
    /// A vertex lies outside the plane of a face.
    #[error("not convex: vertex {vertex} lies {distance:e} m outside face {face}")]
    NotConvex {
        /// Index of the face.
        face: usize,
        /// Index of the vertex.
        vertex: usize,
        /// How far outside (m).
        distance: f64,
    },
    /// Zero or negative volume: all faces inside out.
    #[error("volume {volume:e} m^3 is not positive: degenerate, or all faces inside out")]
    NoVolume {
        /// The signed volume (m^3).
        volume: f64,
    },
}

impl Polyhedron {
    /// A box with axis-parallel edges between two opposite corners.
    pub fn cuboid(min: Vec3, max: Vec3) -> Self {
        Self::hexahedron([
            Vec3::new(min.x, min.y, min.z),
            Vec3::new(max.x, min.y, min.z),
            Vec3::new(max.x, max.y, min.z),
            Vec3::new(min.x, max.y, min.z),
            Vec3::new(min.x, min.y, max.z),
            Vec3::new(max.x, min.y, max.z),
            Vec3::new(max.x, max.y, max.z),
            Vec3::new(min.x, max.y, max.z),
        ])
    }

    /// A six-sided block from its corners: the lower four counter-clockwise seen from above, then the upper four
    /// above them in the same order.
    pub fn hexahedron(corners: [Vec3; 8]) -> Self {
        Polyhedron {
            vertices: corners.to_vec(),
            faces: vec![
                vec![3, 2, 1, 0],
                vec![4, 5, 6, 7],
                vec![0, 1, 5, 4],
                vec![1, 2, 6, 5],
                vec![2, 3, 7, 6],
                vec![3, 0, 4, 7],
            ],
        }
    }

    /// The positions of a face's vertices, counter-clockwise seen from outside.
    pub fn face_vertices(&self, face: usize) -> impl Iterator<Item = Vec3> + '_ {
        self.faces[face].iter().map(|&v| self.vertices[v as usize])
    }

    /// Area vector of a face (m^2): normal pointing out of the solid, length = area.
    pub fn face_area_vector(&self, face: usize) -> Vec3 {
        let f = &self.faces[face];
        let o = self.vertices[f[0] as usize];
        let mut sum = Vec3::zeros();
        for pair in f[1..].windows(2) {
            sum += (self.vertices[pair[0] as usize] - o).cross(&(self.vertices[pair[1] as usize] - o));
        }
        sum * 0.5
    }

    /// The outward plane of a face, through the mean of its vertices.
    pub fn face_plane(&self, face: usize) -> Plane {
        let mean = self.face_vertices(face).sum::<Vec3>() / self.faces[face].len() as f64;
        Plane::through(mean, self.face_area_vector(face))
    }

    /// Volume, centroid and inertia at unit density, by tetrahedra from the first vertex: exact for a polyhedron.
    pub fn mass_properties(&self) -> MassProperties {
        let o = self.vertices[0];
        let (mut volume, mut first, mut second) = (0.0, Vec3::zeros(), Mat3::zeros());
        for f in &self.faces {
            let a = self.vertices[f[0] as usize] - o;
            for pair in f[1..].windows(2) {
                let (b, c) = (self.vertices[pair[0] as usize] - o, self.vertices[pair[1] as usize] - o);
                let det = a.dot(&b.cross(&c));
                let sum = a + b + c;
                volume += det / 6.0;
                first += sum * (det / 24.0);
                // Integral of x x^T over a tetrahedron with one vertex at the origin.
                second += (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose())
                    * (det / 120.0);
            }
        }
        let c = if volume != 0.0 { first / volume } else { Vec3::zeros() };
        let about_centroid = second - c * c.transpose() * volume;
        MassProperties {
            volume,
            centroid: o + c,
            inertia: Mat3::identity() * about_centroid.trace() - about_centroid,
        }
    }

    /// Volume (m^3).
    pub fn volume(&self) -> f64 {
        self.mass_properties().volume
    }

    /// The lowest and highest corner of the axis-parallel bounding box.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let mut low = Vec3::repeat(f64::INFINITY);
        let mut high = Vec3::repeat(f64::NEG_INFINITY);
        for v in &self.vertices {
            low = low.inf(v);
            high = high.sup(v);
        }
        (low, high)
    }

    /// Extent along a unit direction (m): the distance between the two supporting planes normal to it.
    pub fn width(&self, direction: &Vec3) -> f64 {
        let mut low = f64::INFINITY;
        let mut high = f64::NEG_INFINITY;
        for v in &self.vertices {
            let d = direction.dot(v);
            low = low.min(d);
            high = high.max(d);
        }
        high - low
    }

    /// Smallest extent over the directions of the face normals (m), the size that decides whether a stone is a
    /// sliver; for prisms and boxes this is the exact minimum width.
    pub fn smallest_width(&self) -> f64 {
        (0..self.faces.len()).map(|f| self.width(&self.face_plane(f).normal)).fold(f64::INFINITY, f64::min)
    }

    /// Largest distance between two vertices (m).
    pub fn diameter(&self) -> f64 {
        let mut largest: f64 = 0.0;
        for (i, a) in self.vertices.iter().enumerate() {
            for b in &self.vertices[i + 1..] {
                largest = largest.max((a - b).norm_squared());
            }
        }
        largest.sqrt()
    }

    /// The same solid moved by `shift`.
    pub fn translated(&self, shift: &Vec3) -> Self {
        Polyhedron { vertices: self.vertices.iter().map(|v| v + shift).collect(), faces: self.faces.clone() }
    }

    /// The same solid after x -> rotation x + shift.
    pub fn moved(&self, rotation: &Mat3, shift: &Vec3) -> Self {
        Polyhedron {
            vertices: self.vertices.iter().map(|v| rotation * v + shift).collect(),
            faces: self.faces.clone(),
        }
    }

    /// Cuts by a plane: the part below (against the normal) and the part above, each `None` when empty.
    ///
    /// Vertices within `tolerance` (m) of the plane count as lying on it, so that no part is a film thinner than
    /// that. New vertices lie on the plane, and both parts use the same ones: neighbours fit without a gap.
    pub fn cut(&self, plane: &Plane, tolerance: f64) -> (Option<Polyhedron>, Option<Polyhedron>) {
        let side: Vec<i8> = self
            .vertices
            .iter()
            .map(|v| {
                let d = plane.distance(v);
                if d > tolerance {
                    1
                } else if d < -tolerance {
                    -1
                } else {
                    0
                }
            })
            .collect();
        if !side.contains(&1) {
            return (Some(self.clone()), None);
        }
        if !side.contains(&-1) {
            return (None, Some(self.clone()));
        }
        let mut vertices = self.vertices.clone();
        let mut on_edge: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut crossing = |a: u32, b: u32, vertices: &mut Vec<Vec3>| {
            // One direction for both faces that share the edge: the same bits for both.
            let key = (a.min(b), a.max(b));
            *on_edge.entry(key).or_insert_with(|| {
                let (p, q) = (vertices[key.0 as usize], vertices[key.1 as usize]);
                let (dp, dq) = (plane.distance(&p), plane.distance(&q));
                vertices.push(p + (q - p) * (dp / (dp - dq)));
                vertices.len() as u32 - 1
            })
        };
        let sign = |v: u32| side.get(v as usize).copied().unwrap_or(0);
        let (mut below, mut above) = (Vec::new(), Vec::new());
        for face in &self.faces {
            let (mut low, mut high) = (Vec::new(), Vec::new());
            for (i, &a) in face.iter().enumerate() {
                let b = face[(i + 1) % face.len()];
                if sign(a) <= 0 {
                    low.push(a);
                }
                if sign(a) >= 0 {
                    high.push(a);
                }
                if sign(a) * sign(b) < 0 {
                    let x = crossing(a, b, &mut vertices);
                    low.push(x);
                    high.push(x);
                }
            }
            // A face that only touches the plane is no face of that part.
            if low.iter().any(|&v| sign(v) < 0) {
                below.push(low);
            }
            if high.iter().any(|&v| sign(v) > 0) {
                above.push(high);
            }
        }
        (close(&vertices, below), close(&vertices, above))
    }

    /// Checks that the solid is closed, plane-faced, convex and of positive volume, to within `tolerance` (m).
    ///
    /// # Errors
    /// The first [`ShapeFault`] found.
    pub fn validate(&self, tolerance: f64) -> Result<(), ShapeFault> {
        if let Some(vertex) = self.vertices.iter().position(|v| !v.iter().all(|c| c.is_finite())) {
            return Err(ShapeFault::NotFinite { vertex });
        }
        if self.vertices.len() < 4 || self.faces.len() < 4 || self.faces.iter().any(|f| f.len() < 3) {
            return Err(ShapeFault::TooFew);
        }
        let mut edges: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        for (face, f) in self.faces.iter().enumerate() {
            for (i, &vertex) in f.iter().enumerate() {
                if vertex as usize >= self.vertices.len() || f[..i].contains(&vertex) {
                    return Err(ShapeFault::BadIndex { face, vertex });
                }
                *edges.entry((vertex, f[(i + 1) % f.len()])).or_insert(0) += 1;
            }
        }
        for (&(from, to), &count) in &edges {
            if count != 1 || !edges.contains_key(&(to, from)) {
                return Err(ShapeFault::Open { from, to });
            }
        }
        let volume = self.volume();
        if volume <= 0.0 || !volume.is_finite() {
            return Err(ShapeFault::NoVolume { volume });
        }
        for face in 0..self.faces.len() {
            let plane = self.face_plane(face);
            let off = self.face_vertices(face).map(|v| plane.distance(&v).abs()).fold(0.0, f64::max);
            // A face without area has no plane: its normal is NaN, and so is every distance from it.
            if !plane.offset.is_finite() {
                return Err(ShapeFault::NotPlane { face, distance: f64::NAN });
            }
            if off > tolerance {
                return Err(ShapeFault::NotPlane { face, distance: off });
            }
            for (vertex, v) in self.vertices.iter().enumerate() {
                let distance = plane.distance(v);
                if distance > tolerance {
                    return Err(ShapeFault::NotConvex { face, vertex, distance });
                }
            }
        }
        Ok(())
    }
}

/// How far (m) the farthest of some corners is from the nearest of others, whichever way (Hausdorff's distance).
pub fn corners_apart(one: &[Vec3], other: &[Vec3]) -> f64 {
    let farthest = |of: &[Vec3], from: &[Vec3]| {
        let nearest = |p: &Vec3| from.iter().map(|q| (p - q).norm()).fold(f64::INFINITY, f64::min);
        of.iter().map(nearest).fold(0.0, f64::max)
    };
    farthest(one, other).max(farthest(other, one))
}

/// Builds a closed solid from faces of a cut solid: adds the cap, and keeps only the vertices in use.
fn close(vertices: &[Vec3], mut faces: Vec<Vec<u32>>) -> Option<Polyhedron> {
    // An edge used in one direction only borders the cap; the cap runs it the other way.
    let mut open: BTreeMap<u32, u32> = BTreeMap::new();
    let mut directed: std::collections::BTreeSet<(u32, u32)> = std::collections::BTreeSet::new();
    for f in &faces {
        for (i, &a) in f.iter().enumerate() {
            directed.insert((a, f[(i + 1) % f.len()]));
        }
    }
    for &(a, b) in &directed {
        if !directed.contains(&(b, a)) {
            open.insert(b, a);
        }
    }
    if let Some((&start, _)) = open.iter().next() {
        let mut cap = vec![start];
        let mut at = open[&start];
        while at != start && cap.len() <= open.len() {
            cap.push(at);
            at = *open.get(&at)?;
        }
        if cap.len() < 3 {
            return None;
        }
        faces.push(cap);
    }
    let mut renumbered: BTreeMap<u32, u32> = BTreeMap::new();
    let mut kept = Vec::new();
    for f in &mut faces {
        for v in f.iter_mut() {
            *v = *renumbered.entry(*v).or_insert_with(|| {
                kept.push(vertices[*v as usize]);
                kept.len() as u32 - 1
            });
        }
    }
    (faces.len() >= 4).then_some(Polyhedron { vertices: kept, faces })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_box_has_the_mass_properties_of_a_box() {
        let solid = Polyhedron::cuboid(Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.4, 2.2, 3.1));
        let m = solid.mass_properties();
        assert_relative_eq!(m.volume, 0.4 * 0.2 * 0.1, max_relative = 1e-13);
        assert_relative_eq!(m.centroid, Vec3::new(1.2, 2.1, 3.05), max_relative = 1e-13);
        assert_relative_eq!(
            m.inertia[(0, 0)],
            m.volume * (0.2f64 * 0.2 + 0.1 * 0.1) / 12.0,
            max_relative = 1e-10
        );
        assert!(m.inertia[(0, 1)].abs() < 1e-15);
        solid.validate(1e-12).unwrap();
    }

    #[test]
    fn the_parts_of_a_cut_are_valid_and_fill_the_whole() {
        let solid = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(0.4, 0.3, 0.2));
        for (i, normal) in
            [Vec3::z(), Vec3::new(0.3, -0.2, 1.0), Vec3::new(1.0, 1.0, 1.0), Vec3::new(-1.0, 0.5, 0.1)]
                .iter()
                .enumerate()
        {
            let plane = Plane::through(Vec3::new(0.2, 0.15, 0.1), *normal);
            let (below, above) = solid.cut(&plane, 1e-9);
            let (below, above) = (below.unwrap(), above.unwrap());
            below.validate(1e-9).unwrap_or_else(|e| panic!("cut {i}: {e}"));
            above.validate(1e-9).unwrap_or_else(|e| panic!("cut {i}: {e}"));
            assert_relative_eq!(below.volume() + above.volume(), solid.volume(), max_relative = 1e-12);
        }
    }

    #[test]
    fn a_cut_through_corners_and_along_a_diagonal_stays_valid() {
        let solid = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(1.0, 1.0, 1.0));
        let (below, above) = solid.cut(&Plane::through(Vec3::zeros(), Vec3::new(1.0, -1.0, 0.0)), 1e-9);
        for part in [below.unwrap(), above.unwrap()] {
            part.validate(1e-12).unwrap();
            assert_relative_eq!(part.volume(), 0.5, max_relative = 1e-12);
            assert_eq!(part.faces.len(), 5);
        }
        let (below, above) = solid.cut(&Plane::through(Vec3::zeros(), Vec3::z()), 1e-9);
        assert!(below.is_none() && above.is_some(), "a plane along a face cuts nothing off");
    }

    #[test]
    fn faults_are_named() {
        let good = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(1.0, 1.0, 1.0));
        let mut open = good.clone();
        open.faces.pop();
        assert!(matches!(open.validate(1e-9), Err(ShapeFault::Open { .. })));
        let mut turned = good.clone();
        turned.faces.iter_mut().for_each(|f| f.reverse());
        assert!(matches!(turned.validate(1e-9), Err(ShapeFault::NoVolume { .. })));
        let mut dented = good.clone();
        dented.vertices[6] = Vec3::new(0.4, 0.4, 0.4);
        assert!(dented.validate(1e-9).is_err());
        let mut holed = good;
        holed.vertices[2].x = f64::NAN;
        assert_eq!(holed.validate(1e-9), Err(ShapeFault::NotFinite { vertex: 2 }));
        // A face folded flat onto an edge closes the surface, but encloses nothing.
        let mut flat = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(1.0, 1.0, 1.0));
        flat.vertices.push(Vec3::new(0.5, 0.0, 0.0));
        let edge = flat.faces[2].iter().position(|v| *v == 1).unwrap();
        flat.faces[2].insert(edge, 8);
        flat.faces.push(vec![8, 0, 1]);
        assert!(matches!(flat.validate(1e-9), Err(ShapeFault::NotPlane { face: 6, .. })));
    }
}
