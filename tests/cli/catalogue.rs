//! Every file below `distributions/` and `studies/` loads, has its unit and its source, and names what exists.

use std::fs;
use std::path::{Path, PathBuf};

use pirca::generate::Arrangement;
use pirca::study::{ClaimTest, ElementStudy, Study, load_distributions};

fn root(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

#[test]
fn every_distribution_loads_with_its_unit_and_source() {
    let files = load_distributions(&root("distributions")).unwrap_or_else(|faults| panic!("{faults}"));
    for (name, unit) in [
        ("block/density", "kg/m3"),
        ("block/dip", "deg"),
        ("block/size", "m"),
        ("block/size_factor", "1"),
        ("block/wedge", "m"),
        ("joint/cohesion", "Pa"),
        ("joint/friction", "deg"),
        ("joint/stiffness", "Pa/m"),
    ] {
        assert_eq!(files[name].unit, unit, "{name}");
    }
    for (name, file) in &files {
        for (entry, distribution) in &file.entries {
            // A publication has its year.
            let has_year = |source: &str| {
                let words = source.split(|c: char| !c.is_ascii_digit());
                words.into_iter().any(|word| word.len() == 4)
            };
            let source = &distribution.source;
            let known =
                source.contains("source paper") || has_year(source) || distribution.status == "assumed";
            assert!(known, "{name}:{entry} is not said to be assumed and names no publication");
        }
    }
}

#[test]
fn every_study_loads_in_all_its_variants() {
    let mut seen = 0;
    for entry in fs::read_dir(root("studies")).expect("studies can be listed").flatten() {
        let folder = entry.path();
        if folder.ends_with("hidden-effects") {
            // It asks about the study tilting-table, and has none of its own.
            continue;
        }
        if folder.ends_with("roughness") {
            // Its tables are those of tests/physics/roughness_tables.rs.
            continue;
        }
        if folder.ends_with("rocking") {
            // Its tables are those of tests/physics/rocking_tables.rs and rocking_closed_forms.rs.
            continue;
        }
        if folder.join("prepare.py").is_file() {
            // Its scan and motions are brought by that, see tests/published/shaken_rocks.rs.
            continue;
        }
        seen += 1;
        if ElementStudy::is_in(&folder) {
            let study = ElementStudy::load(&folder).unwrap_or_else(|faults| panic!("{faults}"));
            assert!(study.warnings.is_empty() && !study.published.is_empty(), "{:?}", study.warnings);
            continue;
        }
        let base =
            Study::load(&folder, None).unwrap_or_else(|faults| panic!("{}: {faults}", folder.display()));
        // One asks what averages out over the joints of a cell.
        let asks = folder.ends_with("homogenisation");
        let expected = |own: &pirca::study::Fault| asks && own.allowed.contains("averages out");
        assert!(base.warnings.iter().all(expected), "{:?}", base.warnings);
        let mut hashes = vec![base.study.hash.clone()];
        for variant in &base.variants {
            let read = Study::load(&folder, Some(&variant.name)).unwrap_or_else(|faults| panic!("{faults}"));
            assert!(!hashes.contains(&read.study.hash), "the variant {} changes nothing", variant.name);
            hashes.push(read.study.hash);
        }
    }
    assert!(seen >= 1);
}

/// The source paper's section 4.1 and Table 5, as the study must state them.
#[test]
fn the_joint_arrangement_study_states_the_papers_wall() {
    let loaded =
        Study::load(&root("studies/joint-arrangement"), None).unwrap_or_else(|faults| panic!("{faults}"));
    let study = loaded.study;
    assert_eq!(study.name, "joint-arrangement");
    let walls: Vec<(&str, u64)> = study.arms.iter().map(|a| (a.name.as_str(), a.members)).collect();
    assert_eq!(walls, [("continuous", 1), ("discontinuous", 1), ("irregular", 30)]);
    assert_eq!(walls.iter().map(|w| w.1).sum::<u64>() * 6, 192);
    for arm in &study.arms {
        let outline = arm.layout.outline;
        assert_eq!(
            [outline.length, outline.height, outline.base_thickness, outline.top_thickness],
            [4.0, 1.0, 0.45, 0.25]
        );
        assert_eq!(arm.layout.density.mean(), 2400.0);
        assert_eq!(arm.kn_points, [7.5e7, 8.5e7, 9.5e7, 10.5e7, 11.5e7, 12.5e7]);
        assert_eq!(arm.joint.kn_over_ks, 2.0);
        assert_eq!(arm.joint.phi_deg.mean(), 30.0);
        assert_eq!(arm.joint.cohesion.mean(), 1e5);
    }
    let Arrangement::Coursed { sizes, dip, .. } = &study.arms[2].layout.arrangement else {
        panic!("irregular walls are laid in courses")
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
    let [length, height] = sizes.means();
    assert!(near(length, 0.4) && near(height, 0.2));
    let twenty_deg = std::f64::consts::PI / 9.0;
    assert!(
        near(dip.support().0, -twenty_deg) && near(dip.support().1, twenty_deg),
        "dips are in radians inside"
    );
    assert!(study.published.iter().any(|c| matches!(c.test, ClaimTest::FallsWithKn)));
    assert_eq!(study.published.len(), 5);
    assert!(loaded.used.iter().any(|u| u.reference == "block/size:length" && u.status == "assumed"));
}
