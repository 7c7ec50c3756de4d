//! How arms are told apart: a colour and a marker each.
//!
//! Colours are those of Okabe and Ito, told apart with the common colour vision deficiencies; every arm has its own
//! marker as well, so that the figure survives a print in grey.

use plotters::element::{DynElement, IntoDynElement};
use plotters::prelude::*;

/// Okabe and Ito's palette without yellow, which is hard to see on white.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(0, 0, 0),
];
/// Corners of the markers (pixels); an empty one is a circle.
const MARKERS: [&[(i32, i32)]; 4] = [
    &[(-5, -5), (5, -5), (5, 5), (-5, 5)],
    &[(0, -7), (7, 5), (-7, 5)],
    &[],
    &[(0, -7), (7, 0), (0, 7), (-7, 0)],
];
/// Radius of the round marker (pixels).
const RADIUS: i32 = 6;
/// A hollow marker is larger by half, so that it shows around a filled one in the same place.
const HOLLOW: [i32; 2] = [3, 2];

/// The colour of the arm with this number.
pub fn colour(index: usize) -> RGBColor {
    COLOURS[index % COLOURS.len()]
}

/// The marker of the arm with this number.
pub fn filled<'m, DB: DrawingBackend + 'm, C: Clone + 'm>(
    at: C,
    index: usize,
    scale: u32,
) -> DynElement<'m, DB, C> {
    let (style, px) = (colour(index).filled(), scale as i32);
    match corners(index, px) {
        None => (EmptyElement::at(at) + Circle::new((0, 0), RADIUS * px, style)).into_dyn(),
        Some(corners) => (EmptyElement::at(at) + Polygon::new(corners, style)).into_dyn(),
    }
}

/// The outline of that marker, larger; an edge each, as a bent line of this width would be drawn with spikes.
pub fn hollow<'m, DB: DrawingBackend + 'm, C: Clone + 'm>(
    at: C,
    index: usize,
    scale: u32,
) -> Vec<DynElement<'m, DB, C>> {
    let (style, px) =
        (colour(index).stroke_width(2 * scale), |length: i32| length * HOLLOW[0] * scale as i32 / HOLLOW[1]);
    let Some(corners) = corners(index, 1) else {
        return vec![(EmptyElement::at(at) + Circle::new((0, 0), px(RADIUS), style)).into_dyn()];
    };
    let corners: Vec<(i32, i32)> = corners.into_iter().map(|(x, y)| (px(x), px(y))).collect();
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges
        .map(|(&a, &b)| (EmptyElement::at(at.clone()) + PathElement::new([a, b], style)).into_dyn())
        .collect()
}

/// The corners of a marker; `None` for the round one.
fn corners(index: usize, px: i32) -> Option<Vec<(i32, i32)>> {
    let corners = MARKERS[index % MARKERS.len()];
    (!corners.is_empty()).then(|| corners.iter().map(|(x, y)| (x * px, y * px)).collect())
}
