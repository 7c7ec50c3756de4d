//! What the walls of a bank would have done between its points: a Gaussian process with a polynomial mean over the scores of the
//! inputs for every number of a path (Rasmussen and Williams 2006, chapter 2), and what it leaves. In units of the variance that it
//! leaves its covariance is
//!
//! ```text
//! k(z, z') = [z = z'] + WIDE t(z) . t(z') + s m(r)        t: 1; each score as well; each product of two as well
//! m(r) = (1 + sqrt(5) r + 5/3 r^2) exp(-sqrt(5) r)         r^2 = sum of ((z_k - z'_k) / l_k)^2  (Matern, 5/2)
//! ```
//!
//! with the terms `t`, the size `s` and the lengths `l` that predict walls best that they do not know. What a wall's own stones decide
//! (which wedge is lost, which stones are small) hangs on no score: there a constant predicts more than a quadratic.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::critic::simulate::bank::path::NUMBERS;
use crate::math::{exp, exp_all, ln};
use crate::stats;

/// Variance of the polynomial's coefficients.
const WIDE: f64 = 10.0;
/// The first inputs are the joints': walls answer to them smoothly.
const JOINTS: usize = 3;
/// Length over which they do (in scores).
const SMOOTH: f64 = 5.0;
/// Lengths that are tried for the other inputs, and sizes of what a polynomial misses; none at all is tried as well.
const LENGTHS: [f64; 3] = [0.7, 1.5, 3.0];
const SIZES: [f64; 3] = [3.0, 30.0, 300.0];

/// Degrees of the polynomial.
const DEGREES: [usize; 3] = [2, 1, 0];

/// A polynomial and what is smooth beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    degree: usize,
    size: f64,
    length: f64,
}

/// Curves of some of the numbers, of one shape.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    numbers: Range<usize>,
    pub(super) shape: Shape,
    /// Coefficients of the polynomial, by term and number.
    coefficients: Vec<Vec<f64>>,
    known: Known,
}

/// How well a curve is known by the walls of the bank (sections 2.1.2 and 2.2).
#[derive(Clone, Debug)]
enum Known {
    /// A polynomial alone: the covariance of its coefficients.
    Polynomial(DMatrix<f64>),
    /// A polynomial with what is smooth beside it.
    Smooth {
        /// Of the covariance of the walls.
        inverse: DMatrix<f64>,
        /// Terms of the polynomial, by wall.
        terms: Vec<Vec<f64>>,
        /// Weights of the walls in what is smooth, by wall and number.
        weights: Vec<Vec<f64>>,
    },
}

/// What a shape makes of the walls.
struct Fitted {
    /// Terms by wall.
    design: DMatrix<f64>,
    inverse: DMatrix<f64>,
    weights: DMatrix<f64>,
    /// By wall and number.
    left: DMatrix<f64>,
}

impl Curve {
    /// Through walls by their scores and by what their numbers in a range are more than in the mean, with what leaving out each
    /// wall in turn leaves of it (by wall and number). The shape is the one that leaves least.
    pub(super) fn fit(
        numbers: Range<usize>,
        scores: &[Vec<f64>],
        more: &DMatrix<f64>,
    ) -> Option<(Curve, DMatrix<f64>)> {
        let tried: Vec<Shape> =
            DEGREES.iter().flat_map(|&degree| Shape::tried(degree, scores[0].len())).collect();
        let fitted: Vec<(Shape, Fitted)> = tried
            .into_par_iter()
            .filter_map(|shape| Some((shape, Fitted::of(shape, scores, more)?)))
            .collect();
        let best = fitted.into_iter().map(|(shape, fitted)| (fitted.misses(), shape, fitted));
        let (_, shape, Fitted { design, inverse, weights, left }) =
            best.reduce(|best, own| if own.0 < best.0 { own } else { best })?;
        let coefficients = by_row(&(design.transpose() * &weights * WIDE));
        let known = if shape.size > 0.0 {
            let terms = scores.iter().map(|z| terms(z, shape.degree)).collect();
            Known::Smooth { inverse, terms, weights: by_row(&weights) }
        } else {
            let p = design.ncols();
            let information = DMatrix::identity(p, p) / WIDE + design.tr_mul(&design);
            Known::Polynomial(information.cholesky()?.inverse())
        };
        Some((Curve { numbers, shape, coefficients, known }, left))
    }

    /// Adds what is expected at some scores to the numbers of its range; `walls` are the scores that it was fitted through. The terms of
    /// the polynomial there, and the covariances with the walls of what is smooth.
    pub(super) fn expect(
        &self,
        scores: &[f64],
        walls: &[Vec<f64>],
        numbers: &mut [f64; NUMBERS],
    ) -> (Vec<f64>, Vec<f64>) {
        let own = terms(scores, self.shape.degree);
        let mut add = |share: f64, of: &[f64]| {
            let numbers = &mut numbers[self.numbers.clone()];
            numbers.iter_mut().zip(of).for_each(|(number, of)| *number += share * of);
        };
        own.iter().zip(&self.coefficients).for_each(|(term, of)| add(*term, of));
        let Known::Smooth { weights, .. } = &self.known else { return (own, Vec::new()) };
        let distances = walls.iter().map(|wall| self.shape.squared_distance(scores, wall));
        let smooths = self.shape.covariances(distances);
        smooths.iter().zip(weights).for_each(|(covariance, of)| add(*covariance, of));
        (own, smooths)
    }

    /// The [same](Self::expect), and which share of the variance that it leaves is its own error there.
    pub(super) fn add(&self, scores: &[f64], walls: &[Vec<f64>], numbers: &mut [f64; NUMBERS]) -> f64 {
        let (own, smooths) = self.expect(scores, walls, numbers);
        // What the walls do not tell of the curve, in units of what the stones leave.
        let unknown = match &self.known {
            Known::Polynomial(covariance) => {
                let own = DVector::from_vec(own);
                own.dot(&(covariance * &own))
            }
            Known::Smooth { inverse, terms, .. } => {
                let dot = |other: &[f64]| WIDE * own.iter().zip(other).fold(0.0, |sum, (a, b)| sum + a * b);
                let covariances = smooths.iter().zip(terms).map(|(smooth, other)| smooth + dot(other));
                let covariances = DVector::from_iterator(smooths.len(), covariances);
                let known = covariances.dot(&(inverse * &covariances));
                (self.shape.covariance(0.0) + dot(&own) - known).max(0.0)
            }
        };
        unknown / (1.0 + unknown)
    }
}

impl Fitted {
    /// The weights, and what leaving out each wall in turn leaves of it (section 5.4.2): its weight over the diagonal of the
    /// inverse covariance.
    fn of(shape: Shape, scores: &[Vec<f64>], more: &DMatrix<f64>) -> Option<Fitted> {
        let n = scores.len();
        let terms: Vec<Vec<f64>> = scores.iter().map(|z| terms(z, shape.degree)).collect();
        let design = DMatrix::from_fn(n, terms[0].len(), |row, column| terms[row][column]);
        let mut covariance = &design * design.transpose() * WIDE;
        for (row, one) in scores.iter().enumerate() {
            for (column, other) in scores[..row].iter().enumerate() {
                let own = shape.covariance(shape.squared_distance(one, other));
                covariance[(row, column)] += own;
                covariance[(column, row)] += own;
            }
            covariance[(row, row)] += 1.0 + shape.size;
        }
        let inverse = covariance.cholesky()?.inverse();
        let weights = &inverse * more;
        let left =
            DMatrix::from_fn(n, more.ncols(), |wall, number| weights[(wall, number)] / inverse[(wall, wall)]);
        Some(Fitted { design, inverse, weights, left })
    }

    /// How far off it is of walls that it does not know: mean logarithm over the numbers that vary.
    fn misses(&self) -> f64 {
        let squares = self.left.column_iter().map(|left| left.dot(&left)).filter(|square| *square > 0.0);
        stats::mean(&squares.map(ln).collect::<Vec<_>>()).unwrap_or(0.0)
    }
}

impl Shape {
    /// Those with a polynomial of a degree; what a cause does not change is smooth.
    fn tried(degree: usize, inputs: usize) -> Vec<Shape> {
        let alone = Shape { degree, size: 0.0, length: 1.0 };
        let beside = SIZES.iter().flat_map(|&size| LENGTHS.map(|length| Shape { degree, size, length }));
        std::iter::once(alone).chain(beside.filter(|_| inputs > JOINTS)).collect()
    }

    pub(super) fn squared_distance(&self, one: &[f64], other: &[f64]) -> f64 {
        let pairs = one.iter().zip(other).enumerate();
        pairs.fold(0.0, |sum, (k, (a, b))| {
            let length = if k < JOINTS { SMOOTH } else { self.length };
            let off = (a - b) / length;
            sum + off * off
        })
    }

    fn covariance(&self, squared_distance: f64) -> f64 {
        let square = 5.0 * squared_distance;
        self.smooth(square, exp(-square.sqrt()))
    }

    /// Of many squared distances.
    fn covariances(&self, squared_distances: impl Iterator<Item = f64>) -> Vec<f64> {
        let squares: Vec<f64> = squared_distances.map(|of| 5.0 * of).collect();
        let mut covariances: Vec<f64> = squares.iter().map(|square| -square.sqrt()).collect();
        exp_all(&mut covariances);
        covariances.iter_mut().zip(squares).for_each(|(own, square)| *own = self.smooth(square, *own));
        covariances
    }

    /// By five times the squared distance, and how far it has died away at the root of that.
    fn smooth(&self, square: f64, dying: f64) -> f64 {
        self.size * (1.0 + square.sqrt() + square / 3.0) * dying
    }
}

/// Numbers by number, row by row.
fn by_row(of: &DMatrix<f64>) -> Vec<Vec<f64>> {
    of.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// One; of the first degree each score as well; of the second each product of two as well.
pub(super) fn terms(z: &[f64], degree: usize) -> Vec<f64> {
    let mut terms = vec![1.0];
    if degree > 0 {
        terms.extend(z);
    }
    if degree > 1 {
        for (k, a) in z.iter().enumerate() {
            terms.extend(z[k..].iter().map(|b| a * b));
        }
    }
    terms
}
