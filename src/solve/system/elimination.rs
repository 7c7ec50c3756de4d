//! Sparse elimination by blocks of six.
//!
//! Two bodies that touch have a full block of six by six, and so has everything that elimination fills in: worked by
//! blocks, one index serves 36 numbers, and the innermost loops have a fixed length. Stiffness has its pivots on the
//! diagonal, so rows are exchanged within a body only, and the fill is known beforehand; the matrix is scaled to a unit
//! diagonal, as forces and moments are not of one size. The sign of the determinant is read off the pivots.
//!
//! With `D` the block of a body after all before it have been eliminated, and `i`, `j` what it touches:
//!
//! ```text
//! L_i = A_i D^-1        A_ij <- A_ij - L_i U_j
//! ```
//!
//! Beside faer's LU, which may exchange any rows and therefore fills in more, it takes a quarter of the time, from a wall of
//! a hundred blocks to one of ten thousand (`benches/history`).

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};

use crate::solve::system::DOF;

/// A block by columns.
type Block = [[f64; DOF]; DOF];

const ZERO: Block = [[0.0; DOF]; DOF];

/// In which order bodies are eliminated, and what that fills in: the same for all matrices of one pattern.
#[derive(Debug)]
pub struct Order {
    /// Place of each body in the order.
    place: Vec<u32>,
    /// The bodies, first eliminated first.
    bodies: Vec<u32>,
    /// The places, in order, that are later than a place and coupled to it: those of place `k` from `start[k]` on.
    later: Vec<u32>,
    start: Vec<usize>,
}

impl Order {
    /// By approximate minimum degree (Amestoy, Davis and Duff 1996, by faer), from the coupled bodies of each body, in
    /// order; `None` when memory runs out.
    pub fn new(neighbours: &[Vec<usize>]) -> Option<Order> {
        let n = neighbours.len();
        let mut col_ptr = vec![0];
        let mut row_idx = Vec::new();
        for list in neighbours {
            row_idx.extend_from_slice(list);
            col_ptr.push(row_idx.len());
        }
        let pattern = SymbolicSparseColMat::new_checked(n, n, col_ptr, None, row_idx);
        let bodies = minimum_degree(pattern.as_ref())?;
        let mut place = vec![0; n];
        for (k, &body) in bodies.iter().enumerate() {
            place[body as usize] = k as u32;
        }
        // What is eliminated couples all that it is coupled to: the first of them inherits the others.
        let mut columns: Vec<Vec<u32>> = vec![Vec::new(); n];
        let (mut later, mut start) = (Vec::new(), vec![0]);
        for (k, &body) in bodies.iter().enumerate() {
            let mut column = std::mem::take(&mut columns[k]);
            column.extend(neighbours[body as usize].iter().map(|&b| place[b]).filter(|&p| p as usize > k));
            column.sort_unstable();
            column.dedup();
            if let Some((&first, others)) = column.split_first() {
                columns[first as usize].extend_from_slice(others);
            }
            later.extend_from_slice(&column);
            start.push(later.len());
        }
        Some(Order { place, bodies, later, start })
    }

    /// The later places coupled to a place.
    fn after(&self, k: usize) -> &[u32] {
        &self.later[self.start[k]..self.start[k + 1]]
    }
}

fn minimum_degree(pattern: SymbolicSparseColMatRef<'_, usize>) -> Option<Vec<u32>> {
    let n = pattern.ncols();
    let (mut forward, mut backward) = (vec![0; n], vec![0; n]);
    let request = amd::order_maybe_unsorted_scratch::<usize>(n, pattern.row_idx().len());
    let mut memory = MemBuffer::try_new(request).ok()?;
    let stack = MemStack::new(&mut memory);
    amd::order_maybe_unsorted(&mut forward, &mut backward, pattern, amd::Control::default(), stack).ok()?;
    Some(forward.into_iter().map(|body| body as u32).collect())
}

/// The factors of a matrix.
#[derive(Debug)]
pub struct Elimination {
    order: Arc<Order>,
    pivots: Vec<Pivot>,
    /// Blocks of the lower and the upper factor, in the sequence of [`Order::later`].
    lower: Vec<Block>,
    upper: Vec<Block>,
    /// One over the root of the diagonal.
    scale: Vec<f64>,
}

impl Elimination {
    /// Factorises a matrix whose entries `neighbours` give: six columns for each body, in each the six rows of each body
    /// coupled to it, in order. `None` where it is singular or its diagonal has a zero.
    pub fn new(order: Arc<Order>, neighbours: &[Vec<usize>], values: &[f64]) -> Option<Elimination> {
        let n = neighbours.len();
        let scale = scale(neighbours, values)?;
        let mut diagonal = vec![ZERO; n];
        let (mut lower, mut upper) = (vec![ZERO; order.later.len()], vec![ZERO; order.later.len()]);
        let mut from = 0;
        for (column, list) in neighbours.iter().enumerate() {
            let height = DOF * list.len();
            for (k, &row) in list.iter().enumerate() {
                let block: Block = std::array::from_fn(|c| {
                    let entries = &values[from + c * height + DOF * k..][..DOF];
                    std::array::from_fn(|r| entries[r] * scale[DOF * row + r] * scale[DOF * column + c])
                });
                let (r, c) = (order.place[row] as usize, order.place[column] as usize);
                let at = |early: usize, late: usize| {
                    Some(order.start[early] + order.after(early).binary_search(&(late as u32)).ok()?)
                };
                match r.cmp(&c) {
                    std::cmp::Ordering::Equal => diagonal[r] = block,
                    std::cmp::Ordering::Greater => lower[at(c, r)?] = block,
                    std::cmp::Ordering::Less => upper[at(r, c)?] = block,
                }
            }
            from += DOF * height;
        }
        let mut pivots = Vec::with_capacity(n);
        for k in 0..n {
            let pivot = Pivot::new(diagonal[k])?;
            let after = order.after(k);
            let (start, end) = (order.start[k], order.start[k + 1]);
            let (own_lower, later_lower) = lower.split_at_mut(end);
            let (own_upper, later_upper) = upper.split_at_mut(end);
            let (own_lower, own_upper) = (&mut own_lower[start..], &own_upper[start..]);
            own_lower.iter_mut().for_each(|block| pivot.divide(block));
            for (a, &j) in after.iter().enumerate() {
                let j = j as usize;
                subtract(&mut diagonal[j], &own_lower[a], &own_upper[a]);
                let mut at = order.start[j] - end;
                let mut targets = order.after(j).iter();
                for (b, i) in after.iter().enumerate().skip(a + 1) {
                    // All that is coupled to `k` later than `j` is coupled to `j`.
                    at += targets.position(|target| target == i)?;
                    subtract(&mut later_lower[at], &own_lower[b], &own_upper[a]);
                    subtract(&mut later_upper[at], &own_lower[a], &own_upper[b]);
                    at += 1;
                }
            }
            pivots.push(pivot);
        }
        Some(Elimination { order, pivots, lower, upper, scale })
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        let Order { bodies, .. } = &*self.order;
        let mut y: Vec<[f64; DOF]> = bodies
            .iter()
            .map(|&b| std::array::from_fn(|k| x[DOF * b as usize + k] * self.scale[DOF * b as usize + k]))
            .collect();
        for k in 0..y.len() {
            let known = y[k];
            for (&i, block) in self.order.after(k).iter().zip(&self.lower[self.order.start[k]..]) {
                take_off(&mut y[i as usize], block, &known);
            }
        }
        for k in (0..y.len()).rev() {
            let mut right = y[k];
            for (&i, block) in self.order.after(k).iter().zip(&self.upper[self.order.start[k]..]) {
                take_off(&mut right, block, &y[i as usize]);
            }
            y[k] = self.pivots[k].solve(right);
        }
        for (&b, y) in bodies.iter().zip(&y) {
            let range = DOF * b as usize..DOF * (b as usize + 1);
            for ((x, scale), y) in x[range.clone()].iter_mut().zip(&self.scale[range]).zip(y) {
                *x = y * scale;
            }
        }
    }

    /// Whether the determinant is positive.
    pub fn is_positive(&self) -> bool {
        self.pivots.iter().filter(|pivot| !pivot.is_positive).count() % 2 == 0
    }
}

/// The factors of the block that a body is eliminated by, its rows exchanged for the largest pivots.
#[derive(Debug)]
struct Pivot {
    /// Unit lower factor below the diagonal, upper factor above it, one over the pivots on it; by columns.
    factors: Block,
    /// Row of the block that stands in each row of the factors.
    rows: [usize; DOF],
    /// Whether the block's determinant is positive.
    is_positive: bool,
}

impl Pivot {
    fn new(mut block: Block) -> Option<Pivot> {
        let mut rows: [usize; DOF] = std::array::from_fn(|k| k);
        let mut is_positive = true;
        for k in 0..DOF {
            let largest = (k..DOF)
                .fold(k, |best, row| if block[k][row].abs() > block[k][best].abs() { row } else { best });
            if largest != k {
                rows.swap(k, largest);
                block.iter_mut().for_each(|column| column.swap(k, largest));
                is_positive = !is_positive;
            }
            let pivot = block[k][k];
            is_positive ^= pivot < 0.0;
            let inverse = 1.0 / pivot;
            // Zero and NaN as well.
            if !inverse.is_finite() || pivot.is_infinite() {
                return None;
            }
            block[k][k] = inverse;
            block[k].iter_mut().skip(k + 1).for_each(|x| *x *= inverse);
            let eliminated = block[k];
            for column in block.iter_mut().skip(k + 1) {
                let factor = column[k];
                for row in k + 1..DOF {
                    column[row] -= eliminated[row] * factor;
                }
            }
        }
        Some(Pivot { factors: block, rows, is_positive })
    }

    /// Multiplies a block by the inverse from the right.
    fn divide(&self, block: &mut Block) {
        for k in 0..DOF {
            for earlier in 0..k {
                let (factor, known) = (self.factors[k][earlier], block[earlier]);
                block[k].iter_mut().zip(known).for_each(|(x, known)| *x -= known * factor);
            }
            block[k].iter_mut().for_each(|x| *x *= self.factors[k][k]);
        }
        for k in (0..DOF).rev() {
            for later in k + 1..DOF {
                let (factor, known) = (self.factors[k][later], block[later]);
                block[k].iter_mut().zip(known).for_each(|(x, known)| *x -= known * factor);
            }
        }
        let exchanged = *block;
        for (column, &row) in exchanged.iter().zip(&self.rows) {
            block[row] = *column;
        }
    }

    fn solve(&self, right: [f64; DOF]) -> [f64; DOF] {
        let mut x = self.rows.map(|row| right[row]);
        for k in 0..DOF {
            for row in k + 1..DOF {
                x[row] -= self.factors[k][row] * x[k];
            }
        }
        for k in (0..DOF).rev() {
            x[k] *= self.factors[k][k];
            for row in 0..k {
                x[row] -= self.factors[k][row] * x[k];
            }
        }
        x
    }
}

/// `target -= left right`.
fn subtract(target: &mut Block, left: &Block, right: &Block) {
    for (target, right) in target.iter_mut().zip(right) {
        take_off(target, left, right);
    }
}

/// `target -= block x`.
fn take_off(target: &mut [f64; DOF], block: &Block, x: &[f64; DOF]) {
    for (column, x) in block.iter().zip(x) {
        target.iter_mut().zip(column).for_each(|(target, entry)| *target -= entry * x);
    }
}

/// One over the root of each diagonal entry; `None` where one is zero.
fn scale(neighbours: &[Vec<usize>], values: &[f64]) -> Option<Vec<f64>> {
    let mut scale = Vec::with_capacity(DOF * neighbours.len());
    let mut from = 0;
    for (body, list) in neighbours.iter().enumerate() {
        let (own, height) = (DOF * list.binary_search(&body).ok()?, DOF * list.len());
        for k in 0..DOF {
            let diagonal = values[from + k * height + own + k].abs();
            scale.push((diagonal > 0.0).then(|| 1.0 / diagonal.sqrt())?);
        }
        from += DOF * height;
    }
    Some(scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// The bodies coupled in a bond of `courses` by `length` stones: beside one another, and two above and below.
    fn bond(courses: usize, length: usize) -> Vec<Vec<usize>> {
        let at = |course: usize, stone: usize| course * length + stone;
        let mut neighbours: Vec<Vec<usize>> = (0..courses * length).map(|body| vec![body]).collect();
        let mut couple = |a: usize, b: usize| {
            neighbours[a].push(b);
            neighbours[b].push(a);
        };
        for course in 0..courses {
            for stone in 0..length {
                if stone > 0 {
                    couple(at(course, stone), at(course, stone - 1));
                }
                if course > 0 {
                    couple(at(course, stone), at(course - 1, stone));
                    if stone > 0 {
                        couple(at(course, stone), at(course - 1, stone - 1));
                    }
                }
            }
        }
        neighbours.iter_mut().for_each(|list| list.sort_unstable());
        neighbours
    }

    /// Random entries, with `diagonal` added to the diagonal; and the same as a dense matrix.
    fn random(neighbours: &[Vec<usize>], diagonal: f64, seed: u64) -> (Vec<f64>, DMatrix<f64>) {
        let mut draws = ChaCha8Rng::seed_from_u64(seed);
        let n = DOF * neighbours.len();
        let (mut values, mut dense) = (Vec::new(), DMatrix::zeros(n, n));
        for column in 0..n {
            for &body in &neighbours[column / DOF] {
                for row in DOF * body..DOF * (body + 1) {
                    let entry = draws.random_range(-1.0..1.0) + if row == column { diagonal } else { 0.0 };
                    values.push(entry);
                    dense[(row, column)] = entry;
                }
            }
        }
        (values, dense)
    }

    fn eliminated(neighbours: &[Vec<usize>], values: &[f64]) -> Option<Elimination> {
        Elimination::new(Arc::new(Order::new(neighbours)?), neighbours, values)
    }

    #[test]
    fn solves_what_a_dense_elimination_solves_and_knows_the_sign_of_its_determinant() {
        let neighbours = bond(5, 7);
        let mut signs = [0, 0];
        // From a strong diagonal to one that pivots cannot rely on: the last ones lose some digits.
        for (seed, diagonal, tolerance) in
            (0..40).flat_map(|seed| [(seed, 20.0, 1e-13), (seed, -20.0, 1e-13), (seed, 3.0, 1e-8)])
        {
            let (values, dense) = random(&neighbours, diagonal, seed);
            let elimination = eliminated(&neighbours, &values).expect("regular");
            let right = DVector::from_fn(dense.nrows(), |row, _| crate::math::sin(row as f64));
            let mut found = right.as_slice().to_vec();
            elimination.solve(&mut found);
            let lu = dense.lu();
            let expected = lu.solve(&right).expect("regular");
            let error = (DVector::from_vec(found) - &expected).norm() / expected.norm();
            assert!(error < tolerance, "seed {seed}, diagonal {diagonal}: {error:.1e}");
            assert_eq!(elimination.is_positive(), lu.determinant() > 0.0, "seed {seed}, diagonal {diagonal}");
            signs[usize::from(elimination.is_positive())] += 1;
        }
        assert!(signs[0] > 10 && signs[1] > 10, "one sign alone tells nothing: {signs:?}");
    }

    #[test]
    fn a_singular_matrix_has_no_factors() {
        let neighbours = bond(1, 1);
        // Two equal rows; and a zero on the diagonal.
        let (mut values, _) = random(&neighbours, 5.0, 1);
        (0..DOF).for_each(|column| values[DOF * column + 4] = values[DOF * column + 2]);
        assert!(eliminated(&neighbours, &values).is_none());
        let (mut values, _) = random(&neighbours, 5.0, 1);
        values[0] = 0.0;
        assert!(eliminated(&neighbours, &values).is_none());
    }

    #[test]
    fn rows_are_exchanged_within_a_body() {
        let neighbours = bond(1, 1);
        // A small pivot where a large one stands below it.
        let (mut values, mut dense) = random(&neighbours, 0.0, 3);
        values[0] = 1e-18;
        dense[(0, 0)] = 1e-18;
        let right = DVector::from_fn(DOF, |row, _| 1.0 + row as f64);
        let mut found = right.as_slice().to_vec();
        eliminated(&neighbours, &values).expect("regular").solve(&mut found);
        let expected = dense.lu().solve(&right).expect("regular");
        assert!((DVector::from_vec(found) - &expected).norm() < 1e-9 * expected.norm());
    }
}
