//! What the walls of a bank would have done between its points: [curves](curve) of the numbers of a path over the scores of the
//! inputs, and what they leave.

mod curve;

use nalgebra::DMatrix;

use crate::critic::simulate::bank::emulator::curve::{Curve, terms};
use crate::critic::simulate::bank::path::NUMBERS;
use crate::critic::simulate::bank::test::Test;
use crate::stats;

/// Scores beyond this are taken to be there: few walls tell of the far ends of their inputs.
const FURTHEST: f64 = 2.5;
/// Half of the way over which a slope is taken (in scores).
const STEP: f64 = 0.2;

/// The walls of a family under one cause, in few numbers.
#[derive(Clone, Debug)]
pub struct Emulator {
    inputs: usize,
    test: Test,
    /// Means of the numbers, from which all else counts.
    middle: [f64; NUMBERS],
    /// Of each group of numbers.
    curves: Vec<Curve>,
    /// Where the walls of the bank lie, in scores that are [`held`].
    scores: Vec<Vec<f64>>,
    /// Where those lie that do not stand at rest.
    fallen: Vec<Vec<f64>>,
    /// What each wall of the bank differs by from a curve that does not know it: the stones' own part, and the emulator's error.
    left: Vec<[f64; NUMBERS]>,
    /// Share of the variance that such curves explain, by number.
    explained: [f64; NUMBERS],
}

/// What an emulator predicts of walls at some scores.
pub struct Emulated<'e> {
    /// The numbers to be expected.
    pub numbers: [f64; NUMBERS],
    /// What the walls of the bank that lie nearest are left with, nearest first: a wall differs from what is expected by one of
    /// them.
    pub left: Vec<&'e [f64; NUMBERS]>,
    /// Share of the variance of that which is the emulator's own error, by number: all walls at these scores have it in common.
    pub common: [f64; NUMBERS],
}

impl Emulator {
    /// Through walls by their scores (standard normal, one per input) and numbers, see [`Path::adding`](super::Path::adding);
    /// `None` for fewer than twice as many walls as a quadratic has terms; where they are sheared, a plane.
    pub fn fit(test: Test, scores: &[Vec<f64>], walls: &[[f64; NUMBERS]]) -> Option<Emulator> {
        let inputs = scores.first()?.len();
        let scores: Vec<Vec<f64>> = scores.iter().map(|z| held(z)).collect();
        let n = scores.len();
        if n < 2 * terms(&scores[0], test.least_degree()).len() {
            return None;
        }
        let mean = |number: usize| stats::mean(&walls.iter().map(|wall| wall[number]).collect::<Vec<_>>());
        let middle: [f64; NUMBERS] = std::array::from_fn(|number| mean(number).unwrap_or(0.0));
        let mut left = vec![[0.0; NUMBERS]; n];
        let fitted = test.groups().iter().map(|group| {
            let more = DMatrix::from_fn(n, group.len(), |row, number| {
                walls[row][group.start + number] - middle[group.start + number]
            });
            let (curve, rest) = Curve::fit(group.clone(), &scores, &more)?;
            for (left, rest) in left.iter_mut().zip(rest.row_iter()) {
                left[group.clone()].iter_mut().zip(rest.iter()).for_each(|(left, rest)| *left = *rest);
            }
            Some(curve)
        });
        let curves = fitted.collect::<Option<Vec<Curve>>>()?;
        let explained = std::array::from_fn(|number| {
            let values: Vec<f64> = walls.iter().map(|wall| wall[number]).collect();
            let squares: Vec<f64> = left.iter().map(|left| left[number] * left[number]).collect();
            let whole = stats::sigma(&values).unwrap_or(0.0);
            let rest = stats::sum(&squares) / n as f64;
            if whole > 0.0 { 1.0 - rest / (whole * whole) } else { 0.0 }
        });
        Some(Emulator { inputs, test, middle, curves, scores, fallen: Vec::new(), left, explained })
    }

    /// With walls (by their scores, as [`Self::fit`] has them) that do not stand at rest.
    pub fn beside(self, fallen: &[Vec<f64>]) -> Emulator {
        Emulator { fallen: fallen.iter().map(|wall| held(wall)).collect(), ..self }
    }

    /// What it predicts of walls at these scores (one per input), with what so many walls of the bank are left with.
    pub fn emulated(&self, scores: &[f64], count: usize) -> Emulated<'_> {
        crate::check!(scores.len() == self.inputs, "{} scores for {} inputs", scores.len(), self.inputs);
        let scores = held(scores);
        let (mut numbers, mut common) = (self.middle, [0.0; NUMBERS]);
        for (curve, group) in self.curves.iter().zip(self.test.groups()) {
            let own = curve.add(&scores, &self.scores, &mut numbers);
            common[group.clone()].fill(own);
        }
        let nearest = stats::smallest(self.distances(&self.scores, &scores).zip(0..), count);
        Emulated { numbers, left: nearest.into_iter().map(|wall| &self.left[wall]).collect(), common }
    }

    /// How the expected numbers change with one of the scores there (per unit of it); beyond what the walls tell of as at the last
    /// place that they do.
    pub fn slope(&self, scores: &[f64], input: usize) -> [f64; NUMBERS] {
        let at = |step: f64| {
            let mut scores = held(scores);
            scores[input] = scores[input].clamp(STEP - FURTHEST, FURTHEST - STEP) + step;
            let mut numbers = [0.0; NUMBERS];
            for curve in &self.curves {
                curve.expect(&scores, &self.scores, &mut numbers);
            }
            numbers
        };
        let (above, below) = (at(STEP), at(-STEP));
        std::array::from_fn(|k| (above[k] - below[k]) / (2.0 * STEP))
    }

    /// Whether walls at some scores stand at rest, as the nearest wall of the bank does.
    pub fn stands(&self, scores: &[f64]) -> bool {
        if self.fallen.is_empty() {
            return true;
        }
        let scores = held(scores);
        let own = self.distances(&self.scores, &scores).fold(f64::INFINITY, f64::min);
        self.distances(&self.fallen, &scores).all(|fallen| fallen >= own)
    }

    /// Squared distances of walls from some scores, as the fall and the way up to it see them.
    fn distances(&self, walls: &[Vec<f64>], scores: &[f64]) -> impl Iterator<Item = f64> {
        walls.iter().map(|wall| self.curves[0].shape.squared_distance(scores, wall))
    }

    /// Share of the variance of each number that is explained for a wall that the curve does not know.
    pub fn explained(&self) -> &[f64; NUMBERS] {
        &self.explained
    }
}

/// Scores within what walls tell of.
fn held(scores: &[f64]) -> Vec<f64> {
    scores.iter().map(|score| score.clamp(-FURTHEST, FURTHEST)).collect()
}
