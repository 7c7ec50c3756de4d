//! Sparse elimination for matrices with a symmetric pattern and a strong diagonal, by faer's simplicial LU.
//!
//! faer's own driver orders the columns for any choice of pivots, which costs a stiffness matrix more than twice the
//! fill, and it does not show its pivots. Here the columns are ordered by minimum degree as for Cholesky's method, the
//! matrix is scaled to a unit diagonal so that the pivots stay there unless they must not, and the sign of the
//! determinant is read off the pivots.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::lu::simplicial::{
    SimplicialLu, factorize_simplicial_numeric_lu, factorize_simplicial_numeric_lu_scratch,
    solve_in_place_scratch,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};

/// An order of the columns that keeps the factors sparse, for all matrices of one pattern.
#[derive(Clone)]
pub struct Order {
    forward: Vec<usize>,
    backward: Vec<usize>,
}

impl Order {
    /// Approximate minimum degree (Amestoy, Davis and Duff 1996, by faer); `None` when memory runs out.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, usize>) -> Option<Order> {
        let n = pattern.ncols();
        let (mut forward, mut backward) = (vec![0; n], vec![0; n]);
        let request = amd::order_maybe_unsorted_scratch::<usize>(n, pattern.row_idx().len());
        let mut memory = MemBuffer::try_new(request).ok()?;
        let stack = MemStack::new(&mut memory);
        amd::order_maybe_unsorted(&mut forward, &mut backward, pattern, amd::Control::default(), stack)
            .ok()?;
        Some(Order { forward, backward })
    }
}

/// The factors of a matrix.
#[derive(Clone)]
pub struct Elimination {
    factors: SimplicialLu<usize, f64>,
    rows: Order,
    columns: Order,
    /// One over the root of the diagonal.
    scale: Vec<f64>,
}

impl Elimination {
    /// Factorises; `None` where the matrix is singular or its diagonal has a zero.
    pub fn new(
        columns: Order,
        pattern: SymbolicSparseColMatRef<'_, usize>,
        values: &[f64],
    ) -> Option<Elimination> {
        let n = pattern.ncols();
        let scale = scale(pattern, values)?;
        let mut scaled = values.to_vec();
        for column in 0..n {
            let range = pattern.col_ptr()[column]..pattern.col_ptr()[column + 1];
            for (value, row) in scaled[range.clone()].iter_mut().zip(&pattern.row_idx()[range]) {
                *value *= scale[column] * scale[*row];
            }
        }
        let mut rows = Order { forward: vec![0; n], backward: vec![0; n] };
        let mut factors = SimplicialLu::new();
        let mut memory =
            MemBuffer::try_new(factorize_simplicial_numeric_lu_scratch::<usize, f64>(n, n)).ok()?;
        factorize_simplicial_numeric_lu(
            &mut rows.forward,
            &mut rows.backward,
            &mut factors,
            SparseColMatRef::new(pattern, &scaled),
            PermRef::new_checked(&columns.forward, &columns.backward, n),
            MemStack::new(&mut memory),
        )
        .ok()?;
        Some(Elimination { factors, rows, columns, scale })
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        let n = x.len();
        for (x, scale) in x.iter_mut().zip(&self.scale) {
            *x *= scale;
        }
        let request = StackReq::or(
            solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq),
            faer::perm::permute_rows_in_place_scratch::<usize, f64>(n, 1),
        );
        let mut memory = MemBuffer::new(request);
        self.factors.solve_in_place_with_conj(
            PermRef::new_checked(&self.rows.forward, &self.rows.backward, n),
            PermRef::new_checked(&self.columns.forward, &self.columns.backward, n),
            Conj::No,
            MatMut::from_column_major_slice_mut(x, n, 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        for (x, scale) in x.iter_mut().zip(&self.scale) {
            *x *= scale;
        }
    }

    /// Whether the determinant is positive.
    pub fn is_positive(&self) -> bool {
        let upper = self.factors.u_factor_unsorted();
        let mut positive = is_even(&self.rows.forward) == is_even(&self.columns.forward);
        for column in 0..upper.ncols() {
            for (row, value) in upper.row_idx_of_col(column).zip(upper.val_of_col(column)) {
                if row == column && *value < 0.0 {
                    positive = !positive;
                }
            }
        }
        positive
    }
}

/// One over the root of each diagonal entry; `None` where one is zero or missing.
fn scale(pattern: SymbolicSparseColMatRef<'_, usize>, values: &[f64]) -> Option<Vec<f64>> {
    (0..pattern.ncols())
        .map(|column| {
            let start = pattern.col_ptr()[column];
            let rows = &pattern.row_idx()[start..pattern.col_ptr()[column + 1]];
            let diagonal = values[start + rows.binary_search(&column).ok()?].abs();
            (diagonal > 0.0).then(|| 1.0 / diagonal.sqrt())
        })
        .collect()
}

/// Whether a permutation is made of an even number of swaps.
fn is_even(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut even = true;
    for start in 0..permutation.len() {
        let mut at = permutation[start];
        while !seen[start] && at != start {
            seen[at] = true;
            at = permutation[at];
            even = !even;
        }
        seen[start] = true;
    }
    even
}
