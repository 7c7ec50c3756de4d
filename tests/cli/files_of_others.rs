//! Files as other programs write them: corners once per face, T-junctions, names that come again, warped faces, y up, one's own
//! tags, many equal faults; and gaps that someone who models by hand leaves.

use std::fs;

use pirca::exchange::{
    ReadOptions, Up, WallFile, read_obj, read_wall_json, read_wall_json_with, write_wall_json,
};
use pirca::math::{Vec3, atan, cos, degrees, radians, sin};
use pirca::model::Tag;
use pirca::shape::Polyhedron;
use serde_json::Value;

use crate::mutated_walls::Draws;
use crate::walls::{Folder, GOOD_JSON};

/// The faces of a box from its corners as [`Polyhedron::cuboid`] numbers them.
const FACES: [[usize; 4]; 6] =
    [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

/// A number in [-1, 1].
fn between(draws: &mut Draws) -> f64 {
    draws.below(2_000_001) as f64 / 1e6 - 1.0
}

fn cuboid(low: [f64; 3], high: [f64; 3]) -> Polyhedron {
    Polyhedron::cuboid(Vec3::from(low), Vec3::from(high))
}

/// Ground and two stones: 0.2 m deep and 0.6 m high, they topple at atan(0.2 / 0.6).
fn three() -> [(&'static str, Polyhedron); 3] {
    [
        ("Ground", cuboid([0.0, 0.0, 0.0], [0.6, 0.4, 0.1])),
        ("stone_1", cuboid([0.1, 0.1, 0.1], [0.5, 0.3, 0.4])),
        ("stone_2", cuboid([0.1, 0.1, 0.4], [0.5, 0.3, 0.7])),
    ]
}

fn object(name: &str) -> String {
    format!("o {name}\n")
}

fn vertex(v: &Vec3) -> String {
    format!("v {:.9} {:.9} {:.9}\n", v.x, v.y, v.z)
}

/// Every corner once per face, its copies up to `noise` (m) off in each coordinate, faces numbered back from the last vertex.
fn corners_per_face(shape: &Polyhedron, noise: f64, draws: &mut Draws) -> String {
    let mut text = String::new();
    for face in &shape.faces {
        for &v in face {
            text += &vertex(&(shape.vertices[v as usize] + Vec3::from_fn(|_, _| noise * between(draws))));
        }
        let numbers: Vec<String> = (0..face.len()).rev().map(|k| format!("-{}", k + 1)).collect();
        text += &format!("f {}\n", numbers.join(" "));
    }
    text
}

fn read(text: &str) -> WallFile {
    read_obj(text, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn answer(folder: &Folder, name: &str, more: &[&str]) -> Value {
    let output = folder.pirca(&[&["analyse", name, "--json"], more].concat());
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&output.stderr)))
}

fn angle(answer: &Value) -> f64 {
    answer["collapse_angle_deg"].as_f64().unwrap_or_else(|| panic!("{answer}"))
}

fn warnings(answer: &Value) -> Vec<&str> {
    answer["warnings"].as_array().unwrap().iter().filter_map(Value::as_str).collect()
}

/// Single precision leaves 1e-7 m between the copies of a corner; 2e-5 m is what a drawing to a tenth of a millimetre is off by.
#[test]
fn corners_written_once_per_face_make_the_same_wall() {
    let folder = Folder::new();
    let mut draws = Draws(9);
    for noise in [0.0, 1e-7, 2e-6, 2e-5] {
        let text: String = three()
            .iter()
            .map(|(name, shape)| object(name) + &corners_per_face(shape, noise, &mut draws))
            .collect();
        for block in &read(&text).wall.blocks {
            assert_eq!((block.shape.vertices.len(), block.shape.faces.len()), (8, 6));
        }
        fs::write(folder.path("wall.obj"), text).unwrap();
        let said = answer(&folder, "wall.obj", &["--phi-deg", "35", "--touch-tolerance", "0.2mm"]);
        // A corner off by the noise shifts the edge by as much: 0.06 deg for 2e-5 m in 0.1 m of half depth and height together.
        let allowed = 1e-4 + degrees(10.0 * noise);
        assert!((angle(&said) - degrees(atan(0.2 / 0.6))).abs() < allowed, "{noise}: {said}");
        let told = warnings(&said).iter().any(|w| w.contains("corners of neighbouring faces lay up to"));
        assert_eq!(told, noise > 1e-7, "{noise}: {said}");
    }
}

/// Boxes turned at random, each face in pieces of its own, every corner once per piece: pieces meet in T-junctions.
#[test]
fn faces_in_pieces_that_meet_in_t_junctions_close() {
    let mut draws = Draws(20);
    for round in 0..300 {
        let size = Vec3::from_fn(|_, _| 0.3 + 0.2 * between(&mut draws));
        let turn = {
            let (a, b) = (3.0 * between(&mut draws), 3.0 * between(&mut draws));
            move |v: Vec3| {
                let w = Vec3::new(cos(a) * v.x - sin(a) * v.y, sin(a) * v.x + cos(a) * v.y, v.z);
                Vec3::new(w.x, cos(b) * w.y - sin(b) * w.z, sin(b) * w.y + cos(b) * w.z)
            }
        };
        let corners = Polyhedron::cuboid(Vec3::zeros(), size).vertices;
        let noise = [0.0, 1e-7, 5e-6][draws.below(3)];
        let mut text = object("stone");
        for face in FACES {
            let at = |s: f64, t: f64| {
                let [a, b, c, d] = face.map(|v| corners[v]);
                (a * (1.0 - s) + b * s) * (1.0 - t) + (d * (1.0 - s) + c * s) * t
            };
            // Cuts at places of the face's own.
            let cuts = |draws: &mut Draws| {
                let mut cuts = vec![0.0, 1.0];
                (0..draws.below(3)).for_each(|_| cuts.insert(1, 0.5 + 0.4 * between(draws)));
                cuts.sort_by(f64::total_cmp);
                cuts.dedup_by(|a, b| (*a - *b).abs() < 0.01);
                cuts
            };
            let (s, t) = (cuts(&mut draws), cuts(&mut draws));
            for (s, t) in s.windows(2).flat_map(|s| t.windows(2).map(move |t| (s, t))) {
                for (s, t) in [(s[0], t[0]), (s[1], t[0]), (s[1], t[1]), (s[0], t[1])] {
                    text += &vertex(&(turn(at(s, t)) + Vec3::from_fn(|_, _| noise * between(&mut draws))));
                }
                text += "f -4 -3 -2 -1\n";
            }
        }
        text += "o ground\nv 9 9 -1\nv 10 9 -1\nv 9 10 -1\nv 9 9 0\nf -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n";
        let shape = &read(&text).wall.blocks[0].shape;
        assert_eq!((shape.vertices.len(), shape.faces.len()), (8, 6), "round {round}: {text}");
        let volume = size.x * size.y * size.z;
        // Corners off by the noise, and nine digits in the file.
        assert!((shape.volume() / volume - 1.0).abs() < 1e-6 + 60.0 * noise, "round {round}");
    }
}

#[test]
fn what_does_not_close_is_refused_for_its_true_cause() {
    let mut draws = Draws(3);
    let [ground, stone, _] = three();
    let ground = object(ground.0) + &corners_per_face(&ground.1, 0.0, &mut draws);
    let refused = |stone: &str| {
        let text = format!("{ground}{}{stone}", object("stone"));
        read_obj(&text, &ReadOptions::default()).unwrap_err().to_string()
    };
    // A face is missing.
    let whole = corners_per_face(&stone.1, 0.0, &mut draws);
    let faces: Vec<&str> = whole.split_inclusive("f -4 -3 -2 -1\n").collect();
    let said = refused(&faces[1..].concat());
    assert!(
        said.contains("the solid is open: 4 edges have no neighbour")
            && said.contains("add the missing face"),
        "{said}"
    );
    // No face is missing, but one lies a millimetre off.
    let off = Polyhedron {
        vertices: stone.1.vertices.iter().map(|v| v + Vec3::new(0.0, 0.0, 1e-3)).collect(),
        ..stone.1.clone()
    };
    let moved = corners_per_face(&off, 0.0, &mut draws);
    let moved: Vec<&str> = moved.split_inclusive("f -4 -3 -2 -1\n").collect();
    let said = refused(&(moved[1].to_owned() + faces[0] + &faces[2..].concat()));
    assert!(
        said.contains("faces that belong together lie up to 1.00e-3 m apart")
            && said.contains("--flatness 1.1"),
        "{said}"
    );
    assert!(!said.contains("add the missing face"), "{said}");
}

#[test]
fn a_name_that_comes_again_is_the_same_block_unless_each_piece_is_a_solid() {
    let mut draws = Draws(4);
    let [ground, stone, upper] = three();
    let pieces = corners_per_face(&stone.1, 0.0, &mut draws);
    let pieces: Vec<&str> = pieces.split_inclusive("f -4 -3 -2 -1\n").collect();
    let base = object(ground.0) + &corners_per_face(&ground.1, 0.0, &mut draws);
    let above = corners_per_face(&upper.1, 0.0, &mut draws);
    // By material, as some exporters write it, with another object between.
    let split = [
        base.clone(),
        object("stone"),
        pieces[..2].concat(),
        object("upper"),
        above.clone(),
        object("stone"),
        pieces[2..].concat(),
    ]
    .concat();
    let file = read(&split);
    assert_eq!(file.names, ["block 0 (Ground)", "block 1 (stone)", "block 2 (upper)"]);
    assert_eq!(
        file.wall.blocks[1].shape,
        read(&[base.clone(), object("stone"), pieces.concat()].concat()).wall.blocks[1].shape
    );
    assert_eq!(read(&split.replace("o ", "g ")).wall, file.wall);
    // Two stones that somebody called the same.
    let twins = [base, object("stone"), pieces.concat(), object("stone"), above].concat();
    assert_eq!(read(&twins).wall.blocks.len(), 3);
}

#[test]
fn a_tag_is_the_owners_own_word_and_comes_back() {
    let text = GOOD_JSON.replacen("\"tag\":\"stone\"", "\"tag\":\"Schlußstein \\\"A\\\"\"", 1);
    let file = read_wall_json(&text).unwrap();
    assert_eq!(file.wall.blocks[1].tag, Tag::Other("Schlußstein \"A\"".to_owned()));
    assert_eq!(file.wall.blocks[0].tag, Tag::Base);
    assert_eq!(read_wall_json(&write_wall_json(&file.wall)).unwrap().wall, file.wall);
    // It counts as a stone.
    assert_eq!(file.wall.stones().count(), 3);
}

#[test]
fn forty_equal_faults_are_one_with_a_count() {
    let mut millimetres = String::from("{\"blocks\":[");
    for id in 0..41 {
        let (x, fixed) = (500 * id, if id == 0 { ",\"fixed\":true" } else { "" });
        let corners: Vec<String> = cuboid([0.0; 3], [400.0, 200.0, 300.0])
            .vertices
            .iter()
            .map(|v| format!("[{},{},{}]", v.x + f64::from(x), v.y, v.z))
            .collect();
        millimetres += &format!(
            "{}{{\"id\":{id},\"vertices\":[{}],\"faces\":{FACES:?},\"density\":2400{fixed}}}",
            if id > 0 { "," } else { "" },
            corners.join(",")
        );
    }
    let faults = read_wall_json(&(millimetres + "]}")).unwrap_err();
    let said = faults.to_string();
    assert!(said.starts_with("2 faults in wall.json:\n"), "{said}");
    assert!(said.contains("(40 times: block 1, block 2, block 3, block 4, block 5, ...)"), "{said}");
    assert_eq!((faults.faults.len(), faults.faults[1].times), (2, 40));

    let commas = "o base\n".to_owned() + &"v 0,5 1,25 0\n".repeat(40);
    let said = read_obj(&commas, &ReadOptions::default()).unwrap_err().to_string();
    assert!(
        said.starts_with("1 fault in wall.obj:\n") && said.contains("decimal commas? Write 0.5 for 0,5"),
        "{said}"
    );
    assert!(said.contains("(40 times: block 0 (base) (line 2), block 0 (base) (line 3), "), "{said}");

    let in_json = GOOD_JSON.replace("[0,0,0.2]", "[0,0,0,2]").replace("[0.5,0,0.2]", "[0,5,0,0,2]");
    let said = read_wall_json(&in_json).unwrap_err().to_string();
    assert!(said.contains("decimal commas? Write 0.5 for 0,5"), "{said}");
}

/// Two stones of 0.32 m in a wall of 2.9 m: gaps on both sides of half a per cent of a stone, which is as far as contacts are
/// looked for.
#[test]
fn a_gap_is_told_up_to_a_tenth_of_a_stone_and_closed_by_a_length() {
    let folder = Folder::new();
    let wall = |beside: f64, above: f64| {
        let mut blocks = vec![(true, cuboid([-0.5, -0.5, -0.2], [3.4, 1.0, 0.0]))];
        for i in 0..9 {
            let x = 0.32 * f64::from(i) + if i > 4 { beside } else { 0.0 };
            blocks.push((false, cuboid([x, 0.0, 0.0], [x + 0.32, 0.32, 0.32])));
        }
        blocks.push((false, cuboid([0.0, 0.0, 0.32 + above], [0.32, 0.32, 0.64 + above])));
        let blocks: Vec<String> = blocks
            .iter()
            .enumerate()
            .map(|(id, (fixed, shape))| {
                let (v, f) = (serde_json::to_string(&shape.vertices).unwrap(), &shape.faces);
                format!("{{\"id\":{id},\"vertices\":{v},\"faces\":{f:?},\"density\":2400,\"fixed\":{fixed}}}")
            })
            .collect();
        fs::write(folder.path("wall.json"), format!("{{\"blocks\":[{}]}}", blocks.join(","))).unwrap();
    };
    for gap in [1.6e-3, 2e-3, 5e-3, 0.03] {
        let size = format!("{} mm", 1e3 * gap);
        // Both stones stand on the ground: the joint between them is told to be none.
        wall(gap, 0.0);
        let said = answer(&folder, "wall.json", &["--phi-deg", "20"]);
        let told = format!("a gap of {size} between block 5 and block 6: they do not touch");
        assert!(warnings(&said).iter().any(|w| w.starts_with(&told)), "{gap}: {said}");
        // Nothing else holds the upper stone.
        wall(0.0, gap);
        let output = folder.pirca(&["analyse", "wall.json", "--phi-deg", "20"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.code() == Some(3)
                && said.contains(&format!("block 1 and block 10, are {size} apart")),
            "{gap}: {said}"
        );
        // Every stone slides at the friction angle; two on one another topple at atan(0.16 / 0.32).
        let wider = format!("{} mm", 1e3 * gap + 0.1);
        let said = answer(&folder, "wall.json", &["--phi-deg", "20", "--touch-tolerance", &wider]);
        assert!((angle(&said) - 20.0).abs() < 1e-3, "{said}");
        assert!(!warnings(&said).iter().any(|w| w.contains("gap")), "{said}");
    }
    let refused = folder.pirca(&["analyse", "wall.json", "--phi-deg", "20", "--touch-tolerance", "5cm"]);
    let refused = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.contains("--touch-tolerance is 50 mm; allowed is at most 32 mm"), "{refused}");
}

/// A tower of three slabs, written with y up: on its side it falls.
#[test]
fn y_may_be_up_and_is_asked_for_where_the_wall_would_stand_so() {
    let folder = Folder::new();
    let mut draws = Draws(5);
    let blocks = [
        ("base", cuboid([-0.5, -0.5, -0.1], [0.5, 0.5, 0.0])),
        ("lower", cuboid([-0.2, -0.1, 0.0], [0.2, 0.1, 0.3])),
        ("upper", cuboid([-0.2, -0.1, 0.3], [0.2, 0.1, 0.6])),
    ];
    let (mut z_up, mut y_up) = (String::new(), String::new());
    for (name, shape) in &blocks {
        // x, y, z of the wall are x, z, -y of the file.
        let file = Polyhedron {
            vertices: shape.vertices.iter().map(|v| Vec3::new(v.x, v.z, -v.y)).collect(),
            ..shape.clone()
        };
        z_up += &(object(name) + &corners_per_face(shape, 0.0, &mut draws));
        y_up += &(object(name) + &corners_per_face(&file, 0.0, &mut draws));
    }
    let options = ReadOptions { up: Some(Up::Y), ..ReadOptions::default() };
    assert_eq!(read_obj(&y_up, &options).unwrap().wall, read(&z_up).wall);
    fs::write(folder.path("tower.obj"), y_up).unwrap();
    let asked = ["--phi-deg", "40"];
    let wrong = answer(&folder, "tower.obj", &asked);
    assert_eq!(wrong["outcome"], "unstable_at_rest", "{wrong}");
    assert!(
        warnings(&wrong).iter().any(|w| w.contains("it would with y up") && w.contains("--up y")),
        "{wrong}"
    );
    let right = answer(&folder, "tower.obj", &[&asked[..], &["--up", "y"]].concat());
    assert!((angle(&right) - degrees(atan(0.1 / 0.3))).abs() < 1e-4, "{right}");
    assert!(!warnings(&right).iter().any(|w| w.contains("up")), "{right}");
    // In a wall.json z is up, and the file cannot be asked otherwise.
    fs::write(folder.path("wall.json"), GOOD_JSON).unwrap();
    let refused = folder.pirca(&["analyse", "wall.json", "--phi-deg", "30", "--up", "y"]);
    assert_eq!(refused.status.code(), Some(2));
}

/// A skew barrel vault of one row: the beds of its stones are ruled surfaces, warped by some millimetres, and each is shared by
/// two stones. In `triangles` the same in two halves a face.
fn skew_arch(stones: usize, skew: f64, in_triangles: bool) -> String {
    let (inner, outer, width) = (1.0, 1.3, 0.6);
    let place = |k: usize, radius: f64, y: f64| {
        let turn = skew * (y / width - 0.5);
        let a = radians(180.0) * (1.0 - k as f64 / stones as f64)
            + if k == 0 || k == stones { 0.0 } else { turn };
        Vec3::new(radius * cos(a), y, radius * sin(a))
    };
    let corners =
        |k: usize| [(outer, 0.0), (inner, 0.0), (inner, width), (outer, width)].map(|(r, y)| place(k, r, y));
    let mut blocks = Vec::new();
    let mut write = |vertices: Vec<Vec3>, fixed: bool| {
        let faces: Vec<Vec<usize>> = match in_triangles && !fixed {
            true => FACES.iter().flat_map(|[a, b, c, d]| [vec![*a, *b, *c], vec![*a, *c, *d]]).collect(),
            false => FACES.iter().map(|f| f.to_vec()).collect(),
        };
        let id = blocks.len();
        let v = serde_json::to_string(&vertices).unwrap();
        blocks.push(format!(
            "{{\"id\":{id},\"vertices\":{v},\"faces\":{faces:?},\"density\":2400,\"fixed\":{fixed}}}"
        ));
    };
    for x in [-1.5, 0.8] {
        write(cuboid([x, -0.2, -0.2], [x + 0.7, 0.8, 0.0]).vertices, true);
    }
    for k in 0..stones {
        let (from, to) = (corners(k), corners(k + 1));
        write(from.into_iter().chain(to).collect(), false);
    }
    format!("{{\"blocks\":[{}]}}", blocks.join(","))
}

#[test]
fn warped_faces_are_made_plane_where_that_is_allowed_and_how_far_is_told() {
    let folder = Folder::new();
    let ask = |text: &str, more: &[&str]| {
        fs::write(folder.path("arch.json"), text).unwrap();
        folder.pirca(
            &[
                &[
                    "analyse",
                    "arch.json",
                    "--phi-deg",
                    "40",
                    "--load",
                    "lateral",
                    "--direction",
                    "x+",
                    "--json",
                ],
                more,
            ]
            .concat(),
        )
    };
    let multiplier = |text: &str, more: &[&str]| {
        let output = ask(text, more);
        let answer: Value = serde_json::from_slice(&output.stdout)
            .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&output.stderr)));
        (answer["multiplier"].as_f64().unwrap_or_else(|| panic!("{answer}")), answer)
    };
    let straight = multiplier(&skew_arch(15, 0.0, false), &[]).0;
    let skew = skew_arch(15, radians(2.0), false);
    let refused = ask(&skew, &[]);
    let said = String::from_utf8_lossy(&refused.stdout).into_owned();
    assert!(
        refused.status.code() == Some(3) && said.contains("is not plane") && said.contains("--flatness"),
        "{said}"
    );
    for in_triangles in [false, true] {
        let text = skew_arch(15, radians(2.0), in_triangles);
        let (found, answer) = multiplier(&text, &["--flatness", "10mm"]);
        // The skew shifts the joints by 2 cm of 19 at the edges, and by nothing in the middle.
        assert!((found / straight - 1.0).abs() < 0.1, "{found} against {straight}");
        assert_eq!(answer["joints"], 16, "{answer}");
        let told = warnings(&answer);
        let told = told.iter().find(|w| w.contains("warped faces made plane within 10 mm in 15 block(s)"));
        assert!(
            told.is_some_and(|w| w.contains(" mm and 10 more by less") || w.contains(" mm, block")),
            "{answer}"
        );
    }
    // Less than they are warped by is not enough.
    assert_eq!(ask(&skew, &["--flatness", "0.1mm"]).status.code(), Some(3));
    // What is plane stays as it is, to the bit.
    let plain = read_wall_json(GOOD_JSON).unwrap();
    let allowed = read_wall_json_with(GOOD_JSON, Some(0.01)).unwrap();
    assert!(plain.wall == allowed.wall && allowed.warnings == plain.warnings, "{:?}", allowed.warnings);
}

/// Corners rounded to a millimetre are half a millimetre off at most in each coordinate, and so are the planes.
#[test]
fn corners_rounded_to_a_millimetre_are_taken_with_a_flatness() {
    let mut draws = Draws(6);
    let (mut refused, mut moved_most): (u32, f64) = (0, 0.0);
    for _ in 0..100 {
        let (a, b) = (3.0 * between(&mut draws), 3.0 * between(&mut draws));
        let turned = |v: &Vec3| {
            let w = Vec3::new(cos(a) * v.x - sin(a) * v.y, sin(a) * v.x + cos(a) * v.y, v.z);
            let u = Vec3::new(w.x, cos(b) * w.y - sin(b) * w.z, sin(b) * w.y + cos(b) * w.z);
            u.map(|c| (1e3 * c).round())
        };
        let corners = cuboid([0.0; 3], [0.4, 0.2, 0.3]).vertices.iter().map(turned).collect::<Vec<_>>();
        let v = serde_json::to_string(&corners).unwrap();
        let ground = serde_json::to_string(&cuboid([0.0; 3], [900.0, 900.0, 100.0]).vertices).unwrap();
        let text = format!(
            "{{\"unit\":\"mm\",\"blocks\":[{{\"id\":0,\"vertices\":{v},\"faces\":{FACES:?},\"density\":2400}},{{\"id\":1,\"vertices\":{ground},\"faces\":{FACES:?},\"fixed\":true}}]}}"
        );
        refused += u32::from(read_wall_json(&text).is_err());
        let file = read_wall_json_with(&text, Some(2e-3)).unwrap_or_else(|e| panic!("{e}"));
        let shape = &file.wall.blocks[0].shape;
        assert_eq!((shape.vertices.len(), shape.faces.len()), (8, 6));
        // Those that happen to be plane to 1e-4 of their size stay as they are.
        shape.validate(1e-4).unwrap();
        assert!((shape.volume() / 0.024 - 1.0).abs() < 0.02, "{}", shape.volume());
        for corner in &corners {
            let nearest =
                shape.vertices.iter().map(|v| (v - corner / 1e3).norm()).fold(f64::INFINITY, f64::min);
            moved_most = moved_most.max(nearest);
        }
    }
    // Most of them are warped by more than 1e-4 of their size; none is moved by more than its corners are off and as much again.
    assert!(refused > 50 && moved_most < 2e-3, "{refused} refused, moved by {moved_most}");
}
