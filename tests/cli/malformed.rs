//! Every malformed file gives all its faults, each with line, key, value found, what is allowed and how to mend it.

use std::fs;

use crate::scratch::{DIP, PUBLISHED, SIZE, STUDY, Scratch};

/// One malformed study: the file, the text replaced by another, and what the listing must hold. `@` in an expectation
/// is the place `file:line:` of the replaced text; `#` heads the number of faults expected (1 when there is none).
type Case = (&'static str, &'static str, &'static str, &'static [&'static str]);

/// The fixture's load, to be replaced by a tilting table.
const LOAD: &str =
    "protocol = \"lateral\"\nmean_pressure_pa = 1000\nbase_over_top = 2\nsteps = 4\ncollapse_share = 0.5\n";
/// The head of the fixture's solver, to be replaced by another one.
const SOLVER: &str = "name = \"explicit\"\nagreement = false\nunbalanced_ratio = 1e-5\ndamping = 0.8\nstep_safety = 0.5\nmax_steps = 200000\nscaled_inertia = true\nlongest_step_s = 1e-3\n";

// One case per line: a table.
#[rustfmt::skip]
const CASES: &[Case] = &[
    // unknown and missing keys
    (STUDY, "height_m = 1.0\n", "heigth_m = 1.0\n", &["#2", "@ wall.heigth_m is not a known key", "did you mean \"height_m\"?", "study.toml:7: wall.height_m is missing: allowed is a number above 0 and at most 1000 (m)", "add height_m to [wall]"]),
    (STUDY, "[solver]\n", "[sovler]\n", &["@ sovler is not a known key", "did you mean \"solver\"?"]),
    (STUDY, "damping = 0.8", "dampling = 0.8", &["@ solver.dampling is not a known key", "did you mean \"damping\"?"]),
    (STUDY, "seed = 7\n", "seed = 7\nzzzzzzzzzz = 1\n", &["study.toml:6: study.zzzzzzzzzz is not a known key", "remove it"]),
    (STUDY, "seed = 7\n", "", &["study.toml:3: study.seed is missing: allowed is a whole number within 0 to 18446744073709551615", "add seed to [study]"]),
    (STUDY, "[block]\ndensity_kg_per_m3 = 2400\n", "", &["study.toml:1: block is missing: allowed is a table [block]"]),
    (STUDY, "overlap = 0.5\n", "", &["arm.running.overlap is missing: allowed is a number above 0 and below 1"]),
    (STUDY, "kn_over_ks = 2.0\n", "", &["joint.kn_over_ks is missing"]),
    // keys that mean nothing for the arrangement
    (STUDY, "course_height_m = 0.2\n", "course_height_m = 0.2\noverlap = 0.5\n", &["arm.stack.overlap means nothing where arrangement = \"continuous\"", "it belongs to discontinuous"]),
    (STUDY, "dip_about = \"both\"", "dip_about = \"both\"\nleast_overlap = 0.1", &["arm.hewn.least_overlap means nothing where arrangement = \"cut\"", "it belongs to coursed"]),
    // wrong types
    (STUDY, "seed = 7", "seed = \"seven\"", &["@ study.seed = \"seven\": allowed is a whole number", "a string cannot stand here"]),
    (STUDY, "seed = 7", "seed = 7.5", &["@ study.seed = 7.5: allowed is a whole number"]),
    (STUDY, "seed = 7", "seed = -1", &["@ study.seed = -1", "at least 0 is needed"]),
    (STUDY, "height_m = 1.0", "height_m = \"1 kN\"", &["@ wall.height_m = \"1 kN\": allowed is a number above 0", "with its unit in quotes: m, cm, mm"]),
    (STUDY, "height_m = 1.0", "height_m = \"1100000 mm\"", &["@ wall.height_m = \"1100000 mm\"", "reduce it"]),
    (STUDY, "phi_deg = 30", "phi_deg = \"30 mm\"", &["@ joint.phi_deg = \"30 mm\"", "with its unit in quotes: deg, rad"]),
    (STUDY, "height_m = 1.0", "height_m = true", &["@ wall.height_m = true", "true or false cannot stand here"]),
    (STUDY, "height_m = 1.0", "height_m = 2026-01-01", &["@ wall.height_m = 2026-01-01", "a date cannot stand here"]),
    (STUDY, "scaled_inertia = true", "scaled_inertia = \"yes\"", &["@ solver.scaled_inertia = \"yes\": allowed is true or false"]),
    (STUDY, "question = \"Does every key work?\"", "question = \"\"", &["@ study.question = \"\": allowed is a text in quotes that is not empty"]),
    (STUDY, "phi_deg = 30", "phi_deg = [30]", &["@ joint.phi_deg = [30]: allowed is a number or a distribution within 0 to 85 (deg)", "a list cannot stand here"]),
    (STUDY, "[[arm]]\nname = \"stack\"", "[arm]\nname = \"stack\"", &["cannot be read as TOML"]),
    (STUDY, "sub_contacts = [2, 2]", "sub_contacts = [2, 2, 2]", &["@ joint.sub_contacts = [2, 2, 2]: allowed is a list of two whole numbers within 1 to 32", "give exactly two"]),
    (STUDY, "sub_contacts = [2, 2]", "sub_contacts = [0, 2]", &["@ joint.sub_contacts = 0", "at least 1 is needed"]),
    // not finite
    (STUDY, "length_m = 4.0", "length_m = nan", &["@ wall.length_m = nan", "a finite number is needed"]),
    (STUDY, "mean_pressure_pa = 1000", "mean_pressure_pa = inf", &["@ load.mean_pressure_pa = inf", "a finite number is needed"]),
    (STUDY, "mean_pressure_pa = 1000", "mean_pressure_pa = 1e999", &["@ load.mean_pressure_pa = 1e999", "a finite number is needed"]),
    // out of range
    (STUDY, "height_m = 1.0", "height_m = -1.0", &["@ wall.height_m = -1.0: allowed is a number above 0 and at most 1000 (m); raise it"]),
    (STUDY, "base_thickness_m = 0.45", "base_thickness_m = 0", &["@ wall.base_thickness_m = 0: allowed is a number above 0"]),
    (STUDY, "top_thickness_m = 0.25", "top_thickness_m = 0.5", &["@ wall.top_thickness_m = 0.5: allowed is at most base_thickness_m = 0.45", "upside down"]),
    (STUDY, "overlap = 0.5", "overlap = 1.0", &["@ arm.running.overlap = 1.0: allowed is a number above 0 and below 1; reduce it"]),
    (STUDY, "least_overlap = 0.2", "least_overlap = 0.5", &["@ arm.laid.least_overlap = 0.5: allowed is a number at least 0 and below 0.5"]),
    (STUDY, "share = 0.1\nheight_m", "share = 1.1\nheight_m", &["@ arm.laid.wedges.share = 1.1: allowed is a number within 0 to 1"]),
    (STUDY, "header_share = 0\n", "header_share = 0.2\n", &["@ wall.header_share = 0.2: allowed is 0 where wythes = 1", "raise wythes"]),
    (STUDY, "members = 3", "members = 0", &["@ arm.laid.members = 0: allowed is a whole number within 1 to 1000000"]),
    (STUDY, "damping = 0.8", "damping = 1.0", &["@ solver.damping = 1.0: allowed is a number at least 0 and below 1"]),
    (STUDY, "steps = 4", "steps = 0", &["@ load.steps = 0", "at least 1 is needed"]),
    (STUDY, "dip_deg = 5", "dip_deg = 60", &["@ arm.hewn.dip_deg = 60: allowed is a number or a distribution within -45 to 45 (deg); reduce it"]),
    (STUDY, "phi_deg = 30", "phi_deg = 95", &["@ joint.phi_deg = 95: allowed is a number or a distribution within 0 to 85 (deg)"]),
    (STUDY, "wythes = 1\n", "wythes = 11\n", &["@ wall.wythes = 11: allowed is a whole number within 1 to 10"]),
    // the tilting table, the platform, the implicit solver
    (STUDY, "protocol = \"lateral\"", "protocol = \"tilting\"", &["#4", "load.mean_pressure_pa means nothing where protocol = \"tilting\"", "it belongs to lateral"]),
    (STUDY, "protocol = \"lateral\"", "protocol = \"tilt\"", &["@ load.protocol = \"tilt\": allowed is one of", "did you mean \"tilting\"?"]),
    (STUDY, "protocol = \"lateral\"", "protocol = \"tilted\"", &["@ load.protocol = \"tilted\": allowed is one of \"lateral\", \"tilting\"", "did you mean \"tilting\"?"]),
    (STUDY, "collapse_share = 0.5", "collapse_share = 0.5\nstep_deg = 0.5", &["load.step_deg means nothing where protocol = \"lateral\"", "it belongs to tilting"]),
    (STUDY, LOAD, "protocol = \"tilting\"\nend_deg = 90\n", &["load.end_deg = 90: allowed is a number above 0 and at most 89 (deg); reduce it"]),
    (STUDY, LOAD, "protocol = \"tilting\"\nstep_deg = 0\n", &["load.step_deg = 0: allowed is a number above 0 and at most 10 (deg)"]),
    (STUDY, LOAD, "protocol = \"tilting\"\nbracket_deg = 0\n", &["load.bracket_deg = 0: allowed is a number above 1e-4"]),
    (STUDY, LOAD, "protocol = \"tilting\"\ntowards = \"z+\"\n", &["load.towards = \"z+\": allowed is one of \"x+\", \"x-\", \"y+\", \"y-\""]),
    (STUDY, LOAD, "protocol = \"tilting\"\nrunaway_share = 2\n", &["load.runaway_share = 2: allowed is a number above 0 and at most 1"]),
    (STUDY, LOAD, "protocol = \"tilting\"\n[load.turning]\n", &["load.turning.rate_deg_per_s is missing: allowed is a number within 0.001 to 1000 (deg/s)"]),
    (STUDY, LOAD, "protocol = \"tilting\"\n[load.turning]\nrate_deg_per_s = 1\ndampling = 0\n", &["load.turning.dampling is not a known key", "did you mean \"damping\"?"]),
    (STUDY, LOAD, "protocol = \"tilting\"\nremainders = 1\n", &["load.remainders = 1: allowed is true or false"]),
    (STUDY, LOAD, "protocol = \"tilting\"\nremainders = true\n[load.turning]\nrate_deg_per_s = 1\n", &["load.remainders = true: allowed is false where the platform turns steadily, as it never stops; remove one of the two"]),
    (STUDY, "wythes = 1\n", "wythes = 1\nturned = \"yes\"\n", &["wall.turned = \"yes\": allowed is true or false"]),
    (STUDY, "base = \"fixed\"", "base = \"strip\"", &["restraint.strip_height_m is missing: allowed is a number above 0 and at most 1 (m)"]),
    (STUDY, "base = \"fixed\"", "base = \"fixed\"\nstrip_height_m = 0.02", &["restraint.strip_height_m means nothing where base = \"fixed\"", "it belongs to strip"]),
    (STUDY, "base = \"fixed\"", "base = \"fixed\"\nplatform_phi_deg = 90", &["restraint.platform_phi_deg = 90: allowed is a number within 0 to 85 (deg)"]),
    (STUDY, "ends = \"joint_springs\"", "ends = \"ropes\"", &["@ restraint.ends = \"ropes\": allowed is this with a table [restraint.rope]", "add [restraint.rope] with stiffness_n_per_m"]),
    (STUDY, "ends = \"joint_springs\"", "ends = \"free\"\n[restraint.rope]\nstiffness_n_per_m = 1e6\n", &["restraint.rope = ", "only where ends = \"ropes\""]),
    (STUDY, "ends = \"joint_springs\"", "ends = \"ropes\"\n[restraint.rope]\nstiffness_n_per_m = 0\nslack_m = -1\nsides = \"push\"\n", &["#3", "restraint.rope.stiffness_n_per_m = 0: allowed is a number above 0 and at most 1e12 (N/m)", "restraint.rope.slack_m = -1: allowed is a number within 0 to 1 (m)", "restraint.rope.sides = \"push\": allowed is one of \"pull\", \"both\""]),
    (STUDY, "name = \"explicit\"", "name = \"implicit\"", &["#5", "solver.damping means nothing where name = \"implicit\"", "it belongs to explicit"]),
    (STUDY, SOLVER, "name = \"implicit\"\nmax_factorisations = 0\n", &["solver.max_factorisations = 0", "at least 1 is needed"]),
    (STUDY, SOLVER, "name = \"implicit\"\nstabilisation = 1\n", &["solver.stabilisation = 1: allowed is a number within 0 to 0.001"]),
    (STUDY, SOLVER, "name = \"implicit\"\nunbalanced_ratio = 0\n", &["solver.unbalanced_ratio = 0: allowed is a number above 0 and below 1"]),
    (STUDY, "agreement = false", "agreement = \"limit\"", &["@ solver.agreement = \"limit\": allowed is true or false"]),
    // sizes against each other
    (STUDY, "block_length_m = 0.4\n", "block_length_m = 4.5\n", &["@ arm.stack.block_length_m = 4.5: allowed is at most wall.length_m = 4", "the block is larger than the wall"]),
    (STUDY, "course_height_m = 0.2\n", "course_height_m = 1.5\n", &["@ arm.stack.course_height_m = 1.5: allowed is at most wall.height_m = 1"]),
    (STUDY, "min_size_m = 0.02", "min_size_m = 0.22", &["#2", "@ arm.laid.limits.min_size_m = 0.22: allowed is at most a stone's height, 0.2", "no stone would pass"]),
    (STUDY, "depth_m = 0.1", "depth_m = 0.5", &["@ arm.laid.wedges.depth_m = 0.5: allowed is a mean below the wall's thickness at the base, 0.45"]),
    (STUDY, "head_joint_gap_m = 0.001", "head_joint_gap_m = 0.2", &["@ wall.head_joint_gap_m = 0.2: allowed is a number within 0 to 0.1"]),
    // names
    (STUDY, "ends = \"joint_springs\"", "ends = \"joint_spring\"", &["@ restraint.ends = \"joint_spring\": allowed is one of \"free\"", "did you mean \"joint_springs\"?"]),
    (STUDY, "arrangement = \"coursed\"", "arrangement = \"corsed\"", &["@ arm.laid.arrangement = \"corsed\"", "did you mean \"coursed\"?"]),
    (STUDY, "name = \"running\"", "name = \"stack\"", &["@ arm.stack.name = \"stack\": allowed is every name once", "published.toml:6: claim[1].over = \"running\": allowed is an arm of study.toml", "#3"]),
    (STUDY, "name = \"hewn\"", "name = \"Hewn/1\"", &["@ arm[4].name = \"Hewn/1\": allowed is a name of lower-case letters"]),
    // lists of stiffnesses
    (STUDY, "[5e7, 7.5e7]", "[7.5e7, 5e7]", &["@ joint.kn_pa_per_m = 5e7", "5e7 follows 7.5e7: sort the list"]),
    (STUDY, "[5e7, 7.5e7]", "[5e7, 5e7]", &["@ joint.kn_pa_per_m = 5e7", "drop repeated values"]),
    (STUDY, "[5e7, 7.5e7]", "[]", &["@ joint.kn_pa_per_m = []: allowed is a list of 1 to 50 ascending numbers, each above 0 (Pa/m); it has 0 entries"]),
    (STUDY, "[5e7, 7.5e7]", "5e7", &["@ joint.kn_pa_per_m = 5e7: allowed is a list"]),
    (STUDY, "[5e7, 7.5e7]", "[-5e7, 7.5e7]", &["@ joint.kn_pa_per_m = -5e7", "raise it"]),
    (STUDY, "[5e7, 7.5e7]", "[1e7,2e7,3e7,4e7,5e7,6e7,7e7,8e7,9e7,1e8,1.1e8,1.2e8,1.3e8,1.4e8,1.5e8,1.6e8,1.7e8,1.8e8,1.9e8,2e8,2.1e8,2.2e8,2.3e8,2.4e8,2.5e8,2.6e8,2.7e8,2.8e8,2.9e8,3e8,3.1e8,3.2e8,3.3e8,3.4e8,3.5e8,3.6e8,3.7e8,3.8e8,3.9e8,4e8,4.1e8,4.2e8,4.3e8,4.4e8,4.5e8,4.6e8,4.7e8,4.8e8,4.9e8,5e8,5.1e8]", &["it has 51 entries"]),
    // distributions written in place
    (STUDY, "low = 0.15, high = 0.25", "low = 0.25, high = 0.15", &["@ arm.laid.height_m.high = 0.15: allowed is a value that must be above low"]),
    (STUDY, "low = 0.15, high = 0.25", "low = -0.15, high = 0.25", &["@ arm.laid.height_m = { family", "its values run from -0.15 to 0.25: truncate or shift it"]),
    (STUDY, "low = -20, high = 20", "low = -50, high = 50", &["@ arm.laid.dip_deg = { family", "within -45 to 45 (deg)", "its values run from -50 to 50"]),
    (STUDY, "\"uniform\", low = -20, high = 20", "\"normal\", mean = 0, sd = 10", &["@ arm.laid.dip_deg = { family", "its values run from -inf to inf"]),
    (STUDY, "\"uniform\", low = 0.15", "\"unifrom\", low = 0.15", &["@ arm.laid.height_m.family = \"unifrom\"", "did you mean \"uniform\"?"]),
    (STUDY, "low = 0.15, high = 0.25", "low = 0.15, sd = 0.25", &["#2", "@ arm.laid.height_m.sd means nothing where family = \"uniform\"", "@ arm.laid.height_m.high is missing"]),
    (STUDY, "\"lognormal\", mean = 1.0", "\"lognormal\", mean = -1.0", &["@ joint.kn_factor.mean = -1: allowed is a value that must be above 0"]),
    (STUDY, "mean = 1.0, sd = 0.1", "mean = 1.0, sd = -0.1", &["@ joint.kn_factor.sd = -0.1: allowed is a value that must be between"]),
    // references
    (STUDY, "block/size:length", "block/size:lenght", &["@ arm.laid.length_m = \"block/size:lenght\": allowed is an entry of distributions/block/size.toml", "did you mean \"length\"?"]),
    (STUDY, "block/size:length", "block/sise:length", &["@ arm.laid.length_m = \"block/sise:length\": allowed is a file of `distributions`: block/density, block/dip, block/size, ", "; or a prior; did you mean \"block/size\"?"]),
    (STUDY, "block/size:length", "block/size", &["@ arm.laid.length_m = \"block/size\": allowed is a reference file:entry"]),
    (STUDY, "block/size:length", "../size:length", &["@ arm.laid.length_m = \"../size:length\": allowed is a reference"]),
    (STUDY, "block/size:length", "block/dip:steep", &["@ arm.laid.length_m = \"block/dip:steep\": allowed is a quantity in m; distributions/block/dip.toml is in deg"]),
    (STUDY, "dip_deg = 5", "dip_deg = \"block/dip:steep\"", &["@ arm.hewn.dip_deg = \"block/dip:steep\"", "its values run from -60 to 60"]),
    // syntax
    (STUDY, "height_m = 1.0", "height_m = = 1.0", &["@ cannot be read as TOML", "^"]),
    (STUDY, "height_m = 1.0", "height_m = 1.0\nheight_m = 1.0", &["study.toml:9: cannot be read as TOML: duplicate key"]),
    (STUDY, "battered_face = \"both\"", "battered_face = \"both", &["@ cannot be read as TOML"]),
    // variants
    (STUDY, "\"joint.sampling\" = \"vertices\"", "\"joint.smapling\" = \"vertices\"", &["@ variant.corners: \"joint.smapling\" sets what does not exist: allowed is a key of [joint]; did you mean \"sampling\"?"]),
    (STUDY, "\"joint.sampling\" = \"vertices\"", "\"joint.sampling\" = \"vertexes\"", &["@ joint.sampling = \"vertexes\": allowed is one of \"area\", \"vertices\"", "(variant \"corners\")"]),
    (STUDY, "\"arm.laid.dip_about\"", "\"arm.lade.dip_about\"", &["#2", "@ variant.laid-cut: \"arm.lade.dip_about\" sets what does not exist", "did you mean \"laid\"?", "arm.laid.dip_about is missing"]),
    (STUDY, "unset = [\"arm.laid.least_overlap\"]\n", "", &["arm.laid.least_overlap means nothing where arrangement = \"cut\"", "(variant \"laid-cut\")"]),
    (STUDY, "\"arm.laid.least_overlap\"", "\"arm.laid.overlap\"", &["#2", "@ variant.laid-cut: \"arm.laid.overlap\" takes away what is not there"]),
    (STUDY, "\"joint.sampling\" = \"vertices\"", "\"joint.sampling.kind\" = \"vertices\"", &["@ variant.corners: \"joint.sampling.kind\" sets what does not exist", "set sampling as a whole"]),
    (STUDY, "\"joint.sampling\" = \"vertices\"", "\"wall.top_thickness_m\" = 0.6", &["@ wall.top_thickness_m = 0.6: allowed is at most base_thickness_m = 0.45", "(variant \"corners\")"]),
    (STUDY, "\"joint.sampling\" = \"vertices\"", "", &["variant.corners.set = ", "set at least one key"]),
    (STUDY, "name = \"laid-cut\"", "name = \"corners\"", &["variant.corners is the name of two variants"]),
    (STUDY, "why = \"Older codes.\"\n", "", &["variant.corners.why is missing"]),
    // published.toml
    (PUBLISHED, "arm = \"stack\"", "arm = \"stak\"", &["@ claim[1].arm = \"stak\": allowed is an arm of study.toml: stack, running, laid, hewn; did you mean \"stack\"?"]),
    (PUBLISHED, "low = 0.5", "low = 0.8", &["@ claim[1].low = 0.8: allowed is at most high = 0.7; the interval is reversed"]),
    (PUBLISHED, "stated = 0.6", "stated = 0.9", &["@ claim[1].stated = 0.9: allowed is within low to high, 0.5 to 0.7"]),
    (PUBLISHED, "stated = \"0.2 to 0.3\"", "stated = 0.25", &["@ claim[2].stated = 0.25: allowed is a text in quotes"]),
    (PUBLISHED, "of = [\"stack\", \"running\"]", "of = [\"stack\", \"stack\"]", &["@ claim[3].of = [\"stack\", \"stack\"]: allowed is a list of two different names"]),
    (PUBLISHED, "test = \"falls_with_kn\"", "test = \"falls_with_kn\"\nlow = 1", &["published.toml:34: claim[4].low means nothing where test = \"falls_with_kn\""]),
    (PUBLISHED, "test = \"falls_with_kn\"", "test = \"mechanism\"\narm = \"laid\"\nstated = \"topples\"\nmode = \"rocking\"\nplace = [0.5]", &["claim[4].place = [0.5]: allowed is two shares, the smaller first"]),
    (PUBLISHED, "test = \"falls_with_kn\"", "test = \"mean\"\narm = \"laid\"\nstated = 3\nlow = 1\nhigh = 2", &["claim[4].stated = 3: allowed is within low to high, 1 to 2"]),
    (PUBLISHED, "over = \"running\"", "over = \"stack\"", &["@ claim[1].over = \"stack\": allowed is another arm than above the line"]),
    // distributions
    (SIZE, "status = \"assumed\"\n", "", &["distributions/block/size.toml:5: length.status is missing: allowed is one of \"measured\", \"literature\", \"calibrated\", \"assumed\""]),
    (SIZE, "status = \"assumed\"", "status = \"guessed\"", &["@ length.status = \"guessed\": allowed is one of \"measured\""]),
    (SIZE, "source = \"an example\"\nn", "source = \" \"\nn", &["@ length.source = \" \": allowed is a text"]),
    (SIZE, "low = 0.2\nhigh = 0.6", "low = 0.6\nhigh = 0.2", &["distributions/block/size.toml:10: length.high = 0.2: allowed is a value that must be above low"]),
    (SIZE, "values = [0.1, 0.2]", "values = []", &["@ height.values = []: allowed is a list of 1 to 10000 numbers"]),
    (SIZE, "values = [0.1, 0.2]", "values = [0.1, nan]", &["@ height.values = nan", "a finite number is needed"]),
    (SIZE, "unit = \"m\"", "unit = \"mm\"", &["@ unit = \"mm\": allowed is one of \"1\", \"m\", \"deg\""]),
    (SIZE, "unit = \"m\"\n", "", &["distributions/block/size.toml:1: unit is missing"]),
    (SIZE, "symbol = \"l\"", "symbl = \"l\"", &["#2", "@ symbl is not a known key", "did you mean \"symbol\"?"]),
    (SIZE, "n = 12", "n = 0", &["@ length.n = 0: allowed is a whole number within 1 to"]),
    (SIZE, "[length]", "[length", &["@ cannot be read as TOML"]),
];

#[test]
fn every_fault_is_named() {
    let mut failures = Vec::new();
    for (i, (file, from, to, expected)) in CASES.iter().enumerate() {
        let scratch = Scratch::new(&format!("case-{i}"));
        let line = scratch.replace(file, from, to);
        let shown = file.trim_start_matches("studies/base/");
        let Err(faults) = scratch.load(None) else {
            failures.push(format!("`{to}` in {file} was accepted"));
            continue;
        };
        let listing = faults.to_string();
        let mut count = 1;
        for part in *expected {
            if let Some(number) = part.strip_prefix('#') {
                count = number.parse().expect("a number of faults");
                continue;
            }
            let part = part.replacen('@', &format!("{shown}:{line}:"), usize::from(part.starts_with('@')));
            if !listing.contains(&part) {
                failures.push(format!("`{to}` in {file}: no `{part}` in\n{listing}"));
            }
        }
        if faults.faults.len() != count {
            failures.push(format!(
                "`{to}` in {file}: {} faults instead of {count}:\n{listing}",
                faults.faults.len()
            ));
        }
    }
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn the_table_is_large_enough() {
    assert!(CASES.len() >= 45, "{} malformed files", CASES.len());
}

/// The base of all edits must be sound, in all its readings, or the table above would prove nothing.
#[test]
fn the_sound_study_loads() {
    let scratch = Scratch::new("sound");
    for variant in [None, Some("corners"), Some("laid-cut")] {
        let loaded = scratch.load(variant).unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(loaded.study.variant.as_deref(), variant);
        // Its joints scatter from one to the next, which is said: see `averaged`.
        let warned: Vec<&str> = loaded.warnings.iter().map(|own| own.key.as_str()).collect();
        assert_eq!(warned, ["joint.kn_factor"], "{:?}", loaded.warnings);
    }
}

#[test]
fn faults_of_all_files_are_listed_together_in_order() {
    let scratch = Scratch::new("together");
    scratch.replace(STUDY, "height_m = 1.0", "height_m = -1");
    scratch.replace(STUDY, "phi_deg = 30", "phi_deg = \"thirty\"");
    scratch.replace(STUDY, "overlap = 0.5", "overlap = 2");
    scratch.replace(STUDY, "max_steps = 200000", "max_stepps = 200000");
    scratch.replace(PUBLISHED, "high = 0.31", "high = 0.1");
    scratch.replace(SIZE, "sd = 0.1", "sd = 0");
    scratch.replace(SIZE, "n = 12", "n = 1.5");
    let faults = scratch.load(Some("corners")).expect_err("seven faults");
    let places: Vec<(&str, usize, &str)> =
        faults.faults.iter().map(|f| (f.file.as_str(), f.line, f.key.as_str())).collect();
    assert_eq!(
        places,
        [
            ("study.toml", 8, "wall.height_m"),
            ("study.toml", 24, "joint.phi_deg"),
            ("study.toml", 49, "solver.max_stepps"),
            ("study.toml", 66, "arm.running.overlap"),
            ("published.toml", 18, "claim[2].low"),
            ("distributions/block/size.toml", 8, "length.sd"),
            ("distributions/block/size.toml", 13, "length.n"),
        ]
    );
    assert!(
        faults
            .to_string()
            .starts_with("7 faults in the input:\nstudy.toml:8: wall.height_m = -1: allowed is ")
    );
}

#[test]
fn a_fault_shows_its_line_with_a_caret() {
    let scratch = Scratch::new("caret");
    scratch.replace(STUDY, "dip_deg = 5", "dip_deg = 60");
    let listing = scratch.load(None).expect_err("60 deg").to_string();
    assert!(listing.contains("\n  99 | dip_deg = 60\n     |           ^^\n"), "{listing}");
}

#[test]
fn faults_of_whole_files() {
    type Spoil = fn(&Scratch);
    let cases: &[(&str, Spoil, &[&str])] = &[
        (
            "missing",
            |s| fs::remove_file(s.path(STUDY)).expect("it was there"),
            &["study.toml: does not exist", "a text file in TOML"],
        ),
        (
            "misnamed",
            |s| fs::rename(s.path(STUDY), s.path("studies/base/studdy.toml")).expect("it was there"),
            &["did you mean \"studdy.toml\"?"],
        ),
        ("empty", |s| s.write(STUDY, b" \n"), &["study.toml: is empty"]),
        ("empty-published", |s| s.write(PUBLISHED, b""), &["published.toml: is empty"]),
        ("empty-distribution", |s| s.write(SIZE, b"\n"), &["distributions/block/size.toml: is empty"]),
        (
            "latin-1",
            |s| s.write(STUDY, b"[study]\nquestion = \"caf\xe9\"\n"),
            &["study.toml:2: is not UTF-8", "save it as UTF-8"],
        ),
        (
            "folder",
            |s| {
                fs::remove_file(s.path(STUDY)).expect("it was there");
                fs::create_dir(s.path(STUDY)).expect("a folder")
            },
            &["study.toml: is a folder"],
        ),
        (
            "folder-distribution",
            |s| {
                fs::remove_file(s.path(SIZE)).expect("it was there");
                fs::create_dir(s.path(SIZE)).expect("a folder")
            },
            &["distributions/block/size.toml: is a folder"],
        ),
        (
            // What is built in serves where a study has none, and holds no such file.
            "no-distributions",
            |s| {
                fs::remove_dir_all(s.path("distributions")).expect("it was there");
                s.replace(STUDY, "block/size:length", "block/sizes:length");
            },
            &[
                "arm.laid.length_m = \"block/sizes:length\": allowed is a file of `distributions`: block/density, ",
                "joint/stiffness; or a prior; did you mean \"block/size\"?",
            ],
        ),
        (
            "comment",
            |s| s.write(STUDY, b"# nothing\n"),
            &[
                "study.toml:1: study is missing",
                "wall is missing",
                "arm is missing: allowed is one or more tables [[arm]]",
            ],
        ),
        (
            "no-entries",
            |s| s.write(SIZE, b"quantity = \"l\"\nsymbol = \"l\"\nunit = \"m\"\n"),
            &["entry is missing: allowed is one or more tables"],
        ),
    ];
    for (name, spoil, expected) in cases {
        let scratch = Scratch::new(name);
        spoil(&scratch);
        let listing = scratch.load(None).map(|_| ()).expect_err(name).to_string();
        for part in *expected {
            assert!(listing.contains(part), "{name}: no `{part}` in\n{listing}");
        }
    }
}

#[test]
fn a_study_that_is_not_there_is_said_so() {
    let scratch = Scratch::new("not-there");
    for (path, part) in [
        ("studies/bse", "did you mean \"base\"?"),
        ("studies/base/study.toml", "is a file: allowed is the folder of a study"),
    ] {
        let listing = pirca::study::Study::load(&scratch.path(path), None).expect_err(path).to_string();
        assert!(listing.contains(part), "{listing}");
    }
}

#[test]
fn an_unknown_variant_is_refused() {
    let scratch = Scratch::new("variant");
    let listing = scratch.load(Some("corner")).expect_err("no such variant").to_string();
    assert!(listing.contains("study.toml: has no variant \"corner\": allowed is one of corners, laid-cut; did you mean \"corners\"?"), "{listing}");
}

#[test]
fn a_stiffness_in_the_wrong_magnitude_is_a_warning() {
    let scratch = Scratch::new("magnitude");
    let line = scratch.replace(STUDY, "[5e7, 7.5e7]", "[5e2, 7.5e7, 2e13]");
    let loaded = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}"));
    let of_kn = loaded.warnings.iter().filter(|own| own.key == "joint.kn_pa_per_m");
    let shown: Vec<String> = of_kn.map(ToString::to_string).collect();
    assert_eq!(shown.len(), 2, "{shown:?}");
    assert!(shown[0].starts_with(&format!("study.toml:{line}: joint.kn_pa_per_m = 5e2: allowed is this, but usual is within 1e6 to 1e12 (Pa/m)")), "{}", shown[0]);
    assert!(shown[1].contains("2e13"), "{}", shown[1]);
}

/// Friction of 0.6 deg is radians or a coefficient; so are other angles that small.
#[test]
fn an_angle_that_looks_like_radians_is_a_warning() {
    let study = std::fs::read_to_string(
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/peers/column/study.toml"),
    );
    let study = study.expect("a study of a column");
    let warned = |from: &str, to: &str, key: &str| {
        let folder = crate::fixture::Folder::with_study(&study.replace(from, to));
        let loaded = pirca::study::Study::load(&folder.path("studies/tiny"), None);
        let loaded = loaded.unwrap_or_else(|faults| panic!("{faults}"));
        let own = loaded.warnings.iter().filter(|own| own.key == key).map(ToString::to_string);
        own.collect::<Vec<String>>().join("\n")
    };
    let uncertain = "\"joint.phi_deg\" = { family = \"uniform\", low = 23, high = 27 }";
    let dip = "dip_deg = { family = \"uniform\", low = -5, high = 5 }";
    for (from, to, key, part) in [
        (
            "phi_deg = 25",
            "phi_deg = 0.6",
            "joint.phi_deg",
            "in radians (34.4 deg), or a coefficient of friction (31.0 deg)?",
        ),
        (
            uncertain,
            "\"joint.phi_deg\" = { family = \"uniform\", low = 0.4, high = 0.6 }",
            "uncertain.joint.phi_deg",
            "hardly any friction",
        ),
        (
            dip,
            "dip_deg = { family = \"uniform\", low = -0.35, high = 0.35 }",
            "arm.column.dip_deg",
            "is level: is it in radians",
        ),
        ("end_deg = 45", "end_deg = 0.785", "load.end_deg", "is hardly a tilt: is it in radians (45.0 deg)?"),
        ("towards = \"y+\"", "towards_deg = 1.5708", "load.towards_deg", "is it in radians (90.0 deg)?"),
    ] {
        assert_eq!(warned("phi_deg = 25", "phi_deg = 25", key), "", "{key}");
        let shown = warned(from, to, key);
        assert!(shown.contains(part) && shown.contains("state it in degrees"), "{key}: {shown}");
    }
}

/// DIP is referred to by some cases only; it must be sound itself, or they would fail for another reason.
#[test]
fn the_sound_distributions_load() {
    let scratch = Scratch::new("distributions");
    let files =
        pirca::study::load_distributions(&scratch.path("distributions")).unwrap_or_else(|f| panic!("{f}"));
    assert_eq!(files.keys().collect::<Vec<_>>(), ["block/dip", "block/size"]);
    assert!(scratch.read(DIP).contains(&files["block/dip"].entries["steep"].source));
}
