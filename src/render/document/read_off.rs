//! Numbers behind a figure, for the page's script to draw them so that values can be read off. The drawing stays for print, and for
//! browsers without scripts.

use serde::Serialize;

/// The script with the library that it needs, and the library's style.
pub const READER: &str = include_str!("read_off/chart.min.js");
/// See [`READER`].
pub const READER_STYLE: &str = include_str!("read_off/chart.min.css");

/// Lines over one axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReadOff {
    /// The axis across.
    pub x: Scale,
    /// The axis upwards.
    pub y: Scale,
    /// The lines.
    pub lines: Vec<Trace>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scale {
    /// What it shows, with its unit.
    pub label: String,
    /// Whether it goes by powers.
    pub log: bool,
}

/// A line; all its lists are as long as the first one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trace {
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
    /// Number of its colour, that of its arm in the drawing; left out where lines are numbered as they come.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<usize>,
}

impl Scale {
    /// An axis that goes by equal differences.
    pub fn of(label: impl Into<String>) -> Scale {
        Scale { label: label.into(), log: false }
    }

    /// The same by powers.
    pub fn by_powers(self) -> Scale {
        Scale { log: true, ..self }
    }
}

impl Trace {
    /// A line through points, each with its value and the ends of its band.
    pub fn through(
        name: impl Into<String>,
        points: impl IntoIterator<Item = (f64, Option<f64>, Option<[f64; 2]>)>,
    ) -> Trace {
        let points: Vec<_> = points.into_iter().collect();
        let has_band = points.iter().any(|(.., band)| band.is_some());
        let end = |end: usize| -> Vec<Option<f64>> {
            let ends = points.iter().map(|(.., band)| band.map(|ends| ends[end]));
            if has_band { ends.collect() } else { Vec::new() }
        };
        Trace {
            name: name.into(),
            x: points.iter().map(|(x, ..)| *x).collect(),
            y: points.iter().map(|(_, y, _)| *y).collect(),
            low: end(0),
            high: end(1),
            steps: false,
            colour: None,
        }
    }
}

impl ReadOff {
    /// The numbers of lines of which some has a point.
    pub fn with(x: Scale, y: Scale, lines: impl Iterator<Item = Trace>) -> Option<ReadOff> {
        let lines: Vec<Trace> = lines.filter(|line| !line.x.is_empty()).collect();
        (!lines.is_empty()).then_some(ReadOff { x, y, lines })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_a_band_where_any_of_its_points_has_one() {
        let line = Trace::through("a", [(1.0, Some(2.0), Some([1.5, 2.5])), (2.0, None, None)]);
        assert_eq!((line.low, line.high), (vec![Some(1.5), None], vec![Some(2.5), None]));
        let bare = Trace::through("b", [(1.0, Some(2.0), None)]);
        assert_eq!(
            serde_json::to_string(&bare).expect("it is finite"),
            r#"{"name":"b","x":[1.0],"y":[2.0],"steps":false}"#
        );
        let axis = || Scale::of("x");
        assert_eq!(ReadOff::with(axis(), axis(), [Trace::through("none", [])].into_iter()), None);
    }
}
