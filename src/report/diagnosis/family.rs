//! What the figure of a family shows, in the units of its axes, before anything is drawn.

use crate::critic::{Band, FamilyCurves, Residual, Residuals, Seen};
use crate::math::degrees;
use crate::study::{Described, MeasuredKind, MeasuredQuantity, Study};

/// A family over the tilt.
#[derive(Clone, Debug, PartialEq)]
pub struct FamilyFigure {
    /// Its name.
    pub family: String,
    /// The causes that a verdict speaks of.
    pub causes: Vec<String>,
    /// What was read at a tilt, quantity by quantity.
    pub panels: Vec<Panel>,
    /// The collapse angle (deg) of the base model, and its median under each cause.
    pub collapse: (Band, Vec<f64>),
    /// The collapse angles that were measured (deg).
    pub angles: Vec<Mark>,
}

/// A quantity over the tilt.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The quantity in words.
    pub words: &'static str,
    /// Tilt (deg) and what the base model shows (mm).
    pub bands: Vec<(f64, Band)>,
    /// Tilt and median under each cause.
    pub causes: Vec<Vec<(f64, f64)>>,
    /// What was measured (mm).
    pub marks: Vec<Mark>,
}

/// A reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Tilt (deg); 0 of a collapse angle.
    pub tilt: f64,
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
    /// A figure per family that was tilted, from its curves in the base model and under the causes of the verdict.
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
        let over = |bands: &[(f64, Band)]| -> Vec<(f64, Band)> {
            bands.iter().map(|(tilt, band)| (degrees(*tilt), band.map(millimetres))).collect()
        };
        let panels = curves.curves.iter().map(|curve| {
            let same = causes.iter().map(|(_, of)| of.curves.iter().find(|c| c.quantity == curve.quantity));
            let medians = same.map(|of| {
                let bands = of.map_or_else(Vec::new, |of| over(&of.bands));
                bands.into_iter().map(|(tilt, band)| (tilt, band.median)).collect()
            });
            Panel {
                words: words(curve.quantity),
                bands: over(&curve.bands),
                causes: medians.collect(),
                marks: marks(curve.quantity),
            }
        });
        let angles = causes.iter().map(|(_, curves)| degrees(curves.collapse.median));
        FamilyFigure {
            family: study.arms[curves.family].name.clone(),
            causes: causes.iter().map(|(name, _)| name.clone()).collect(),
            panels: panels.collect(),
            collapse: (curves.collapse.map(degrees), angles.collect()),
            angles: marks(MeasuredQuantity::CollapseAngle),
        }
    }

    /// The largest tilt of all that is drawn (deg).
    pub fn end(&self) -> f64 {
        let read = self.panels.iter().flat_map(|panel| &panel.marks).map(|mark| mark.tilt);
        let fell = self.angles.iter().map(|mark| mark.value + mark.error);
        let (band, causes) = &self.collapse;
        read.chain(fell).chain(causes.iter().copied()).fold(band.most[1], f64::max)
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
        Seen::Nothing => return None,
    };
    let shown = if m.tilt.is_some() { millimetres } else { degrees };
    let place = specimens.iter().position(|name| *name == m.specimen)? as f64;
    Some(Mark {
        tilt: m.tilt.map_or(0.0, degrees),
        value: shown(value),
        error: shown(residual.error()),
        bound,
        place: place - 0.5 * (specimens.len() - 1) as f64,
    })
}

fn millimetres(x: f64) -> f64 {
    1e3 * x
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
        other => other.name(),
    }
}
