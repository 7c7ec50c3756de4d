//! The conic program: sparse equilibrium, strength of every contact point, pulls of the ropes, a cap on the multiplier; solved by clarabel
//! (Goulart and Chen 2024) on one thread: the same bits on the same machine.
//!
//! Unknowns are the multiplier and the contact forces over the unit of force (the blocks' mean weight); moments are divided
//! by the block's radius, so that all rows and columns are of the size of one.

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, SecondOrderConeT, ZeroConeT};
use clarabel::solver::{DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

use crate::math::Vec3;
use crate::model::Support;
use crate::shape::Frame;
use crate::solve::conic::{Entries, settings};
use crate::solve::limit::Cone;
use crate::solve::limit::interfaces::{Blocks, Interface, Rigid};
use crate::solve::limit::loads::Wrench;
use crate::solve::limit::strength::{Strength, apothem, facets};

/// The largest multiplier asked for, and what it multiplies.
pub(crate) struct Program<'a> {
    pub blocks: &'a Blocks,
    /// In-plane axes of every joint, the first along the load.
    pub axes: &'a [[Vec3; 2]],
    /// Strength of every contact point.
    pub strengths: &'a [Strength],
    pub dead: &'a [Wrench],
    pub live: &'a [Wrench],
    /// The multiplier is at most this.
    pub cap: f64,
    pub cone: Cone,
    pub tolerance: f64,
    /// Whether a state that reaches the cap is all that is asked. All loads are live then, and no load at all is borne.
    pub enough: bool,
    /// What a normal force of one unit of force costs, in multipliers.
    pub pressure: f64,
    /// Normal forces that the solution is to be near.
    pub near: Option<Near<'a>>,
}

/// A preference among the states that bear as much: half of the weight times the squares of the distances, over the unit
/// of force, is taken off the multiplier.
#[derive(Clone, Copy)]
pub(crate) struct Near<'a> {
    pub weight: f64,
    /// Normal force (N) at every contact point.
    pub normal: &'a [f64],
}

/// What the solver gave; nothing of it is believed before it has been audited.
pub(crate) struct Solved {
    pub multiplier: f64,
    /// Force (N) on the incident block at every contact point: along the normal and the two in-plane axes.
    pub forces: Vec<[f64; 3]>,
    /// Pull (N) of every rope.
    pub pulls: Vec<f64>,
    /// Velocity and spin of every block; scaled so that the live loads have the power 1 W, unless the cap holds.
    pub velocities: Vec<Wrench>,
    pub iterations: u32,
    pub status: SolverStatus,
}

/// Directions of the joint forces in the plane of each joint: the first along the projection of the first direction that
/// has one.
pub(crate) fn axes(blocks: &Blocks, directions: [Vec3; 2]) -> Vec<[Vec3; 2]> {
    let first = |normal: Vec3| {
        directions
            .iter()
            .map(|d| (d - normal * d.dot(&normal), d.norm()))
            // A projection of less than 1e-6 of the load is its rounding.
            .find(|(projection, size)| projection.norm() > 1e-6 * size)
            .map_or_else(
                || Frame::on_plane(Vec3::zeros(), normal).s,
                |(projection, _)| projection.normalize(),
            )
    };
    blocks
        .interfaces
        .iter()
        .map(|joint| {
            let e1 = first(joint.normal);
            [e1, joint.normal.cross(&e1)]
        })
        .collect()
}

/// The constraints of the program, row by row.
#[derive(Default)]
struct Matrix {
    entries: Entries,
    right: Vec<f64>,
}

impl Matrix {
    /// Adds the row `entries . x + s = right`.
    fn row(&mut self, entries: &[(usize, f64)], right: f64) {
        let row = self.right.len();
        entries.iter().for_each(|&(column, value)| self.entries.add(row, column, value));
        self.right.push(right);
    }
}

/// Where the equilibrium rows of a block begin; `None` for a fixed one.
fn first_rows(blocks: &Blocks) -> (Vec<Option<usize>>, usize) {
    let mut next = 0;
    let first = blocks
        .rigid
        .iter()
        .map(|block| {
            let rows = match block.support {
                Support::Fixed | Support::Absent => return None,
                Support::Free if block.pinned => 3,
                Support::Free => 6,
                Support::OutOfPlane => 3,
                Support::Upright => 2,
            };
            next += rows;
            Some(next - rows)
        })
        .collect();
    (first, next)
}

/// The components of a wrench that a block feels, in the order of its rows; moments over its radius.
fn components(block: &Rigid, wrench: &Wrench) -> ([f64; 6], usize) {
    let (f, m) = (wrench.force, wrench.moment / block.radius);
    match block.support {
        Support::Fixed | Support::Absent => ([0.0; 6], 0),
        Support::Free if block.pinned => ([m.x, m.y, m.z, 0.0, 0.0, 0.0], 3),
        Support::Free => ([f.x, f.y, f.z, m.x, m.y, m.z], 6),
        Support::OutOfPlane => ([f.x, f.z, m.y, 0.0, 0.0, 0.0], 3),
        Support::Upright => ([f.x, f.z, 0.0, 0.0, 0.0, 0.0], 2),
    }
}

impl Program<'_> {
    /// Whether more than the multiplier is asked for.
    pub fn has_preference(&self) -> bool {
        self.near.is_some() || self.pressure > 0.0
    }

    /// Solves the program as it stands, by clarabel.
    pub fn solve(&self) -> Solved {
        let (first, equations) = first_rows(self.blocks);
        let columns = self.columns();
        let ropes = 1 + columns.iter().map(|c| c.1).sum::<usize>();
        let unknowns = ropes + self.blocks.ties.len();
        let mut matrix = self.equilibrium(&first, equations, &columns);
        self.pull(&mut matrix, &first, ropes);
        let cones = self.strength(&mut matrix, &columns, equations, ropes);
        let (objective, quadratic) = self.objective(&columns, unknowns);
        let Matrix { entries, right } = matrix;
        let constraints = entries.matrix(right.len(), unknowns);
        let mut solver = DefaultSolver::new(
            &quadratic,
            &objective,
            &constraints,
            &right,
            &cones,
            settings(self.tolerance),
        )
        .expect("the program's dimensions agree");
        solver.solve();
        let (x, z) = (&solver.solution.x, &solver.solution.z);
        Solved {
            multiplier: x[0],
            forces: self.forces(x, &columns),
            pulls: x[ropes..].iter().map(|pull| pull * self.blocks.unit).collect(),
            velocities: self.velocities(z, &first),
            iterations: solver.solution.iterations,
            status: solver.solution.status,
        }
    }

    /// Slopes and curvatures of what is minimised.
    fn objective(&self, columns: &[(usize, usize)], unknowns: usize) -> (Vec<f64>, CscMatrix<f64>) {
        let (mut slopes, mut curvatures) = (vec![0.0; unknowns], vec![0.0; unknowns]);
        slopes[0] = -1.0;
        for (k, &(column, _)) in columns.iter().enumerate() {
            slopes[column] = self.pressure;
            if let Some(near) = self.near {
                slopes[column] -= near.weight * near.normal[k] / self.blocks.unit;
                curvatures[column] = near.weight;
            }
        }
        let curved: Vec<usize> = (0..unknowns).filter(|&k| curvatures[k] > 0.0).collect();
        let values = curved.iter().map(|&k| curvatures[k]).collect();
        (slopes, CscMatrix::new_from_triplets(unknowns, unknowns, curved.clone(), curved, values))
    }

    /// First column and number of columns of every contact point: the normal force, and the shear if it can bear any.
    fn columns(&self) -> Vec<(usize, usize)> {
        let mut next = 1;
        self.strengths
            .iter()
            .map(|strength| {
                let width = if strength.shears() { 3 } else { 1 };
                next += width;
                (next - width, width)
            })
            .collect()
    }

    /// Directions of the unit forces of a joint's contact points.
    pub(super) fn directions(&self, joint: usize) -> [Vec3; 3] {
        let [e1, e2] = self.axes[joint];
        [self.blocks.interfaces[joint].normal, e1, e2]
    }

    /// Every contact point as (joint, interface, position).
    pub(super) fn points(&self) -> impl Iterator<Item = (usize, &Interface, Vec3)> {
        let joints = self.blocks.interfaces.iter().enumerate();
        joints.flat_map(|(j, interface)| interface.points.iter().map(move |p| (j, interface, p.at)))
    }

    /// Rows `B f + lambda l = -d`.
    fn equilibrium(&self, first: &[Option<usize>], equations: usize, columns: &[(usize, usize)]) -> Matrix {
        let mut matrix = Matrix { right: vec![0.0; equations], ..Matrix::default() };
        for (b, block) in self.blocks.rigid.iter().enumerate() {
            let Some(row) = first[b] else { continue };
            let (live, n) = components(block, &self.live[b]);
            let (dead, _) = components(block, &self.dead[b]);
            for k in 0..n {
                matrix.entries.add(row + k, 0, live[k] / self.blocks.unit);
                matrix.right[row + k] = -dead[k] / self.blocks.unit;
            }
        }
        for ((joint, interface, at), &(column, width)) in self.points().zip(columns) {
            for (c, direction) in self.directions(joint).into_iter().enumerate().take(width) {
                for (b, wrench) in self.blocks.felt(interface, at, direction).into_iter().flatten() {
                    let Some(row) = first[b] else { continue };
                    let (values, n) = components(&self.blocks.rigid[b], &wrench);
                    (0..n).for_each(|k| matrix.entries.add(row + k, column + c, values[k]));
                }
            }
        }
        matrix
    }

    /// Adds the ropes' pulls, whose columns begin at `ropes`, to the equilibrium.
    fn pull(&self, matrix: &mut Matrix, first: &[Option<usize>], ropes: usize) {
        for (k, rope) in self.blocks.ties.iter().enumerate() {
            let Some(row) = first[rope.block] else { continue };
            let block = &self.blocks.rigid[rope.block];
            let mut wrench = Wrench::default();
            wrench.add(rope.at - block.centroid, -rope.direction);
            let (values, n) = components(block, &wrench);
            (0..n).for_each(|r| matrix.entries.add(row + r, ropes + k, values[r]));
        }
    }

    /// Rows of the cap, of the strengths and of the ropes; returns all cones.
    fn strength(
        &self,
        matrix: &mut Matrix,
        columns: &[(usize, usize)],
        equations: usize,
        ropes: usize,
    ) -> Vec<SupportedConeT<f64>> {
        matrix.row(&[(0, 1.0)], self.cap);
        let points = || self.strengths.iter().zip(columns.iter()).filter(|(s, _)| !s.bonded);
        let unit = self.blocks.unit;
        for (s, &(n, _)) in points().filter(|(s, _)| s.needs_least()) {
            matrix.row(&[(n, -1.0)], -s.least / unit);
        }
        for (k, _) in self.blocks.ties.iter().enumerate().filter(|(_, rope)| !rope.two_sided) {
            matrix.row(&[(ropes + k, -1.0)], 0.0);
        }
        let mut cones = vec![ZeroConeT(equations)];
        match self.cone {
            Cone::Linearised { sides } => {
                let reach = apothem(sides);
                for (s, &(n, _)) in points().filter(|(s, _)| s.shears()) {
                    for [a, b] in facets(sides) {
                        let row = [(n, -s.friction * reach), (n + 1, a), (n + 2, b)];
                        matrix.row(&row, s.cohesion / unit * reach);
                    }
                }
                cones.push(NonnegativeConeT(matrix.right.len() - equations));
            }
            Cone::SecondOrder => {
                cones.push(NonnegativeConeT(matrix.right.len() - equations));
                for (s, &(n, _)) in points().filter(|(s, _)| s.shears()) {
                    matrix.row(&[(n, -s.friction)], s.cohesion / unit);
                    matrix.row(&[(n + 1, -1.0)], 0.0);
                    matrix.row(&[(n + 2, -1.0)], 0.0);
                    cones.push(SecondOrderConeT(3));
                }
            }
        }
        cones
    }

    fn forces(&self, x: &[f64], columns: &[(usize, usize)]) -> Vec<[f64; 3]> {
        let of = |&(column, width): &(usize, usize)| {
            let mut force = [0.0; 3];
            (0..width).for_each(|k| force[k] = x[column + k] * self.blocks.unit);
            force
        };
        columns.iter().map(of).collect()
    }

    fn velocities(&self, z: &[f64], first: &[Option<usize>]) -> Vec<Wrench> {
        let of = |(b, first): (usize, &Option<usize>)| {
            let Some(row) = *first else { return Wrench::default() };
            let (unit, radius) = (self.blocks.unit, self.blocks.rigid[b].radius);
            let v = |k: usize| z[row + k] / unit;
            let w = |k: usize| z[row + k] / (unit * radius);
            match self.blocks.rigid[b].support {
                Support::Fixed | Support::Absent => Wrench::default(),
                Support::Free if self.blocks.rigid[b].pinned => {
                    Wrench { force: Vec3::zeros(), moment: Vec3::new(w(0), w(1), w(2)) }
                }
                Support::Free => {
                    Wrench { force: Vec3::new(v(0), v(1), v(2)), moment: Vec3::new(w(3), w(4), w(5)) }
                }
                Support::OutOfPlane => {
                    Wrench { force: Vec3::new(v(0), 0.0, v(1)), moment: Vec3::new(0.0, w(2), 0.0) }
                }
                Support::Upright => Wrench { force: Vec3::new(v(0), 0.0, v(1)), moment: Vec3::zeros() },
            }
        };
        first.iter().enumerate().map(of).collect()
    }
}
