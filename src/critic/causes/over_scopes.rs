//! The evidence of a cause, whatever its scope.

use crate::critic::causes::evidence::Evidence;
use crate::critic::causes::network::softmax;
use crate::critic::simulate::{Causes, Truth};
use crate::math::ln;

/// What a campaign says of a cause over its scopes, or of the base model.
#[derive(Clone, Debug, PartialEq)]
pub struct OverScopes {
    /// The cause with its likeliest scope.
    pub causes: Causes,
    /// Probability of that scope, if the cause acts.
    pub share: f64,
    /// Logarithm of the evidence: the mean over the scopes, by their probabilities beforehand.
    pub log: f64,
    /// Standard error of that.
    pub spread: f64,
    /// All its models with their probabilities beforehand and the evidence of each, but for its draws.
    pub models: Vec<(Causes, f64, Evidence)>,
    /// Draws from the posterior under the likeliest scope, equally likely.
    pub draws: Vec<Truth>,
}

impl OverScopes {
    /// From the evidence of each of the models of a cause, which come with their probabilities beforehand.
    ///
    /// # Panics
    /// Without a model.
    pub fn of(models: impl IntoIterator<Item = (Causes, f64)>, evidences: Vec<Evidence>) -> OverScopes {
        let mut all: Vec<(Causes, f64, Evidence)> =
            models.into_iter().zip(evidences).map(|((causes, p), evidence)| (causes, p, evidence)).collect();
        let logs: Vec<f64> = all.iter().map(|(_, p, evidence)| ln(*p) + evidence.log).collect();
        let shares = softmax(&logs, 1.0);
        let first = |best: usize, k: usize| if logs[k] > logs[best] { k } else { best };
        let best = (0..logs.len()).fold(0, first);
        let parts = all.iter().zip(&shares).map(|((.., evidence), share)| share * evidence.spread);
        let spread = parts.fold(0.0, |sum, part| sum + part * part).sqrt();
        let mut draws = Vec::new();
        for (k, (.., evidence)) in all.iter_mut().enumerate() {
            let own = std::mem::take(&mut evidence.draws);
            if k == best {
                draws = own;
            }
        }
        let (causes, log) = (all[best].0, logs[best] - ln(shares[best]));
        OverScopes { causes, share: shares[best], log, spread, models: all, draws }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::simulate::Scope;
    use crate::math::exp;

    #[test]
    fn the_evidence_of_a_cause_is_the_mean_over_its_scopes() {
        let evidences = |logs: &[f64]| {
            let truth = |k: usize| Truth {
                causes: Causes::default(),
                parameters: vec![k as f64],
                joints: Vec::new(),
                scatter: 0.0,
            };
            let one = |(k, log): (usize, &f64)| Evidence { log: *log, spread: 0.3, draws: vec![truth(k)] };
            logs.iter().enumerate().map(one).collect()
        };
        let models = [(Scope::All, 0.5), (Scope::Kind(1), 0.25), (Scope::Each, 0.25)]
            .map(|(scope, p)| (Causes::one(3, scope), p));
        let over = OverScopes::of(models, evidences(&[-3.0, -1.0, -2.0]));
        let mean = 0.5 * exp(-3.0) + 0.25 * exp(-1.0) + 0.25 * exp(-2.0);
        assert!((over.log - ln(mean)).abs() < 1e-12);
        assert!((over.share - 0.25 * exp(-1.0) / mean).abs() < 1e-12);
        assert_eq!((over.causes, over.draws[0].parameters[0]), (models[1].0, 1.0));
        // Each scope counts by its share in how far that scatters.
        let shares = [0.5 * exp(-3.0), 0.25 * exp(-1.0), 0.25 * exp(-2.0)].map(|part| part / mean);
        let squares = shares.iter().fold(0.0, |sum, share| sum + share * share);
        assert!((over.spread - 0.3 * squares.sqrt()).abs() < 1e-12);
        // One scope is its own evidence, to the last bit.
        let alone = OverScopes::of([(Causes::one(3, Scope::All), 1.0)], evidences(&[-3.7]));
        assert_eq!((alone.log, alone.share), (-3.7, 1.0));
    }
}
