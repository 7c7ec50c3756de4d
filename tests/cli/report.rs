//! The pages of runs and of walls from files: what is on them, what does nothing on them, and folders that hold no run.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::fixture::{Folder, STUDY, stderr};
use crate::walls;

/// Run with three random walls.
const RUN: [&str; 6] = ["run", "studies/tiny", "--members", "3", "--out", "out"];

/// A folder with a finished run in `out`, and its page.
fn finished() -> (Folder, String) {
    let folder = Folder::with_study(STUDY);
    let output = folder.pirca(&[&RUN[..], &["--report"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = fs::read_to_string(folder.path("out/report.html")).expect("the page was written");
    (folder, page)
}

/// What stands in double quotes behind each occurrence of a text.
fn quoted<'p>(page: &'p str, before: &str) -> Vec<&'p str> {
    page.split(before).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

/// The page without our own scripts, which are its end.
fn markup(page: &str) -> &str {
    page.split("<script>\n").next().unwrap_or_default()
}

/// Every link leads somewhere on the page, no two places have one name, and nothing is fetched.
fn holds_together(page: &str) {
    let page = markup(page);
    let ids = quoted(page, " id=\"");
    let names: BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(ids.len(), names.len(), "a name comes twice");
    for link in quoted(page, "href=\"") {
        let to = link.strip_prefix('#');
        assert!(to.is_some_and(|to| names.contains(to)) || link == "data:,", "{link} leads nowhere");
    }
    for list in quoted(page, "aria-labelledby=\"") {
        assert!(list.split(' ').all(|name| names.contains(name)), "{list}");
    }
    for fetched in [" src=\"", "<link rel=\"stylesheet", "url(", "@import"] {
        assert!(!page.contains(fetched), "{fetched} fetches something");
    }
}

#[test]
fn a_run_comes_on_a_page_with_its_answer_its_walls_and_its_sources() {
    let (folder, page) = finished();
    holds_together(&page);
    let printed = folder.pirca(&RUN);
    let printed = String::from_utf8_lossy(&printed.stdout).into_owned();
    let first = printed.lines().find(|line| line.starts_with("tiny: ")).expect("the conclusion");
    for words in [
        "Does the machinery hold?",
        first,
        "<td>wall.height_m</td><td>0.3</td><td>stated in the study</td>",
        "<td>joint.sampling</td><td>area</td><td>default</td>",
        "<td>members</td><td>3</td><td>asked for with the command</td>",
        "<td>dip_deg</td><td>uniform, low -3.0, high 3.0</td>",
        "pirca run studies&#x2f;tiny --members 3 --out out --report",
        "The weakest wall: number ",
        "The median wall: number ",
        "The strongest wall: number ",
        "Intervals are at 95 %",
        "@software{pirca",
    ] {
        assert!(page.contains(words), "{words} is not on the page");
    }
    // The stack bond at two stiffnesses and three random walls at both.
    let rows = quoted(&page, "<tr id=\"").len();
    assert_eq!((rows, quoted(&page, "<a href=\"#wall-").len()), (8, 5), "three marks lead to drawings");
    assert_eq!(quoted(&page, "<a href=\"#figure-").len(), 3);
}

#[test]
fn a_page_is_written_again_from_the_folder_alone() {
    let (folder, page) = finished();
    fs::remove_file(folder.path("out/report.html")).unwrap();
    let output = folder.pirca(&["report", "out", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let told: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
    assert_eq!((&told["evaluations"], &told["page"]), (&Value::from(8), &Value::from("out/report.html")));
    assert!(fs::read_to_string(folder.path("out/report.html")).unwrap() == page, "the same bytes");
    // What else the run wrote is left alone, and a run that says nothing of its command has a page as well.
    fs::remove_file(folder.path("out/command.json")).unwrap();
    let output = folder.pirca(&["report", "out", "--out", "elsewhere.html"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let other = fs::read_to_string(folder.path("elsewhere.html")).unwrap();
    assert!(other.contains("<td>command</td><td>not recorded</td>"));
    holds_together(&other);
}

#[test]
fn a_folder_without_such_a_run_is_refused_in_one_sentence() {
    let (folder, _) = finished();
    let refused = |arguments: &[&str], code: i32, words: &str| {
        let output = folder.pirca(&[&["report"], arguments].concat());
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        let said = stderr(&output);
        assert!(said.contains(words) && said.trim_end().lines().count() == 1, "{words} in {said}");
    };
    refused(&["nowhere"], 1, "nowhere: there is no such folder; give the folder that pirca run wrote to");
    refused(&["studies"], 1, "studies: holds no run: it has no manifest.json; give the folder");
    let manifest = fs::read_to_string(folder.path("out/manifest.json")).unwrap();
    let with = |text: &str| fs::write(folder.path("out/manifest.json"), text).unwrap();
    let own = env!("CARGO_PKG_VERSION");
    with(&manifest.replacen(&format!("\"version\": \"{own}\""), "\"version\": \"0.0.9\"", 1));
    refused(&["out"], 1, &format!("the run is of pirca 0.0.9, and this is pirca {own}; use that version"));
    with("{\"version\": 3}");
    refused(&["out"], 1, "its manifest.json is not that of a run");
    fs::remove_file(folder.path("out/manifest.json")).unwrap();
    refused(
        &["out"],
        1,
        "the run was stopped before its manifest.json was written; start the same pirca run again",
    );
    with(&manifest);
    let journal = fs::read_to_string(folder.path("out/journal.jsonl")).unwrap();
    let lines: Vec<&str> = journal.lines().collect();
    fs::write(folder.path("out/journal.jsonl"), lines[..lines.len() - 2].join("\n") + "\n").unwrap();
    refused(&["out"], 1, "2 of 8 walls are not evaluated yet; start the same pirca run again");
    fs::write(folder.path("out/journal.jsonl"), &journal).unwrap();
    folder.write_study(&STUDY.replacen("phi_deg = 35", "phi_deg = 36", 1));
    refused(&["out"], 1, "the study is another one than was run (joint.phi_deg: ");
    fs::rename(folder.path("studies/tiny"), folder.path("studies/moved")).unwrap();
    refused(&["out"], 3, "the study tiny of the run is neither where it was run from nor in studies/");
    // Where it went to, as it was.
    fs::write(folder.path("studies/moved/study.toml"), STUDY).unwrap();
    let output = folder.pirca(&["report", "out", "--study", "studies/moved"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

/// Asks a question of the study and looks at its page, which a later answer without one takes away.
fn asked(folder: &Folder, arguments: &[&str], words: &[&str]) {
    let out = arguments[0];
    let all = [&[arguments[0], "studies/tiny"], &arguments[1..], &["--out", out, "--report"]].concat();
    let output = folder.pirca(&all);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = fs::read_to_string(folder.path(format!("{out}/report.html"))).expect("the page was written");
    holds_together(&page);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    // What the terminal says first stands there in one line.
    let first = said.split_whitespace().take(6).collect::<Vec<_>>().join(" ");
    for part in words.iter().copied().chain([
        &format!("<p class=\"verdict\">{first}")[..],
        "<td>joint.sampling</td>",
        "Intervals are at 95 %",
        "@software{pirca",
    ]) {
        assert!(page.contains(part), "{out}: {part} is not on the page");
    }
    // That of an earlier answer is not left beside a later one.
    let output = folder.pirca(&all[..all.len() - 1]);
    removes_the_page(&folder.path(out), &output);
}

/// A command without a page took away that of an earlier one, and says so in a line.
fn removes_the_page(out: &Path, output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
    assert!(!out.join("report.html").exists(), "{}", out.display());
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(
        said.matches("was of an earlier answer and is removed; --report writes it").count(),
        1,
        "{said}"
    );
}

#[test]
fn a_run_leaves_no_page_of_fewer_walls_and_no_figure_that_it_does_not_draw() {
    let (folder, _) = finished();
    removes_the_page(
        &folder.path("out"),
        &folder.pirca(&["run", "studies/tiny", "--members", "5", "--out", "out"]),
    );
    let again = folder.pirca(&["run", "studies/tiny", "--members", "5", "--out", "out"]);
    assert!(!String::from_utf8_lossy(&again.stdout).contains("is removed"), "there was none");
    // One stiffness beside an earlier run has a figure, and alone has none.
    folder.write_study(&STUDY.replace("[5e7, 1.75e8]", "[5e7]"));
    let one = ["run", "studies/tiny", "--members", "3", "--out", "one"];
    let figure = folder.path("one/figure-10.svg");
    for (more, is_drawn) in [(&["--beside", "out"][..], true), (&[], false)] {
        let output = folder.pirca(&[&one[..], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert_eq!(figure.exists(), is_drawn, "{more:?}");
    }
    assert!(folder.path("one/figure-10.csv").is_file());
    let output = folder.pirca(&[&one[..], &["--report"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = fs::read_to_string(folder.path("one/report.html")).expect("the page was written");
    holds_together(&page);
    assert!(!page.contains("id=\"figures\""), "no heading without a figure");
}

#[test]
fn an_answer_on_a_wall_leaves_no_figure_of_an_earlier_one() {
    let folder = walls::Folder::new();
    fs::write(folder.path("tower.obj"), walls::GOOD_OBJ).unwrap();
    let answered = |phi: &str| {
        let output = folder.pirca(&["analyse", "tower.obj", "--phi-deg", phi, "--out", "seen"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        folder.path("seen/uncertainty.svg").exists()
    };
    assert!(answered("30..38"), "the figure of the ranges");
    fs::write(folder.path("seen/notes.txt"), "of the user").unwrap();
    assert!(!answered("35"), "a number has none");
    assert!(folder.path("seen/notes.txt").exists() && folder.path("seen/wall.json").exists());
}

#[test]
fn what_was_asked_of_a_study_comes_on_a_page_if_it_is_asked_for() {
    let folder = Folder::with_study(STUDY);
    asked(
        &folder,
        &["capacity", "--members", "20", "--above-m", "0.001"],
        &[
            "How probable is a top displacement above 1.00 mm?",
            "Answers (",
            "id=\"figure-probability\"",
            "plain sampling",
        ],
    );
    asked(
        &folder,
        &["compare", "--walls", "40"],
        &[
            "Which arm is the best by the mean top displacement",
            "Every pair of arms (1)",
            "id=\"figure-compare\"",
        ],
    );
    asked(
        &folder,
        &["sensitivity", "--points", "32"],
        &["Shares of the variance in %", "id=\"figure-sensitivity\"", "Sobol"],
    );
    asked(
        &folder,
        &["plan-tests", "--specimens", "3", "--members", "12"],
        &["What do 3 specimens of each arm tell", "<th scope=\"col\">seen from</th>", "Student&#x27;s test"],
    );
}

#[test]
fn what_needs_published_or_measured_numbers_or_plates_comes_on_a_page_as_well() {
    let published = Folder::with_study(&STUDY.replace("top_thickness_m = 0.16", "top_thickness_m = 0.2"));
    let falls =
        "[[claim]]\nclaim = \"it falls\"\nsource = \"a test\"\ntest = \"falls_with_kn\"\nwhy = \"A test.\"\n";
    fs::write(published.path("studies/tiny/published.toml"), falls).expect("a file");
    asked(
        &published,
        &["readings", "--members", "2", "--departures", "1"],
        &["<summary>Readings, the best ones first", "<h3>Statements</h3>", "id=\"figure-readings\""],
    );
    asked(
        &published,
        &["homogenise", "--arms", "random", "--cells", "2", "--stones", "2,4", "--point", "0"],
        &["<summary>Stiffness at kn of the arm", "<h3>Size of the cells</h3>", "id=\"figure-scatter\""],
    );
    let towers = Folder::with_study(include_str!("../../studies/hidden-effects/example/study.toml"));
    let measured = include_str!("fixtures/diagnose/gauge-offset.csv");
    fs::write(towers.path("studies/tiny/measured.csv"), measured).expect("a file");
    asked(
        &towers,
        &["detectability", "--members", "1"],
        &["<h3>What each mechanism was</h3>", "<summary>Family ", "id=\"figure-detectability\""],
    );
}

#[test]
fn a_study_and_a_wall_come_on_a_page_by_their_own_names() {
    let folder = Folder::with_study(STUDY);
    let told = |arguments: &[&str], code: i32| {
        let output = folder.pirca(arguments);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        (String::from_utf8_lossy(&output.stdout).into_owned(), stderr(&output))
    };
    // A study is run first; its page goes where it is asked for, and its run to the usual folder.
    told(&["report", "studies/tiny", "--out", "study.html"], 0);
    let page = fs::read_to_string(folder.path("study.html")).unwrap();
    assert!(page.contains("<p>Study tiny</p>") && folder.path("runs/tiny/summary.json").is_file());
    assert!(!folder.path("runs/tiny/report.html").exists());
    let (_, error) = told(&["report", "studies/tiny", "--study", "studies/tiny"], 2);
    assert!(error.contains("--study is for the folder of a run"), "{error}");
    // A variant that says what it sets is known again by that.
    told(&["run", "studies/tiny", "--members", "2", "--variant", "joint.phi_deg=32"], 0);
    told(&["report", "runs/tiny-joint.phi_deg=32"], 0);
    let page = fs::read_to_string(folder.path("runs/tiny-joint.phi_deg=32/report.html")).unwrap();
    assert!(page.contains("<td>joint.phi_deg</td><td>32.0</td><td>asked for with the command</td>"));
    // A wall is analysed as is asked behind the dashes.
    fs::write(folder.path("tower.obj"), walls::GOOD_OBJ).unwrap();
    let (said, _) = told(&["report", "tower.obj", "--out", "tower.html", "--", "--phi-deg", "35"], 0);
    assert!(
        said.contains("The wall collapses at a tilt of") && said.ends_with("written to tower.html\n"),
        "{said}"
    );
    let page = fs::read_to_string(folder.path("tower.html")).unwrap();
    holds_together(&page);
    assert!(page.contains("<td>35 deg</td>"));
    told(&["analyse", "tower.obj", "--phi-deg", "35", "--report"], 0);
    assert!(folder.path("tower-report.html").is_file());
    let (_, error) = told(&["report", "tower.obj"], 0);
    assert!(error.contains("taken where nothing is stated: friction 25..38 deg"), "{error}");
    let (_, error) = told(&["report", "tower.obj", "--", "--phi-deg", "35", "--frobnicate"], 2);
    assert!(error.contains("unexpected argument '--frobnicate'"), "{error}");
    let (_, error) = told(&["report", "runs/tiny", "--", "--phi-deg", "35"], 2);
    assert!(error.contains("what stands behind -- is for a wall from a file"), "{error}");
}

/// A study of two types of elements that end at once.
fn few_elements(folder: &Folder) {
    let whole = include_str!("../../studies/element-types/study.toml");
    let from = |name: &str| whole.find(&format!("[[element]]\nname = \"{name}\"")).expect("an element");
    let end = from("clumps-with-overlap");
    folder
        .write_study(&whole[..end].replace("members = 5", "members = 2").replace("../../schemas", "schemas"));
}

#[test]
fn a_study_of_elements_has_a_page_with_its_table_and_its_inputs() {
    let folder = Folder::with_study(STUDY);
    few_elements(&folder);
    let output = folder.pirca(&["report", "studies/tiny", "--out", "page.html"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let page = fs::read_to_string(folder.path("page.html")).expect("the page");
    for part in [
        "Types of elements in study tiny",
        "2 of 2 types do not stand: aligned-spheres, sphere-cloud.",
        "aligned-spheres",
        "falls under gravity (2 of 2)",
        "cube.side_m",
    ] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn assemblies_that_are_there_are_not_shoved_again() {
    let folder = Folder::with_study(STUDY);
    few_elements(&folder);
    let run = |more: &[&str]| {
        let output = folder.pirca(&[&["run", "studies/tiny", "--out", "out"], more].concat());
        assert!(output.status.success(), "{}", stderr(&output));
        let read = |name: &str| fs::read_to_string(folder.path("out").join(name)).expect("a table");
        (read("elements.csv"), read("timing.csv"))
    };
    let (few, first) = run(&[]);
    let (more, second) = run(&["--members", "4", "--threads", "3"]);
    let anew = folder.pirca(&["run", "studies/tiny", "--out", "anew", "--members", "4"]);
    assert!(anew.status.success(), "{}", stderr(&anew));
    assert_eq!(fs::read_to_string(folder.path("anew/elements.csv")).expect("a table"), more);
    assert!(few.lines().all(|line| more.contains(line)), "{more}");
    // Times are those of the run that computed an assembly: none of the first run's is measured again.
    assert!(first.lines().all(|line| second.contains(line)), "{first}{second}");
    assert_eq!(second.lines().filter(|line| line.ends_with(",3")).count(), 2, "{second}");
    let run_alone = folder.pirca(&["report", "out"]);
    assert_eq!(run_alone.status.code(), Some(3));
    assert!(stderr(&run_alone).contains("give its study"), "{}", stderr(&run_alone));
    let other = folder.pirca(&["run", "studies/tiny", "--out", "out", "--seed", "5"]);
    assert_eq!(other.status.code(), Some(1), "{}", stderr(&other));
    assert!(stderr(&other).contains("of another study"), "{}", stderr(&other));
}

/// Names that would do something if they were markup.
const NAME: &str = "<img src=x onerror=alert(1)>";
const WORDS: &str = "<script>alert(2)</script> & \\\"more\\\"";

fn does_nothing(page: &str) {
    let page = markup(page);
    for tag in ["<img", "<script>alert", "onerror=alert(1)>"] {
        assert!(!page.contains(tag), "{tag} is on the page as markup");
    }
    assert!(page.contains("&lt;img src=x onerror=alert(1)&gt;"), "the name is there to be read");
}

#[test]
fn markup_in_the_names_of_a_study_does_nothing() {
    let folder = Folder::with_study(STUDY);
    let study = format!("studies/{NAME}");
    fs::create_dir(folder.path(&study)).unwrap();
    let text = STUDY.replacen("Does the machinery hold?", WORDS, 1);
    fs::write(folder.path(&study).join("study.toml"), text).unwrap();
    let output = folder.pirca(&["run", &study, "--members", "2", "--out", "out", "--report"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = fs::read_to_string(folder.path("out/report.html")).unwrap();
    does_nothing(&page);
    assert!(page.contains("&lt;script&gt;alert(2)&lt;&#x2f;script&gt; &amp; &quot;more&quot;"));
}

#[test]
fn a_wall_from_a_file_comes_on_a_page_and_markup_in_its_names_does_nothing() {
    let folder = walls::Folder::new();
    let file = format!("{NAME}.obj");
    fs::write(folder.path(&file), walls::GOOD_OBJ.replacen("o Stone", &format!("o {NAME}"), 1)).unwrap();
    let output = folder.pirca(&["analyse", &file, "--phi-deg", "35", "--out", "seen"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let page = fs::read_to_string(folder.path("seen/report.html")).expect("the page was written");
    holds_together(&page);
    does_nothing(&page);
    let headline = said.lines().next().expect("an answer");
    for words in [
        "At which tilt towards y+ does the wall fall?",
        headline,
        "<td>friction angle of the joints</td><td>35 deg</td>",
        "Blocks (3)",
        "Joints (2)",
        "SHA-256 of the file",
    ] {
        assert!(page.contains(words), "{words} is not on the page");
    }
}
