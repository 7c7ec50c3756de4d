//! What fits the program into a shell and an editor: completions, pages for man, schemas, citations, colour, and silence.

use std::fs;
use std::path::Path;
use std::process::Output;

use pirca::study::Schema;
use serde_json::Value;

use crate::fixture::{Folder, STUDY, changed, stderr};

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn done(folder: &Folder, arguments: &[&str]) -> String {
    let output = folder.pirca(arguments);
    assert_eq!(output.status.code(), Some(0), "pirca {}: {}", arguments.join(" "), stderr(&output));
    stdout(&output)
}

/// Verbs as the help lists them.
fn verbs(folder: &Folder) -> Vec<String> {
    let whole = done(folder, &["--help"]);
    let listed = whole.split("\nOptions:").next().unwrap_or_default().lines();
    listed.filter_map(|line| Some(line.strip_prefix("  ")?.split_whitespace().next()?.to_owned())).collect()
}

#[test]
fn every_shell_completes_every_verb_and_its_options() {
    let folder = Folder::with_study(STUDY);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = done(&folder, &["reference", "completions", shell]);
        for known in verbs(&folder).iter().map(String::as_str).chain(["members", "half-width", "quiet"]) {
            assert!(script.contains(known), "{known} is missing in the completions of {shell}");
        }
    }
    let wrong = folder.pirca(&["reference", "completions", "cmd"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(stderr(&wrong).contains("possible values"), "{}", stderr(&wrong));
}

#[test]
fn every_verb_has_a_page_for_man() {
    let folder = Folder::with_study(STUDY);
    done(&folder, &["reference", "man", "--out", "man"]);
    let verbs = verbs(&folder);
    assert!(verbs.len() > 10, "{verbs:?}");
    let steps = ["pirca.1".to_owned(), "pirca-shards-plan.1".to_owned()];
    for page in verbs.iter().map(|verb| format!("pirca-{verb}.1")).chain(steps) {
        let text = fs::read_to_string(folder.path("man").join(&page)).expect("a page");
        assert!(text.contains(".TH pirca"), "{page}: {text}");
        assert!(text.contains("Example") && text.contains("Exit codes: 0"), "{page}");
    }
    fs::write(folder.path("file"), "").expect("writable");
    let taken = folder.pirca(&["reference", "man", "--out", "file"]);
    assert_eq!(taken.status.code(), Some(1));
    assert!(stderr(&taken).starts_with("error: cannot create the folder"), "{}", stderr(&taken));
}

#[test]
fn the_schemas_in_the_repository_are_those_of_the_program() {
    let schemas = Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas");
    for schema in [Schema::Study, Schema::ElementStudy] {
        let text = fs::read_to_string(schemas.join(schema.file())).unwrap_or_default();
        let of = schema.file().trim_end_matches(".schema.json");
        assert!(
            text == schema.text(),
            "write it anew: pirca reference schema --of {of} --out schemas/{}",
            schema.file()
        );
    }
    let folder = Folder::with_study(STUDY);
    assert_eq!(done(&folder, &["reference", "schema"]), Schema::Study.text());
    done(&folder, &["reference", "schema", "--of", "published", "--out", "p.json"]);
    assert_eq!(fs::read_to_string(folder.path("p.json")).expect("written"), Schema::Published.text());
}

#[test]
fn a_run_says_how_to_cite_it() {
    let folder = Folder::with_study(STUDY);
    done(&folder, &["run", "studies/tiny", "--members", "2", "--out", "out"]);
    let manifest = fs::read_to_string(folder.path("out/manifest.json")).expect("a manifest");
    let manifest: Value = serde_json::from_str(&manifest).expect("JSON");
    let hash = manifest["study_hash"].as_str().expect("a hash");
    let said = format!("Version {}, study tiny, seed 7, study hash {hash}", env!("CARGO_PKG_VERSION"));
    let text = done(&folder, &["report", "out", "--cite"]);
    assert!(
        text.starts_with("The pirca developers: ") && text.trim_end().ends_with(&format!("{said}.")),
        "{text}"
    );
    let bibtex = done(&folder, &["report", "out", "--bibtex"]);
    assert!(bibtex.starts_with("@software{pirca,") && bibtex.contains(hash), "{bibtex}");
    let json: Value =
        serde_json::from_str(&done(&folder, &["report", "out", "--cite", "--json"])).expect("JSON");
    assert_eq!((&json["study_hash"], &json["bibtex"]), (&manifest["study_hash"], &bibtex.trim_end().into()));
    for (place, found) in [("studies/tiny", "holds no run"), ("nowhere", "there is no such folder")] {
        let wrong = folder.pirca(&["report", place, "--cite"]);
        assert_eq!(wrong.status.code(), Some(1));
        assert!(stderr(&wrong).contains(found), "{}", stderr(&wrong));
    }
}

#[test]
fn quiet_leaves_errors_alone_on_standard_error() {
    let noisy = changed("kn_pa_per_m = [5e7, 1.75e8]", "kn_pa_per_m = [5e5]");
    let folder = Folder::with_study(&noisy);
    let run = |quiet: &[&str], out: &str| {
        let output =
            folder.pirca(&[quiet, &["run", "studies/tiny", "--members", "2", "--out", out]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        (stdout(&output).replace(out, ""), stderr(&output))
    };
    let (said, noted) = run(&[], "loud");
    assert!(noted.contains("warning: study.toml") && noted.contains("done"), "{noted}");
    let (alone, nothing) = run(&["--quiet"], "quiet");
    assert_eq!((alone.as_str(), nothing.as_str()), (said.as_str(), ""));
    assert_eq!(run(&["-q"], "short").1, "");
    let wrong = folder.pirca(&["check", "nowhere", "--quiet"]);
    assert_eq!(wrong.status.code(), Some(3));
    assert!(stderr(&wrong).starts_with("error: no study"), "{}", stderr(&wrong));
}

/// A pipe is no terminal: it gets bare text unless colour is asked for by the usual variable.
#[test]
fn colour_is_for_terminals() {
    const ESCAPE: char = '\u{1b}';
    let folder = Folder::with_study(&changed("kn_pa_per_m = [5e7, 1.75e8]", "kn_pa_per_m = [5e5]"));
    let run = |forced: bool, arguments: &[&str]| {
        let mut command = folder.command(arguments);
        command.env_remove("CLICOLOR_FORCE").env_remove("NO_COLOR");
        if forced {
            command.env("CLICOLOR_FORCE", "1");
        }
        let output = command.output().expect("it starts");
        (stdout(&output), stderr(&output))
    };
    const RUN: &[&str] = &["run", "studies/tiny", "--members", "2", "--out", "out"];
    for arguments in [RUN, &["check", "nowhere"], &["--help"]] {
        let (said, told) = run(false, arguments);
        assert!(!said.contains(ESCAPE) && !told.contains(ESCAPE), "{said}{told}");
    }
    let (said, told) = run(true, RUN);
    assert!(said.contains("\u{1b}[1m"), "a head of a table in bold: {said}");
    assert!(told.contains("\u{1b}[33m\u{1b}[1mwarning:\u{1b}[0m"), "{told}");
    let (_, told) = run(true, &["check", "nowhere"]);
    assert!(told.starts_with("\u{1b}[31m\u{1b}[1merror:\u{1b}[0m no study"), "{told:?}");
}
