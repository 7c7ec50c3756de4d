//! The patch where two blocks touch, on hand-made pairs.

use crate::contact::{Feature, Settings, find_patch};
use crate::math::{Mat3, Vec3, cos, radians, sin};
use crate::shape::Polyhedron;
use approx::assert_relative_eq;

fn slab() -> Polyhedron {
    Polyhedron::cuboid(Vec3::new(-1.0, -1.0, -0.1), Vec3::new(1.0, 1.0, 0.0))
}

fn about_x(degrees: f64) -> Mat3 {
    let (c, s) = (cos(radians(degrees)), sin(radians(degrees)));
    Mat3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
}

fn settings() -> Settings {
    Settings::for_size(0.2, [2, 2])
}

#[test]
fn a_block_half_over_the_edge_touches_with_half_its_face() {
    let block = Polyhedron::cuboid(Vec3::new(0.9, -0.1, 0.0), Vec3::new(1.1, 0.2, 0.1));
    let patch = find_patch(&slab(), &block, &settings()).unwrap();
    assert_relative_eq!(patch.polygon.area(), 0.1 * 0.3, max_relative = 1e-12);
    assert!(!patch.reference_is_second);
    assert_relative_eq!(patch.plane.normal, Vec3::z(), epsilon = 1e-14);
    assert_relative_eq!(patch.frame.normal, -Vec3::z(), epsilon = 1e-14);
}

/// A six-sided prism of height 1 and circumradius 1 on the plane z.
fn prism(z: f64) -> Polyhedron {
    let ring = |h: f64| {
        (0..6).map(move |i| {
            let a = radians(60.0 * f64::from(i));
            Vec3::new(cos(a), sin(a), h)
        })
    };
    Polyhedron {
        vertices: ring(z).chain(ring(z + 1.0)).collect(),
        faces: [vec![5, 4, 3, 2, 1, 0], vec![6, 7, 8, 9, 10, 11]]
            .into_iter()
            .chain((0..6).map(|i| vec![i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i]))
            .collect(),
    }
}

fn worn(inset: f64) -> Settings {
    Settings { inset, ..settings() }
}

#[test]
fn a_joint_ends_short_of_the_arrises_of_both_blocks() {
    // Half over the edge: the strip next to the slab's edge is lost on one side, those along the block's on three.
    let block = Polyhedron::cuboid(Vec3::new(0.9, -0.1, 0.0), Vec3::new(1.1, 0.2, 0.1));
    let patch = find_patch(&slab(), &block, &worn(0.01)).unwrap();
    assert_relative_eq!(patch.polygon.area(), (0.1 - 0.02) * (0.3 - 0.02), max_relative = 1e-12);
    let reached = patch.polygon.vertices.iter().map(|v| patch.frame.lift(*v).x).fold(0.0, f64::max);
    assert_relative_eq!(reached, 0.99, max_relative = 1e-12);
}

#[test]
fn an_inset_hexagon_is_a_smaller_hexagon() {
    // The apothem shrinks by the inset; the area goes with its square.
    let patch = find_patch(&prism(0.0), &prism(1.0), &worn(0.1)).unwrap();
    let apothem = 0.75f64.sqrt() - 0.1;
    assert_relative_eq!(patch.polygon.area(), 2.0 * 3f64.sqrt() * apothem * apothem, max_relative = 1e-12);
}

#[test]
fn a_joint_no_wider_than_the_arrises_is_none() {
    // 15 mm of overlap: an inset of 7 mm from either edge leaves 1 mm, one of 8 mm nothing.
    let block = Polyhedron::cuboid(Vec3::new(0.985, -0.1, 0.0), Vec3::new(1.185, 0.2, 0.1));
    assert!(find_patch(&slab(), &block, &worn(0.007)).is_some());
    assert!(find_patch(&slab(), &block, &worn(0.008)).is_none());
    // A slat thinner than its two arrises has no bearing face, whichever block it belongs to.
    let slat = Polyhedron::cuboid(Vec3::new(0.0, -0.1, 0.0), Vec3::new(0.015, 0.2, 0.1));
    assert!(find_patch(&slab(), &slat, &worn(0.008)).is_none());
    assert!(find_patch(&slat, &slab(), &worn(0.008)).is_none());
    // Leaning about two axes, so that crossing edges part them better than any face: a square would carry it all the same.
    let (c, s) = (cos(radians(1.0)), sin(radians(1.0)));
    let lean = about_x(-3.0) * Mat3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c);
    let foot = Vec3::new(0.985, 0.05, 0.0);
    let leaning = block.moved(&lean, &(foot - lean * foot));
    assert!(find_patch(&slab(), &leaning, &worn(0.0)).is_some());
    assert!(find_patch(&slab(), &leaning, &worn(0.008)).is_none());
}

#[test]
fn what_is_uneven_stays_where_it_is_when_two_blocks_change_their_roles() {
    // Flat on each other the lower block is the reference; a plate that leans separates better by its own face.
    let lower = Polyhedron::cuboid(Vec3::new(-0.1, -0.15, -0.1), Vec3::new(0.1, 0.15, 0.0));
    let plate = Polyhedron::cuboid(Vec3::new(-0.25, -0.3, 0.0), Vec3::new(0.2, 0.35, 0.1));
    let leaning = plate.moved(&about_x(0.5), &Vec3::new(0.0, 0.0, -1e-4));
    let patches = [&plate, &leaning].map(|upper| find_patch(&lower, upper, &settings()).unwrap());
    assert_eq!([false, true], [0, 1].map(|k| patches[k].reference_is_second));
    let [flat, leant] = patches.map(|patch| {
        let lift = |v: [f64; 2]| patch.frame.lift(v);
        let cells = patch.pieces(8, 1 << 3 | 1 << 21 | 1 << 40);
        assert!(cells.iter().all(|cell| cell.outline.area() > 0.0));
        cells.iter().map(|cell| lift(cell.moments.centroid())).collect::<Vec<_>>()
    });
    assert_eq!((flat.len(), leant.len()), (3, 3));
    for (a, b) in flat.iter().zip(&leant) {
        // Cells are 25 by 37 mm; half a degree lifts them by a millimetre and moves them by hundredths.
        assert!((a - b).xy().norm() < 1e-4 && (a - b).norm() < 2e-3, "{a} against {b}");
    }
}

#[test]
fn hexagonal_faces_keep_their_whole_area() {
    let patch = find_patch(&prism(0.0), &prism(1.0), &settings()).unwrap();
    assert_relative_eq!(patch.polygon.area(), 1.5 * 3f64.sqrt(), max_relative = 1e-12);
}

#[test]
fn a_block_on_its_edge_touches_in_a_strip_of_the_stated_width() {
    let block = Polyhedron::cuboid(Vec3::repeat(-0.1), Vec3::repeat(0.1));
    let lift = 0.1 * 2f64.sqrt() - 1e-5;
    let block = block.moved(&about_x(45.0), &Vec3::new(0.0, 0.0, lift));
    let patch = find_patch(&slab(), &block, &settings()).unwrap();
    assert!(matches!(patch.feature, Feature::Steep(..)));
    assert_relative_eq!(patch.polygon.area(), 0.2 * settings().steep_width, max_relative = 1e-9);
    assert_relative_eq!(patch.plane.distance(&patch.frame.origin), -1e-5, epsilon = 1e-12);
}

#[test]
fn a_block_on_its_corner_touches_in_a_square_of_the_stated_width() {
    let about_y = about_x(0.0) * {
        let (c, s) = (cos(radians(35.0)), sin(radians(35.0)));
        Mat3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
    };
    let block = Polyhedron::cuboid(Vec3::repeat(-0.1), Vec3::repeat(0.1));
    let block = block.moved(&(about_x(45.0) * about_y), &Vec3::zeros());
    let low = block.bounds().0.z;
    let block = block.translated(&Vec3::new(0.0, 0.0, -low - 1e-5));
    let patch = find_patch(&slab(), &block, &settings()).unwrap();
    assert_relative_eq!(
        patch.polygon.area(),
        settings().steep_width * settings().steep_width,
        max_relative = 1e-9
    );
}

#[test]
fn crossed_edges_touch_in_a_square_between_them() {
    let block = Polyhedron::cuboid(Vec3::repeat(-0.1), Vec3::repeat(0.1));
    let about_y = {
        let (c, s) = (cos(radians(45.0)), sin(radians(45.0)));
        Mat3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
    };
    let lower = block.moved(&about_x(45.0), &Vec3::zeros());
    let upper = block.moved(&about_y, &Vec3::new(0.0, 0.0, 0.2 * 2f64.sqrt() - 1e-5));
    let patch = find_patch(&lower, &upper, &settings()).unwrap();
    assert!(matches!(patch.feature, Feature::Edges(..)));
    assert_relative_eq!(patch.frame.normal, -Vec3::z(), epsilon = 1e-12);
    assert_relative_eq!(patch.plane.distance(&patch.frame.origin), -1e-5, epsilon = 1e-12);
}

#[test]
fn far_blocks_share_no_patch() {
    let block = Polyhedron::cuboid(Vec3::new(0.0, 0.0, 0.01), Vec3::new(0.2, 0.2, 0.2));
    assert!(find_patch(&slab(), &block, &settings()).is_none());
}
