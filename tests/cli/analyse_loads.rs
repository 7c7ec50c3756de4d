//! `pirca analyse`: vertical shares, dead loads and supports that go down, against statics and solver against solver.

use std::fs;

use pirca::exchange::write_wall_json;
use pirca::math::{Vec3, atan, cos, degrees, radians, sin, tan};
use pirca::model::{Block, Support, Wall};
use pirca::shape::Polyhedron;
use serde_json::Value;

use crate::walls::{Folder, GOOD_JSON};

const GRAVITY: f64 = 9.806_65;
const DENSITY: f64 = 2400.0;

fn block(support: Support, low: [f64; 3], high: [f64; 3]) -> Block {
    let shape = Polyhedron::cuboid(Vec3::from(low), Vec3::from(high));
    Block { support, ..Block::stone(shape, DENSITY) }
}

/// Blocks 0.2 m deep along y and 0.4 m wide, one on the other from z = 0 up to these heights, on a wide fixed one, block 0.
fn column(heights: &[f64]) -> Vec<Block> {
    let mut blocks = vec![block(Support::Fixed, [-1.0, -1.0, -0.2], [1.0, 1.0, 0.0])];
    let mut below = 0.0;
    for &height in heights {
        blocks.push(block(Support::Free, [-0.2, -0.1, below], [0.2, 0.1, height]));
        below = height;
    }
    blocks
}

/// A beam from x = -0.2 to 1.2 m, block 2, on two fixed blocks 0.2 m wide, 0 on the left and 1 on the right.
fn beam() -> Vec<Block> {
    vec![
        block(Support::Fixed, [-0.2, 0.0, -0.2], [0.0, 0.3, 0.0]),
        block(Support::Fixed, [1.0, 0.0, -0.2], [1.2, 0.3, 0.0]),
        block(Support::Free, [-0.2, 0.0, 0.0], [1.2, 0.3, 0.3]),
    ]
}

/// What is printed of a wall, and the exit code.
fn said(blocks: &[Block], more: &[&str]) -> (String, Option<i32>) {
    let folder = Folder::new();
    fs::write(folder.path("wall.json"), write_wall_json(&Wall { blocks: blocks.to_vec() })).unwrap();
    let output = folder.pirca(&[&["analyse", "wall.json"], more].concat());
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    (text, output.status.code())
}

fn analysed(blocks: &[Block], more: &[&str]) -> Value {
    let (text, code) = said(blocks, &[more, &["--json"]].concat());
    assert_eq!(code, Some(0), "{more:?}: {text}");
    serde_json::Deserializer::from_str(&text).into_iter().next().expect("a JSON object").expect("JSON")
}

fn number(answer: &Value, key: &str) -> f64 {
    answer[key].as_f64().unwrap_or_else(|| panic!("no {key}: {answer}"))
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} instead of {expected}");
}

/// A block of depth b and height h under x W sideways and V x W upwards turns over its edge at x h / 2 = (1 - V x) b / 2, and slides
/// at x = (1 - V x) tan(phi).
#[test]
fn a_vertical_share_changes_rocking_and_sliding_as_statics_says() {
    let (stone, b, h) = (column(&[0.6]), 0.2, 0.6);
    for share in [-0.5, 0.0, 0.5, 2.0] {
        let rocks = b / (h + share * b);
        let slides = tan(radians(15.0)) / (1.0 + share * tan(radians(15.0)));
        let share = share.to_string();
        let asked = |phi: &str, more: &[&str]| {
            let lateral = ["--load", "lateral", "--vertical", &share, "--phi-deg", phi];
            let answer = analysed(&stone, &[&lateral[..], more].concat());
            assert_eq!(answer["vertical"].as_f64(), share.parse().ok());
            number(&answer, "multiplier")
        };
        for flow in ["associative", "non-associative"] {
            close(asked("60", &["--flow", flow]), rocks, 1e-6);
            close(asked("15", &["--flow", flow]), slides, 1e-6);
        }
        // The bed is not quite rigid: 1.5 % of the multiplier at 1e12 Pa/m, as the cube root of the stiffness goes.
        let implicit = ["--solver", "implicit", "--kn", "1e12"];
        let rocking = asked("60", &implicit);
        assert!(rocking < rocks && rocking > 0.985 * rocks, "{rocking} instead of {rocks}");
        close(asked("15", &implicit), slides, 1e-4);
        if share == "0.5" {
            let explicit = ["--solver", "explicit", "--kn", "1e12", "--step-deg", "2"];
            close(asked("60", &explicit), rocking, 2e-4);
            close(asked("15", &explicit), slides, 2e-4);
        }
    }
    let (text, _) = said(&stone, &["--load", "lateral", "--vertical", "0.5", "--phi-deg", "60"]);
    assert!(text.contains("0.28571 of its weight towards y+ and 0.14286 upwards"), "{text}");
}

/// Two blocks of weight W, each 0.3 m high, with N on the upper one: they turn over their edge as one where
/// x (0.15 W + 0.45 (W + N)) = 0.1 (2 W + N), and a tilt is as bad as its tangent.
#[test]
fn a_dead_load_pushes_and_turns_as_the_weight_of_its_block_does() {
    let blocks = column(&[0.3, 0.6]);
    let (weight, load) = (0.4 * 0.2 * 0.3 * DENSITY * GRAVITY, 1500.0);
    let turns = 0.1 * (2.0 * weight + load) / (0.15 * weight + 0.45 * (weight + load));
    let loaded = ["--phi-deg", "60", "--dead-load", "2=1500"];
    let lateral = [&loaded[..], &["--load", "lateral"]].concat();
    let answer = analysed(&blocks, &lateral);
    close(number(&answer, "multiplier"), turns, 1e-6);
    assert_eq!(answer["dead_loads"], serde_json::json!([{ "block": 2, "weight_n": 1500.0 }]));
    close(number(&analysed(&blocks, &loaded), "collapse_angle_deg"), degrees(atan(turns)), 1e-4);
    let elastic = |solver: &str| {
        let asked = ["--solver", solver, "--kn", "1e12", "--step-deg", "2"];
        number(&analysed(&blocks, &[&lateral[..], &asked].concat()), "multiplier")
    };
    let (implicit, explicit) = (elastic("implicit"), elastic("explicit"));
    assert!(implicit < turns && implicit > 0.98 * turns, "{implicit} instead of {turns}");
    close(explicit, implicit, 5e-4);
    // On one block of two that slide, with cohesion: c A + (2 W + N) cos(a) tan(phi) = (2 W + N) sin(a).
    let sticky = ["--phi-deg", "10", "--cohesion", "100", "--dead-load", "1=1500"];
    let angle = radians(number(&analysed(&blocks, &sticky), "collapse_angle_deg"));
    // The lower joint carries most and has the same area: it is the one that slides.
    let all = 2.0 * weight + load;
    close(100.0 * 0.08 + all * cos(angle) * tan(radians(10.0)), all * sin(angle), 1e-5 * all);
}

fn joint(answer: &Value, blocks: [u64; 2]) -> &Value {
    let joints = answer["settled_joints"].as_array().unwrap_or_else(|| panic!("{answer}"));
    let pair = serde_json::json!(blocks);
    joints.iter().find(|joint| joint["blocks"] == pair).unwrap_or_else(|| panic!("{blocks:?}: {answer}"))
}

fn upwards(joint: &Value) -> f64 {
    joint["force_on_second_n"][2].as_f64().unwrap()
}

/// A column goes down with its base: joints carry the weight above them as before, and it falls at the same tilt.
#[test]
fn a_column_goes_down_with_its_base() {
    let blocks = column(&[0.3, 0.6]);
    let weight = 0.4 * 0.2 * 0.3 * DENSITY * GRAVITY;
    for solver in ["implicit", "explicit"] {
        let asked = ["--phi-deg", "35", "--kn", "1e9", "--solver", solver];
        let settled = analysed(&blocks, &[&asked[..], &["--settle", "0=0.01"]].concat());
        let stayed = analysed(&blocks, &asked);
        // The brackets are 0.01 deg wide.
        close(number(&settled, "collapse_angle_deg"), number(&stayed, "collapse_angle_deg"), 0.02);
        assert_eq!(settled["settlements"], serde_json::json!([{ "block": 0, "down_m": 0.01 }]));
        assert_eq!((&settled["settled_share"], &stayed["settled_share"]), (&1.0.into(), &Value::Null));
        assert_eq!(stayed["settled_joints"], serde_json::json!([]));
        for (pair, carried, height) in [([0, 1], 2.0 * weight, 0.0), ([1, 2], weight, 0.3)] {
            let joint = joint(&settled, pair);
            // The explicit solver stops at an unbalanced force ratio of 1e-5.
            close(upwards(joint), carried, 1e-4 * carried);
            // 1e9 Pa/m gives by 14 micrometres at most.
            close(joint["place_m"][2].as_f64().unwrap(), height - 0.01, 4e-5);
            assert_eq!(joint["opening"], 0.0);
            assert!(joint["slip"].as_f64().unwrap() < 1e-9, "{joint}");
        }
    }
}

/// A beam turns by the settlement over its span. It then presses on two edges, 1.2 m apart, over zones c = sqrt(2 R / (kn t w)) that
/// a pressure growing linearly needs on a joint of width w under a turn t; the reactions act at c / 3, and the joints open over the
/// rest of their 0.2 m.
#[test]
fn a_beam_on_a_settling_support_turns_and_is_carried_as_statics_says() {
    let (kn, width, down) = (1e9, 0.3, 0.01);
    let weight = 1.4 * 0.3 * width * DENSITY * GRAVITY;
    let (mut turn, mut reactions, mut zones) = (down / 1.2, [0.5 * weight; 2], [0.0; 2]);
    for _ in 0..50 {
        zones = reactions.map(|reaction: f64| (2.0 * reaction / (kn * turn * width)).sqrt());
        // From the left edge at x = 0, deep by t c, to the right one at x = 1.2.
        turn = (down + turn * (zones[1] - zones[0])) / 1.2;
        let [left, right] = [-zones[0] / 3.0, 1.2 - zones[1] / 3.0];
        reactions[1] = weight * (0.5 - left) / (right - left);
        reactions[0] = weight - reactions[1];
    }
    for solver in ["implicit", "explicit"] {
        let asked = ["--phi-deg", "35", "--kn", "1e9", "--solver", solver, "--settle", "1=0.01"];
        let answer = analysed(&beam(), &asked);
        for (support, reaction, zone) in [(0, reactions[0], zones[0]), (1, reactions[1], zones[1])] {
            let joint = joint(&answer, [support, 2]);
            // Friction at the edges, which statics leaves open, has a lever of the settlement over the span.
            close(upwards(joint), reaction, 1e-3 * weight);
            let opening = turn * (0.2 - zone);
            close(joint["opening"].as_f64().unwrap(), opening, 2e-3 * opening);
        }
    }
    let asked = ["--phi-deg", "35", "--kn", "1e9", "--solver", "implicit", "--settle", "1=0.01"];
    let (text, _) = said(&beam(), &asked);
    assert!(text.contains("open on the settled supports: block 1 - block 2 by 1.39"), "{text}");
}

/// A slender block on two supports turns about the edge of the left one as the right one goes down, and on the corner that stands
/// there it topples: tan(t) = b / h, where the corner has gone 0.13 m sin(t). That is 0.0129 m, 65 % of 0.02 m; soft joints take some
/// off.
#[test]
fn a_wall_that_falls_before_its_support_is_down_says_when() {
    let blocks = [
        block(Support::Fixed, [-0.5, 0.0, -0.2], [-0.03, 0.3, 0.0]),
        block(Support::Fixed, [-0.03, 0.0, -0.2], [0.5, 0.3, 0.0]),
        block(Support::Free, [-0.1, 0.0, 0.0], [0.1, 0.3, 2.0]),
    ];
    let topples = 0.13 * sin(atan(0.1)) / 0.02;
    for (solver, kn, lost) in
        [("implicit", "1e10", 0.05), ("explicit", "1e10", 0.05), ("implicit", "1e12", 0.025)]
    {
        let asked = ["--phi-deg", "35", "--kn", kn, "--solver", solver, "--settle", "1=0.02"];
        let answer = analysed(&blocks, &asked);
        assert_eq!((&answer["outcome"], &answer["multiplier"]), (&"collapsed".into(), &Value::Null));
        assert_eq!(answer["mechanism"], serde_json::json!([2]));
        let share = number(&answer, "settled_share");
        assert!(share < topples && share > topples - lost, "{solver} {kn}: {share} instead of {topples}");
    }
    let (text, _) = said(
        &blocks,
        &["--phi-deg", "35", "--kn", "1e10", "--solver", "implicit", "--settle", "1=0.02", "--out", "seen"],
    );
    assert!(text.contains("of the settlement of its supports, before the load grows"), "{text}");
}

#[test]
fn loads_that_make_no_sense_are_refused_with_what_is_allowed() {
    let folder = Folder::new();
    fs::write(folder.path("wall.json"), GOOD_JSON).unwrap();
    let implicit = ["--solver", "implicit", "--kn", "1e9"];
    for (more, said) in [
        (&["--vertical", "0.3"][..], "--vertical is for --load lateral"),
        (&["--load", "lateral", "--vertical", "3"], "a number from -2 to 2 of the horizontal load"),
        (&["--load", "lateral", "--vertical", "nan"], "a number from -2 to 2 of the horizontal load"),
        (&["--dead-load", "7"], "allowed is ID=N, as 12=1500"),
        (&["--dead-load", "stone=5"], "\"stone\" is no id of a block; allowed is ID=N"),
        (&["--dead-load", "7=-5"], "a number from 0 to 1e9 N downwards"),
        (&["--dead-load", "5=10"], "there is no block 5; blocks that move: 4, 7, 9"),
        (&["--dead-load", "0=10"], "block 0 is fixed: it carries any load; blocks that move: 4, 7, 9"),
        (&["--dead-load", "7=10", "--dead-load", "7=10"], "--dead-load 7 is there twice"),
        (&["--settle", "0=0.01"], "ask --solver implicit --kn PA_PER_M, or move the support"),
        (&[&implicit[..], &["--settle", "0=9"]].concat(), "a number from 0 to 0.5 m downwards"),
        (
            &[&implicit[..], &["--settle", "4=0.01"]].concat(),
            "block 4 is not fixed: it goes where its support goes; blocks that are fixed: 0",
        ),
    ] {
        let output = folder.pirca(&[&["analyse", "wall.json", "--phi-deg", "30"], more].concat());
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {text}");
        assert!(text.contains(said), "{more:?}: {text}");
    }
    // Two parts of one support.
    let mut blocks = beam();
    blocks.iter_mut().take(2).for_each(|block| block.group = Some("frame".to_owned()));
    let twice = ["--settle", "0=0.01", "--settle", "1=0.01", "--phi-deg", "30"];
    let (text, code) = said(&blocks, &[&twice[..], &implicit].concat());
    assert!(code == Some(2) && text.contains("blocks 0 and 1 are parts of one body"), "{text}");
}
