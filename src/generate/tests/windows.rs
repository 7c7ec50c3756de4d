//! Windows of generated walls: their area, and stones around them on every side.

use approx::assert_relative_eq;

use super::*;
use crate::model::{Side, Tag, Window, WindowFault};

/// A wall of one thickness, 4 m long and 1 m high.
fn upright(mut layout: Layout) -> Layout {
    layout.outline.top_thickness = layout.outline.base_thickness;
    layout
}

#[test]
fn a_window_of_a_running_bond_holds_its_stones_and_the_ring_around_them() {
    let wall = member(&upright(discontinuous()), 0).wall;
    // Three stones in the two courses that begin with half a stone, two in the one between them.
    let window = wall.window([0.79, 0.2], [1.61, 0.8]).expect("a window");
    assert_eq!(window.inside.len(), 3 + 2 + 3);
    assert_eq!(window.thickness, 0.45);
    assert_relative_eq!(window.area, 8.0 * 0.399 * 0.2, max_relative = 1e-12);
    // One at either end of each of the three courses, and four above and below.
    assert_eq!(window.around.len(), 3 * 2 + 2 * 4);
    let open = Layout { head_joint_gap: 0.005, ..upright(discontinuous()) };
    let same = member(&open, 0).wall.window([0.79, 0.2], [1.61, 0.8]).expect("a window");
    assert_eq!((same.inside.len(), same.around.len()), (8, 14), "stones beyond an open joint are neighbours");
}

#[test]
fn windows_of_random_walls_are_enclosed() {
    let rigid = |mut layout: Layout| {
        layout.outline.length = 5.0;
        layout.outline.height = 2.0;
        layout.arrangement = match layout.arrangement {
            Arrangement::Coursed { sizes, dip, least_overlap, .. } => Arrangement::Coursed {
                sizes,
                wall_size_factor: Family::Constant { value: 1.0 },
                dip,
                least_overlap,
            },
            Arrangement::Cut { sizes, dip, dip_about, .. } => {
                Arrangement::Cut { sizes, wall_size_factor: Family::Constant { value: 1.0 }, dip, dip_about }
            }
            other => other,
        };
        upright(layout)
    };
    let (from, to) = ([1.0, 0.5], [4.0, 1.5]);
    for asked in [rigid(with_wedges(two_wythes(coursed()))), rigid(with_wedges(cut(DipAbout::LongAxis)))] {
        for number in 0..20 {
            let wall = member(&asked, number).wall.with_base();
            let window = wall.window(from, to).unwrap_or_else(|e| panic!("wall {number}: {e}"));
            assert_eq!(window.thickness, 0.45);
            // A window of 3 m^2 whose jagged border cuts no stone.
            assert!((window.area - 3.0).abs() < 0.6, "{} m^2", window.area);
            assert!(window.inside.iter().chain(&window.around).all(|block| block.tag != Tag::Base));
            check_ring(&window);
        }
    }
}

/// The stones around reach beyond the window on all four sides, and none of them is inside.
fn check_ring(window: &Window) {
    let corner = |blocks: &[crate::model::Block], k: usize| {
        let boxes = blocks.iter().map(|block| block.shape.bounds());
        boxes.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), b| (low.min(b.0[k]), high.max(b.1[k])))
    };
    for k in [0, 2] {
        let (inside, around) = (corner(&window.inside, k), corner(&window.around, k));
        assert!(around.0 < inside.0 - 0.05 && around.1 > inside.1 + 0.05, "{inside:?} in {around:?}");
    }
    assert!(window.around.iter().all(|block| !window.inside.contains(block)));
}

#[test]
fn walls_without_such_a_window_say_why() {
    let wall = member(&upright(discontinuous()), 0).wall;
    let fault = |from, to| wall.window(from, to).expect_err("no window");
    assert_eq!(
        fault([1.0, 0.5], [1.0, 0.8]).to_string(),
        "a window from (1, 0.5) to (1, 0.8) m has no finite area above 0: give its lower left corner, then its upper right one"
    );
    assert!(matches!(fault([0.0, 0.0], [f64::INFINITY, 1.0]), WindowFault::NoRectangle { .. }));
    assert_eq!(
        fault([5.0, 0.0], [6.0, 1.0]).to_string(),
        "no stone has its middle between (5, 0) and (6, 1) m: the wall's stones reach from (0, 0) to (4, 1) m"
    );
    assert_eq!(
        fault([1.0, 0.1], [2.0, 0.8]).to_string(),
        "stone 2 at (1.000, 0.100) m is in the window, but has no stone below it: a window needs neighbours on every side, so \
         keep it a stone away from the wall's ends, base and top"
    );
    let side = |from, to| match fault(from, to) {
        WindowFault::Border { side, .. } => side,
        other => panic!("{other}"),
    };
    assert_eq!(side([0.0, 0.3], [2.0, 0.7]), Side::Left);
    assert_eq!(side([2.0, 0.3], [4.0, 0.7]), Side::Right);
    assert_eq!(side([1.0, 0.0], [3.0, 0.7]), Side::Below);
    assert_eq!(side([1.0, 0.3], [3.0, 1.0]), Side::Above);
    let battered = member(&discontinuous(), 0).wall.window([1.0, 0.3], [3.0, 0.5]).expect_err("battered");
    assert_eq!(
        battered.to_string(),
        "the wall reaches from y = -0.225000 to 0.125000 m at the height of 0.500 m, but from -0.225000 to 0.185000 m elsewhere \
         in the window: a window needs one thickness between upright faces, so take a wall that is not battered and does not \
         lean"
    );
    let leaning = wall.leaning(0.01).window([1.0, 0.3], [3.0, 0.7]);
    assert!(matches!(leaning, Err(WindowFault::Uneven { .. })));
}

#[test]
fn a_window_lies_about_the_middle_of_its_wall() {
    let mut wall = member(&upright(discontinuous()), 0).wall;
    let before = wall.window([1.0, 0.3], [3.0, 0.7]).expect("a window");
    for block in &mut wall.blocks {
        block.shape = block.shape.translated(&crate::math::Vec3::new(0.0, 0.225, 0.0));
    }
    let after = wall.window([1.0, 0.3], [3.0, 0.7]).expect("a window");
    let low = |window: &Window| window.inside[0].shape.bounds().0;
    assert_relative_eq!(low(&before), low(&after), epsilon = 1e-12);
    assert_relative_eq!(low(&after).y, -0.225, epsilon = 1e-12);
}

#[test]
fn parts_of_one_stone_are_in_a_window_together() {
    let mut wall = member(&upright(discontinuous()), 0).wall;
    let apart = wall.window([1.9, 0.3], [2.9, 0.7]).expect("a window").inside.len();
    let at = |x: f64, z: f64| {
        let hit = wall.blocks.iter().position(|block| {
            let (low, high) = block.shape.bounds();
            low.x < x && x < high.x && low.z < z && z < high.z
        });
        hit.expect("a stone")
    };
    // One with its middle at 1.8 m outside, its right neighbour with its middle at 2.2 m inside: together at 2.0 m inside.
    for id in [at(1.8, 0.5), at(2.2, 0.5)] {
        wall.blocks[id].group = Some("pair".to_owned());
    }
    assert_eq!(wall.window([1.9, 0.3], [2.9, 0.7]).expect("a window").inside.len(), apart + 1);
}
