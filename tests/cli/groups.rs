//! Concave stones: convex parts of one group are one rigid body in every solver.

use std::fs;

use pirca::exchange::{ReadOptions, read_obj, read_wall, read_wall_json, write_obj, write_wall_json};
use pirca::math::Vec3;
use pirca::model::{Block, Support, Tag, Wall};
use pirca::shape::{Plane, Polyhedron};
use pirca::solve::bodies::Bodies;
use serde_json::Value;

use crate::walls::{Folder, GOOD_JSON, example};

fn block(shape: Polyhedron, group: &str) -> Block {
    let group = (!group.is_empty()).then(|| group.to_owned());
    Block { group, ..Block::stone(shape, 2400.0) }
}

fn fixed(shape: Polyhedron) -> Block {
    Block { support: Support::Fixed, tag: Tag::Base, ..block(shape, "") }
}

fn cuboid(low: [f64; 3], high: [f64; 3]) -> Polyhedron {
    Polyhedron::cuboid(Vec3::from(low), Vec3::from(high))
}

/// The wall with every free block cut by a plane through its middle; the parts of a block are of one group, one behind the other or,
/// `scattered`, all second parts at the end.
fn cut(wall: &Wall, normals: &[Vec3], scattered: bool) -> Wall {
    let (mut blocks, mut end) = (Vec::new(), Vec::new());
    for (id, whole) in wall.blocks.iter().enumerate() {
        if whole.support == Support::Fixed {
            blocks.push(whole.clone());
            continue;
        }
        let plane = Plane::through(whole.shape.mass_properties().centroid, normals[id % normals.len()]);
        let (below, above) = whole.shape.cut(&plane, 1e-9);
        let part = |shape: Option<Polyhedron>| Block {
            shape: shape.unwrap(),
            group: Some(format!("stone {id}")),
            ..whole.clone()
        };
        blocks.push(part(below));
        if scattered { end.push(part(above)) } else { blocks.push(part(above)) }
    }
    blocks.extend(end);
    Wall { blocks }
}

fn analysed(wall: &Wall, more: &[&str]) -> Value {
    let folder = Folder::new();
    fs::write(folder.path("wall.json"), write_wall_json(wall)).unwrap();
    let output = folder.pirca(&[&["analyse", "wall.json", "--json"], more].concat());
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&output.stderr)))
}

fn load(answer: &Value) -> f64 {
    let [angle, multiplier] = ["collapse_angle_deg", "multiplier"].map(|key| answer[key].as_f64());
    angle.or(multiplier).unwrap_or_else(|| panic!("{answer}"))
}

#[test]
fn a_block_cut_in_two_has_the_mass_and_the_inertia_of_the_whole() {
    let shape = cuboid([0.1, 0.2, 0.0], [0.5, 0.4, 0.3])
        .cut(&Plane::through(Vec3::new(0.45, 0.35, 0.2), Vec3::new(1.0, 0.7, 0.4)), 1e-9);
    let whole = Wall { blocks: vec![block(shape.0.unwrap(), "")] };
    let one = Bodies::from_wall(&whole).all.remove(0);
    for normal in [Vec3::x(), Vec3::new(0.2, -0.5, 1.0), Vec3::new(-1.0, 1.0, 0.3)] {
        let parts = Bodies::from_wall(&cut(&whole, &[normal], false));
        let two = &parts.all[0];
        assert!((two.mass / one.mass - 1.0).abs() < 1e-12);
        assert!((two.position - one.position).norm() < 1e-12);
        assert!(
            (two.inertia - one.inertia).norm() < 1e-12 * one.inertia.norm(),
            "{} {}",
            two.inertia,
            one.inertia
        );
        assert!((two.radius - one.radius).abs() < 1e-12);
        assert!(!parts.all[1].moves() && parts.carriers == [0, 0]);
        // The parts lie where they were cut.
        let volume: f64 = (0..2).map(|part| parts.world_shape(part).volume()).sum();
        assert!((volume - whole.blocks[0].shape.volume()).abs() < 1e-12);
    }
}

/// Every block of a tower and of an arch in two: the same collapse, to 1e-9, by all three solvers.
#[test]
fn blocks_cut_in_two_give_the_same_collapse() {
    let normals = [Vec3::x(), Vec3::new(1.0, 0.2, 0.0), Vec3::new(1.0, 0.0, 0.3)];
    for (name, direction) in [("leaning-tower.json", "y+"), ("leaning-tower.json", "x-"), ("arch.json", "x+")]
    {
        let wall = read_wall(&example(name), &ReadOptions::default()).unwrap().wall;
        let normals = if name == "arch.json" { [Vec3::y(); 3] } else { normals };
        for load_name in ["tilt", "lateral"] {
            let asked = ["--phi-deg", "40", "--load", load_name, "--direction", direction];
            let found = load(&analysed(&wall, &asked));
            for scattered in [false, true] {
                let parts = analysed(&cut(&wall, &normals, scattered), &asked);
                assert!(
                    (load(&parts) / found - 1.0).abs() < 1e-9,
                    "{name} {load_name}: {} {found}",
                    load(&parts)
                );
            }
        }
    }
    // Both parts of a block that moves take part in the mechanism.
    let wall = read_wall(&example("leaning-tower.json"), &ReadOptions::default()).unwrap().wall;
    let asked = ["--phi-deg", "40"];
    let moving = |wall: &Wall| analysed(wall, &asked)["mechanism"].as_array().unwrap().len();
    assert_eq!(moving(&cut(&wall, &normals, true)), 2 * moving(&wall));
}

#[test]
fn blocks_cut_in_two_give_the_same_collapse_of_elastic_joints() {
    let ground = fixed(cuboid([-1.0, -1.0, -0.2], [2.0, 1.5, 0.0]));
    let stones = [cuboid([0.0, 0.0, 0.0], [0.4, 0.2, 0.3]), cuboid([0.1, 0.0, 0.3], [0.5, 0.2, 0.5])];
    let stones = stones.map(|shape| block(shape, ""));
    let wall = Wall { blocks: [vec![ground], stones.to_vec()].concat() };
    let parts = cut(&wall, &[Vec3::x()], true);
    // The points that follow shear move with the part of a sub-contact that presses; those of two halves lie elsewhere than those of
    // the whole once a joint opens, and take their traction along. It makes 1.5e-5 deg here, of a bracket of 7e-3 deg.
    for solver in ["implicit", "explicit"] {
        let asked = ["--phi-deg", "40", "--kn", "1e8", "--solver", solver, "--step-deg", "1"];
        let (one, two) = (analysed(&wall, &asked), analysed(&parts, &asked));
        assert!((load(&two) - load(&one)).abs() < 1e-4, "{solver}: {two} {one}");
        let count = |answer: &Value| answer["mechanism"].as_array().unwrap().len();
        assert_eq!(count(&two), 2 * count(&one), "{solver}: {two} {one}");
    }
}

/// A stone with a tail in a slot between two fixed jaws that widens by 15 deg to each side. Seen from above
///
/// ```text
///   jaw  \  tail  /  jaw       y = 0
///  -----  |      |  -----
///       head of the stone      y+
/// ```
///
/// The tail has half widths (m) where it begins and where it ends; without it the head is alone.
fn dovetail(tail: Option<[f64; 2]>) -> Wall {
    let prism = |outline: [[f64; 2]; 4]| {
        let at = |z: f64| outline.map(|[x, y]| Vec3::new(x, y, z));
        let ([a, b, c, d], [e, f, g, h]) = (at(0.0), at(0.2));
        Polyhedron::hexahedron([a, b, c, d, e, f, g, h])
    };
    let [neck, wide] = SLOT;
    let mut blocks = vec![
        fixed(cuboid([-1.0, -1.0, -0.2], [1.0, 1.0, 0.0])),
        fixed(prism([[-0.6, -0.2], [-wide, -0.2], [-neck, 0.0], [-0.6, 0.0]])),
        fixed(prism([[wide, -0.2], [0.6, -0.2], [0.6, 0.0], [neck, 0.0]])),
        block(cuboid([-0.3, 0.0, 0.0], [0.3, 0.4, 0.2]), "stone"),
    ];
    if let Some([from, to]) = tail {
        blocks.push(block(prism([[-to, -0.2], [to, -0.2], [from, 0.0], [-from, 0.0]]), "stone"));
    }
    Wall { blocks }
}

/// Half widths of the slot (m): 0.2 m further it is wider by 0.2 tan(15 deg).
const SLOT: [f64; 2] = [0.1, 0.153_589_838_486_224_55];

/// The head alone slides at the friction angle, 25 deg, and so does a stone with a straight tail that touches no jaw. A tail
/// that widens lets the stone leave its slot upwards only: tipping over would move its upper half forwards, into the jaws.
#[test]
fn a_dovetail_does_not_pull_out() {
    for (solver, within) in [("limit", 1e-4), ("implicit", 0.02), ("explicit", 0.02)] {
        let mut asked = vec!["--phi-deg", "25", "--solver", solver];
        if solver != "limit" {
            asked.extend(["--kn", "1e9", "--step-deg", "5"]);
        }
        for slides in [None, Some([0.09, 0.09])] {
            let found = load(&analysed(&dovetail(slides), &asked));
            assert!((found - 25.0).abs() < within, "{solver} {slides:?}: {found}");
        }
        let locked = analysed(&dovetail(Some(SLOT)), &asked);
        assert_eq!(locked["outcome"], "stable", "{solver}: {locked}");
        let lateral = analysed(&dovetail(Some(SLOT)), &[&asked[..], &["--load", "lateral"]].concat());
        let bears = lateral["outcome"].as_str().unwrap();
        assert!(bears == "stable" || bears == "unbounded", "{solver}: {lateral}");
    }
}

#[test]
fn parts_may_overlap_and_that_is_told() {
    let ground = fixed(cuboid([-1.0, -1.0, -0.2], [2.0, 1.5, 0.0]));
    let parts = [cuboid([0.0, 0.0, 0.0], [0.3, 0.2, 0.2]), cuboid([0.2, 0.0, 0.0], [0.5, 0.2, 0.2])];
    let of = |group: &str| {
        let parts = parts.clone().map(|shape| block(shape, group));
        Wall { blocks: [vec![ground.clone()], parts.to_vec()].concat() }
    };
    let one = analysed(&of("L"), &["--phi-deg", "30"]);
    assert!((load(&one) - 30.0).abs() < 1e-4, "{one}");
    let said = "block 1 and block 2 overlap by 100 mm: parts of group \"L\": what they share weighs twice";
    assert!(one["warnings"].as_array().unwrap().contains(&said.into()), "{one}");
    assert_eq!(analysed(&of(""), &["--phi-deg", "30"])["outcome"], "invalid_geometry");
}

#[test]
fn groups_come_back_from_both_formats_and_are_checked() {
    let wall = cut(
        &read_wall(&example("leaning-tower.json"), &ReadOptions::default()).unwrap().wall,
        &[Vec3::x()],
        true,
    );
    assert!(read_wall_json(&write_wall_json(&wall)).unwrap().wall == wall);
    let obj = read_obj(&write_obj(&wall), &ReadOptions::default()).unwrap();
    assert_eq!(obj.wall.leads(), wall.leads());
    assert!(obj.warnings.iter().all(|w| w.starts_with("fixed by their names")), "{:?}", obj.warnings);
    let shapes = |wall: &Wall| wall.blocks.iter().map(|b| b.shape.clone()).collect::<Vec<_>>();
    assert_eq!(shapes(&obj.wall), shapes(&wall));
    // A group with one part, and one that is held in part.
    let lone = GOOD_JSON.replacen("\"id\":4,", "\"id\":4,\"group\":\"keystone\",", 1);
    assert_eq!(read_wall_json(&lone).unwrap().warnings, ["block 4 is the only part of group \"keystone\""]);
    let held = lone.replacen("\"id\":0,", "\"id\":0,\"group\":\"keystone\",", 1);
    let said = read_wall_json(&held).unwrap_err().to_string();
    assert!(
        said.contains("block 4: it is free and block 0 is fixed, and both are parts of group \"keystone\""),
        "{said}"
    );
    let said = read_wall_json(&lone.replace("\"keystone\"", "7")).unwrap_err().to_string();
    assert!(said.contains("\"group\" is 7; allowed is a name"), "{said}");
}
