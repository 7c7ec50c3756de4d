//! Whether a law predicts specimens that it has not seen: half of each family's specimens from the other half, and back.

use crate::critic::joint_law::fit::Fit;
use crate::critic::joint_law::tested::Tested;
use crate::stats;

/// The gain of a law over joints of constant stiffness.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct LawGain {
    /// Gain in the logarithm of the density of the specimens held out, added up, in either fold (nats).
    pub folds: [f64; 2],
    /// Mean over all specimens, and its 95 % interval (nats a specimen).
    pub mean: f64,
    /// See [`LawGain::mean`].
    pub interval: [f64; 2],
    /// Whether the law is better in both folds, and surely so over all specimens.
    pub is_accepted: bool,
}

/// The gain, from the fits of all specimens; `None` with fewer than two specimens in a fold, or where a fold cannot be fitted.
pub(super) fn gained(tested: &Tested<'_>, free: &Fit, level: &Fit) -> Option<LawGain> {
    let mut folds = [Vec::new(), Vec::new()];
    for &family in &tested.families {
        let own = (0..tested.specimens.len()).filter(|&at| tested.specimens[at].family == family);
        own.enumerate().for_each(|(place, at)| folds[place % 2].push(at));
    }
    if folds.iter().any(|fold| fold.len() < 2) {
        return None;
    }
    let mut gains = [Vec::new(), Vec::new()];
    for (fold, gains) in gains.iter_mut().enumerate() {
        let known = &folds[1 - fold];
        let [free, level] = [free.of_some(tested, known)?, level.of_some(tested, known)?];
        for &at in &folds[fold] {
            gains.push(free.predicts(tested, at)? - level.predicts(tested, at)?);
        }
    }
    let sums = [0, 1].map(|fold| gains[fold].iter().sum::<f64>());
    let all = gains.concat();
    let (mean, sigma) = (stats::mean(&all)?, stats::sigma(&all)?);
    let n = all.len() as f64;
    let half = stats::student_quantile(0.975, n - 1.0) * sigma / n.sqrt();
    let interval = [mean - half, mean + half];
    Some(LawGain {
        folds: sums,
        mean,
        interval,
        is_accepted: interval[0] > 0.0 && sums.iter().all(|sum| *sum > 0.0),
    })
}
