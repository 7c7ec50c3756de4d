//! The figure: what the mechanism bears against what the ground asks, over the displacement of the oscillator.

use std::f64::consts::PI;

use crate::render::axes::{Axes, Axis};
use crate::render::chart::{Chart, Mark, Series};
use crate::solve::STANDARD_GRAVITY;
use crate::verb::analyse::verify::work::Checked;
use crate::verify::{ByDisplacement, Place, Spectrum};

/// Points of the spectrum, and its longest period where nothing is longer (s).
const POINTS: u32 = 300;
const LONGEST: f64 = 4.0;

/// The capacity curve, the spectra with their damping, and the limit states.
pub(super) fn figure(
    checked: &Checked,
    (code, place): (&str, &Place),
    spectra: &[(&str, &Spectrum, f64)],
) -> Chart {
    let (curve, verified) = (&checked.curve, &checked.verified);
    let in_g = |a: f64| a / STANDARD_GRAVITY;
    let line: Vec<(f64, f64)> = curve.points().iter().map(|[d, a]| (1e3 * d, in_g(*a))).collect();
    let furthest = 1.05 * 1e3 * verified.d0;
    let spectrum = |(index, (name, spectrum, damping)): (usize, &(&str, &Spectrum, f64))| {
        let periods = (1..=POINTS).map(|k| LONGEST * f64::from(k) / f64::from(POINTS));
        let point = |period: f64| {
            let a = place.acceleration(spectrum, period, *damping);
            (1e3 * a * period * period / (4.0 * PI * PI), in_g(a))
        };
        let line = periods.map(point).filter(|(d, _)| *d <= furthest).collect();
        Series {
            index: index + 2,
            label: format!("{name}: the ground, {damping} % of damping"),
            marks: vec![Mark::Line(line)],
        }
    };
    let state = |own: &ByDisplacement| curve.at(own.capacity).map(|a| (1e3 * own.capacity, in_g(a)));
    let states: Vec<(f64, f64)> = verified.nonlinear.iter().filter_map(state).collect();
    let mut series = vec![
        Series { index: 0, label: "the mechanism".to_owned(), marks: vec![Mark::Line(line)] },
        Series {
            index: 1,
            label: "displacements that the code allows".to_owned(),
            marks: vec![Mark::Markers(states)],
        },
    ];
    series.extend(spectra.iter().enumerate().map(spectrum));
    let highest = series.iter().flat_map(|own| &own.marks).fold(0.0, |most: f64, mark| match mark {
        Mark::Line(points) => points.iter().map(|(_, a)| *a).fold(most, f64::max),
        _ => most,
    });
    Chart {
        caption: code.to_owned(),
        axes: Axes {
            x: Axis::new("spectral displacement (mm)", [0.0, furthest], 10),
            y: Axis::new("spectral acceleration (g)", [0.0, 1.1 * highest], 8),
        },
        series,
        remarks: Vec::new(),
    }
}
