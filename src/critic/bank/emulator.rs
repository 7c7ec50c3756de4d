//! What the walls of a bank would have done between its points: a quadratic in the scores of the inputs for every number of a
//! path, and what it leaves.

use nalgebra::{DMatrix, DVector};

use crate::critic::bank::path::{NUMBERS, Path};
use crate::stats;

/// Weight of the penalty on coefficients, per wall: enough to keep a point of few neighbours from pulling a curve its way.
const RIDGE: f64 = 1e-3;
/// Scores beyond this are taken to be there: a quadratic says nothing of the far ends of its inputs.
const FURTHEST: f64 = 2.5;

/// The walls of a family under one cause, told by few numbers.
#[derive(Clone, Debug)]
pub struct Emulator {
    inputs: usize,
    /// Coefficients by term and number.
    coefficients: DMatrix<f64>,
    /// Where the walls of the bank lie, in scores.
    scores: Vec<Vec<f64>>,
    /// What each wall of the bank differs by from a curve that does not know it: the stones' own part, and the emulator's error.
    left: Vec<[f64; NUMBERS]>,
    /// Share of the variance that such curves explain, by number.
    explained: [f64; NUMBERS],
}

impl Emulator {
    /// Through walls by their scores (standard normal, one per input) and paths; `None` for fewer than twice as many walls as
    /// terms.
    pub fn fit(scores: &[Vec<f64>], paths: &[Path]) -> Option<Emulator> {
        let inputs = scores.first()?.len();
        let rows: Vec<Vec<f64>> = scores.iter().map(|z| terms(z)).collect();
        let (n, p) = (rows.len(), rows[0].len());
        if n < 2 * p {
            return None;
        }
        let design = DMatrix::from_fn(n, p, |row, column| rows[row][column]);
        let wanted = DMatrix::from_fn(n, NUMBERS, |row, column| paths[row].numbers[column]);
        let mut normal = design.transpose() * &design;
        for k in 1..p {
            normal[(k, k)] += RIDGE * n as f64;
        }
        let solved = normal.cholesky()?;
        let coefficients = solved.solve(&(design.transpose() * &wanted));
        let errors = &wanted - &design * &coefficients;
        let left: Vec<[f64; NUMBERS]> = (0..n)
            .map(|wall| {
                let own = DVector::from_row_slice(&rows[wall]);
                // Without the wall the curve would be further away by this factor (leave-one-out of a linear smoother).
                let further = 1.0 / (1.0 - own.dot(&solved.solve(&own)));
                std::array::from_fn(|number| errors[(wall, number)] * further)
            })
            .collect();
        let explained = std::array::from_fn(|number| {
            let values: Vec<f64> = paths.iter().map(|path| path.numbers[number]).collect();
            let squares: Vec<f64> = left.iter().map(|left| left[number] * left[number]).collect();
            let whole = stats::sigma(&values).unwrap_or(0.0);
            let rest = stats::sum(&squares) / n as f64;
            if whole > 0.0 { 1.0 - rest / (whole * whole) } else { 0.0 }
        });
        Some(Emulator { inputs, coefficients, scores: scores.to_vec(), left, explained })
    }

    /// The path to be expected at these scores, one per input.
    pub fn expected(&self, scores: &[f64]) -> Path {
        crate::check!(scores.len() == self.inputs, "{} scores for {} inputs", scores.len(), self.inputs);
        let terms = terms(scores);
        let number = |k: usize| {
            let products: Vec<f64> =
                terms.iter().zip(self.coefficients.column(k).iter()).map(|(t, c)| t * c).collect();
            stats::sum(&products)
        };
        Path { numbers: std::array::from_fn(number) }
    }

    /// What the walls of the bank that lie nearest to these scores are left with, nearest first: a wall there differs from the
    /// expected path by one of them.
    pub fn nearest(&self, scores: &[f64], count: usize) -> Vec<&[f64; NUMBERS]> {
        let distance =
            |wall: &Vec<f64>| wall.iter().zip(scores).map(|(a, b)| (a - b) * (a - b)).fold(0.0, |s, x| s + x);
        let mut order: Vec<(f64, usize)> = self.scores.iter().map(distance).zip(0..).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        order.into_iter().take(count).map(|(_, wall)| &self.left[wall]).collect()
    }

    /// Share of the variance of each number that is told beforehand for a wall that the curve does not know.
    pub fn explained(&self) -> &[f64; NUMBERS] {
        &self.explained
    }
}

/// One, each score, and each product of two.
fn terms(scores: &[f64]) -> Vec<f64> {
    let z: Vec<f64> = scores.iter().map(|z| z.clamp(-FURTHEST, FURTHEST)).collect();
    let mut terms = vec![1.0];
    terms.extend(&z);
    for (k, a) in z.iter().enumerate() {
        terms.extend(z[k..].iter().map(|b| a * b));
    }
    terms
}
