//! `summary.json`: the numbers of a study, every statistic with its interval.

use std::collections::BTreeMap;

use crate::ensemble::{Look, Quantity, Row};
use crate::stats;
use crate::stats::{EmpiricalStep, Estimate, Sorted, Statistic};
use crate::study::{Arm, Study, SweptArm, Until};
use crate::verb::run::answer::bounded::Bounded;
use crate::verb::run::answer::comparison::{Comparison, comparisons};
use crate::verb::run::answer::demand::DemandSummary;
use crate::verb::run::answer::gathered::populations;
use crate::verb::run::answer::measured::{MeasuredSummary, measured};
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::published::{Published, judge_all};
use crate::verb::run::answer::shaken::{ShakenSummary, shaken};
use crate::verb::run::answer::undecided::LeftOpen;

/// What came out of a study. Intervals are at 95 %; what is not defined is null, never zero.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Summary {
    /// Name of the study.
    pub study: String,
    /// The question it answers.
    pub question: String,
    /// Named variant, null for the main reading.
    pub variant: Option<String>,
    /// Name of the solver.
    pub solver: &'static str,
    /// Seed of all random streams.
    pub seed: u64,
    /// Hash over everything that decides the results.
    pub study_hash: String,
    /// One entry per arm and kn: arms in the order of the study, kn ascending.
    pub arms: Vec<ArmSummary>,
    /// What a sweep set in which arm; left out where there is none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sweep: Vec<SweptArm>,
    /// What came of a demand; left out where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub demand: Option<DemandSummary>,
    /// Ratios of means between arms, kn by kn.
    pub comparisons: Vec<Comparison>,
    /// Published statements beside our numbers.
    pub published: Vec<Published>,
    /// What was measured beside our numbers; left out where nothing was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<MeasuredSummary>,
    /// What comes of walls that are shaken; left out of others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaken: Option<ShakenSummary>,
}

/// One arm at one kn.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ArmSummary {
    /// Name of the arm.
    pub arm: String,
    /// What its walls and joints are, units in the keys.
    pub parameters: BTreeMap<String, serde_json::Value>,
    /// Normal stiffness of the joints (Pa/m).
    pub kn_pa_per_m: f64,
    /// False when nothing is drawn in this arm: its value has no sampling error.
    pub random: bool,
    /// Walls that the study asks for.
    pub members: u64,
    /// Of them, those that have not been computed: shards of them are missing.
    #[serde(skip_serializing_if = "is_zero")]
    pub missing: u64,
    /// Walls by outcome; only `equilibrium` (of a collapse angle, `collapsed`; of a capacity or a load factor, either) enters the
    /// statistics.
    pub outcomes: BTreeMap<String, u64>,
    /// Walls that enter the statistics.
    pub in_mean: u64,
    /// Walls that stood to the end of a path that is meant to bring them down; their value is not known.
    #[serde(skip_serializing_if = "is_zero")]
    pub stood_to_the_end: u64,
    /// Walls by mechanism, of those that fell and were watched.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub failure_modes: BTreeMap<String, u64>,
    /// What is described: `top_displacement`, the largest out-of-plane displacement at the wall's top, `collapse_angle`, the tilt at
    /// which the wall falls, `load_factor`, that of limit analysis on the full load, or another one.
    pub quantity: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Mean.
    pub mean: Option<f64>,
    /// Its interval (Student's t; of a design, over its randomisations, as all intervals).
    pub mean_ci: Option<[f64; 2]>,
    /// Standard deviation, n - 1 in the denominator; null for fewer than two walls.
    pub sigma: Option<f64>,
    /// Its interval (chi-square, exact for normal values).
    pub sigma_ci: Option<[f64; 2]>,
    /// Its interval by bootstrap (BCa); null of a design, and of more than 200,000 walls, where it takes too long.
    pub sigma_bootstrap_ci: Option<[f64; 2]>,
    /// Coefficient of variation, a fraction.
    pub cov: Option<f64>,
    /// Its interval (modified McKay, Vangel 1996).
    pub cov_ci: Option<[f64; 2]>,
    /// Its interval by bootstrap (BCa); null where that of sigma is.
    pub cov_bootstrap_ci: Option<[f64; 2]>,
    /// Quantiles.
    pub quantiles: Vec<QuantileEntry>,
    /// The empirical distribution of the capacity, P(collapse | load), in the quantity's unit, with its 95 % bands; at most 10,000
    /// steps of it, see [`empirical`](crate::stats::empirical). Left out of a design, whose walls are not independent.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fragility: Vec<EmpiricalStep>,
    /// When the arm had walls enough; left out where their number was fixed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub enough: Option<EnoughEntry>,
    /// What limit analysis says of the same walls; left out where the study does not ask it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit_analysis: Option<Bounded>,
    /// Walls whose value rigid blocks leave open: it is an upper end. Left out where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_open: Option<LeftOpen>,
    /// Says which walls are not in the numbers; null when all are.
    pub note: Option<String>,
    /// How the quantity is shown.
    #[serde(skip)]
    pub shown: Quantity,
}

/// The last look at an arm whose walls were added until a statistic was known well enough.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct EnoughEntry {
    /// The statistic.
    pub of: String,
    /// Its value, in the unit of the quantity.
    pub value: Option<f64>,
    /// Its 95 % interval, which allows for all looks: it stands in the place of the one for a number of walls that is fixed beforehand.
    pub ci: Option<[f64; 2]>,
    /// Half the width of the interval over the value.
    pub half_width: Option<f64>,
    /// What the half width was to fall below.
    pub below: f64,
    /// Most walls that there could have been.
    pub at_most: u64,
    /// Whether it fell below.
    pub reached: bool,
}

impl EnoughEntry {
    /// At the walls of an arm at one stiffness.
    pub(crate) fn of(until: Until, population: &Population) -> EnoughEntry {
        let look = Look::at(until, population.values.values(), population.above.len());
        EnoughEntry {
            of: until.of.name(),
            value: look.estimate.value,
            ci: look.estimate.interval,
            half_width: look.half_width,
            below: until.below,
            at_most: until.at_most,
            reached: look.is_enough(),
        }
    }
}

impl ArmSummary {
    /// Walls that have been computed.
    pub fn computed(&self) -> u64 {
        self.members - self.missing.min(self.members)
    }

    /// Walls that have been computed and bring no value.
    pub fn failed(&self) -> u64 {
        self.computed().saturating_sub(self.in_mean + self.stood_to_the_end)
    }

    /// With the last look at an arm that has walls enough: its interval is that of the statistic.
    fn stopped(mut self, last: Option<(Statistic, EnoughEntry)>) -> ArmSummary {
        let Some((statistic, entry)) = last else { return self };
        match statistic {
            Statistic::Mean => self.mean_ci = entry.ci,
            Statistic::Sigma => self.sigma_ci = entry.ci,
            Statistic::Quantile(share) => {
                let own = self.quantiles.iter_mut().find(|own| own.probability == share);
                own.into_iter().for_each(|own| own.ci = entry.ci);
            }
        }
        ArmSummary { enough: Some(entry), ..self }
    }
}

/// For serde: a count that says nothing is left out.
fn is_zero(count: &u64) -> bool {
    *count == 0
}

/// A quantile of the walls that bring a value.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct QuantileEntry {
    /// Probability.
    pub probability: f64,
    /// The quantile (type 7 of Hyndman and Fan).
    pub value: Option<f64>,
    /// Its distribution-free interval; null when the walls are too few to bound it.
    pub ci: Option<[f64; 2]>,
}

impl QuantileEntry {
    fn of(probability: f64, Estimate { value, interval }: Estimate) -> Self {
        QuantileEntry { probability, value, ci: interval }
    }
}

/// Resamples of a bootstrap; 2000 keep the Monte Carlo error of an interval's ends small beside its width.
const REPLICATES: usize = 2000;
/// Most walls of a bootstrap. With so many it takes some ten seconds of each arm and stiffness, and in proportion with more.
const MOST_BOOTSTRAPPED: usize = 200_000;
/// Probabilities of the quantiles given.
const PROBABILITIES: [f64; 3] = [0.05, 0.5, 0.95];

/// Sums up the rows of a study, which come in the order of the results (arm, point, member). Who has too many rows to hold them at once
/// gathers them one by one, see [`Gathered`](crate::verb::run::answer::gathered::Gathered).
pub fn summarise(study: &Study, rows: &[Row]) -> Summary {
    summary_of(study, populations(study, rows), rows)
}

/// The summary of populations, and of rows as far as it needs them. Each population gives up its values for its quantiles.
pub(crate) fn summary_of(study: &Study, populations: Vec<Population>, rows: &[Row]) -> Summary {
    let comparisons = comparisons(&populations, &study.published);
    let published = judge_all(&study.published, &populations);
    let demanded = |demand| DemandSummary::of(demand, Quantity::of(study), &populations);
    let demand = study.demand.as_ref().and_then(demanded);
    let arms = populations.into_iter().map(|population| {
        let arm = study.arms.iter().find(|arm| arm.name == population.arm);
        let until = arm.and_then(|arm| arm.until);
        let last = until.map(|until| (until.of, EnoughEntry::of(until, &population)));
        let limit_analysis = study.agreement.then(|| population.bounded.clone());
        let entry =
            describe(population, study.seed, arm.map_or_else(BTreeMap::new, parameters)).stopped(last);
        ArmSummary { limit_analysis, ..entry }
    });
    Summary {
        study: study.name.clone(),
        question: study.question.clone(),
        variant: study.variant.clone(),
        solver: study.solver.name(),
        seed: study.seed,
        study_hash: study.hash.clone(),
        arms: arms.collect(),
        sweep: study.sweep.clone(),
        demand,
        comparisons,
        published,
        measured: measured(study, rows),
        shaken: shaken(study, rows),
    }
}

/// The statistics of one population.
pub(crate) fn describe(
    population: Population,
    seed: u64,
    parameters: BTreeMap<String, serde_json::Value>,
) -> ArmSummary {
    let statistics = match population.quantity {
        Quantity::CollapseAngle
        | Quantity::ShearCapacity
        | Quantity::LoadFactor
        | Quantity::CollapseIntensity(_)
        | Quantity::RetainedHeight => population.sample().summary_of_positive(),
        Quantity::TopDisplacement => population.sample().summary(),
    };
    let [sigma_bootstrap, cov_bootstrap] = bootstraps(&population, seed);
    let entry = ArmSummary {
        arm: population.arm.clone(),
        parameters,
        kn_pa_per_m: population.kn,
        random: !population.fixed,
        members: population.planned,
        missing: population.missing(),
        outcomes: population.outcomes.clone(),
        in_mean: statistics.n as u64,
        stood_to_the_end: population.above.len() as u64,
        failure_modes: population.modes.clone(),
        quantity: population.quantity.name(),
        unit: population.quantity.unit(),
        mean: statistics.mean.value,
        mean_ci: statistics.mean.interval,
        sigma: statistics.sigma.value,
        sigma_ci: statistics.sigma.interval,
        sigma_bootstrap_ci: sigma_bootstrap.interval,
        cov: statistics.cov.value,
        cov_ci: statistics.cov.interval,
        cov_bootstrap_ci: cov_bootstrap.interval,
        quantiles: Vec::new(),
        fragility: Vec::new(),
        enough: None,
        limit_analysis: None,
        left_open: population.left_open(),
        note: population.note(),
        shown: population.quantity,
    };
    let (quantiles, fragility) = distribution(population);
    ArmSummary { quantiles, fragility, ..entry }
}

/// Sigma and COV by bootstrap, where its values are independent as its draws are, and not too many.
fn bootstraps(population: &Population, seed: u64) -> [Estimate; 2] {
    let values = population.complete();
    if population.randomisations > 1 || values.len() > MOST_BOOTSTRAPPED {
        return [Estimate::UNDEFINED; 2];
    }
    let name = format!("{} {:e}", population.arm, population.kn);
    stats::spread_bootstrap(values, REPLICATES, seed, &name)
}

/// Quantiles and the empirical distribution of a capacity. They rest on the values in ascending order, which are sorted where they lie.
fn distribution(population: Population) -> (Vec<QuantileEntry>, Vec<EmpiricalStep>) {
    let quantiles =
        |of: &dyn Fn(f64) -> Estimate| PROBABILITIES.map(|p| QuantileEntry::of(p, of(p))).to_vec();
    if population.randomisations > 1 {
        // The bands of a distribution are those of independent values.
        let sample = population.sample();
        return (quantiles(&|p| sample.quantile(p)), Vec::new());
    }
    let Population { quantity, values, above, .. } = population;
    let sorted = Sorted::of(values.into_values());
    let of = |p| if above.is_empty() { sorted.quantile(p) } else { Estimate::UNDEFINED };
    let steps = match quantity {
        Quantity::TopDisplacement
        | Quantity::ShearCapacity
        | Quantity::LoadFactor
        | Quantity::CollapseIntensity(_)
        | Quantity::RetainedHeight => Vec::new(),
        Quantity::CollapseAngle => stats::empirical_of(&sorted, &above),
    };
    (quantiles(&of), steps)
}

/// What is known of walls that are drawn, and not of those of a file.
const OF_DRAWN: [&str; 5] = ["battered_face", "wythes", "header_share", "head_joint_gap_m", "wedge_share"];

/// What sets an arm apart: its walls, its joints and what holds it.
fn parameters(arm: &Arm) -> BTreeMap<String, serde_json::Value> {
    let (layout, outline, joint) = (&arm.layout, &arm.layout.outline, &arm.joint);
    let entries = [
        ("arrangement", serde_json::json!(layout.arrangement)),
        ("length_m", serde_json::json!(outline.length)),
        ("height_m", serde_json::json!(outline.height)),
        ("base_thickness_m", serde_json::json!(outline.base_thickness)),
        ("top_thickness_m", serde_json::json!(outline.top_thickness)),
        ("battered_face", serde_json::json!(outline.battered_face)),
        ("density_kg_per_m3", serde_json::json!(layout.density)),
        ("wythes", serde_json::json!(layout.wythes.count)),
        ("header_share", serde_json::json!(layout.wythes.header_share)),
        ("head_joint_gap_m", serde_json::json!(layout.head_joint_gap)),
        ("wedge_share", serde_json::json!(layout.wedges.as_ref().map_or(0.0, |wedges| wedges.share))),
        ("kn_factor", serde_json::json!(joint.kn_factor)),
        ("kn_over_ks", serde_json::json!(joint.kn_over_ks)),
        ("phi_deg", serde_json::json!(joint.phi_deg)),
        ("cohesion_pa", serde_json::json!(joint.cohesion)),
        ("tension_pa", serde_json::json!(joint.tension)),
    ];
    let entries = entries.into_iter().filter(|(key, _)| arm.file().is_none() || !OF_DRAWN.contains(key));
    let curve = arm.curve.iter().map(|curve| ("curve", serde_json::json!(curve)));
    let bearing = joint.bearing.iter().map(|bearing| ("bearing", serde_json::json!(bearing)));
    let uncertain: BTreeMap<&str, _> = arm.uncertain.iter().map(|own| (own.key, &own.family)).collect();
    let uncertain = (!uncertain.is_empty()).then(|| ("uncertain", serde_json::json!(uncertain)));
    entries
        .chain(bearing)
        .chain(curve)
        .chain(uncertain)
        .map(|(key, value)| (key.to_string(), value))
        .collect()
}
