//! The share of trials in which something is so, with its interval, from counts alone.

use super::randomised::by_randomisations;
use super::{Estimate, clopper_pearson};

/// Fewer trials on one side show no error by how randomisations differ.
const FEW: u64 = 10;

/// How often something was so: in independent trials, or at the points of randomisations of a design.
#[derive(Clone, Debug, PartialEq)]
pub struct Trials {
    /// By randomisation: how often it was so, and in how many trials.
    counts: Vec<[u64; 2]>,
}

impl Trials {
    /// No trial yet, of members that share so many randomisations in turn; 1 where each is drawn by itself.
    pub fn none(randomisations: u64) -> Trials {
        Trials { counts: vec![[0, 0]; randomisations.max(1) as usize] }
    }

    /// Counts the trial of a member.
    pub fn take(&mut self, member: u64, is_so: bool) {
        let own = (member % self.counts.len() as u64) as usize;
        self.counts[own][0] += u64::from(is_so);
        self.counts[own][1] += 1;
    }

    /// The share with its 95 % interval: of independent trials that of Clopper and Pearson, else that over the randomisations. Where fewer than
    /// ten trials were on one side, few randomisations differ, and their spread shows no error. Then the interval reaches to
    /// that of Clopper and Pearson as well, as if the trials were independent: points of a design lie more evenly, so that none of
    /// them hits what independent ones would have. Not defined without a trial.
    ///
    /// ```
    /// use pirca::stats::{Trials, clopper_pearson};
    /// let mut rocking = Trials::none(1);
    /// (0..20).for_each(|wall| rocking.take(wall, wall < 7));
    /// assert_eq!(rocking.share().value, Some(0.35));
    /// assert_eq!(rocking.share().interval, Some(clopper_pearson(7, 20)));
    /// ```
    pub fn share(&self) -> Estimate {
        let share = |counts: &[[u64; 2]]| {
            let [so, of] = counts.iter().fold([0, 0], |[so, of], own| [so + own[0], of + own[1]]);
            (of > 0).then(|| so as f64 / of as f64)
        };
        if let [[so, of]] = self.counts[..] {
            let interval = (of > 0).then(|| clopper_pearson(so as usize, of as usize));
            return Estimate { value: share(&self.counts), interval };
        }
        let held = |own: &[u64; 2]| if own[1] > 0 { vec![*own] } else { Vec::new() };
        let Estimate { value, interval } =
            by_randomisations(&self.counts.iter().map(held).collect::<Vec<_>>(), share);
        let [so, of] = self.counts.iter().fold([0, 0], |[so, of], own| [so + own[0], of + own[1]]);
        let interval = interval.map(|ends| ends.map(|end| end.clamp(0.0, 1.0))).map(|[low, high]| {
            if so.min(of - so) >= FEW {
                return [low, high];
            }
            let [alone_low, alone_high] = clopper_pearson(so as usize, of as usize);
            [low.min(alone_low), high.max(alone_high)]
        });
        Estimate { value, interval }
    }
}
