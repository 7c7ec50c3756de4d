//! Triangles of a rectangle: every cell is cut by both of its diagonals, so that a mesh with twice as many cells each way has all
//! lines of the coarser one, and its mechanisms too.

use std::collections::BTreeMap;

/// A side of the rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Bottom,
    Left,
    Right,
    Top,
}

/// What lies across an edge from its own triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Across {
    Triangle(usize),
    Side(Side),
}

/// An edge of the mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// Nodes at its ends; its own triangle is on the left of the way from the first to the second.
    pub ends: [usize; 2],
    pub triangle: usize,
    pub across: Across,
    pub length: f64,
    /// Unit normal (x, z), out of its own triangle.
    pub normal: [f64; 2],
}

/// A triangle of the mesh; turns counter-clockwise where x is to the right and z up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Nodes at the corners.
    pub corners: [usize; 3],
    /// Nodes in the middle of the edges: from corner 0 to 1, 1 to 2, 2 to 0.
    pub middles: [usize; 3],
    pub area: f64,
    /// Gradients (x, z) in 1/m of the barycentric coordinates of the corners.
    pub slopes: [[f64; 2]; 3],
}

/// The mesh of a rectangle 0..length along x and 0..height along z.
pub(super) struct Mesh {
    /// Positions (x, z): corners of cells row by row from the bottom, centres of cells, middles of edges.
    pub nodes: Vec<[f64; 2]>,
    /// Four to a cell: bottom, right, top, left.
    pub triangles: Vec<Triangle>,
    pub edges: Vec<Edge>,
    size: [f64; 2],
    cells: [usize; 2],
}

impl Mesh {
    /// The mesh with `cells` cells along x and along z.
    pub fn new(size: [f64; 2], cells: [usize; 2]) -> Self {
        let [across, up] = cells;
        // The last line is put at the size itself, free of rounding.
        let line = |k: usize, axis: usize, half: f64| {
            if k == cells[axis] { size[axis] } else { size[axis] * (k as f64 + half) / cells[axis] as f64 }
        };
        let corner = |i: usize, k: usize| k * (across + 1) + i;
        let mut nodes: Vec<[f64; 2]> =
            (0..=up).flat_map(|k| (0..=across).map(move |i| [line(i, 0, 0.0), line(k, 1, 0.0)])).collect();
        let centres = nodes.len();
        nodes.extend((0..up).flat_map(|k| (0..across).map(move |i| [line(i, 0, 0.5), line(k, 1, 0.5)])));
        let mut corners = Vec::with_capacity(4 * across * up);
        for k in 0..up {
            for i in 0..across {
                let around = [corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1)];
                let centre = centres + k * across + i;
                corners.extend((0..4).map(|s| [around[s], around[(s + 1) % 4], centre]));
            }
        }
        let (edges, middles) = edges(&nodes, &corners);
        let first = nodes.len();
        nodes.extend(edges.iter().map(|e| middle(nodes[e.ends[0]], nodes[e.ends[1]])).collect::<Vec<_>>());
        let triangles = corners
            .iter()
            .zip(middles)
            .map(|(&corners, middles)| triangle(&nodes, corners, middles.map(|edge| first + edge)))
            .collect();
        Self { nodes, triangles, edges, size, cells }
    }

    /// Height of the rectangle (m).
    pub fn height(&self) -> f64 {
        self.size[1]
    }

    /// The node in the middle of an edge.
    pub fn middle(&self, edge: usize) -> usize {
        self.nodes.len() - self.edges.len() + edge
    }

    /// The triangle that a point (x, z) of the rectangle is in, and its barycentric coordinates there.
    pub fn locate(&self, at: [f64; 2]) -> (usize, [f64; 3]) {
        let cell = |axis: usize| {
            let place = at[axis] / self.size[axis] * self.cells[axis] as f64;
            (place as usize).min(self.cells[axis] - 1)
        };
        let first = 4 * (cell(1) * self.cells[0] + cell(0));
        let depth = |t: usize| self.barycentric(t, at).into_iter().fold(f64::INFINITY, f64::min);
        // On a line between triangles either will do: the deflection is continuous.
        let deepest = (first..first + 4).fold(first, |best, t| if depth(t) > depth(best) { t } else { best });
        (deepest, self.barycentric(deepest, at))
    }

    fn barycentric(&self, triangle: usize, at: [f64; 2]) -> [f64; 3] {
        let Triangle { corners, slopes, .. } = &self.triangles[triangle];
        let from = self.nodes[corners[0]];
        let [_, second, third] = slopes.map(|s| s[0] * (at[0] - from[0]) + s[1] * (at[1] - from[1]));
        [1.0 - second - third, second, third]
    }
}

/// The edges of triangles, and the three edges of every triangle.
fn edges(nodes: &[[f64; 2]], triangles: &[[usize; 3]]) -> (Vec<Edge>, Vec<[usize; 3]>) {
    let mut known: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let mut edges: Vec<Edge> = Vec::new();
    let mut of_triangles = Vec::with_capacity(triangles.len());
    for (t, corners) in triangles.iter().enumerate() {
        of_triangles.push([0, 1, 2].map(|s| {
            let ends = [corners[s], corners[(s + 1) % 3]];
            let key = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            let edge = *known.entry(key).or_insert(edges.len());
            if edge == edges.len() {
                edges.push(new_edge(nodes, ends, t));
            } else {
                edges[edge].across = Across::Triangle(t);
            }
            edge
        }));
    }
    (edges, of_triangles)
}

/// An edge that so far has one triangle, and so is taken for one of the rectangle's.
fn new_edge(nodes: &[[f64; 2]], ends: [usize; 2], triangle: usize) -> Edge {
    let [a, b] = ends.map(|e| nodes[e]);
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
    let normal = [along[1] / length, -along[0] / length];
    let side = match (normal[0].abs() > normal[1].abs(), normal[0] + normal[1] > 0.0) {
        (true, true) => Side::Right,
        (true, false) => Side::Left,
        (false, true) => Side::Top,
        (false, false) => Side::Bottom,
    };
    Edge { ends, triangle, across: Across::Side(side), length, normal }
}

fn triangle(nodes: &[[f64; 2]], corners: [usize; 3], middles: [usize; 3]) -> Triangle {
    let [a, b, c] = corners.map(|n| nodes[n]);
    let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    let slope = |from: [f64; 2], to: [f64; 2]| [(from[1] - to[1]) / twice, (to[0] - from[0]) / twice];
    Triangle { corners, middles, area: twice / 2.0, slopes: [slope(b, c), slope(c, a), slope(a, b)] }
}

fn middle(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])]
}
