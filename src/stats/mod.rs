//! Statistics on plain slices: moments, COV, intervals, bootstrap. Every statistic comes with its interval.
//!
//! A statistic that a sample does not define is `None`: never zero, never NaN. Values handed in must be finite and at
//! most 1e150 in magnitude (so that squares stay finite); anything else is the caller's fault and stops the program.
//! Sums run in index order, so a result depends on the order of the values only, never on threads. The quantiles of
//! Student's t, chi-square and the binomial distribution come from `statrs`, which uses the platform's logarithm:
//! the last digits of an interval may differ between platforms; values and bootstrap intervals may not.

mod always_valid;
mod bootstrap;
mod characteristic;
mod dominance;
pub mod effort;
mod empirical;
mod estimate;
pub mod fragility;
pub mod importance;
mod kolmogorov;
mod moments;
mod order;
mod paired;
mod possible;
mod randomised;
mod ratio;
mod reference;
mod seeded;
pub mod selection;
mod sensitivity;
mod sequential;
mod size_effect;
mod stated_cov;
pub mod strata;
pub mod subset;
mod summary;
pub mod tally;
mod test_plan;
mod trials;
mod very_many;
mod weighted;

pub use always_valid::{always_valid_mean, always_valid_quantile, always_valid_share};
pub use bootstrap::{bootstrap_bca, cov_bootstrap, sigma_bootstrap};
pub use characteristic::{
    CHARACTERISTIC_PROBABILITY, DESIGN_PROBABILITY, Shape, Variation, below_mean, predictive_factor,
    tolerance_factor,
};
pub use dominance::{Distributed, Dominance, dominance};
pub use empirical::{
    EmpiricalStep, clopper_pearson, clopper_pearson_at, dkw_half_width, empirical, empirical_of,
};
pub use estimate::Estimate;
pub use kolmogorov::{ks_p_value, ks_statistic};
pub use moments::{correlation, correlation_estimate, cov, mean, sigma, sum};
pub use order::{Sorted, predictive_quantile, quantile, quantile_interval, smallest};
pub use paired::{NextPair, next_pair, probability_above};
pub use possible::possible_shares;
pub use randomised::{Sample, by_randomisations};
pub use ratio::{paired_ratio_of_means, ratio_of_means};
pub use reference::student_quantile;
pub use seeded::{spread_bootstrap, stream_of};
pub use sensitivity::{BasePoint, Sensitivity, Share, sensitivity, share_alone};
pub use sequential::{Looks, Statistic, relative_half_width};
pub use size_effect::{Settled, SizeEffect, size_effect};
pub use stated_cov::{CovTest, Scatter};
pub use summary::{Summary, above_zero, sigma_factors};
pub use test_plan::{
    Aim, characteristic_loss, pairs_to_see, power_of_groups, smallest_seen, specimens_for_characteristic,
    specimens_to_see,
};
pub use trials::Trials;
pub use weighted::weighted_interval;
