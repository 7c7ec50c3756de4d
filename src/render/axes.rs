//! The axes of a chart: ends, titles, ticks, the digits of their labels; and the sizes that charts share.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::math::{ln, pow};
use crate::render::number::compact;
use crate::render::pen::Pen;

/// Width, and height without the legend (pixels at scale 1).
pub(crate) const WIDTH: u32 = 960;
pub(crate) const PLOT_HEIGHT: u32 = 560;
/// Transparency of a band.
pub(crate) const BAND_ALPHA: f64 = 0.18;

/// What marks are drawn on.
pub(crate) type Plane<'a, DB> = ChartContext<'a, DB, Cartesian2d<Axis, Axis>>;

/// One axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Axis {
    /// What it shows, with its unit.
    pub title: String,
    /// The values at its ends.
    pub ends: [f64; 2],
    /// So many labels at most; 0 of an axis that is not drawn.
    pub labels: usize,
    /// Whether it goes by powers of ten.
    pub is_log: bool,
}

impl Axis {
    /// An axis that goes by equal differences.
    pub fn new(title: impl Into<String>, ends: [f64; 2], labels: usize) -> Axis {
        Axis { title: title.into(), ends, labels, is_log: false }
    }

    /// An axis that goes by powers of ten.
    pub fn by_powers(title: impl Into<String>, ends: [f64; 2], labels: usize) -> Axis {
        Axis { is_log: true, ..Axis::new(title, ends, labels) }
    }

    /// A number, or its logarithm where the axis goes by powers.
    fn place(&self, x: f64) -> f64 {
        if self.is_log { ln(x) } else { x }
    }

    /// The axis of those.
    fn places(&self) -> RangedCoordf64 {
        (self.place(self.ends[0])..self.place(self.ends[1])).into()
    }

    fn label(&self, x: f64) -> String {
        if self.is_log {
            return engineering(x);
        }
        let digits = decimals(self.ends[1] - self.ends[0]);
        // What rounds to 0 from below has no sign.
        let x = if x.abs() < 0.5 * pow(0.1, digits as f64) { 0.0 } else { x };
        format!("{x:.digits$}")
    }
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, pixels: (i32, i32)) -> i32 {
        self.places().map(&self.place(*value), pixels)
    }

    /// By powers: 1, 2 and 5 of every decade, or the powers alone where these are too many; round numbers where the axis is too short for two
    /// of them.
    fn key_points<H: KeyPointHint>(&self, hint: H) -> Vec<f64> {
        if !self.is_log {
            return self.places().key_points(hint);
        }
        let [low, high] = self.ends;
        let within = |digits: &[i32]| -> Vec<f64> {
            let decades = exponent(low)..=exponent(high);
            let all = decades
                .flat_map(|power| digits.iter().filter_map(move |k| format!("{k}e{power}").parse().ok()));
            all.filter(|x| (low..=high).contains(x)).collect()
        };
        let all = within(&[1, 2, 5]);
        match all.len() {
            0 | 1 => RangedCoordf64::from(low..high).key_points(hint),
            many if many > hint.max_num_points() => within(&[1]),
            _ => all,
        }
    }

    fn range(&self) -> Range<f64> {
        self.ends[0]..self.ends[1]
    }
}

/// Both axes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Axes {
    /// Across.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
}

impl Axes {
    /// Draws frame, grid and labels below a caption in letters of a size; `left` is the width of the labels on the left.
    pub fn on<'a, DB: DrawingBackend>(
        &self,
        area: &'a DrawingArea<DB, Shift>,
        pen: Pen,
        caption: (&str, i32),
        left: i32,
    ) -> Result<Plane<'a, DB>, DrawingAreaErrorKind<DB::ErrorType>> {
        let mut plane = pen.frame(area, caption, left).build_cartesian_2d(self.x.clone(), self.y.clone())?;
        let (across, upwards) = (|x: &f64| self.x.label(*x), |y: &f64| self.y.label(*y));
        let mut mesh = plane.configure_mesh();
        pen.grid(&mut mesh)
            .x_labels(self.x.labels)
            .y_labels(self.y.labels)
            .x_label_formatter(&across)
            .y_label_formatter(&upwards)
            .x_desc(&self.x.title)
            .y_desc(&self.y.title);
        if self.y.labels == 0 {
            mesh.disable_y_mesh().disable_y_axis();
        }
        mesh.draw()?;
        Ok(plane)
    }
}

/// Decimals that tell the ticks of an axis of this length apart.
pub(crate) fn decimals(length: f64) -> usize {
    (1 - exponent(length)).max(0) as usize
}

/// The power of ten of a positive number, read off its decimal form (exact, unlike a logarithm).
pub(crate) fn exponent(x: f64) -> i32 {
    format!("{x:e}").split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}

/// Numbers from here up to the next bound are written out, others with a power of ten.
const WRITTEN_OUT: [f64; 2] = [1e-3, 1e5];

/// A number as engineers write it: `200`, `0.05`, `10⁷`, `2·10⁷`.
fn engineering(x: f64) -> String {
    let text = compact(x);
    match text.split_once('e') {
        Some((digits, power)) if !(WRITTEN_OUT[0]..WRITTEN_OUT[1]).contains(&x) => {
            let ten = format!("10{}", superscript(power.parse().unwrap_or(0)));
            if digits == "1" { ten } else { format!("{digits}\u{b7}{ten}") }
        }
        // The shortest decimal of what is read back has no zeros behind its digits.
        _ => text.parse::<f64>().map_or(text, |short| short.to_string()),
    }
}

/// An integer in superscript digits.
pub(crate) fn superscript(number: i32) -> String {
    number
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '\u{207b}',
            '1' => '\u{b9}',
            '2' => '\u{b2}',
            '3' => '\u{b3}',
            digit => char::from_u32(0x2070 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
        })
        .collect()
}

/// Units at the end of keys, the longest ones first, and how they are written.
const UNITS: [(&str, &str); 7] = [
    ("_kg_per_m3", "kg/m\u{b3}"),
    ("_pa_per_m", "Pa/m"),
    ("_pa", "Pa"),
    ("_deg", "deg"),
    ("_m", "m"),
    ("_n", "N"),
    ("_s", "s"),
];

/// What the axis over a key is called: `joint.phi_deg` is the `friction angle (deg)`.
pub(crate) fn over_key(key: &str) -> String {
    let name = key.rsplit('.').next().unwrap_or(key);
    let unit = UNITS.iter().find_map(|(end, unit)| Some((name.strip_suffix(end)?, *unit)));
    let (bare, unit) = unit.unwrap_or((name, ""));
    let words = match bare {
        "phi" => "friction angle".to_owned(),
        "kn" => "joint stiffness kn".to_owned(),
        "ks" => "shear stiffness of joints ks".to_owned(),
        other => other.replace('_', " "),
    };
    if unit.is_empty() { words } else { format!("{words} ({unit})") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decade_has_three_labels_and_many_decades_have_one_each() {
        let labels = |ends: [f64; 2]| {
            let axis = Axis::by_powers("kn", ends, 8);
            axis.key_points(axis.labels).into_iter().map(|x| axis.label(x)).collect::<Vec<_>>()
        };
        assert_eq!(
            labels([0.9e7, 1.1e8]),
            ["10\u{2077}", "2\u{b7}10\u{2077}", "5\u{b7}10\u{2077}", "10\u{2078}"]
        );
        assert_eq!(labels([1e-4, 1.0]), ["10\u{207b}\u{2074}", "0.001", "0.01", "0.1", "1"]);
        assert_eq!(labels([20.0, 600.0]), ["20", "50", "100", "200", "500"]);
        // No power of ten, nor twice or five times one, lies between: round numbers do.
        let short = labels([2.9e7, 4.1e7]);
        assert!(
            ["3", "4"].iter().all(|digit| short.contains(&format!("{digit}\u{b7}10\u{2077}"))),
            "{short:?}"
        );
    }

    #[test]
    fn an_axis_over_a_key_is_called_by_words() {
        let keys = [
            "phi_deg",
            "joint.kn_pa_per_m",
            "wall.base_thickness_m",
            "arm.a.density_kg_per_m3",
            "header_share",
        ];
        assert_eq!(
            keys.map(over_key),
            [
                "friction angle (deg)",
                "joint stiffness kn (Pa/m)",
                "base thickness (m)",
                "density (kg/m\u{b3})",
                "header share"
            ]
        );
    }

    #[test]
    fn zero_has_no_sign() {
        let axis = Axis::new("mm", [-0.1, 0.2], 8);
        assert_eq!([-1e-17, -0.05, 0.15].map(|x| axis.label(x)), ["0.00", "-0.05", "0.15"]);
    }

    #[test]
    fn a_power_in_the_middle_of_two_lies_in_the_middle() {
        let axis = Axis::by_powers("p", [0.01, 1.0], 8);
        assert_eq!([0.01, 0.1, 1.0].map(|x| axis.map(&x, (100, 300))), [100, 200, 300]);
    }
}
