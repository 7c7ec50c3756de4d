//! Walls that stand by their weight, and what stands only by pressure that no weight causes.

use pirca::generate::canonical;
use pirca::math::{Vec3, cos, radians, sin};
use pirca::model::{Outcome, Support, Wall};
use pirca::shape::Polyhedron;
use pirca::solve::limit::{Flow, Loads, Settings};

use crate::fixture::{dry, irregular, on_floor, resting, stone};
use crate::limit_known::{analysis, collapse};

fn cuboid(low: [f64; 3], high: [f64; 3]) -> pirca::model::Block {
    stone(Polyhedron::cuboid(Vec3::from(low), Vec3::from(high)), 2000.0)
}

fn fixed(low: [f64; 3], high: [f64; 3]) -> pirca::model::Block {
    pirca::model::Block { support: Support::Fixed, ..cuboid(low, high) }
}

/// A bar between two fixed walls, on nothing.
fn clamped() -> Vec<pirca::model::Block> {
    vec![
        fixed([-0.3, 0.0, 0.0], [0.0, 0.3, 1.0]),
        fixed([0.6, 0.0, 0.0], [0.9, 0.3, 1.0]),
        cuboid([0.0, 0.0, 0.4], [0.6, 0.3, 0.6]),
    ]
}

/// The blocks that stand by self-stress alone: those that move by a hundredth of the fastest.
fn held(wall: &Wall, phi: f64) -> Vec<usize> {
    let moves = analysis(wall, &dry(1e9, phi), Settings::default()).self_stressed(&Loads::weight());
    let moves = moves.unwrap_or_default();
    (0..moves.len()).filter(|&i| moves[i].velocity.norm() + moves[i].spin.norm() > 0.01).collect()
}

/// A section in the plane of x and z, counter-clockwise seen from -y, drawn out from -half to half along y.
fn prism(section: &[[f64; 2]], half: f64) -> pirca::model::Block {
    let n = section.len() as u32;
    let vertices =
        [-half, half].into_iter().flat_map(|y| section.iter().map(move |[x, z]| Vec3::new(*x, y, *z)));
    let sides = (0..n).map(|i| vec![(i + 1) % n, i, i + n, (i + 1) % n + n]);
    let ends = [(0..n).collect(), (n..2 * n).rev().collect()];
    stone(Polyhedron { vertices: vertices.collect(), faces: ends.into_iter().chain(sides).collect() }, 2000.0)
}

/// An arch of nine voussoirs over a half circle, on two fixed springers: thick enough to stand by its weight.
fn arch() -> Wall {
    let at = |r: f64, i: u32| [-r * cos(radians(20.0 * f64::from(i))), r * sin(radians(20.0 * f64::from(i)))];
    let (inner, outer) = (1.0, 1.3);
    let voussoir = |i| prism(&[at(inner, i), at(inner, i + 1), at(outer, i + 1), at(outer, i)], 0.2);
    let mut blocks: Vec<_> = (0..9).map(voussoir).collect();
    blocks.push(fixed([-1.6, -0.4, -0.3], [-0.8, 0.4, 0.0]));
    blocks.push(fixed([0.8, -0.4, -0.3], [1.6, 0.4, 0.0]));
    blocks.iter().for_each(|block| block.shape.validate(1e-9).expect("a sound shape"));
    Wall { blocks }
}

#[test]
fn a_bar_between_two_walls_stands_by_a_pressure_that_no_weight_causes() {
    let wall = Wall { blocks: clamped() };
    for flow in [Flow::Associative, Flow::NonAssociative] {
        let settings = Settings { flow, ..Settings::default() };
        let limit = analysis(&wall, &dry(1e9, 40.0), settings).tilt(Vec3::y(), &[]);
        // Any tilt is borne if the walls press enough: the bound is right, and nothing moves.
        assert_eq!(limit.outcome, Outcome::Equilibrium, "{flow:?}");
        assert!(limit.mechanism.iter().all(|m| m.velocity.norm() == 0.0 && m.spin.norm() == 0.0), "{flow:?}");
    }
    assert_eq!(held(&wall, 40.0), [2]);
}

#[test]
fn one_clamped_bar_is_found_beside_a_whole_wall() {
    let mut wall = canonical::wall_72().with_base();
    let bar = wall.blocks.len() + 2;
    wall.blocks.extend(clamped().into_iter().map(|mut block| {
        block.shape = block.shape.translated(&Vec3::new(0.0, 3.0, 0.0));
        block
    }));
    assert_eq!(held(&wall, 40.0), [bar]);
}

#[test]
fn what_stands_by_its_weight_is_not_said_to_be_clamped() {
    let none: Vec<usize> = Vec::new();
    assert_eq!(held(&canonical::wall_72().with_base(), 30.0), none);
    assert_eq!(held(&on_floor(vec![resting([0.3, 0.4, 0.1], 2000.0)]), 30.0), none);
    assert_eq!(held(&arch(), 35.0), none, "an arch: its weight makes the thrust");
    for member in 0..6 {
        assert_eq!(held(&irregular(member, 2.0, 1.0), 30.0), none, "irregular wall {member}");
    }
    // The bar on a ledge: the walls need not press.
    let mut ledge = clamped();
    ledge.push(fixed([0.0, 0.0, 0.3], [0.05, 0.3, 0.4]));
    ledge.push(fixed([0.55, 0.0, 0.3], [0.6, 0.3, 0.4]));
    assert_eq!(held(&Wall { blocks: ledge }, 40.0), none);
    // A block on a slope less steep than its friction: the weight makes the pressure, the friction is needed.
    let mut slope = cuboid([-0.2, -0.2, 0.0], [0.2, 0.2, 0.2]);
    let mut plane = fixed([-1.0, -1.0, -0.2], [1.0, 1.0, 0.0]);
    let turn = nalgebra::Rotation3::from_axis_angle(&Vec3::x_axis(), radians(20.0)).into_inner();
    for block in [&mut slope, &mut plane] {
        block.shape = block.shape.moved(&turn, &Vec3::zeros());
    }
    assert_eq!(held(&Wall { blocks: vec![slope, plane] }, 25.0), none);
}

/// A prism in a groove whose sides stand at 45 degrees and whose axis dips by `dip` (deg) towards +y.
fn groove(dip: f64) -> Wall {
    let turn = nalgebra::Rotation3::from_axis_angle(&Vec3::x_axis(), radians(-dip)).into_inner();
    let mut blocks = vec![
        prism(&[[0.0, 0.0], [0.3, 0.3], [-0.3, 0.3]], 0.2),
        prism(&[[0.0, -0.2], [0.5, -0.2], [0.5, 0.5], [0.0, 0.0]], 1.0),
        prism(&[[0.0, -0.2], [0.0, 0.0], [-0.5, 0.5], [-0.5, -0.2]], 1.0),
    ];
    for (i, block) in blocks.iter_mut().enumerate() {
        block.shape = block.shape.moved(&turn, &Vec3::zeros());
        block.shape.validate(1e-9).expect("a sound shape");
        block.support = if i == 0 { Support::Free } else { Support::Fixed };
    }
    Wall { blocks }
}

#[test]
fn a_prism_in_a_groove_steeper_than_its_friction_does_not_stand_without_dilatancy() {
    // Slides along the axis when tan(dip) > tan(phi) / sin(45 deg): from 27.236 degrees on for phi = 20.
    let of = |dip: f64, flow| {
        analysis(&groove(dip), &dry(1e9, 20.0), Settings { flow, ..Settings::default() }).tilt(Vec3::y(), &[])
    };
    // At 35 degrees dilatancy does not help either.
    assert_eq!(of(35.0, Flow::Associative).outcome, Outcome::UnstableAtRest);
    assert_eq!(of(35.0, Flow::NonAssociative).outcome, Outcome::UnstableAtRest);
    for dip in [27.5, 28.0] {
        let limit = of(dip, Flow::NonAssociative);
        assert_eq!(limit.outcome, Outcome::UnstableAtRest, "{dip}");
        let share = pirca::math::tan(radians(20.0)) / (sin(radians(45.0)) * pirca::math::tan(radians(dip)));
        // The search's own accuracy.
        assert!((limit.multiplier - share).abs() < 1e-4, "{dip}: {} against {share}", limit.multiplier);
        // Tilted the other way it slides, too: it does not stand, whatever is asked.
        let settings = Settings { flow: Flow::NonAssociative, ..Settings::default() };
        let back = analysis(&groove(dip), &dry(1e9, 20.0), settings).tilt(-Vec3::y(), &[]);
        assert_eq!(back.outcome, Outcome::UnstableAtRest, "{dip}");
    }
    // Dilating sides wedge it: an upper bound, which stands by no weight.
    assert!(collapse(&of(28.0, Flow::Associative)) > 0.0);
    assert_eq!(held(&groove(28.0), 20.0), [0]);
    // Less steep, it stands, and slides at the tilt that is left.
    let limit = of(20.0, Flow::NonAssociative);
    let left = pirca::math::atan(pirca::math::tan(radians(20.0)) / sin(radians(45.0))) - radians(20.0);
    let Outcome::Collapsed { at } = limit.outcome else { panic!("{:?}", limit.outcome) };
    assert!((at.value() - left).abs() < 1e-4, "{} against {left}", at.value());
    assert_eq!(held(&groove(20.0), 20.0), Vec::<usize>::new());
}
