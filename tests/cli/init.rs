//! A program that lies anywhere: what is built into it, and the studies that it begins.

use std::fs;
use std::path::Path;
use std::process::Output;

use pirca::study::{Distributions, ElementStudy, Study, built_in_studies};
use serde_json::Value;

use crate::commands::stdout;
use crate::fixture::{Folder, STUDY, stderr};

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", stderr(output)))
}

/// Runs the program and checks its exit code.
fn ends_with(folder: &Folder, code: i32, arguments: &[&str]) -> Output {
    let output = folder.pirca(arguments);
    assert_eq!(output.status.code(), Some(code), "pirca {}: {}", arguments.join(" "), stderr(&output));
    output
}

/// The hash of the study in a folder.
fn hash(folder: &Path) -> String {
    if ElementStudy::is_in(folder) {
        return ElementStudy::load(folder).unwrap_or_else(|faults| panic!("{faults}")).hash;
    }
    Study::load(folder, None).unwrap_or_else(|faults| panic!("{faults}")).study.hash
}

#[test]
fn a_new_study_runs_as_it_is() {
    let folder = Folder::with_study(STUDY);
    let told = json(&ends_with(&folder, 0, &["init", "walls/first", "--json"]));
    assert_eq!(told["study"], "first");
    assert_eq!(told["files"], serde_json::json!(["study.toml", "study.schema.json", "README.md"]));
    let checked = ends_with(&folder, 0, &["check", "walls/first"]);
    assert_eq!(stderr(&checked), "", "nothing about it is odd");
    let ran = ends_with(&folder, 0, &["run", "walls/first", "--members", "2", "--json"]);
    let arms = json(&ran)["arms"].as_array().expect("it has arms").clone();
    let ended: Vec<_> = arms.iter().map(|arm| (&arm["arm"], &arm["outcomes"])).collect();
    let collapsed = |n: u64| serde_json::json!({ "collapsed": n });
    assert_eq!(ended, [(&"regular".into(), &collapsed(1)), (&"irregular".into(), &collapsed(2))]);
    let readme = fs::read_to_string(folder.path("walls/first/README.md")).unwrap();
    assert!(
        readme.contains("pirca run walls/first") && readme.contains("Change in `study.toml`"),
        "{readme}"
    );
}

/// Every key of the template is explained, what stands behind a # is its default, and no line is wider than a page.
#[test]
fn the_template_says_what_is_true() {
    let folder = Folder::with_study(STUDY);
    ends_with(&folder, 0, &["init", "first"]);
    let path = folder.path("first/study.toml");
    let text = fs::read_to_string(&path).unwrap();
    let own = hash(&folder.path("first"));
    let mut defaults = 0;
    for line in text.lines() {
        assert!(line.chars().count() <= 120, "{line}");
        let (key, off) = match line.strip_prefix("# ") {
            Some(rest) => (rest.split(" = ").next().unwrap_or_default(), true),
            None => (line.split(" = ").next().unwrap_or_default(), false),
        };
        let is_key = line.contains(" = ") && key.chars().all(|c| c.is_ascii_lowercase() || c == '_');
        if !is_key {
            continue;
        }
        assert!(line.trim_start_matches("# ").contains(" # "), "not explained: {line}");
        if off {
            fs::write(&path, text.replacen(line, line.trim_start_matches("# "), 1)).unwrap();
            let with = hash(&folder.path("first"));
            // The list of arms is no default: without it there is none.
            assert_eq!(with == own, key != "arms", "{line}");
            defaults += 1;
        }
    }
    assert_eq!(defaults, 10);
}

#[test]
fn every_built_in_study_is_copied_as_it_is() {
    let folder = Folder::with_study(STUDY);
    for study in built_in_studies() {
        ends_with(&folder, 0, &["init", &format!("copies/{}", study.name), "--from", study.name]);
        let copy = folder.path("copies").join(study.name);
        let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies").join(study.name);
        assert_eq!(hash(&copy), hash(&original), "{}", study.name);
        for (name, text) in &study.files {
            // But for the first line, which tells an editor where the schema lies.
            let here = text.replace("#:schema ../../schemas/", "#:schema ./");
            assert_eq!(fs::read_to_string(copy.join(name)).unwrap(), here, "{}/{name}", study.name);
        }
        let first = fs::read_to_string(copy.join("study.toml")).unwrap();
        let schema =
            first.lines().next().and_then(|line| line.strip_prefix("#:schema ./")).expect("it tells");
        assert!(copy.join(schema).is_file(), "{}: {schema}", study.name);
        // But for those that a study brings itself.
        let own = study.files.iter().any(|(name, _)| name.starts_with("distributions/"));
        assert_eq!(copy.join("distributions").exists(), own, "they are built in");
    }
}

/// What is built in is what lies in the repository's folders, and all of it.
#[test]
fn nothing_is_forgotten_that_should_be_built_in() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (on_disk, built_in) =
        (Distributions::only_in(&root.join("distributions")), Distributions::built_in());
    assert_eq!(on_disk.names(), built_in.names());
    let missing =
        on_disk.missing_from(&built_in, on_disk.names()).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(missing, []);
    let read = ["measured.csv", "published.toml", "study.toml"];
    let mut files: Vec<String> = fs::read_dir(root.join("studies"))
        .expect("studies can be listed")
        .flatten()
        .filter(|entry| entry.path().join("study.toml").is_file())
        // What others must bring the files of cannot be copied.
        .filter(|entry| !entry.path().join("prepare.py").is_file())
        .flat_map(|entry| {
            let here = read.into_iter().filter(|name| entry.path().join(name).is_file()).collect::<Vec<_>>();
            let own = Distributions::only_in(&entry.path().join("distributions"));
            let own = own.names().into_iter().map(|name| format!("distributions/{name}.toml"));
            let here = here.into_iter().map(str::to_owned).chain(own);
            here.map(|name| format!("{}/{name}", entry.file_name().to_string_lossy())).collect::<Vec<_>>()
        })
        .collect();
    files.sort();
    let studies = built_in_studies();
    let listed =
        studies.iter().flat_map(|study| study.files.iter().map(|(file, _)| format!("{}/{file}", study.name)));
    assert_eq!(listed.collect::<Vec<_>>(), files);
}

#[test]
fn an_existing_folder_and_an_unknown_study_are_refused() {
    let folder = Folder::with_study(STUDY);
    let error = stderr(&ends_with(&folder, 2, &["init", "studies/tiny"]));
    assert!(error.contains("studies/tiny is a folder with files in it"), "{error}");
    assert_eq!(fs::read_to_string(folder.path("studies/tiny/study.toml")).unwrap(), STUDY);
    let error = stderr(&ends_with(&folder, 2, &["init", "mine", "--from", "tiltingtable"]));
    for said in ["did you mean \"tilting-table\"?", "built in are: tilting-table, ", "joint-arrangement"] {
        assert!(error.contains(said), "{said} in: {error}");
    }
    ends_with(&folder, 2, &["init", "mine", "--from", "quite-another"]);
    ends_with(&folder, 2, &["init", ".."]);
    // A study with faults is not copied, and nothing of it stays.
    folder.write_study(&STUDY.replace("seed = 7", "seed = -7"));
    let error = stderr(&ends_with(&folder, 3, &["init", "mine", "--from", "studies/tiny"]));
    assert!(error.contains("study.seed = -7"), "{error}");
    assert!(!folder.path("mine").exists());
    // A path without a study is told what could be copied.
    let error = stderr(&ends_with(&folder, 3, &["run", "mine"]));
    assert!(error.contains("pirca init mine --from"), "{error}");
}

/// A small file of distributions with one entry of sizes.
fn sizes(low: f64) -> String {
    format!(
        "quantity = \"size\"\nsymbol = \"l\"\nunit = \"m\"\n[length]\nfamily = \"uniform\"\nlow = {low}\nhigh = 0.25\n\
         status = \"assumed\"\nsource = \"a test\"\n"
    )
}

/// A study that takes the lengths of its stones from a file.
fn referring() -> String {
    let length = "length_m = { family = \"uniform\", low = 0.15, high = 0.25 }";
    assert!(STUDY.contains(length));
    STUDY.replace(length, "length_m = \"block/size:length\"")
}

#[test]
fn distributions_are_taken_beside_a_study_then_above_it_then_built_in() {
    let folder = Folder::with_study(&referring());
    let from = |part: &str| {
        let told = json(&ends_with(&folder, 0, &["check", "studies/tiny", "--json"]));
        let used = told["distributions"][0].clone();
        assert_eq!(used["reference"], "block/size:length");
        let place = used["from"].as_str().expect("a place").to_owned();
        assert!(place.ends_with(part), "{part} in {place}");
        let text = stdout(&ends_with(&folder, 0, &["check", "studies/tiny"]));
        assert!(text.contains(&format!("distribution: block/size from {part}")), "{text}");
        told["study_hash"].as_str().expect("a hash").to_owned()
    };
    let built_in = from("built-in:distributions/block/size.toml");
    let mut hashes = vec![built_in];
    for (place, low) in
        [("distributions", 0.15), ("studies/distributions", 0.16), ("studies/tiny/distributions", 0.17)]
    {
        fs::create_dir_all(folder.path(place).join("block")).unwrap();
        // A folder that lacks the file is passed by.
        assert_eq!(&from(&place_of(hashes.len())), hashes.last().unwrap());
        fs::write(folder.path(place).join("block/size.toml"), sizes(low)).unwrap();
        hashes.push(from(&format!("{place}/block/size.toml")));
    }
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), 4, "each place says something else");
}

/// Where the lengths come from once so many places have been filled.
fn place_of(filled: usize) -> String {
    let place = ["built-in:distributions", "distributions", "studies/distributions"][filled - 1];
    format!("{place}/block/size.toml")
}

#[test]
fn a_copy_brings_the_distributions_that_it_would_not_find() {
    let folder = Folder::with_study(&referring());
    let own = folder.path("distributions/block/size.toml");
    fs::create_dir_all(own.parent().unwrap()).unwrap();
    fs::write(&own, sizes(0.15)).unwrap();
    fs::write(folder.path("distributions/block/other.toml"), sizes(0.15)).unwrap();
    // Below the same folder nothing needs to be brought.
    let near = json(&ends_with(&folder, 0, &["init", "near", "--from", "studies/tiny", "--json"]));
    assert_eq!(near["files"], serde_json::json!(["study.toml", "study.schema.json", "README.md"]));
    // In another one it is: to a place with a file of that name that says something else, and to a place without.
    let elsewhere = Folder::with_study(STUDY);
    let original = folder.path("studies/tiny");
    let original_shown = original.to_str().unwrap();
    for place in ["copy", "other/copy"] {
        let there = elsewhere.path(place);
        if let Some(parent) = there.parent().filter(|_| place.contains('/')) {
            fs::create_dir_all(parent.join("distributions/block")).unwrap();
            fs::write(parent.join("distributions/block/size.toml"), sizes(0.2)).unwrap();
        }
        let told = json(&ends_with(&elsewhere, 0, &["init", place, "--from", original_shown, "--json"]));
        assert_eq!(
            told["files"],
            serde_json::json!([
                "study.toml",
                "study.schema.json",
                "distributions/block/size.toml",
                "README.md"
            ])
        );
        assert_eq!(hash(&there), hash(&original));
    }
    // What is built in is brought, too, where something else stands in its way.
    let told =
        json(&ends_with(&elsewhere, 0, &["init", "other/ja", "--from", "joint-arrangement", "--json"]));
    assert!(told["files"].as_array().unwrap().contains(&"distributions/block/size.toml".into()), "{told}");
    let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/joint-arrangement");
    assert_eq!(hash(&elsewhere.path("other/ja")), hash(&original));
}

/// A table that a study takes distributions from is a part of it, wherever in its folder it lies.
#[test]
fn a_copy_brings_the_surveys_of_a_study() {
    let arm = "length_m = { family = \"empirical\", values = \"tables/stones.csv:length_m\" }";
    let length = STUDY.lines().find(|line| line.starts_with("length_m = {")).expect("a random arm");
    let folder = Folder::with_study(&STUDY.replacen(length, arm, 1));
    fs::create_dir_all(folder.path("studies/tiny/tables")).unwrap();
    fs::write(folder.path("studies/tiny/tables/stones.csv"), "length_m\n0.18\n0.22\n0.2\n").unwrap();
    let told = json(&ends_with(&folder, 0, &["init", "copy", "--from", "studies/tiny", "--json"]));
    let files = ["study.toml", "study.schema.json", "tables/stones.csv", "README.md"];
    assert_eq!(told["files"], serde_json::json!(files));
    assert_eq!(hash(&folder.path("copy")), hash(&folder.path("studies/tiny")));
}

/// A schema on the net is left as it is told.
#[test]
fn a_copy_tells_editors_of_the_schema_beside_it() {
    for (first, expected) in [
        ("#:schema https://example.org/own.json\n", "#:schema https://example.org/own.json"),
        ("#:schema ../../schemas/study.schema.json\n", "#:schema ./study.schema.json"),
        ("", "#:schema ./study.schema.json"),
    ] {
        let folder = Folder::with_study(&format!("{first}{STUDY}"));
        ends_with(&folder, 0, &["init", "copy", "--from", "studies/tiny"]);
        let text = fs::read_to_string(folder.path("copy/study.toml")).unwrap();
        assert_eq!(text.lines().next(), Some(expected));
        assert_eq!(text.split_once("\n").expect("lines").1.trim_start(), STUDY.trim_start());
    }
}

/// The program in an empty folder: the priors, the manifest of a run.
#[test]
fn an_empty_folder_is_enough() {
    let folder = Folder::with_study(&referring());
    let listed = ends_with(&folder, 0, &["reference", "causes"]);
    assert!(stdout(&listed).contains("creep: Shear tractions that relax"), "{}", stdout(&listed));
    let listed = ends_with(&folder, 0, &["reference", "priors"]);
    let said = stdout(&listed);
    assert!(said.contains("joint/friction: friction angle of a joint, phi (deg)"), "{said}");
    assert!(said.contains("limestone: 35 to 36; literature, source paper Table 10"), "{said}");
    assert!(!said.contains("mechanism/"), "{said}");
    let density = ends_with(&folder, 0, &["reference", "priors", "block/density", "--json"]);
    let density: Value = serde_json::from_slice(&density.stdout).expect("JSON");
    let entry = &density["priors"]["block/density"]["entries"]["paper-table-5"];
    assert_eq!(entry["family"]["value"].as_f64(), Some(2400.0), "{density}");
    let refused = ends_with(&folder, 2, &["reference", "priors", "mortar"]);
    assert!(stderr(&refused).contains("there are no such distributions; allowed is"), "{}", stderr(&refused));
    let refused = ends_with(&folder, 3, &["reference", "causes", "--distributions", "nowhere"]);
    assert!(stderr(&refused).contains("there is no such folder"), "{}", stderr(&refused));
    ends_with(&folder, 0, &["run", "studies/tiny", "--members", "1", "--solver", "implicit", "--out", "out"]);
    let manifest: Value =
        serde_json::from_slice(&fs::read(folder.path("out/manifest.json")).unwrap()).unwrap();
    let inputs = manifest["inputs"].as_object().expect("its inputs");
    let names: Vec<&String> = inputs.keys().collect();
    assert_eq!(names, ["built-in:distributions/block/size.toml", "study.toml"]);
    // The hash of the file in the repository.
    let text = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions/block/size.toml")).unwrap();
    let told = inputs["built-in:distributions/block/size.toml"].as_str().unwrap().to_string();
    assert_eq!(told.len(), 64);
    fs::create_dir_all(folder.path("distributions/block")).unwrap();
    fs::write(folder.path("distributions/block/size.toml"), text).unwrap();
    let again = ends_with(
        &folder,
        0,
        &["run", "studies/tiny", "--members", "1", "--solver", "implicit", "--out", "on-disk"],
    );
    assert_eq!(again.status.code(), Some(0));
    let manifest: Value =
        serde_json::from_slice(&fs::read(folder.path("on-disk/manifest.json")).unwrap()).unwrap();
    assert_eq!(manifest["inputs"]["distributions/block/size.toml"].as_str(), Some(told.as_str()));
}
