//! `studies/element-types`: the source paper's section 5.1 and Table 6.

use std::fs;
use std::path::Path;

use pirca::ensemble::{ElementRow, evaluate_element};
use pirca::study::ElementStudy;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/element-types");

fn study() -> ElementStudy {
    ElementStudy::load(Path::new(FOLDER)).expect("the study is valid")
}

fn row(study: &ElementStudy, name: &str, member: u64) -> ElementRow {
    let arm = study.arms.iter().find(|arm| arm.name == name).expect("the study has that arm");
    evaluate_element(study, arm, member)
}

#[test]
fn spheres_fall_and_blocks_of_spheres_stand() {
    let study = study();
    for (name, elements, ending) in [
        ("aligned-spheres", 27, "falls_sideways"),
        ("sphere-cloud", 28, "falls_under_gravity"),
        ("clumps-mesh", 64, "stands"),
        ("clumps-compact", 64, "stands"),
        ("blocks", 16, "stands"),
    ] {
        let row = row(&study, name, 0);
        println!("{name}: {row:?}");
        assert_eq!((row.elements, row.ending()), (elements, ending), "{name}");
    }
}

#[test]
fn a_small_lateral_load_is_enough_for_aligned_spheres() {
    let mut study = study();
    study.shove.acceleration = 0.1;
    assert_eq!(row(&study, "aligned-spheres", 0).ending(), "falls_sideways");
    assert_eq!(row(&study, "clumps-compact", 0).ending(), "stands");
}

#[test]
fn an_assembly_gives_the_same_bits_again() {
    let study = study();
    assert_eq!(row(&study, "clumps-compact", 0), row(&study, "clumps-compact", 0));
    assert_eq!(row(&study, "sphere-cloud", 1), row(&study, "sphere-cloud", 1));
    assert_ne!(row(&study, "sphere-cloud", 1), row(&study, "sphere-cloud", 0));
}

#[test]
fn faults_are_named_and_none_is_passed_over() {
    let text = fs::read_to_string(Path::new(FOLDER).join("study.toml")).expect("the study is there");
    let folder = std::env::temp_dir().join(format!("pirca-element-types-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder for the test");
    for (from, to, named) in [
        ("side_m = 0.4", "side_m = -0.4", "cube.side_m"),
        ("across = 2", "across = 2\nradius_m = 0.1", "element.clumps-mesh.radius_m"),
        ("fine_ratio = 0.001", "fine_ratio = 0.1", "shove.fine_ratio"),
        ("name = \"blocks\"", "name = \"clumps-mesh\"", "name"),
        ("along_z = 3", "along_z = 3\nmembers = 2", "members"),
        ("young_pa = 3.07e10", "young_mpa = 3.07e4", "spheres.young_pa"),
    ] {
        assert!(text.contains(from), "{from}");
        fs::write(folder.join("study.toml"), text.replacen(from, to, 1)).expect("it can be written");
        assert!(ElementStudy::is_in(&folder));
        let faults = ElementStudy::load(&folder).expect_err(to).to_string();
        assert!(faults.contains(named), "{to}: {faults}");
    }
    let unusual = text.replacen("young_pa = 3.07e10", "young_pa = 30.7", 1);
    fs::write(folder.join("study.toml"), unusual).expect("it can be written");
    let warned = ElementStudy::load(&folder).expect("it is valid").warnings;
    assert_eq!(warned.len(), 1, "{warned:?}");
    fs::remove_dir_all(&folder).expect("the folder is ours");
}
