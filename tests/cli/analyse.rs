//! `pirca analyse`: example walls against closed forms, the arguments, and what is told about gaps and overlaps.

use std::fs;
use std::path::Path;
use std::process::Output;

use pirca::ensemble::build;
use pirca::exchange::{ReadOptions, Unit, read_obj, read_wall, read_wall_json, write_obj, write_wall_json};
use pirca::generate::canonical;
use pirca::math::{Vec3, atan, cos, degrees, radians, sin, tan};
use pirca::model::Support;
use pirca::study::Study;
use serde_json::Value;

use crate::walls::{Folder, GOOD_JSON, GOOD_OBJ, example};

fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// The JSON object about an example wall.
fn analysed(name: &str, more: &[&str]) -> Value {
    let path = example(name).display().to_string();
    let arguments = [&["analyse", &path, "--json"], more].concat();
    let output = Folder::new().pirca(&arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output));
    serde_json::from_slice(&output.stdout).expect("one JSON object on standard output")
}

/// The collapse angle (deg).
fn angle(name: &str, more: &[&str]) -> f64 {
    let answer = analysed(name, more);
    assert_eq!(
        (&answer["outcome"], &answer["multiplier"]),
        (&Value::from("collapsed"), &Value::Null),
        "{answer}"
    );
    answer["collapse_angle_deg"].as_f64().unwrap_or_else(|| panic!("{answer}"))
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} instead of {expected}");
}

/// Accuracy of the limit analysis: its own gap and the rounded numbers of the files.
const EXACT: f64 = 1e-4;

/// Each block of the tower is `step` further out than the one below: above joint k, the upper part's centroid is
/// `step (n - 1 - k) / 2` further out than its lowest block, whose edge is the nearer one for k = 0 and otherwise
/// `step` further out than that of the block below.
#[test]
fn a_leaning_tower_topples_as_its_parts_on_their_edges() {
    let (n, width, height, step) = (6, 0.5, 0.2, 0.02);
    let tangent = |towards: f64| {
        (0..n)
            .map(|k| {
                let centroid = step * f64::from(k + n - 1) / 2.0;
                let edges =
                    [f64::from(k), f64::from((k - 1).max(0))].map(|j| step * j + towards * width / 2.0);
                let edge = if k == 0 {
                    edges[0]
                } else if towards > 0.0 {
                    edges[1]
                } else {
                    edges[0]
                };
                towards * (edge - centroid) / (height * f64::from(n - k) / 2.0)
            })
            .fold(f64::INFINITY, f64::min)
    };
    let forwards = degrees(atan(tangent(1.0)));
    close(forwards, degrees(atan(1.0 / 3.0)), 1e-9);
    close(angle("leaning-tower.json", &["--phi-deg", "45"]), forwards, EXACT);
    let backwards = degrees(atan(tangent(-1.0)));
    close(angle("leaning-tower.json", &["--phi-deg", "45", "--direction", "y-"]), backwards, EXACT);
    // With little friction it slides first, in every direction.
    for direction in ["x+", "x-", "y+", "y-"] {
        close(angle("leaning-tower.json", &["--phi-deg", "12", "--direction", direction]), 12.0, EXACT);
    }
}

/// A semicircular arch stands if its thickness is more than 0.1075 of its mean radius (Milankovitch 1907); 31
/// voussoirs need hardly less.
#[test]
fn an_arch_stands_if_it_is_thick_enough() {
    let thick = analysed("arch.json", &["--phi-deg", "45", "--load", "lateral", "--direction", "x+"]);
    assert_eq!(
        (&thick["outcome"], &thick["blocks"], &thick["joints"]),
        (&"collapsed".into(), &33.into(), &32.into())
    );
    let multiplier = thick["multiplier"].as_f64().unwrap();
    assert!((0.1..0.2).contains(&multiplier), "{multiplier}");
    // Symmetric: the same to the other side; and for c = 0 the tilt is the angle of the multiplier.
    let back = analysed("arch.json", &["--phi-deg", "45", "--load", "lateral", "--direction", "x-"]);
    close(back["multiplier"].as_f64().unwrap(), multiplier, 1e-6);
    close(angle("arch.json", &["--phi-deg", "45", "--direction", "x+"]), degrees(atan(multiplier)), EXACT);
    let thin = analysed("thin-arch.json", &["--phi-deg", "45"]);
    assert_eq!((&thin["outcome"], &thin["collapse_angle_deg"]), (&"unstable_at_rest".into(), &Value::Null));
}

/// An arch of one span falls by four hinges, which alternate between its inside and its outside; elastic joints let its neighbours
/// open as well, and yet it turns about four.
#[test]
fn an_arch_falls_by_four_hinges() {
    let path = example("arch.json").display().to_string();
    for more in [&["--solver", "limit"][..], &["--solver", "implicit", "--kn", "1e10"]] {
        let folder = Folder::new();
        let asked = ["analyse", &path, "--phi-deg", "40", "--direction", "x+", "--out", "seen"];
        let output = folder.pirca(&[&asked[..], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
        let joints = fs::read_to_string(folder.path("seen/joints.csv")).unwrap();
        let states: Vec<&str> = joints.lines().skip(1).filter_map(|line| line.split(',').nth(2)).collect();
        let count = |state: &str| states.iter().filter(|of| **of == state).count();
        assert_eq!((count("hinge"), count("closed")), (4, 28), "{more:?}: {states:?}");
        // Four in the arch and one in the legend.
        let picture = fs::read_to_string(folder.path("seen/mechanism.svg")).unwrap();
        assert_eq!(picture.matches("<circle").count(), 5, "{more:?}");
    }
}

/// The wall with an opening topples as a whole about its front edge: half its thickness over its centroid's height. Its
/// upper parts are less slender, and the lintel and the courses above load both piers alike.
#[test]
fn a_wall_with_an_opening_topples_as_a_whole() {
    let file = read_wall(&example("opening.json"), &ReadOptions::default()).unwrap();
    let (mut volume, mut moment) = (0.0, 0.0);
    for block in file.wall.blocks.iter().filter(|b| b.support == Support::Free) {
        let mass = block.shape.mass_properties();
        volume += mass.volume;
        moment += mass.volume * mass.centroid.z;
    }
    close(moment / volume, 0.66, 1e-12);
    for direction in ["y+", "y-"] {
        let found = angle("opening.json", &["--phi-deg", "40", "--direction", direction]);
        close(found, degrees(atan(0.15 * volume / moment)), EXACT);
    }
    let mechanism = analysed("opening.json", &["--phi-deg", "40"])["mechanism"].as_array().unwrap().len();
    assert_eq!(mechanism, 30);
}

/// The second leg holds the first: the corner bears more than the leg alone, whose angle is atan(t / H) = atan(1 / 6).
#[test]
fn a_corner_bears_more_than_a_straight_wall() {
    for direction in ["y+", "y-", "x+", "x-"] {
        let found = angle("corner.json", &["--phi-deg", "40", "--direction", direction]);
        assert!(found > 1.2 * degrees(atan(1.0 / 6.0)) && found < 40.0, "{direction}: {found}");
    }
    // Mirrored at the plane x = y the courses change places: hardly another wall (0.003 deg found).
    let [x, y] = ["x+", "y+"].map(|to| angle("corner.json", &["--phi-deg", "40", "--direction", to]));
    close(x, y, 0.05);
}

/// A column of drums topples about the side of its base, apothem 0.25 m, or parts of it above; a cone frustum of radii R
/// and 0.6 R has its centroid at 0.41 of its height. Split into triangles with a vertex per corner it is the same column.
#[test]
fn a_column_of_drums_is_the_same_in_triangles() {
    let cap = 0.1 * (1.0 + 2.0 * 0.6 + 3.0 * 0.36) / (4.0 * (1.0 + 0.6 + 0.36));
    let (drums, cap_volume) = (0.9, 0.1 * (1.0 + 0.6 + 0.36) / 3.0);
    let centroid = (drums * 0.45 + cap_volume * (0.9 + cap)) / (drums + cap_volume);
    // Ring corners lie half a side beside the axes: sides look along +-x and +-y.
    let expected = degrees(atan(0.25 / centroid));
    for name in ["drums.obj", "drums-triangles.obj"] {
        for direction in ["y+", "x-"] {
            close(angle(name, &["--phi-deg", "40", "--direction", direction]), expected, EXACT);
        }
    }
    let options = ReadOptions { density: Some(2000.0), ..ReadOptions::default() };
    let [whole, pieces] =
        ["drums.obj", "drums-triangles.obj"].map(|n| read_wall(&example(n), &options).unwrap().wall);
    for (a, b) in whole.blocks.iter().zip(&pieces.blocks) {
        assert_eq!(
            (a.shape.faces.len(), a.shape.vertices.len()),
            (b.shape.faces.len(), b.shape.vertices.len())
        );
        // The triangles' file has nine digits after the point.
        close(a.shape.volume(), b.shape.volume(), 1e-8);
    }
    assert_eq!(whole.blocks[1].shape.faces.len(), 18);
}

/// What a program has written is read back to the bit; OBJ carries no ids, but its densities and supports.
#[test]
fn walls_that_pirca_writes_are_read_back_to_the_bit() {
    let wall = canonical::wall_72().with_base();
    let read = read_wall_json(&write_wall_json(&wall)).unwrap();
    assert!(read.wall == wall && read.warnings.is_empty(), "{:?}", read.warnings);
    assert_eq!(read.ids, (0..73).collect::<Vec<u64>>());
    assert!(read_obj(&write_obj(&wall), &ReadOptions::default()).unwrap().wall == wall);
}

/// Dips, wedges and cuts turn and lean the stones of a study: corners of all angles, small faces, no round numbers.
#[test]
fn the_walls_of_a_study_are_read_back_to_the_bit() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/joint-arrangement");
    for variant in [None, Some("cut")] {
        let study = Study::load(&folder, variant).unwrap().study;
        for arm in 0..study.arms.len() as u32 {
            for member in 0..3 {
                let wall = build(&study, arm, member).unwrap().wall.with_base();
                let read = read_wall_json(&write_wall_json(&wall)).unwrap_or_else(|e| panic!("{e}"));
                assert!(read.wall == wall, "arm {arm}, member {member}");
                assert!(read_obj(&write_obj(&wall), &ReadOptions::default()).unwrap().wall == wall);
            }
        }
    }
}

#[test]
fn units_and_defaults_are_as_documented() {
    let metres = read_wall_json(GOOD_JSON).unwrap();
    assert_eq!(metres.ids, [0, 4, 7, 9]);
    assert_eq!(metres.wall.blocks[0].support, Support::Fixed);
    let name = |text: &str| read_wall_json(text).unwrap().wall;
    assert_eq!(name(&GOOD_JSON.replacen("\"unit\":\"m\",", "", 1)), metres.wall);
    let centimetres = name(&GOOD_JSON.replacen("\"unit\":\"m\"", "\"unit\":\"cm\"", 1));
    assert_eq!(centimetres.blocks[2].shape.vertices[1], Vec3::new(0.5 / 100.0, 0.0, 0.2 / 100.0));
    let options =
        ReadOptions { unit: Some(Unit::Centimetre), density: Some(1900.0), ..ReadOptions::default() };
    let obj = read_obj(GOOD_OBJ, &options).unwrap();
    assert_eq!(obj.names, ["block 0 (Base)", "block 1 (Stone)", "block 2 (Upper.001)"]);
    let densities: Vec<f64> = obj.wall.blocks.iter().map(|b| b.density).collect();
    assert_eq!(densities, [1900.0, 1900.0, 2300.0]);
    assert_eq!(obj.wall.blocks[1].shape.vertices[1].x, 0.5 / 100.0);
    assert_eq!(obj.warnings, ["fixed by their names: block 0 (Base)"]);
    let groups = GOOD_OBJ.replace("o ", "g ");
    assert_eq!(read_obj(&groups, &options).unwrap().wall, obj.wall);
    let assumed = read_obj(GOOD_OBJ, &ReadOptions::default()).unwrap();
    assert!(
        assumed.warnings[0].contains("density of 1 object(s) not stated: 2400 kg/m^3 is taken"),
        "{:?}",
        assumed.warnings
    );
}

/// A block turned by an odd angle, its faces in triangles, its corners rounded to a hundredth of a millimetre.
#[test]
fn rounded_triangles_are_merged_to_plane_faces() {
    let (c, s) = (cos(radians(17.0)), sin(radians(17.0)));
    let corner = |x: f64, y: f64, z: f64| {
        let r = |v: f64| (v * 1e5).round() / 1e5;
        format!("[{},{},{}]", r(c * x - s * z), r(y), r(s * x + c * z + 0.2))
    };
    let mut corners = Vec::new();
    for (x, y, z) in [
        (0., 0., 0.),
        (0.4, 0., 0.),
        (0.4, 0.2, 0.),
        (0., 0.2, 0.),
        (0., 0., 0.3),
        (0.4, 0., 0.3),
        (0.4, 0.2, 0.3),
        (0., 0.2, 0.3),
    ] {
        corners.push(corner(x, y, z));
    }
    let mut faces = String::new();
    for [a, b, c, d] in [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]] {
        faces += &format!("[{a},{b},{c}],[{a},{c},{d}],");
    }
    let block = format!(
        "{{\"id\":5,\"vertices\":[{}],\"faces\":[{}],\"density\":2400}},",
        corners.join(","),
        faces.trim_end_matches(',')
    );
    let text = GOOD_JSON.replacen("{\"id\":4", &format!("{block}{{\"id\":4"), 1);
    let shape = read_wall_json(&text).unwrap().wall.blocks.remove(1).shape;
    assert_eq!((shape.faces.len(), shape.vertices.len()), (6, 8));
    close(shape.volume(), 0.4 * 0.2 * 0.3, 1e-5);
}

/// The upper block of the good wall lifted by a gap, or sunk.
fn lifted(by: f64) -> String {
    let (from, to) = (format!("{}", 0.2 + by), format!("{}", 0.4 + by));
    let at = GOOD_JSON.find("{\"id\":7").unwrap();
    let (before, rest) = GOOD_JSON.split_at(at);
    let (block, after) = rest.split_once("\"faces\"").unwrap();
    let block = block.replace("0.2]", &format!("{from}]")).replace("0.4]", &format!("{to}]"));
    format!("{before}{block}\"faces\"{after}")
}

#[test]
fn small_gaps_and_overlaps_are_told_with_their_size() {
    let folder = Folder::new();
    let told = |by: f64, more: &[&str]| {
        fs::write(folder.path("wall.json"), lifted(by)).unwrap();
        let output = folder.pirca(&[&["analyse", "wall.json", "--phi-deg", "30", "--json"], more].concat());
        let answer: Value =
            serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", text(&output)));
        (output.status.code(), answer)
    };
    let (code, answer) = told(-2e-4, &[]);
    assert_eq!((code, &answer["warnings"][0]), (Some(0), &"block 4 and block 7 overlap by 0.2 mm".into()));
    assert_eq!(answer["joints"], 3);
    let (code, answer) = told(1e-4, &[]);
    assert_eq!((code, &answer["outcome"]), (Some(3), &"invalid_geometry".into()));
    let fix = answer["faults"][0]["fix"].as_str().unwrap();
    assert!(
        fix.contains("block 4 and block 7, are 0.1 mm apart") && fix.contains("--touch-tolerance"),
        "{answer}"
    );
    // Within the tolerance asked for it is a joint: 1e-4 m in a wall of some 1.2 m.
    let (code, answer) = told(1e-4, &["--touch-tolerance", "1e-4"]);
    assert_eq!(
        (code, &answer["outcome"], &answer["joints"]),
        (Some(0), &"collapsed".into(), &3.into()),
        "{answer}"
    );
    assert_eq!(answer["warnings"], Value::Array(vec![]));
    // Beside one another, with a gap: each stands by itself, and the gap is told.
    let beside = GOOD_JSON.replace(
        "[0.8,0,0],[1.1,0,0],[0.9,0.3,0],[0.9,0.1,0.2]",
        "[0.5005,0,0],[0.8,0,0],[0.5005,0.3,0],[0.5005,0.1,0.2]",
    );
    fs::write(folder.path("wall.json"), beside).unwrap();
    let said = text(&folder.pirca(&["analyse", "wall.json", "--phi-deg", "30"]));
    assert!(
        said.contains("warning: a gap of 0.5 mm between block 4 and block 9: they do not touch"),
        "{said}"
    );
}

/// A block 0.15 m wide and 0.375 m high of 889 N per metre on an elastic bed of 5e7 Pa/m: 17.088 deg by the closed form
/// (pressure and its line of action on the block's face), between brackets of 0.01 deg.
#[test]
fn an_elastic_bed_costs_as_many_degrees_as_the_closed_form_says() {
    let folder = Folder::new();
    let cuboid = |y: [f64; 2], z: [f64; 2]| {
        let [[a, b], [c, d]] = [y, z];
        format!(
            "[[0,{a},{c}],[1,{a},{c}],[1,{b},{c}],[0,{b},{c}],[0,{a},{d}],[1,{a},{d}],[1,{b},{d}],[0,{b},{d}]]"
        )
    };
    let faces = "[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]";
    let density = 889.0 / (0.15 * 0.375 * 9.806_65);
    let wall = format!(
        "{{\"blocks\":[{{\"id\":1,\"vertices\":{},\"faces\":{faces},\"density\":{density}}},{{\"id\":2,\"vertices\":{},\"faces\":{faces},\"fixed\":true}}]}}",
        cuboid([0.0, 0.15], [0.0, 0.375]),
        cuboid([-0.5, 0.65], [-0.1, 0.0])
    );
    fs::write(folder.path("block.json"), wall).unwrap();
    for solver in ["implicit", "explicit"] {
        let asked = ["analyse", "block.json", "--phi-deg", "60", "--kn", "5e7", "--solver", solver, "--json"];
        let output = folder.pirca(&asked);
        let answer: Value =
            serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", text(&output)));
        assert_eq!((&answer["outcome"], &answer["joints"]), (&"collapsed".into(), &1.into()), "{answer}");
        close(answer["collapse_angle_deg"].as_f64().unwrap(), 17.088, 0.02);
        assert_eq!(answer["mechanism"], serde_json::json!([1]), "{answer}");
    }
}

/// A bar clamped between two walls: any pressure between them holds it, none is caused by weight.
#[test]
fn a_bar_between_two_walls_moves_nowhere_and_is_warned_of() {
    let folder = Folder::new();
    let faces = "[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]";
    let block = |id: u32, x: [f64; 2], z: [f64; 2], fixed: bool| {
        let corner = |i: usize, z: f64| {
            let (right, back) = ([0, 1, 1, 0][i], [0, 0, 1, 1][i]);
            format!("[{}, {}, {z}]", x[right], [-0.5, 0.5][back])
        };
        let corners: Vec<String> = (0..8).map(|i| corner(i % 4, z[i / 4])).collect();
        format!(
            "{{\"id\":{id},\"vertices\":[{}],\"faces\":{faces},\"density\":2000,\"fixed\":{fixed}}}",
            corners.join(",")
        )
    };
    let blocks = [
        block(0, [-1.1, -0.9], [-1.0, 1.4], true),
        block(1, [0.9, 1.1], [-1.0, 1.4], true),
        block(2, [-0.9, 0.9], [0.0, 0.4], false),
    ];
    fs::write(folder.path("bar.json"), format!("{{\"blocks\":[{}]}}", blocks.join(","))).unwrap();
    for flow in ["associative", "non-associative"] {
        let output = folder.pirca(&["analyse", "bar.json", "--phi-deg", "40", "--flow", flow, "--json"]);
        let answer: Value =
            serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", text(&output)));
        assert_eq!((&answer["outcome"], &answer["mechanism"]), (&"stable".into(), &serde_json::json!([])));
        assert!(answer["warnings"].to_string().contains("forces that no weight causes"), "{answer}");
    }
    let output = folder.pirca(&["analyse", "bar.json", "--phi-deg", "40"]);
    assert!(!text(&output).contains("moves at collapse"), "{}", text(&output));
}

/// A stone on a three-cornered face slides at its friction angle wherever its weight acts on that face; 0.25 deg for friction
/// at the middle of sub-contacts.
#[test]
fn a_stone_slides_at_its_friction_angle_whatever_its_shape() {
    let folder = Folder::new();
    let wall = "{\"blocks\":[{\"id\":0,\"vertices\":[[-2,-2,-0.2],[2,-2,-0.2],[2,2,-0.2],[-2,2,-0.2],[-2,-2,0],[2,-2,0],[2,2,0],[-2,2,0]],\"faces\":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],\"fixed\":true},{\"id\":1,\"vertices\":[[0,0,0],[0.4,0,0],[0,0.4,0],[0.13,0.13,0.5]],\"faces\":[[0,2,1],[0,1,3],[1,2,3],[2,0,3]],\"density\":2400}]}";
    fs::write(folder.path("stone.json"), wall).unwrap();
    for (solver, kn, direction) in
        [("implicit", "1e9", "x-"), ("implicit", "1e12", "y-"), ("explicit", "1e12", "x-")]
    {
        let asked = [
            "analyse",
            "stone.json",
            "--phi-deg",
            "40",
            "--kn",
            kn,
            "--solver",
            solver,
            "--direction",
            direction,
            "--json",
        ];
        let output = folder.pirca(&asked);
        let answer: Value =
            serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", text(&output)));
        close(answer["collapse_angle_deg"].as_f64().unwrap(), 40.0, 0.25);
    }
}

/// Two solvers of the same joints find the same angle of an example, below that of rigid blocks.
fn the_elastic_solvers_agree_on(name: &str, to: &str) {
    let asked = ["--phi-deg", "40", "--direction", to];
    let elastic = |solver| angle(name, &[&asked[..], &["--kn", "1e9", "--solver", solver]].concat());
    let (implicit, explicit, rigid) = (elastic("implicit"), elastic("explicit"), angle(name, &asked));
    close(implicit, explicit, 0.05);
    assert!(implicit < rigid, "{name}: {implicit} against {rigid}");
}

#[test]
#[ignore = "slow: 20 s of processor time"]
fn the_elastic_solvers_agree_below_the_limit_of_rigid_blocks() {
    the_elastic_solvers_agree_on("leaning-tower.json", "x+");
    let lateral = |solver: &str| {
        let asked =
            ["--phi-deg", "40", "--load", "lateral", "--kn", "1e9", "--step-deg", "2", "--solver", solver];
        analysed("leaning-tower.json", &asked)["multiplier"].as_f64().unwrap()
    };
    close(lateral("implicit"), lateral("explicit"), 1e-3);
}

#[test]
#[ignore = "slow: three walls to their fall by the explicit solver, half a minute of processor time"]
fn the_elastic_solvers_agree_on_an_arch_drums_and_an_opening() {
    for (name, to) in [("arch.json", "x+"), ("drums.obj", "y+"), ("opening.json", "y+")] {
        the_elastic_solvers_agree_on(name, to);
    }
}

/// 0.2 mm of overlap at 1e10 Pa/m is 2000 kPa; 0.3998 m of 2400 kg/m^3 weigh 9.410 kPa. Rigid blocks take no notice.
#[test]
fn the_prestress_of_an_overlap_is_told_to_those_whom_it_concerns() {
    let folder = Folder::new();
    fs::write(folder.path("wall.json"), lifted(-2e-4)).unwrap();
    let said =
        |more: &[&str]| text(&folder.pirca(&[&["analyse", "wall.json", "--phi-deg", "30"], more].concat()));
    let elastic = said(&["--solver", "implicit", "--kn", "1e10"]);
    assert!(
        elastic.contains("2000.000 kPa at kn = 1e10 Pa/m") && elastic.contains("makes 9.410 kPa"),
        "{elastic}"
    );
    assert!(!said(&[]).contains("kPa"));
}

#[test]
fn the_json_object_holds_what_is_promised() {
    let answer = analysed("leaning-tower.json", &["--phi-deg", "30"]);
    let keys: Vec<&str> = answer.as_object().unwrap().keys().map(String::as_str).collect();
    for key in [
        "outcome",
        "collapse_angle_deg",
        "multiplier",
        "between",
        "blocks",
        "joints",
        "seconds",
        "warnings",
        "solver",
        "load",
        "direction",
        "mechanism",
        "loose",
        "meaning",
        "reason",
    ] {
        assert!(keys.contains(&key), "{key} is missing: {answer}");
    }
    assert_eq!(
        (&answer["blocks"], &answer["joints"], &answer["solver"]),
        (&7.into(), &6.into(), &"limit".into())
    );
    assert!(answer["seconds"].as_f64().unwrap() > 0.0);
    assert!(answer["meaning"].as_str().unwrap().contains("upper bound"));
    let lateral = analysed("leaning-tower.json", &["--phi-deg", "30", "--load", "lateral"]);
    close(lateral["multiplier"].as_f64().unwrap(), 1.0 / 3.0, 1e-6);
    assert_eq!(lateral["collapse_angle_deg"], Value::Null);
    let other = analysed("leaning-tower.json", &["--phi-deg", "30", "--flow", "non-associative"]);
    assert!(other["meaning"].as_str().unwrap().contains("neither a bound nor unique"), "{other}");
    // Cohesion holds the joints' shear, not their opening: what topples does so as before.
    close(
        angle("leaning-tower.json", &["--phi-deg", "30", "--cohesion", "1e6"]),
        degrees(atan(1.0 / 3.0)),
        EXACT,
    );
    let sliding = angle("leaning-tower.json", &["--phi-deg", "10", "--cohesion", "100"]);
    // The base slides: c A + W cos(a) tan(phi) = W sin(a), W = 0.3 m^3 of 2400 kg/m^3.
    let weight = 0.3 * 2400.0 * 9.806_65;
    let a = radians(sliding);
    close(100.0 * 0.25 + weight * cos(a) * tan(radians(10.0)), weight * sin(a), 1e-3 * weight);
}

#[test]
fn arguments_that_make_no_sense_are_refused_with_what_is_allowed() {
    let folder = Folder::new();
    fs::write(folder.path("wall.json"), GOOD_JSON).unwrap();
    for (more, said) in [
        (&["--phi-deg", "-5"][..], "allowed is a number from 0 to 89 degrees"),
        (&["--phi-deg", "nan"], "allowed is a number from 0 to 89 degrees"),
        (&["--phi-deg", "90"], "allowed is a number from 0 to 89 degrees"),
        (&["--phi-deg", "30", "--kn", "-1e9"], "1000 to 1e16 Pa/m"),
        (&["--phi-deg", "30", "--ks", "0"], "1000 to 1e16 Pa/m"),
        (&["--phi-deg", "30", "--cohesion", "-1"], "0 to 1e9 Pa"),
        (&["--phi-deg", "30", "--step-deg", "0"], "0.01 to 45 degrees"),
        (&["--phi-deg", "30", "--touch-tolerance", "1"], "1e-12 to 0.001 of the wall's size"),
        (&["--phi-deg", "30", "--direction", "z+"], "or x+, x-, y+, y-"),
        (&["--phi-deg", "30", "--direction", "400"], "-360 to 360 degrees"),
        (&["--phi-deg", "30", "--solver", "magic"], "limit"),
        (&["--phi-deg", "30", "--load", "seismic"], "lateral"),
        (
            &["--phi-deg", "30", "--solver", "limit,implicit"],
            "--kn PA_PER_M is required for the implicit solver",
        ),
        (&["--phi-deg", "30", "--solver", "explicit"], "--kn PA_PER_M is required for the explicit solver"),
        (&["--phi-deg", "30", "--unit", "mm"], "a wall.json states its own"),
    ] {
        let output = folder.pirca(&[&["analyse", "wall.json"], more].concat());
        assert_eq!(output.status.code(), Some(2), "{more:?}: {}", text(&output));
        assert!(text(&output).contains(said), "{more:?}: {}", text(&output));
    }
    let missing = folder.pirca(&["analyse", "none.json", "--phi-deg", "30"]);
    assert!(
        missing.status.code() == Some(3) && text(&missing).contains("none.json: cannot be read"),
        "{}",
        text(&missing)
    );
    let told =
        text(&folder.pirca(&["analyse", "wall.json", "--phi-deg", "30", "--kn", "1e9", "--step-deg", "1"]));
    assert!(
        told.contains("--kn and --ks do not matter") && told.contains("--step-deg does not matter"),
        "{told}"
    );
}

/// A block of 0.4 m x 0.2 m x 0.6 m on the ground, both turned about the vertical.
fn turned_block(turn_deg: f64) -> String {
    let (c, s) = (cos(radians(turn_deg)), sin(radians(turn_deg)));
    let corner = |x: f64, y: f64, z: f64| format!("[{:?}, {:?}, {z:?}]", c * x - s * y, s * x + c * y);
    let block = |id: u32, [a, b]: [f64; 2], [low, high]: [f64; 2], more: &str| {
        let around = [(-a, -b), (a, -b), (a, b), (-a, b)];
        let corners: Vec<String> =
            [low, high].iter().flat_map(|&z| around.map(|(x, y)| corner(x, y, z))).collect();
        let faces = "[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]";
        format!("{{\"id\": {id}, {more}, \"vertices\": [{}], \"faces\": {faces}}}", corners.join(", "))
    };
    let ground = block(0, [1.0, 1.0], [-0.2, 0.0], "\"fixed\": true");
    let stone = block(1, [0.2, 0.1], [0.0, 0.6], "\"density\": 2400");
    format!("{{\"blocks\": [{ground}, {stone}]}}")
}

/// A block topples when the line of its weight leaves its base: the base reaches a / |cos| or b / |sin| in a direction, and the
/// centroid stands 0.3 m above it. What is turned with the direction falls at the same tilt.
#[test]
fn a_wall_is_tilted_in_any_direction() {
    let folder = Folder::new();
    let falls = |turn: f64, more: &[&str]| {
        fs::write(folder.path("block.json"), turned_block(turn)).unwrap();
        let arguments = [&["analyse", "block.json", "--phi-deg", "60", "--json"], more].concat();
        let output = folder.pirca(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
        let answer: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
        let angle = answer["collapse_angle_deg"].as_f64().unwrap_or_else(|| panic!("{answer}"));
        (angle, answer["direction"].clone(), answer["direction_deg"].clone())
    };
    for direction in [-120.0, 10.0, 60.0, 100.0, 200.5] {
        let (c, s) = (cos(radians(direction)), sin(radians(direction)));
        let reach = (0.2 / c.abs()).min(0.1 / s.abs());
        let asked = format!("{direction}");
        let (angle, name, told) = falls(0.0, &["--direction", &asked]);
        close(angle, degrees(atan(reach / 0.3)), EXACT);
        assert_eq!(name, format!("{} deg", (direction + 360.0) % 360.0));
        // Degrees come back from radians, rounded by some units in the last place.
        close(told.as_f64().unwrap(), (direction + 360.0) % 360.0, 1e-12);
        close(falls(-direction, &["--direction", "x+"]).0, angle, EXACT);
    }
    // Elastic joints: the same block seen from its own axes, to the width of both brackets.
    let elastic = ["--solver", "implicit", "--kn", "1e9"];
    let aslant = falls(0.0, &[&elastic[..], &["--direction", "60"]].concat()).0;
    close(falls(-60.0, &[&elastic[..], &["--direction", "0"]].concat()).0, aslant, 0.02);
    // The angle of an axis is the axis, bit for bit.
    for (angle, axis) in [("0", "x+"), ("90", "y+"), ("-180", "x-"), ("270", "y-")] {
        for solver in [&[][..], &elastic] {
            let [by_angle, by_name] =
                [angle, axis].map(|to| falls(0.0, &[solver, &["--direction", to]].concat()));
            assert_eq!(by_angle, by_name);
            assert_eq!(by_angle.1, axis);
        }
    }
}

#[test]
fn help_shows_an_example_the_format_and_the_exit_codes() {
    let help = text(&Folder::new().pirca(&["analyse", "--help"]));
    for said in
        ["Usage: pirca analyse", "Example: pirca", "Exit codes: 0", "\"vertices\"", "fixed", "--json", "mm"]
    {
        assert!(help.contains(said), "{said} is missing: {help}");
    }
}

/// What `--out` writes about a tower that leans: the joint under block k carries the weight above it, turned by the tilt.
#[test]
fn joints_carry_what_stands_on_them_and_a_tower_turns_about_its_foot() {
    let folder = Folder::new();
    let path = example("leaning-tower.json").display().to_string();
    for (solver, kn, close_to) in [
        ("limit", "", 1e-6),
        ("implicit", "--kn=1e9", 1e-3),
        ("explicit", "--kn=1e9", 1e-2),
        ("nonsmooth", "", 1e-6),
    ] {
        let mut asked = vec!["analyse", &path, "--phi-deg", "35", "--solver", solver, "--out", solver];
        asked.extend((!kn.is_empty()).then_some(kn));
        let output = folder.pirca(&asked);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
        assert!(text(&output).contains(&format!("written to {solver}")));
        let file = |name: &str| fs::read_to_string(folder.path(&format!("{solver}/{name}"))).expect(name);
        let whole: Value = serde_json::from_str(&file("analysis.json")).expect("JSON");
        let angle = radians(whole["collapse_angle_deg"].as_f64().expect("it falls"));
        let joints = whole["joint_states"].as_array().expect("joints");
        assert_eq!(joints.len(), 6);
        let weight = |blocks: usize| 2400.0 * 0.5 * 0.5 * 0.2 * 9.80665 * blocks as f64;
        for (k, joint) in joints.iter().enumerate() {
            let force = |axis: usize| joint["force_on_second_n"][axis].as_f64().expect("a number");
            let above = weight(6 - k);
            // Downhill is y+; what the joint gives holds against it. Blocks of elastic joints have turned by a few hundredths.
            assert!((force(2) / (above * cos(angle)) - 1.0).abs() < 10.0 * close_to, "{solver} {joint}");
            assert!((force(1) / (above * sin(angle)) + 1.0).abs() < 10.0 * close_to, "{solver} {joint}");
            let area = joint["area_m2"].as_f64().expect("an area");
            let pressure = joint["pressure_pa"].as_f64().expect("a pressure");
            assert!((pressure * area / (above * cos(angle)) - 1.0).abs() < 0.02, "{solver} {joint}");
        }
        // It turns about the edge of its foot at y = 0.5: what lies h above it moves out by h times the turn.
        let blocks = whole["block_states"].as_array().expect("blocks");
        assert!(
            blocks[0]["fixed"] == true && blocks[0]["moves"] == false && blocks[0]["mechanism"][1] == 0.0
        );
        for (k, block) in blocks.iter().enumerate().skip(1) {
            let [out, turn] =
                [&block["mechanism"][1], &block["mechanism_turn"][0]].map(|x| x.as_f64().expect("a number"));
            let lever = 0.1 + 0.2 * (k as f64 - 1.0);
            assert!((out / (-turn * lever) - 1.0).abs() < 0.2, "{solver} {block}");
        }
        let opened = joints[0]["opening"].as_f64().expect("an opening");
        // Joints that are rigid do not open before the fall.
        let widest = if solver == "nonsmooth" { 1e-9 } else { opened };
        assert!(joints.iter().all(|joint| joint["opening"].as_f64() <= Some(widest)) && opened > 0.0);
        for (name, lines) in [("blocks.csv", 8), ("joints.csv", 7)] {
            assert_eq!(file(name).lines().count(), lines, "{name}");
            let columns = |line: &str| line.split(',').count();
            assert!(
                file(name).lines().all(|line| columns(line) == columns(file(name).lines().next().unwrap()))
            );
        }
        assert!(file("mechanism.svg").contains("The wall collapses at a tilt of"));
        // The tower is 0.5 m long and 1.2 m high, and pushed towards y+ in the section and in the plan.
        let views = file("views.svg");
        assert!(views.contains(">0.500 m<") && views.contains(">1.200 m<"), "{views}");
        assert_eq!(views.matches(">load y+<").count(), 2, "{views}");
        let page = file("report.html");
        assert!(page.contains("figure-views") && !page.contains("figure-mended"));
        // The foot alone is open but for its front edge.
        let states: Vec<&Value> = joints.iter().map(|joint| &joint["state"]).collect();
        assert_eq!(states, ["hinge", "closed", "closed", "closed", "closed", "closed"], "{solver}");
        assert!(file("joints.csv").contains("\n0,1,hinge,"));
        assert!(file("mechanism.svg").contains("1 hinge: joints open but for an edge that presses"));
        assert_eq!(file("rest.vtu").contains("Name=\"displacement\""), solver != "limit");
        assert!(file("mechanism.vtu").contains("NumberOfCells=\"7\""));
        let glb = fs::read(folder.path(&format!("{solver}/wall.glb"))).expect("wall.glb");
        assert_eq!(
            (&glb[..4], u32::from_le_bytes(glb[8..12].try_into().unwrap()) as usize),
            (&b"glTF"[..], glb.len())
        );
        // Six blocks turn, each by a place and a rotation; the ground does not.
        let described: Value = serde_json::from_slice(
            &glb[20..20 + u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize],
        )
        .expect("JSON");
        assert_eq!(described["meshes"].as_array().expect("meshes").len(), 7);
        assert_eq!(described["animations"][0]["channels"].as_array().expect("channels").len(), 12);
    }
}

/// The tower leans towards y+, and falls that way at the least tilt, see the first test.
#[test]
fn the_weakest_direction_is_found_and_all_that_were_tried_are_told() {
    let answer = analysed("leaning-tower.json", &["--phi-deg", "45", "--worst-direction"]);
    close(answer["direction_deg"].as_f64().expect("an angle"), 90.0, 0.25);
    close(answer["collapse_angle_deg"].as_f64().expect("it falls"), degrees(atan(1.0 / 3.0)), EXACT);
    let tried = answer["directions"].as_array().expect("a list");
    assert!(
        tried.len() >= 24
            && tried.iter().all(|of| of["bears"].as_f64() >= answer["collapse_angle_deg"].as_f64())
    );
    let path = example("leaning-tower.json").display().to_string();
    let refused = |more: &[&str]| {
        let output = Folder::new().pirca(&[&["analyse", &path, "--phi-deg", "45"], more].concat());
        assert_eq!(output.status.code(), Some(2), "{}", text(&output));
        text(&output)
    };
    assert!(refused(&["--worst-direction", "--direction", "y+"]).contains("--direction"));
    assert!(refused(&["--colour", "slip"]).contains("--out"));
}
