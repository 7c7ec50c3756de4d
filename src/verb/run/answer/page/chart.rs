//! Numbers behind a figure, for the page's script to draw them so that values can be read off. The drawing stays for print, and for
//! browsers without scripts.

use serde::Serialize;

use crate::ensemble::Quantity;
use crate::render::number::compact;
use crate::verb::run::answer::drift::DriftCurve;
use crate::verb::run::answer::figure::{Curve, Ladder};
use crate::verb::run::answer::force_drift::ForceCurve;

/// The script with the library that it needs, and the library's style.
pub const READER: &str = include_str!("chart/chart.min.js");
/// See [`READER`].
pub const READER_STYLE: &str = include_str!("chart/chart.min.css");

/// Lines over one axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chart {
    /// The axis across.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// The lines.
    pub lines: Vec<Line>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// What it shows, with its unit.
    pub label: String,
    /// Whether it goes by powers.
    pub log: bool,
}

/// A line; all its lists are as long as the first one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// What the legend calls it.
    pub name: String,
    /// Where its points are, ascending.
    pub x: Vec<f64>,
    /// Its values; null where there is none.
    pub y: Vec<Option<f64>>,
    /// The lower ends of its band; left out where it has none anywhere.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub low: Vec<Option<f64>>,
    /// The upper ends.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub high: Vec<Option<f64>>,
    /// Whether it goes by steps.
    pub steps: bool,
}

impl Axis {
    /// An axis that goes by equal differences.
    pub fn of(label: impl Into<String>) -> Axis {
        Axis { label: label.into(), log: false }
    }

    /// The same by powers.
    pub fn by_powers(self) -> Axis {
        Axis { log: true, ..self }
    }
}

impl Line {
    /// A line through points, each with its value and the ends of its band.
    pub fn through(
        name: impl Into<String>,
        points: impl IntoIterator<Item = (f64, Option<f64>, Option<[f64; 2]>)>,
    ) -> Line {
        let points: Vec<_> = points.into_iter().collect();
        let has_band = points.iter().any(|(.., band)| band.is_some());
        let end = |end: usize| -> Vec<Option<f64>> {
            let ends = points.iter().map(|(.., band)| band.map(|ends| ends[end]));
            if has_band { ends.collect() } else { Vec::new() }
        };
        Line {
            name: name.into(),
            x: points.iter().map(|(x, ..)| *x).collect(),
            y: points.iter().map(|(_, y, _)| *y).collect(),
            low: end(0),
            high: end(1),
            steps: false,
        }
    }
}

impl Chart {
    /// Means over the stiffness of the joints, with their intervals.
    pub fn of_curves(curves: &[Curve]) -> Option<Chart> {
        let axis = curves.first()?.quantity.axis();
        let line = |curve: &Curve| {
            Line::through(&curve.arm, curve.points.iter().map(|point| (point.kn, point.mean, point.mean_ci)))
        };
        Chart::with(Axis::of("kn (Pa/m)").by_powers(), Axis::of(axis), curves.iter().map(line))
    }

    /// Shares of walls that have failed over the level, with the interval at each level alone.
    pub fn of_ladders(ladders: &[Ladder], quantity: Quantity) -> Option<Chart> {
        let line = |ladder: &Ladder| {
            let band = |ends: [f64; 2]| ladder.random.then_some(ends);
            let steps =
                ladder.steps.iter().map(|step| (step.value, Some(step.probability), band(step.pointwise)));
            Line { steps: true, ..Line::through(&ladder.arm, steps) }
        };
        Chart::with(Axis::of(quantity.axis()), Axis::of("share of walls"), ladders.iter().map(line))
    }

    /// Mean push over the drift (kN, %), with the band that one more wall lies in.
    pub fn of_forces(curves: &[ForceCurve]) -> Option<Chart> {
        let kilo = |x: f64| 1e-3 * x;
        let line = |curve: &ForceCurve| {
            let points = curve.points.iter().map(|point| {
                let band = point.low.value.zip(point.high.value).filter(|_| curve.random);
                (
                    point.drift_percent,
                    point.mean.value.map(kilo),
                    band.map(|(low, high)| [low, high].map(kilo)),
                )
            });
            Line::through(format!("{}, kn {}", curve.arm, compact(curve.kn)), points)
        };
        Chart::with(Axis::of("drift (%)"), Axis::of("push (kN)"), curves.iter().map(line))
    }

    /// Drift over the length of the wall, with its interval.
    pub fn of_drifts(curves: &[DriftCurve]) -> Option<Chart> {
        let line = |curve: &DriftCurve| {
            let points = curve.points.iter().map(|point| (point.slenderness, point.drift, point.interval));
            Line::through(format!("{}, kn {}", curve.curve, compact(curve.kn)), points)
        };
        Chart::with(Axis::of("length over height"), Axis::of("drift (mm/m)"), curves.iter().map(line))
    }

    /// The chart of lines of which some has a point.
    pub fn with(x: Axis, y: Axis, lines: impl Iterator<Item = Line>) -> Option<Chart> {
        let lines: Vec<Line> = lines.filter(|line| !line.x.is_empty()).collect();
        (!lines.is_empty()).then_some(Chart { x, y, lines })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_a_band_where_any_of_its_points_has_one() {
        let line = Line::through("a", [(1.0, Some(2.0), Some([1.5, 2.5])), (2.0, None, None)]);
        assert_eq!((line.low, line.high), (vec![Some(1.5), None], vec![Some(2.5), None]));
        let bare = Line::through("b", [(1.0, Some(2.0), None)]);
        assert_eq!(
            serde_json::to_string(&bare).expect("it is finite"),
            r#"{"name":"b","x":[1.0],"y":[2.0],"steps":false}"#
        );
        let axis = || Axis::of("x");
        assert_eq!(Chart::with(axis(), axis(), [Line::through("none", [])].into_iter()), None);
    }
}
