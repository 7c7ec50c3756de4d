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
            return compact(x);
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

    /// By powers: 1, 2 and 5 of every decade, or the powers alone where these are too many.
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
        if all.len() > hint.max_num_points() { within(&[1]) } else { all }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decade_has_three_labels_and_many_decades_have_one_each() {
        let labels = |ends: [f64; 2]| {
            let axis = Axis::by_powers("kn", ends, 8);
            axis.key_points(axis.labels).into_iter().map(|x| axis.label(x)).collect::<Vec<_>>()
        };
        assert_eq!(labels([0.9e7, 1.1e8]), ["1e7", "2e7", "5e7", "1e8"]);
        assert_eq!(labels([1e-4, 1.0]), ["1e-4", "1e-3", "1e-2", "1e-1", "1e0"]);
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
