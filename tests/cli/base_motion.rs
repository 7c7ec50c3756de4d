//! A wall from a file on ground that moves as a record says: a block with a known answer, what is printed, what is refused.

use std::fmt::Write;
use std::fs;

use serde_json::Value;

use crate::walls::{Folder, example};

/// A free block of 0.4 m x 1.2 m, out of plane and up, on a fixed ground.
const BLOCK: &str = r#"{"unit":"m","blocks":[
{"id":0,"vertices":[[-2,-3,-0.5],[2,-3,-0.5],[2,3,-0.5],[-2,3,-0.5],[-2,-3,0],[2,-3,0],[2,3,0],[-2,3,0]],"faces":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],"fixed":true},
{"id":1,"vertices":[[-0.2,-0.2,0],[0.2,-0.2,0],[0.2,0.2,0],[-0.2,0.2,0],[-0.2,-0.2,1.2],[0.2,-0.2,1.2],[0.2,0.2,1.2],[-0.2,0.2,1.2]],"faces":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],"density":2400}
]}"#;

/// A half-sine pulse of a peak (m/s^2) and a circular frequency of twice the block's p, 2 x 3.4102/s under 9.80665 m/s^2, as CSV; then 1 s of nothing.
fn half_sine(peak: f64, name: &str) -> String {
    let (step, w) = (1e-3, 2.0 * 3.410_17);
    let mut text = format!("t_s,{name}\n");
    for k in 0..1461 {
        let (time, phase) = (f64::from(k) * step, f64::from(k) * step * w);
        let value = if phase < std::f64::consts::PI { peak * pirca::math::sin(phase) } else { 0.0 };
        writeln!(text, "{time:.3},{value:.9}").expect("a string takes all");
    }
    text
}

fn folder(peak: f64, name: &str) -> Folder {
    let folder = Folder::new();
    for (file, text) in [("block.json", BLOCK), ("pulse.csv", &half_sine(peak, name))] {
        fs::write(folder.path(file), text).expect("it can be written");
    }
    folder
}

const ASKED: [&str; 9] =
    ["analyse", "block.json", "--phi-deg", "60", "--load", "base-motion", "--record", "pulse.csv", "--json"];

fn answer(folder: &Folder, more: &[&str]) -> Value {
    let output = folder.pirca(&[&ASKED[..], more].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{more:?}: {said}");
    serde_json::from_slice(&output.stdout).expect("one JSON object on standard output")
}

#[test]
fn a_block_overturns_above_the_amplitude_of_the_nonlinear_equation_and_stands_below() {
    // 5.89217 m/s^2 under 9.81: 5.8902 here. 2 % below it stands, 2 % above it falls.
    let folder = folder(5.8902, "ay_m_per_s2");
    let stands = answer(&folder, &["--solver", "nonsmooth", "--scale", "0.98", "--time-step", "5e-4"]);
    assert_eq!((&stands["outcome"], &stands["half_weight_s"]), (&"stands".into(), &Value::Null), "{stands}");
    let turned = stands["largest_rotation_rad"].as_f64().expect("it rocks");
    // The unstable equilibrium is at atan(1/3) = 0.322.
    assert!((0.2..0.33).contains(&turned), "{turned}");
    assert_eq!(stands["extremes"]["rotation"]["block"], "block 1", "{stands}");
    assert!((stands["record"]["pga_m_per_s2"].as_f64().expect("a peak") - 0.98 * 5.8902).abs() < 1e-3);
    let falls = answer(&folder, &["--solver", "nonsmooth", "--scale", "1.02", "--time-step", "5e-4"]);
    assert_eq!((&falls["outcome"], &falls["twin_outcome"]), (&"collapsed".into(), &"collapsed".into()));
    assert!(falls["half_weight_s"].as_f64().expect("it falls") > 0.4, "{falls}");
    assert_eq!(falls["fallen"].as_array().map(Vec::len), Some(1));
    // The explicit solver with stiff joints says the same 5 % away.
    for (scale, outcome) in [("0.95", "stands"), ("1.05", "collapsed")] {
        let explicit = answer(&folder, &["--solver", "explicit", "--kn", "1e11", "--scale", scale]);
        assert_eq!(explicit["outcome"], outcome, "{explicit}");
    }
}

#[test]
fn a_record_without_an_axis_acts_along_the_direction_and_words_say_what_came_of_it() {
    let folder = folder(5.8902, "a_m_per_s2");
    // Turned by a right angle the square block does the same.
    let along = answer(&folder, &["--solver", "nonsmooth", "--scale", "1.05", "--direction", "x+"]);
    assert_eq!(along["outcome"], "collapsed", "{along}");
    let asked = [&ASKED[..8], &["--solver", "nonsmooth", "--scale", "0.5"]].concat();
    let output = folder.pirca(&asked);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.starts_with("The wall stands: no block falls.\n"), "{text}");
    assert!(text.contains("largest turn"), "{text}");
}

/// The block on its edge y = -0.2 m, turned by 3 deg about it: it falls back onto its face before it is shaken, and that is said.
#[test]
fn a_wall_that_is_not_in_balance_as_built_is_shaken_from_where_it_rests_and_it_is_said() {
    let folder = folder(0.3, "ay_m_per_s2");
    let lean = 3f64.to_radians();
    let mut wall: Value = serde_json::from_str(BLOCK).expect("JSON");
    for corner in wall["blocks"][1]["vertices"].as_array_mut().expect("a list") {
        let [y, z] = [1, 2].map(|axis| corner[axis].as_f64().expect("a number"));
        let (sine, cosine) = (pirca::math::sin(lean), pirca::math::cos(lean));
        corner[1] = (-0.2 + (y + 0.2) * cosine - z * sine).into();
        corner[2] = ((y + 0.2) * sine + z * cosine).into();
    }
    for solver in [&["--solver", "nonsmooth"][..], &["--solver", "explicit", "--kn", "1e10"]] {
        let upright = answer(&folder, solver);
        assert_eq!((&upright["settled"], &upright["outcome"]), (&Value::Null, &"stands".into()), "{upright}");
        fs::write(folder.path("block.json"), wall.to_string()).expect("it can be written");
        let leaning = answer(&folder, solver);
        fs::write(folder.path("block.json"), BLOCK).expect("it can be written");
        let turned = leaning["settled"]["rotation_rad"].as_f64().expect("it falls back");
        // Joints that give way turn it by less than a thousandth of that.
        assert!((turned - lean).abs() < 1e-3 * lean, "{turned} {lean}");
        assert_eq!(leaning["settled"]["block"], "block 1", "{leaning}");
        let warnings = leaning["warnings"].to_string();
        assert!(
            warnings.contains("not in balance as built: until it rests block 1 turns by 3.00 deg"),
            "{warnings}"
        );
        assert!(!warnings.contains("block block"), "{warnings}");
    }
}

#[test]
fn what_is_asked_in_vain_and_odd_records_are_refused() {
    let folder = folder(3.0, "ay_m_per_s2");
    let tower = example("leaning-tower.json").display().to_string();
    for (more, said) in [
        (&["--solver", "limit"][..], "for solvers that know time"),
        (&["--solver", "implicit", "--kn", "1e9"], "for solvers that know time"),
        (&["--solver", "explicit"], "--kn PA_PER_M is required"),
        (&["--solver", "nonsmooth", "--rayleigh", "0.05,1,10"], "--rayleigh is for --solver explicit"),
        (
            &["--solver", "explicit", "--kn", "1e9", "--time-step", "1e-3"],
            "--time-step is for --solver nonsmooth",
        ),
        (&["--solver", "explicit", "--kn", "1e9", "--rayleigh", "0.05,10,1"], "is not below the second"),
        (&["--solver", "nonsmooth", "--worst-direction"], "--worst-direction is not for --load base-motion"),
        (
            &["--solver", "explicit", "--kn", "1e9", "--restitution", "0.5"],
            "--restitution is for --solver nonsmooth",
        ),
        (&["--solver", "nonsmooth", "--restitution", "1.5"], "of the closing speed"),
        (&["--solver", "nonsmooth", "--lean-deg", "-1"], "0 to 45 degrees"),
        (
            &["--solver", "nonsmooth", "--scale", "0.5,1", "--report"],
            "--report is for one record at one scale",
        ),
        (&["--solver", "nonsmooth", "--scale", "0"], "times the record"),
    ] {
        let output = folder.pirca(&[&ASKED[..], more].concat());
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {told}");
        assert!(told.contains(said), "{more:?}: {told}");
    }
    for (asked, said) in [
        (
            &["analyse", &tower, "--phi-deg", "30", "--record", "pulse.csv"][..],
            "--record is for --load base-motion",
        ),
        (
            &["analyse", &tower, "--phi-deg", "30", "--load", "base-motion", "--solver", "nonsmooth"],
            "needs --record FILE",
        ),
        (
            &[
                "analyse",
                &tower,
                "--phi-deg",
                "30..38",
                "--load",
                "base-motion",
                "--solver",
                "nonsmooth",
                "--record",
                "pulse.csv",
            ],
            "takes one number",
        ),
    ] {
        let output = folder.pirca(asked);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{asked:?}: {told}");
        assert!(told.contains(said), "{asked:?}: {told}");
    }
    // A record with a hole in its times.
    let holed: String = half_sine(3.0, "ay_m_per_s2")
        .lines()
        .filter(|line| !line.starts_with("0.100"))
        .map(|l| format!("{l}\n"))
        .collect();
    fs::write(folder.path("pulse.csv"), holed).expect("it can be written");
    let output = folder.pirca(&[&ASKED[..], &["--solver", "nonsmooth"]].concat());
    let told = String::from_utf8_lossy(&output.stderr);
    // Faults of a file end with 3.
    assert_eq!(output.status.code(), Some(3), "{told}");
    assert!(told.contains("pulse.csv:102: ") && told.contains("equal steps"), "{told}");
}
