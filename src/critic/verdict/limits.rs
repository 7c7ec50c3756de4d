//! From where on something is said.

/// A set of more causes than this separates nothing.
pub const MOST_AMBIGUOUS: usize = 3;
/// A cause that the ranking cannot put aside is put aside by the evidence where this leaves it a smaller probability.
pub const POSSIBLE: f64 = 0.01;
/// Evidence that differs by less than so many of its standard errors does not differ.
pub(super) const NOISE: f64 = 2.0;
/// A cause is put aside where its evidence lies further behind that of another one that fits, and by more than noise (nat): 20 to 1, from where
/// on Kass and Raftery (1995) call evidence strong.
const STRONG: f64 = 3.0;

/// The limits of a verdict.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// There is a discrepancy below this p-value.
    pub found: f64,
    /// A cause is named at this probability or above.
    pub named: f64,
    /// And below this p-value: where nothing is hidden a name is given in no larger a share of campaigns.
    pub sure: f64,
    /// A cause that fits a campaign worse than all but so large a share of its own does not explain it.
    pub check: f64,
    /// A cause acts outside its physical prior below this p-value.
    pub conflict: f64,
    /// The same two limits of a pair: the best of many pairs fits much that it has no part in, so that it must fit better.
    pub pair: PairLimits,
}

/// The limits of a pair of causes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairLimits {
    /// Share of the evidence at which it is named.
    pub named: f64,
    /// Share of its own campaigns that must fit no better.
    pub check: f64,
    /// The largest probability of something unmodelled. Two causes in one campaign look like one of them, hardly ever like none; and
    /// what is like none fits the best of many pairs now and then.
    pub unmodelled: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            found: 0.05,
            named: 0.8,
            sure: 0.01,
            check: 0.05,
            conflict: 0.05,
            pair: PairLimits { named: 0.99, check: 0.25, unmodelled: 0.05 },
        }
    }
}

/// Whether evidence lies far behind other evidence: logarithms with their standard errors.
pub(super) fn far_behind([log, spread]: [f64; 2], [other, others]: [f64; 2]) -> bool {
    other - log > STRONG.max(NOISE * of_difference(spread, others))
}

/// Standard error of a difference, from those of its parts.
pub(super) fn of_difference(one: f64, other: f64) -> f64 {
    (one * one + other * other).sqrt()
}
