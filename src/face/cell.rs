//! What each stone fills in the face: behind the lines of its joints, and within its own outline where nothing faces it.

use std::collections::BTreeMap;

use crate::face::border::Meeting;
use crate::face::joint::{Joint, outward};
use crate::face::line::{Line, dot, minus};
use crate::face::simple::straightened;
use crate::shape::{Polygon, bounds};

/// A side gives way to a joint that so many points of it face,
const FACING: usize = 3;
/// and whose direction differs by less than that of this cosine (50 degrees).
const ALONG: f64 = 0.64;
/// Cells that share no more than this share of the smaller one do not overlap: rounding.
const SHARED: f64 = 1e-9;

/// A line that bounds a stone, and the points of the stone's outline that face what is beyond it.
type Bound<'p> = (Line, &'p [[f64; 2]]);

/// Polygons of stones whose `hulls` face each other along `joints`; those that are fixed stay as they are, and nothing may be left of one. No side moves out by
/// more than `widest` (m).
pub fn cells(
    (hulls, fixed): (&[Polygon], &[bool]),
    joints: &[Joint],
    meetings: &BTreeMap<(usize, usize), Meeting>,
    (ground, widest): (&[Option<Line>], f64),
) -> Vec<Polygon> {
    let mut lines: Vec<Vec<Bound>> = vec![Vec::new(); hulls.len()];
    for joint in joints {
        let (a, b) = joint.stones;
        for (at, stone) in [a, b].into_iter().enumerate() {
            let facing = meetings.get(&(a, b)).map_or(&[][..], |own| &own.own[at]);
            lines[stone].push((outward(joint, stone), facing));
        }
    }
    let mut cells: Vec<Polygon> = hulls
        .iter()
        .zip(&lines)
        .zip(ground)
        .zip(fixed)
        .map(
            |(((hull, lines), ground), fixed)| {
                if *fixed { hull.clone() } else { filled(hull, lines, ground.as_ref(), widest) }
            },
        )
        .collect();
    let bounds: Vec<[f64; 4]> = cells.iter().map(|own| bounds(&own.vertices)).collect();
    for (a, b) in near(&bounds) {
        part((a, b), &mut cells, (&lines, fixed));
    }
    cells.iter_mut().for_each(|cell| straightened(&mut cell.vertices));
    cells
}

/// What one stone fills.
fn filled(hull: &Polygon, lines: &[Bound<'_>], ground: Option<&Line>, widest: f64) -> Polygon {
    let sides: Vec<([[f64; 2]; 2], Line)> =
        hull.sides().filter_map(|ends| Some((ends, Line::side(ends)?))).collect();
    let mut gives_way: Vec<bool> = sides
        .iter()
        .map(|(_, side)| ground.is_some_and(|ground| dot(ground.normal, side.normal) > ALONG))
        .collect();
    for (line, facing) in lines {
        let mut points = vec![0_usize; sides.len()];
        for point in *facing {
            let nearest = (0..sides.len())
                .min_by(|a, b| off(&sides[*a].0, *point).total_cmp(&off(&sides[*b].0, *point)));
            if let Some(nearest) = nearest {
                points[nearest] += 1;
            }
        }
        for (at, (_, side)) in sides.iter().enumerate() {
            gives_way[at] |= points[at] >= FACING && dot(side.normal, line.normal) > ALONG;
        }
    }
    let [left, low, right, high] = bounds(&hull.vertices);
    let mut cell = Polygon {
        vertices: vec![
            [left - widest, low - widest],
            [right + widest, low - widest],
            [right + widest, high + widest],
            [left - widest, high + widest],
        ],
    };
    for ((_, side), gives_way) in sides.iter().zip(&gives_way) {
        let out = if *gives_way { widest } else { 0.0 };
        cell = behind(&cell, &Line { offset: side.offset + out, ..*side });
    }
    lines.iter().map(|(line, _)| line).chain(ground).fold(cell, |cell, line| behind(&cell, line))
}

/// The part of a polygon on the near side of a line.
fn behind(polygon: &Polygon, line: &Line) -> Polygon {
    polygon.clip(-line.offset, line.normal[0], line.normal[1])
}

/// Takes from one of two cells what they share, along a line that bounds the other: that of which the least is lost.
fn part((a, b): (usize, usize), cells: &mut [Polygon], (lines, fixed): (&[Vec<Bound<'_>>], &[bool])) {
    let smaller = cells[a].area().min(cells[b].area());
    if cells[a].intersection(&cells[b]).area() <= SHARED * smaller {
        return;
    }
    let mut best: Option<(f64, usize, Polygon)> = None;
    for (keeps, gives) in [(a, b), (b, a)] {
        if fixed[gives] {
            continue;
        }
        let sides = cells[keeps].sides().filter_map(Line::side);
        for line in lines[keeps].iter().map(|(line, _)| *line).chain(sides) {
            let left = behind(&cells[gives], &line.flipped());
            let lost = cells[gives].area() - left.area();
            if best.as_ref().is_none_or(|best| lost < best.0) {
                best = Some((lost, gives, left));
            }
        }
    }
    if let Some((_, gives, left)) = best {
        cells[gives] = left;
    }
}

/// Pairs whose bounds overlap, the smaller number first, in order.
pub fn near(bounds: &[[f64; 4]]) -> Vec<(usize, usize)> {
    let mut order: Vec<usize> = (0..bounds.len()).collect();
    order.sort_by(|a, b| bounds[*a][0].total_cmp(&bounds[*b][0]).then(a.cmp(b)));
    let mut found = Vec::new();
    for (k, &one) in order.iter().enumerate() {
        for &other in order[k + 1..].iter().take_while(|other| bounds[**other][0] <= bounds[one][2]) {
            if bounds[one][1] <= bounds[other][3] && bounds[other][1] <= bounds[one][3] {
                found.push((one.min(other), one.max(other)));
            }
        }
    }
    found.sort_unstable();
    found
}

/// Distance of a point from a side, squared.
fn off([from, to]: &[[f64; 2]; 2], point: [f64; 2]) -> f64 {
    let (along, there) = (minus(*to, *from), minus(point, *from));
    let share = (dot(there, along) / dot(along, along)).clamp(0.0, 1.0);
    let between = minus(there, along.map(|c| share * c));
    dot(between, between)
}
