//! Every bad wall is named with the block and the fault, and what is allowed; never a panic.

use std::fs;
use std::time::Instant;

use pirca::exchange::{ReadOptions, read_obj, read_wall, read_wall_json};
use pirca::math::{cos, radians, sin};

use crate::walls::{Folder, GOOD_JSON, GOOD_OBJ};

/// One bad wall: what is replaced in the good one (nothing: the whole text), by what, and what the listing must hold;
/// `#` heads the number of faults expected (1 without it).
type Case = (&'static str, &'static str, &'static [&'static str]);

// One case per line: a table. Blocks 0 (ground), 4 and 7 (stones on one another), 9 (a tetrahedron beside them).
#[rustfmt::skip]
const JSON: &[Case] = &[
    // the text itself
    ("", "", &["the file is empty"]),
    ("", "   \n", &["the file is empty"]),
    ("", "[1, 2]", &["1:", "an object with \"unit\" and \"blocks\""]),
    ("", "{\"unit\":\"m\",\"blocks\":[]}", &["there are no blocks"]),
    ("", "{\"unit\":\"m\"}", &["\"blocks\" is missing"]),
    ("", "{\"blocks\":{\"id\":0}}", &["a list of blocks"]),
    ("", "{\"blocks\":[3,\"x\"]}", &["#2", "entry 0 of \"blocks\": it is 3; allowed is an object", "entry 1 of \"blocks\": it is \"x\""]),
    ("\"fixed\":false}\n]}\n", "", &["6:", "block 9", "truncated"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]],\"density\":2400,\"fixed\":false}\n]}\n", "[[0,2,1],[0,1", &["6:", "block 9: the file ends too early: it is truncated"]),
    ("]}\n", "]} {", &["7:", "trailing characters"]),
    ("[0.5,0,0.2]", "[0.5,0,0.2", &["4:", "block 7: not what is expected"]),
    // numbers that are none
    ("[0.5,0,0.2]", "[NaN,0,0.2]", &["4:", "block 7: NaN is no number"]),
    ("[0.5,0,0.2]", "[-Infinity,0,0.2]", &["4:", "block 7: -Infinity is no number"]),
    ("[0.5,0,0.2]", "[1e999,0,0.2]", &["4:", "block 7: 1e999 is larger than any number"]),
    ("[0.5,0,0.2]", "[1e308,0,0.2]", &["block 7: vertex 1 is at (1e308", "finite coordinates up to 1e7 m"]),
    ("[0.5,0,0.2]", "[\"0.5\",0,0.2]", &["block 7: vertex 1 is [\"0.5\", 0, 0.2] (3 values)"]),
    ("[0.5,0,0.2]", "[0.5,0]", &["block 7: vertex 1 is [0.5, 0] (2 values)"]),
    ("[0.5,0,0.2]", "null", &["block 7: vertex 1 is null"]),
    // keys
    ("\"id\":7,", "", &["entry 2 of \"blocks\": \"id\" is missing"]),
    ("\"id\":7,", "\"id\":4,", &["block 4: the id 4 is there twice: entries 1 and 2"]),
    ("\"id\":7,", "\"id\":-7,", &["\"id\" is -7"]),
    ("\"id\":7,", "\"id\":\"seven\",", &["\"id\" is \"seven\""]),
    ("\"id\":7,", "\"id\":7.5,", &["\"id\" is 7.5"]),
    ("\"id\":7,\"vertices\"", "\"id\":7,\"vertixes\"", &["#2", "block 7: \"vertixes\" is not a known key", "did you mean \"vertices\"?", "block 7: \"vertices\" is missing"]),
    ("\"id\":7,", "\"id\":7,\"id\":8,", &["\"id\" is there twice"]),
    ("\"unit\":\"m\"", "\"unit\":\"inch\"", &["\"unit\" is \"inch\"; allowed is \"m\", \"cm\" or \"mm\""]),
    ("\"unit\":\"m\"", "\"units\":\"m\"", &["\"units\" is not a known key", "did you mean \"unit\"?"]),
    ("\"fixed\":true", "\"fixed\":\"yes\"", &["block 0: \"fixed\" is \"yes\"; allowed is true or false"]),
    ("\"tag\":\"stone\"", "\"tag\":7", &["block 4: \"tag\" is 7", "stone, header, wedge, base, end or your own"]),
    ("\"tag\":\"stone\"", "\"group\":[4]", &["block 4: \"group\" is a list of 1", "a name that all parts of a stone have"]),
    ("\"tag\":\"stone\"", "\"group\":\"\"", &["block 4: \"group\" is \"\""]),
    // density
    ("\"density\":2300", "\"density\":0", &["block 7: density is 0; allowed is a density from 10 to 23000"]),
    ("\"density\":2300", "\"density\":-2300", &["block 7: density is -2300"]),
    ("\"density\":2300", "\"density\":2.3", &["block 7: density is 2.3", "t/m^3 or g/cm^3 by mistake? Multiply it by 1000"]),
    ("\"density\":2300", "\"density\":1e300", &["block 7: density is 1"]),
    ("\"density\":2300", "\"density\":\"2300\"", &["block 7: \"density\" is \"2300\"; allowed is a number"]),
    (",\"density\":2300", "", &["block 7: density is missing"]),
    // faces
    ("[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],\"density\":2300", "[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],\"density\":2300", &["block 7: the solid is open: 4 edges have no neighbour"]),
    ("[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],\"density\":2300", "[7,6,5,4],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],\"density\":2300", &["block 7: faces 1 and", "inside out"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]", "[[0,1,2],[0,3,1],[0,2,3],[1,3,2]]", &["block 9: the solid is inside out: its volume is -", "reverse the order"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]", "[[0,2,1],[0,1,3],[0,3,2],[1,2,4]]", &["block 9: face 3 names vertex 4, which is out of range; allowed is 0 to 3"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]", "[[0,2,1],[0,1,3],[0,3,2],[1,2,-1]]", &["block 9: face 3 names vertex -1, which is out of range"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]", "[[0,2,1],[0,1,3],[0,3,2],[1,2,2]]", &["block 9: face 3 names vertex 2 twice"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]", "[[0,2,1],[0,1,3],[0,3,2],[1,2]]", &["block 9: face 3 has 2 vertices"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]", "[[0,2,1],[0,1,3],[0,3,2],[1,2,1e99]]", &["block 9: face 3 names vertex 1"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]", "[[0,2,1],[0,1,3],[0,3,2]]", &["block 9: 3 faces; allowed is 4 to 2000"]),
    ("[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]", "7", &["block 9: \"faces\" is 7"]),
    // shape
    ("[0.5,0.3,0.4]", "[0.5,0.3,0.45]", &["block 7: face", "is not plane: vertex", "off it"]),
    ("[0.9,0.1,0.2]]", "[0.9,0.1,0.00006]]", &["block 9: the solid is only", "thick"]),
    ("[0.9,0.1,0.2]]", "[0.9,0.1,0]]", &["block 9: the solid", "volume"]),
    ("[0.9,0.1,0.2]]", "[0.9,0.1,0.00001]]", &["block 9: the solid has no volume: its faces lie in one plane"]),
    // the wall as a whole
    ("\"fixed\":true", "\"fixed\":false,\"density\":2400", &["there is no support: no block is fixed"]),
    ("\"unit\":\"m\"", "\"unit\":\"mm\"", &["#3", "block 4: it measures 0.0006 m from corner to corner (unit mm)", "coordinates in m by mistake? Set the unit to m"]),
];

#[rustfmt::skip]
const OBJ: &[Case] = &[
    ("", "", &["the file is empty"]),
    ("", "# nothing\n", &["there are no blocks"]),
    ("v 0.5 0 0.2\n", "v 0.5 0\n", &["wall.obj:37: block 2 (Upper.001): \"v 0.5 0\" is no vertex"]),
    ("v 0.5 0 0.2\n", "v nan 0 0.2\n", &["wall.obj:37: ", "\"v nan 0 0.2\" is no vertex; allowed is three finite numbers"]),
    ("v 0.5 0 0.2\n", "v 1e999 0 0.2\n", &["wall.obj:37: ", "no vertex"]),
    ("v 0.5 0 0.2\n", "v 1e308 0 0.2\n", &["block 2 (Upper.001): vertex 1 is at (1e308"]),
    ("f 17 18 22 21\n", "f 17 18 22 25\n", &["wall.obj:46: block 2 (Upper.001): \"f 17 18 22 25\" names vertex 25, which is out of range; allowed is 1 to 24 or -24 to -1"]),
    ("f 17 18 22 21\n", "f 17 18 22 0\n", &["block 2 (Upper.001)", "names vertex 0, which is out of range"]),
    ("f 17 18 22 21\n", "f 17 18 22 -99\n", &["names vertex -99, which is out of range"]),
    ("f 17 18 22 21\n", "f 17 18 22 x\n", &["\"f 17 18 22 x\" is no face"]),
    ("f 17 18 22 21\n", "f 17 18\n", &["block 2 (Upper.001): face 2 has 2 vertices"]),
    ("f 17 18 22 21\n", "", &["wall.obj:35: block 2 (Upper.001): the solid is open: 4 edges have no neighbour"]),
    ("f 17 18 22 21\n", "f 21 22 18 17\n", &["block 2 (Upper.001): faces 2 and 5 run the edge", "inside out"]),
    ("f 17 18 22 21\n", "f 17 18 22 18\n", &["block 2 (Upper.001): face 2 names vertex 1 twice"]),
    ("f 17 18 22 21\n", "curv 0 1 2\n", &["\"curv\" is no line of a polygon mesh"]),
    ("o Upper.001\n", "", &["block 1 (Stone): 4 faces meet at the edge", "one object"]),
    ("o Base\n", "o Floor\n", &["there is no support"]),
    ("# density 2300 kg/m^3\n", "# density 0 kg/m^3\n", &["block 2 (Upper.001): density is 0"]),
];

/// Each spoilt text has just the faults expected.
fn listed(cases: &[Case], good: &str, read: impl Fn(&str) -> Option<(usize, String)>) {
    let mut wrong = Vec::new();
    for (from, to, parts) in cases {
        let text = if from.is_empty() {
            (*to).to_owned()
        } else {
            assert_eq!(good.matches(from).count(), 1, "`{from}` must stand once in the good wall");
            good.replacen(from, to, 1)
        };
        let Some((count, listing)) = read(&text) else {
            wrong.push(format!("`{to}` in place of `{from}` was taken for good"));
            continue;
        };
        let (expected, parts) = match parts.first().and_then(|p| p.strip_prefix('#')) {
            Some(n) => (n.parse().unwrap(), &parts[1..]),
            None => (1, *parts),
        };
        let missing: Vec<_> = parts.iter().filter(|part| !listing.contains(**part)).collect();
        if count != expected || !missing.is_empty() {
            wrong.push(format!(
                "`{to}` in place of `{from}`: {missing:?} missing, {expected} faults expected:\n{listing}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_fault_of_a_wall_json_is_named_with_its_block() {
    assert!(read_wall_json(GOOD_JSON).is_ok(), "{}", read_wall_json(GOOD_JSON).unwrap_err());
    listed(JSON, GOOD_JSON, |text| read_wall_json(text).err().map(|f| (f.count(), f.to_string())));
}

#[test]
fn every_fault_of_an_obj_is_named_with_its_block_and_line() {
    let read = |text: &str| read_obj(text, &ReadOptions::default());
    assert!(read(GOOD_OBJ).is_ok(), "{}", read(GOOD_OBJ).unwrap_err());
    listed(OBJ, GOOD_OBJ, |text| read(text).err().map(|f| (f.count(), f.to_string())));
}

/// Faults of shape and place that need more than one replacement: a wall of its own each.
#[test]
fn blocks_that_are_dented_overlapping_floating_or_in_millimetres_are_named() {
    let folder = Folder::new();
    let dented = "{\"id\":5,\"vertices\":[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[0.4,0.4,0.6],[0,1,1]],\"faces\":[[3,2,1,0],[4,5,6],[4,6,7],[0,1,5,4],[1,2,6],[1,6,5],[2,3,7],[2,7,6],[3,0,4,7]],\"density\":2400}";
    let ground = "{\"id\":0,\"vertices\":[[-1,-1,-1],[2,-1,-1],[2,2,-1],[-1,2,-1],[-1,-1,0],[2,-1,0],[2,2,0],[-1,2,0]],\"faces\":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],\"fixed\":true}";
    let stone = |id: u32, x: f64, z: f64| {
        let (u, w) = (x + 0.5, z + 0.5);
        format!(
            "{{\"id\":{id},\"vertices\":[[{x},0,{z}],[{u},0,{z}],[{u},0.5,{z}],[{x},0.5,{z}],[{x},0,{w}],[{u},0,{w}],[{u},0.5,{w}],[{x},0.5,{w}]],\"faces\":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],\"density\":2400}}"
        )
    };
    let wall = |unit: &str, blocks: &[String]| {
        format!("{{\"unit\":\"{unit}\",\"blocks\":[{ground},{}]}}", blocks.join(","))
    };
    let millimetres = {
        let block = |id: u32, fixed: bool, z: f64| {
            let (w, more) = (z + 300.0, if fixed { "\"fixed\":true" } else { "\"density\":2400" });
            format!(
                "{{\"id\":{id},\"vertices\":[[0,0,{z}],[400,0,{z}],[400,200,{z}],[0,200,{z}],[0,0,{w}],[400,0,{w}],[400,200,{w}],[0,200,{w}]],\"faces\":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],{more}}}"
            )
        };
        format!("{{\"blocks\":[{},{}]}}", block(0, true, -300.0), block(3, false, 0.0))
    };
    let cases: [(&str, String, &[&str]); 8] = [
        (
            "dented",
            wall("m", &[dented.to_owned()]),
            &[
                "block 5: the solid is not convex: vertex",
                "--parts divides it into convex parts of one stone",
            ],
        ),
        (
            "millimetres",
            millimetres,
            &[
                "block 3: it measures 538",
                "allowed is 0.001 to 25 m for a stone",
                "coordinates in mm by mistake? Set the unit to mm",
            ],
        ),
        (
            "overlapping",
            wall("m", &[stone(1, 0.0, 0.0), stone(2, 0.3, 0.0)]),
            &["block 1: it overlaps block 2 by 200 mm", "at most 5 mm"],
        ),
        (
            "the same twice",
            wall("m", &[stone(1, 0.0, 0.0), stone(2, 0.0, 0.0)]),
            &["block 1: it overlaps block 2 by 500 mm", "remove the one that is there twice"],
        ),
        ("sunk", wall("m", &[stone(1, 0.0, -0.02)]), &["block 0: it overlaps block 1 by 20 mm"]),
        (
            "floating",
            wall("m", &[stone(1, 0.0, 0.0), stone(2, 0.0, 0.9)]),
            &["block 2: it floats free", "a chain of touching blocks"],
        ),
        (
            "just missed",
            wall("m", &[stone(1, 0.0, 0.0005)]),
            &["block 1: it floats free", "block 0 and block 1, are 0.5 mm apart", "--touch-tolerance"],
        ),
        (
            "two in the air",
            wall("m", &[stone(8, 0.0, 0.9), stone(9, 0.5, 0.9), stone(2, 0.0, 0.0)]),
            &["block 8: 2 blocks float free together: block 8, block 9"],
        ),
    ];
    for (name, text, parts) in cases {
        fs::write(folder.path("wall.json"), text).unwrap();
        let output = folder.pirca(&["analyse", "wall.json", "--phi-deg", "30"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(3), "{name}: {said}");
        let count = if name == "millimetres" { "2 faults" } else { "1 fault" };
        assert!(said.starts_with(&format!("error: {count} in wall.json:\n")), "{name}: {said}");
        for part in parts {
            assert!(said.contains(part), "{name}: `{part}` is missing in {said}");
        }
    }
}

#[test]
fn several_faults_are_named_in_one_report() {
    let text = GOOD_JSON
        .replace("\"density\":2300", "\"density\":0")
        .replace("[[0,2,1],[0,1,3]", "[[0,2,1],[0,1,33]")
        .replace("\"tag\":\"stone\"", "\"tag\":null");
    let faults = read_wall_json(&text).unwrap_err();
    let blocks: Vec<&str> = faults.faults.iter().map(|f| f.block.as_str()).collect();
    assert_eq!(blocks, ["block 4", "block 7", "block 9"], "{faults}");
}

#[test]
fn a_listing_ends_where_nobody_reads_on() {
    let mut text = String::from("o Stone\n");
    for _ in 0..5000 {
        text.push_str("v x\n");
    }
    let faults = read_obj(&text, &ReadOptions::default()).unwrap_err();
    assert_eq!((faults.faults.len(), faults.count()), (1, 5000));
    assert!(faults.to_string().contains("(5000 times: block 0 (Stone) (line 2), "), "{faults}");
}

/// What would fill the memory or the afternoon is refused by the size of the parts.
#[test]
fn files_out_of_all_proportion_are_refused_in_time() {
    let deep = "[".repeat(100_000);
    let many = format!("{{\"blocks\":[{{\"id\":3,\"vertices\":[{}[0,0,0]]}}]}}", "[0,0,0],".repeat(50_000));
    let empty = format!("{{\"blocks\":[{}{{}}]}}", "{},".repeat(60_000));
    for (text, part) in [
        (&deep, "not what is expected"),
        (
            &format!("{{\"blocks\":[{{\"id\":3,\"vertices\":{deep}"),
            "block 3: not what is expected: recursion limit exceeded",
        ),
        (&many, "block 3: more than 50000 values in one block"),
        (&empty, "more than 50000 blocks"),
    ] {
        let listing = read_wall_json(text).unwrap_err().to_string();
        assert!(listing.contains(part), "{listing}");
    }
    let face = format!("o a\nv 0 0 0\nf{}\n", " 1".repeat(100_000));
    assert!(
        read_obj(&face, &ReadOptions::default())
            .unwrap_err()
            .to_string()
            .contains("a face with 100000 vertices")
    );
    let objects = "o a\nf\n".repeat(60_000);
    assert!(
        read_obj(&objects, &ReadOptions::default()).unwrap_err().to_string().contains("too many objects")
    );
}

/// Drums of 150 corners in one place, each pair of which takes its time to compare, are given up in time.
#[test]
fn a_heap_of_round_blocks_in_one_place_is_refused_in_time() {
    let folder = Folder::new();
    let mut text =
        String::from("o base\nv 9 9 -1\nv 10 9 -1\nv 9 10 -1\nv 9 9 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    for _ in 0..500 {
        text.push_str("o drum\n");
        let sides = 75;
        for z in [0.0, 0.5] {
            for k in 0..sides {
                let a = radians(360.0 * f64::from(k) / f64::from(sides));
                text += &format!("v {} {} {z}\n", cos(a), sin(a));
            }
        }
        let ring: Vec<i32> = (0..sides).collect();
        let face =
            |numbers: Vec<i32>| numbers.iter().map(|k| format!(" {}", k - 2 * sides)).collect::<String>();
        text += &format!("f{}\n", face(ring.iter().rev().copied().collect()));
        text += &format!("f{}\n", face(ring.iter().map(|k| k + sides).collect()));
        for k in 0..sides {
            let next = (k + 1) % sides;
            text += &format!("f{}\n", face(vec![k, next, next + sides, k + sides]));
        }
    }
    fs::write(folder.path("heap.obj"), text).unwrap();
    let begun = Instant::now();
    let output = folder.pirca(&["analyse", "heap.obj", "--phi-deg", "30"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.code() == Some(3) && said.contains("entangled"),
        "{}",
        &said[..said.len().min(500)]
    );
    // It takes seconds; without a bound it would be an hour.
    assert!(begun.elapsed().as_secs() < 120);
}

#[test]
fn files_that_cannot_be_read_as_text_are_refused() {
    let folder = Folder::new();
    let read = |name: &str, bytes: &[u8]| {
        fs::write(folder.path(name), bytes).unwrap();
        read_wall(&folder.path(name), &ReadOptions::default())
    };
    let refused = |name: &str, bytes: &[u8]| read(name, bytes).unwrap_err().to_string();
    assert!(refused("wall.json", b"\xff\xfe{\0}\0").contains("the file is no text"));
    assert!(refused("wall.step", b"solid").contains(".json, .obj, .ply, .stl, .glb, .gltf or .3ddat"));
    assert!(
        read("wall.json", format!("\u{feff}{GOOD_JSON}").as_bytes()).is_ok(),
        "a byte order mark is no fault"
    );
    assert!(
        read("Wall.OBJ", GOOD_OBJ.replace('\n', "\r\n").as_bytes()).is_ok(),
        "lines of Windows are no fault"
    );
    let missing = read_wall(&folder.path("none.json"), &ReadOptions::default()).unwrap_err().to_string();
    assert!(missing.contains("none.json: cannot be read"), "{missing}");
    let folder_itself = read_wall(&folder.path(".json"), &ReadOptions::default()).unwrap_err().to_string();
    assert!(folder_itself.contains("no format"), "{folder_itself}");
    let large = std::fs::File::create(folder.path("large.obj")).unwrap();
    large.set_len((64 << 20) + 1).unwrap();
    let too_large = read_wall(&folder.path("large.obj"), &ReadOptions::default()).unwrap_err().to_string();
    assert!(too_large.contains("too large; allowed is at most 64 MiB"), "{too_large}");
}
