//! `studies/shaken-rocks`: a boulder on a shaking table. Its scan and its motions belong to others; here a box and a pulse stand for them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use pirca::study::{MeasuredKind, MeasuredQuantity, Study};

/// The boulder's size (m).
const SIDES: [f64; 3] = [0.67, 0.77, 0.79];

/// A box of that size, as an OBJ file has it.
fn boxed() -> String {
    let [a, b, c] = SIDES;
    let mut text = "o rock\n".to_owned();
    for (x, y, z) in
        [(0., 0., 0.), (a, 0., 0.), (a, b, 0.), (0., b, 0.), (0., 0., c), (a, 0., c), (a, b, c), (0., b, c)]
    {
        text.push_str(&format!("v {x} {y} {z}\n"));
    }
    text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
}

#[test]
fn the_study_loads_with_files_in_the_place_of_the_scan_and_the_motions_and_states_every_fourth_outcome() {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/shaken-rocks");
    let folder = std::env::temp_dir().join(format!("pirca-shaken-rocks-{}", std::process::id()));
    fs::create_dir_all(folder.join("motions")).expect("a folder");
    for name in ["study.toml", "measured.csv"] {
        fs::copy(own.join(name), folder.join(name)).expect("copied");
    }
    fs::write(folder.join("rock.obj"), boxed()).expect("written");
    let table = fs::read_to_string(own.join("outcomes.csv")).expect("there");
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(rows.len(), 131);
    for row in &rows {
        let name = format!("motions/test{:0>3}.csv", row[0]);
        fs::write(folder.join(name), "t_s,ay_g\n0,0\n0.01,0.1\n0.02,0\n").expect("written");
    }
    let study = Study::load(&folder, None).unwrap_or_else(|faults| panic!("{faults}")).study;
    fs::remove_dir_all(&folder).expect("removed");
    assert_eq!((study.measured.len(), study.arms.len()), (66, 2));
    let mut stages: BTreeMap<u32, usize> = BTreeMap::new();
    for m in &study.measured {
        let under = m.under.as_ref().expect("it was shaken");
        let row = &rows[m.stage as usize];
        assert_eq!(
            (m.quantity, &under.record),
            (MeasuredQuantity::Outcome, &format!("motions/test{:0>3}.csv", row[0]))
        );
        let fell = row[if m.family == "stand-1" { 4 } else { 5 }] == "1";
        assert_eq!(m.kind == MeasuredKind::Below, fell, "{} {}", m.specimen, under.record);
        *stages.entry(m.stage).or_default() += 1;
    }
    assert!(stages.iter().all(|(stage, count)| stage % 4 == 1 && *count == 2), "{stages:?}");
    // One bank serves both stands.
    let sought = study.seeking_what_was_measured().earthquakes.expect("the base moves").sought.len();
    assert_eq!(sought, 33);
}
