//! Every verb on small studies and walls: all protocols, all solvers, a merge of shards.

use crate::fixture::STUDY;
use crate::loads::{BASE_MOTION, LATERAL, SHEAR, TILTING, loaded};

/// A study and commands on it, one after the other.
pub struct Case {
    pub name: &'static str,
    /// The text of `studies/tiny/study.toml`.
    pub study: fn() -> String,
    /// Files of `tests/cli/fixtures`, and where they are put.
    pub files: &'static [(&'static str, &'static str)],
    pub commands: &'static [&'static str],
}

const TOWER: &[(&str, &str)] = &[("walls/leaning-tower.json", "tower.json")];

fn lateral() -> String {
    STUDY.to_owned()
}

fn tilting() -> String {
    loaded(TILTING, "name = \"limit\"")
}

fn tilting_elastic() -> String {
    loaded(TILTING, "name = \"implicit\"")
}

fn tilting_in_time() -> String {
    loaded(TILTING, "name = \"nonsmooth\"")
}

fn tilting_explicit() -> String {
    loaded(TILTING, "name = \"explicit\"").replace("[5e7, 1.75e8]", "[5e7]")
}

fn without_dilatancy() -> String {
    loaded(&LATERAL.replace("200", "5000"), "name = \"limit\"\nflow = \"non-associative\"")
}

fn sheared() -> String {
    loaded(SHEAR, "name = \"implicit\"")
}

fn shaken() -> String {
    loaded(BASE_MOTION, "name = \"explicit\"")
}

/// One of the element types: all of them take a minute.
fn elements() -> String {
    let text = include_str!("../../studies/element-types/study.toml");
    let from = |name: &str| text.find(&format!("[[element]]\nname = \"{name}\"")).expect("an element");
    let first = &text[from("aligned-spheres")..from("sphere-cloud")];
    text[..from("aligned-spheres")].to_owned() + first
}

/// Walls of one thickness.
fn plate() -> String {
    tilting().replace("top_thickness_m = 0.16", "top_thickness_m = 0.2")
}

/// Towers that are solved in milliseconds, as they were measured.
fn towers() -> String {
    include_str!("../../studies/hidden-effects/example/study.toml").to_owned()
}

/// Joints that nobody knows exactly; without the variant that sets the same key.
fn uncertain() -> String {
    let text = tilting();
    let end = text.find("[[variant]]").expect("a variant");
    text[..end].to_owned()
        + "\n[uncertain]\n\"joint.phi_deg\" = { family = \"uniform\", low = 30, high = 40 }\n"
}

pub const CASES: &[Case] = &[
    Case {
        name: "run-lateral",
        study: lateral,
        files: &[],
        commands: &[
            "run studies/tiny --members 3 --out out --csv --json",
            "report out",
            "report out --cite --json",
            "report out --bibtex",
            "run studies/tiny --variant slippery --members 2 --out slippery --csv --json",
        ],
    },
    Case {
        name: "run-tilting",
        study: tilting,
        files: &[],
        commands: &["run studies/tiny --members 3 --out out --csv --json"],
    },
    Case {
        name: "run-tilting-implicit",
        study: tilting_elastic,
        files: &[],
        commands: &["run studies/tiny --members 2 --out out --csv --json"],
    },
    Case {
        name: "run-tilting-nonsmooth",
        study: tilting_in_time,
        files: &[],
        commands: &["run studies/tiny --members 2 --out out --csv --json"],
    },
    Case {
        name: "run-tilting-explicit",
        study: tilting_explicit,
        files: &[],
        commands: &["run studies/tiny --members 1 --out out --csv --json"],
    },
    Case {
        name: "run-without-dilatancy",
        study: without_dilatancy,
        files: &[],
        commands: &["run studies/tiny --members 3 --out out --csv --json"],
    },
    Case {
        name: "run-shear",
        study: sheared,
        files: &[],
        commands: &["run studies/tiny --members 2 --out out --csv --json"],
    },
    Case {
        name: "run-base-motion",
        study: shaken,
        files: &[],
        commands: &["run studies/tiny --members 2 --out out --csv --json"],
    },
    Case {
        name: "run-elements",
        study: elements,
        files: &[],
        commands: &["check studies/tiny --json", "run studies/tiny --out out --json"],
    },
    Case {
        name: "uncertain",
        study: uncertain,
        files: &[],
        commands: &[
            "run studies/tiny --members 16 --out out --csv --json",
            "sensitivity studies/tiny --points 32 --arm random --out sensitivity --json",
            "capacity studies/tiny --members 32 --quantile 0.05 --out capacity --json",
        ],
    },
    Case {
        name: "questions",
        study: tilting,
        files: &[],
        commands: &[
            "capacity studies/tiny --members 20 --below-deg 18 --out capacity --json",
            "compare studies/tiny --walls 24 --point 0 --out compare --json",
            "plan-tests studies/tiny --specimens 6 --members 20 --point 0 --out plan --json",
            // No published numbers, nothing measured, walls that are thinner at their top.
            "readings studies/tiny --members 2 --json",
            "detectability studies/tiny --members 2 --json",
            "homogenise studies/tiny --point 0 --json",
        ],
    },
    Case {
        name: "published",
        study: tilting_elastic,
        files: &[("../../golden/published.toml", "studies/tiny/published.toml")],
        commands: &[
            "run studies/tiny --members 2 --out out --json",
            "readings studies/tiny --members 2 --departures 1 --out readings --json",
        ],
    },
    Case {
        name: "plate",
        study: plate,
        files: &[],
        commands: &[
            "homogenise studies/tiny --arms random --cells 2 --stones 2,4 --point 0 --out plate --json",
        ],
    },
    Case {
        name: "shards",
        study: tilting,
        files: &[],
        commands: &[
            "shards run studies/tiny --members 3 --index 0 --of 2 --out shards --json",
            "shards status shards --json",
            "shards merge shards --json",
            "shards run studies/tiny --members 3 --index 1 --of 2 --out shards --json",
            "shards status shards --json",
            "shards merge shards --json",
        ],
    },
    Case {
        name: "measured",
        study: towers,
        files: &[
            ("diagnose/gauge-offset.csv", "tests.csv"),
            ("diagnose/gauge-offset.csv", "studies/tiny/measured.csv"),
        ],
        commands: &[
            "init measured.csv --measured studies/tiny --specimens 2",
            "check studies/tiny --measured tests.csv --json",
            "detectability studies/tiny --members 2 --out detectability --json",
            "diagnose studies/tiny --prepare --points 10 --bank bank --json",
            "diagnose studies/tiny --points 10 --bank bank --no-build --no-gain --out verdict \
             --json",
            "reference causes --json",
        ],
    },
    Case {
        name: "analyse",
        study: lateral,
        files: TOWER,
        commands: &[
            "analyse tower.json --phi-deg 35 --json --out limit",
            "analyse tower.json --phi-deg 35 --flow non-associative --json",
            "analyse tower.json --phi-deg 35 --solver implicit --kn 1e9 --json",
            "analyse tower.json --phi-deg 35 --solver explicit --kn 1e8 --json",
            "analyse tower.json --phi-deg 35 --solver nonsmooth --json",
            "analyse tower.json --phi-deg 35 --load lateral --json",
            "analyse tower.json --phi-deg 35 --worst-direction --json",
            "analyse tower.json --phi-deg 35 --load water --direction y- --demand 0.2m --json",
            "analyse tower.json --phi-deg 30..38 --walls 32 --out ranges --json",
            "analyse missing.json --phi-deg 35 --json",
            "analyse tower.json --phi-deg 95 --json",
        ],
    },
    Case {
        name: "analyse-left-open",
        study: lateral,
        files: &[("walls/pyramid.json", "pyramid.json")],
        commands: &["analyse pyramid.json --phi-deg 40 --json"],
    },
    Case {
        name: "one-wall",
        study: lateral,
        files: &[],
        commands: &[
            "wall studies/tiny --arm random --member 1 --with-base --out wall.json --json",
            "wall studies/tiny --arm random --member 1 --out wall.vtu --json",
            "wall studies/tiny --arm random --member 1 --out wall.obj --json",
            "analyse wall.json --phi-deg 35 --json",
            "wall studies/tiny --arm random --member 1 --out fall.svg --json",
        ],
    },
    Case {
        name: "files",
        study: || STUDY.replace("phi_deg = 35", "phi_deg = 350"),
        files: &[],
        commands: &[
            "check studies/tiny --json",
            "run studies/tiny --json",
            "check missing --json",
            "init first --json",
            "check first --json",
            "reference columns",
            "run first --unknown",
        ],
    },
    Case {
        name: "shells",
        study: lateral,
        files: &[],
        commands: &[
            "reference completions bash",
            "reference man --out man",
            "reference schema --out schema.json",
        ],
    },
];
