//! What is learnt of a law, in numbers.

use nalgebra::{DMatrix, DVector};

use crate::critic::joint_law::collapse::collapse;
use crate::critic::joint_law::fit::{Fit, Freedom};
use crate::critic::joint_law::form::Knots;
use crate::critic::joint_law::gain::{LawGain, gained};
use crate::critic::joint_law::named::{Form, Nearness};
use crate::critic::joint_law::tested::{KNOTS, Tested};
use crate::critic::simulate::Design;
use crate::math::{exp, ln};
use crate::random::standard_normal::{cdf, quantile};
use crate::study::{Arm, Nuisance, Study};

/// Probability beyond which a law is said to stiffen or to soften.
const SURE: f64 = 0.975;
/// Step of finite differences in the logarithm of the compliance.
const STEP: f64 = 1e-5;
/// Level of the intervals.
const LEVEL: f64 = 0.9;

/// A median and its 90 % interval.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Known {
    /// The median.
    pub median: f64,
    /// The interval.
    pub interval: [f64; 2],
}

/// Which way the stiffness goes as the stress grows, over the stresses seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Bend {
    /// It grows.
    Stiffening,
    /// It falls.
    Softening,
    /// Neither is sure.
    NotShown,
}

/// A law as it was learnt.
#[derive(Clone, Debug, PartialEq)]
pub struct LearntLaw {
    /// Index of the arms whose specimens it was learnt from.
    pub families: Vec<usize>,
    /// These arms with the law, where it is taken on.
    pub arms: Vec<Arm>,
    /// Stresses (Pa) that press on these walls, smallest and largest.
    pub seen: [f64; 2],
    /// Stresses (Pa) of the knots.
    pub stresses: Vec<f64>,
    /// Stiffness (Pa/m) at the knots.
    pub stiffness: Vec<Known>,
    /// Closure (m) at the knots since the first one at which the beds are pressed: what closed before the walls stood nobody has seen.
    pub closures: Vec<Known>,
    /// Numbers of the law that the readings know, of seven that it has.
    pub resolved: f64,
    /// The exponent of the stress in the stiffness, over the stresses seen.
    pub exponent: Known,
    /// Probability that the stiffness grows.
    pub stiffening: f64,
    /// What is said of that.
    pub bend: Bend,
    /// Laws with a name, the nearest first: each is charged a nat for every parameter.
    pub named: Vec<Nearness>,
    /// A stress (Pa) of twice the largest one seen, and the closures (m) there since the same knot if the stiffness stays as it is at the largest one seen,
    /// and if it goes on as it has changed: what the law is beyond what was seen is not known better than this.
    pub beyond: (f64, [f64; 2]),
    /// The collapse angle (rad) that it predicts of one more wall, by family; `None` where too few walls could be solved.
    pub collapse: Vec<Option<Known>>,
    /// What it gains on specimens held out; `None` where there are too few.
    pub gain: Option<LawGain>,
}

/// Why no law was learnt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotLearnt {
    /// Nothing to learn from.
    #[error("no displacement was read on tilted walls whose joints have no law of their own yet")]
    NothingRead,
    /// Simulated walls tell nothing.
    #[error("the walls of the study cannot be simulated under the laws that were tried")]
    NoWalls,
}

/// Learns the law of the joints from the measurements of a study; a pure function of its arguments.
///
/// # Errors
/// [`NotLearnt`].
pub fn learnt_law(study: &Study, nuisances: &[Nuisance; 3]) -> Result<LearntLaw, NotLearnt> {
    let (design, _) = Design::of(study);
    let tested = Tested::of(study, &design, nuisances).ok_or(NotLearnt::NothingRead)?;
    let level = Fit::of(&tested, Freedom::Level, &Freedom::Level.middle(&tested));
    let level = level.ok_or(NotLearnt::NoWalls)?;
    let free = Fit::of(&tested, Freedom::Knots, &Freedom::Knots.from(&level));
    let free = free.ok_or(NotLearnt::NoWalls)?;
    let gain = gained(&tested, &free, &level);
    Ok(LearntLaw::of(&tested, &free, gain))
}

impl LearntLaw {
    fn of(tested: &Tested<'_>, fit: &Fit, gain: Option<LawGain>) -> LearntLaw {
        let (stresses, law) = (tested.knots.stresses(), fit.law());
        let covariance = fit.covariance.view((0, 0), (KNOTS, KNOTS)).into_owned();
        let z = quantile(0.5 + 0.5 * LEVEL);
        let within = |median: f64, sd: f64| Known { median, interval: [median - z * sd, median + z * sd] };
        let in_logs = |own: Known| Known { median: exp(own.median), interval: own.interval.map(exp) };
        let sd = |of: &DVector<f64>| of.dot(&(&covariance * of)).max(0.0).sqrt();
        let stiffnesses = (0..KNOTS).map(|k| {
            let own = within(-law[k], covariance[(k, k)].max(0.0).sqrt());
            in_logs(own)
        });
        let first = first_pressed(stresses, tested.seen);
        // What has closed before the walls stood nobody has seen.
        let since = |law: &[f64]| {
            let closures = tested.knots.closures(law);
            closures.iter().map(|closure| closure - closures[first]).collect::<Vec<f64>>()
        };
        let closures = since(&law);
        let moved: Vec<Vec<f64>> = (0..KNOTS)
            .map(|k| {
                let mut moved = law.clone();
                moved[k] += STEP;
                since(&moved)
            })
            .collect();
        let closed = (0..KNOTS).map(|at| {
            let slope = DVector::from_fn(KNOTS, |k, _| (moved[k][at] - closures[at]) / STEP);
            within(closures[at], sd(&slope))
        });
        let slope = slope_over(stresses, tested.seen);
        let exponent = within(-slope.dot(&DVector::from_column_slice(&law)), sd(&slope));
        let spread = sd(&slope);
        let stiffening = cdf(exponent.median / spread.max(1e-12));
        let bend = if stiffening > SURE {
            Bend::Stiffening
        } else if stiffening < 1.0 - SURE {
            Bend::Softening
        } else {
            Bend::NotShown
        };
        let information = known_of_law(&fit.information);
        let mut named: Vec<Nearness> =
            Form::ALL.iter().map(|form| form.near(stresses, &law, &information)).collect();
        named.sort_by(|a, b| charged(a).total_cmp(&charged(b)));
        let top = 2.0 * tested.seen[1];
        let resolved = (&fit.covariance * &fit.information).diagonal().iter().take(KNOTS).sum();
        let arms = tested.families.iter().filter_map(|&family| tested.arm(family, &fit.tried()));
        LearntLaw {
            families: tested.families.clone(),
            arms: arms.collect(),
            seen: tested.seen,
            stiffness: stiffnesses.collect(),
            closures: closed.collect(),
            resolved,
            exponent,
            stiffening,
            bend,
            named,
            beyond: (top, beyond(stresses, &law, tested.seen, top, exponent.median)),
            collapse: collapse(tested, fit),
            gain,
            stresses: stresses.to_vec(),
        }
    }

    /// Whether it is taken on: it predicts what it has not seen.
    pub fn is_accepted(&self) -> bool {
        self.gain.as_ref().is_some_and(|gain| gain.is_accepted)
    }
}

/// What the readings know of the law, the scores left open within their priors.
fn known_of_law(information: &DMatrix<f64>) -> DMatrix<f64> {
    let law = information.view((0, 0), (KNOTS, KNOTS)).into_owned();
    let across = information.view((0, KNOTS), (KNOTS, 2)).into_owned();
    let scores = information.view((KNOTS, KNOTS), (2, 2)).into_owned() + DMatrix::identity(2, 2);
    match scores.try_inverse() {
        Some(inverse) => law - &across * inverse * across.transpose(),
        None => law,
    }
}

/// What a named law costs: what it loses, and a nat for every parameter.
fn charged(own: &Nearness) -> f64 {
    own.lost_nats + own.parameters.len() as f64
}

/// The weights of the least-squares slope over the logarithm of the stress, of the knots within what was seen.
fn slope_over(stresses: &[f64], [low, high]: [f64; 2]) -> DVector<f64> {
    let inside = |stress: f64| f64::from(u8::from(stress >= 0.99 * low && stress <= 1.01 * high));
    let count = stresses.iter().map(|s| inside(*s)).sum::<f64>();
    let middle = stresses.iter().map(|s| inside(*s) * ln(*s)).sum::<f64>() / count;
    let spread = stresses.iter().map(|s| inside(*s) * (ln(*s) - middle) * (ln(*s) - middle)).sum::<f64>();
    DVector::from_iterator(stresses.len(), stresses.iter().map(|s| inside(*s) * (ln(*s) - middle) / spread))
}

/// The first knot at which the beds of the walls are pressed.
fn first_pressed(stresses: &[f64], seen: [f64; 2]) -> usize {
    stresses.iter().position(|stress| *stress >= seen[0]).unwrap_or(0)
}

/// Closures (m) at a stress beyond the largest one seen, since the first knot pressed, if the stiffness stays, and if it goes on with its
/// exponent.
fn beyond(stresses: &[f64], law: &[f64], seen: [f64; 2], top: f64, exponent: f64) -> [f64; 2] {
    let first = first_pressed(stresses, seen);
    // The knots below the largest stress seen, and a last one there.
    let inner = stresses.iter().take_while(|stress| **stress < seen[1]).count();
    let share = ln(seen[1] / stresses[inner - 1]) / ln(stresses[inner] / stresses[inner - 1]);
    let last = law[inner - 1] + share * (law[inner] - law[inner - 1]);
    let knots = Knots::at(stresses[first..inner].iter().copied().chain([seen[1]]).collect());
    let own: Vec<f64> = law[first..inner].iter().copied().chain([last]).collect();
    let closures = knots.closures(&own);
    let closure = closures[closures.len() - 1] - closures[0];
    [0.0, exponent].map(|exponent| closure + knots.beyond(last, exponent, top))
}
