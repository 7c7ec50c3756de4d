//! What is seen of a wall along an axis, and what a section across it shows.

use crate::math::Vec3;
use crate::render::picture::order::back_to_front;
use crate::render::picture::view::View;
use crate::shape::{Polygon, Polyhedron, bounds};

/// A block of which less than this share is seen is hidden: rounding along joints. Of a part of it that is smaller still nothing is seen.
const HIDDEN: f64 = 1e-3;
const SLIVER: f64 = 1e-5;
/// Places in the middle third of the wall at which a section may lie, an odd number: the middle is one of them.
const PLACES: usize = 21;
const THIRD: f64 = 1.0 / 3.0;

/// A block as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Seen {
    /// The block.
    pub block: usize,
    /// Its outline on the plane of the view (m), or what the section cuts of it.
    pub outline: Polygon,
    /// Whether the section cuts it.
    pub is_cut: bool,
}

/// All blocks in a view, from the furthest to the nearest; see [`back_to_front`].
pub(super) fn along(shapes: &[Polyhedron], view: &View, depth: f64) -> Vec<Seen> {
    let seen = |block: usize| Seen { block, outline: outline(&shapes[block], view), is_cut: false };
    back_to_front(shapes, view, depth).into_iter().map(seen).collect()
}

/// What a section at `x` (m) cuts, seen towards -x.
pub(super) fn cut(shapes: &[Polyhedron], x: f64) -> Vec<Seen> {
    let all = shapes.iter().enumerate().filter(|(_, shape)| is_cut(shape, x));
    all.map(|(block, shape)| Seen { block, outline: cut_of(shape, x), is_cut: true }).collect()
}

/// The same with what lies beyond the section before it in the list, as it is further away.
pub(super) fn section(shapes: &[Polyhedron], x: f64, depth: f64) -> Vec<Seen> {
    let beyond: Vec<usize> = (0..shapes.len()).filter(|block| shapes[*block].bounds().1.x <= x).collect();
    let behind: Vec<Polyhedron> = beyond.iter().map(|block| shapes[*block].clone()).collect();
    let mut all = along(&behind, &View::END, depth);
    all.iter_mut().for_each(|own| own.block = beyond[own.block]);
    all.extend(cut(shapes, x));
    all
}

/// Where (m) in the middle third of their length a section cuts most of some blocks, of several such places the one nearest to the middle.
pub(super) fn busiest(shapes: &[&Polyhedron], [from, to]: [f64; 2]) -> f64 {
    let middle = PLACES / 2;
    let place = |k: usize| {
        let aside = (k as f64 - middle as f64) / (PLACES as f64 - 1.0);
        0.5 * (from + to) + THIRD * (to - from) * aside
    };
    let cut = |k: usize| shapes.iter().filter(|shape| is_cut(shape, place(k))).count();
    // Of equal ones the last is taken.
    let mut places: Vec<usize> = (0..PLACES).collect();
    places.sort_by_key(|k| std::cmp::Reverse((k.abs_diff(middle), *k)));
    place(places.into_iter().max_by_key(|k| cut(*k)).unwrap_or(middle))
}

/// What is within a frame and not hidden by what comes later, in the same order.
pub(super) fn shown(all: Vec<Seen>, frame: &Polygon) -> Vec<Seen> {
    let within = |own: Seen| Seen { outline: own.outline.intersection(frame), ..own };
    let all: Vec<Seen> = all.into_iter().map(within).filter(|own| own.outline.area() > 0.0).collect();
    let around: Vec<[f64; 4]> = all.iter().map(|own| bounds(&own.outline.vertices)).collect();
    let meets = |a: &[f64; 4], b: &[f64; 4]| (0..2).all(|k| a[k] < b[k + 2] && b[k] < a[k + 2]);
    // From the nearest on: what is hidden hides nothing that is not hidden without it.
    let mut seen: Vec<usize> = Vec::new();
    for at in (0..all.len()).rev() {
        let nearer = seen.iter().filter(|other| meets(&around[at], &around[**other]));
        if !is_hidden(&all[at].outline, nearer.map(|other| &all[*other].outline)) {
            seen.push(at);
        }
    }
    let mut is_seen = vec![false; all.len()];
    seen.into_iter().for_each(|at| is_seen[at] = true);
    all.into_iter().zip(is_seen).filter(|(_, seen)| *seen).map(|(own, _)| own).collect()
}

/// Whether others together leave nothing of an outline to be seen.
fn is_hidden<'o>(own: &Polygon, others: impl Iterator<Item = &'o Polygon>) -> bool {
    let (least, sliver) = (HIDDEN * own.area(), SLIVER * own.area());
    let mut left = vec![own.clone()];
    for nearer in others {
        let parts = left.into_iter().flat_map(|part| match part.intersection(nearer).area() > sliver {
            true => part.without(nearer),
            false => vec![part],
        });
        left = parts.filter(|part| part.area() > sliver).collect();
    }
    left.iter().map(Polygon::area).sum::<f64>() <= least
}

fn outline(shape: &Polyhedron, view: &View) -> Polygon {
    Polygon::around(shape.vertices.iter().map(|v| view.place(v)).collect())
}

/// Whether the plane at `x` passes through the inside of a block.
fn is_cut(shape: &Polyhedron, x: f64) -> bool {
    let (low, high) = shape.bounds();
    low.x < x && x < high.x
}

/// The polygon in which the plane at `x` cuts a block.
fn cut_of(shape: &Polyhedron, x: f64) -> Polygon {
    let mut points = Vec::new();
    for face in 0..shape.faces.len() {
        let corners: Vec<Vec3> = shape.face_vertices(face).collect();
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (da, db) = (a.x - x, b.x - x);
            if da == 0.0 {
                points.push(View::END.place(a));
            }
            // Both faces of an edge run it, each its own way: the same bits for both.
            if da < 0.0 && db > 0.0 {
                points.push(View::END.place(&(a + (b - a) * (da / (da - db)))));
            }
        }
    }
    Polygon::around(points)
}
