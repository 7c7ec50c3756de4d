//! How many walls a small probability takes: a wall of 72 random stones to a coefficient of variation of 20 %.
//!
//! `cargo bench --bench capacity`; a name runs one method: `-- importance`. It prints and records nothing: walls are counted, and
//! their number depends on no machine. See `benches/README.md`.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use serde_json::Value;

/// A free wall of 72 stones or so on a tilting table: lengths, dips and friction differ from stone to stone, stiffness and density
/// from wall to wall.
const WALL: &str = r#"
[study]
question = "How probable is it that a wall of 72 random stones falls at a low tilt?"
seed = 3

[wall]
height_m = 1.0
length_m = 1.6
base_thickness_m = 0.35
top_thickness_m = 0.25
battered_face = "both"

[block]
density_kg_per_m3 = 2400

[joint]
kn_pa_per_m = [5e7]
kn_over_ks = 2
phi_deg = { family = "uniform", low = 28, high = 36 } # from joint to joint
cohesion_pa = 0

[load]
protocol = "tilting"
towards = "y+"

[restraint]
base = "fixed"
ends = "free"

[solver]
name = "implicit"

[[arm]]
name = "irregular"
members = 60
arrangement = "coursed"
length_m = { family = "uniform", low = 0.13, high = 0.27 }
height_m = 0.111
dip_deg = { family = "uniform", low = -10, high = 10 }

[uncertain]
"joint.kn_pa_per_m" = { family = "lognormal", mean = 5e7, sd = 1.5e7 }
"block.density_kg_per_m3" = { family = "uniform", low = 2200, high = 2600 }
"#;

/// Methods with a level (deg) and the most walls that are spent on it: where plain sampling goes, the others must agree with it.
const SCENES: [[&str; 3]; 3] =
    [["plain", "12.2", "4000"], ["importance", "12.2", "1500"], ["importance", "10", "1500"]];

fn main() {
    let asked = std::env::args().skip(1).find(|own| !own.starts_with("--"));
    let folder = std::env::temp_dir().join(format!("pirca-bench-capacity-{}", std::process::id()));
    let study = folder.join("wall-72");
    fs::create_dir_all(&study).expect("a folder");
    fs::write(study.join("study.toml"), WALL).expect("a file");
    for scene in SCENES.iter().filter(|scene| asked.as_ref().is_none_or(|of| scene[0] == of)) {
        let out = folder.join(scene[..2].join("-"));
        println!("{}", answer(&study, &out, *scene));
    }
    fs::remove_dir_all(folder).expect("it is the bench's own");
}

/// One line of what a method comes to.
fn answer(study: &Path, out: &Path, [method, level, walls]: [&str; 3]) -> String {
    let begun = Instant::now();
    let output = Command::new(env!("CARGO_BIN_EXE_pirca"))
        .args([
            "capacity",
            "--below-deg",
            level,
            "--walls",
            walls,
            "--cov",
            "0.2",
            "--method",
            method,
            "--json",
        ])
        .arg("--out")
        .arg(out)
        .arg(study)
        .output()
        .expect("the binary runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let json: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let group = &json["groups"][0];
    format!(
        "wall_72, below {level} deg, {method}: {} {} at a COV of {}, {} walls solved, {:.0} s",
        group["probability"],
        group["interval"],
        group["cov"],
        group["evaluations"]["implicit"],
        begun.elapsed().as_secs_f64()
    )
}
