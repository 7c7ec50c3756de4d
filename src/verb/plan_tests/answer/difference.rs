//! What specimens tell of one arm, and of two.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::stats::{
    CHARACTERISTIC_PROBABILITY, characteristic_loss, correlation, mean, pairs_to_see, power_of_groups, sigma,
    smallest_seen, specimens_for_characteristic, specimens_to_see,
};
use crate::verb::plan_tests::answer::{Asked, Reading};
use crate::verb::run::answer::stated_cov::StatedCov;

/// What specimens of one arm carry.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlannedArm {
    /// Its name.
    pub name: String,
    /// Simulated walls that brought a value.
    pub walls: u64,
    /// Their mean, in the unit of the quantity.
    pub mean: Option<f64>,
    /// Coefficient of variation that real specimens are taken to have, the instrument's error included.
    pub cov: Option<f64>,
    /// How the coefficient of variation that was stated agrees with that of the simulated walls; none where none was stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stated_cov: Option<StatedCov>,
    /// The same of the specimens of this family that the study has measured; none where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stated_cov_of_specimens: Option<StatedCov>,
    /// What the characteristic value of the specimens that might be tested loses in the mean, as a share of the true fractile.
    pub loss: Option<f64>,
    /// Specimens whose characteristic value loses no more than is asked for.
    pub specimens: Option<usize>,
}

impl PlannedArm {
    /// From the values of its walls, and of specimens that were measured.
    pub fn of(
        name: &str,
        (values, specimens): (&BTreeMap<u64, f64>, &[f64]),
        reading: &Reading,
        asked: &Asked,
    ) -> PlannedArm {
        let values: Vec<f64> = values.values().copied().collect();
        let centre = mean(&values);
        let cov = centre
            .map(|centre| scatter(&[&values], centre, reading, asked) / centre.abs())
            .filter(|cov| cov.is_finite());
        let stated = |values: &[f64]| asked.known_cov.and_then(|cov| StatedCov::of(cov, values));
        PlannedArm {
            name: name.to_owned(),
            stated_cov: stated(&values),
            stated_cov_of_specimens: stated(specimens),
            walls: values.len() as u64,
            mean: centre,
            cov,
            loss: cov.and_then(|cov| characteristic_loss(asked.specimens, CHARACTERISTIC_PROBABILITY, cov)),
            specimens: cov
                .and_then(|cov| specimens_for_characteristic(CHARACTERISTIC_PROBABILITY, cov, asked.loss)),
        }
    }
}

/// What specimens of two arms tell by one reading. Values are in the unit that is shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlannedDifference {
    /// The two arms.
    pub arm: String,
    /// See `arm`.
    pub over: String,
    /// What is read.
    pub reading: String,
    /// Its unit.
    pub unit: &'static str,
    /// The difference of the means of simulated walls: the first less the second.
    pub difference: f64,
    /// Standard deviation of one specimen, the instrument's error included.
    pub sigma: f64,
    /// Correlation of simulated walls of the same stones; null where one arm does not scatter.
    pub correlation: Option<f64>,
    /// Specimens of each arm that show the difference, built of different stones.
    pub specimens: Option<usize>,
    /// Pairs that show it where the same stones are laid twice, as if the scatter were known.
    pub pairs: Option<f64>,
    /// Probability that the specimens that might be tested show it.
    pub power: f64,
    /// The smallest difference that they show with the probability that is asked for.
    pub smallest_seen: Option<f64>,
}

impl PlannedDifference {
    /// From the arms at these places; `None` where one has no value, or nothing scatters and no error is stated.
    pub fn of(
        names: [&str; 2],
        places: [usize; 2],
        reading: &Reading,
        asked: &Asked,
    ) -> Option<PlannedDifference> {
        let [a, b] = places.map(|place| &reading.values[place]);
        let [x, y] = [a, b].map(|values| values.values().copied().collect::<Vec<f64>>());
        let (centre_a, centre_b) = mean(&x).zip(mean(&y))?;
        let difference = centre_a - centre_b;
        let sigma = scatter(&[&x, &y], 0.5 * (centre_a + centre_b), reading, asked);
        if sigma <= 0.0 {
            return None;
        }
        let paired: (Vec<f64>, Vec<f64>) =
            a.iter().filter_map(|(member, x)| Some((*x, *b.get(member)?))).unzip();
        let own = correlation(&paired.0, &paired.1);
        // The instruments' errors are not shared by the two walls of a pair.
        let shared = own.map(|own| own * (1.0 - (reading.error / sigma) * (reading.error / sigma)).max(0.0));
        let effect = difference / sigma;
        Some(PlannedDifference {
            arm: names[0].to_owned(),
            over: names[1].to_owned(),
            reading: reading.name.clone(),
            unit: reading.unit,
            difference: difference * reading.shown,
            sigma: sigma * reading.shown,
            correlation: shared,
            specimens: specimens_to_see(effect, asked.aim),
            pairs: shared
                .map(|r| pairs_to_see(sigma, r, difference.abs(), asked.aim))
                .filter(|pairs| pairs.is_finite()),
            power: power_of_groups(effect, asked.specimens, asked.aim.confidence),
            smallest_seen: smallest_seen(asked.specimens, asked.aim).map(|own| own * sigma * reading.shown),
        })
    }
}

/// Standard deviation of one specimen: of the walls, or by the coefficient of variation that is stated, and of the instrument.
fn scatter(samples: &[&[f64]], centre: f64, reading: &Reading, asked: &Asked) -> f64 {
    let squares = match asked.known_cov {
        Some(cov) => cov * centre * cov * centre,
        None => {
            let own = samples.iter().map(|values| sigma(values).unwrap_or(0.0)).map(|sigma| sigma * sigma);
            own.sum::<f64>() / samples.len() as f64
        }
    };
    (squares + reading.error * reading.error).sqrt()
}
