//! What scatters from joint to joint averages out over the joints of a wall: the warning, its arithmetic, and when there is none.

use pirca::study::Fault;

use crate::scratch::{STUDY, Scratch};

fn warnings(scratch: &Scratch) -> Vec<Fault> {
    scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).warnings
}

#[test]
fn a_property_that_averages_out_is_warned_of_with_the_arithmetic() {
    let scratch = Scratch::new("averaged");
    let line =
        scratch.replace(STUDY, "phi_deg = 30", "phi_deg = { family = \"uniform\", low = 28, high = 36 }");
    let all = warnings(&scratch);
    let keys: Vec<&str> = all.iter().map(|own| own.key.as_str()).collect();
    assert_eq!(keys, ["joint.kn_factor", "joint.phi_deg"]);
    let phi = &all[1];
    assert_eq!((phi.file.as_str(), phi.line), ("study.toml", line));
    // Five courses of ten stones in two wythes: 90 bed joints and 45 head joints in each, and 50 joints between them.
    let said = "a wall of arm laid has about 320 joints, and a standard deviation of 2.3 deg in each is one of 2.3 / sqrt(320) = 0.13 deg";
    assert!(phi.allowed.contains(said), "{phi}");
    assert!(phi.fix.contains("\"joint.phi_deg\" in [uncertain]"), "{phi}");
    assert!(all[0].fix.contains("\"joint.kn_pa_per_m\" in [uncertain]"), "{}", all[0]);
    // Said once of the table that arms share, and of an arm that has its own.
    scratch.replace(
        STUDY,
        "[[variant]]",
        "[arm.joint]\nphi_deg = { family = \"triangular\", low = 20, mode = 30, high = 40 }\n\n[[variant]]",
    );
    let keys: Vec<String> = warnings(&scratch).into_iter().map(|own| own.key).collect();
    assert_eq!(keys, ["joint.kn_factor", "joint.phi_deg", "arm.hewn.joint.phi_deg"]);
}

#[test]
fn nothing_is_said_where_the_same_is_drawn_per_wall_or_joints_are_few() {
    let sound = |edit: &dyn Fn(&Scratch)| {
        let scratch = Scratch::new("not-averaged");
        edit(&scratch);
        warnings(&scratch).into_iter().map(|own| own.key).collect::<Vec<_>>()
    };
    let phi = "phi_deg = { family = \"uniform\", low = 28, high = 36 }";
    let per_wall = "[mechanism.friction]\nfactor = 1\n[uncertain]\n\"mechanism.friction.factor\" = { family = \"uniform\", low = 0.8, high = 1.2 }\n\n[load]";
    let both = sound(&|scratch| {
        scratch.replace(STUDY, "phi_deg = 30", phi);
        scratch.replace(STUDY, "[load]", per_wall);
    });
    assert_eq!(both, ["joint.kn_factor"]);
    let scattered = sound(&|scratch| {
        scratch.replace(
            STUDY,
            "[load]",
            "[mechanism.specimen_scatter]\nkn_cov = 0.2\nfriction_cov = 0\n\n[load]",
        );
    });
    assert!(scattered.is_empty(), "{scattered:?}");
    let constant = sound(&|scratch| {
        scratch.replace(STUDY, "kn_factor = { family = \"lognormal\", mean = 1.0, sd = 0.1 }\n", "");
    });
    assert!(constant.is_empty(), "{constant:?}");
    // Two courses of two stones.
    let few = sound(&|scratch| {
        let text = scratch.read(STUDY).replace("block_length_m = 0.41", "block_length_m = 2");
        let text = text.replace("course_height_m = 0.21", "course_height_m = 0.5");
        let (shared, arms) = text.split_once("[[arm]]").expect("arms");
        let running = arms.split("[[arm]]").find(|arm| arm.contains("\"running\"")).expect("that arm");
        scratch.write(STUDY, format!("{shared}[[arm]]{running}").as_bytes());
        scratch.write(
            crate::scratch::PUBLISHED,
            b"[[claim]]\nclaim = \"c\"\nsource = \"s\"\ntest = \"falls_with_kn\"\nwhy = \"w\"\n",
        );
    });
    assert!(few.is_empty(), "{few:?}");
}
