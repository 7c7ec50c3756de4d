//! What each mechanism changes in every observable, in units of the observable's error.
//!
//! The same walls are taken through the load with and without a mechanism (same seed, same members, same random numbers), so
//! that a difference is the mechanism's. Its unit is the standard deviation of the measured mean, [`Observable::error`]:
//! error of the readings and scatter of the specimens together. Of an arm with several joint stiffnesses the middle one (the
//! lower of two) is taken.

use std::collections::BTreeMap;
use std::num::NonZero;

use rayon::prelude::*;

use crate::critic::compare::Simulated;
use crate::critic::detectability::observable::{Observable, observables};
use crate::ensemble::{Progress, Row, Task, evaluate};
use crate::protocol::Protocol;
use crate::stats::{Estimate, Summary};
use crate::study::{Described, Faults, Study, Switched};

/// How many errors a change must have for the data to see it.
pub const SEEN: f64 = 2.0;

/// How the walls are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DetectabilitySettings {
    /// Walls per arm, at least 1; also of an arm in which nothing is drawn, as a mechanism may draw.
    pub members: u64,
    /// The quantile of the priors at which a mechanism is looked at, see [`Described::at_strength`].
    pub quantile: f64,
    /// Worker threads; `None` for one per processor. No result depends on their number.
    pub threads: Option<NonZero<usize>>,
}

/// The map.
#[derive(Clone, Debug, PartialEq)]
pub struct Detectability {
    /// Its columns.
    pub observables: Vec<Observable>,
    /// What the walls of the base model show of each of them: the mean of those that bring a value.
    pub base: Vec<Option<f64>>,
    /// Its rows, in the order of the catalogue.
    pub mechanisms: Vec<Effect>,
}

/// A row of the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// Name of the mechanism.
    pub mechanism: &'static str,
    /// Its parameters, in the units of their keys.
    pub values: Vec<(&'static str, f64)>,
    /// A cell per observable.
    pub cells: Vec<Cell>,
}

/// What becomes of an observable.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// It changes by so much.
    Change(Change),
    /// No wall reaches the reading any more: all that stood without the mechanism fall before it.
    FellBefore,
    /// No wall reaches the reading, neither with the mechanism nor without.
    NeverReached,
    /// The reading is reached only with the mechanism.
    OnlyWith,
    /// The walls stand to the end of the load path, with the mechanism or without: there is no value to compare.
    Stood,
    /// The solver lost the walls, or they cannot be built.
    Lost,
    /// The mechanism cannot act on these walls, for this reason.
    NotApplicable(&'static str),
}

/// A change, with the mechanism less without. SI units; intervals are Student's at 95 %, of the paired differences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Mean over the walls that have a value with and without the mechanism.
    pub value: Estimate,
    /// The part that the readings resolve, see [`Observable::bounds_only`]; otherwise the same.
    pub resolved: Estimate,
    /// Number of these walls.
    pub pairs: u64,
    /// Walls that fall before the reading with the mechanism and not without.
    pub fell_before: u64,
    /// [`Change::resolved`] over the error of the readings alone; `None` where that is 0.
    pub in_measurement_errors: Option<Estimate>,
    /// [`Change::resolved`] over [`Observable::error`]; `None` where that is 0.
    pub in_errors: Option<Estimate>,
}

/// Whether the data can see a mechanism in an observable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Sight {
    /// No.
    Not,
    /// By the mean change, whose interval includes 0: more walls may say otherwise.
    Perhaps,
    /// By [`SEEN`] errors or more, or because the walls no longer reach, or only now reach, a reading that was taken.
    Seen,
}

/// Why there is no map.
#[derive(Debug, thiserror::Error)]
pub enum NoDetectability {
    /// The protocol is another one.
    #[error("the study tilts no platform: the map is that of a tilting test")]
    NotTilting,
    /// There is nothing to see it with.
    #[error("nothing that the simulation gives was measured: the study needs a measured.csv")]
    NothingMeasured,
    /// A prior gives a value that its key forbids.
    #[error("{mechanism} at that quantile of its priors: {faults}")]
    Parameters {
        /// The mechanism.
        mechanism: &'static str,
        /// What is wrong.
        faults: Faults,
    },
    /// The threads cannot be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

/// Computes the map of a study for these mechanisms.
///
/// # Errors
/// See [`NoDetectability`].
pub fn detectability(
    study: &Study,
    mechanisms: &[Described],
    settings: &DetectabilitySettings,
    progress: &dyn Progress,
) -> Result<Detectability, NoDetectability> {
    if !matches!(study.protocol, Protocol::Tilting(_)) {
        return Err(NoDetectability::NotTilting);
    }
    let base = study.clone().without_limit_analysis();
    let switched = mechanisms
        .iter()
        .map(|mechanism| {
            let values = mechanism.at_strength(settings.quantile);
            let switched = base.with_mechanism(mechanism.name, &values);
            let switched = switched
                .map_err(|faults| NoDetectability::Parameters { mechanism: mechanism.name, faults })?;
            Ok((mechanism.name, values, switched))
        })
        .collect::<Result<Vec<_>, NoDetectability>>()?;
    let measured: Vec<usize> = (0..base.arms.len())
        .filter(|&arm| base.measured.iter().any(|m| m.family == base.arms[arm].name))
        .collect();
    if measured.is_empty() {
        return Err(NoDetectability::NothingMeasured);
    }
    let mut jobs = planned(&base, 0, &measured, settings.members);
    for (index, (.., Switched { study, idle })) in switched.iter().enumerate() {
        let acted: Vec<usize> =
            measured.iter().copied().filter(|&arm| !idle.contains_key(&study.arms[arm].name)).collect();
        jobs.extend(planned(study, index + 1, &acted, settings.members));
    }
    let rows = evaluated(&jobs, settings, progress)?;
    let of = |place: usize, arm: usize| rows.get(&(place, arm)).map(|rows| rows.iter().collect::<Vec<_>>());
    let observables = observables(&base, |arm| of(0, arm).unwrap_or_default());
    if observables.is_empty() {
        return Err(NoDetectability::NothingMeasured);
    }
    let shown =
        |place: usize, o: &Observable| of(place, o.arm).and_then(|rows| o.shown(&rows)).unwrap_or_default();
    let without: Vec<Vec<Simulated>> = observables.iter().map(|o| shown(0, o)).collect();
    let mechanisms = switched.iter().enumerate().map(|(index, (mechanism, values, on))| {
        let cells = observables.iter().zip(&without).map(|(o, without)| match on.idle.get(&o.family) {
            Some(why) => Cell::NotApplicable(why),
            None => cell(o, without, &shown(index + 1, o)),
        });
        Effect { mechanism, values: values.clone(), cells: cells.collect() }
    });
    let mechanisms = mechanisms.collect();
    let base = without.iter().map(|shown| Summary::of(&values(shown)).mean.value).collect();
    Ok(Detectability { observables, base, mechanisms })
}

/// A wall to be evaluated: the study, its place (0 for the base model), the task.
type Job<'s> = (&'s Study, usize, Task);

fn planned<'s>(study: &'s Study, place: usize, arms: &[usize], members: u64) -> Vec<Job<'s>> {
    let walls = |&arm: &usize| {
        let point = study.arms[arm].middle_point() as u32;
        (0..members.max(1)).map(move |member| (study, place, Task { arm: arm as u32, point, member }))
    };
    arms.iter().flat_map(walls).collect()
}

/// The rows by place and arm, members ascending.
fn evaluated(
    jobs: &[Job<'_>],
    settings: &DetectabilitySettings,
    progress: &dyn Progress,
) -> Result<BTreeMap<(usize, usize), Vec<Row>>, NoDetectability> {
    let threads =
        settings.threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZero::get);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    progress.begin(jobs.len(), &[]);
    let one = |&(study, _, task): &Job<'_>| {
        let row = evaluate(study, task);
        progress.finished(&row);
        row
    };
    let rows: Vec<Row> = pool.install(|| jobs.par_iter().with_max_len(1).map(one).collect());
    progress.end();
    let mut sorted: BTreeMap<(usize, usize), Vec<Row>> = BTreeMap::new();
    for (&(_, place, task), row) in jobs.iter().zip(rows) {
        sorted.entry((place, task.arm as usize)).or_default().push(row);
    }
    Ok(sorted)
}

fn values(shown: &[Simulated]) -> Vec<f64> {
    shown.iter().filter_map(|s| if let Simulated::Value(x) = s { Some(*x) } else { None }).collect()
}

pub(super) fn cell(observable: &Observable, without: &[Simulated], with: &[Simulated]) -> Cell {
    use Simulated::{Above, FellBefore, Value};
    let both = || without.iter().zip(with);
    let pairs: Vec<(f64, f64)> = both()
        .filter_map(|pair| if let (Value(b), Value(w)) = pair { Some((*b, *w)) } else { None })
        .collect();
    if !pairs.is_empty() {
        let fell = both().filter(|pair| matches!(pair, (Value(_), FellBefore))).count();
        return Cell::Change(change(observable, &pairs, fell as u64));
    }
    let any = |wanted: fn((&Simulated, &Simulated)) -> bool| both().any(wanted);
    if any(|pair| matches!(pair, (Value(_), FellBefore))) {
        Cell::FellBefore
    } else if any(|pair| matches!(pair, (FellBefore, Value(_)))) {
        Cell::OnlyWith
    } else if any(|pair| matches!(pair, (FellBefore, FellBefore))) {
        Cell::NeverReached
    } else if any(|(without, with)| matches!(without, Above(_)) || matches!(with, Above(_))) {
        Cell::Stood
    } else {
        Cell::Lost
    }
}

fn change(observable: &Observable, pairs: &[(f64, f64)], fell_before: u64) -> Change {
    let mean = |of: &dyn Fn(f64) -> f64| {
        Summary::of(&pairs.iter().map(|&(without, with)| of(with) - of(without)).collect::<Vec<_>>()).mean
    };
    let resolved = mean(&|x| observable.resolved(x));
    Change {
        value: mean(&|x| x),
        resolved,
        pairs: pairs.len() as u64,
        fell_before,
        in_measurement_errors: in_units_of(resolved, observable.measurement),
        in_errors: in_units_of(resolved, observable.error()),
    }
}

fn in_units_of(x: Estimate, unit: f64) -> Option<Estimate> {
    let interval = x.interval.map(|ends| ends.map(|end| end / unit));
    (unit > 0.0).then(|| Estimate { value: x.value.map(|value| value / unit), interval })
}

impl Cell {
    /// Whether the data can see the mechanism here.
    pub fn sight(&self) -> Sight {
        match self {
            Cell::FellBefore | Cell::OnlyWith => Sight::Seen,
            Cell::NeverReached | Cell::Stood | Cell::Lost | Cell::NotApplicable(_) => Sight::Not,
            Cell::Change(change) => match change.in_errors.and_then(|e| e.value) {
                Some(errors) if errors.abs() >= SEEN && change.includes_0() => Sight::Perhaps,
                Some(errors) if errors.abs() >= SEEN => Sight::Seen,
                _ => Sight::Not,
            },
        }
    }
}

impl Change {
    /// Whether the interval of the change includes 0; also where one wall gives none.
    pub fn includes_0(&self) -> bool {
        self.resolved.interval.is_none_or(|[low, high]| low <= 0.0 && high >= 0.0)
    }
}

impl Effect {
    /// The best that any observable does.
    pub fn sight(&self) -> Sight {
        self.cells.iter().map(Cell::sight).max().unwrap_or(Sight::Not)
    }
}
