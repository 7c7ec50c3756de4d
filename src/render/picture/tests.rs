//! The picture against geometry that can be written down.

use approx::assert_relative_eq;

use super::order::back_to_front;
use super::view::View;
use super::{Hinge, Picture, Seam, Stone, Thrust, colour};
use crate::math::{Vec3, radians};
use crate::model::Movement;
use crate::shape::Polyhedron;

const RIGHT_ANGLE: f64 = std::f64::consts::FRAC_PI_2;

fn stone(low: [f64; 3], high: [f64; 3]) -> Stone {
    let shape = Polyhedron::cuboid(Vec3::from(low), Vec3::from(high));
    Stone { shape, before: Movement::NONE, movement: Movement::NONE }
}

/// Two courses: one stone of 1 x 0.2 x 0.5 m on another.
fn picture() -> Picture {
    let stones = vec![stone([0.0; 3], [1.0, 0.2, 0.5]), stone([0.0, 0.0, 0.5], [1.0, 0.2, 1.0])];
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.2], [0.0, 0.2]];
    let bed = |blocks, z, value| Seam {
        blocks,
        polygon: corners.iter().map(|&[x, y]| Vec3::new(x, y, z)).collect(),
        value,
    };
    Picture {
        seams: vec![bed([0, 1], 0.5, 1e-3), bed([0, 2], 0.0, 4e-3)],
        stones,
        hinges: Vec::new(),
        thrusts: Vec::new(),
        measure: "opening".to_owned(),
        unit: ("mm", 1e3),
        from_front: true,
        magnification: 1.0,
        title: "a < b & c".to_owned(),
        remarks: vec!["It rests.".to_owned()],
    }
}

/// From the front at the height of the wall x runs to the left and z up; from above y runs down. From 45 deg aside and the
/// height asin(1 / sqrt(3)) the three axes are equally long, sqrt(2 / 3), and 120 deg apart: the isometric view.
#[test]
fn known_views_put_the_axes_where_they_belong() {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let front = View::from(0.0, 0.0);
    let above = View::from(0.0, RIGHT_ANGLE);
    for (view, expected) in
        [(front, [[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]), (above, [[-1.0, 0.0], [0.0, -1.0], [0.0, 0.0]])]
    {
        for (axis, [right, up]) in axes.iter().zip(expected) {
            let [x, y] = view.place(axis);
            // Round-off of one sine.
            assert!((x - right).abs() < 1e-15 && (y - up).abs() < 1e-15, "{axis:?}: {x}, {y}");
        }
    }
    let isometric = View::from(radians(45.0), crate::math::asin(1.0 / 3f64.sqrt()));
    let places = axes.map(|axis| isometric.place(&axis));
    for (k, [x, y]) in places.iter().enumerate() {
        let [u, v] = places[(k + 1) % 3];
        assert_relative_eq!(x * x + y * y, 2.0 / 3.0, max_relative = 1e-14);
        assert_relative_eq!(x * u + y * v, -1.0 / 3.0, max_relative = 1e-14);
        assert_relative_eq!(isometric.nearness(&axes[k]), 1.0 / 3f64.sqrt(), max_relative = 1e-14);
    }
}

/// The three directions of every view make a right-handed frame: nothing is mirrored.
#[test]
fn no_view_mirrors() {
    for front in [true, false] {
        let view = View::on(front);
        assert_relative_eq!(view.right.cross(&view.up), view.viewer, epsilon = 1e-15);
        assert_eq!(view.sees(&Vec3::y()), front);
        assert!(view.sees(&Vec3::z()));
    }
}

/// A long low block reaches nearer to the viewer than a small one that stands on its far end, and so does its centroid; it is
/// painted first all the same.
#[test]
fn a_block_on_another_is_painted_later() {
    let view = View::on(true);
    let long = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(4.0, 0.5, 0.2));
    let upon = Polyhedron::cuboid(Vec3::new(0.0, 0.0, 0.2), Vec3::new(0.5, 0.5, 0.6));
    let [below, above] = [&long, &upon].map(|s| view.nearness(&s.mass_properties().centroid));
    assert!(below > above, "{below} against {above}: depth alone would be wrong");
    assert_eq!(back_to_front(&[long.clone(), upon.clone()], &view, 0.0), [0, 1]);
    assert_eq!(back_to_front(&[upon, long], &view, 0.0), [1, 0]);
}

/// A stone turned by 90 deg about x while its centroid goes up by 1 m, drawn at half: turned by 45 deg, half a metre up.
#[test]
fn a_movement_is_magnified_about_where_the_block_was_at_rest() {
    let mut moved = stone([-1.0; 3], [1.0; 3]);
    moved.before = Movement { shift: Vec3::new(3.0, 0.0, 0.0), turn: Vec3::zeros() };
    moved.movement = Movement { shift: Vec3::z(), turn: Vec3::new(RIGHT_ANGLE, 0.0, 0.0) };
    let [point] = moved.taking(&[Vec3::y()], 0.5)[..] else { panic!("one point") };
    let root = 0.5f64.sqrt();
    assert_relative_eq!(point, Vec3::new(3.0, root, 0.5 + root), epsilon = 1e-15);
    // The height is 2 m and the largest movement 1 m.
    assert_eq!(Picture::fitting(&[moved]), 0.2);
    assert_eq!(Picture::fitting(&[stone([0.0; 3], [1.0; 3])]), 1.0);
}

/// Three faces of each stone are seen. The bed in the middle shows as two lines on either stone; that on the ground as two
/// lines and, below the stone, as a patch.
#[test]
fn faces_and_joints_that_are_seen_are_drawn() {
    let text = picture().svg();
    let polygons = |fill: &str| text.matches(&format!("fill=\"{fill}\" stroke")).count();
    assert_eq!(
        text.matches("<polygon").count(),
        1 + 6 + 2,
        "ground, faces, and the beds on ground and lower stone: {text}"
    );
    let [weak, strong] = [colour::of_share(0.25), colour::of_share(1.0)];
    assert_eq!((polygons(&weak), polygons(&strong)), (1, 1), "{text}");
    let lines = |stroke: &str| text.matches(&format!("stroke=\"{stroke}\" stroke-width=\"3.2\"")).count();
    assert_eq!((lines(&weak), lines(&strong)), (4, 2), "{text}");
    // The largest value and half of it, in mm.
    assert!(text.contains(">4.0</text>") && text.contains(">2.0</text>"), "{text}");
    assert!(text.contains("a &lt; b &amp; c") && text.contains("It rests."), "{text}");
    assert_eq!(text, picture().svg(), "the same picture, the same bytes");
}

#[test]
fn a_hinge_is_a_dot_at_the_near_end_of_an_edge_that_leads_away() {
    let mut picture = picture();
    let without = picture.svg();
    // Along y the front end is nearer, and is taken instead of the middle.
    let along_y = [Vec3::new(1.0, 0.0, 0.5), Vec3::new(1.0, 0.2, 0.5)];
    picture.hinges = vec![Hinge { block: 1, edge: along_y }, Hinge { block: 9, edge: along_y }];
    let with = picture.svg();
    picture.hinges[0].edge = [along_y[1]; 2];
    assert_eq!(picture.svg(), with);
    picture.hinges[0].edge = [along_y[0]; 2];
    assert_ne!(picture.svg(), with);
    // One in the wall and one in the legend; a block that is not there has none.
    assert_eq!(with.matches("<circle").count(), 2);
    assert!(with.contains("1 hinge: joints open") && !without.contains("<circle"));
}

/// Without a joint that did something there is no scale to read it from.
#[test]
fn a_wall_whose_joints_did_nothing_has_no_colour_bar() {
    let mut still = picture();
    still.seams.iter_mut().for_each(|seam| seam.value = 0.0);
    let text = still.svg();
    assert!(!text.contains("opening") && !text.contains("stroke-width=\"3.2\""), "{text}");
    assert_eq!(text.matches("<polygon").count(), 7);
}

#[test]
fn the_colour_scale_runs_from_light_to_dark() {
    let brightness = |share: f64| {
        let hex = u32::from_str_radix(&colour::of_share(share)[1..], 16).unwrap();
        let [r, g, b] = [hex >> 16, hex >> 8 & 255, hex & 255].map(f64::from);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    assert_eq!((colour::of_share(0.0), colour::of_share(1.0)), ("#ffffb2".to_owned(), "#bd0026".to_owned()));
    assert_eq!(colour::of_share(2.0), colour::of_share(1.0));
    assert!((1..=20).all(|k| brightness(0.05 * f64::from(k)) < brightness(0.05 * f64::from(k - 1))));
}

#[test]
fn a_thrust_is_a_line_along_the_force_through_its_centre_of_pressure() {
    let mut picture = picture();
    let without = picture.svg();
    assert!(!without.contains("thrust"));
    let at = |x: f64, newtons: f64| Thrust {
        block: 0,
        at: Vec3::new(x, 0.0, 0.2),
        force: Vec3::new(0.0, 0.0, -newtons),
    };
    picture.thrusts = vec![at(0.1, 500.0), at(0.3, 250.0)];
    let drawn = picture.svg();
    assert!(drawn.contains("longest line 500 N"), "{drawn}");
    // Upright on paper, the second half as long as the first; the third line is that of the legend.
    let lines: Vec<Vec<f64>> = drawn
        .split("<polyline points=\"")
        .skip(1)
        .step_by(2)
        .map(|rest| {
            rest.split('"').next().unwrap_or_default().split([' ', ',']).map(|x| x.parse().unwrap()).collect()
        })
        .collect();
    assert_eq!(lines.len(), 3);
    let long = |line: &[f64]| Vec3::new(line[2] - line[0], line[3] - line[1], 0.0).norm();
    assert!(lines[..2].iter().all(|line| (line[0] - line[2]).abs() < 0.2), "{lines:?}");
    assert!((long(&lines[0]) / long(&lines[1]) - 2.0).abs() < 0.02, "{lines:?}");
}
