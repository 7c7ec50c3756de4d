//! Which of two is stronger: for the next pair, and on average. Pairs share what they can, so that what differs is what is compared.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::always_valid::always_valid_share;
use super::moments::{check_values, mean, sigma};

/// How probable it is that the first of the next pair is the stronger one.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct NextPair {
    /// Pairs in which the first, the second, and neither was stronger, or one of the two brought no value.
    pub pairs: [u64; 4],
    /// The probability: the share of pairs that the first won, a tie counting half; none without a pair.
    pub probability: Option<f64>,
    /// An interval that holds it at every number of pairs at once, whoever would have won the pairs that are tied or lost; none below
    /// ten pairs.
    pub interval: Option<[f64; 2]>,
}

/// The next pair, after pairs in their order; larger values are stronger. Values no further apart than `tie` are a tie. The interval misses
/// with a probability of at most `miss`, by [`always_valid_share`].
pub fn next_pair(pairs: &[(Option<f64>, Option<f64>)], tie: f64, miss: f64) -> NextPair {
    let mut counts = [0; 4];
    // Whether the first won for sure, and whether it may have.
    let mut won = [Vec::with_capacity(pairs.len()), Vec::with_capacity(pairs.len())];
    for (a, b) in pairs {
        let place = match a.zip(*b).map(|(a, b)| a - b) {
            Some(difference) if difference > tie => 0,
            Some(difference) if difference < -tie => 1,
            Some(_) => 2,
            None => 3,
        };
        counts[place] += 1;
        won[0].push(place == 0);
        won[1].push(place != 1);
    }
    let told = (counts[0] + counts[1] + counts[2]) as f64;
    let ends = won.map(|won| always_valid_share(&won, miss));
    NextPair {
        pairs: counts,
        probability: (told > 0.0).then(|| (counts[0] as f64 + 0.5 * counts[2] as f64) / told),
        interval: ends[0].zip(ends[1]).map(|(sure, perhaps)| [sure[0], perhaps[1]]),
    }
}

/// How probable it is that the mean of such values lies above `level`, after these and nothing else: Student's t about their mean (the
/// posterior under Jeffreys' prior of normal values). `None` below two values. Values that are all equal leave no doubt; of a mean that
/// is the level itself it is a half.
pub fn probability_above(values: &[f64], level: f64) -> Option<f64> {
    check_values(values);
    let (centre, spread) = mean(values).zip(sigma(values))?;
    if spread == 0.0 {
        return Some(if centre > level { 1.0 } else { f64::from(u8::from(centre == level)) * 0.5 });
    }
    let n = values.len() as f64;
    let t = StudentsT::new(0.0, 1.0, n - 1.0).ok()?;
    Some(t.cdf((centre - level) / spread * n.sqrt()))
}
