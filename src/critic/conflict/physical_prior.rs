//! The physical prior beside the search prior: truths that it expects, and how much more it expects a truth than the search does.

use crate::critic::simulate::{Causes, Truth, World};
use crate::math::ln;
use crate::random::standard_normal::{cdf, quantile};
use crate::random::{Family, Streams};
use crate::study::{Described, Parameter};

/// Scores beyond this, one in two million, stand for what the search prior cuts off.
const FURTHEST: f64 = 5.0;

impl World<'_> {
    /// The truth with these causes, their parameters drawn from their physical priors, such that walls [stand](Self::stands); joints
    /// as [`Self::drawn`] has them with the same streams, where walls stand under both.
    pub fn expected(&self, causes: impl Into<Causes>, streams: &Streams) -> Truth {
        self.drawn_as(causes.into(), streams, |mut truth| {
            let parameters = truth.causes.each().flat_map(|cause| &self.mechanisms()[cause].parameters);
            let mapped = parameters.zip(&truth.parameters).map(|(p, score)| {
                if is_constant(p) {
                    return *score;
                }
                let value = p.prior.at_score(*score);
                quantile(p.search.cdf(value).clamp(cdf(-FURTHEST), cdf(FURTHEST)))
            });
            truth.parameters = mapped.collect();
            truth
        })
    }
}

/// Logarithm of the density of a truth's parameters under their physical priors, less that under the search priors; minus infinity
/// where the physical priors exclude them. Draws from a posterior under the search priors, weighted by it, are draws under the
/// physical ones.
pub fn log_weight(mechanisms: &[Described], truth: &Truth) -> f64 {
    let parameters = truth.causes.each().flat_map(|cause| &mechanisms[cause].parameters);
    let of = |(p, score): (&Parameter, &f64)| {
        let value = p.search.at_score(*score);
        match (p.prior.density(value), p.search.density(value)) {
            (Some(physical), Some(search)) => ln(physical) - ln(search),
            // A constant has no density, and is the same in both.
            _ => 0.0,
        }
    };
    parameters.zip(&truth.parameters).map(of).sum()
}

fn is_constant(parameter: &Parameter) -> bool {
    matches!(parameter.prior, Family::Constant { .. })
}
