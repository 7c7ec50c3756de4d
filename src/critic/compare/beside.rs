//! Measured beside simulated: one line per family, quantity, tilt and joint stiffness.

use std::collections::BTreeMap;

use crate::critic::compare::simulated::{Simulated, simulated};
use crate::ensemble::Row;
use crate::protocol::Protocol;
use crate::random::standard_normal::cdf;
use crate::stats::{self, Sample, Summary};
use crate::study::{Arm, MeasuredKind, MeasuredQuantity, Measurement, Study};

/// One quantity of one family at one tilt, measured and simulated. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Beside {
    /// The arm.
    pub family: String,
    /// What was measured.
    pub quantity: MeasuredQuantity,
    /// At which tilt (rad); `None` where the quantity has none of its own.
    pub tilt: Option<f64>,
    /// At which drift; `None` where the quantity has none of its own.
    pub drift: Option<f64>,
    /// What was measured.
    pub measured: Measured,
    /// What our walls show.
    pub ours: Ours,
}

/// The measured side.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Mean, sigma and COV of the values that are known; they contain the readings' errors and rounding.
    pub values: Summary,
    /// Values of which only an upper bound is known; they are in no statistic.
    pub below: u64,
    /// Values of which only a lower bound is known.
    pub above: u64,
    /// Error of the mean that comes from the readings, one standard deviation: random errors and rounding averaged, the
    /// common error whole. `None` where no value is known.
    pub error: Option<f64>,
}

/// Our side.
#[derive(Clone, Debug, PartialEq)]
pub enum Ours {
    /// There is none, for this reason.
    None(&'static str),
    /// The walls of the arm at one joint stiffness.
    Walls(Walls),
}

/// Walls of an arm at one joint stiffness.
#[derive(Clone, Debug, PartialEq)]
pub struct Walls {
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Mean, sigma and COV of the walls that bring a value; empty where some are only known to lie above the load path's
    /// end.
    pub values: Summary,
    /// Walls that fell before the tilt of the reading.
    pub fell_before: u64,
    /// Walls that stood to the end of the load path, so that their value is not known.
    pub stood: u64,
    /// Walls that the solver lost or that could not be built.
    pub lost: u64,
    /// How far the means are apart; `None` where one of them is not defined, or no error is known.
    pub difference: Option<Difference>,
    /// Share of the walls that agree with the bounds measured, averaged over these: the probability that a reading of the
    /// wall, with the bound's error, lies on the bound's side; a wall that fell before does not agree. `None` without bounds
    /// and without walls.
    pub agreeing: Option<f64>,
}

/// The difference of the means, simulated less measured, with its standard deviation in three parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Simulated mean less measured mean.
    pub value: f64,
    /// Part of the readings' errors.
    pub measurement: f64,
    /// Part of the scatter between specimens: the simulated sigma over the root of the number of specimens, or the measured
    /// sigma less the readings' random errors where that is larger (an arm without random stones scatters nothing).
    pub scatter: f64,
    /// Part of the sampling error of the simulated mean.
    pub ensemble: f64,
}

impl Difference {
    /// Standard deviation of the difference, all parts together.
    pub fn sd(&self) -> f64 {
        (self.measurement * self.measurement + self.scatter * self.scatter + self.ensemble * self.ensemble)
            .sqrt()
    }

    /// The difference in its standard deviations.
    pub fn in_sd(&self) -> f64 {
        self.value / self.sd()
    }
}

/// A family's readings of one quantity at one tilt, on the way up or after it.
pub type Group<'m> = Vec<&'m Measurement>;

/// Compares all that was measured with the rows: families in the order of the arms, quantities, tilts and kn ascending.
pub fn compare(study: &Study, rows: &[Row]) -> Vec<Beside> {
    let tilts = matches!(study.protocol, Protocol::Tilting(_));
    let shears = matches!(study.protocol, Protocol::Shear(_));
    let goes_back = study.goes_back();
    let mut all = Vec::new();
    for ((arm, quantity, _, rising), group) in groups(study) {
        let Some(first) = group.first() else { continue };
        let measured = measured(&group);
        let beside = |ours| Beside {
            family: first.family.clone(),
            quantity,
            tilt: first.tilt,
            drift: first.drift,
            measured: measured.clone(),
            ours,
        };
        match (study.arms.get(arm), rising) {
            (None, _) => all.push(beside(Ours::None("the arm is not evaluated here"))),
            _ if quantity.is_shaken() => {
                all.push(beside(Ours::None("what motions of the base did is compared by `pirca diagnose`")));
            }
            _ if quantity.has_drift() && !shears => {
                all.push(beside(Ours::None("the walls are not sheared here")));
            }
            _ if !tilts && !quantity.has_drift() && quantity != MeasuredQuantity::SpecimenWeight => {
                all.push(beside(Ours::None("the walls are not tilted here")));
            }
            (_, false) => all.push(beside(Ours::None("read after the load had been larger"))),
            _ if quantity.is_remainder() && !goes_back => {
                all.push(beside(Ours::None("the platform does not go back here: load.remainders = true")));
            }
            (Some(own), true) => match walls((own, study.randomisations()), arm, &group, &measured, rows) {
                Some(walls) => all.extend(walls.into_iter().map(|walls| beside(Ours::Walls(walls)))),
                None => all.push(beside(Ours::None("the simulation does not give it"))),
            },
        }
    }
    all
}

/// Readings by arm, quantity, tilt (bits of a number that is not negative, which are in its order) and whether on the way up.
pub fn groups(study: &Study) -> BTreeMap<(usize, MeasuredQuantity, u64, bool), Group<'_>> {
    let mut groups: BTreeMap<_, Group<'_>> = BTreeMap::new();
    for m in &study.measured {
        let own = study.arms.iter().position(|arm| arm.name == m.family);
        // Families whose arms are not evaluated come behind, each by itself.
        let first = || study.measured.iter().position(|first| first.family == m.family).unwrap_or_default();
        let arm = own.unwrap_or_else(|| study.arms.len() + first());
        groups.entry((arm, m.quantity, order_of_tilt(m), is_rising(m, &study.measured))).or_default().push(m);
    }
    groups
}

/// A key that is in the order of the tilts, or of the drifts: the bits of a number that is not negative; 0 where there is none.
pub fn order_of_tilt(m: &Measurement) -> u64 {
    m.at().map_or(0, |at| at.abs().to_bits())
}

/// Whether the specimen comes to the reading's tilt for the first time: no earlier stage had a larger one, nor the same one with
/// a smaller one, or the level, since; what is left after a tilt belongs to it. Several points may be read at a tilt, each a stage.
pub fn is_rising(m: &Measurement, all: &[Measurement]) -> bool {
    let Some(tilt) = m.tilt.filter(|_| !m.quantity.is_remainder()) else { return true };
    let earlier: Vec<(&Measurement, f64)> = all
        .iter()
        .filter(|other| other.specimen == m.specimen && other.stage < m.stage)
        .filter_map(|other| Some((other, other.tilt?)))
        .collect();
    let first = earlier.iter().filter(|(_, before)| *before >= tilt).map(|(other, _)| other.stage).min();
    let Some(first) = first else { return true };
    earlier
        .iter()
        .filter(|(other, _)| other.stage >= first)
        .all(|(other, before)| *before == tilt && !other.quantity.is_remainder())
}

pub fn known<'m>(group: &'m [&Measurement]) -> impl Iterator<Item = &'m Measurement> {
    group.iter().copied().filter(|m| !m.kind.is_censored())
}

/// Variance of a reading by its random error and its rounding (evenly likely within the resolution).
pub fn reading_variance(m: &Measurement) -> f64 {
    m.error * m.error + m.resolution * m.resolution / 12.0
}

/// Error of the mean of some readings, one standard deviation: random errors and rounding averaged, the common error whole.
pub fn error_of_mean(group: &[&Measurement]) -> f64 {
    let n = group.len() as f64;
    let random: Vec<f64> = group.iter().map(|m| reading_variance(m)).collect();
    let common: Vec<f64> = group.iter().map(|m| m.common_error).collect();
    let shared = stats::sum(&common) / n;
    (stats::sum(&random) / (n * n) + shared * shared).sqrt()
}

pub fn measured(group: &[&Measurement]) -> Measured {
    let known: Vec<&Measurement> = known(group).collect();
    let values: Vec<f64> = known.iter().map(|m| m.value).collect();
    let count = |kind| group.iter().filter(|m| m.kind == kind).count() as u64;
    Measured {
        error: (!known.is_empty()).then(|| error_of_mean(&known)),
        values: Summary::of(&values),
        below: count(MeasuredKind::Below),
        above: count(MeasuredKind::Above),
    }
}

/// The walls of an arm, of which so many randomisations of a design share the members, point by point; `None` where the simulation has
/// no such quantity.
fn walls(
    (arm, randomisations): (&Arm, u64),
    index: usize,
    group: &[&Measurement],
    measured: &Measured,
    rows: &[Row],
) -> Option<Vec<Walls>> {
    let first = group.first()?;
    let mut all = Vec::new();
    for (point, &kn) in arm.kn_points.iter().enumerate() {
        let own = || rows.iter().filter(|row| row.arm_index as usize == index && row.point as usize == point);
        let shown: Vec<Simulated> =
            own().map(|row| simulated(first.quantity, first.at(), row)).collect::<Option<_>>()?;
        let count = |wanted: fn(&Simulated) -> bool| shown.iter().filter(|s| wanted(s)).count() as u64;
        let stood = count(|s| matches!(s, Simulated::Above(_)));
        let values = own().zip(&shown).filter_map(|(row, shown)| match shown {
            Simulated::Value(x) if stood == 0 => Some((row.member, *x)),
            _ => None,
        });
        let sample = Sample::of(values, randomisations);
        let values = sample.summary();
        all.push(Walls {
            kn,
            difference: difference(&values, sample.error_of_mean(), group, measured),
            values,
            fell_before: count(|s| *s == Simulated::FellBefore),
            stood,
            lost: count(|s| *s == Simulated::Nothing),
            agreeing: agreeing(&shown, group),
        });
    }
    Some(all)
}

/// `ensemble` is the standard error of the mean of our walls.
fn difference(
    ours: &Summary,
    ensemble: f64,
    group: &[&Measurement],
    measured: &Measured,
) -> Option<Difference> {
    let value = ours.mean.value? - measured.values.mean.value?;
    let sigma = ours.sigma.value.unwrap_or(0.0);
    let scatter = scatter(sigma, group, measured);
    let difference = Difference { value, measurement: measured.error?, scatter, ensemble };
    (difference.sd() > 0.0).then_some(difference)
}

/// See [`Difference::scatter`]; `sigma` is that of the simulated walls. Bounds alone show no scatter of their own.
pub fn scatter(sigma: f64, group: &[&Measurement], measured: &Measured) -> f64 {
    let specimens = measured.values.n as f64;
    if measured.values.n == 0 {
        return sigma / (group.len() as f64).sqrt();
    }
    let random: Vec<f64> = known(group).map(reading_variance).collect();
    let seen = measured.values.sigma.value.map_or(0.0, |s| s * s - stats::sum(&random) / specimens);
    ((sigma * sigma).max(seen) / specimens).sqrt()
}

/// See [`Walls::agreeing`].
fn agreeing(shown: &[Simulated], group: &[&Measurement]) -> Option<f64> {
    let mut shares = Vec::new();
    for m in group.iter().filter(|m| m.kind.is_censored()) {
        let below = m.kind == MeasuredKind::Below;
        for s in shown {
            let agrees = match s {
                Simulated::Nothing => continue,
                Simulated::FellBefore => 0.0,
                Simulated::Above(limit) if below && *limit >= m.value => 0.0,
                Simulated::Above(limit) if !below && *limit >= m.value => 1.0,
                Simulated::Above(_) => continue,
                Simulated::Value(x) => {
                    let inside = if below { m.value - x } else { x - m.value };
                    let error = (m.error * m.error + m.common_error * m.common_error).sqrt();
                    if error > 0.0 { cdf(inside / error) } else { f64::from(u8::from(inside > 0.0)) }
                }
            };
            shares.push(agrees);
        }
    }
    stats::mean(&shares)
}
