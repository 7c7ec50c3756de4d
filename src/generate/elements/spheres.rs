//! Single spheres: a grid, a cloud.

use crate::generate::elements::{NoRoom, places};
use crate::math::Vec3;
use crate::random::{Family, Streams};
use crate::shape::Ball;

/// Equal spheres on a grid from the cube's lower corner; the most along any axis span its side.
pub fn aligned(side: f64, along: [u32; 3]) -> Vec<Vec<Ball>> {
    let radius = 0.5 * side / f64::from(along.into_iter().fold(1, u32::max));
    let at = |n: u32| radius * (2.0 * f64::from(n) + 1.0);
    places(along).map(|[i, j, k]| vec![Ball { centre: Vec3::new(at(i), at(j), at(k)), radius }]).collect()
}

/// Spheres one after the other at uniform places within the cube, each drawn anew until it touches none before it.
pub fn cloud(
    side: f64,
    count: u32,
    radius: &Family,
    max_draws: u32,
    streams: &Streams,
) -> Result<Vec<Vec<Ball>>, NoRoom> {
    let (mut sizes, mut spots) = (streams.of("sphere radius"), streams.of("sphere place"));
    let mut balls: Vec<Ball> = Vec::new();
    for element in 0..count {
        let radius = radius.sample(&mut sizes);
        let mut draw = || radius + (side - 2.0 * radius) * spots.uniform();
        let mut tries = (0..max_draws).map(|_| Ball { centre: Vec3::new(draw(), draw(), draw()), radius });
        let free = tries.find(|ball| balls.iter().all(|other| ball.overlap(other) <= 0.0));
        balls.push(free.ok_or(NoRoom::Draws { element, draws: max_draws })?);
    }
    Ok(balls.into_iter().map(|ball| vec![ball]).collect())
}
