//! What the figure of a family shows, in the units of its axes, before anything is drawn.

use crate::critic::{Band, FamilyCurves, Residual, Residuals, Seen};
use crate::math::degrees;
use crate::study::{Described, MeasuredKind, MeasuredQuantity, Study};

/// A family over the tilt or the drift.
#[derive(Clone, Debug, PartialEq)]
pub struct FamilyFigure {
    /// Its name.
    pub family: String,
    /// The causes that a verdict speaks of.
    pub causes: Vec<String>,
    /// What it is drawn over.
    pub over: &'static str,
    /// What was read there, quantity by quantity.
    pub panels: Vec<Panel>,
    /// The collapse angle (deg) of the base model, and its median under each cause; `None` of walls that are sheared.
    pub collapse: Option<(Band, Vec<f64>)>,
    /// The collapse angles that were measured (deg).
    pub angles: Vec<Mark>,
}

/// A quantity over the tilt (deg) or the drift (%).
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The quantity in words.
    pub words: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Where, and what the base model shows.
    pub bands: Vec<(f64, Band)>,
    /// Where, and the median under each cause.
    pub causes: Vec<Vec<(f64, f64)>>,
    /// What was measured.
    pub marks: Vec<Mark>,
}

/// A reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Tilt (deg) or drift (%); 0 of a collapse angle.
    pub at: f64,
    /// The value or the bound.
    pub value: f64,
    /// Error of the reading, one standard deviation.
    pub error: f64,
    /// Below or above where only a bound is known.
    pub bound: Option<MeasuredKind>,
    /// Place of the specimen among those of its family, about their middle.
    pub place: f64,
}

impl FamilyFigure {
    /// A figure per family that was tilted or sheared, from its curves in the base model and under the causes of the verdict.
    pub fn all(
        study: &Study,
        mechanisms: &[Described],
        residuals: &Residuals,
        base: &[FamilyCurves],
        causes: &[(Vec<usize>, Vec<FamilyCurves>)],
    ) -> Vec<FamilyFigure> {
        let figure = |curves: &FamilyCurves| {
            let own = |families: &'_ [FamilyCurves]| families.iter().position(|c| c.family == curves.family);
            let name = |causes: &[usize]| {
                causes.iter().map(|cause| mechanisms[*cause].name).collect::<Vec<_>>().join(" and ")
            };
            let causes: Vec<(String, &FamilyCurves)> =
                causes.iter().filter_map(|(causes, all)| Some((name(causes), &all[own(all)?]))).collect();
            FamilyFigure::of(study, curves, &causes, &residuals.readings)
        };
        base.iter().map(figure).collect()
    }

    fn of(
        study: &Study,
        curves: &FamilyCurves,
        causes: &[(String, &FamilyCurves)],
        readings: &[Residual],
    ) -> FamilyFigure {
        let own: Vec<&Residual> = readings.iter().filter(|r| r.family == curves.family).collect();
        let mut specimens: Vec<&str> = Vec::new();
        own.iter().map(|r| r.reading.specimen.as_str()).for_each(|name| {
            if !specimens.contains(&name) {
                specimens.push(name);
            }
        });
        let marks = |quantity: MeasuredQuantity| -> Vec<Mark> {
            let of = own.iter().filter(|r| r.reading.quantity == quantity);
            of.filter_map(|r| mark(r, &specimens)).collect()
        };
        let is_tilted = curves.collapse.is_some();
        let place = if is_tilted { degrees } else { percents };
        let shown = if is_tilted { millimetres } else { kilonewtons };
        let over = |bands: &[(f64, Band)]| -> Vec<(f64, Band)> {
            bands.iter().map(|(at, band)| (place(*at), band.map(shown))).collect()
        };
        let panels = curves.curves.iter().map(|curve| {
            let same = causes.iter().map(|(_, of)| of.curves.iter().find(|c| c.quantity == curve.quantity));
            let medians = same.map(|of| {
                let bands = of.map_or_else(Vec::new, |of| over(&of.bands));
                bands.into_iter().map(|(at, band)| (at, band.median)).collect()
            });
            Panel {
                words: words(curve.quantity),
                unit: if is_tilted { "mm" } else { "kN" },
                bands: over(&curve.bands),
                causes: medians.collect(),
                marks: marks(curve.quantity),
            }
        });
        let angles = || causes.iter().filter_map(|(_, own)| Some(degrees(own.collapse.as_ref()?.median)));
        FamilyFigure {
            family: study.arms[curves.family].name.clone(),
            causes: causes.iter().map(|(name, _)| name.clone()).collect(),
            over: if is_tilted { "tilt (deg)" } else { "drift (%)" },
            panels: panels.collect(),
            collapse: curves.collapse.as_ref().map(|band| (band.map(degrees), angles().collect())),
            angles: marks(MeasuredQuantity::CollapseAngle),
        }
    }

    /// The largest tilt or drift of all that is drawn.
    pub fn end(&self) -> f64 {
        let read = self.panels.iter().flat_map(|panel| &panel.marks).map(|mark| mark.at);
        let fell = self.angles.iter().map(|mark| mark.value + mark.error);
        let last = self.panels.iter().filter_map(|panel| panel.bands.last()).map(|(at, _)| *at);
        let (most, causes) =
            self.collapse.as_ref().map_or((0.0, &[][..]), |(band, causes)| (band.most[1], causes));
        read.chain(fell).chain(last).chain(causes.iter().copied()).fold(most, f64::max)
    }

    /// Whether some readings are only bounds.
    pub fn has_bounds(&self) -> bool {
        let marks = self.panels.iter().flat_map(|panel| &panel.marks).chain(&self.angles);
        marks.into_iter().any(|mark| mark.bound.is_some())
    }
}

/// A reading as a mark; `None` where nothing was seen.
fn mark(residual: &Residual, specimens: &[&str]) -> Option<Mark> {
    let m = &residual.reading;
    let (value, bound) = match residual.seen {
        Seen::Value(value) => (value, None),
        Seen::Beyond => (m.value, Some(m.kind)),
        Seen::Fell | Seen::Stood | Seen::Nothing => return None,
    };
    let shown = match (m.tilt, m.drift) {
        (Some(_), _) => millimetres,
        (None, Some(_)) => kilonewtons,
        (None, None) => degrees,
    };
    let place = specimens.iter().position(|name| *name == m.specimen)? as f64;
    Some(Mark {
        at: m.tilt.map(degrees).or(m.drift.map(percents)).unwrap_or(0.0),
        value: shown(value),
        error: shown(residual.error()),
        bound,
        place: place - 0.5 * (specimens.len() - 1) as f64,
    })
}

fn millimetres(x: f64) -> f64 {
    1e3 * x
}

fn kilonewtons(x: f64) -> f64 {
    1e-3 * x
}

fn percents(x: f64) -> f64 {
    100.0 * x
}

fn words(quantity: MeasuredQuantity) -> &'static str {
    match quantity {
        MeasuredQuantity::DisplacementLeft => "displacement, left end",
        MeasuredQuantity::DisplacementCentre => "displacement, centre",
        MeasuredQuantity::DisplacementRight => "displacement, right end",
        MeasuredQuantity::DisplacementMean => "displacement, mean of left, centre and right",
        MeasuredQuantity::DisplacementCentreMinusEnds => "displacement, centre less mean of the ends",
        MeasuredQuantity::RemainderLeft => "left after going back from there, left end",
        MeasuredQuantity::RemainderCentre => "left after going back from there, centre",
        MeasuredQuantity::RemainderRight => "left after going back from there, right end",
        MeasuredQuantity::RemainderMean => "left after going back from there, mean of left, centre and right",
        MeasuredQuantity::RemainderCentreMinusEnds => {
            "left after going back from there, centre less mean of the ends"
        }
        MeasuredQuantity::ForceAtDrift => "push when the wall first came to the drift",
        other => other.name(),
    }
}
