//! An observable: a quantity of a family at a tilt that was measured, with the error that its mean has.

use crate::critic::compare::{
    Group, Simulated, groups, known, measured, reading_variance, scatter, simulated,
};
use crate::ensemble::Row;
use crate::stats;
use crate::study::{MeasuredKind, MeasuredQuantity, Study};

/// A quantity of a family at a tilt that was measured on the way up, and that the simulation gives. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Observable {
    /// Index of the arm.
    pub arm: usize,
    /// Its name.
    pub family: String,
    /// What was measured.
    pub quantity: MeasuredQuantity,
    /// At which tilt (rad); `None` where the quantity has none of its own.
    pub tilt: Option<f64>,
    /// Readings that the errors below rest on: those with a value, or all where only bounds are known.
    pub readings: usize,
    /// Whether only bounds are known. A change then counts as far as it lies beyond them.
    pub bounds_only: bool,
    /// Error of the mean that comes from the readings, one standard deviation: random errors and rounding averaged, the common
    /// error whole; of bounds, the error that a reading at the bound has.
    pub measurement: f64,
    /// Standard deviation of the mean that comes from the scatter between specimens; see
    /// [`Difference::scatter`](crate::critic::Difference::scatter).
    pub scatter: f64,
    /// The bounds, where only these are known: whether the value is below, and the bound.
    bounds: Vec<(bool, f64)>,
}

impl Observable {
    /// Standard deviation of the measured mean: readings and scatter together.
    pub fn error(&self) -> f64 {
        (self.measurement * self.measurement + self.scatter * self.scatter).sqrt()
    }

    /// What of a wall's value the readings resolve: all of it, or where only bounds are known what lies beyond them.
    pub(super) fn resolved(&self, value: f64) -> f64 {
        if self.bounds.is_empty() {
            return value;
        }
        let clipped = |&(below, bound): &(bool, f64)| if below { value.max(bound) } else { value.min(bound) };
        stats::sum(&self.bounds.iter().map(clipped).collect::<Vec<_>>()) / self.bounds.len() as f64
    }

    /// What the rows of its arm show of it; `None` where the simulation has no such quantity.
    pub(super) fn shown(&self, rows: &[&Row]) -> Option<Vec<Simulated>> {
        rows.iter().map(|row| simulated(self.quantity, self.tilt, row)).collect()
    }
}

/// The observables of a study, in the order of the arms, quantities and tilts, without what no simulation gives; `rows` are
/// those of an arm in the base model, whose scatter enters the errors.
pub(super) fn observables<'r>(study: &Study, rows: impl Fn(usize) -> Vec<&'r Row>) -> Vec<Observable> {
    let is_simulated = |quantity: MeasuredQuantity| study.goes_back() || !quantity.is_remainder();
    let groups = groups(study).into_iter().filter(|((arm, quantity, _, rising), _)| {
        *rising && *arm < study.arms.len() && is_simulated(*quantity)
    });
    groups.filter_map(|((arm, ..), group)| observable(arm, &group, &rows(arm))).collect()
}

fn observable(arm: usize, group: &Group<'_>, rows: &[&Row]) -> Option<Observable> {
    let first = group.first()?;
    let said = measured(group);
    let with_values = known(group).count();
    let bounds = group.iter().filter(|m| with_values == 0 && m.kind.is_censored());
    let at_bounds = || {
        let n = group.len() as f64;
        let random: Vec<f64> = group.iter().map(|m| reading_variance(m)).collect();
        let common: Vec<f64> = group.iter().map(|m| m.common_error).collect();
        let shared = stats::sum(&common) / n;
        (stats::sum(&random) / (n * n) + shared * shared).sqrt()
    };
    let mut one = Observable {
        arm,
        family: first.family.clone(),
        quantity: first.quantity,
        tilt: first.tilt,
        readings: if with_values == 0 { group.len() } else { with_values },
        bounds_only: with_values == 0,
        measurement: said.error.unwrap_or_else(at_bounds),
        scatter: 0.0,
        bounds: bounds.map(|m| (m.kind == MeasuredKind::Below, m.value)).collect(),
    };
    let values: Vec<f64> = one
        .shown(rows)?
        .iter()
        .filter_map(|shown| if let Simulated::Value(x) = shown { Some(*x) } else { None })
        .collect();
    one.scatter = scatter(stats::sigma(&values).unwrap_or(0.0), group, &said);
    Some(one)
}
