//! Laws of no catalogue, learnt from campaigns of small towers: what was learnt is set beside what was true.
//!
//! The towers are read to 12.5 deg, and not when they fall: that is predicted.

use std::path::Path;

use pirca::critic::{Bend, learnt_law};
use pirca::ensemble::{Task, evaluate};
use pirca::law::NormalLaw;
use pirca::math::{exp, ln, radians};
use pirca::random::Streams;
use pirca::study::{MeasuredQuantity, nuisances};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::folders::{Folders, told, write};
use crate::record;
use crate::towers::{Hidden, campaign, towers};
use crate::truth::laws::{KNEE_PA, LAWS, Law, SOFT_SHARE};

/// Campaigns of each law, by look.
pub const PER_LAW: [u64; 3] = [4, 8, 12];
const SEED: u64 = 7_431_000;
/// An exponent of the true stiffness below this is neither stiffening nor softening.
const PLAIN: f64 = 0.1;
/// Stresses at which the true exponent is taken.
const STRESSES: usize = 25;

/// What came of a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Learnt {
    /// Knots within the stresses seen whose interval holds the true closure, and how many there are.
    pub within: [usize; 2],
    /// Whether the interval of the collapse angle of one more wall holds that of a true one; `None` where it was not predicted.
    pub collapse: Option<bool>,
    /// Whether the stiffness is said to go the way that it goes: `None` where neither is said, or where it hardly goes any.
    pub sign: Option<bool>,
    /// Whether it truly goes one way or the other.
    pub goes: bool,
    /// Whether the law was taken on.
    pub accepted: bool,
}

/// What came of the campaigns up to a look; `None` where no law was learnt.
pub fn stage(folders: &Folders, look: usize) -> Vec<Option<Learnt>> {
    let all: Vec<(&Law, u64)> =
        LAWS.iter().flat_map(|law| (0..PER_LAW[look]).map(move |k| (law, k))).collect();
    let folder = folders.of("laws");
    let path = |law: &Law, k: u64| folder.join(format!("{}-{k:02}.json", law.name));
    let open: Vec<_> = all.iter().filter(|(law, k)| !path(law, *k).exists()).collect();
    if !open.is_empty() {
        folders.lack("a law that was learnt");
    }
    open.into_par_iter().for_each(|(law, k)| write(&path(law, *k), &record::json(&learnt(law, *k))));
    all.iter().map(|(law, k)| told(&path(law, *k))).collect()
}

/// Learns one.
fn learnt(law: &'static Law, k: u64) -> Option<Learnt> {
    let mut draws = Streams::new(SEED, k).of(law.name);
    let soft_share = SOFT_SHARE[0] + draws.uniform() * (SOFT_SHARE[1] - SOFT_SHARE[0]);
    let knee = KNEE_PA[0] * exp(draws.uniform() * ln(KNEE_PA[1] / KNEE_PA[0]));
    let hidden = Hidden { law: Some((law, soft_share, knee)), ..Hidden::default() };
    let seed = SEED + k;
    let mut study = towers();
    let acted = hidden.study(&study, seed);
    let truth = law.of(&hidden.joints_of(&study, seed), soft_share, knee);
    study.measured = campaign(&towers(), &hidden, seed);
    study.measured.retain(|m| m.quantity != MeasuredQuantity::CollapseAngle);
    let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
    let nuisances = nuisances(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
    let own = learnt_law(&study, &nuisances).ok()?;
    let seen: Vec<usize> = (0..own.stresses.len())
        .filter(|&k| own.stresses[k] >= own.seen[0] && own.stresses[k] <= own.seen[1])
        .collect();
    let before = truth.closure(own.stresses[seen[0]]);
    let within = seen[1..].iter().filter(|&&k| {
        let ([low, high], exact) = (own.closures[k].interval, truth.closure(own.stresses[k]) - before);
        (low..=high).contains(&exact)
    });
    let true_exponent = exponent(&truth, own.seen);
    let goes = true_exponent.abs() > PLAIN;
    let sign = match own.bend {
        Bend::NotShown => None,
        said => Some((said == Bend::Stiffening) == (true_exponent > 0.0)),
    };
    let one_more = evaluate(&acted, Task { arm: 0, point: 0, member: 99 }).collapse_angle_deg();
    let collapse = one_more.zip(own.collapse[0]).map(|(angle, predicted)| {
        let [low, high] = predicted.interval;
        (low..=high).contains(&radians(angle))
    });
    Some(Learnt {
        within: [within.count(), seen.len() - 1],
        collapse,
        sign: sign.filter(|_| goes),
        goes,
        accepted: own.is_accepted(),
    })
}

/// The exponent of the stress in the stiffness of a law: the slope of a straight line through their logarithms.
fn exponent(law: &NormalLaw, [low, high]: [f64; 2]) -> f64 {
    let places: Vec<f64> =
        (0..STRESSES).map(|k| ln(low) + ln(high / low) * (k as f64 + 0.5) / STRESSES as f64).collect();
    let stiffness = |place: &f64| {
        let [below, above] = [-0.05, 0.05].map(|off| exp(place + off));
        ln((above - below) / (law.closure(above) - law.closure(below)))
    };
    let values: Vec<f64> = places.iter().map(stiffness).collect();
    let middle = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    let (x, y) = (middle(&places), middle(&values));
    let (above, squares) = places.iter().zip(&values).fold((0.0, 0.0), |(above, squares), (place, value)| {
        (above + (place - x) * (value - y), squares + (place - x) * (place - x))
    });
    above / squares
}

#[cfg(test)]
mod tests {
    use pirca::law::Stiffening;

    use super::*;

    #[test]
    fn the_exponent_of_a_power_is_its_own_and_that_of_a_constant_none() {
        let power = NormalLaw::Stiffening(Stiffening::new(5e12, 6e8, 0.6, 1e-3));
        assert!((exponent(&power, [1e3, 5e4]) - 0.6).abs() < 0.01, "{}", exponent(&power, [1e3, 5e4]));
        assert!(exponent(&NormalLaw::Linear { kn: 5e7 }, [1e3, 5e4]).abs() < 1e-6);
    }
}
