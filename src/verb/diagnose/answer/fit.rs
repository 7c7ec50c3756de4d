//! The base model at its best fit beside the best cause, on the readings: numbers of the first figure of a verdict and of its table.

use crate::critic::{Band, FamilyCurves, Residuals};
use crate::stats;
use crate::study::{Described, Study};
use crate::verb::diagnose::answer::family::{FamilyFigure, Mark, Panel};

/// So many families are drawn, those that the base model misses most.
const FAMILIES: usize = 4;
/// A band of nine in ten of a normal distribution is so many standard deviations wide.
const NINE_IN_TEN: f64 = 3.29;

/// Both models on the readings.
#[derive(Clone, Debug, PartialEq)]
pub struct FitFigure {
    /// The best cause, or both of a pair: names and plain titles. None where nothing was found.
    pub causes: Vec<(&'static str, &'static str)>,
    /// Whether the verdict speaks of it; else it was examined, and does not explain the readings.
    pub in_verdict: bool,
    /// A row per family.
    pub rows: Vec<FitRow>,
}

/// A family under both models: what was read that the base model misses most, and the collapse angles.
#[derive(Clone, Debug, PartialEq)]
pub struct FitRow {
    /// Under the base model with fitted joints.
    pub base: FamilyFigure,
    /// Under the cause.
    pub cause: Option<FamilyFigure>,
}

/// How far readings lie from the walls of the two models: the root of the mean square of their distance from the median, in standard
/// deviations of these walls and of the readings' errors together. About 1 where a model is right.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    /// Family and quantity.
    pub what: String,
    /// Readings that have a value and lie where walls of both models stand.
    pub readings: usize,
    /// Of the base model with fitted joints.
    pub base: f64,
    /// Of the cause.
    pub cause: Option<f64>,
}

impl FitFigure {
    /// From the curves of both models.
    pub fn of(
        study: &Study,
        mechanisms: &[Described],
        residuals: &Residuals,
        base: &[FamilyCurves],
        cause: Option<&(Vec<usize>, Vec<FamilyCurves>)>,
        in_verdict: bool,
    ) -> FitFigure {
        let figures = |curves: &[FamilyCurves]| FamilyFigure::all(study, mechanisms, residuals, curves, &[]);
        let caused = cause.map_or_else(Vec::new, |(_, curves)| figures(curves));
        let row = |base: FamilyFigure| {
            let cause = caused.iter().find(|own| own.family == base.family).cloned();
            FitRow { base, cause }.with_one_panel()
        };
        let mut rows: Vec<FitRow> = figures(base).into_iter().map(row).collect();
        let off = |row: &FitRow| row.misfits().iter().map(|own| own.base).fold(0.0, f64::max);
        rows.sort_by(|a, b| off(b).total_cmp(&off(a)));
        rows.truncate(FAMILIES);
        let names = cause.map_or(&[][..], |(causes, _)| causes);
        FitFigure {
            causes: names.iter().map(|own| (mechanisms[*own].name, mechanisms[*own].title)).collect(),
            in_verdict,
            rows,
        }
    }

    /// What the figure shows.
    pub fn caption(&self) -> String {
        let right = match (self.causes.is_empty(), self.in_verdict) {
            (true, _) => "",
            (_, true) => " Right: with the cause.",
            (_, false) => " Right: with the cause that fits best, which does not explain them.",
        };
        format!(
            "What was measured on the walls of two models. Left: the base model with joints fitted to the readings.{right} Of each family \
             the quantity is shown that the base model misses most."
        )
    }

    /// How far off both are, family by family.
    pub fn misfits(&self) -> Vec<Misfit> {
        self.rows.iter().flat_map(FitRow::misfits).collect()
    }
}

impl FitRow {
    /// Of the quantities over the tilt or the drift, that one alone which the base model misses most.
    fn with_one_panel(mut self) -> FitRow {
        let off = |panel: &&Panel| of_marks(&panel.marks, &at(panel)).map_or(0.0, |(off, _)| off);
        let most = self.base.panels.iter().max_by(|a, b| off(a).total_cmp(&off(b)));
        let Some(words) = most.map(|panel| panel.words) else { return self };
        for figure in std::iter::once(&mut self.base).chain(&mut self.cause) {
            figure.panels.retain(|panel| panel.words == words);
        }
        self
    }

    fn misfits(&self) -> Vec<Misfit> {
        let panel = self.base.panels.first().and_then(|base| {
            let cause = self.cause.as_ref().and_then(|own| own.panels.first());
            let bands = (at(base), cause.map(at));
            misfit(
                &self.base.family,
                base.words,
                &base.marks,
                (&bands.0, bands.1.as_ref().map(|own| own as _)),
            )
        });
        let strip = self.base.collapse.as_ref().and_then(|(base, _)| {
            let cause = self.cause.as_ref().and_then(|own| own.collapse.as_ref()).map(|(band, _)| *band);
            let (base, cause) = (|_: f64| Some(*base), cause.map(|band| move |_: f64| Some(band)));
            let cause = cause.as_ref().map(|own| own as &dyn Fn(f64) -> Option<Band>);
            misfit(&self.base.family, "collapse angle", &self.base.angles, (&base, cause))
        });
        panel.into_iter().chain(strip).collect()
    }
}

/// The band of a panel at a tilt or a drift, between those that are known; `None` beyond them.
fn at(panel: &Panel) -> impl Fn(f64) -> Option<Band> + '_ {
    move |place: f64| {
        let above = panel.bands.iter().position(|(end, _)| *end >= place - 1e-9)?;
        let (high, upper) = panel.bands[above];
        let Some((low, lower)) = above.checked_sub(1).map(|below| panel.bands[below]) else {
            return Some(upper);
        };
        let share = ((place - low) / (high - low)).clamp(0.0, 1.0);
        let between = |a: f64, b: f64| (1.0 - share) * a + share * b;
        let pair = |a: [f64; 2], b: [f64; 2]| [between(a[0], b[0]), between(a[1], b[1])];
        Some(Band {
            median: between(lower.median, upper.median),
            half: pair(lower.half, upper.half),
            most: pair(lower.most, upper.most),
        })
    }
}

/// The root of the mean square distance of marks from bands, and how many of them have one.
fn of_marks(marks: &[Mark], band: &dyn Fn(f64) -> Option<Band>) -> Option<(f64, usize)> {
    let square = |mark: &Mark| {
        let band = band(mark.at).filter(|_| mark.bound.is_none())?;
        let walls = (band.most[1] - band.most[0]) / NINE_IN_TEN;
        let variance = walls * walls + mark.error * mark.error;
        let off = mark.value - band.median;
        (variance > 0.0).then(|| off * off / variance)
    };
    let squares: Vec<f64> = marks.iter().filter_map(square).collect();
    Some((stats::mean(&squares)?.sqrt(), squares.len()))
}

type Bands<'b> = (&'b dyn Fn(f64) -> Option<Band>, Option<&'b dyn Fn(f64) -> Option<Band>>);

/// Of the marks that have a place in both models.
fn misfit(family: &str, quantity: &str, marks: &[Mark], (base, cause): Bands<'_>) -> Option<Misfit> {
    let both = |mark: &&Mark| base(mark.at).is_some() && cause.is_none_or(|cause| cause(mark.at).is_some());
    let marks: Vec<Mark> = marks.iter().filter(both).copied().collect();
    let (off, readings) = of_marks(&marks, base)?;
    let cause = cause.and_then(|cause| of_marks(&marks, cause)).map(|(off, _)| off);
    Some(Misfit { what: format!("{family}: {quantity}"), readings, base: off, cause })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::MeasuredKind;

    fn band(median: f64) -> Band {
        Band { median, half: [median; 2], most: [median - 0.5 * NINE_IN_TEN, median + 0.5 * NINE_IN_TEN] }
    }

    fn panel(bands: Vec<(f64, Band)>, marks: Vec<Mark>) -> Panel {
        Panel { words: "w", unit: "mm", bands, causes: Vec::new(), marks }
    }

    fn mark(at: f64, value: f64) -> Mark {
        Mark { at, value, error: 0.0, bound: None, place: 0.0 }
    }

    #[test]
    fn readings_are_measured_by_walls_and_errors_together() {
        // One standard deviation each of the walls and, in the second, of the error.
        let wide = Mark { error: 1.0, ..mark(1.0, 2.0) };
        let bound = Mark { bound: Some(MeasuredKind::Above), ..mark(1.0, 99.0) };
        let beyond = mark(3.0, 99.0);
        let own = panel(vec![(0.0, band(0.0)), (2.0, band(2.0))], vec![mark(2.0, 4.0), wide, bound, beyond]);
        let (off, readings) = of_marks(&own.marks, &at(&own)).expect("two have a place");
        // (4 - 2)^2 / 1 and (2 - 1)^2 / 2.
        assert_eq!(readings, 2);
        assert!((off - (0.5 * (4.0 + 0.5_f64)).sqrt()).abs() < 1e-12, "{off}");
    }

    #[test]
    fn both_models_are_measured_on_the_same_readings() {
        let base = panel(vec![(0.0, band(0.0)), (1.0, band(0.0))], vec![mark(0.5, 1.0), mark(1.5, 9.0)]);
        let cause = panel(vec![(0.0, band(1.0)), (2.0, band(1.0))], Vec::new());
        let (b, c) = (at(&base), at(&cause));
        let found = misfit("f", "q", &base.marks, (&b, Some(&c))).expect("one has a place in both");
        assert_eq!(found, Misfit { what: "f: q".into(), readings: 1, base: 1.0, cause: Some(0.0) });
    }
}
