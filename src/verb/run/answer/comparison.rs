//! Ratios of means between arms, and between stiffnesses of one arm.

use crate::stats;
use crate::stats::Estimate;
use crate::study::{Claim, ClaimTest};
use crate::verb::run::answer::population::Population;

/// What the interval of a ratio rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// Neither mean is random: the ratio has no sampling error and its interval is the ratio itself.
    Exact,
    /// One mean is not random: the interval of the other one's mean, scaled.
    OneArmFixed,
    /// The same members on both sides, which share their random numbers: paired.
    Paired,
    /// Two independent samples.
    Independent,
    /// One of the means does not exist.
    Undefined,
}

/// A ratio of means with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// The ratio.
    pub value: Option<f64>,
    /// Its 95 % interval.
    pub interval: Option<[f64; 2]>,
    /// What the interval rests on.
    pub basis: Basis,
    /// Walls above the line (pairs where paired).
    pub walls: u64,
}

/// Ratio of the means of two arms at one kn.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Comparison {
    /// The arm above the line.
    pub arm: String,
    /// The arm below the line.
    pub over: String,
    /// Normal stiffness of the joints (Pa/m).
    pub kn_pa_per_m: f64,
    /// Mean of `arm` over mean of `over`; null where one of them has no standing wall.
    pub ratio: Option<f64>,
    /// 95 % interval of the ratio; null where it is not defined, the ratio itself where nothing is random.
    pub ratio_ci: Option<[f64; 2]>,
    /// What the interval rests on.
    pub basis: Basis,
    /// Walls of `arm` used; where paired, walls that stand in both arms, and the ratio is over these alone.
    pub walls: u64,
}

/// Ratio of the means of two populations.
///
/// Two random populations of equally many members share their random numbers (streams are keyed by member), so
/// they are compared pairwise over the members that stand in both.
pub fn ratio(above: &Population, below: &Population) -> Ratio {
    let (a, b) = (above.complete(), below.complete());
    let walls = a.len() as u64;
    let (Some(mean_a), Some(mean_b)) = (stats::mean(a), stats::mean(b)) else {
        return Ratio { value: None, interval: None, basis: Basis::Undefined, walls };
    };
    // A single value handed to `ratio_of_means` counts as known without scatter: only a fixed arm may do that.
    let (estimate, basis) = match (above.fixed, below.fixed) {
        (true, true) => {
            let value = stats::ratio_of_means(&[mean_a], &[mean_b]).value;
            (Estimate { value, interval: value.map(|ratio| [ratio, ratio]) }, Basis::Exact)
        }
        (false, true) if above.randomisations > 1 => {
            let pairs: Vec<(u64, [f64; 2])> = above.values.iter().map(|(m, x)| (m, [x, mean_b])).collect();
            (randomised(&pairs, above.randomisations), Basis::OneArmFixed)
        }
        (true, false) if below.randomisations > 1 => {
            let pairs: Vec<(u64, [f64; 2])> = below.values.iter().map(|(m, y)| (m, [mean_a, y])).collect();
            (randomised(&pairs, below.randomisations), Basis::OneArmFixed)
        }
        (false, true) => (stats::ratio_of_means(a, &[mean_b]), Basis::OneArmFixed),
        (true, false) => (stats::ratio_of_means(&[mean_a], b), Basis::OneArmFixed),
        (false, false) if above.planned == below.planned => return paired(above, below),
        (false, false) if a.len() < 2 || b.len() < 2 => {
            (Estimate { interval: None, ..stats::ratio_of_means(a, b) }, Basis::Independent)
        }
        (false, false) => (stats::ratio_of_means(a, b), Basis::Independent),
    };
    Ratio { value: estimate.value, interval: estimate.interval, basis, walls }
}

fn paired(above: &Population, below: &Population) -> Ratio {
    let (walls, Estimate { value, interval }) = if above.randomisations > 1 {
        let pairs: Vec<(u64, [f64; 2])> = above.values.pairs(&below.values).collect();
        (pairs.len(), randomised(&pairs, above.randomisations))
    } else {
        let [a, b] = above.values.paired(&below.values);
        (a.len(), stats::paired_ratio_of_means(&a, &b))
    };
    Ratio { value, interval, basis: Basis::Paired, walls: walls as u64 }
}

/// Ratio of the means of pairs, by member, that share the randomisations of a design in turn.
fn randomised(pairs: &[(u64, [f64; 2])], randomisations: u64) -> Estimate {
    let mut shared = vec![Vec::new(); randomisations as usize];
    pairs.iter().for_each(|(member, pair)| shared[(member % randomisations) as usize].push(*pair));
    stats::by_randomisations(&shared, |pairs| {
        let mean = |side: usize| stats::mean(&pairs.iter().map(|pair| pair[side]).collect::<Vec<_>>());
        mean(0).zip(mean(1)).map(|(a, b)| a / b).filter(|ratio| ratio.is_finite())
    })
}

/// Ratios of means for every pair of arms, kn by kn. A pair that a published statement names is given in the
/// direction of the statement, every other pair as earlier over later arm of the study.
pub fn comparisons(populations: &[Population], claims: &[Claim]) -> Vec<Comparison> {
    let mut all = Vec::new();
    for (arm, over) in pairs(populations, claims) {
        for above in populations.iter().filter(|population| population.arm == arm) {
            let Some(below) = at(populations, &over, above.kn) else { continue };
            let ratio = ratio(above, below);
            all.push(Comparison {
                arm: arm.clone(),
                over: over.clone(),
                kn_pa_per_m: above.kn,
                ratio: ratio.value,
                ratio_ci: ratio.interval,
                basis: ratio.basis,
                walls: ratio.walls,
            });
        }
    }
    all
}

/// The population of an arm at one kn.
pub fn at<'a>(populations: &'a [Population], arm: &str, kn: f64) -> Option<&'a Population> {
    populations.iter().find(|population| population.arm == arm && population.kn == kn)
}

/// The populations of an arm, kn ascending.
pub fn of_arm<'a>(populations: &'a [Population], arm: &str) -> Vec<&'a Population> {
    populations.iter().filter(|population| population.arm == arm).collect()
}

/// Names of the arms in the order of the study.
pub fn arm_names(populations: &[Population]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for population in populations {
        if !names.contains(&population.arm) {
            names.push(population.arm.clone());
        }
    }
    names
}

fn pairs(populations: &[Population], claims: &[Claim]) -> Vec<(String, String)> {
    let mut pairs: Vec<(String, String)> = Vec::new();
    for claim in claims {
        if let ClaimTest::RatioOfMeans { arm, over, .. } = &claim.test
            && !pairs.contains(&(arm.clone(), over.clone()))
        {
            pairs.push((arm.clone(), over.clone()));
        }
    }
    let names = arm_names(populations);
    for (i, arm) in names.iter().enumerate() {
        for over in &names[i + 1..] {
            let pair = (arm.clone(), over.clone());
            if !pairs.contains(&pair) && !pairs.contains(&(over.clone(), arm.clone())) {
                pairs.push(pair);
            }
        }
    }
    pairs
}
