//! Comparison of two samples whose members are paired: the same record shook both.
//!
//! Under the same records two samples are alike even where the models differ somewhat. The critical value for independent samples is then
//! too large: the test hardly ever rejects. Right is the law of the distance when within each pair the two are exchanged at random.

use pirca::random::{Streams, standard_normal};

/// Random exchanges.
const EXCHANGES: usize = 2000;

/// Kolmogorov's and Smirnov's distance of two samples of `n` pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// Largest difference of the two empirical CDFs.
    pub found: f64,
    /// Its 95 % point where pairs are exchanged at random: the critical value.
    pub critical: f64,
    /// Share of the exchanges, the sample itself among them, with at least this distance.
    pub p_value: f64,
    /// The 95 % point for two independent samples, `1.358 sqrt(2/n)` (Smirnov 1948).
    pub independent: f64,
}

impl Distance {
    /// Of pairs.
    pub fn of(pairs: &[[f64; 2]]) -> Distance {
        let n = pairs.len();
        let mut ordered: Vec<(f64, usize, bool)> =
            pairs.iter().enumerate().flat_map(|(k, [a, b])| [(*a, k, false), (*b, k, true)]).collect();
        ordered.sort_by(|a, b| a.0.total_cmp(&b.0));
        let distance = |exchanged: &[bool]| {
            let (mut ahead, mut largest) = (0i64, 0);
            for (place, (value, pair, second)) in ordered.iter().enumerate() {
                ahead += if *second != exchanged[*pair] { -1 } else { 1 };
                // Between equal values no CDF is read.
                if ordered.get(place + 1).is_none_or(|next| next.0 > *value) {
                    largest = largest.max(ahead.abs());
                }
            }
            largest
        };
        let found = distance(&vec![false; n]);
        let mut stream = Streams::new(1, 0).of("exchanges");
        let mut all: Vec<i64> = (0..EXCHANGES)
            .map(|_| distance(&(0..n).map(|_| stream.uniform() < 0.5).collect::<Vec<bool>>()))
            .collect();
        all.sort_unstable();
        let reached = 1 + all.iter().filter(|other| **other >= found).count();
        Distance {
            found: found as f64 / n as f64,
            critical: all[EXCHANGES * 95 / 100] as f64 / n as f64,
            p_value: reached as f64 / (EXCHANGES + 1) as f64,
            independent: 1.358 * (2.0 / n as f64).sqrt(),
        }
    }

    /// Whether the two laws are told apart at 5 %.
    pub fn rejects(&self) -> bool {
        self.p_value <= 0.05
    }
}

/// Shares of hits in a sample of pairs: `[both, first only, second only, none]`.
pub fn counted(pairs: &[[bool; 2]]) -> [usize; 4] {
    let of = |wanted: [bool; 2]| pairs.iter().filter(|pair| **pair == wanted).count();
    [of([true, true]), of([true, false]), of([false, true]), of([false, false])]
}

/// Share of the first less that of the second, and its 95 % interval (Newcombe 1998, Statistics in Medicine 17, 2635, method 10: Wilson's
/// intervals put together with the correlation of the pairs).
pub fn difference([both, first, second, none]: [usize; 4]) -> (f64, [f64; 2]) {
    let [both, first, second, none] = [both, first, second, none].map(|k| k as f64);
    let n = both + first + second + none;
    let shares = [(both + first) / n, (both + second) / n];
    let [own, other] = shares.map(|share| wilson(share, n));
    let margins = (both + first) * (second + none) * (both + second) * (first + none);
    let cross = both * none - first * second;
    // Half a pair for continuity, of a positive correlation only.
    let cross = if cross > 0.0 { (cross - 0.5 * n).max(0.0) } else { cross };
    let correlation = if margins > 0.0 { cross / margins.sqrt() } else { 0.0 };
    let together = |a: f64, b: f64| (a * a - 2.0 * correlation * a * b + b * b).max(0.0).sqrt();
    let found = shares[0] - shares[1];
    let below = together(shares[0] - own[0], other[1] - shares[1]);
    let above = together(own[1] - shares[0], shares[1] - other[0]);
    (found, [found - below, found + above])
}

/// Wilson's 95 % interval (1927) of a share of `n`.
fn wilson(share: f64, n: f64) -> [f64; 2] {
    let z = standard_normal::quantile(0.975);
    let middle = share + z * z / (2.0 * n);
    let half = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    [middle - half, middle + half].map(|end| end / (1.0 + z * z / n))
}
