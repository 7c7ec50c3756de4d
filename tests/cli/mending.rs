//! Walls that were measured, in one call: what is said of joints that are no planes, what mending says, and what several solvers say.

use std::fs;

use pirca::exchange::write_obj;
use pirca::math::Vec3;
use pirca::model::{Block, Support, Tag, Wall};
use pirca::shape::Polyhedron;
use serde_json::Value;

use crate::fixture::stderr;
use crate::walls::Folder;

/// A ground and a column of three stones, 0.3 m deep and 0.2 m high each, whose beds are off by these lengths (m) at their front and back.
fn column(off: [f64; 2]) -> String {
    let stone = |from: [f64; 3], to: [f64; 3]| {
        Block::stone(Polyhedron::cuboid(Vec3::from(from), Vec3::from(to)), 2400.0)
    };
    let ground = stone([-0.2, -0.2, -0.1], [0.7, 0.6, 0.0]);
    let mut blocks = vec![Block { support: Support::Fixed, tag: Tag::Base, ..ground }];
    blocks.extend((0..3).map(|nth| {
        let low = 0.2 * f64::from(nth);
        let mut block = stone([0.0, 0.0, low], [0.5, 0.3, low + 0.2]);
        for corner in block.shape.vertices.iter_mut().filter(|corner| corner.z > low + 0.1) {
            corner.z += if corner.y < 0.1 { off[0] } else { off[1] };
        }
        block
    }));
    write_obj(&Wall { blocks })
}

/// A folder with such a column.
fn with_column(off: [f64; 2]) -> Folder {
    let folder = Folder::new();
    fs::write(folder.path("wall.obj"), column(off)).expect("written");
    folder
}

/// The answer of `analyse` to such a column, and what it says on the side.
fn analysed(off: [f64; 2], more: &[&str]) -> (Value, String) {
    let folder = with_column(off);
    let asked = [&["analyse", "wall.obj", "--phi-deg", "35", "--load", "lateral", "--json"], more].concat();
    let output = folder.pirca(&asked);
    assert!(output.status.success(), "{}", stderr(&output));
    (serde_json::from_slice(&output.stdout).expect("one JSON object"), stderr(&output))
}

fn multiplier(answer: &Value) -> f64 {
    answer["collapse_multiplier"].as_f64().expect("it falls")
}

#[test]
fn joints_that_are_no_planes_are_told_by_every_solver() {
    for solver in
        [&["--solver", "limit"][..], &["--solver", "nonsmooth"], &["--solver", "implicit", "--kn", "1e9"]]
    {
        let (answer, _) = analysed([-1e-3, 1e-3], &[&["--touch-tolerance", "3mm"], solver].concat());
        let warnings = answer["warnings"].to_string();
        assert!(
            warnings.contains("in 2 of 3 joints the faces are not one plane, by up to 2 mm"),
            "{warnings}"
        );
        assert!(warnings.contains("--mend 2.200mm"), "{warnings}");
    }
    let (sound, _) = analysed([0.0, 0.0], &[]);
    assert_eq!(sound["warnings"].as_array().map(Vec::len), Some(1), "{}", sound["warnings"]);
}

#[test]
fn a_mended_wall_bears_what_the_sound_one_does_and_says_what_was_done() {
    let (sound, _) = analysed([0.0, 0.0], &[]);
    let (mended, said) = analysed([-1e-3, 1e-3], &["--mend", "3mm"]);
    // The top leans by 2 mm in 0.3 m, half of it in each joint: the column topples over its lowest edge, 0.6 m below its top.
    assert!((multiplier(&mended) / multiplier(&sound) - 1.0).abs() < 0.01);
    let done = &mended["mended"];
    assert_eq!((done["within_m"].as_f64(), done["faces"].as_u64()), (Some(3e-3), Some(18)));
    assert_eq!(done["faces_moved"].as_u64(), Some(4), "{done}");
    assert!((done["moved_m"].as_f64().expect("a length") - 0.5e-3).abs() < 1e-6, "{done}");
    assert_eq!(done["stones"].as_array().map(Vec::len), Some(3));
    assert!(
        mended["warnings"].to_string().contains("mended within 3 mm: 4 of 18 faces moved by at most 0.5 mm"),
        "{said}"
    );
    let (untouched, _) = analysed([0.0, 0.0], &["--mend", "3mm"]);
    assert_eq!(multiplier(&untouched).to_bits(), multiplier(&sound).to_bits());
    assert!(untouched["warnings"].to_string().contains("nothing to mend within 3 mm"));
}

/// The wall that needs nothing has no drawing of what was moved.
#[test]
fn what_was_moved_is_drawn() {
    for (off, is_drawn) in [([-1e-3, 1e-3], true), ([0.0, 0.0], false)] {
        let folder = with_column(off);
        let asked = ["analyse", "wall.obj", "--phi-deg", "35", "--mend", "3mm", "--out", "seen"];
        let output = folder.pirca(&asked);
        assert!(output.status.success(), "{}", stderr(&output));
        let page = fs::read_to_string(folder.path("seen/report.html")).expect("a page");
        assert_eq!(page.contains("figure-mended"), is_drawn);
        let drawn = fs::read_to_string(folder.path("seen/mended.svg"));
        assert_eq!(
            drawn.is_ok_and(|svg| svg.contains("mm: largest distance that a corner was moved")),
            is_drawn
        );
    }
}

#[test]
fn a_length_of_mending_that_would_change_stones_is_refused() {
    let folder = with_column([0.0, 0.0]);
    let output = folder.pirca(&["analyse", "wall.obj", "--phi-deg", "35", "--mend", "5cm"]);
    assert_eq!(output.status.code(), Some(3));
    let said = stderr(&output);
    assert!(said.contains("--mend is 50 mm") && said.contains("a tenth of a stone"), "{said}");
}

#[test]
fn several_solvers_answer_in_one_call_and_are_set_beside_each_other() {
    let (answer, _) = analysed([0.0, 0.0], &["--solver", "limit,nonsmooth,implicit", "--kn", "1e8"]);
    let all = answer["opinions"]["solvers"].as_array().expect("opinions");
    let said: Vec<&str> = all.iter().filter_map(|own| own["solver"].as_str()).collect();
    assert_eq!(said, ["limit", "nonsmooth", "implicit"]);
    assert_eq!(
        (answer["solver"].as_str(), &answer["opinions"]["agree"]),
        (Some("limit"), &Value::Bool(true))
    );
    let finding = answer["opinions"]["finding"].as_str().expect("a sentence");
    assert!(
        finding.starts_with("rigid blocks fall at the same load by limit analysis and by contact dynamics"),
        "{finding}"
    );
    // A column of 0.3 m by 0.6 m on joints of 1e8 Pa/m sinks into its toe: it leans before it falls.
    assert!(finding.contains("elastic joints"), "{finding}");
    assert!((multiplier(&all[0]) - 0.5).abs() < 1e-3 && multiplier(&all[2]) < multiplier(&all[0]));
}

#[test]
fn an_elastic_solver_among_several_needs_a_stiffness() {
    let folder = with_column([0.0, 0.0]);
    let output = folder.pirca(&["analyse", "wall.obj", "--phi-deg", "35", "--solver", "limit,implicit"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("--kn PA_PER_M is required for the implicit solver"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_study_of_a_mended_wall_has_the_answer_of_the_wall() {
    let folder = with_column([-1e-3, 1e-3]);
    let told = |asked: &[&str]| -> Value {
        let output = folder.pirca(asked);
        assert!(output.status.success(), "{asked:?}: {}", stderr(&output));
        serde_json::from_slice(&output.stdout).expect("one JSON object")
    };
    let alone =
        told(&["analyse", "wall.obj", "--phi-deg", "35", "--mend", "3mm", "--study", "mine", "--json"]);
    let study = fs::read_to_string(folder.path("mine/study.toml")).expect("a study");
    assert!(study.contains("mend_m = 0.003"), "{study}");
    let run = told(&["run", "mine", "--out", "out", "--json"]);
    let mean = run["arms"][0]["mean"].as_f64().expect("a mean");
    assert!((mean - alone["collapse_angle_deg"].as_f64().expect("it falls")).abs() < 1e-9, "{mean}");
    let said = folder.pirca(&["check", "mine"]);
    assert!(stderr(&said).contains("mended within 3 mm: 4 of 18 faces moved"), "{}", stderr(&said));
}
