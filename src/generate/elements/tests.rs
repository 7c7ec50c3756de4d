//! The assemblies are what they say: numbers, room, overlaps.

use super::*;
use crate::math::Vec3;
use crate::shape::overlap_depth;
use approx::assert_relative_eq;

const SIDE: f64 = 0.4;

fn balls(elements: &Elements, member: u64) -> Vec<Vec<Ball>> {
    match elements.fill(SIDE, &Streams::new(1, member)).unwrap() {
        Shapes::Balls(clumps) => clumps,
        Shapes::Polyhedra(_) => panic!("these are balls"),
    }
}

fn polyhedra(elements: &Elements, member: u64) -> Vec<Polyhedron> {
    match elements.fill(SIDE, &Streams::new(1, member)).unwrap() {
        Shapes::Polyhedra(solids) => solids,
        Shapes::Balls(_) => panic!("these are polyhedra"),
    }
}

/// Deepest overlap of balls of different clumps (m), and of balls of the same one.
fn overlaps(clumps: &[Vec<Ball>]) -> [f64; 2] {
    let mut deepest = [f64::NEG_INFINITY; 2];
    let all: Vec<(usize, Ball)> =
        clumps.iter().enumerate().flat_map(|(id, c)| c.iter().map(move |b| (id, *b))).collect();
    for (n, (i, a)) in all.iter().enumerate() {
        for (j, b) in &all[n + 1..] {
            let which = usize::from(i == j);
            deepest[which] = deepest[which].max(a.overlap(b));
        }
    }
    deepest
}

fn within_the_cube(clumps: &[Vec<Ball>]) -> bool {
    let inside = |x: f64, r: f64| x - r > -1e-12 && x + r < SIDE + 1e-12;
    clumps.iter().flatten().all(|b| b.centre.iter().all(|&x| inside(x, b.radius)))
}

fn rough() -> Elements {
    let corner_share = Family::Uniform { low: 0.4, high: 0.6 };
    Elements::RoughStones { count: 115, per_layer: [5, 5], core_share: 0.9, corner_share }
}

fn cloud(count: u32) -> Elements {
    Elements::SphereCloud { count, radius: Family::Uniform { low: 0.03, high: 0.05 }, max_draws: 1000 }
}

#[test]
fn aligned_spheres_touch() {
    let grid = balls(&Elements::AlignedSpheres { along: [3, 3, 3] }, 0);
    assert_eq!(grid.len(), 27);
    assert!(within_the_cube(&grid));
    // Neighbours touch to rounding.
    assert_relative_eq!(overlaps(&grid)[0], 0.0, epsilon = 1e-15);
}

#[test]
fn a_cloud_is_loose_and_says_when_there_is_no_room() {
    let spheres = balls(&cloud(28), 3);
    assert_eq!(spheres.len(), 28);
    assert!(within_the_cube(&spheres) && overlaps(&spheres)[0] <= 0.0);
    assert_eq!(spheres, balls(&cloud(28), 3));
    assert_ne!(spheres, balls(&cloud(28), 4));
    // Spheres of 0.03 m and more have no place for a thousand: they would fill more than the cube.
    let full = cloud(1000).fill(SIDE, &Streams::new(1, 0));
    assert!(matches!(full, Err(NoRoom::Draws { element: 30.., draws: 1000 })), "{full:?}");
}

#[test]
fn rough_stones_overlap_within_and_not_between() {
    let stones = balls(&rough(), 0);
    assert_eq!(stones.len(), 115);
    assert!(within_the_cube(&stones));
    let [between, within] = overlaps(&stones);
    assert!(between <= 1e-15 && within > 0.01, "{between:e}, {within}");
    // No two stones alike.
    let shape = |stone: &Vec<Ball>| stone.iter().map(|b| b.radius).collect::<Vec<_>>();
    assert_ne!(shape(&stones[0]), shape(&stones[1]));
}

#[test]
fn blocks_of_spheres_touch_and_do_not_overlap() {
    let mesh = balls(&Elements::MeshClumps { along: [4, 4, 4], across: 2 }, 0);
    assert_eq!((mesh.len(), mesh[0].len()), (64, 8));
    assert!(within_the_cube(&mesh));
    for deepest in overlaps(&mesh) {
        assert_relative_eq!(deepest, 0.0, epsilon = 1e-15);
    }
    let compact = balls(&Elements::CompactClumps { along: [4, 4, 4], across: 2 }, 0);
    // 0.1 m take two rows of radius 0.025 at 0.043 m.
    assert_eq!((compact.len(), compact[0].len()), (64, 8));
    for deepest in overlaps(&compact) {
        assert_relative_eq!(deepest, 0.0, epsilon = 1e-15);
    }
    // A ball in the middle touches two of the row below.
    let touching = |ball: &Ball| {
        let below = |b: &&Ball| b.centre.z < ball.centre.z - 0.01 && ball.overlap(b) > -1e-12;
        compact.iter().flatten().filter(below).count()
    };
    assert_eq!(touching(&compact[21][0]), 2);
}

#[test]
fn cells_are_valid_and_fill_the_cube_but_for_their_gaps() {
    let solids = |gap: f64| {
        polyhedra(
            &Elements::RandomPolyhedra { count: 32, least_distance_share: 0.5, gap, max_draws: 1000 },
            5,
        )
    };
    let whole: f64 = solids(0.0).iter().map(Polyhedron::volume).sum();
    assert_relative_eq!(whole, SIDE * SIDE * SIDE, max_relative = 1e-9);
    let apart = solids(1e-4);
    assert_eq!(apart.len(), 32);
    let volume: f64 = apart.iter().map(Polyhedron::volume).sum();
    assert!(volume < whole && volume > 0.99 * whole);
    for (i, a) in apart.iter().enumerate() {
        for b in &apart[i + 1..] {
            assert_eq!(overlap_depth(a, b, 0.0), None);
        }
    }
}

#[test]
fn blocks_fill_the_cube() {
    let grid = polyhedra(&Elements::Blocks { along: [2, 2, 4] }, 0);
    assert_eq!(grid.len(), 16);
    let volume: f64 = grid.iter().map(Polyhedron::volume).sum();
    assert_relative_eq!(volume, SIDE * SIDE * SIDE, max_relative = 1e-12);
    assert_eq!(grid[15].bounds().1, Vec3::repeat(SIDE));
}

#[test]
fn only_random_ones_differ_from_member_to_member() {
    let mesh = Elements::MeshClumps { along: [4, 4, 4], across: 2 };
    assert!(mesh.is_fixed() && !rough().is_fixed() && !cloud(3).is_fixed());
    assert_eq!(balls(&mesh, 0), balls(&mesh, 1));
    assert_ne!(balls(&rough(), 0), balls(&rough(), 1));
}
