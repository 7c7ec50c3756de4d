//! Unsymmetric sparse systems with a few equations that most unknowns appear in, solved by LU factors.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::colamd::Control;
use faer::sparse::linalg::lu::{LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};
use faer::{ColMut, Conj, Par};

/// The places of a matrix's entries, and the order of its elimination.
pub(super) struct Sparse {
    pattern: SymbolicSparseColMat<usize>,
    entries: Argsort<usize>,
    symbolic: SymbolicLu<usize>,
}

impl Sparse {
    /// A matrix of this size with entries at these rows and columns, several at one place if need be. Rows and columns of more than
    /// `most` entries come last: else each would make all that appear in it neighbours of one another, and the order useless.
    pub fn of(size: usize, entries: &[Pair<usize, usize>], most: usize) -> Option<Sparse> {
        let (pattern, entries) = SymbolicSparseColMat::try_new_from_indices(size, size, entries).ok()?;
        let dense = (most as f64 + 0.5) / size as f64;
        let control = Control { dense_row: dense, dense_col: dense, ..Control::default() };
        let settings = LuSymbolicParams { colamd_params: control, ..LuSymbolicParams::default() };
        let symbolic = factorize_symbolic_lu(pattern.as_ref(), settings).ok()?;
        Some(Sparse { pattern, entries, symbolic })
    }

    /// Solves with the matrix of these values, in the order of its entries; sequentially, so that the same values give the same bits.
    /// `None` where it is singular.
    pub fn solve(&self, values: &[f64], mut right: Vec<f64>) -> Option<Vec<f64>> {
        let matrix = SparseColMat::new_from_argsort(self.pattern.clone(), &self.entries, values).ok()?;
        let mut numeric = NumericLu::new();
        let (symbolic, own) = (&self.symbolic, Par::Seq);
        let scratch = symbolic
            .factorize_numeric_lu_scratch::<f64>(own, Default::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, own));
        let mut memory = MemBuffer::try_new(scratch).ok()?;
        let stack = MemStack::new(&mut memory);
        let factors = symbolic
            .factorize_numeric_lu(&mut numeric, matrix.as_ref(), own, stack, Default::default())
            .ok()?;
        factors.solve_in_place_with_conj(
            Conj::No,
            ColMut::from_slice_mut(&mut right).as_mat_mut(),
            own,
            stack,
        );
        right.iter().all(|x| x.is_finite()).then_some(right)
    }
}
