//! Clumps of spheres: rough stones that overlap, blocks of a mesh, blocks of a packing.

use crate::generate::elements::places;
use crate::math::Vec3;
use crate::random::{Family, Streams};
use crate::shape::Ball;

/// Rough stones in the cells of a grid, lowest layer first.
pub fn rough(
    side: f64,
    count: u32,
    [nx, ny]: [u32; 2],
    core_share: f64,
    corner_share: &Family,
    streams: &Streams,
) -> Vec<Vec<Ball>> {
    let layers = count.div_ceil(nx * ny);
    let half = Vec3::new(f64::from(nx), f64::from(ny), f64::from(layers)).map(|n| 0.5 * side / n);
    let smallest = half.min();
    let mut sizes = streams.of("corner radius");
    let stone = |[i, j, k]: [u32; 3]| {
        let place = Vec3::new(f64::from(i), f64::from(j), f64::from(k));
        let centre = half.component_mul(&(place * 2.0).add_scalar(1.0));
        let mut balls = vec![Ball { centre, radius: core_share * smallest }];
        for signs in places([2, 2, 2]) {
            let radius = corner_share.sample(&mut sizes) * smallest;
            let corner = Vec3::from_fn(|k, _| (2.0 * f64::from(signs[k]) - 1.0) * (half[k] - radius));
            balls.push(Ball { centre: centre + corner, radius });
        }
        balls
    };
    places([nx, ny, layers]).take(count as usize).map(stone).collect()
}

/// Blocks of a square mesh of spheres: `across` of them fill the width of a block; along its length and its height are
/// as many as fit.
pub fn mesh(side: f64, along: [u32; 3], across: u32) -> Vec<Vec<Ball>> {
    let (radius, counts) = spheres_of_a_block(side, along, across, 2.0);
    let block = |[i, j, k]: [u32; 3]| {
        let first = [i * counts[0], j * counts[1], k * counts[2]];
        let at = |own: [u32; 3]| Vec3::from_fn(|n, _| radius * (2.0 * f64::from(first[n] + own[n]) + 1.0));
        places(counts).map(|own| Ball { centre: at(own), radius }).collect()
    };
    places(along).map(block).collect()
}

/// Blocks of a packing whose rows lie `sqrt(3)` radii above one another, every second one shifted along y by a radius.
pub fn compact(side: f64, along: [u32; 3], across: u32) -> Vec<Vec<Ball>> {
    let rise = 3.0f64.sqrt();
    let (radius, counts) = spheres_of_a_block(side, along, across, rise);
    let block = |[i, j, k]: [u32; 3]| {
        let at = |[a, b, c]: [u32; 3]| {
            let row = k * counts[2] + c;
            let shift = f64::from(row % 2);
            Vec3::new(
                radius * (2.0 * f64::from(i * counts[0] + a) + 1.0),
                radius * (2.0 * f64::from(j * counts[1] + b) + 1.0 + shift),
                radius * (rise * f64::from(row) + 1.0),
            )
        };
        places(counts).map(|own| Ball { centre: at(own), radius }).collect()
    };
    places(along).map(block).collect()
}

/// Radius of the spheres of a block and their numbers along it, where layers of them are `rise` radii apart.
fn spheres_of_a_block(side: f64, along: [u32; 3], across: u32, rise: f64) -> (f64, [u32; 3]) {
    let size = along.map(|n| side / f64::from(n));
    let radius = 0.5 * size[1] / f64::from(across);
    // Rounded down, but not because of rounding errors.
    let fitting =
        |room: f64, spacing: f64| 1 + ((room - 2.0 * radius) / spacing + 1e-9).max(0.0).floor() as u32;
    (radius, [fitting(size[0], 2.0 * radius), across, fitting(size[2], rise * radius)])
}
