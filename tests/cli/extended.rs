//! A study extended by a mechanism: written, it is an ordinary study that means the same anywhere.

use std::fs;
use std::path::Path;

use pirca::study::{Acting, Arm, Loaded, Point, Study, described};

use crate::fixture::Folder;

/// Towers with room for what a test adds.
const TOWERS: &str = include_str!("../../studies/hidden-effects/example/study.toml");

fn root(below: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(below)
}

fn load(folder: &Path, variant: Option<&str>) -> Loaded {
    Study::load(folder, variant).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The study extended by points, as it is read from a folder far from the catalogue; the variants by their names.
fn read_back(loaded: &Loaded, own: &Point, others: &[Point]) -> (String, Vec<Study>) {
    let named =
        others.iter().enumerate().map(|(k, point)| (format!("draw-{k}"), "a draw".into(), point.clone()));
    let extended = loaded.study.extended(&loaded.stated, own, named.collect());
    let extended = extended.unwrap_or_else(|faults| panic!("{faults}"));
    let folder = Folder::with_study(&extended.to_toml());
    if let Some(published) = extended.published() {
        fs::write(folder.path("studies/tiny/published.toml"), published).unwrap();
    }
    let names = (0..others.len()).map(|k| format!("draw-{k}"));
    let variants = std::iter::once(None).chain(names.map(Some));
    let read = variants.map(|name| load(&folder.path("studies/tiny"), name.as_deref()).study);
    (extended.to_toml(), read.collect())
}

/// A point with each parameter at a quantile of its prior, and factors on the joints of some arms.
fn point(mechanism: &pirca::study::Described, quantile: f64, joints: Vec<(usize, [f64; 3])>) -> Point {
    let parameters = mechanism.parameters.iter().map(|p| (p.key, p.prior.quantile(quantile)));
    Point {
        acting: vec![Acting { mechanism: mechanism.name, parameters: parameters.collect(), arms: None }],
        joints,
    }
}

/// The arms that a point makes of a study's own.
fn expected(study: &Study, point: &Point) -> Vec<Arm> {
    let [Acting { mechanism, parameters, .. }] = &point.acting[..] else { panic!("one mechanism") };
    let on = study.with_mechanism(mechanism, parameters).unwrap_or_else(|faults| panic!("{faults}"));
    let mut arms = on.study.arms;
    for (arm, factors) in &point.joints {
        let kn = arms[*arm].kn_points[arms[*arm].middle_point()];
        arms[*arm] = arms[*arm].with_joints(kn, *factors);
    }
    // Where it has nothing to act on it stands and does nothing.
    for (arm, own) in arms.iter_mut().zip(&study.arms).filter(|(arm, _)| on.idle.contains_key(&arm.name)) {
        assert_eq!(arm.mechanisms, own.mechanisms);
    }
    arms
}

#[test]
fn written_and_read_again_the_arms_are_the_same_but_for_mechanism_and_joints() {
    let mechanisms = described(&root("distributions")).unwrap_or_else(|lacks| panic!("{lacks}"));
    for variant in [None, Some("two-wythes-headers"), Some("table-7")] {
        let base = load(&root("studies/tilting-table"), variant);
        let joints = |f: f64| vec![(0, [f, 1.0 / f, f]), (2, [1.0 / f, f, 1.0])];
        for mechanism in &mechanisms {
            // The base of these walls does not move.
            if ["worn_bearing", "heading", "motion_scale", "restitution"].contains(&mechanism.name) {
                continue;
            }
            if variant == Some("table-7") && ["size_scatter", "wedge_loss"].contains(&mechanism.name) {
                continue;
            }
            let points = [point(mechanism, 0.5, joints(1.1)), point(mechanism, 0.3, joints(0.9))];
            let (text, read) = read_back(&base, &points[0], &points[1..]);
            assert!(text.contains(&format!("\n[mechanism.{}]\n", mechanism.name)), "{text}");
            assert!(!text.contains("block/size:"), "{text}");
            for (study, point) in read.iter().zip(&points) {
                for ((arm, wanted), own) in
                    study.arms.iter().zip(&expected(&base.study, point)).zip(&base.study.arms)
                {
                    let same = Arm { mechanisms: arm.mechanisms.clone(), ..wanted.clone() };
                    assert_eq!(arm, &same, "{} {}", mechanism.name, arm.name);
                    assert!(
                        wanted.mechanisms == own.mechanisms || arm == wanted,
                        "{} {}",
                        mechanism.name,
                        arm.name
                    );
                }
                assert_eq!(study.arms.len(), base.study.arms.len());
                let rest = |study: &Study| {
                    (study.seed, study.question.clone(), study.protocol, study.published.clone())
                };
                assert_eq!(rest(study), rest(&base.study));
                assert_eq!(study.solver, base.study.solver);
            }
        }
    }
}

#[test]
fn a_study_that_is_changed_in_nothing_is_the_same_study() {
    for name in ["joint-arrangement", "tilting-block", "edge-restraint", "tilting-table"] {
        let base = load(&root("studies").join(name), None);
        let folder = Folder::with_study(&base.stated.to_toml());
        let again = load(&folder.path("studies/tiny"), None).study;
        assert_eq!(again.arms, base.study.arms, "{name}");
        // What was a reference has its parameters in there beside what they amount to.
        let lost = base.study.effective.iter().find(|(key, value)| again.effective.get(*key) != Some(value));
        assert_eq!(lost, None, "{name}");
        let text = base.stated.published().unwrap_or_default();
        assert_eq!(
            text,
            fs::read_to_string(root("studies").join(name).join("published.toml")).unwrap_or_default()
        );
    }
    // The largest seed, a question of several lines and quotes, a list of values.
    let text = TOWERS
        .replace("seed = 7", "seed = 18446744073709551615")
        .replace("question = \"What", "question = \"\"\"\n\"What\"\nand \\u0001")
        .replace("towers of stones?\"", "towers of stones?\"\"\"")
        .replace("\"uniform\", low = 0.08, high = 0.12", "\"empirical\", values = [0.1, 0.09, 0.11]");
    let folder = Folder::with_study(&text);
    let base = load(&folder.path("studies/tiny"), None);
    folder.write_study(&base.stated.to_toml());
    let again = load(&folder.path("studies/tiny"), None).study;
    assert_eq!(
        (again.seed, &again.question, &again.hash),
        (u64::MAX, &base.study.question, &base.study.hash)
    );
}

fn at(mechanism: &'static str, parameters: &[(&'static str, f64)]) -> Point {
    Point {
        acting: vec![Acting { mechanism, parameters: parameters.to_vec(), arms: None }],
        joints: Vec::new(),
    }
}

#[test]
fn an_arm_that_has_the_mechanism_keeps_its_own_and_gauges_read_one_another() {
    let (before, arm) = TOWERS.split_once("[[arm]]").unwrap();
    let second = arm.replace("name = \"tower\"", "name = \"other\"");
    let own = |tables: &str| {
        let folder = Folder::with_study(&format!("{before}[[arm]]{arm}\n[[arm]]{second}\n{tables}"));
        load(&folder.path("studies/tiny"), None)
    };
    let leaning = own("[arm.mechanism.lean]\nangle_deg = 3");
    assert_eq!(leaning.study.arms_with("lean"), ["other"]);
    let (_, read) =
        read_back(&leaning, &at("lean", &[("angle_deg", 1.0)]), &[at("lean", &[("angle_deg", 2.0)])]);
    for (study, found) in read.iter().zip([1.0, 2.0]) {
        let lean = |arm: usize| study.arms[arm].mechanisms.value("lean", "angle_deg").unwrap();
        assert!((lean(0) - found).abs() < 1e-9 && (lean(1) - 3.0).abs() < 1e-9);
    }
    // A gauge of 2 x + 1 mm, read by one that adds 3 mm, and by one that trebles.
    let gauged = own("[arm.mechanism]\ngauge_offset = { offset_m = 0.001 }\ngauge_scale = { factor = 2 }");
    let gauges = |found: Point| {
        let (_, read) = read_back(&gauged, &found, &[]);
        read[0].arms.iter().map(gauges_of).collect::<Vec<_>>()
    };
    assert_eq!(
        gauges(at("gauge_offset", &[("offset_m", 0.003)])),
        [(None, Some(0.003)), (Some(2.0), Some(0.004))]
    );
    assert_eq!(gauges(at("gauge_scale", &[("factor", 3.0)])), [(Some(3.0), None), (Some(6.0), Some(0.003))]);
}

fn gauges_of(arm: &Arm) -> (Option<f64>, Option<f64>) {
    let of = |name, key| arm.mechanisms.value(name, key);
    (of("gauge_scale", "factor"), of("gauge_offset", "offset_m"))
}

#[test]
fn a_mechanism_of_some_arms_stands_in_these_each_with_its_parameters() {
    let base = load(&root("studies/tilting-table"), None);
    let of = |factor: f64, arms: &[usize]| Acting {
        mechanism: "friction",
        parameters: vec![("factor", factor)],
        arms: Some(arms.to_vec()),
    };
    let factors = |acting: Vec<Acting>| {
        let (_, read) = read_back(&base, &Point { acting, joints: Vec::new() }, &[]);
        let friction = |arm: &Arm| arm.mechanisms.value("friction", "factor");
        read[0].arms.iter().map(friction).collect::<Vec<_>>()
    };
    assert_eq!(factors(vec![of(0.8, &[1, 2])]), [None, Some(0.8), Some(0.8)]);
    assert_eq!(factors(vec![of(1.2, &[0]), of(0.8, &[1, 2])]), [Some(1.2), Some(0.8), Some(0.8)]);
}

#[test]
fn two_mechanisms_stand_beside_each_other_and_two_gauges_are_read_as_one() {
    let both =
        |one: Point, other: Point| Point { acting: [one.acting, other.acting].concat(), joints: Vec::new() };
    let (before, arm) = TOWERS.split_once("[[arm]]").unwrap();
    let second = arm.replace("name = \"tower\"", "name = \"other\"");
    let gauge = "[arm.mechanism]\ngauge_offset = { offset_m = 0.001 }\ngauge_scale = { factor = 2 }";
    let folder = Folder::with_study(&format!("{before}[[arm]]{arm}\n[[arm]]{second}\n{gauge}"));
    let base = load(&folder.path("studies/tiny"), None);
    let pair = both(at("lean", &[("angle_deg", 1.0)]), at("density", &[("factor", 1.2)]));
    let (_, read) = read_back(&base, &pair, &[]);
    let lean = |arm: &Arm| arm.mechanisms.value("lean", "angle_deg").unwrap();
    for arm in &read[0].arms {
        assert!((lean(arm) - 1.0).abs() < 1e-9);
        assert_eq!(arm.mechanisms.value("density", "factor"), Some(1.2));
    }
    // Three times what a gauge of 2 x + 1 mm shows, and 3 mm more.
    let gauges = both(at("gauge_offset", &[("offset_m", 0.003)]), at("gauge_scale", &[("factor", 3.0)]));
    let (_, read) = read_back(&base, &gauges, &[]);
    assert_eq!(
        read[0].arms.iter().map(gauges_of).collect::<Vec<_>>(),
        [(Some(3.0), Some(0.003)), (Some(6.0), Some(0.006))]
    );
}

#[test]
fn a_mechanism_that_an_arm_refuses_stands_in_the_others_and_limit_analysis_goes_where_it_must() {
    let (before, arm) = TOWERS.split_once("[[arm]]").unwrap();
    let corners = arm.replace("name = \"tower\"", "name = \"corners\"\njoint.sampling = \"vertices\"");
    let text = format!("{before}[[arm]]{arm}\n[[arm]]{corners}")
        .replace("name = \"implicit\"", "name = \"implicit\"\nagreement = true");
    let folder = Folder::with_study(&text);
    let base = load(&folder.path("studies/tiny"), None);
    let (text, read) =
        read_back(&base, &at("contact_area", &[("share", 0.5)]), &[at("contact_area", &[("share", 0.25)])]);
    assert!(text.contains("[arm.mechanism.contact_area]"), "{text}");
    for (study, share) in read.iter().zip([0.5, 0.25]) {
        let shares: Vec<Option<f64>> =
            study.arms.iter().map(|arm| arm.mechanisms.value("contact_area", "share")).collect();
        assert_eq!((&shares[..], study.agreement), (&[Some(share), None][..], true));
    }
    let creep = at("creep", &[("rate_per_deg", 0.01)]);
    assert!(!read_back(&base, &creep, &[]).1[0].agreement);
    // A value that its key does not allow is a fault, not a study.
    let faults =
        base.study.extended(&base.stated, &at("density", &[("factor", -1.0)]), Vec::new()).unwrap_err();
    assert!(faults.to_string().contains("density.factor"), "{faults}");
}
