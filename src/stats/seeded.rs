//! Bootstrap intervals from a named stream of their own, and such streams, for callers that draw nothing else.

use super::Estimate;
use super::bootstrap::{cov_bootstrap, sigma_bootstrap};
use crate::random::{Stream, Streams};

/// Sigma and COV of a sample with their BCa intervals; see [`super::bootstrap_bca`].
///
/// The resamples depend on `seed` and `name` alone, so that the interval of one sample does not change when another
/// one is added.
pub fn spread_bootstrap(values: &[f64], replicates: usize, seed: u64, name: &str) -> [Estimate; 2] {
    let streams = Streams::new(seed, 0);
    [
        sigma_bootstrap(values, replicates, &mut streams.of(&format!("bootstrap sigma {name}"))),
        cov_bootstrap(values, replicates, &mut streams.of(&format!("bootstrap cov {name}"))),
    ]
}

/// The stream of a name, for what is drawn of one sample: another one that is added changes nothing.
pub fn stream_of(seed: u64, name: &str) -> Stream {
    Streams::new(seed, 0).of(name)
}
