//! The signs of a family's figure: a reading, a bound, the line of a cause.

use plotters::element::{DynElement, IntoDynElement};
use plotters::prelude::*;

use crate::render::marker::colour;
use crate::render::pen::Pen;

/// Lengths of the dashes of causes and of their gaps (pixels at scale 1).
const DASHES: [[i32; 2]; 3] = [[12, 7], [5, 5], [20, 5]];

/// A reading: a point, or for a bound a bar with an arrow towards where the value lies (pixels to the right and down).
pub fn reading<'m, DB: DrawingBackend + 'm, C: Clone + 'm>(
    at: C,
    towards: Option<(i32, i32)>,
    pen: Pen,
) -> Vec<DynElement<'m, DB, C>> {
    let line = BLACK.stroke_width(2 * pen.scale);
    let Some((x, y)) = towards else {
        return vec![(EmptyElement::at(at) + Circle::new((0, 0), pen.px(4), BLACK.filled())).into_dyn()];
    };
    let along = |far: i32, side: i32| (pen.px(far * x + side * y), pen.px(far * y + side * x));
    let path =
        |ends: [(i32, i32); 2]| (EmptyElement::at(at.clone()) + PathElement::new(ends, line)).into_dyn();
    let head = Polygon::new([along(20, 0), along(11, 4), along(11, -4)], BLACK.filled());
    vec![
        path([along(0, -5), along(0, 5)]),
        path([along(0, 0), along(12, 0)]),
        (EmptyElement::at(at.clone()) + head).into_dyn(),
    ]
}

/// Lengths of the dashes of a cause and of their gaps (pixels), and their style.
pub fn dashes(cause: usize, pen: Pen) -> ([i32; 2], ShapeStyle) {
    (DASHES[cause % DASHES.len()].map(|x| pen.px(x)), colour(cause + 1).stroke_width(3 * pen.scale))
}
