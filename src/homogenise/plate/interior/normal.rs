//! The normal equations of a step: what is left for the velocities once every group's six stresses, which share their planes with
//! no other, are eliminated.

use faer::prelude::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{ColMut, Side};

use super::problem::{Problem, Six, dot};

/// Added to the diagonal of the normal equations, relative to it: rounding, for motions that no stress hinders.
const REGULARISATION: f64 = 1e-13;
/// Added to what holds stresses to their last value, beside the planes: over their weights' sum, and at all. It slows the method, where
/// no plane bounds a stress, but does not change its end.
const HELD: (f64, f64) = (1e-14, 1e-11);

/// The matrix `sum of B' H^-1 B`, lower half, and its factor; `H` of a group is the weighted sum of its normals' squares.
pub(super) struct Normal {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicLlt<usize>,
    values: Vec<f64>,
    diagonal: Vec<usize>,
    /// Where the products of the velocities of every group are, row by row of its lower half.
    entries: Vec<Vec<usize>>,
    /// Cholesky factors of every `H`.
    blocks: Vec<[Six; 6]>,
    factor: Option<Llt<usize, f64>>,
    /// Velocities from the live load.
    pub per_lambda: Vec<f64>,
}

impl Normal {
    /// The pattern; `None` when memory runs out.
    pub fn new(problem: &Problem) -> Option<Self> {
        let n = problem.dead.len();
        let mut columns: Vec<Vec<usize>> = (0..n).map(|v| vec![v]).collect();
        for group in &problem.groups {
            for (i, (a, _)) in group.rate.iter().enumerate() {
                group.rate[..i].iter().for_each(|(b, _)| columns[*a.min(b)].push(*a.max(b)));
            }
        }
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for column in &mut columns {
            column.sort_unstable();
            column.dedup();
            rows.extend_from_slice(column);
            starts.push(rows.len());
        }
        let place = |a: usize, b: usize| {
            let column = a.min(b);
            starts[column] + columns[column].binary_search(&a.max(b)).expect("it was put there")
        };
        let entries = problem.groups.iter().map(|group| {
            let pairs = group.rate.iter().enumerate();
            pairs.flat_map(|(i, (a, _))| group.rate[..=i].iter().map(|(b, _)| place(*a, *b))).collect()
        });
        let entries = entries.collect();
        let (values, diagonal) = (vec![0.0; rows.len()], starts[..n].to_vec());
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let symbolic = SymbolicLlt::try_new(pattern.as_ref(), Side::Lower).ok()?;
        let blocks = vec![[[0.0; 6]; 6]; problem.groups.len()];
        Some(Self {
            pattern,
            symbolic,
            values,
            diagonal,
            entries,
            blocks,
            factor: None,
            per_lambda: Vec::new(),
        })
    }

    /// Sets the matrix up for the planes' weights, flow over slack, and factorises it. Whether that went well.
    pub fn factorise(&mut self, problem: &Problem, weights: &[f64]) -> bool {
        self.values.fill(0.0);
        for ((group, entries), block) in problem.groups.iter().zip(&self.entries).zip(&mut self.blocks) {
            let mut sum = [[0.0; 6]; 6];
            for (plane, weight) in problem.planes(group).iter().zip(&weights[group.first..]) {
                for (row, n) in sum.iter_mut().zip(plane.normal) {
                    let scaled = n * weight;
                    row.iter_mut().zip(plane.normal).for_each(|(entry, m)| *entry += scaled * m);
                }
            }
            let Some(factor) = cholesky(sum) else { return false };
            *block = factor;
            let halves: Vec<Six> = group.rate.iter().map(|(_, rate)| forward(block, rate)).collect();
            let mut entries = entries.iter();
            for (i, a) in halves.iter().enumerate() {
                halves[..=i].iter().zip(&mut entries).for_each(|(b, at)| self.values[*at] += dot(a, b));
            }
        }
        for &at in &self.diagonal {
            // What nothing hinders has an empty equation.
            let entry = self.values[at];
            self.values[at] = if entry > 0.0 { entry * (1.0 + REGULARISATION) } else { 1.0 };
        }
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), &self.values);
        self.factor = Llt::try_new_with_symbolic(self.symbolic.clone(), matrix, Side::Lower).ok();
        self.per_lambda = self.solve(&problem.live);
        self.factor.is_some()
    }

    /// Velocities from forces.
    pub fn solve(&self, forces: &[f64]) -> Vec<f64> {
        let mut velocities = forces.to_vec();
        if let Some(factor) = &self.factor {
            factor.solve_in_place(ColMut::from_slice_mut(&mut velocities));
        }
        velocities
    }

    /// Stresses from rates: `H^-1` of every group.
    pub fn stresses(&self, rates: &[Six]) -> Vec<Six> {
        let pairs = self.blocks.iter().zip(rates);
        pairs.map(|(block, rate)| backward(block, &forward(block, rate))).collect()
    }
}

/// The Cholesky factor, lower half; `None` where there is none.
fn cholesky(mut a: [Six; 6]) -> Option<[Six; 6]> {
    let trace: f64 = (0..6).map(|i| a[i][i]).sum();
    (0..6).for_each(|i| a[i][i] += HELD.0 * trace + HELD.1);
    for j in 0..6 {
        for k in 0..j {
            let share = a[j][k];
            (j..6).for_each(|i| a[i][j] -= a[i][k] * share);
        }
        if !(a[j][j] > 0.0 && a[j][j].is_finite()) {
            return None;
        }
        let root = a[j][j].sqrt();
        (j..6).for_each(|i| a[i][j] /= root);
    }
    Some(a)
}

fn forward(factor: &[Six; 6], right: &Six) -> Six {
    let mut x = *right;
    for i in 0..6 {
        let known: f64 = (0..i).map(|k| factor[i][k] * x[k]).sum();
        x[i] = (x[i] - known) / factor[i][i];
    }
    x
}

fn backward(factor: &[Six; 6], right: &Six) -> Six {
    let mut x = *right;
    for i in (0..6).rev() {
        let known: f64 = (i + 1..6).map(|k| factor[k][i] * x[k]).sum();
        x[i] = (x[i] - known) / factor[i][i];
    }
    x
}
