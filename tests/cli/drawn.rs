//! Walls from drawings and pictures of their faces: what is read, what is passed over, and what is wrong.

use std::fs;
use std::io::Cursor;

use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgb, RgbImage, Rgba, RgbaImage};
use pirca::exchange::{ReadOptions, read_wall_bytes};
use serde_json::Value;

use crate::fixture::stderr;
use crate::mutated_walls::Draws;
use crate::walls::Folder;

/// A column of three stones, 0.5 m long and 0.2 m high at 5 mm a pixel, with joints of 2 pixels: 0.62 m high.
const STONES: [[u32; 4]; 3] = [[10, 92, 110, 132], [10, 50, 110, 90], [10, 8, 110, 48]];
const WIDTH: u32 = 120;
const HEIGHT: u32 = 140;
/// Half the depth of 0.3 m over half the height.
const FALLS: f64 = 0.3 / 0.62;

fn encoded(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, format).expect("encoded");
    bytes.into_inner()
}

/// The column in two grey levels.
fn grey(stone: u8, joint: u8) -> GrayImage {
    GrayImage::from_fn(WIDTH, HEIGHT, |x, y| {
        let inside = STONES.iter().any(|[l, t, r, b]| (*l..*r).contains(&x) && (*t..*b).contains(&y));
        Luma([if inside { stone } else { joint }])
    })
}

/// The column with a colour for each stone.
fn labels() -> RgbImage {
    RgbImage::from_fn(WIDTH, HEIGHT, |x, y| {
        let inside = |[l, t, r, b]: &[u32; 4]| (*l..*r).contains(&x) && (*t..*b).contains(&y);
        STONES.iter().position(inside).map_or(Rgb([0; 3]), |own| Rgb([60 * own as u8 + 60, 200, 30]))
    })
}

const ASKED: [&str; 6] = ["--phi-deg", "40", "--load", "lateral", "--thickness", "30cm"];

fn asked(name: &str, bytes: &[u8], more: &[&str]) -> Result<Value, String> {
    let folder = Folder::new();
    fs::write(folder.path(name), bytes).expect("written");
    let output = folder.pirca(&[&["analyse", name, "--json"], &ASKED[..], more].concat());
    let told: Value = serde_json::from_slice(&output.stdout).map_err(|_| stderr(&output))?;
    if output.status.success() { Ok(told) } else { Err(told.to_string()) }
}

fn falls(told: &Value) -> f64 {
    told["collapse_multiplier"].as_f64().expect("it falls")
}

#[test]
fn a_column_is_read_from_pictures_of_any_kind() {
    let sixteen = image::ImageBuffer::from_fn(WIDTH, HEIGHT, |x, y| {
        let own = labels().get_pixel(x, y).0[0];
        Luma([u16::from(own) * 7])
    });
    let open = RgbaImage::from_fn(WIDTH, HEIGHT, |x, y| {
        let [r, g, b] = labels().get_pixel(x, y).0;
        Rgba([r, g, b, if g > 0 { 255 } else { 0 }])
    });
    let kinds = [
        ("labels.png", encoded(labels(), ImageFormat::Png)),
        ("labels.tif", encoded(labels(), ImageFormat::Tiff)),
        ("sixteen.png", encoded(DynamicImage::ImageLuma16(sixteen), ImageFormat::Png)),
        ("open.png", encoded(open, ImageFormat::Png)),
        ("light.png", encoded(grey(255, 0), ImageFormat::Png)),
        ("dark.png", encoded(grey(20, 240), ImageFormat::Png)),
        ("light.jpg", encoded(grey(230, 25), ImageFormat::Jpeg)),
    ];
    for (name, bytes) in kinds {
        let told = asked(name, &bytes, &["--pixel", "5mm"]).unwrap_or_else(|said| panic!("{name}: {said}"));
        assert!((falls(&told) - FALLS).abs() < 2e-3, "{name}: {told}");
        assert_eq!((told["blocks"].as_u64(), told["joints"].as_u64()), (Some(4), Some(3)), "{name}");
        let warnings = told["warnings"].to_string();
        assert!(warnings.contains("read 3 stones, 0.500 m long and 0.620 m high"), "{name}: {warnings}");
        assert!(warnings.contains("closed 2 joints, 10.0 mm wide in the median"), "{name}: {warnings}");
        // The length of all stones together says the same; at four times that size the wall is as much higher.
        let told = asked(name, &bytes, &["--width", "50cm"]).expect("an answer");
        assert!((falls(&told) - FALLS).abs() < 2e-3, "{name}: {told}");
        let told = asked(name, &bytes, &["--width", "2m"]).expect("an answer");
        assert!((falls(&told) - FALLS / 4.0).abs() < 2e-3, "{name}: {told}");
    }
}

#[test]
fn specks_are_passed_over_and_bridges_are_cut() {
    let mut spoilt = grey(255, 0);
    // A speck of 2 x 2 pixels, and a bridge of one between the lower stones.
    (60..62).for_each(|x| (3..5).for_each(|y| spoilt.put_pixel(x, y, Luma([255]))));
    (90..92).for_each(|y| spoilt.put_pixel(50, y, Luma([255])));
    let told = asked("wall.png", &encoded(spoilt, ImageFormat::Png), &["--pixel", "5mm"]).expect("an answer");
    assert!((falls(&told) - FALLS).abs() < 2e-3, "{told}");
    let warnings = told["warnings"].to_string();
    assert!(warnings.contains("1 area(s) are no stones"), "{warnings}");
    assert!(warnings.contains("1 pair(s) of stones hung together by a bridge"), "{warnings}");
}

#[test]
fn what_a_picture_lacks_is_told_with_what_to_do() {
    let bytes = encoded(labels(), ImageFormat::Png);
    let said = asked("wall.png", &bytes, &[]).expect_err("no size");
    assert!(said.contains("nothing says how large a pixel is") && said.contains("--pixel 2mm"), "{said}");
    let said = asked("wall.png", &bytes, &["--pixel", "5mm", "--unit", "mm"]).expect_err("a unit");
    assert!(said.contains("--unit is for coordinates"), "{said}");
    // Joints of 2 pixels are wider than 5 mm.
    let said = asked("wall.png", &bytes, &["--pixel", "5mm", "--mend", "4mm"]).expect_err("too narrow");
    assert!(
        said.contains("meets nothing") && said.contains("10.0 mm away") && said.contains("--mend"),
        "{said}"
    );
    let said = asked("wall.png", &bytes, &["--pixel", "5mm", "--mend", "20cm"]).expect_err("too wide");
    assert!(said.contains("a quarter of a stone"), "{said}");
    let photograph = RgbImage::from_fn(WIDTH, HEIGHT, |x, y| {
        let own = (x * 37 + y * 91 + x * y * 13) as u8;
        Rgb([own, own.wrapping_mul(3), own / 2 + (x as u8)])
    });
    let said = asked("wall.png", &encoded(photograph, ImageFormat::Png), &["--pixel", "5mm"])
        .expect_err("a photograph");
    assert!(said.contains("looks like a photograph") && said.contains("outline the stones"), "{said}");
    let blank = encoded(GrayImage::new(40, 40), ImageFormat::Png);
    let said = asked("wall.png", &blank, &["--pixel", "5mm"]).expect_err("nothing in it");
    assert!(said.contains("stones") || said.contains("photograph"), "{said}");
    let said = asked("wall.png", b"no picture", &["--pixel", "5mm"]).expect_err("a text");
    assert!(said.contains("cannot be read as a picture"), "{said}");
}

#[test]
fn the_page_shows_what_was_read_over_the_picture() {
    let folder = Folder::new();
    fs::write(folder.path("wall.png"), encoded(labels(), ImageFormat::Png)).expect("written");
    let more = ["--pixel", "5mm", "--out", "answer", "--study", "mine"];
    let output = folder
        .pirca(&[&["analyse", "wall.png"], &["--phi-deg", "40", "--thickness", "30cm"][..], &more].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    let read = fs::read_to_string(folder.path("answer/read.svg")).expect("a picture");
    assert!(read.contains("data:image/png;base64,"), "{read}");
    assert_eq!(read.matches("<polygon").count(), 3);
    let page = fs::read_to_string(folder.path("answer/report.html")).expect("a page");
    assert!(page.contains("figure-read") && page.contains("What was read"));
    let joints = fs::read_to_string(folder.path("answer/closed-joints.csv")).expect("a table");
    let heads = "block_a,block_b,gap_mean_m,gap_largest_m,length_m,area_share_a,area_share_b";
    assert_eq!(joints.lines().next(), Some(heads));
    let closed = joints.lines().count() - 1;
    for words in [format!("closed {closed} joints"), format!("Joints that were closed ({closed})")] {
        assert!(page.contains(&words), "{words}: {joints}");
    }
    // The study has the same wall, which falls at the same tilt.
    let output = folder.pirca(&["run", "mine", "--json"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let once: Value =
        serde_json::from_str(&fs::read_to_string(folder.path("answer/analysis.json")).expect("an answer"))
            .expect("JSON");
    let many: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let angle = once["collapse_angle_deg"].as_f64().expect("it falls");
    assert!(many.to_string().contains(&format!("{angle:.3}")[..5]), "{angle}: {many}");
}

/// Beds of the example wander: stones that lose what they bear on would fall at once.
#[test]
fn the_example_of_the_manual_stands_however_far_its_joints_are_closed() {
    let bytes =
        fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/how-to/elevation.png")).expect("a picture");
    for mend in ["14mm", "20mm", "24mm"] {
        let folder = Folder::new();
        fs::write(folder.path("wall.png"), &bytes).expect("written");
        let asked =
            ["analyse", "wall.png", "--pixel", "4mm", "--thickness", "45cm", "--phi-deg", "34", "--json"];
        let output = folder.pirca(&[&asked[..], &["--mend", mend]].concat());
        let told: Value = serde_json::from_slice(&output.stdout).expect("an answer");
        let angle = told["collapse_angle_deg"].as_f64().unwrap_or_else(|| panic!("{mend}: {told}"));
        assert!((angle - 21.9).abs() < 0.5, "{mend}: {angle}");
    }
}

/// The same column as a drawing in centimetres, with an opening, a ground and a remark.
const SVG: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="200cm" height="100cm" viewBox="0 0 200 100">
<g id="stones"><rect x="50" y="70" width="50" height="20"/><rect x="50" y="49" width="50" height="20"/><rect x="50" y="28" width="50" height="20"/></g>
<g id="ground"><rect x="20" y="90.5" width="120" height="9"/></g>
<g id="opening"><rect x="120" y="60" width="20" height="20"/></g><text x="3" y="3">north wall</text></svg>"#;

#[test]
fn layers_say_what_is_ground_and_what_is_open() {
    let told = asked("wall.svg", SVG.as_bytes(), &["--mend", "2cm"]).expect("an answer");
    // The ground stays where it is: half a joint of 10 mm and all of that of 5 mm below go to the stones.
    assert!((falls(&told) - 0.3 / 0.625).abs() < 2e-3, "{told}");
    assert_eq!((told["blocks"].as_u64(), told["joints"].as_u64()), (Some(4), Some(3)));
    let warnings = told["warnings"].to_string();
    assert!(warnings.contains("read 3 stones on 1 outline(s) of ground"), "{warnings}");
    assert!(warnings.contains("1 opening(s) stay open"), "{warnings}");
    let said = asked("wall.svg", SVG.as_bytes(), &["--pixel", "1mm"]).expect_err("it has no pixels");
    assert!(said.contains("--pixel is for pictures"), "{said}");
    let said = asked("wall.svg", SVG.as_bytes(), &["--width", "2m", "--unit", "cm"]).expect_err("two sizes");
    assert!(said.contains("--width is the size a second time"), "{said}");
    let said = asked("wall.svg", SVG.as_bytes(), &["--mend", "2cm", "--parts"]).expect_err("convex already");
    assert!(said.contains("becomes convex"), "{said}");
    let apart = asked("wall.svg", SVG.as_bytes(), &[]).expect_err("it floats");
    assert!(apart.contains("floats free"), "{apart}");
}

#[test]
fn a_layer_of_headers_marks_stones_that_go_through() {
    let marked = SVG.replace(r#"<rect x="50" y="49" width="50" height="20"/>"#, "").replace(
        r#"<g id="ground">"#,
        r#"<g id="Headers"><rect x="50" y="49" width="50" height="20"/></g><g id="ground">"#,
    );
    let folder = Folder::new();
    fs::write(folder.path("wall.svg"), marked).expect("written");
    let asked = ["analyse", "wall.svg", "--thickness", "30cm", "--mend", "2cm", "--json", "--out", "answer"];
    let output = folder.pirca(&asked);
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(told.contains("read 3 stones, 1 of them headers on 1 outline(s) of ground"), "{told}");
    let read = fs::read_to_string(folder.path("answer/wall.json")).expect("the wall");
    assert_eq!(read.matches("\"header\"").count(), 1, "{read}");
}

#[test]
fn a_section_is_a_slice_of_a_wall() {
    // 0.5 m thick and 0.62 m high; its front is to the right, and it falls there.
    let bytes = encoded(labels(), ImageFormat::Png);
    let asked = |more: &[&str]| {
        let folder = Folder::new();
        fs::write(folder.path("wall.png"), &bytes).expect("written");
        let output = folder.pirca(
            &[
                &["analyse", "wall.png", "--phi-deg", "60", "--load", "lateral", "--pixel", "5mm", "--json"],
                more,
            ]
            .concat(),
        );
        assert!(output.status.success(), "{}", stderr(&output));
        serde_json::from_slice::<Value>(&output.stdout).expect("JSON")
    };
    let told = asked(&["--section"]);
    assert!((falls(&told) - 0.5 / 0.62).abs() < 2e-3, "{told}");
    // Along the wall the slice is as long as is asked for, or 1 m.
    for (more, long) in [
        (&["--section", "--direction", "x+"][..], 1.0),
        (&["--section", "--direction", "x+", "--thickness", "40cm"], 0.4),
    ] {
        let told = asked(more);
        assert!((falls(&told) - long / 0.62).abs() < 2e-3, "{told}");
    }
}

#[test]
fn a_concave_stone_is_divided_or_its_hull_is_taken() {
    let drawing = |stone: &str| {
        format!(
            r#"{{"type":"FeatureCollection","unit":"cm","features":[
            {{"type":"Feature","properties":{{"name":"A"}},"geometry":{{"type":"Polygon","coordinates":[[[0,0],[50,0],[50,20],[0,20],[0,0]]]}}}},
            {{"type":"Feature","properties":{{"name":"L"}},"geometry":{{"type":"Polygon","coordinates":[[{stone}]]}}}}]}}"#
        )
    };
    let concave = drawing("[0,20],[50,20],[50,60],[30,60],[30,40],[0,40],[0,20]");
    let refused = asked("wall.geojson", concave.as_bytes(), &[]).expect_err("it is concave");
    assert!(refused.contains("stone 1 (L)") && refused.contains("--parts"), "{refused}");
    let parts = asked("wall.geojson", concave.as_bytes(), &["--parts"]).expect("an answer");
    assert!(parts["warnings"].to_string().contains("taken as 2 convex parts of one stone"), "{parts}");
    let hull = asked("wall.geojson", concave.as_bytes(), &["--mend", "1cm"]).expect("an answer");
    assert!(hull["warnings"].to_string().contains("stone 1 (L) by +"), "{hull}");
    assert!(falls(&parts) > falls(&hull), "the hull is heavier above");
    let crossed = drawing("[0,20],[50,40],[50,20],[0,40],[0,20]");
    let said = asked("wall.geojson", crossed.as_bytes(), &["--mend", "1cm"]).expect_err("it crosses");
    assert!(said.contains("crosses or touches itself at x = 0.2500 m, z = 0.3000 m"), "{said}");
    let twice = drawing("[0,1],[50,1],[50,19],[0,19],[0,1]");
    let said = asked("wall.geojson", twice.as_bytes(), &["--mend", "1cm"]).expect_err("one in the other");
    assert!(said.contains("100 % of it lie within stone 0 (A)"), "{said}");
}

#[test]
fn spoilt_pictures_are_told_and_never_panic() {
    let good = encoded(labels(), ImageFormat::Png);
    let options = ReadOptions { thickness: Some(0.3), pixel: Some(5e-3), ..ReadOptions::default() };
    let mut draws = Draws(7);
    let mut read = 0;
    for _ in 0..200 {
        let mut bytes = good.clone();
        match draws.below(3) {
            0 => bytes.truncate(draws.below(bytes.len())),
            1 => (0..4).for_each(|_| {
                let at = draws.below(bytes.len());
                bytes[at] = draws.below(256) as u8;
            }),
            _ => {
                let at = draws.below(bytes.len());
                bytes.drain(at..(at + 5).min(bytes.len()));
            }
        }
        read += usize::from(read_wall_bytes("wall.png", &bytes, &options).is_ok());
    }
    assert!(read < 200);
}
