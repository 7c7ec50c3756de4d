//! The density of what is read on a wall, from the paths that it may have.

use std::f64::consts::PI;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::math::{ln, ln_gamma};

/// Share of the walls' variance that counts as a reading's own: few paths do not span all that walls may do.
const LEAST: f64 = 0.02;

/// What the paths that a wall may have show, by column.
pub(super) struct Paths {
    /// By path.
    shown: Vec<Vec<f64>>,
    pub(super) mean: Vec<f64>,
    pub(super) variance: Vec<f64>,
    /// What a standard deviation of a specimen's own stiffness adds, by column.
    pub(super) by_stiffness: Vec<f64>,
}

impl Paths {
    pub(super) fn of(shown: Vec<Vec<f64>>, by_stiffness: Vec<f64>) -> Paths {
        let columns = shown[0].len();
        // Path by path, as they lie in memory.
        let mut mean = vec![0.0; columns];
        for path in &shown {
            mean.iter_mut().zip(path).for_each(|(sum, x)| *sum += x);
        }
        mean.iter_mut().for_each(|sum| *sum /= shown.len() as f64);
        let mut variance = vec![0.0; columns];
        for path in &shown {
            let off = path.iter().zip(&mean).map(|(x, mean)| x - mean);
            variance.iter_mut().zip(off).for_each(|(sum, off)| *sum += off * off);
        }
        let freedom = (shown.len() - 1) as f64;
        variance.iter_mut().for_each(|sum| *sum /= freedom);
        Paths { shown, mean, variance, by_stiffness }
    }

    /// Share of the variance of some columns that they have in common: that of the mean of a path's columns, less what independent ones
    /// would have (each column in its standard deviation).
    pub(super) fn shared(&self, columns: impl Iterator<Item = usize>) -> f64 {
        let columns: Vec<usize> = columns.filter(|column| self.variance[*column] > 0.0).collect();
        if columns.len() < 2 {
            return 0.0;
        }
        let n = columns.len() as f64;
        let mean = |path: &Vec<f64>| {
            let off = |column: &usize| (path[*column] - self.mean[*column]) / self.variance[*column].sqrt();
            columns.iter().fold(0.0, |sum, column| sum + off(column)) / n
        };
        let square = |path: &Vec<f64>| mean(path) * mean(path);
        let variance = self.shown.iter().map(square).sum::<f64>() / (self.shown.len() - 1) as f64;
        ((variance - 1.0 / n) / (1.0 - 1.0 / n)).clamp(0.0, 1.0)
    }
}

/// The density of readings with a value: Student's t, as the covariance is that of few paths and not known exactly.
pub(super) struct Density {
    /// Degrees of freedom of the covariance.
    freedom: f64,
    /// Each reading's own standard deviation, of which none is free.
    sd: Vec<f64>,
    /// What the paths are off their mean in units of it, by reading and path, then what each specimen's stiffness adds, such that the
    /// readings' covariance is 1 + spread spread'.
    spread: DMatrix<f64>,
    /// Woodbury: only the paths' side of that, 1 + spread' spread, is factored.
    inner: Cholesky<f64, Dyn>,
    /// Logarithm of the density where nothing is off: models that share a path among walls, and models that do not, are compared.
    top: f64,
    half_log_determinant: f64,
}

impl Density {
    /// Of readings by their columns and the variances of their own errors, specimen by specimen (the first of the next); `None` where the
    /// paths are no numbers.
    pub(super) fn of(read: &[(usize, f64)], ends: &[usize], paths: &Paths) -> Option<Density> {
        let (readings, count) = (read.len(), paths.shown.len() + ends.len());
        let freedom = (paths.shown.len() - 1) as f64;
        let sd = read.iter().map(|(column, variance)| {
            (variance + LEAST * paths.variance[*column]).sqrt().max(f64::MIN_POSITIVE)
        });
        let sd: Vec<f64> = sd.collect();
        let unit: Vec<f64> = sd.iter().map(|sd| 1.0 / (sd * freedom.sqrt())).collect();
        let specimen = |k: usize| ends.partition_point(|end| *end <= k);
        let spread = DMatrix::from_fn(readings, count, |k, path| {
            let column = read[k].0;
            match paths.shown.get(path) {
                Some(shown) => (paths.mean[column] - shown[column]) * unit[k],
                None if paths.shown.len() + specimen(k) == path => paths.by_stiffness[column] / sd[k],
                None => 0.0,
            }
        });
        // The lower triangle is all that is asked for.
        let mut inner = DMatrix::identity(count, count);
        for column in 0..count {
            for row in column..count {
                inner[(row, column)] += spread.column(row).dot(&spread.column(column));
            }
        }
        let inner = inner.cholesky()?;
        let own = sd.iter().fold(0.0, |sum, sd| sum + ln(*sd));
        let lower = inner.l_dirty();
        let half_log_determinant = (0..count).fold(own, |sum, k| sum + ln(lower[(k, k)]));
        let n = readings as f64;
        let top = ln_gamma(0.5 * (freedom + n)) - ln_gamma(0.5 * freedom) - 0.5 * n * ln(PI * freedom);
        let top = top - half_log_determinant;
        Some(Density { freedom, sd, spread, inner, top, half_log_determinant })
    }

    /// Its logarithm where readings are so far off the paths' mean.
    pub(super) fn log(&self, off: &[f64]) -> f64 {
        let power = 0.5 * (self.freedom + off.len() as f64);
        self.top - power * ln(1.0 + self.square(off) / self.freedom)
    }

    /// The logarithm of the normal density with the same mean and covariance there.
    pub(super) fn normal_log(&self, off: &[f64]) -> f64 {
        -0.5 * (self.square(off) + off.len() as f64 * ln(2.0 * PI)) - self.half_log_determinant
    }

    /// Covariance of two of the readings.
    pub(super) fn covariance(&self, one: usize, other: usize) -> f64 {
        let alone = if one == other { 1.0 } else { 0.0 };
        self.sd[one] * self.sd[other] * (alone + self.spread.row(one).dot(&self.spread.row(other)))
    }

    /// Squared distance from the mean, as the covariance has it.
    fn square(&self, off: &[f64]) -> f64 {
        let off = DVector::from_iterator(off.len(), off.iter().zip(&self.sd).map(|(off, sd)| off / sd));
        let along = self.spread.tr_mul(&off);
        off.dot(&off) - along.dot(&self.inner.solve(&along))
    }
}
