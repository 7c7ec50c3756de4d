//! Many walls with one face: what is drawn behind it, and what a study refuses.

use std::fs;

use pirca::ensemble::sources;
use pirca::math::{atan, degrees};
use pirca::study::Study;
use serde_json::Value;

use crate::fixture::stderr;
use crate::walls::Folder;

/// Two courses of two stones in a running bond, 1 m long and 0.5 m high.
const TABLE: &str = "x,z,length,height\n0,0,0.5,0.25\n0.5,0,0.5,0.25\n0,0.25,0.25,0.25\n0.25,0.25,0.5,0.25\n0.75,0.25,0.25,0.25\n";

fn study(unseen: &str) -> String {
    format!(
        r#"[study]
question = "How strong is what is behind this face?"
seed = 3
[joint]
kn_pa_per_m = [1e9]
kn_over_ks = 2
phi_deg = 35
cohesion_pa = 0
sub_contacts = [4, 4]
[load]
protocol = "tilting"
towards = "y+"
capacity = "first_stone"
[restraint]
base = "fixed"
ends = "free"
[solver]
name = "limit"
flow = "non-associative"
[[arm]]
name = "wall"
members = 12
arrangement = "file"
file = "wall.csv"
unit = "m"
unstated_density_kg_per_m3 = 2400
thickness_m = 0.4
{unseen}"#
    )
}

/// The collapse angles (deg) of its walls.
fn angles(unseen: &str) -> Result<Vec<f64>, String> {
    let folder = Folder::new();
    fs::create_dir(folder.path("face")).expect("a folder");
    fs::write(folder.path("face/study.toml"), study(unseen)).expect("written");
    fs::write(folder.path("face/wall.csv"), TABLE).expect("written");
    let output = folder.pirca(&["run", "face", "--csv", "--json"]);
    if !output.status.success() {
        return Err(stderr(&output));
    }
    let table = fs::read_to_string(folder.path("runs/face/members.csv")).expect("a table");
    let mut lines = table.lines();
    let at = lines
        .next()
        .and_then(|head| head.split(',').position(|own| own == "collapse_angle_deg"))
        .expect("a column");
    Ok(lines.filter_map(|line| line.split(',').nth(at)?.parse().ok()).collect())
}

#[test]
fn walls_with_one_face_differ_by_what_is_behind_it() {
    // A wall of one leaf, 0.4 m deep and 0.5 m high, slides on its base before it topples.
    let solid = angles("\n[arm.unseen]\nthrough_share = 1\n").expect("walls");
    assert!(solid.iter().all(|own| (own - 35.0).abs() < 0.01), "{solid:?}");
    let unseen = angles("\n[arm.unseen]\nthrough_share = { family = \"uniform\", low = 0, high = 0.5 }\n");
    let unseen = unseen.expect("walls");
    assert_eq!(unseen.len(), 12);
    let (low, high) =
        unseen.iter().fold((f64::MAX, 0.0_f64), |(low, high), own| (low.min(*own), high.max(*own)));
    assert!(low > 10.0 && high <= 35.01 && high - low > 0.3, "{unseen:?}");
}

#[test]
fn a_core_of_which_nothing_ties_the_leaves_weakens_the_wall() {
    let angle = |core: &str| {
        let unseen = format!("\n[arm.unseen]\nthrough_share = 0\ndepth_share = 0.5\ncore_share = {core}\n");
        angles(&unseen).expect("walls")[0]
    };
    // Each leaf topples by itself, as a block of its own depth does: 0.14 m with a core of 0.12 m, both 0.5 m high.
    let (cored, whole) = (angle("0.3"), angle("0"));
    assert!((cored - degrees(atan(0.14 / 0.5))).abs() < 0.02, "{cored}");
    assert!(whole > cored + 3.0, "leaves that touch lean on each other: {whole}");
}

#[test]
fn the_scatter_of_what_is_unseen_has_its_sources() {
    let of = |unseen: &str| {
        let folder = Folder::new();
        fs::create_dir(folder.path("face")).expect("a folder");
        fs::write(folder.path("face/study.toml"), study(unseen)).expect("written");
        fs::write(folder.path("face/wall.csv"), TABLE).expect("written");
        let study = Study::load(&folder.path("face"), None).expect("a study").study;
        let names: Vec<String> = sources(&study.arms[0]).into_iter().map(|own| own.name).collect();
        names
    };
    let all = of(
        "\n[arm.unseen]\ncore_share = { family = \"uniform\", low = 0, high = 0.2 }\ndip_deg = { family = \"uniform\", low = -2, high = 2 }\n",
    );
    assert_eq!(all, ["layout", "throughs", "depths", "core", "beds through the wall"]);
    assert_eq!(of("\n[arm.unseen]\nthrough_share = 0.3\ndepth_share = 0.5\n"), ["layout"]);
    assert_eq!(of("\n[arm.unseen]\nthrough_share = 1\n"), Vec::<String>::new());
}

#[test]
fn what_is_unseen_is_of_faces_alone() {
    let folder = Folder::new();
    fs::create_dir(folder.path("face")).expect("a folder");
    fs::write(folder.path("face/study.toml"), study("\n[arm.unseen]\nthrough_share = 0.2\n"))
        .expect("written");
    let deep = TABLE.replace("height\n", "height,depth\n").replace(",0.25\n", ",0.25,0.4\n").replacen(
        ",0.25,0.4\n",
        ",0.25,0.3\n",
        1,
    );
    fs::write(folder.path("face/wall.csv"), deep).expect("written");
    let output = folder.pirca(&["check", "face", "--json"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &stderr(&output);
    assert!(
        !output.status.success() && said.contains("stones of this file have depths of their own"),
        "{said}"
    );
    let told: Value = serde_json::from_slice(&output.stdout).unwrap_or(Value::Null);
    assert!(told.is_null() || told.to_string().contains("unseen"), "{told}");
}
