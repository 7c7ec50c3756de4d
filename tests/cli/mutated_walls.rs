//! The readers of walls against texts that chance has spoilt: never a panic, and what is taken for good is good.

use std::time::Instant;

use pirca::contact::{Settings, survey};
use pirca::exchange::{
    ReadOptions, Up, WallFaults, WallFile, read_obj, read_wall_json, read_wall_json_with, write_obj,
    write_wall_json,
};
use pirca::generate::canonical;
use pirca::model::Support;

use crate::walls::{GOOD_JSON, GOOD_OBJ};

/// The seed of all draws here.
const SEED: u64 = 20_261_121;

/// A generator of 64-bit numbers (splitmix64): enough for spoiling texts, and the same everywhere.
pub struct Draws(pub u64);

impl Draws {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }

    fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.below(from.len())]
    }
}

/// What is put in the place of numbers and words.
const TOKENS: [&str; 36] = [
    "NaN",
    "-Infinity",
    "1e999",
    "1e308",
    "-1e308",
    "1e-320",
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "3",
    "8",
    "0.1",
    "400",
    "1e7",
    "4294967296",
    "18446744073709551616",
    "9007199254740993",
    "null",
    "true",
    "false",
    "\"\"",
    "\"m\"",
    "\"mm\"",
    "[]",
    "{}",
    "[[]]",
    "{\"id\":0}",
    "\\",
    "\"",
    "f",
    "o",
    "v",
    "f 1 2 3",
    "\u{e9}",
];

/// The text with one to four accidents.
pub fn spoilt(text: &str, draws: &mut Draws) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=draws.below(4) {
        let at = draws.below(bytes.len());
        let to = (at + 1 + draws.below(40)).min(bytes.len());
        match draws.below(8) {
            0 if !bytes.is_empty() => bytes[at] = draws.below(256) as u8,
            1 if !bytes.is_empty() => bytes[at] ^= 1 << draws.below(8),
            2 => bytes.truncate(at),
            3 => {
                bytes.drain(at..to);
            }
            4 => {
                let part = bytes[at..to].to_vec();
                let place = draws.below(bytes.len());
                bytes.splice(place..place, part);
            }
            5 => {
                bytes.splice(at..at, draws.pick(&TOKENS).bytes());
            }
            _ => {
                let (from, to) = number_near(&bytes, at);
                let token = draws.pick(&TOKENS);
                bytes.splice(from..to, token.bytes());
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The number at or after a byte.
fn number_near(bytes: &[u8], at: usize) -> (usize, usize) {
    let part = |b: &u8| b.is_ascii_digit() || b".-+eE".contains(b);
    let from = at + bytes[at..].iter().take_while(|b| !part(b)).count();
    (from, from + bytes[from..].iter().take_while(|b| part(b)).count())
}

/// A wall.json of random structure, mostly wrong.
fn made_up(draws: &mut Draws) -> String {
    let list = |draws: &mut Draws, most: usize, inner: &mut dyn FnMut(&mut Draws) -> String| {
        let n = draws.below(most);
        let items: Vec<String> = (0..n).map(|_| inner(draws)).collect();
        format!("[{}]", items.join(","))
    };
    let block = |draws: &mut Draws| {
        let vertices = list(draws, 10, &mut |d| format!("[{},{},{}]", d.below(3), d.below(3), d.below(3)));
        let faces = list(draws, 8, &mut |d| list(d, 6, &mut |d| d.below(9).to_string()));
        let mut entries = vec![
            format!("\"id\":{}", draws.below(4)),
            format!("\"vertices\":{vertices}"),
            format!("\"faces\":{faces}"),
            format!("\"density\":{}", draws.pick(&["2400", "0", "-1", "null"])),
            format!("\"fixed\":{}", draws.pick(&["true", "false", "1"])),
        ];
        entries.remove(draws.below(9).min(entries.len() - 1));
        format!("{{{}}}", entries.join(","))
    };
    let blocks: Vec<String> = (0..draws.below(4)).map(|_| block(draws)).collect();
    format!("{{\"unit\":\"m\",\"blocks\":[{}]}}", blocks.join(","))
}

/// What a reader has taken for good is fit for the solvers.
fn must_be_good(read: Result<WallFile, WallFaults>, text: &str) -> bool {
    let Ok(file) = read else {
        let faults = read.expect_err("it is one");
        assert!(!faults.is_empty() && !faults.to_string().is_empty(), "{text}");
        return false;
    };
    let blocks = &file.wall.blocks;
    assert!(blocks.iter().any(|b| b.support == Support::Fixed) && blocks.len() > 1, "{text}");
    assert_eq!((file.ids.len(), file.names.len()), (blocks.len(), blocks.len()));
    for block in blocks {
        let (low, high) = block.shape.bounds();
        let size = (high - low).norm();
        // The tolerance of the readers, and a little for the box shrinking when idle vertices are dropped.
        block.shape.validate(1.001e-4 * size.max(1e-3)).unwrap_or_else(|e| panic!("{e}: {text}"));
        assert!((1e-4..=250.0).contains(&size) && (10.0..=23_000.0).contains(&block.density), "{text}");
    }
    let leads = file.wall.leads();
    assert!(leads.iter().enumerate().all(|(id, &lead)| lead <= id && leads[lead] == lead), "{text}");
    assert!(leads.iter().enumerate().all(|(id, &lead)| blocks[id].support == blocks[lead].support), "{text}");
    let found = survey(&file.wall, &Settings::for_size(0.2, [2, 2]), 0.02);
    assert!(found.is_none_or(|found| found.deepest.is_finite()), "{text}");
    true
}

/// Spoils good texts `count` times; how many of the results were still good.
fn spoil(count: usize, seed: u64) -> usize {
    let mut draws = Draws(seed);
    let (json, obj) = (write_wall_json(&small()), write_obj(&small()));
    let mut good = 0;
    for i in 0..count {
        let (text, is_obj) = match i % 6 {
            0 | 1 => (spoilt(GOOD_JSON, &mut draws), false),
            2 | 3 => (spoilt(GOOD_OBJ, &mut draws), true),
            4 if i % 12 == 4 => (spoilt(&json, &mut draws), false),
            4 => (spoilt(&obj, &mut draws), true),
            _ => (made_up(&mut draws), false),
        };
        let flatness = [None, Some(1e-3), Some(0.05)][i % 3];
        let up = (i % 5 == 0).then_some(Up::Y);
        let options = ReadOptions { flatness, up, ..ReadOptions::default() };
        let read = if is_obj { read_obj(&text, &options) } else { read_wall_json_with(&text, flatness) };
        good += usize::from(must_be_good(read, &text));
    }
    good
}

/// The lowest stones of the 72-block wall, two of them one body, on their base.
fn small() -> pirca::model::Wall {
    let mut wall = canonical::wall_72();
    wall.blocks.truncate(3);
    wall.blocks[1..].iter_mut().for_each(|block| block.group = Some("pair".to_owned()));
    wall.with_base()
}

#[test]
fn no_spoilt_text_makes_the_readers_panic_or_take_a_bad_wall_for_good() {
    let count = 20_000;
    let good = spoil(count, SEED);
    // Neither all refused nor all taken: the accidents reach the checks behind the syntax.
    assert!((count / 100..count / 2).contains(&good), "{good} of {count} were taken for good");
}

/// The long run: `cargo test --release --test cli -- --ignored a_million`.
#[test]
#[ignore = "a minute or two"]
fn a_million_spoilt_texts_make_no_panic() {
    let begun = Instant::now();
    let good = spoil(1_200_000, SEED + 1);
    println!(
        "1,200,000 texts (seed {}) in {:.1} s, {good} still good",
        SEED + 1,
        begun.elapsed().as_secs_f64()
    );
}

/// Vertices moved a little: refused with a reason, or taken and then plane and convex to the stated tolerance.
#[test]
fn a_good_wall_with_its_corners_moved_is_refused_or_still_good() {
    let mut draws = Draws(SEED);
    let (mut taken, mut refused) = (0, 0);
    for scale in [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2] {
        for _ in 0..40 {
            let mut wall = small();
            for block in &mut wall.blocks {
                for vertex in &mut block.shape.vertices {
                    for c in vertex.iter_mut() {
                        *c += scale * (draws.below(2001) as f64 / 1000.0 - 1.0);
                    }
                }
            }
            let text = write_wall_json(&wall);
            if must_be_good(read_wall_json(&text), &text) { taken += 1 } else { refused += 1 }
        }
    }
    assert!(taken > 50 && refused > 50, "{taken} taken, {refused} refused");
}
