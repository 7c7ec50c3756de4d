//! Intervals of statistics of trials that share records and walls.

use crate::random::Stream;
use crate::stats::Estimate;
use crate::stats::reference::student;

/// Records and walls that cross: each record meets each wall. Walls may come in several groups, as those of two arrangements, which are
/// sampled apart.
#[derive(Clone, Debug)]
pub(super) struct Crossed {
    records: usize,
    groups: Vec<usize>,
}

/// Variance of a statistic by clusters of one kind, with its degrees of freedom.
#[derive(Clone, Copy, Debug)]
struct Part {
    variance: f64,
    freedom: f64,
}

/// What a statistic is without each cluster of a kind in turn.
type LeftOut<const N: usize> = Vec<[f64; N]>;

impl Crossed {
    pub fn new(records: usize, groups: &[usize]) -> Crossed {
        Crossed { records, groups: groups.to_vec() }
    }

    /// Number of pairs of record and wall.
    pub fn pairs(&self) -> usize {
        self.records * self.walls()
    }

    fn walls(&self) -> usize {
        self.groups.iter().sum()
    }

    /// Statistics with their 95 % intervals: Student's t about the value less its jackknife bias.
    ///
    /// `statistic` gets a weight for each pair, by record, then wall. Leaving out each record in turn gives the variance V_R, each wall
    /// V_W, and each pair, less what its record and its wall explain, V_I. As V_R and V_W both hold V_I, the variance is
    /// V_R + V_W - V_I, that of a mean in a two-way layout of random effects, and never below the larger of V_R and V_W. Degrees of
    /// freedom are Satterthwaite's. A group of one wall adds nothing: the interval is then about that wall. No interval from a single
    /// record, nor where a statistic is not defined without one record, wall or pair.
    pub fn estimates<const N: usize>(&self, statistic: impl Fn(&[f64]) -> Option<[f64; N]>) -> [Estimate; N] {
        let Some(values) = statistic(&vec![1.0; self.pairs()]) else { return [Estimate::UNDEFINED; N] };
        let intervals = self.intervals(&statistic, values);
        std::array::from_fn(|own| Estimate {
            value: Some(values[own]),
            interval: intervals.map(|intervals| intervals[own]),
        })
    }

    fn intervals<const N: usize>(
        &self,
        statistic: &impl Fn(&[f64]) -> Option<[f64; N]>,
        values: [f64; N],
    ) -> Option<[[f64; 2]; N]> {
        if self.records < 2 {
            return None;
        }
        let walls = self.walls();
        let by_record = self.without(self.records, statistic, |record, pair| pair / walls == record)?;
        let mut by_group: Vec<[LeftOut<N>; 2]> = Vec::new();
        let mut first = 0;
        for &size in &self.groups {
            if size > 1 {
                let by_wall = self.without(size, statistic, |own, pair| pair % walls == first + own)?;
                let by_pair = self.without(self.records * size, statistic, |own, pair| {
                    pair == own / size * walls + first + own % size
                })?;
                by_group.push([by_wall, by_pair]);
            }
            first += size;
        }
        Some(std::array::from_fn(|own| {
            let column = |rows: &LeftOut<N>| rows.iter().map(|row| row[own]).collect::<Vec<f64>>();
            let value = values[own];
            let (mut bias, record) = jackknife(&column(&by_record), value);
            let (mut of_walls, mut of_pairs) = (Vec::new(), Vec::new());
            for [by_wall, by_pair] in &by_group {
                let (own_bias, wall) = jackknife(&column(by_wall), value);
                bias += own_bias;
                of_walls.push(wall);
                of_pairs.push(interaction(&column(by_pair), value, by_wall.len()));
            }
            let half = half_width(record, &of_walls, &of_pairs);
            [value - bias - half, value - bias + half]
        }))
    }

    /// The statistics without each cluster in turn; `belongs` says whether a pair belongs to one.
    fn without<const N: usize>(
        &self,
        clusters: usize,
        statistic: &impl Fn(&[f64]) -> Option<[f64; N]>,
        belongs: impl Fn(usize, usize) -> bool,
    ) -> Option<LeftOut<N>> {
        let weights = |cluster: usize| -> Vec<f64> {
            (0..self.pairs()).map(|pair| f64::from(u8::from(!belongs(cluster, pair)))).collect()
        };
        (0..clusters).map(|cluster| statistic(&weights(cluster))).collect()
    }

    /// Weights of a resample: records and, apart from them, the walls of each group are drawn with replacement, and a pair counts as often
    /// as its record times as often as its wall (the pigeonhole bootstrap, Owen 2007).
    pub fn resampled(&self, stream: &mut Stream) -> Vec<f64> {
        let mut times = |n: usize| {
            let mut times = vec![0.0; n];
            for _ in 0..n {
                times[stream.below(n)] += 1.0;
            }
            times
        };
        let records = times(self.records);
        let walls: Vec<f64> = self.groups.iter().flat_map(|size| times(*size)).collect();
        records.iter().flat_map(|record| walls.iter().map(move |wall| record * wall)).collect()
    }
}

/// Bias and variance of a value by what it is without each cluster in turn (Tukey 1958).
fn jackknife(without: &[f64], value: f64) -> (f64, Part) {
    let n = without.len() as f64;
    let mean = without.iter().sum::<f64>() / n;
    let squares: f64 = without.iter().map(|own| (own - mean) * (own - mean)).sum();
    ((n - 1.0) * (mean - value), Part { variance: squares * (n - 1.0) / n, freedom: n - 1.0 })
}

/// Variance of a value by what is particular to pairs: their influences less the means of record and wall.
fn interaction(without: &[f64], value: f64, walls: usize) -> Part {
    let all = without.len();
    let records = all / walls;
    let influence: Vec<f64> = without.iter().map(|own| (all - 1) as f64 * (value - own)).collect();
    let mean = influence.iter().sum::<f64>() / all as f64;
    let rows: Vec<f64> = influence.chunks(walls).map(|row| row.iter().sum::<f64>() / walls as f64).collect();
    let columns: Vec<f64> = (0..walls)
        .map(|wall| influence.iter().skip(wall).step_by(walls).sum::<f64>() / records as f64)
        .collect();
    let rest = |pair: usize| influence[pair] - rows[pair / walls] - columns[pair % walls] + mean;
    let squares: f64 = (0..all).map(|pair| rest(pair) * rest(pair)).sum();
    let freedom = ((records - 1) * (walls - 1)) as f64;
    Part { variance: squares / freedom / all as f64, freedom }
}

/// Student's t times the standard error, with the degrees of freedom of a sum of variances (Satterthwaite 1946).
fn half_width(record: Part, walls: &[Part], pairs: &[Part]) -> f64 {
    let sum = |parts: &[Part]| parts.iter().map(|part| part.variance).sum::<f64>();
    let spent =
        |parts: &[Part]| parts.iter().map(|part| part.variance * part.variance / part.freedom).sum::<f64>();
    let all = (record.variance + sum(walls) - sum(pairs), spent(&[record]) + spent(walls) + spent(pairs));
    let alone = [(record.variance, spent(&[record])), (sum(walls), spent(walls))];
    let larger = |a: (f64, f64), b: (f64, f64)| if b.0 > a.0 { b } else { a };
    let (variance, spent) = alone.into_iter().fold(all, larger);
    if variance > 0.0 { student(variance * variance / spent) * variance.sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean squares of rows, columns and the rest of a table, by the textbook.
    #[test]
    fn the_interval_of_a_mean_is_that_of_a_two_way_layout() {
        let table = [[3.0, 5.0, 4.0], [7.0, 8.0, 9.5], [1.0, 2.0, 4.0], [6.0, 4.0, 7.0]];
        let flat = table.as_flattened();
        let mean = |weights: &[f64]| {
            let all: f64 = weights.iter().sum();
            Some([weights.iter().zip(flat).map(|(w, y)| w * y).sum::<f64>() / all])
        };
        let [found] = Crossed::new(4, &[3]).estimates(mean);
        // Rows 4, 24.5/3, 7/3, 17/3; columns 4.25, 4.75, 6.125; all 60.5/12.
        let all = 60.5 / 12.0;
        let rows = [4.0, 24.5 / 3.0, 7.0 / 3.0, 17.0 / 3.0];
        let columns = [4.25, 4.75, 6.125];
        let square = |x: f64| x * x;
        let of_rows: f64 = rows.iter().map(|row| 3.0 * square(row - all)).sum::<f64>() / 3.0;
        let of_columns: f64 = columns.iter().map(|column| 4.0 * square(column - all)).sum::<f64>() / 2.0;
        let mut of_rest = 0.0;
        for (row, own) in rows.iter().zip(&table) {
            for (column, y) in columns.iter().zip(own) {
                of_rest += square(y - row - column + all) / 6.0;
            }
        }
        let variance = (of_rows + of_columns - of_rest) / 12.0;
        let freedom = square(12.0 * variance)
            / (square(of_rows) / 3.0 + square(of_columns) / 2.0 + square(of_rest) / 6.0);
        let half = student(freedom) * variance.sqrt();
        let [low, high] = found.interval.unwrap();
        // A dozen roundings, in differences of numbers of the same size times the number of pairs.
        assert!((found.value.unwrap() - all).abs() < 1e-14);
        assert!(
            (low - (all - half)).abs() < 1e-10 && (high - (all + half)).abs() < 1e-10,
            "{found:?} {half}"
        );
    }

    #[test]
    fn one_record_shows_no_scatter_and_one_wall_is_all_there_is() {
        let share = |weights: &[f64]| {
            let all: f64 = weights.iter().sum();
            (all > 0.0).then(|| [weights.iter().enumerate().map(|(k, w)| k as f64 * w).sum::<f64>() / all])
        };
        let all = |weights: &[f64]| Some([weights.iter().sum()]);
        assert_eq!(Crossed::new(1, &[3]).estimates(all)[0], Estimate { value: Some(3.0), interval: None });
        // Values 0, 1, 2 of three records: mean 1, standard error 1 / sqrt 3, two degrees of freedom.
        let [low, high] = Crossed::new(3, &[1]).estimates(share)[0].interval.unwrap();
        let half = student(2.0) / 3.0_f64.sqrt();
        assert!((low - 1.0 + half).abs() < 1e-12 && (high - 1.0 - half).abs() < 1e-12);
    }
}
