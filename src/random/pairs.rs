//! Two quantities of one thing that are drawn together: rows of a survey.

use crate::random::{Family, Stream};

/// Rows of two values each, one row as likely as any other. What is drawn is a row, so that its two values stay together.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(transparent)]
pub struct Pairs {
    /// In ascending order of the first value, then of the second.
    rows: Vec<[f64; 2]>,
}

impl Pairs {
    /// Of rows in any order; `None` where there is none, or where a value is not finite.
    ///
    /// ```
    /// use pirca::random::Pairs;
    /// let stones = Pairs::of(vec![[0.4, 0.2], [0.3, 0.1]]).unwrap();
    /// assert_eq!(stones.quantile(0.9), [0.4, 0.2]);
    /// assert_eq!(Pairs::of(vec![[f64::NAN, 0.1]]), None);
    /// ```
    pub fn of(mut rows: Vec<[f64; 2]>) -> Option<Pairs> {
        if rows.is_empty() || rows.iter().flatten().any(|value| !value.is_finite()) {
            return None;
        }
        rows.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        Some(Pairs { rows })
    }

    /// The rows, ascending.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// The row at `u` in the open interval (0, 1). Its first value is the quantile of the first values alone, so that who draws
    /// these apart gets the same from the same stream.
    pub fn quantile(&self, u: f64) -> [f64; 2] {
        crate::check!(u > 0.0 && u < 1.0, "a quantile was asked at {u}, outside (0, 1)");
        let n = self.rows.len();
        self.rows[((u * n as f64).ceil() as usize).clamp(1, n) - 1]
    }

    /// One row, by exactly one uniform of the stream.
    pub fn sample(&self, stream: &mut Stream) -> [f64; 2] {
        self.quantile(stream.uniform())
    }

    /// The two quantities, each by itself.
    pub fn marginals(&self) -> [Family; 2] {
        [0, 1].map(|which| {
            let mut values: Vec<f64> = self.rows.iter().map(|row| row[which]).collect();
            values.sort_by(f64::total_cmp);
            Family::Empirical { values }
        })
    }

    /// The same with deviations from the means that are `factor` times as large; `factor` is above 0.
    pub fn widened(self, factor: f64) -> Pairs {
        let means = self.marginals().map(|own| own.mean());
        let out = |row: [f64; 2]| [0, 1].map(|which| means[which] + factor * (row[which] - means[which]));
        Pairs { rows: self.rows.into_iter().map(out).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Streams;

    /// Length and height, of which the second says the row.
    fn stones() -> Pairs {
        Pairs::of(vec![[0.3, 0.11], [0.2, 0.14], [0.5, 0.12], [0.3, 0.1]]).expect("finite rows")
    }

    #[test]
    fn every_row_is_as_likely_and_comes_whole() {
        let mut stream = Streams::new(3, 0).of("stones");
        let mut seen = [0_u32; 4];
        for _ in 0..40_000 {
            let row = stones().sample(&mut stream);
            seen[stones().rows().iter().position(|own| *own == row).expect("a row of the survey")] += 1;
        }
        // Five standard deviations of a binomial count: sqrt(40,000 x 1/4 x 3/4) = 87.
        assert!(seen.iter().all(|n| n.abs_diff(10_000) < 433), "{seen:?}");
    }

    #[test]
    fn lengths_are_those_that_are_drawn_apart_from_the_same_stream() {
        let [lengths, heights] = stones().marginals();
        assert_eq!((lengths.mean(), heights.support()), (0.325, (0.1, 0.14)));
        let [mut together, mut apart] = [0; 2].map(|_| Streams::new(3, 1).of("stone length"));
        for _ in 0..100 {
            assert_eq!(stones().sample(&mut together)[0], lengths.sample(&mut apart));
        }
    }

    #[test]
    fn widened_rows_keep_their_means_and_stay_together() {
        let wide = stones().widened(2.0);
        assert!((wide.rows()[0][0] - 0.075).abs() < 1e-15 && (wide.rows()[0][1] - 0.1625).abs() < 1e-15);
        let [before, after] = [stones(), wide].map(|own| own.marginals().map(|one| one.mean()));
        assert!(before.iter().zip(after).all(|(a, b)| (a - b).abs() < 1e-15));
    }
}
