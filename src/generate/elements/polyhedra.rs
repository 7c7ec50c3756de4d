//! Polyhedra: equal blocks, and the cells around random points.

use crate::generate::draft::CUT_TOLERANCE;
use crate::generate::elements::{NoRoom, places};
use crate::math::{Vec3, cbrt};
use crate::random::Streams;
use crate::shape::{Plane, Polyhedron};

/// Equal blocks on a grid.
pub fn blocks(side: f64, along: [u32; 3]) -> Vec<Polyhedron> {
    let size = Vec3::from_fn(|k, _| side / f64::from(along[k]));
    let corner = |at: [u32; 3]| Vec3::from_fn(|k, _| size[k] * f64::from(at[k]));
    places(along).map(|at| Polyhedron::cuboid(corner(at), corner(at.map(|n| n + 1)))).collect()
}

/// Uniform points in the cube, each drawn anew until it is far enough from those before it.
pub fn points(
    side: f64,
    count: u32,
    least_distance_share: f64,
    max_draws: u32,
    streams: &Streams,
) -> Result<Vec<Vec3>, NoRoom> {
    let least = least_distance_share * side / cbrt(f64::from(count));
    let mut spots = streams.of("cell place");
    let mut points: Vec<Vec3> = Vec::new();
    for element in 0..count {
        let mut draw = || side * spots.uniform();
        let mut tries = (0..max_draws).map(|_| Vec3::new(draw(), draw(), draw()));
        let free = tries.find(|p| points.iter().all(|q| (p - q).norm() >= least));
        points.push(free.ok_or(NoRoom::Draws { element, draws: max_draws })?);
    }
    Ok(points)
}

/// The part of the cube that is nearer to each point than to any other, less half the gap.
pub fn cells(side: f64, points: &[Vec3], gap: f64) -> Result<Vec<Polyhedron>, NoRoom> {
    let cube = Polyhedron::cuboid(Vec3::zeros(), Vec3::repeat(side));
    let cell = |(element, point): (usize, &Vec3)| {
        let others = points.iter().enumerate().filter(|(k, _)| *k != element).map(|(_, other)| other);
        let solid = others.fold(cube.clone(), |solid, other| {
            let mut between = Plane::through((point + other) * 0.5, other - point);
            between.offset -= 0.5 * gap;
            // Its own point is always on this side.
            solid.cut(&between, CUT_TOLERANCE).0.unwrap_or(solid)
        });
        let element = element as u32;
        solid.validate(10.0 * CUT_TOLERANCE).map_err(|fault| NoRoom::Cell { element, fault })?;
        Ok(solid)
    };
    points.iter().enumerate().map(cell).collect()
}
