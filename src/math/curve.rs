//! A smooth curve through points that rises where they rise and falls where they fall.

use crate::math::monotone_slopes;

/// Piecewise cubic through given points, monotone between neighbours and once continuously differentiable (Fritsch and
/// Carlson 1980, with the slopes of Fritsch and Butland 1984). Constant beyond the first and the last point.
///
/// The points are held as they are given, in a `Vec` or in an array: of the latter many may be made without a heap.
#[derive(Clone, Debug, PartialEq)]
pub struct Monotone<S = Vec<f64>> {
    x: S,
    y: S,
    slopes: S,
}

impl<S: AsRef<[f64]> + AsMut<[f64]> + Clone> Monotone<S> {
    /// Through these points, at least one, `x` strictly ascending.
    pub fn through(x: S, y: S) -> Monotone<S> {
        let mut slopes = y.clone();
        {
            let (x, y) = (x.as_ref(), y.as_ref());
            crate::check!(!x.is_empty() && x.len() == y.len(), "{} places for {} values", x.len(), y.len());
            crate::check!(x.windows(2).all(|pair| pair[0] < pair[1]), "the places are not ascending: {x:?}");
            monotone_slopes(x, y, slopes.as_mut());
        }
        Monotone { x, y, slopes }
    }

    /// Value at a place.
    pub fn at(&self, place: f64) -> f64 {
        self.by(&Share::of(self.x.as_ref(), place))
    }

    /// Value at a place by what its points have of it.
    pub fn by(&self, share: &Share) -> f64 {
        let (y, slopes) = (self.y.as_ref(), self.slopes.as_ref());
        match *share {
            Share::One(i) => y[i],
            Share::Two { first: i, width, values, slopes: [slope, next] } => {
                let [value, next_value] = values;
                value * y[i] + next_value * y[i + 1] + width * (slope * slopes[i] + next * slopes[i + 1])
            }
        }
    }
}

/// What points have of a place: the same for all curves through points at the same `x`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Share {
    /// One has all of it.
    One(usize),
    /// It lies between two.
    Two {
        /// The lower one.
        first: usize,
        /// How far they are apart.
        width: f64,
        /// What counts of the value at either.
        values: [f64; 2],
        /// What counts of the slope at either, over the width.
        slopes: [f64; 2],
    },
}

impl Share {
    /// Of points at `x`, at least one, strictly ascending.
    pub fn of(x: &[f64], place: f64) -> Share {
        let last = x.len() - 1;
        if place <= x[0] {
            return Share::One(0);
        }
        if place >= x[last] {
            return Share::One(last);
        }
        let first = x.partition_point(|&known| known <= place) - 1;
        let width = x[first + 1] - x[first];
        let t = (place - x[first]) / width;
        // Hermite's cubics.
        let (s, tt) = (1.0 - t, t * t);
        let values = [(1.0 + 2.0 * t) * s * s, tt * (3.0 - 2.0 * t)];
        Share::Two { first, width, values, slopes: [t * s * s, -tt * s] }
    }
}
