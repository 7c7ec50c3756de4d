//! The motions of the plate: numbers of the unknown velocities, rates of strain at every section, and the power of the loads.

use super::mesh::{Across, Mesh, Triangle};
use super::wall::{Edge, Plate};

/// A velocity's number, and what a unit of it gives.
pub(super) type Term<T> = (usize, T);

/// A place where stress and rate of strain meet: an end of an edge, or a whole triangle.
pub(super) struct Place {
    /// Position (x, z); the middle of a triangle.
    pub at: [f64; 2],
    /// Unit normal (x, z) of the edge; `None` in a triangle.
    pub normal: Option<[f64; 2]>,
    /// What the power per length or per area is multiplied by: half of the edge (m), or the triangle (m^2).
    pub size: f64,
    /// Rate of strain (E11, E22, 2 E12, chi11, chi22, 2 chi12) from the velocities.
    pub rate: Vec<Term<[f64; 6]>>,
}

/// Numbers of the unknown velocities: deflections of the nodes that nothing holds, then velocities in the plane by triangle.
pub(super) struct Motions {
    deflections: Vec<Option<usize>>,
    first_in_plane: usize,
    pub count: usize,
}

impl Motions {
    pub fn new(plate: &Plate, mesh: &Mesh) -> Self {
        let mut held = vec![false; mesh.nodes.len()];
        for (e, edge) in mesh.edges.iter().enumerate() {
            if let Across::Side(side) = edge.across
                && plate.edges.at(side) != Edge::Free
            {
                [edge.ends[0], edge.ends[1], mesh.middle(e)].into_iter().for_each(|node| held[node] = true);
            }
        }
        let mut first_in_plane = 0;
        let number = |held: bool| {
            (!held).then(|| {
                first_in_plane += 1;
                first_in_plane - 1
            })
        };
        let deflections = held.into_iter().map(number).collect();
        Self { deflections, first_in_plane, count: first_in_plane + 6 * mesh.triangles.len() }
    }

    /// The deflection of a node, along +y; `None` where it is held.
    pub fn deflection(&self, node: usize) -> Option<usize> {
        self.deflections[node]
    }

    /// The velocity along x (axis 0) or z (axis 1) of a triangle at one of its corners.
    pub fn in_plane(&self, triangle: usize, corner: usize, axis: usize) -> usize {
        self.first_in_plane + 6 * triangle + 2 * corner + axis
    }

    /// The terms of a triangle's free nodes: its corners, then the middles of its edges.
    fn of_nodes<T: Copy>(&self, triangle: &Triangle, values: &[T; 6]) -> Vec<Term<T>> {
        let nodes = triangle.corners.iter().chain(&triangle.middles);
        nodes.zip(values).filter_map(|(&node, &value)| Some((self.deflection(node)?, value))).collect()
    }

    /// The deflection at a point of the plate.
    pub fn deflection_at(&self, mesh: &Mesh, at: [f64; 2]) -> Vec<Term<f64>> {
        let (triangle, l) = mesh.locate(at);
        let corner = |i: usize| l[i] * (2.0 * l[i] - 1.0);
        let middle = |i: usize| 4.0 * l[i] * l[(i + 1) % 3];
        let shapes = [corner(0), corner(1), corner(2), middle(0), middle(1), middle(2)];
        self.of_nodes(&mesh.triangles[triangle], &shapes)
    }

    /// All places where the plate can yield.
    pub fn places(&self, plate: &Plate, mesh: &Mesh) -> Vec<Place> {
        let inside = (0..mesh.triangles.len()).map(|t| self.inside(mesh, t));
        let crossing = |&e: &usize| match mesh.edges[e].across {
            Across::Triangle(_) => true,
            Across::Side(side) => matches!(plate.edges.at(side), Edge::Held | Edge::Guided),
        };
        let edges = (0..mesh.edges.len()).filter(crossing);
        let place = |e: usize| [0, 1].map(|end| self.edge_end(mesh, e, end, self.is_led(plate, mesh, e)));
        inside.chain(edges.flat_map(place)).collect()
    }

    /// A triangle: its strain and its curvature are the same all over it.
    fn inside(&self, mesh: &Mesh, t: usize) -> Place {
        let triangle = &mesh.triangles[t];
        let slopes = &triangle.slopes;
        let mut rate: Vec<Term<[f64; 6]>> = Vec::with_capacity(12);
        for (corner, &[x, z]) in slopes.iter().enumerate() {
            rate.push((self.in_plane(t, corner, 0), [x, 0.0, z, 0.0, 0.0, 0.0]));
            rate.push((self.in_plane(t, corner, 1), [0.0, z, x, 0.0, 0.0, 0.0]));
        }
        let product = |i: usize, k: usize| {
            let ([a, b], [c, d]) = (slopes[i], slopes[k]);
            [0.0, 0.0, 0.0, 4.0 * a * c, 4.0 * b * d, 4.0 * (a * d + b * c)]
        };
        let middle = |i: usize| product(i, (i + 1) % 3).map(|v| 2.0 * v);
        let curvatures = [product(0, 0), product(1, 1), product(2, 2), middle(0), middle(1), middle(2)];
        // The mixed one is doubled in `product` already, as a pair of equal factors has it twice.
        rate.extend(self.of_nodes(triangle, &curvatures));
        let sum = |axis: usize| triangle.corners.iter().map(|&n| mesh.nodes[n][axis]).sum::<f64>();
        Place { at: [sum(0) / 3.0, sum(1) / 3.0], normal: None, size: triangle.area, rate }
    }

    /// Whether what is beyond an edge of the plate goes along with it in its plane, and only keeps it from turning.
    fn is_led(&self, plate: &Plate, mesh: &Mesh, e: usize) -> bool {
        matches!(mesh.edges[e].across, Across::Side(side) if plate.edges.at(side) == Edge::Guided)
    }

    /// An end of an edge: the jump of velocity across it, and that of the slope along its normal, both linear along the edge. What
    /// is beyond an edge of the plate is at rest, or goes along in its plane where the edge is `led`.
    fn edge_end(&self, mesh: &Mesh, e: usize, end: usize, led: bool) -> Place {
        let edge = &mesh.edges[e];
        let (node, [n1, n2]) = (edge.ends[end], edge.normal);
        let mut rate = Vec::new();
        let sides = [(Some(edge.triangle), -1.0), (edge.across.triangle(), 1.0)];
        for (t, sign) in sides.into_iter().filter_map(|(t, sign)| Some((t?, sign))) {
            let triangle = &mesh.triangles[t];
            let corner =
                usize::from(triangle.corners[1] == node) + 2 * usize::from(triangle.corners[2] == node);
            if !led {
                rate.push((self.in_plane(t, corner, 0), [n1, 0.0, n2, 0.0, 0.0, 0.0].map(|v| sign * v)));
                rate.push((self.in_plane(t, corner, 1), [0.0, n2, n1, 0.0, 0.0, 0.0].map(|v| sign * v)));
            }
            let fold = [0.0, 0.0, 0.0, n1 * n1, n2 * n2, 2.0 * n1 * n2];
            let slopes = normal_slopes(triangle, corner, edge.normal);
            rate.extend(self.of_nodes(triangle, &slopes.map(|slope| fold.map(|v| sign * slope * v))));
        }
        Place { at: mesh.nodes[node], normal: Some(edge.normal), size: edge.length / 2.0, rate: merged(rate) }
    }

    /// Power on every velocity of a load per area: its mean along x, y and z, and that at the bottom over that at the top.
    pub fn power(&self, mesh: &Mesh, mean: [f64; 3], base_over_top: f64) -> Vec<f64> {
        let mut power = vec![0.0; self.count];
        let top = 2.0 / (base_over_top + 1.0);
        let share =
            |node: usize| top * (base_over_top + (1.0 - base_over_top) * mesh.nodes[node][1] / mesh.height());
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            let q = triangle.corners.map(share);
            let sum = q[0] + q[1] + q[2];
            for corner in 0..3 {
                // The integral of l_i q, with barycentric coordinates l.
                let of = triangle.area / 12.0 * (sum + q[corner]);
                power[self.in_plane(t, corner, 0)] += mean[0] * of;
                power[self.in_plane(t, corner, 1)] += mean[2] * of;
            }
            // Those of the quadratic shapes l_i (2 l_i - 1) and 4 l_i l_k with q.
            let at_corner = |i: usize| triangle.area / 60.0 * (3.0 * q[i] - sum);
            let between = |i: usize| triangle.area / 15.0 * (2.0 * sum - q[(i + 2) % 3]);
            let shapes = [at_corner(0), at_corner(1), at_corner(2), between(0), between(1), between(2)];
            for (velocity, of) in self.of_nodes(triangle, &shapes) {
                power[velocity] += mean[1] * of;
            }
        }
        power
    }
}

impl Across {
    fn triangle(self) -> Option<usize> {
        match self {
            Self::Triangle(t) => Some(t),
            Self::Side(_) => None,
        }
    }
}

/// Slopes of the deflection along a direction, at a corner of a triangle, by node.
fn normal_slopes(triangle: &Triangle, corner: usize, normal: [f64; 2]) -> [f64; 6] {
    let slope = triangle.slopes.map(|[x, z]| x * normal[0] + z * normal[1]);
    let is = |i: usize| f64::from(u8::from(i == corner));
    let of_corner = |i: usize| (4.0 * is(i) - 1.0) * slope[i];
    let of_middle = |i: usize| {
        let next = (i + 1) % 3;
        4.0 * (is(i) * slope[next] + is(next) * slope[i])
    };
    [of_corner(0), of_corner(1), of_corner(2), of_middle(0), of_middle(1), of_middle(2)]
}

/// Terms with one entry for every velocity.
fn merged(mut terms: Vec<Term<[f64; 6]>>) -> Vec<Term<[f64; 6]>> {
    terms.sort_by_key(|term| term.0);
    let mut merged: Vec<Term<[f64; 6]>> = Vec::with_capacity(terms.len());
    for (velocity, rate) in terms {
        match merged.last_mut() {
            Some(last) if last.0 == velocity => last.1.iter_mut().zip(rate).for_each(|(a, b)| *a += b),
            _ => merged.push((velocity, rate)),
        }
    }
    merged
}
