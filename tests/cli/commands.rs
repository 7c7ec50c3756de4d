//! Each verb as a user meets it: exit codes, messages, formats.

use std::fs::{self, File};
use std::process::{Output, Stdio};

use serde_json::Value;

use crate::fixture::{Folder, STUDY, changed, stderr};

/// What a finished program wrote to standard output.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", stdout(output)))
}

/// Runs the program and checks its exit code.
fn ends_with(folder: &Folder, code: i32, arguments: &[&str]) -> Output {
    let output = folder.pirca(arguments);
    assert_eq!(output.status.code(), Some(code), "pirca {}: {}", arguments.join(" "), stderr(&output));
    output
}

#[test]
fn every_verb_has_help_with_an_example_and_the_exit_codes() {
    let folder = Folder::with_study(STUDY);
    let whole = stdout(&ends_with(&folder, 0, &["--help"]));
    for group in ["One wall:", "Many walls:", "Measured walls:"] {
        assert!(whole.contains(group), "{group} is missing in: {whole}");
    }
    let verbs: Vec<&str> =
        whole.lines().filter_map(|line| line.strip_prefix("  ")?.split("  ").next()).collect();
    let of_a_study = ["capacity", "check", "diagnose", "wall", "run", "detectability"];
    for verb in ["analyse", "init", "readings"].iter().chain(&of_a_study) {
        assert!(verbs.contains(verb), "{verb} is missing in: {whole}");
        let help = stdout(&ends_with(&folder, 0, &[verb, "--help"]));
        for said in ["Usage: pirca", "Example: pirca", "Exit codes: 0", "--json"] {
            assert!(help.contains(said), "{said} is missing in the help of {verb}: {help}");
        }
        let of_a_variant = of_a_study.contains(verb) || *verb == "init";
        assert_eq!(help.contains("--variant <"), of_a_variant, "{verb}");
    }
    assert_eq!(
        stdout(&ends_with(&folder, 0, &["--version"])),
        format!("pirca {}\n", env!("CARGO_PKG_VERSION"))
    );
}

/// Help fills the columns that there are, up to 100.
#[test]
fn help_is_wrapped() {
    let folder = Folder::with_study(STUDY);
    for (columns, most) in [("60", 60), ("90", 90), ("200", 100)] {
        let help = folder.command(&["run", "--help"]).env("COLUMNS", columns).output().unwrap();
        let longest =
            stdout(&help).lines().filter(|l| !l.contains("pirca ")).map(|l| l.chars().count()).max();
        let longest = longest.unwrap_or_default();
        // Words are shorter than 15 letters, so that a long paragraph comes so near.
        assert!(longest <= most && longest > most - 15, "{columns}: {longest} in {}", stdout(&help));
    }
}

#[test]
fn arguments_that_make_no_sense_end_with_2() {
    let folder = Folder::with_study(STUDY);
    for (arguments, said) in [
        (&["solve"][..], "solve"),
        (&["check"], "STUDY"),
        (&["run", "studies/tiny", "--members", "0"], "--members"),
        (&["run", "studies/tiny", "--threads", "0"], "--threads"),
        (&["run", "studies/tiny", "--solver", "quantum"], "explicit"),
        (&["run", "studies/tiny", "--seed", "-1"], "-1"),
        (&["detectability", "studies/tiny", "--members", "0"], "--members"),
        (&["detectability", "studies/tiny", "--quantile", "1"], "--quantile"),
        (&["detectability", "studies/tiny", "--quantile", "-0.5"], "--quantile"),
        (&["diagnose", "studies/tiny", "--prepare", "--points", "3"], "--points"),
        (&["diagnose", "studies/tiny", "--seed", "x"], "--seed"),
        (&["init", "tests.csv", "--wide"], "--measured"),
        (&["diagnose", "studies/tiny", "--prepare", "--law"], "--prepare"),
        (&["init", "tests.csv", "--measured", "studies/tiny", "--specimens", "0"], "--specimens"),
        (&["wall", "studies/tiny"], "--out"),
        (&["wall", "studies/tiny", "--out", "wall.stl"], ".svg, .vtu, .obj or .json"),
        (&["wall", "studies/tiny", "--out", "wall"], ".svg, .vtu, .obj or .json"),
        (&["wall", "studies/tiny", "--out", "wall.obj", "--arm", "randon"], "it has stack, random"),
        (&["wall", "studies/tiny", "--out", "wall.obj", "--point", "2"], "2 kn points, numbers 0 to 1"),
        (
            &["wall", "studies/tiny", "--out", "wall.svg", "--solved"],
            "--solved is for a .vtu, .obj or .json file",
        ),
        (&["wall", "studies/tiny", "--out", "wall.obj", "--magnify", "2"], "--magnify is for a picture"),
        (&["wall", "studies/tiny", "--out", "wall.svg", "--arm", "randon"], "it has stack, random"),
        (&["wall", "studies/tiny", "--out", "wall.svg", "--point", "2"], "2 kn points, numbers 0 to 1"),
        (&["wall", "studies/tiny", "--out", "wall.svg", "--member", "-1"], "-1"),
        (
            &["wall", "studies/tiny", "--out", "wall.svg", "--member", "8"],
            "arm random has 8 walls, numbers 0 to 7",
        ),
        (
            &["wall", "studies/tiny", "--out", "wall.obj", "--member", "99"],
            "arm random has 8 walls, numbers 0 to 7",
        ),
        (
            &["wall", "studies/tiny", "--out", "wall.obj", "--member", "8", "--members", "8"],
            "arm random has 8 walls, numbers 0 to 7",
        ),
        (
            &["wall", "studies/tiny", "--out", "wall.obj", "--arm", "stack", "--member", "1"],
            "arm stack has one wall, number 0; nothing in it is random",
        ),
        (&["wall", "studies/tiny", "--out", "wall.svg", "--magnify", "0"], "a number above 0"),
        (&["wall", "studies/tiny", "--out", "wall.svg", "--colour", "red"], "opening"),
    ] {
        let output = ends_with(&folder, 2, arguments);
        assert!(stderr(&output).contains(said), "{said} in: {}", stderr(&output));
        assert!(output.stdout.is_empty(), "an error goes to standard error");
    }
}

#[test]
fn a_path_without_a_study_is_told_with_the_studies_that_there_are() {
    let folder = Folder::with_study(STUDY);
    fs::create_dir(folder.path("studies/empty")).unwrap();
    for (path, found) in [
        ("studies/tinny", "studies/tinny: No such file or directory"),
        ("tiny", "tiny: No such file or directory"),
        ("studies/empty", "studies/empty is a folder without a study.toml"),
        ("studies/tiny/study.toml/x", "Not a directory"),
    ] {
        let generate = ["wall", path, "--out", "wall.obj"];
        for verb in [&["check", path][..], &["run", path], &generate, &["detectability", path]] {
            let error = stderr(&ends_with(&folder, 3, verb));
            assert!(error.contains(found), "{found} in: {error}");
            assert!(error.contains("nearest name first:\n  studies/tiny"), "{error}");
        }
    }
    let output = ends_with(&folder, 3, &["check", "studies/tinny", "--json"]);
    assert_eq!(json(&output)["valid"], false);
    assert!(json(&output)["error"].as_str().unwrap().contains("studies/tiny"));
}

#[test]
fn check_accepts_a_folder_or_its_file_and_says_what_it_found() {
    let folder = Folder::with_study(STUDY);
    for path in ["studies/tiny", "studies/tiny/", "studies/tiny/study.toml"] {
        let output = ends_with(&folder, 0, &["check", path]);
        for said in [
            "tiny: valid",
            "Does the machinery hold?",
            "stack (1 x 2 kn), random (8 x 2 kn)",
            "evaluations: 18",
            "slippery: Wet",
        ] {
            assert!(stdout(&output).contains(said), "{said} in: {}", stdout(&output));
        }
        let told = json(&ends_with(&folder, 0, &["check", path, "--json", "--variant", "slippery"]));
        assert_eq!(told["valid"], true);
        assert_eq!(told["study"], "tiny");
        assert_eq!(told["variant"], "slippery");
        assert_eq!(told["evaluations"], 18);
        assert_eq!(told["arms"][1]["random"], true);
        assert_eq!(told["faults"], Value::Array(Vec::new()));
    }
    // From inside the folder, too, the study has the folder's name.
    let inside = folder.command(&["check", "."]).current_dir(folder.path("studies/tiny")).output().unwrap();
    assert!(stdout(&inside).starts_with("tiny: valid"), "{}", stdout(&inside));
}

#[test]
fn an_invalid_study_ends_with_3_and_all_its_faults() {
    let faulty = changed("height_m = 0.3", "height_m = -0.3").replace("phi_deg = 35", "phi_deg = 135");
    let folder = Folder::with_study(&faulty);
    for verb in [
        &["check", "studies/tiny"][..],
        &["run", "studies/tiny"],
        &["wall", "studies/tiny", "--out", "w.obj"],
    ] {
        let error = stderr(&ends_with(&folder, 3, verb));
        for said in ["study.toml:7", "wall.height_m = -0.3", "joint.phi_deg = 135"] {
            assert!(error.contains(said), "{said} in: {error}");
        }
    }
    let told = json(&ends_with(&folder, 3, &["check", "studies/tiny", "--json"]));
    assert_eq!(told["valid"], false);
    let keys: Vec<_> = told["faults"].as_array().unwrap().iter().map(|fault| fault["key"].clone()).collect();
    assert_eq!(keys, ["wall.height_m", "joint.phi_deg"]);
    assert!(!folder.path("runs").exists(), "nothing is run");

    let folder = Folder::with_study(STUDY);
    let error = stderr(&ends_with(&folder, 3, &["run", "studies/tiny", "--variant", "slipery"]));
    assert!(error.contains("slippery"), "{error}");
}

#[test]
fn a_warning_goes_to_standard_error_and_stops_nothing() {
    let folder = Folder::with_study(&changed("[5e7, 1.75e8]", "[50, 100]"));
    let output = ends_with(&folder, 0, &["check", "studies/tiny"]);
    assert!(
        stderr(&output).contains("warning: ") && stderr(&output).contains("kn_pa_per_m"),
        "{}",
        stderr(&output)
    );
    let output = ends_with(&folder, 0, &["check", "studies/tiny", "--json"]);
    assert_ne!(json(&output)["warnings"], Value::Array(Vec::new()));
}

#[test]
fn generate_writes_the_format_that_the_ending_says() {
    let folder = Folder::with_study(STUDY);
    for (name, holds) in [("wall.json", "\"blocks\""), ("wall.obj", "\nv "), ("wall.vtu", "<VTKFile")] {
        ends_with(&folder, 0, &["wall", "studies/tiny", "--out", name]);
        let text = fs::read_to_string(folder.path(name)).unwrap();
        assert!(text.contains(holds), "{holds} in {name}");
    }
    let told = json(&ends_with(&folder, 0, &["wall", "studies/tiny", "--out", "wall.json", "--json"]));
    assert_eq!(told["arm"], "random", "the first arm that is random");
    assert_eq!((&told["point"], &told["member"]), (&Value::from(0), &Value::from(0)));
    assert_eq!(told["kn_pa_per_m"], 5e7);
    let wall: Value = serde_json::from_slice(&fs::read(folder.path("wall.json")).unwrap()).unwrap();
    let stones = wall["blocks"].as_array().unwrap().iter().filter(|b| b["tag"] == "stone").count();
    assert_eq!(told["stones"], stones);
    let stack = ["wall", "studies/tiny", "--arm", "stack", "--point", "1", "--out", "stack.json", "--json"];
    let told = json(&ends_with(&folder, 0, &stack));
    assert_eq!(
        (&told["arm"], &told["stones"]),
        (&Value::from("stack"), &Value::from(12)),
        "3 courses of 4 stones"
    );
    assert_eq!(told["kn_pa_per_m"], 1.75e8);
}

/// As many walls as a run is asked for have a number; a number of walls that would change nothing is refused.
#[test]
fn a_number_of_walls_is_heeded_or_refused() {
    let folder = Folder::with_study(STUDY);
    let ninth = ["wall", "studies/tiny", "--member", "8", "--members", "9", "--out", "wall.json"];
    assert!(stdout(&ends_with(&folder, 0, &ninth)).contains("arm random, member 8"));
    folder.write_study(&STUDY.replace("members = 8", "members = 1"));
    for verb in [&["run", "studies/tiny"][..], &["wall", "studies/tiny", "--out", "wall.json"]] {
        let error = stderr(&ends_with(&folder, 2, &[verb, &["--members", "9"]].concat()));
        assert!(error.contains("--members 9: every arm of tiny has one wall"), "{error}");
    }
    let second = ["wall", "studies/tiny", "--member", "1", "--out", "wall.json"];
    let error = stderr(&ends_with(&folder, 2, &second));
    assert!(error.contains("arm random has one wall, number 0; leave --member out"), "{error}");
}

#[test]
fn check_lists_the_keys_of_a_study() {
    let folder = Folder::with_study(STUDY);
    let text = stdout(&ends_with(&folder, 0, &["reference", "keys"])).to_string();
    for key in ["| `kn_pa_per_m` |", "| `dip_deg` |", "## `[solver]`"] {
        assert!(text.contains(key), "{key} in {text}");
    }
    let error = stderr(&ends_with(&folder, 2, &["check", "studies/tiny", "--keys"]));
    assert!(error.contains("`check --keys` is now `reference keys`"), "{error}");
}

#[test]
fn a_solved_wall_carries_its_displacements() {
    let folder = Folder::with_study(STUDY);
    let solved = ["wall", "studies/tiny", "--solved", "--out", "wall.vtu", "--json"];
    let told = json(&ends_with(&folder, 0, &solved));
    assert_eq!(told["outcome"], "equilibrium");
    let text = fs::read_to_string(folder.path("wall.vtu")).unwrap();
    // That of the corners comes first.
    let field = text.split("Name=\"displacement\"").nth(2).expect("a displacement field of the stones");
    let values = field.split('>').nth(1).unwrap().split('<').next().unwrap();
    let values: Vec<f64> = values.split_whitespace().map(|v| v.parse().unwrap()).collect();
    assert_eq!(values.len() as u64, 3 * told["stones"].as_u64().unwrap());
    assert!(values.iter().skip(1).step_by(3).all(|&y| y > 0.0), "the load presses every stone towards +y");
    let error = stderr(&ends_with(&folder, 2, &["wall", "studies/tiny", "--solved", "--out", "wall.obj"]));
    assert!(error.contains("--solved") && error.contains(".vtu"), "{error}");
}

#[test]
fn generate_says_why_there_is_no_wall_or_no_file() {
    let folder = Folder::with_study(STUDY);
    let error = stderr(&ends_with(&folder, 1, &["wall", "studies/tiny", "--out", "no/such/folder/wall.obj"]));
    assert!(error.contains("cannot write no/such/folder/wall.obj"), "{error}");
    let dip = "dip_deg = { family = \"uniform\", low = -3, high = 3 }";
    folder.write_study(&changed(dip, &format!("{dip}\nlimits = {{ max_aspect = 1.5, max_attempts = 3 }}")));
    let error = stderr(&ends_with(&folder, 1, &["wall", "studies/tiny", "--out", "wall.obj"]));
    assert!(
        error.contains("arm random, member 0: invalid geometry") && error.contains("3 attempts"),
        "{error}"
    );
    assert!(!folder.path("wall.obj").exists());
}

#[test]
fn run_shows_the_table_and_writes_the_files() {
    let folder = Folder::with_study(STUDY);
    let output = ends_with(&folder, 0, &["run", "studies/tiny", "--members", "2", "--solver", "explicit"]);
    assert!(
        stdout(&output).contains("random") && stdout(&output).contains("written to runs/tiny"),
        "{}",
        stdout(&output)
    );
    // Two random walls and the one of the stack bond, at two points; which of them ends last is not certain.
    let last = stderr(&output).lines().last().unwrap_or_default().to_string();
    assert!(
        last.starts_with("tiny: 6/6 done, 0 failed, mean 0.") && last.contains(" at kn "),
        "{}",
        stderr(&output)
    );
    for name in [
        "members.parquet",
        "steps.parquet",
        "summary.json",
        "manifest.json",
        "timing.csv",
        "figure-10.svg",
        "figure-10.png",
        "figure-10.csv",
    ] {
        assert!(folder.path("runs/tiny").join(name).is_file(), "{name}");
    }
    let output = ends_with(&folder, 0, &["run", "studies/tiny", "--members", "2", "--json"]);
    let file: Value =
        serde_json::from_slice(&fs::read(folder.path("runs/tiny/summary.json")).unwrap()).unwrap();
    assert_eq!(json(&output), file, "--json is the object of summary.json and nothing else");
    ends_with(&folder, 0, &["run", "studies/tiny", "--members", "2", "--variant", "slippery", "--seed", "9"]);
    let file: Value =
        serde_json::from_slice(&fs::read(folder.path("runs/tiny-slippery/summary.json")).unwrap()).unwrap();
    assert_eq!((&file["seed"], &file["variant"]), (&Value::from(9), &Value::from("slippery")));
}

/// `pirca ... | head` closes the pipe early: no error, no panic.
#[test]
fn a_closed_pipe_is_no_error() {
    let folder = Folder::with_study(STUDY);
    for arguments in
        [&["check", "studies/tiny"][..], &["check", "studies/tiny", "--json"], &["run", "--help"]]
    {
        let mut child =
            folder.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert_eq!(stderr(&output), "");
    }
}

#[test]
fn a_full_standard_output_is_an_error() {
    let folder = Folder::with_study(STUDY);
    let full = File::options().write(true).open("/dev/full").unwrap();
    let output = folder.command(&["check", "studies/tiny"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("cannot write to standard output: No space left"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_run_shows_an_earlier_one_of_the_same_study_beside_it() {
    let folder = Folder::with_study(STUDY);
    let run = |out: &str, more: &[&str], code: i32| {
        ends_with(&folder, code, &[&["run", "studies/tiny", "--members", "2", "--out", out], more].concat())
    };
    run("first", &["--solver", "implicit"], 0);
    run("second", &["--solver", "explicit", "--beside", "first"], 0);
    let figure = fs::read_to_string(folder.path("second/figure-10.svg")).unwrap();
    assert!(figure.contains("stack: mean of an earlier run (main reading, implicit solver)"), "{figure}");
    // Refused before anything is run.
    let error = stderr(&run("third", &["--beside", "nowhere"], 2));
    assert!(error.contains("--beside: cannot read nowhere/summary.json"), "{error}");
    assert!(!folder.path("third").exists());
}

#[test]
fn a_generated_wall_is_analysed_once_it_has_the_ground() {
    let folder = Folder::with_study(STUDY);
    ends_with(&folder, 0, &["wall", "studies/tiny", "--out", "loose.json"]);
    let error = stderr(&ends_with(&folder, 3, &["analyse", "loose.json", "--phi-deg", "35"]));
    assert!(error.contains("no support") && error.contains("pirca wall --with-base"), "{error}");
    for file in ["wall.json", "wall.obj"] {
        let told = ends_with(&folder, 0, &["wall", "studies/tiny", "--with-base", "--out", file, "--json"]);
        let answer = json(&ends_with(&folder, 0, &["analyse", file, "--phi-deg", "35", "--json"]));
        assert_eq!(answer["outcome"], "collapsed", "{answer}");
        let blocks = json(&told)["stones"].as_u64().expect("a count") + 1;
        assert_eq!(answer["blocks"], blocks, "the ground is no stone");
    }
}

/// What was measured is counted by `check` and set beside the results by `run`; a study that does not tilt says so.
#[test]
fn measurements_are_counted_and_compared() {
    let folder = Folder::with_study(STUDY);
    let rows = "a,random,,specimen_weight,1000,N,10,exact\na,random,,collapse_angle,15,deg,0.5,exact\n";
    let text = format!("specimen,family,tilt_deg,quantity,value,unit,error,kind\n{rows}");
    fs::write(folder.path("studies/tiny/measured.csv"), &text).unwrap();
    let said = stdout(&ends_with(&folder, 0, &["check", "studies/tiny"]));
    assert!(said.contains("measured: 2 values on 1 specimen\n"), "{said}");
    let checked = json(&ends_with(&folder, 0, &["check", "studies/tiny", "--json"]));
    assert_eq!((checked["measured"].as_u64(), checked["specimens"].as_u64()), (Some(2), Some(1)));
    let keys = stdout(&ends_with(&folder, 0, &["reference", "keys"]));
    assert!(keys.contains("## `measured.csv`") && keys.contains("| `common_error` | no |"), "{keys}");
    let run = ["run", "studies/tiny", "--members", "2", "--out", "out"];
    let ran = stdout(&ends_with(&folder, 0, &run));
    assert!(ran.contains("random, collapse angle: not compared: the walls are not tilted here"), "{ran}");
    let table = fs::read_to_string(folder.path("out/comparison.csv")).unwrap();
    // Two points of the weight, and the angle. A file that changed is another input, not another run.
    assert_eq!(table.lines().count(), 4, "{table}");
    let of_weight = table.lines().find(|line| line.contains("specimen_weight")).unwrap();
    let weight: f64 = of_weight.split(',').nth(19).unwrap().parse().unwrap();
    // 0.8 x 0.3 x 0.18 m3 at 2400 kg/m3 and 9.80665 m/s2, the standard gravity; head joints have no gap in this study.
    assert!((weight - 1_016.753_472).abs() < 1e-6, "{weight}");
    fs::write(folder.path("studies/tiny/measured.csv"), text.replace("1000", "1010")).unwrap();
    let again = ends_with(&folder, 0, &run);
    assert!(stderr(&again).contains("6 evaluations, 6 of them recorded before"), "{}", stderr(&again));
    fs::write(folder.path("studies/tiny/measured.csv"), text.replace("1000,N", "1000,kg")).unwrap();
    let refused = ends_with(&folder, 3, &["check", "studies/tiny"]);
    assert!(stderr(&refused).contains("measured.csv:2: unit = kg"), "{}", stderr(&refused));
}

/// The small study on a tilting table, stiff walls, with what was measured on them.
fn measured_on_a_table() -> Folder {
    let load = STUDY.split_once("[load]").and_then(|(_, rest)| rest.split_once("\n\n")).map(|(keys, _)| keys);
    let load = load.expect("the study has a load");
    let text = STUDY.replace(load, "\nprotocol = \"tilting\"\nstep_deg = 5\nbracket_deg = 0.2\n");
    let text =
        text.replace("ends = \"joint_springs\"", "ends = \"free\"").replace("unbalanced_ratio = 1e-4", "");
    let folder = Folder::with_study(&text.replace("[solver]", "[solver]\nname = \"implicit\""));
    let distributions = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions/mechanism");
    for mechanism in fs::read_dir(&distributions).unwrap().flatten() {
        let to = folder.path("distributions/mechanism").join(mechanism.file_name());
        fs::create_dir_all(&to).unwrap();
        for file in fs::read_dir(mechanism.path()).unwrap().flatten() {
            fs::copy(file.path(), to.join(file.file_name())).unwrap();
        }
    }
    folder
}

#[test]
fn detectability_writes_the_map_and_names_what_has_no_number() {
    let folder = measured_on_a_table();
    let without = stderr(&ends_with(&folder, 3, &["detectability", "studies/tiny"]));
    assert!(without.contains("measured.csv"), "{without}");
    fs::write(
        folder.path("studies/tiny/measured.csv"),
        "specimen,family,tilt_deg,quantity,value,unit,error,kind,resolution\n\
         A,stack,,collapse_angle,20,deg,0,rounded,0.5\n\
         A,stack,5,displacement_mean,1,mm,0.5,exact,\n\
         B,stack,80,displacement_mean,1,mm,0.5,exact,\n",
    )
    .unwrap();
    let arguments = ["detectability", "studies/tiny", "--members", "1", "--json", "--out"];
    let told = json(&ends_with(&folder, 0, &[&arguments[..], &["a", "--threads", "1"]].concat()));
    ends_with(&folder, 0, &[&arguments[..], &["b", "--threads", "2"]].concat());
    for name in ["detectability.csv", "detectability.json", "detectability.svg", "detectability.png"] {
        let read =
            |out: &str| fs::read(folder.path(out).join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(read("a"), read("b"), "{name}");
    }
    let rows = told["mechanisms"].as_array().unwrap();
    assert_eq!(rows.len(), 24);
    let cells = |name: &str| rows.iter().find(|row| row["mechanism"] == name).unwrap()["cells"].clone();
    assert_eq!(cells("rope_slack")[0]["outcome"], "not applicable");
    assert_eq!(cells("wedge_loss")[1]["note"], "there are no wedges");
    assert_eq!(cells("density")[2]["outcome"], "collapsed before the reading without it as well");
    // The offset of the prior's 84 % quantile, 5 mm times the normal quantile 0.99446, over the error of 0.5 mm.
    let errors = cells("gauge_offset")[1]["in_measurement_errors"].as_f64().unwrap();
    assert!((errors - 9.9446).abs() < 1e-3, "{errors}");
    let text = fs::read_to_string(folder.path("a/detectability.csv")).unwrap();
    assert_eq!(text.lines().count(), 1 + 24 * 3);
    let columns = text.lines().next().unwrap().split(',').count();
    assert!(text.lines().filter(|line| !line.contains('"')).all(|line| line.split(',').count() == columns));
    assert!(!text.contains("NaN") && !text.contains("inf"));
    // Two walls, which are the same: one alone gives no interval.
    let table = stdout(&ends_with(&folder, 0, &["detectability", "studies/tiny", "--members", "2"]));
    for said in [
        "tiny: data like these could see 9 of 24 mechanisms",
        "Seen: contact_inset (",
        "Not seen: ",
        "n/a",
        "runs/tiny-detectability",
    ] {
        assert!(table.contains(said), "{said} in: {table}");
    }
}

#[test]
fn a_verb_of_before_says_what_it_is_called_now() {
    let folder = Folder::with_study(STUDY);
    for (before, now) in
        [("influence", "`sensitivity`"), ("cite", "`report RUN --cite`"), ("picture", "`wall --out FILE`")]
    {
        let old = stderr(&ends_with(&folder, 2, &[before, "studies/tiny"]));
        assert!(old.contains(&format!("`{before}` is now {now}")), "{old}");
    }
    let swapped = stderr(&ends_with(&folder, 2, &["sensitivity", "studies/tiny", "--members", "1"]));
    assert!(swapped.contains("`detectability` now"), "{swapped}");
    // A slip of the pen is told as one.
    let slip = stderr(&ends_with(&folder, 2, &["sensitivity", "studies/tiny", "--pionts", "32"]));
    assert!(slip.contains("--points") && !slip.contains("detectability"), "{slip}");
}
