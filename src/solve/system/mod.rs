//! The sparse linear system of bodies coupled by joints: its pattern, its matrix, its factorisation.
//!
//! Every body has six columns, displacement then turn (rad, world axes about the centroid). What a body cannot do, or
//! a fixed one, has a diagonal entry alone.

mod elimination;

use std::sync::Arc;

use faer::prelude::Solve;
use faer::sparse::linalg::LltError;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{ColMut, Side};

use crate::solve::bodies::{Body, Freedom};
use crate::solve::joints::Joints;
use elimination::{Elimination, Order};

/// Unknowns per body.
pub const DOF: usize = 6;

/// The matrix of the balance of all bodies, and how to solve with it.
#[derive(Clone)]
pub struct System {
    /// The two bodies of each joint that the pattern was made for.
    pairs: Vec<(u32, u32)>,
    /// The bodies coupled to each body, itself among them, in order.
    neighbours: Arc<Vec<Vec<usize>>>,
    pattern: SymbolicSparseColMat<usize>,
    values: Vec<f64>,
    /// For each joint, where its four blocks (incident and reference by incident and reference) start in the first of
    /// their columns, and the length of the columns.
    places: Vec<[usize; 4]>,
    heights: Vec<usize>,
    /// Start of each body's own block in its first column.
    own: Vec<usize>,
    symmetric: Option<SymbolicLlt<usize>>,
    order: Option<Arc<Order>>,
    factor: Factor,
    /// Whether the matrix was said to be symmetric and proved to have a negative eigenvalue.
    indefinite: bool,
}

#[derive(Clone, Default)]
enum Factor {
    #[default]
    None,
    Symmetric(Llt<usize, f64>),
    General(Arc<Elimination>),
}

/// How a matrix was factorised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// By Cholesky's method: symmetric and positive definite.
    Symmetric,
    /// By elimination.
    General,
}

impl System {
    /// The pattern of the bodies and joints as they are.
    pub fn new(bodies: &[Body], joints: &Joints) -> Self {
        let n = bodies.len();
        let pairs = pairs(joints);
        let mut neighbours: Vec<Vec<usize>> = (0..n).map(|b| vec![b]).collect();
        for &(i, r) in &pairs {
            let (i, r) = (i as usize, r as usize);
            if bodies[i].moves() && bodies[r].moves() {
                neighbours[i].push(r);
                neighbours[r].push(i);
            }
        }
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        let mut col_ptr = vec![0];
        let mut row_idx = Vec::new();
        let mut own = Vec::with_capacity(n);
        let mut starts = Vec::with_capacity(n);
        for (body, list) in neighbours.iter().enumerate() {
            starts.push(row_idx.len());
            own.push(row_idx.len() + DOF * list.binary_search(&body).unwrap_or_default());
            for _ in 0..DOF {
                row_idx.extend(list.iter().flat_map(|b| DOF * b..DOF * (b + 1)));
                col_ptr.push(row_idx.len());
            }
        }
        let heights: Vec<usize> = neighbours.iter().map(|list| DOF * list.len()).collect();
        let place = |row: u32, column: u32| {
            let (row, column) = (row as usize, column as usize);
            neighbours[column].binary_search(&row).map_or(usize::MAX, |k| starts[column] + DOF * k)
        };
        let places =
            pairs.iter().map(|&(i, r)| [place(i, i), place(i, r), place(r, i), place(r, r)]).collect();
        let values = vec![0.0; row_idx.len()];
        let pattern = SymbolicSparseColMat::new_checked(DOF * n, DOF * n, col_ptr, None, row_idx);
        System {
            pairs,
            neighbours: Arc::new(neighbours),
            pattern,
            values,
            places,
            heights,
            own,
            symmetric: None,
            order: None,
            factor: Factor::None,
            indefinite: false,
        }
    }

    /// Whether the pattern still is that of the joints.
    pub fn fits(&self, joints: &Joints) -> bool {
        self.pairs.len() == joints.all.len()
            && self.pairs.iter().zip(&joints.all).all(|(pair, j)| *pair == (j.incident, j.reference))
    }

    /// Whether there is a factorised matrix to solve with.
    pub fn is_factorised(&self) -> bool {
        !matches!(self.factor, Factor::None)
    }

    /// Sets the matrix to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds what couples the two bodies of a joint, by row and column: the incident body's six unknowns, then the reference body's.
    pub fn add_joint(&mut self, joint: usize, bodies: &[Body], what: &[[f64; 2 * DOF]; 2 * DOF]) {
        let (i, r) = self.pairs[joint];
        for (block, place) in self.places[joint].into_iter().enumerate() {
            let column = if block % 2 == 0 { i } else { r } as usize;
            let row = if block < 2 { i } else { r } as usize;
            if place == usize::MAX || !bodies[row].moves() || !bodies[column].moves() {
                continue;
            }
            for c in 0..DOF {
                let start = place + c * self.heights[column];
                for (k, value) in self.values[start..start + DOF].iter_mut().enumerate() {
                    *value += what[DOF * (block / 2) + k][DOF * (block % 2) + c];
                }
            }
        }
    }

    /// The 6 x 6 block of a body with itself, by row and column.
    pub fn own_block(&self, body: usize) -> [[f64; DOF]; DOF] {
        std::array::from_fn(|row| {
            std::array::from_fn(|column| self.values[self.own[body] + column * self.heights[body] + row])
        })
    }

    /// Adds to the 6 x 6 block of a body with itself, by row and column.
    pub fn add_own(&mut self, body: usize, what: &[[f64; DOF]; DOF]) {
        for (row, entries) in what.iter().enumerate() {
            for (column, value) in entries.iter().enumerate() {
                self.values[self.own[body] + column * self.heights[body] + row] += value;
            }
        }
    }

    /// Adds to the diagonal of a body.
    pub fn add_diagonal(&mut self, body: usize, what: [f64; DOF]) {
        for (k, value) in what.into_iter().enumerate() {
            self.values[self.own[body] + k * self.heights[body] + k] += value;
        }
    }

    /// Takes a body's k-th unknown out of the system: what it cannot do. `diagonal` stands for it.
    pub fn hold(&mut self, body: usize, k: usize, diagonal: f64) {
        let (col_ptr, row_idx) = (self.pattern.col_ptr(), self.pattern.row_idx());
        let held = DOF * body + k;
        for place in col_ptr[held]..col_ptr[held + 1] {
            // Row `held` has an entry in each of the columns of the bodies in its own column.
            let column = row_idx[place];
            self.values[place] = 0.0;
            let entries = col_ptr[column]..col_ptr[column + 1];
            if let Ok(k) = row_idx[entries.clone()].binary_search(&held) {
                self.values[entries.start + k] = 0.0;
            }
        }
        self.values[self.own[body] + k * self.heights[body] + k] = diagonal;
    }

    /// Factorises the matrix: as symmetric and positive definite if asked and possible, else in general. Says how, or
    /// `None` where it is singular.
    pub fn factorise(&mut self, symmetric: bool) -> Option<Kind> {
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), &self.values);
        self.indefinite = false;
        if symmetric {
            if self.symmetric.is_none() {
                self.symmetric = SymbolicLlt::try_new(self.pattern.as_ref(), Side::Lower).ok();
            }
            let symbolic = self.symmetric.clone()?;
            match Llt::try_new_with_symbolic(symbolic, matrix, Side::Lower) {
                Ok(factor) => {
                    self.factor = Factor::Symmetric(factor);
                    return Some(Kind::Symmetric);
                }
                Err(LltError::Numeric(_)) => self.indefinite = true,
                Err(LltError::Generic(_)) => return None,
            }
        }
        if self.order.is_none() {
            self.order = Order::new(&self.neighbours).map(Arc::new);
        }
        let eliminated = Elimination::new(self.order.clone()?, &self.neighbours, &self.values)?;
        self.factor = Factor::General(Arc::new(eliminated));
        Some(Kind::General)
    }

    /// Whether the matrix as it was factorised last is that of a stable state: a symmetric one is positive definite, a
    /// general one has a positive determinant, as it has from an unloaded stable state up to the first limit point.
    pub fn is_stable(&self) -> bool {
        match &self.factor {
            _ if self.indefinite => false,
            Factor::None => false,
            Factor::Symmetric(_) => true,
            Factor::General(elimination) => elimination.is_positive(),
        }
    }

    /// Solves with the factorised matrix; NaN where there is none.
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        match &self.factor {
            Factor::None => x.fill(f64::NAN),
            Factor::Symmetric(factor) => {
                factor.solve_in_place(ColMut::from_slice_mut(&mut x));
            }
            Factor::General(elimination) => elimination.solve(&mut x),
        }
        x
    }
}

/// The two bodies of each joint, incident first.
fn pairs(joints: &Joints) -> Vec<(u32, u32)> {
    joints.all.iter().map(|j| (j.incident, j.reference)).collect()
}

/// Which of a body's six unknowns it does not have.
pub fn held(body: &Body) -> &'static [usize] {
    match body.freedom {
        Freedom::Free => &[],
        Freedom::Fixed => &[0, 1, 2, 3, 4, 5],
        // Neither out of plane nor about x and z.
        Freedom::InPlane => &[1, 3, 5],
        // Nor about y.
        Freedom::Upright => &[1, 3, 4, 5],
        Freedom::Led => &[0, 1, 3, 4, 5],
        Freedom::Mounted => &[0, 1, 4, 5],
    }
}
