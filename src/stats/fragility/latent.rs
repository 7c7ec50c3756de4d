//! Campaigns drawn from the model of crossed records and walls.

use super::campaign::{Campaign, Outcome};
use super::lognormal::Lognormal;
use crate::math::ln;
use crate::random::{Stream, standard_normal};

/// A wall collapses under a record at x where ln x reaches ln theta plus normal deviates of the record, the wall, the pair and the trial.
///
/// The curve of all pairs together has the dispersion that the four standard deviations add up to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Latent {
    /// Median intensity of collapse.
    pub theta: f64,
    /// Standard deviations in ln x of record, wall, interaction and rest.
    pub deviations: [f64; 4],
}

impl Latent {
    /// The lognormal curve that a new record and a new wall have.
    pub fn curve(&self) -> Lognormal {
        let variance: f64 = self.deviations.iter().map(|own| own * own).sum();
        Lognormal { theta: self.theta, beta: variance.sqrt() }
    }

    /// A campaign with the intensities of another one, and without outcome where that has none.
    ///
    /// ```
    /// use pirca::random::Streams;
    /// use pirca::stats::fragility::{Campaign, Latent, Outcome};
    /// let planned = Campaign::of_stripes(&[0.5, 1.0, 2.0], 10, 4, vec![Some(Outcome::Stands); 120]);
    /// let latent = Latent { theta: 1.0, deviations: [0.3, 0.1, 0.1, 0.1] };
    /// let drawn = latent.drawn(&planned, &mut Streams::new(1, 0).of("planned campaign"));
    /// assert!(drawn.counts().collapsed > 20);
    /// ```
    pub fn drawn(&self, like: &Campaign, stream: &mut Stream) -> Campaign {
        let (stripes, walls) = (like.stripes(), like.walls());
        let mut deviates = |n: usize, deviation: f64| -> Vec<f64> {
            (0..n).map(|_| deviation * standard_normal::quantile(stream.uniform())).collect()
        };
        let [of_record, of_wall, of_pair, of_trial] = self.deviations;
        let by_record = deviates(like.records(), of_record);
        let by_wall = deviates(walls, of_wall);
        let by_pair = deviates(like.records() * walls, of_pair);
        let by_trial = deviates(like.outcomes().len(), of_trial);
        let outcome = |trial: usize| {
            like.outcomes()[trial]?;
            let (cell, wall) = (trial / walls, trial % walls);
            let record = cell / stripes;
            let capacity =
                by_record[record] + by_wall[wall] + by_pair[record * walls + wall] + by_trial[trial];
            let collapses = ln(like.intensities()[cell] / self.theta) >= capacity;
            Some(if collapses { Outcome::Collapsed } else { Outcome::Stands })
        };
        let outcomes = (0..like.outcomes().len()).map(outcome).collect();
        Campaign::new(like.intensities().to_vec(), like.records(), walls, outcomes)
    }
}
