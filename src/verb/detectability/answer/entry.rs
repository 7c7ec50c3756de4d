//! The map in the units of files.

use crate::critic::{Cell, Change, Detectability, DetectabilitySettings, Effect, Observable, Sight};
use crate::stats::Estimate;
use crate::study::{Described, MeasuredQuantity, Study};
use crate::verb::run::answer::measured::{in_unit, tidy_degrees, unit};

/// How a change is measured, in words.
const DEFINITION: &str = "change: mean over the walls of the observable with the mechanism less without it, the same walls and \
    random numbers; error: standard deviation of the measured mean, errors of the readings and scatter between specimens \
    together (the larger of the measured and the simulated scatter, over the root of the number of specimens); of an \
    observable of which only bounds are known (*), the part of the change that lies beyond the bounds counts";

/// The map. Intervals are at 95 % (Student's, of the paired differences); what is not defined is null.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct DetectabilitySummary {
    /// Name of the study.
    pub study: String,
    /// Its variant.
    pub variant: Option<String>,
    /// Seed of all random streams.
    pub seed: u64,
    /// Hash of the study without any of the mechanisms.
    pub study_hash: String,
    /// Walls per arm.
    pub members: u64,
    /// Quantile of the priors, from the weak end, at which each mechanism is looked at.
    pub quantile: f64,
    /// How a change is measured.
    pub definition: &'static str,
    /// The columns.
    pub observables: Vec<ObservableEntry>,
    /// The rows.
    pub mechanisms: Vec<MechanismEntry>,
}

/// A column.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ObservableEntry {
    /// The arm.
    pub family: String,
    /// What was measured.
    pub quantity: &'static str,
    /// Tilt of the reading; null where the quantity has none of its own.
    pub tilt_deg: Option<f64>,
    /// Unit of the numbers below, and of the changes.
    pub unit: &'static str,
    /// Readings that the errors rest on.
    pub readings: usize,
    /// Whether only bounds are known.
    pub bounds_only: bool,
    /// Mean of the walls without any of the mechanisms.
    pub without: Option<f64>,
    /// Error of the measured mean from the readings, one standard deviation.
    pub measurement_error: f64,
    /// The same from the scatter between specimens.
    pub scatter: f64,
    /// Both together.
    pub error: f64,
}

/// A row.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct MechanismEntry {
    /// The mechanism.
    pub mechanism: &'static str,
    /// What it is.
    pub what: &'static str,
    /// Its parameters.
    pub parameters: Vec<ParameterEntry>,
    /// The best that any observable does.
    pub sight: Sight,
    /// A cell per observable.
    pub cells: Vec<CellEntry>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ParameterEntry {
    /// Its key.
    pub key: &'static str,
    /// Its value.
    pub value: f64,
    /// Its unit; "1" for a plain number.
    pub unit: &'static str,
}

/// A cell. Numbers are null unless the outcome is `change`.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct CellEntry {
    /// What becomes of the observable: change, collapsed before the reading, and so on.
    pub outcome: &'static str,
    /// Why, where the mechanism is not applicable.
    pub note: Option<&'static str>,
    /// Whether the data can see it here.
    pub sight: Sight,
    /// The change.
    pub change: Option<f64>,
    /// Its interval.
    pub change_ci: Option<[f64; 2]>,
    /// The change that the readings can tell, over the error of the readings alone.
    pub in_measurement_errors: Option<f64>,
    /// The same over the error.
    pub in_errors: Option<f64>,
    /// Its interval.
    pub in_errors_ci: Option<[f64; 2]>,
    /// Walls with a value with and without the mechanism.
    pub pairs: u64,
    /// Walls that fall before the reading with the mechanism and not without.
    pub fell_before: u64,
}

impl DetectabilitySummary {
    /// From a map of a study and what it was made with.
    pub fn of(
        study: &Study,
        described: &[Described],
        settings: &DetectabilitySettings,
        map: &Detectability,
    ) -> DetectabilitySummary {
        let observables = map.observables.iter().zip(&map.base);
        let row = |effect: &Effect| {
            let found = described.iter().find(|one| one.name == effect.mechanism);
            row(effect, found, &map.observables)
        };
        DetectabilitySummary {
            study: study.name.clone(),
            variant: study.variant.clone(),
            seed: study.seed,
            study_hash: study.hash.clone(),
            members: settings.members,
            quantile: settings.quantile,
            definition: DEFINITION,
            observables: observables.map(|(one, base)| ObservableEntry::of(one, *base)).collect(),
            mechanisms: map.mechanisms.iter().map(row).collect(),
        }
    }
}

impl ObservableEntry {
    fn of(one: &Observable, base: Option<f64>) -> Self {
        let number = |x: f64| in_unit(one.quantity, x);
        ObservableEntry {
            family: one.family.clone(),
            quantity: one.quantity.name(),
            tilt_deg: one.tilt.map(tidy_degrees),
            unit: unit(one.quantity),
            readings: one.readings,
            bounds_only: one.bounds_only,
            without: base.map(number),
            measurement_error: number(one.measurement),
            scatter: number(one.scatter),
            error: number(one.error()),
        }
    }

    /// Name as people read it: quantity, and tilt if it has one.
    pub fn words(&self) -> String {
        let bound = if self.bounds_only { " (bound)" } else { "" };
        match self.tilt_deg {
            Some(tilt) => format!("{} {} at {tilt} deg{bound}", self.family, self.short()),
            None => format!("{} {}{bound}", self.family, self.short()),
        }
    }

    /// The quantity, in the words of a column's head.
    pub fn short(&self) -> &'static str {
        match MeasuredQuantity::named(self.quantity) {
            Some(MeasuredQuantity::CollapseAngle) => "angle",
            Some(MeasuredQuantity::DisplacementMean) => "mean",
            Some(MeasuredQuantity::DisplacementCentreMinusEnds) => "centre-ends",
            Some(MeasuredQuantity::DisplacementLeft) => "left",
            Some(MeasuredQuantity::DisplacementCentre) => "centre",
            Some(MeasuredQuantity::DisplacementRight) => "right",
            Some(MeasuredQuantity::RemainderMean) => "mean, back",
            Some(MeasuredQuantity::RemainderCentreMinusEnds) => "centre-ends, back",
            Some(MeasuredQuantity::RemainderLeft) => "left, back",
            Some(MeasuredQuantity::RemainderCentre) => "centre, back",
            Some(MeasuredQuantity::RemainderRight) => "right, back",
            Some(MeasuredQuantity::SpecimenWeight) => "weight",
            _ => self.quantity,
        }
    }
}

fn row(effect: &Effect, described: Option<&Described>, observables: &[Observable]) -> MechanismEntry {
    let unit_of = |key: &str| {
        let parameters = described.iter().flat_map(|one| &one.parameters);
        parameters.clone().find(|p| p.key == key).map_or("1", |p| p.unit)
    };
    let parameter = |&(key, value): &(&'static str, f64)| ParameterEntry { key, value, unit: unit_of(key) };
    MechanismEntry {
        mechanism: effect.mechanism,
        what: described.map_or("", |one| one.what),
        parameters: effect.values.iter().map(parameter).collect(),
        sight: effect.sight(),
        cells: effect
            .cells
            .iter()
            .zip(observables)
            .map(|(cell, o)| CellEntry::of(cell, o.quantity))
            .collect(),
    }
}

impl CellEntry {
    fn of(cell: &Cell, quantity: MeasuredQuantity) -> Self {
        let number = |x: f64| in_unit(quantity, x);
        let change: Option<&Change> = if let Cell::Change(change) = cell { Some(change) } else { None };
        let value = |of: fn(&Change) -> Option<Estimate>| change.and_then(of);
        CellEntry {
            outcome: match cell {
                Cell::Change(_) => "change",
                Cell::FellBefore => "collapsed before the reading",
                Cell::NeverReached => "collapsed before the reading without it as well",
                Cell::OnlyWith => "reaches the reading only with it",
                Cell::Stood => "stood to the end of the load path",
                Cell::Lost => "not solved",
                Cell::NotApplicable(_) => "not applicable",
            },
            note: if let Cell::NotApplicable(why) = cell { Some(why) } else { None },
            sight: cell.sight(),
            change: value(|c| Some(c.value)).and_then(|e| e.value).map(number),
            change_ci: value(|c| Some(c.value)).and_then(|e| e.interval).map(|ci| ci.map(number)),
            in_measurement_errors: value(|c| c.in_measurement_errors).and_then(|e| e.value),
            in_errors: value(|c| c.in_errors).and_then(|e| e.value),
            in_errors_ci: value(|c| c.in_errors).and_then(|e| e.interval),
            pairs: change.map_or(0, |c| c.pairs),
            fell_before: change.map_or(0, |c| c.fell_before),
        }
    }

    /// What stands in the cell: the change in errors (with a mark where its interval includes 0), or the outcome's short name.
    pub fn shown(&self) -> String {
        match (self.outcome, self.in_errors) {
            ("change", Some(errors)) => {
                let unsure = self.in_errors_ci.is_none_or(|[low, high]| low <= 0.0 && high >= 0.0);
                // A change of exactly 0 is no estimate of anything else.
                let mark = if unsure && errors != 0.0 { "~" } else { "" };
                let rounded = format!("{errors:+.1}");
                let shown =
                    if ["+0.0", "-0.0"].contains(&rounded.as_str()) { "0".to_string() } else { rounded };
                format!("{mark}{shown}")
            }
            ("change", None) => "-".to_string(),
            ("collapsed before the reading", _) => "falls".to_string(),
            ("collapsed before the reading without it as well", _) => "fallen".to_string(),
            ("reaches the reading only with it", _) => "stands".to_string(),
            ("stood to the end of the load path", _) => "end".to_string(),
            ("not applicable", _) => "n/a".to_string(),
            _ => "lost".to_string(),
        }
    }
}

impl MechanismEntry {
    /// The parameters in one line.
    pub fn strength(&self) -> String {
        let one = |p: &ParameterEntry| {
            let unit = if p.unit == "1" { String::new() } else { format!(" {}", p.unit) };
            format!("{} {}{unit}", p.key, crate::render::number::significant(p.value, 3))
        };
        self.parameters.iter().map(one).collect::<Vec<_>>().join(", ")
    }
}
