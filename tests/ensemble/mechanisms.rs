//! Mechanisms in an ensemble: gauges change readings alone, and what is switched on changes no other draw.

use std::fs;

use pirca::ensemble::{Row, Task, build, evaluate};
use pirca::study::Study;

use crate::fixture::{Folder, STUDY};

/// The small study on a tilting table with wedges, to 6 deg, by the implicit solver, and with tables of mechanisms.
fn study(mechanisms: &str) -> (Folder, Study) {
    let text = STUDY
        .replace(
            "protocol = \"lateral\"\nmean_pressure_pa = 200\nbase_over_top = 2",
            "protocol = \"tilting\"\nstep_deg = 2\nend_deg = 6",
        )
        .replace(
            "[solver]\nunbalanced_ratio = 1e-4",
            &format!("[solver]\nname = \"implicit\"\n\n{mechanisms}"),
        )
        + "\n";
    let text = text.replace(
        "dip_deg = { family = \"uniform\", low = -3, high = 3 }",
        "dip_deg = { family = \"uniform\", low = -3, high = 3 }\nwedges = { share = 0.5, height_m = 0.02, depth_m = 0.05 }",
    );
    let folder = Folder::with_study(&text);
    let loaded = Study::load(&folder.path("studies/tiny"), None).unwrap_or_else(|faults| panic!("{faults}"));
    (folder, loaded.study)
}

fn row(study: &Study, arm: u32) -> Row {
    evaluate(study, Task { arm, point: 0, member: 1 })
}

#[test]
fn a_gauge_changes_what_is_read_after_the_zero_reading_and_nothing_else() {
    let (_folder, plain) = study("");
    let (_other, gauged) =
        study("[mechanism.gauge_offset]\noffset_m = 0.002\n[mechanism.gauge_scale]\nfactor = 1.5\n");
    let (plain, gauged) = (row(&plain, 1), row(&gauged, 1));
    assert_eq!(plain.load_steps.len(), 4);
    for (step, (a, b)) in plain.load_steps.iter().zip(&gauged.load_steps).enumerate() {
        let [a, b] = [a.top, b.top];
        for (x, y) in
            a.points().into_iter().zip(b.points()).chain([(a.top_displacement_m, b.top_displacement_m)])
        {
            let x = x.expect("it is read");
            assert_eq!(y, Some(if step == 0 { x } else { 1.5 * x + 0.002 }), "step {step}");
        }
    }
    let mut unread = gauged.clone();
    unread.load_steps = plain.load_steps.clone();
    unread.reading.top_displacement_m = plain.top_displacement_m();
    assert_eq!(unread, plain);
    let x = plain.top_displacement_m().expect("it stands");
    assert_eq!(gauged.top_displacement_m(), Some(1.5 * x + 0.002));
}

#[test]
fn a_mechanism_of_one_arm_leaves_the_other_arm_alone() {
    let (folder, plain) = study("");
    let text = fs::read_to_string(folder.path("studies/tiny/study.toml")).expect("it is there");
    let own = "name = \"random\"\nmechanism = { creep = { rate_per_deg = 0.05 }, contact_area = { share = 0.5 } }\n";
    folder.write_study(&text.replace("name = \"random\"\n", own));
    let changed =
        Study::load(&folder.path("studies/tiny"), None).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!(row(&plain, 0), row(&changed, 0));
    assert_ne!(row(&plain, 1), row(&changed, 1));
    // Its stones are the same.
    let wall = |study: &Study| build(study, 1, 1).expect("a wall comes out").wall;
    assert_eq!(wall(&plain), wall(&changed));
}

#[test]
fn a_wall_changes_by_what_is_asked_for_with_the_same_draws() {
    let (_a, plain) = study("");
    let (_b, leaning) = study("[mechanism.lean]\nangle_deg = 3\n[mechanism.density]\nfactor = 1.25\n");
    let wall = |study: &Study| build(study, 1, 1).expect("a wall comes out").wall;
    let slope = pirca::math::tan(pirca::math::radians(3.0));
    for (a, b) in wall(&plain).blocks.iter().zip(&wall(&leaning).blocks) {
        for (p, q) in a.shape.vertices.iter().zip(&b.shape.vertices) {
            assert_eq!((q.x, q.y, q.z), (p.x, p.y + slope * p.z, p.z));
        }
        assert!((b.density / a.density - 1.25).abs() < 1e-12);
    }
    // Wider sizes about the same mean, from the same uniforms: what was long is longer, what was short is shorter.
    let (_c, wide) = study("[mechanism.size_scatter]\nfactor = 1.5\n");
    let lengths = |study: &Study| build(study, 1, 1).expect("a wall comes out").realised.lengths;
    let (narrow, wide) = (lengths(&plain), lengths(&wide));
    let spread = |lengths: &[f64]| pirca::stats::sigma(lengths).expect("there are some");
    println!("{} {}", spread(&narrow), spread(&wide));
    assert!(spread(&wide) > 1.1 * spread(&narrow), "{narrow:?} {wide:?}");
}

#[test]
fn a_gauge_reads_what_is_left_as_well_and_the_way_up_does_not_know_of_it() {
    let back = |mechanisms: &str| {
        let (folder, study) = study(mechanisms);
        let study = study.with_remainders();
        (folder, study)
    };
    let (_folder, plain) = study("");
    let (_other, with) = back("");
    let (_third, gauged) = back("[mechanism.gauge_offset]\noffset_m = 0.002\n");
    assert!(with.goes_back() && !plain.goes_back() && with.hash != plain.hash);
    let [plain, with, gauged] = [plain, with, gauged].map(|study| row(&study, 1));
    for (step, ((a, b), c)) in
        plain.load_steps.iter().zip(&with.load_steps).zip(&gauged.load_steps).enumerate()
    {
        assert_eq!(a.top.points(), b.top.points());
        assert_eq!(a.top.remainders(), [None; 3]);
        for (b, c) in b.top.remainders().into_iter().zip(c.top.remainders()) {
            assert_eq!(b.is_some(), step > 0);
            assert_eq!(c, b.map(|left| left + 0.002));
        }
    }
}

/// A wall that leans and is turned round leans the other way: it falls where one does that was built so.
#[test]
fn a_wall_that_is_turned_round_leans_the_other_way() {
    let load = |lean: &str, turned: &str| {
        let text = STUDY
            .replace(
                "protocol = \"lateral\"\nmean_pressure_pa = 200\nbase_over_top = 2",
                "protocol = \"tilting\"\nstep_deg = 2\nbracket_deg = 0.02",
            )
            .replace("battered_face = \"both\"", &format!("battered_face = \"both\"\n{turned}"))
            .replace("ends = \"joint_springs\"", "ends = \"free\"")
            .replace(
                "[solver]\nunbalanced_ratio = 1e-4",
                &format!("[solver]\nname = \"implicit\"\n\n[mechanism.lean]\nangle_deg = {lean}\n"),
            )
            + "\n";
        let folder = Folder::with_study(&text);
        Study::load(&folder.path("studies/tiny"), None).unwrap_or_else(|faults| panic!("{faults}")).study
    };
    let angle =
        |lean: &str, turned: &str| row(&load(lean, turned), 0).collapse_angle_deg().expect("it falls");
    let turned = "turned = true";
    let [downhill, uphill, round] = [angle("1", ""), angle("-1", ""), angle("1", turned)];
    println!("{downhill} {uphill} {round}");
    assert!(uphill - downhill > 1.3 && (round - uphill).abs() < 0.03, "{downhill} {uphill} {round}");
    // By half a turn about the middle of its length and its base, stone by stone.
    let [built, turned] =
        ["", turned].map(|turned| build(&load("1", turned), 1, 1).expect("it can be built").wall);
    let length = load("1", "").arms[1].layout.outline.length;
    for (a, b) in built.blocks.iter().zip(&turned.blocks) {
        for (a, b) in a.shape.vertices.iter().zip(&b.shape.vertices) {
            assert_eq!([b.x, b.y, b.z], [length - a.x, -a.y, a.z]);
        }
        assert!((a.shape.volume() - b.shape.volume()).abs() < 1e-15);
    }
}
