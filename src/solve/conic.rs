//! What the conic programs share that clarabel solves (Goulart and Chen 2024): sparse matrices entry by entry, and its settings.

use clarabel::algebra::CscMatrix;
use clarabel::solver::DefaultSettings;

/// A sparse matrix, entry by entry; entries at the same place add up.
#[derive(Default)]
pub(crate) struct Entries {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl Entries {
    /// Adds a value at a place; a zero takes none.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        if value != 0.0 {
            self.rows.push(row);
            self.columns.push(column);
            self.values.push(value);
        }
    }

    /// The matrix of so many rows and columns.
    pub fn matrix(self, height: usize, width: usize) -> CscMatrix<f64> {
        CscMatrix::new_from_triplets(height, width, self.rows, self.columns, self.values)
    }
}

/// On one thread, so that bits are the same, without presolve, to a relative accuracy of gap, equilibrium and compatibility.
pub(crate) fn settings(tolerance: f64) -> DefaultSettings<f64> {
    DefaultSettings {
        verbose: false,
        max_threads: 1,
        tol_gap_abs: tolerance,
        tol_gap_rel: tolerance,
        tol_feas: tolerance,
        presolve_enable: false,
        ..DefaultSettings::default()
    }
}
