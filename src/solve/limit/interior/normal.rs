//! The normal equations of a step: what remains of a step's equations when every group's forces are eliminated, which only
//! their own cone couples. Six equations for each block, coupled as the blocks touch: a ninth of the equations with forces.

use faer::prelude::Solve;
use faer::sparse::linalg::LltError;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{ColMut, Side};

use crate::solve::limit::interior::cone::Triple;
use crate::solve::limit::interior::groups::{ENDS, Group, Groups, SIX, Six};

/// Pairs of ends.
const PAIRS: [(usize, usize); ENDS] = [(0, 1), (0, 2), (1, 2)];
/// Added to the diagonal, relative to it, at first; what it grows by, and how often, where the matrix is not positive.
const REGULARISATION: (f64, f64, u32) = (1e-14, 100.0, 4);

/// The matrix `sum of A_i M_i^-1 A_i'`, lower half, and its factor.
pub(super) struct Normal {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicLlt<usize>,
    values: Vec<f64>,
    /// Where a block's own six by six entries begin, and the length of its columns.
    own: Vec<usize>,
    heights: Vec<usize>,
    /// For every group and pair of its ends where their entries begin, and which two they are: that with the columns first.
    between: Vec<[Option<(usize, usize, usize)>; ENDS]>,
    factor: Option<Llt<usize, f64>>,
}

impl Normal {
    /// The pattern; `None` when memory runs out.
    pub fn new(groups: &Groups) -> Option<Normal> {
        let n = groups.dead.len();
        let mut rows: Vec<Vec<usize>> = (0..n).map(|b| vec![b]).collect();
        for group in &groups.groups {
            for (a, b) in PAIRS.map(|(a, b)| (group.ends[a], group.ends[b])) {
                if let (Some(a), Some(b)) = (a, b) {
                    rows[a.min(b)].push(a.max(b));
                }
            }
        }
        let (mut col_ptr, mut row_idx) = (vec![0], Vec::new());
        let (mut own, mut heights) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for list in &mut rows {
            list.sort_unstable();
            list.dedup();
            own.push(row_idx.len());
            heights.push(SIX * list.len());
            for _ in 0..SIX {
                row_idx.extend(list.iter().flat_map(|b| SIX * b..SIX * (b + 1)));
                col_ptr.push(row_idx.len());
            }
        }
        let between = groups
            .groups
            .iter()
            .map(|group| {
                PAIRS.map(|(first, second)| {
                    let (a, b) = (group.ends[first]?, group.ends[second]?);
                    let (column, row) = (a.min(b), a.max(b));
                    let place = rows[column].binary_search(&row).unwrap_or_default();
                    let (first, second) = if b < a { (second, first) } else { (first, second) };
                    Some((own[column] + SIX * place, first, second))
                })
            })
            .collect();
        let values = vec![0.0; row_idx.len()];
        let pattern = SymbolicSparseColMat::new_checked(SIX * n, SIX * n, col_ptr, None, row_idx);
        let symbolic = SymbolicLlt::try_new(pattern.as_ref(), Side::Lower).ok()?;
        Some(Normal { pattern, symbolic, values, own, heights, between, factor: None })
    }

    /// Sets up the matrix from the groups' `M^-1` and factorises it. Whether that went well.
    pub fn factorise(&mut self, groups: &Groups, inverses: &[[Triple; 3]]) -> bool {
        self.values.fill(0.0);
        for ((k, group), inverse) in groups.groups.iter().enumerate().zip(inverses) {
            let mut weighted = [[[0.0; SIX]; 3]; ENDS];
            for (end, block) in group.ends.iter().enumerate() {
                if let Some(b) = *block {
                    weighted[end] = times(&group.columns[end], inverse);
                    self.add(self.own[b], self.heights[b], &group.columns[end], &weighted[end]);
                }
            }
            for (place, first, second) in self.between[k].into_iter().flatten() {
                let column = group.ends[first].unwrap_or_default();
                self.add(place, self.heights[column], &group.columns[second], &weighted[first]);
            }
        }
        let (mut added, factor, patience) = REGULARISATION;
        for (b, held) in groups.held.iter().enumerate() {
            for (k, held) in held.iter().enumerate() {
                let entry = &mut self.values[self.own[b] + k * (self.heights[b] + 1)];
                // A block that nothing touches has an empty equation.
                *entry = if *held || *entry == 0.0 { 1.0 } else { *entry * (1.0 + added) };
            }
        }
        for _ in 0..patience {
            let matrix = SparseColMatRef::new(self.pattern.as_ref(), &self.values);
            match Llt::try_new_with_symbolic(self.symbolic.clone(), matrix, Side::Lower) {
                Ok(factor) => {
                    self.factor = Some(factor);
                    return true;
                }
                Err(LltError::Numeric(_)) => added *= factor,
                Err(LltError::Generic(_)) => return false,
            }
            for (own, height) in self.own.iter().zip(&self.heights) {
                (0..SIX).for_each(|k| self.values[own + k * (height + 1)] *= 1.0 + added);
            }
        }
        false
    }

    /// Adds `rows columns'` to six by six entries.
    fn add(&mut self, place: usize, height: usize, rows: &[Six; 3], columns: &[Six; 3]) {
        let [first, second, third] = columns;
        for (c, ((x, y), z)) in first.iter().zip(second).zip(third).enumerate() {
            let entries = &mut self.values[place + c * height..][..SIX];
            for (r, entry) in entries.iter_mut().enumerate() {
                *entry += rows[0][r] * x + rows[1][r] * y + rows[2][r] * z;
            }
        }
    }

    /// Solves with the factor.
    pub fn solve(&self, right: &[Six]) -> Vec<Six> {
        let mut x = right.to_vec();
        if let Some(factor) = &self.factor {
            factor.solve_in_place(ColMut::from_slice_mut(x.as_flattened_mut()));
        }
        x
    }
}

/// The columns times a symmetric matrix.
fn times(columns: &[Six; 3], by: &[Triple; 3]) -> [Six; 3] {
    std::array::from_fn(|j| {
        std::array::from_fn(|r| {
            columns[0][r] * by[0][j] + columns[1][r] * by[1][j] + columns[2][r] * by[2][j]
        })
    })
}

impl Group {
    /// What forces of the group do to the blocks, added to `sums`.
    pub fn act(&self, force: Triple, sums: &mut [Six]) {
        for (end, columns) in self.ends.iter().zip(&self.columns) {
            let Some(block) = *end else { continue };
            for (k, sum) in sums[block].iter_mut().enumerate() {
                *sum += columns[0][k] * force[0] + columns[1][k] * force[1] + columns[2][k] * force[2];
            }
        }
    }

    /// Velocities of the blocks as the group feels them.
    pub fn feel(&self, velocities: &[Six]) -> Triple {
        let mut felt = [0.0; 3];
        for (end, columns) in self.ends.iter().zip(&self.columns) {
            let Some(block) = *end else { continue };
            for (sum, column) in felt.iter_mut().zip(columns) {
                *sum += column.iter().zip(&velocities[block]).map(|(a, v)| a * v).sum::<f64>();
            }
        }
        felt
    }
}
