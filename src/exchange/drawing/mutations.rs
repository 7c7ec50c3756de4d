//! Files that went wrong in every way we can think of: none of them may stop the program, or keep it busy.

use std::fmt::Write;
use std::time::Instant;

use crate::exchange::drawing::{Drawing, read_dxf, read_geojson, read_svg};
use crate::exchange::fault::WallFaults;

/// A small drawing that has something of all that is read.
const DXF: &str = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nLAYER\n2\nOFF\n62\n-7\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nPAIR\n10\n0\n20\n0\n0\nCIRCLE\n8\n0\n10\n5\n20\n5\n40\n5\n0\nLWPOLYLINE\n8\nSTONES\n70\n1\n10\n20\n20\n0\n10\n30\n20\n0\n42\n0.5\n10\n30\n20\n10\n0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n8\nSTONES\n2\nPAIR\n10\n100\n20\n50\n41\n2\n50\n30\n0\nLINE\n8\nSTONES\n10\n0\n20\n0\n11\n10\n21\n0\n0\nLINE\n8\nSTONES\n10\n10\n20\n0\n11\n10\n21\n10\n0\nARC\n8\nSTONES\n10\n5\n20\n10\n40\n5\n50\n0\n51\n180\n0\nLINE\n8\nSTONES\n10\n0\n20\n0\n11\n0\n21\n10\n0\nPOLYLINE\n8\nGROUND\n70\n1\n0\nVERTEX\n10\n0\n20\n-5\n0\nVERTEX\n10\n200\n20\n-5\n42\n0.1\n0\nVERTEX\n10\n200\n20\n0\n0\nSEQEND\n0\nTEXT\n8\nTEXT\n1\nhello\n0\nHATCH\n8\nSTONES\n0\nENDSEC\n0\nEOF\n";

const SVG: &str = "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"2000mm\" height=\"1000mm\" viewBox=\"0 0 2000 1000\">\n<defs><path id=\"s\" d=\"M0 0h100v100h-100z\"/></defs>\n<g id=\"stones\" transform=\"translate(10,10) rotate(1)\">\n<rect x=\"1\" y=\"2\" width=\"30\" height=\"10\" rx=\"2\"/>\n<circle cx=\"100\" cy=\"100\" r=\"50\"/>\n<g><ellipse cx=\"300\" cy=\"100\" rx=\"50\" ry=\"20\"/></g>\n<use href=\"#s\" x=\"400\" y=\"1\"/>\n<path id=\"h\" d=\"M600 300C650 290 690 300 700 300A50 50 0 0 1 700 400Q650 420 600 400T600 300zM620 320h20v20h-20z\"/>\n<polygon points=\"800,0 900,0 850,90\"/>\n<text>hello</text>\n</g>\n<g id=\"ground\"><rect x=\"0\" y=\"900\" width=\"1000\" height=\"50\"/></g>\n</svg>\n";

const GEOJSON: &str = "{\"type\": \"FeatureCollection\", \"unit\": \"cm\",\n\"features\": [\n{\"type\": \"Feature\", \"id\": 3,\n\"properties\": {\"name\": \"K3\", \"layer\": \"wall\"},\n\"geometry\": {\"type\": \"Polygon\", \"coordinates\": [[[0, 0], [10, 0], [10, 10], [0, 0]]]}},\n{\"type\": \"Feature\", \"properties\": {\"part\": \"ground\"},\n\"geometry\": {\"type\": \"MultiPolygon\",\n\"coordinates\": [[[[0, -5], [50, -5], [50, 0]]], [[[60, -5], [70, -5], [70, 0]]]]}},\n{\"type\": \"Feature\", \"properties\": null, \"geometry\": {\"type\": \"Point\", \"coordinates\": [1, 2]}}\n]}\n";

type Read = fn(&[u8]) -> Result<Drawing, WallFaults>;

const READERS: [(&str, Read); 3] = [
    (DXF, read_dxf),
    (SVG, |bytes| read_svg(&String::from_utf8_lossy(bytes))),
    (GEOJSON, |bytes| read_geojson(&String::from_utf8_lossy(bytes))),
];

/// Numbers that look random and are the same every time (a linear congruential generator).
struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit.max(1)
    }
}

/// What stands in the place of a number.
const ODD: [&str; 12] = [
    "NaN",
    "inf",
    "-inf",
    "1e400",
    "-1e308",
    "1e-320",
    "",
    "0",
    "-1",
    "99999999999999999999",
    "1,5",
    "\u{fc}",
];

/// The text with one thing wrong.
fn mutated(text: &str, dice: &mut Dice) -> Vec<u8> {
    let bytes = text.as_bytes();
    let (mut lines, line) = (text.lines().collect::<Vec<_>>(), dice.below(text.lines().count()));
    let digits: Vec<usize> = (0..bytes.len()).filter(|i| bytes[*i].is_ascii_digit()).collect();
    match dice.below(8) {
        0 => bytes[..dice.below(bytes.len())].to_vec(),
        1 => {
            lines.remove(line);
            lines.join("\n").into_bytes()
        }
        2 => {
            let many = if dice.below(2) == 0 { 1 } else { 2000 };
            (0..many).for_each(|_| lines.insert(line, lines[line]));
            lines.join("\n").into_bytes()
        }
        3 => {
            let other = dice.below(lines.len());
            lines.swap(line, other);
            lines.join("\n").into_bytes()
        }
        4 => {
            let mut own = bytes.to_vec();
            (0..1 + dice.below(8)).for_each(|_| own[dice.below(bytes.len())] = dice.below(256) as u8);
            own
        }
        5 => {
            let at = digits[dice.below(digits.len())];
            [&bytes[..at], ODD[dice.below(ODD.len())].as_bytes(), &bytes[at + 1..]].concat()
        }
        6 => {
            let [a, b] = [0, 0].map(|_| digits[dice.below(digits.len())]);
            let mut own = bytes.to_vec();
            own.swap(a, b);
            own
        }
        _ => {
            let from = dice.below(bytes.len());
            let to = (from + 1 + dice.below(40)).min(bytes.len());
            [&bytes[..from], &bytes[to..]].concat()
        }
    }
}

#[test]
fn the_drawings_to_be_mutated_are_read_whole() {
    let read = READERS.map(|(text, read)| read(text.as_bytes()).unwrap());
    let names =
        read.each_ref().map(|own| own.outlines.iter().map(|own| own.name.as_str()).collect::<Vec<_>>());
    assert_eq!(names[0], ["stone 0", "stone 1", "stone 2", "ground 0"]);
    assert_eq!(names[1].len(), 7);
    assert_eq!((names[1][3], names[1][6]), ("stone 3", "ground 0"));
    assert_eq!(names[2], ["stone 0 (K3)", "ground 0", "ground 1"]);
    assert_eq!(read.each_ref().map(|own| own.metres), [Some(1e-3), Some(1e-3), Some(0.01)]);
    assert_eq!(read.each_ref().map(|own| own.warnings.len()), [2, 2, 1]);
}

#[test]
fn a_drawing_with_something_wrong_is_read_or_told() {
    for (text, read) in READERS {
        let mut dice = Dice(12);
        for round in 0..600 {
            let own = mutated(text, &mut dice);
            match read(&own) {
                Ok(drawing) => {
                    let points = drawing.outlines.iter().flat_map(|own| &own.points);
                    assert!(points.flatten().all(|x| x.is_finite()), "{round}");
                    assert!(drawing.outlines.iter().all(|own| own.points.len() > 2), "{round}");
                }
                Err(faults) => assert!(!faults.is_empty(), "{round}"),
            }
        }
    }
}

#[test]
fn huge_and_deep_drawings_end_soon() {
    let many = |head: &str, one: &dyn Fn(usize) -> String, tail: &str, n: usize| {
        let mut text = head.to_owned();
        (0..n).for_each(|i| text.write_str(&one(i)).expect("a string grows"));
        text + tail
    };
    let entities = "0\nSECTION\n2\nENTITIES\n";
    let lines = |i: usize| format!("0\nLINE\n10\n{i}\n20\n0\n11\n{i}\n21\n{}\n", 1 + i % 7);
    let square = "[[[0,0],[1,0],[1,1]]]";
    let blocks = |i: usize| {
        let insert = format!("0\nINSERT\n2\nB{}\n", i + 1).repeat(10);
        format!("0\nBLOCK\n2\nB{i}\n10\n0\n{insert}0\nENDBLK\n")
    };
    let uses = |i: usize| format!("<g id='u{i}'>{}</g>", format!("<use href='#u{}'/>", i + 1).repeat(10));
    let cases: Vec<(&str, Read, String)> = vec![
        ("open lines", READERS[0].1, many(entities, &lines, "0\nEOF\n", 60_000)),
        (
            "circles",
            READERS[0].1,
            many(entities, &|i| format!("0\nCIRCLE\n10\n{i}\n40\n1\n"), "0\nEOF\n", 70_000),
        ),
        (
            "blocks",
            READERS[0].1,
            many(
                "0\nSECTION\n2\nBLOCKS\n",
                &blocks,
                "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nB0\n0\nEOF\n",
                20,
            ),
        ),
        (
            "rectangles",
            READERS[1].1,
            many("<svg>", &|i| format!("<rect x='{i}' width='1' height='1'/>"), "</svg>", 60_000),
        ),
        ("subpaths", READERS[1].1, many("<svg><path d='", &|i| format!("M{i} 0h1v1z"), "'/></svg>", 60_000)),
        ("groups", READERS[1].1, many("<svg>", &|_| "<g>".to_owned(), "", 100_000)),
        (
            "closed groups",
            READERS[1].1,
            "<svg>".to_owned() + &"<g>".repeat(50_000) + &"</g>".repeat(50_000) + "</svg>",
        ),
        ("uses", READERS[1].1, many("<svg>", &uses, "</svg>", 20)),
        ("attributes", READERS[1].1, many("<svg ", &|i| format!("a{i}='' "), "/>", 50_000)),
        (
            "entities",
            READERS[1].1,
            many(
                "<!DOCTYPE svg [<!ENTITY a 'aaaaaaaaaaaaaaaa'>]><svg><text>",
                &|_| "&a;".to_owned(),
                "</text></svg>",
                100_000,
            ),
        ),
        ("brackets", READERS[2].1, "[".repeat(1_000_000)),
        (
            "polygons",
            READERS[2].1,
            many(
                "{\"type\":\"MultiPolygon\",\"coordinates\":[",
                &|_| format!("{square},"),
                &format!("{square}]}}"),
                60_000,
            ),
        ),
    ];
    for (name, read, text) in cases {
        let begun = Instant::now();
        assert!(read(text.as_bytes()).is_err(), "{name}");
        // Of the order of a second, on a busy machine and without optimisation too.
        assert!(begun.elapsed().as_secs() < 20, "{name} took {:?}", begun.elapsed());
    }
}
