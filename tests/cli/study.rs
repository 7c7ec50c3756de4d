//! What the loader makes of a sound study: defaults, variants, units, the hash.

use pirca::generate::{Arrangement, DipAbout};
use pirca::law::Sampling;
use pirca::protocol::Ends;
use pirca::solve::explicit::Settings;
use pirca::solve::{REVISION, Solver};
use pirca::study::{Study, key_reference};

use crate::scratch::{PUBLISHED, SIZE, STUDY, Scratch};

fn hash(scratch: &Scratch, variant: Option<&str>) -> String {
    scratch.load(variant).unwrap_or_else(|faults| panic!("{faults}")).study.hash
}

#[test]
fn a_variant_changes_what_it_names_and_nothing_else() {
    let scratch = Scratch::new("variant-effect");
    let base = scratch.load(None).expect("sound").study;
    let corners = scratch.load(Some("corners")).expect("sound").study;
    assert_eq!(
        (base.arms[0].joint.sampling, corners.arms[0].joint.sampling),
        (Sampling::Area, Sampling::Vertices)
    );
    let walls = |study: &Study| study.arms.iter().map(|arm| arm.layout.clone()).collect::<Vec<_>>();
    assert_eq!(walls(&base), walls(&corners), "the walls stay the same");
    let cut = scratch.load(Some("laid-cut")).expect("sound").study;
    let Arrangement::Cut { dip_about, .. } = &cut.arms[2].layout.arrangement else {
        panic!("the variant cuts")
    };
    assert_eq!(*dip_about, DipAbout::LongAxis);
    assert_eq!(cut.arms[2].layout.limits, base.arms[2].layout.limits);
}

/// What is asked for in the place of a name is what the file would state.
#[test]
fn a_variant_may_say_what_it_sets() {
    let (asked, edited) = (Scratch::new("asked-for"), Scratch::new("edited"));
    edited.replace(STUDY, "phi_deg = 30", "phi_deg = 32");
    assert_eq!(hash(&asked, Some("joint.phi_deg=32")), hash(&edited, None));
    assert_eq!(hash(&asked, Some("corners+joint.phi_deg = 32")), hash(&edited, Some("corners")));
    // A word needs no quotes.
    for corners in ["joint.sampling=vertices", "joint.sampling=\"vertices\""] {
        assert_eq!(hash(&asked, Some(corners)), hash(&asked, Some("corners")));
    }
    let named = asked.load(Some("joint.phi_deg = 32+corners")).expect("sound").study;
    assert_eq!(named.variant.as_deref(), Some("corners+joint.phi_deg=32"));
    let refused = |variant: &str, words: &[&str]| {
        let said = asked.load(Some(variant)).expect_err(variant).to_string();
        assert!(words.iter().all(|word| said.contains(word)), "{variant}: {said}");
    };
    refused("joint.phi_deg=95", &["joint.phi_deg = 95", "allowed is"]);
    refused("joint.phi=32", &["--variant:1", "joint.phi", "sets what does not exist", "phi_deg"]);
    refused("joint.phi_deg=", &["cannot be read as TOML"]);
}

/// The study is the same, and so is its hash.
#[test]
fn a_number_may_carry_its_unit() {
    let (plain, written) = (Scratch::new("plain-numbers"), Scratch::new("numbers-with-units"));
    for (from, to) in [
        ("phi_deg = 30", "phi_deg = \"30 deg\""),
        ("height_m = 1.0", "height_m = \"100 cm\""),
        ("length_m = 4.0", "length_m = \"4000mm\""),
    ] {
        written.replace(STUDY, from, to);
    }
    assert_eq!(hash(&plain, None), hash(&written, None));
    assert_eq!(hash(&plain, Some("joint.phi_deg=32")), hash(&written, Some("joint.phi_deg=32deg")));
}

/// Where two change the same key the later one holds, and a warning says which.
#[test]
fn of_two_variants_that_change_one_key_the_later_one_holds_and_it_is_said() {
    let scratch = Scratch::new("overlaid");
    let of = |variant: &str| scratch.load(Some(variant)).unwrap_or_else(|faults| panic!("{faults}"));
    for (variant, sampling, said) in [
        ("corners+joint.sampling=area", Sampling::Area, "is changed by corners and by joint.sampling=area"),
        (
            "joint.sampling=area+corners",
            Sampling::Vertices,
            "is changed by joint.sampling=area and by corners",
        ),
    ] {
        let loaded = of(variant);
        assert_eq!(loaded.study.arms[0].joint.sampling, sampling, "{variant}");
        assert_eq!(loaded.study.variant.as_deref(), Some(variant));
        let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
        assert!(
            warnings.iter().any(|own| own.starts_with(&format!("study.toml: joint.sampling {said}: "))),
            "{variant}: {warnings:?}"
        );
    }
    assert_eq!(
        hash(&scratch, Some("joint.phi_deg=32+joint.phi_deg=33")),
        hash(&scratch, Some("joint.phi_deg=33"))
    );
    assert!(of("corners+laid-cut").warnings.iter().all(|own| own.key != "joint.sampling"));
}

/// A path may be written in quotes, or as TOML's own dotted key or table: the same three keys are meant.
#[test]
fn a_path_may_be_quoted_or_nested() {
    let quoted = Scratch::new("quoted");
    let nested = Scratch::new("nested");
    nested.replace(STUDY, "\"joint.sampling\" = \"vertices\"", "joint = { sampling = \"vertices\" }");
    let dotted = Scratch::new("dotted");
    dotted.replace(STUDY, "\"joint.sampling\" = \"vertices\"", "joint.sampling = \"vertices\"");
    assert_eq!(hash(&quoted, Some("corners")), hash(&nested, Some("corners")));
    assert_eq!(hash(&quoted, Some("corners")), hash(&dotted, Some("corners")));
    let arms = Scratch::new("nested-arm");
    arms.replace(
        STUDY,
        "\"joint.sampling\" = \"vertices\"",
        "arm.stack = { members = 4 }\narm.laid.wall.wythes = 3",
    );
    let study = arms.load(Some("corners")).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!((study.arms[0].members, study.arms[2].layout.wythes.count), (4, 3));
}

#[test]
fn the_hash_follows_what_decides_results_and_nothing_else() {
    let scratch = Scratch::new("hash");
    let base = hash(&scratch, None);
    for (file, from, to) in [
        (STUDY, "seed = 7", "seed   =   0x7 # seven"),
        (STUDY, "height_m = 1.0", "height_m = 1"),
        (STUDY, "question = \"Does every key work?\"", "question = \"Does it?\""),
        (STUDY, "normal_law = \"linear\"\n", ""),
        (PUBLISHED, "stated = 0.6", "stated = 0.61"),
        (SIZE, "note = \"an example\"", "note = \"another\""),
        (SIZE, "values = [0.1, 0.2]", "values = [0.1, 0.3]"),
    ] {
        let same = Scratch::new("hash-same");
        same.replace(file, from, to);
        assert_eq!(hash(&same, None), base, "{to}");
    }
    for (file, from, to) in [
        (STUDY, "seed = 7", "seed = 8"),
        (STUDY, "steps = 4", "steps = 5"),
        (STUDY, "[5e7, 7.5e7]", "[5e7, 7.6e7]"),
        (STUDY, "name = \"hewn\"", "name = \"sawn\""),
        (SIZE, "sd = 0.1", "sd = 0.11"),
    ] {
        let other = Scratch::new("hash-other");
        other.replace(file, from, to);
        assert_ne!(hash(&other, None), base, "{to}");
    }
    assert_ne!(hash(&scratch, Some("corners")), base);
}

/// What a key left out means is what the parts' own defaults say.
#[test]
fn a_solver_that_is_not_described_is_the_default_one() {
    let scratch = Scratch::new("default-solver");
    let text = scratch.read(STUDY);
    let (before, rest) = text.split_once("[solver]").expect("the fixture has a solver");
    let (_, after) = rest.split_once("\n\n").expect("something follows it");
    scratch.write(STUDY, format!("{before}{after}").as_bytes());
    let study = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!(study.solver, Solver::Explicit(Settings::default()));
}

#[test]
fn a_solver_that_is_named_and_not_described_has_its_own_defaults() {
    let scratch = Scratch::new("implicit-defaults");
    let own = scratch.load(None).expect("sound").study;
    let implicit = own.clone().with_solver("implicit").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(implicit.solver, Solver::Implicit(pirca::solve::implicit::Settings::default()));
    assert_ne!(implicit.hash, own.hash);
    assert_eq!(implicit.effective["solver.name"], "implicit");
    assert!(!implicit.effective.contains_key("solver.damping"));
    // Written into the study it is the same study; asked for twice it stays the same.
    let text = scratch.read(STUDY);
    let (before, rest) = text.split_once("[solver]").expect("the fixture has a solver");
    let (_, after) = rest.split_once("\n\n").expect("something follows it");
    scratch.write(STUDY, format!("{before}[solver]\nname = \"implicit\"\n\n{after}").as_bytes());
    let written = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!(written.hash, implicit.hash);
    assert_eq!(written.clone().with_solver("implicit").unwrap().hash, written.hash);
    // The study's own settings come with its own solver, and no other name is known.
    assert_eq!(own.clone().with_solver("explicit").unwrap().solver, own.solver);
    assert!(
        own.with_solver("magic")
            .unwrap_err()
            .to_string()
            .contains("allowed is one of \"explicit\", \"implicit\", \"nonsmooth\", \"limit\"")
    );
}

#[test]
fn limit_analysis_is_a_solver_with_a_flow_and_refuses_what_rigid_blocks_do_not_have() {
    use pirca::solve::limit::{Flow, Settings};
    let scratch = Scratch::new("limit-solver");
    let own = scratch.load(None).expect("sound").study;
    let text = scratch.read(STUDY);
    let (before, rest) = text.split_once("[solver]").expect("the fixture has a solver");
    let (_, after) = rest.split_once("\n\n").expect("something follows it");
    let with = |solver: &str, more: &str| {
        let text = format!("{before}[solver]\nname = \"limit\"\n{solver}\n\n{after}\n{more}\n");
        scratch.write(STUDY, text.as_bytes());
        scratch.load(None).map(|loaded| loaded.study)
    };
    let limit = with("", "").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(limit.solver, Solver::Limit(Settings::default()));
    assert_eq!(limit.effective["solver.flow"], "associative");
    assert_eq!(own.with_solver("limit").unwrap().hash, limit.hash);
    let flows = with("flow = \"non-associative\"", "").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(flows.solver, Solver::Limit(Settings { flow: Flow::NonAssociative, ..Settings::default() }));
    let closing = "[mechanism.joint_closure]\ninitial_pa_per_m = 1e8\nclosure_m = 1e-4";
    for (solver, more, words) in [
        ("agreement = true", "", "compared with itself"),
        ("", closing, "rigid blocks have joints without closure"),
        ("damping = 0.5", "", "damping"),
    ] {
        let faults = with(solver, more).expect_err(words).to_string();
        assert!(faults.contains(words), "{faults}");
    }
}

#[test]
fn a_tilting_study_has_the_defaults_of_its_protocol() {
    use pirca::math::{radians, tan};
    use pirca::protocol::{Base, Protocol, Rate, Tilting, Turning};
    let scratch = Scratch::new("tilting");
    let text = scratch.read(STUDY);
    let (before, rest) = text.split_once("[load]").expect("the fixture has a load");
    let (_, after) = rest.split_once("\n\n").expect("something follows it");
    let with = |load: &str| {
        scratch.write(STUDY, format!("{before}[load]\nprotocol = \"tilting\"\n{load}\n{after}").as_bytes());
        scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study
    };
    let study = with("");
    assert_eq!(study.protocol, Protocol::Tilting(Tilting::default()));
    assert_eq!(study.arms[0].restraint.base, Base::default());
    let turning = with("[load.turning]\nrate_deg_per_s = 2\n");
    let expected = Turning { rate: radians(2.0), damping: 0.05, step_safety: 0.5 };
    assert_eq!(
        turning.protocol,
        Protocol::Tilting(Tilting { rate: Rate::Dynamic(expected), ..Tilting::default() })
    );
    assert_ne!(turning.hash, study.hash);
    let back = with("remainders = true\n");
    assert_eq!(back.protocol, Protocol::Tilting(Tilting { remainders: true, ..Tilting::default() }));
    assert_ne!(back.hash, study.hash);
    scratch.replace(
        STUDY,
        "base = \"fixed\"",
        "base = \"strip\"\nstrip_height_m = 0.02\nplatform_phi_deg = 20",
    );
    let strip = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!(
        strip.arms[0].restraint.base,
        Base { tan_phi: Some(tan(radians(20.0))), strip_height: Some(0.02), compliance: None }
    );
}

#[test]
fn a_study_of_shear_has_the_defaults_of_its_protocol_and_its_arms_their_own_load() {
    use pirca::protocol::{Head, History, Protocol, Shear};
    let scratch = Scratch::new("shear");
    let text = scratch.read(STUDY);
    let (before, rest) = text.split_once("[load]").expect("the fixture has a load");
    let (_, after) = rest.split_once("\n\n").expect("something follows it");
    let after = after.replacen("ends = \"joint_springs\"", "ends = \"free\"", 1);
    let with = |load: &str, after: &str| {
        let shear = "[load]\nprotocol = \"shear\"\nvertical_load_n = 1e5";
        scratch.write(STUDY, format!("{before}{shear}\n{load}\n\n{after}").as_bytes());
        scratch.load(None)
    };
    let study = with("force_height_m = 1.325", &after).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!(study.protocol, Protocol::Shear(Shear::default()));
    let cycles = "force_height_m = 1.2\nhead = \"level\"\ndrift_percent = 1\ncycles = 3\nstep_percent = 0.02";
    let own = after.replacen("name = \"stack\"", "name = \"stack\"\nvertical_load_n = 2e4", 1);
    let study = with(cycles, &own).unwrap_or_else(|faults| panic!("{faults}")).study;
    let expected = Shear {
        force_height: 1.2,
        head: Head::Level,
        history: History::Cycles { to: 0.01, count: 3 },
        step: 0.0002,
        ..Shear::default()
    };
    assert_eq!(study.protocol_of(&study.arms[1]), Protocol::Shear(expected));
    let light = Protocol::Shear(Shear { vertical_load: 2e4, ..expected });
    assert_eq!(study.protocol_of(&study.arms[0]), light);
    let refused = |load: &str, after: &str, said: &str| {
        let faults = with(load, after).expect_err(said).to_string();
        assert!(faults.contains(said), "{faults}");
    };
    refused("force_height_m = 1", &after, "more than the height of every wall");
    refused("force_height_m = 1.3\ntowards = \"x+\"", &after, "load.towards");
    let held = after.replacen("ends = \"free\"", "ends = \"fixed_end_blocks\"", 1);
    refused("force_height_m = 1.3", &held, "\"free\" where walls are sheared");
    // A load of its own means nothing to a wall that no beam presses.
    scratch.write(
        STUDY,
        text.replacen("name = \"stack\"", "name = \"stack\"\nvertical_load_n = 2e4", 1).as_bytes(),
    );
    let faults = scratch.load(None).expect_err("nothing is sheared").to_string();
    assert!(faults.contains("arm.stack.vertical_load_n"), "{faults}");
}

/// The side that goes down by its angle; that of an axis is the axis.
#[test]
fn a_platform_goes_down_at_any_angle() {
    use pirca::protocol::{Direction, Protocol};
    let scratch = Scratch::new("towards");
    let text = scratch.read(STUDY);
    let (before, rest) = text.split_once("[load]").expect("the fixture has a load");
    let (_, after) = rest.split_once("\n\n").expect("something follows it");
    let with = |load: &str| {
        scratch.write(STUDY, format!("{before}[load]\nprotocol = \"tilting\"\n{load}\n{after}").as_bytes());
        scratch.load(None)
    };
    let towards = |load: &str| {
        let study = with(load).unwrap_or_else(|faults| panic!("{faults}")).study;
        let Protocol::Tilting(tilting) = study.protocol else { panic!("it tilts") };
        (tilting.towards, study.effective)
    };
    let (aslant, effective) = towards("towards_deg = -60\n");
    assert_eq!(aslant, Direction::at(300.0));
    assert!(!effective.contains_key("load.towards"), "what is not used decides nothing");
    assert_eq!(effective["load.towards_deg"], "-60.0");
    assert_eq!(towards("towards_deg = 270\n").0, Direction::YMinus);
    assert_eq!(towards("towards = \"x-\"\n").0, Direction::XMinus);
    let refused =
        with("towards = \"x-\"\ntowards_deg = 180\n").expect_err("they are two answers").to_string();
    assert!(refused.contains("towards_deg = 180: allowed is one of towards and towards_deg"), "{refused}");
}

#[test]
fn another_seed_or_size_is_another_study() {
    let scratch = Scratch::new("overrides");
    let base = scratch.load(None).expect("sound").study;
    scratch.replace(STUDY, "seed = 7", "seed = 18446744073709551615");
    let seeded = scratch.load(None).expect("sound").study;
    assert_eq!(base.clone().with_seed(u64::MAX).hash, seeded.hash);
    let more = base.clone().with_members(12);
    assert_eq!(more.arms.iter().map(|a| a.members).collect::<Vec<_>>(), [1, 1, 12, 12]);
    assert_ne!(more.hash, base.hash);
    assert_eq!(more.with_members(3).hash, base.hash);
}

/// What another state of laws and solvers computed is another study's result, whichever solver is asked for.
#[test]
fn the_revision_of_laws_and_solvers_decides_a_result() {
    let scratch = Scratch::new("revision");
    let study = scratch.load(None).expect("sound").study;
    for study in [study.clone().with_solver("implicit"), study.with_solver("explicit")] {
        let effective = study.expect("both go").effective;
        assert_eq!(effective["revision of laws and solvers"], REVISION.to_string());
    }
}

/// Every key that decides a result is in the effective values: none is parsed and then forgotten.
#[test]
fn every_key_of_the_fixture_is_read() {
    let scratch = Scratch::new("every-key");
    let effective = scratch.load(None).expect("sound").study.effective;
    let mut section = String::new();
    let mut arm = String::new();
    let mut checked = 0;
    for line in scratch.read(STUDY).lines() {
        if line.starts_with('[') {
            section = line.trim_matches(['[', ']']).to_owned();
        } else if let Some((key, value)) = line.split_once(" = ") {
            if section == "arm" && key == "name" {
                arm = value.trim_matches('"').to_owned();
            }
            if section.starts_with("variant") || key == "question" {
                continue;
            }
            let path = format!("{section}.{key}").replacen(
                "arm.",
                &format!("arm.{arm}."),
                usize::from(section.starts_with("arm")),
            );
            assert!(effective.contains_key(&path), "{path} is not among {:?}", effective.keys());
            checked += 1;
        }
    }
    assert_eq!(checked, 73);
}

#[test]
fn the_reference_lists_every_key_of_the_fixture() {
    let reference = key_reference();
    let scratch = Scratch::new("reference");
    for file in [STUDY, PUBLISHED, SIZE] {
        for line in scratch.read(file).lines() {
            if let Some((key, _)) = line.split_once(" = ").filter(|(key, _)| !key.contains(['"', '#'])) {
                assert!(reference.contains(&format!("| `{key}` |")), "{key}");
            }
        }
    }
    assert!(reference.contains("a number within 0 to 1"));
}

/// An arm's own tables are laid over the study's key by key, and a choice made there takes the keys of the other choice away.
#[test]
fn an_arm_may_have_its_own_wall_stones_joints_and_restraint() {
    let scratch = Scratch::new("own-tables");
    scratch.replace(STUDY, "base = \"fixed\"\nends", "base = \"strip\"\nstrip_height_m = 0.02\nends");
    scratch.replace(
        STUDY,
        "block_length_m = 0.4\ncourse_height_m = 0.2\n\n",
        "block_length_m = 0.4\ncourse_height_m = 0.2\nwall = { length_m = 2.0 }\nblock.density_kg_per_m3 = 2500\n\
         joint = { kn_pa_per_m = [1e8], phi_deg = 35 }\nrestraint = { base = \"fixed\", ends = \"free\" }\n\n",
    );
    let study = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    let (own, shared) = (&study.arms[0], &study.arms[1]);
    assert_eq!((own.layout.outline.length, shared.layout.outline.length), (2.0, 4.0));
    assert_eq!((own.layout.outline.height, own.layout.density.mean()), (1.0, 2500.0));
    assert_eq!((own.kn_points.len(), shared.kn_points.len()), (1, 2));
    assert_eq!((own.joint.phi_deg.mean(), own.joint.cohesion.mean()), (35.0, 1e5));
    assert_eq!((own.restraint.ends, shared.restraint.ends), (Ends::Free, Ends::JointSprings));
    assert_eq!((own.restraint.base.strip_height, shared.restraint.base.strip_height), (None, Some(0.02)));
}

/// A fault of the shared table is said once, not once per arm that lays keys over it; one of the arm's own is said there.
#[test]
fn faults_of_an_arms_own_tables_are_named_where_they_stand() {
    let scratch = Scratch::new("own-tables-faulty");
    let own = "course_height_m = 0.2\njoint = { phi_deg = 95 }\n\n";
    scratch.replace(STUDY, "course_height_m = 0.2\n\n", own);
    scratch.replace(STUDY, "cohesion_pa = 1e5", "cohesion_pa = -1");
    let faults = scratch.load(None).expect_err("two values are out of range").to_string();
    assert_eq!(faults.matches("cohesion_pa = -1: allowed").count(), 1, "{faults}");
    assert!(
        faults.contains("joint.phi_deg = 95: allowed is a number or a distribution within 0 to 85"),
        "{faults}"
    );
}

#[test]
fn only_the_arms_asked_for_are_evaluated_and_decide_the_hash() {
    let scratch = Scratch::new("only-some-arms");
    scratch.replace(STUDY, "seed = 7", "seed = 7\narms = [\"laid\", \"stack\"]");
    let loaded = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    let names: Vec<&str> = loaded.arms.iter().map(|arm| arm.name.as_str()).collect();
    assert_eq!(names, ["laid", "stack"]);
    scratch.replace(STUDY, "overlap = 0.5", "overlap = 0.4");
    assert_eq!(hash(&scratch, None), loaded.hash, "an arm that is left out decides nothing");
    scratch.replace(STUDY, "\"laid\", \"stack\"", "\"laid\", \"stuck\"");
    let faults = scratch.load(None).expect_err("no arm has that name").to_string();
    assert!(faults.contains("did you mean \"stack\"?"), "{faults}");
}
