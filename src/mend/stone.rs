//! The stones behind their planes.

use crate::mend::ROUNDING;
use crate::mend::face::{Face, farthest};
use crate::model::Wall;
use crate::shape::{Plane, Polyhedron};

/// Share of its volume that a stone may lose or gain: beyond it, it is another stone.
const MOST_CHANGED: f64 = 0.5;

/// The shapes of all blocks; those whose planes stay, or whose planes would leave no stone of about its size, are as they were.
pub fn rebuilt(wall: &Wall, faces: &[Face], planes: &[Option<Plane>]) -> Vec<Polyhedron> {
    let mut place = 0;
    let mut shapes = Vec::with_capacity(wall.blocks.len());
    for block in &wall.blocks {
        let own = place..place + block.shape.faces.len();
        place = own.end;
        let shape = behind(&block.shape, &faces[own.clone()], &planes[own]);
        shapes.push(shape.unwrap_or_else(|| block.shape.clone()));
    }
    shapes
}

fn behind(shape: &Polyhedron, faces: &[Face], planes: &[Option<Plane>]) -> Option<Polyhedron> {
    let size = shape.diameter();
    let stays = |(face, plane): (&Face, &Option<Plane>)| {
        face.is_fixed || plane.is_none_or(|plane| farthest(face, &plane) <= ROUNDING * size)
    };
    if faces.iter().zip(planes).all(stays) {
        return None;
    }
    let mut all: Vec<Plane> = Vec::new();
    for (face, plane) in faces.iter().zip(planes) {
        let plane = plane.unwrap_or(face.plane);
        // Two faces of a stone that have become one plane are one face.
        if !all.contains(&plane) {
            all.push(plane);
        }
    }
    sound(Polyhedron::behind(&all, &shape.vertices, size, ROUNDING * size)?, shape)
}

/// A shape that may stand for another one.
pub fn sound(shape: Polyhedron, of: &Polyhedron) -> Option<Polyhedron> {
    shape.validate(100.0 * ROUNDING * of.diameter()).ok()?;
    let (now, then) = (shape.volume(), of.volume());
    ((now - then).abs() <= MOST_CHANGED * then).then_some(shape)
}
