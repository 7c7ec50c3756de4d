//! The physical prior beside the search prior: truths that it expects, and how much more it expects a truth than the search does.

use crate::critic::simulate::{Causes, Scored, Truth, World};
use crate::math::ln;
use crate::random::standard_normal::{cdf, quantile};
use crate::random::{Family, Streams};
use crate::study::Parameter;

/// Scores beyond this, one in two million, stand for what the search prior cuts off.
const FURTHEST: f64 = 5.0;

impl World<'_> {
    /// The truth with these causes, their parameters drawn from their physical priors, such that walls [stand](Self::stands); joints
    /// as [`Self::drawn`] has them with the same streams, where walls stand under both.
    pub fn expected(&self, causes: impl Into<Causes>, streams: &Streams) -> Truth {
        self.drawn_as(causes.into(), streams, |mut truth| {
            let mapped = self.scored(truth.causes).zip(&truth.parameters).map(|(scored, score)| {
                if is_constant(scored.parameter) {
                    return *score;
                }
                let value = scored.parameter.prior.at_score(*score);
                quantile(scored.parameter.search.cdf(value).clamp(cdf(-FURTHEST), cdf(FURTHEST)))
            });
            truth.parameters = mapped.collect();
            truth
        })
    }

    /// Logarithm of the density of a truth's parameters under their physical priors, less that under the search priors; minus infinity
    /// where the physical priors exclude them. Draws from a posterior under the search priors, weighted by it, are draws under the
    /// physical ones.
    pub fn log_weight(&self, truth: &Truth) -> f64 {
        let log_ratio = |(scored, score): (Scored<'_>, &f64)| {
            let p = scored.parameter;
            let value = p.search.at_score(*score);
            match (p.prior.density(value), p.search.density(value)) {
                (Some(physical), Some(search)) => ln(physical) - ln(search),
                // A constant has no density, and is the same in both.
                _ => 0.0,
            }
        };
        self.scored(truth.causes).zip(&truth.parameters).map(log_ratio).sum()
    }
}

fn is_constant(parameter: &Parameter) -> bool {
    matches!(parameter.prior, Family::Constant { .. })
}
