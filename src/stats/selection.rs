//! Which of several kinds is the best, with how few values: the kinds that are near to the best one get the values, the others no more.
//!
//! A look compares the best kind so far with each other one, pair by pair: members of the same number share what they can. Another kind is
//! *settled* once the interval of its difference shows it to be worse, or the same within a zone of indifference. The intervals of all
//! pairs hold at all numbers of values together, so that looking after every round and stopping at the first answer costs no confidence.
//! The next values go to the kinds that are not settled, in proportion to the number that each is expected to need: optimal computing
//! budget allocation, N_i / N_j = ((s_i / d_i) / (s_j / d_j))^2 (Chen, Lin, Yücesan and Chick 2000), where s_i is the scatter of the paired
//! differences to the best kind (Fu, Hu, Chen and Xiong 2007), and where d_i is what its interval must shrink to. The best kind has as
//! many as the one that is compared with it most often. Nothing here knows of walls.

use super::always_valid::{always_valid_mean, always_valid_quantile, always_valid_share};
use super::order::quantile;
use super::paired::probability_above;
use super::{mean, smallest};

/// Values that every kind has before the first look.
pub const FIRST: usize = 10;

/// New values between two looks, after so many: a tenth, so that few are taken in vain, and never less than a few.
pub fn round(spent: usize) -> usize {
    (spent / 10).max(8)
}

/// What kinds are compared by; larger values are stronger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// The mean.
    Mean,
    /// The share that lies below a level: the smaller the better.
    ShareBelow(f64),
    /// The value that a share lies below.
    Quantile(f64),
}

/// The values of one kind, by member.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    /// Values in the order of the members; none of a member that brought no value.
    pub values: Vec<Option<f64>>,
    /// Whether nothing is drawn: the first value is that of every member.
    pub fixed: bool,
}

/// When the best kind is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// What kinds are compared by.
    pub measure: Measure,
    /// Probability with which all that is said of differences holds together.
    pub confidence: f64,
    /// Differences smaller than this do not matter; above 0, in the unit of the measure.
    pub same_within: f64,
    /// What a member that brought no value counts at worst, and at best.
    pub ends: [f64; 2],
}

/// How much better one kind is than another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Pairs that it rests on.
    pub pairs: usize,
    /// Pairs of which one brought no value.
    pub lost: usize,
    /// The difference; none without a pair.
    pub value: Option<f64>,
    /// Its interval, which holds together with those of all other pairs of kinds, at all numbers of values; none while they bound nothing.
    pub interval: Option<[f64; 2]>,
    /// The interval that also holds whatever those without a value would have brought; the same where all brought one.
    pub whatever: Option<[f64; 2]>,
}

/// What a difference to the best kind shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shown {
    /// The other kind is worse.
    Worse,
    /// The two are the same within the zone of indifference.
    Same,
    /// Neither, so far.
    Open,
}

/// The kinds at one look.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// The best kind so far: whose least difference to any other is the largest.
    pub best: usize,
    /// The difference of the best kind to each; `None` to itself.
    pub differences: Vec<Option<Difference>>,
    /// What each difference shows; `Same` of the best kind itself.
    pub shown: Vec<Shown>,
}

impl Standing {
    /// Whether every other kind is settled.
    pub fn is_settled(&self) -> bool {
        !self.shown.contains(&Shown::Open)
    }
}

impl Rule {
    /// How much better `a` is than `b`, among so many kinds.
    pub fn difference(&self, a: &Kind, b: &Kind, kinds: usize) -> Difference {
        let miss = (1.0 - self.confidence) / ((kinds * (kinds - 1)) as f64 / 2.0);
        let pairs = pairs(a, b);
        let told: Vec<(f64, f64)> = pairs.iter().filter_map(|(a, b)| a.zip(*b)).collect();
        let lost = pairs.len() - told.len();
        let exact = a.fixed && b.fixed;
        let of = |pairs: &[(f64, f64)]| {
            let [x, y] = [|p: &(f64, f64)| p.0, |p: &(f64, f64)| p.1]
                .map(|side| pairs.iter().map(side).collect::<Vec<f64>>());
            let value = self.value(&x, &y);
            (
                value,
                if exact {
                    value.map(|value| [value; 2])
                } else {
                    self.interval([&x, &y], [a.fixed, b.fixed], miss)
                },
            )
        };
        let (value, interval) = of(&told);
        let whatever = if lost == 0 {
            interval
        } else {
            let filled = |[a, b]: [f64; 2]| {
                pairs.iter().map(|(x, y)| (x.unwrap_or(a), y.unwrap_or(b))).collect::<Vec<_>>()
            };
            let [worst, best] = self.ends;
            let ends = [of(&filled([worst, best])).1, of(&filled([best, worst])).1];
            ends[0].zip(ends[1]).map(|(low, high)| [low[0].min(high[0]), low[1].max(high[1])])
        };
        Difference { pairs: told.len(), lost, value, interval, whatever }
    }

    /// What the values found so far show. There must be two kinds or more.
    pub fn standing(&self, kinds: &[Kind]) -> Standing {
        crate::check!(kinds.len() > 1 && self.same_within > 0.0, "{} kinds, {self:?}", kinds.len());
        let best = self.best(kinds);
        let mut standing = Standing { best, differences: Vec::new(), shown: Vec::new() };
        for (index, kind) in kinds.iter().enumerate() {
            let difference = (index != best).then(|| self.difference(&kinds[best], kind, kinds.len()));
            standing.shown.push(difference.map_or(Shown::Same, |difference| self.shown(&difference)));
            standing.differences.push(difference);
        }
        standing
    }

    /// How many values each kind should have next, with no more than `more` new ones; a fixed kind has one. As many as now where all is
    /// settled.
    pub fn next(&self, kinds: &[Kind], standing: &Standing, more: usize) -> Vec<usize> {
        let mut counts: Vec<usize> = kinds.iter().map(|kind| kind.values.len()).collect();
        let needed: Vec<f64> = (0..kinds.len()).map(|index| self.needed(standing, index)).collect();
        let drawn = |index: usize| !kinds[index].fixed;
        let mut given = 0;
        loop {
            // Pairs that a kind has with the best one, for every one that it is expected to need.
            let pairs = |index: usize| {
                let both = [index, standing.best].into_iter().filter(|of| drawn(*of)).map(|of| counts[of]);
                both.min().unwrap_or(usize::MAX)
            };
            let open = (0..kinds.len()).filter(|index| standing.shown[*index] == Shown::Open);
            let open = open.filter(|index| drawn(*index) || drawn(standing.best));
            let starved = smallest(open.map(|index| (pairs(index) as f64 / needed[index], index)), 1);
            let Some(&index) = starved.first() else { return counts };
            let least = pairs(index);
            let short = [index, standing.best].into_iter().filter(|of| drawn(*of) && counts[*of] == least);
            let short: Vec<usize> = short.collect();
            given += short.len();
            if given > more {
                return counts;
            }
            short.into_iter().for_each(|of| counts[of] += 1);
        }
    }

    /// How probable it is that no kind is better than the best one by the zone of indifference or more, after these values and nothing
    /// else: one less the sum of what is against it (Chen, Lin, Yücesan and Chick 2000, their Eq. 5). Of means alone; `None` where a
    /// difference has less than two pairs.
    pub fn probability_of_correct_selection(&self, kinds: &[Kind], best: usize) -> Option<f64> {
        if self.measure != Measure::Mean {
            return None;
        }
        let mut against = 0.0;
        for (_, kind) in kinds.iter().enumerate().filter(|(index, _)| *index != best) {
            let told = pairs(&kinds[best], kind);
            let differences: Vec<f64> =
                told.iter().filter_map(|(a, b)| a.zip(*b)).map(|(a, b)| a - b).collect();
            against += match kinds[best].fixed && kind.fixed {
                true => f64::from(u8::from(mean(&differences)? <= -self.same_within)),
                false => 1.0 - probability_above(&differences, -self.same_within)?,
            };
        }
        Some((1.0 - against).max(0.0))
    }

    fn best(&self, kinds: &[Kind]) -> usize {
        let mut least = vec![f64::INFINITY; kinds.len()];
        for (a, own) in kinds.iter().enumerate() {
            for (b, other) in kinds.iter().enumerate().skip(a + 1) {
                let told = pairs(own, other).into_iter().filter_map(|(a, b)| a.zip(b));
                let (x, y): (Vec<f64>, Vec<f64>) = told.unzip();
                // Without a pair neither is ahead of the other; it has to be found out.
                let ahead = self.value(&x, &y).unwrap_or(0.0);
                least[a] = least[a].min(ahead);
                least[b] = least[b].min(-ahead);
            }
        }
        smallest(least.into_iter().map(|own| -own).zip(0..), 1).first().copied().unwrap_or(0)
    }

    fn shown(&self, difference: &Difference) -> Shown {
        match difference.whatever {
            Some([low, _]) if low > 0.0 => Shown::Worse,
            Some([low, high]) if low > -self.same_within && high < self.same_within => Shown::Same,
            _ => Shown::Open,
        }
    }

    /// Pairs that would settle a kind, if its difference and scatter stay as they are: intervals shrink with the root of their number.
    fn needed(&self, standing: &Standing, index: usize) -> f64 {
        let Some(difference) = &standing.differences[index] else { return 1.0 };
        let Some((value, [low, high])) = difference.value.zip(difference.whatever) else { return f64::MAX };
        let goal = value.abs().max(self.same_within - value.abs());
        let ratio = 0.5 * (high - low) / goal;
        (difference.pairs as f64 * ratio * ratio).max(1.0)
    }

    /// How much better the first are than the second.
    fn value(&self, a: &[f64], b: &[f64]) -> Option<f64> {
        let below = |values: &[f64], level: f64| {
            let share = values.iter().filter(|value| **value < level).count() as f64 / values.len() as f64;
            (!values.is_empty()).then_some(share)
        };
        Some(match self.measure {
            Measure::Mean => mean(a)? - mean(b)?,
            Measure::ShareBelow(level) => below(b, level)? - below(a, level)?,
            Measure::Quantile(share) => quantile(a, share)? - quantile(b, share)?,
        })
    }

    fn interval(&self, [a, b]: [&[f64]; 2], fixed: [bool; 2], miss: f64) -> Option<[f64; 2]> {
        match self.measure {
            Measure::Mean => {
                let differences: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
                always_valid_mean(&differences, miss)
            }
            Measure::ShareBelow(level) => {
                // Pairs that agree say nothing of the difference.
                let only = |first: &[f64], second: &[f64]| {
                    let hits: Vec<bool> =
                        first.iter().zip(second).map(|(x, y)| *x < level && *y >= level).collect();
                    always_valid_share(&hits, 0.5 * miss)
                };
                let ([own_low, own_high], [other_low, other_high]) = (only(a, b)?, only(b, a)?);
                Some([other_low - own_high, other_high - own_low])
            }
            Measure::Quantile(share) => {
                let of = |values: &[f64], fixed: bool| match fixed {
                    true => values.first().map(|value| [*value; 2]),
                    false => always_valid_quantile(values, share, 0.5 * miss),
                };
                let ([a_low, a_high], [b_low, b_high]) = (of(a, fixed[0])?, of(b, fixed[1])?);
                Some([a_low - b_high, a_high - b_low])
            }
        }
    }
}

/// The members that both kinds have, pair by pair; a fixed kind has its one value in each.
pub fn pairs(a: &Kind, b: &Kind) -> Vec<(Option<f64>, Option<f64>)> {
    let count = match (a.fixed, b.fixed) {
        (true, true) => 1,
        (true, false) => b.values.len(),
        (false, true) => a.values.len(),
        (false, false) => a.values.len().min(b.values.len()),
    };
    let at =
        |kind: &Kind, member: usize| kind.values.get(if kind.fixed { 0 } else { member }).copied().flatten();
    (0..count).map(|member| (at(a, member), at(b, member))).collect()
}
