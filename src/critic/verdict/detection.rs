//! Is anything wrong at all? Three ways of looking, each against campaigns without any effect: the largest excess, which sees what
//! is far off in one respect; the distance of all features together, which sees what is a little off in many; and the odds of the
//! ranking, which see what looks like one of the causes, or like what is nameless. The p-value is that of the most surprised of the
//! three, its choice accounted for (the smallest of several p-values, judged by simulation as in Westfall and Young 1993).

use crate::critic::causes::Ranked;
use crate::critic::discrepancy::Discrepancy;

/// What campaigns without any effect show.
#[derive(Clone, Debug)]
pub struct Alarm {
    /// Each way of looking, ascending.
    looks: [Vec<f64>; 3],
    /// The smallest share of the three by campaign, ascending.
    smallest: Vec<f64>,
}

fn looks(discrepancy: &Discrepancy, ranked: &Ranked) -> [f64; 3] {
    [discrepancy.largest(), discrepancy.distance, ranked.odds()]
}

/// Share of the values that are at least as large, the one asked about among them.
fn share(ascending: &[f64], value: f64) -> f64 {
    let as_large = ascending.len() - ascending.partition_point(|x| *x < value);
    (as_large + 1) as f64 / (ascending.len() + 1) as f64
}

fn smallest(shares: [f64; 3]) -> f64 {
    shares.into_iter().fold(1.0, f64::min)
}

impl Alarm {
    /// From campaigns of the base model, at least one.
    pub fn of(campaigns: &[(Discrepancy, Ranked)]) -> Alarm {
        let shown: Vec<[f64; 3]> =
            campaigns.iter().map(|(discrepancy, ranked)| looks(discrepancy, ranked)).collect();
        let sorted = |k: usize| {
            let mut values: Vec<f64> = shown.iter().map(|looks| looks[k]).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let mut alarm = Alarm { looks: [sorted(0), sorted(1), sorted(2)], smallest: Vec::new() };
        let mut least: Vec<f64> = shown.iter().map(|looks| smallest(alarm.shares(looks))).collect();
        least.sort_by(f64::total_cmp);
        alarm.smallest = least;
        alarm
    }

    fn shares(&self, looks: &[f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| share(&self.looks[k], looks[k]))
    }

    /// Share of campaigns without any effect that surprise as much in any way, and in each way alone: with `n` campaigns at least
    /// 1/(n + 1).
    pub fn p_values(&self, discrepancy: &Discrepancy, ranked: &Ranked) -> (f64, [f64; 3]) {
        let shares = self.shares(&looks(discrepancy, ranked));
        let as_small = self.smallest.partition_point(|x| *x <= smallest(shares));
        ((as_small + 1) as f64 / (self.smallest.len() + 1) as f64, shares)
    }
}
