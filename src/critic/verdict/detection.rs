//! Is there a discrepancy at all? A test by three statistics, each against campaigns without any effect.
//!
//! The largest excess sees what is far off in one respect. The distance of all features together sees what is a little off in many.
//! The odds of the ranking see what looks like one of the causes, or like an unmodelled effect. The p-value is the smallest of the
//! three, its choice accounted for by simulation (Westfall and Young 1993).

use crate::critic::causes::Ranked;
use crate::critic::discrepancy::Discrepancy;

/// The test: what campaigns without any effect show.
#[derive(Clone, Debug)]
pub struct Detection {
    /// Each statistic, ascending.
    statistics: [Vec<f64>; 3],
    /// The smallest share of the three by campaign, ascending.
    smallest: Vec<f64>,
}

fn statistics(discrepancy: &Discrepancy, ranked: &Ranked) -> [f64; 3] {
    [discrepancy.largest(), discrepancy.distance, ranked.odds()]
}

/// Share of the values that are at least as large, the one in question among them.
fn share(ascending: &[f64], value: f64) -> f64 {
    let as_large = ascending.len() - ascending.partition_point(|x| *x < value);
    (as_large + 1) as f64 / (ascending.len() + 1) as f64
}

fn smallest(shares: [f64; 3]) -> f64 {
    shares.into_iter().fold(1.0, f64::min)
}

impl Detection {
    /// From campaigns of the base model, at least one.
    pub fn of(campaigns: &[(Discrepancy, Ranked)]) -> Detection {
        let shown: Vec<[f64; 3]> =
            campaigns.iter().map(|(discrepancy, ranked)| statistics(discrepancy, ranked)).collect();
        let sorted = |k: usize| {
            let mut values: Vec<f64> = shown.iter().map(|statistics| statistics[k]).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let mut detection = Detection { statistics: [sorted(0), sorted(1), sorted(2)], smallest: Vec::new() };
        let mut least: Vec<f64> =
            shown.iter().map(|statistics| smallest(detection.shares(statistics))).collect();
        least.sort_by(f64::total_cmp);
        detection.smallest = least;
        detection
    }

    fn shares(&self, statistics: &[f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| share(&self.statistics[k], statistics[k]))
    }

    /// The p-value of all three statistics together, and of each alone: with `n` campaigns at least 1/(n + 1).
    pub fn p_values(&self, discrepancy: &Discrepancy, ranked: &Ranked) -> (f64, [f64; 3]) {
        let shares = self.shares(&statistics(discrepancy, ranked));
        let as_small = self.smallest.partition_point(|x| *x <= smallest(shares));
        ((as_small + 1) as f64 / (self.smallest.len() + 1) as f64, shares)
    }
}
