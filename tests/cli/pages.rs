//! What README.md, docs/ and the studies' READMEs show of the program is what the program does: every block ```console is run.
//!
//! A block begins with `$ pirca ...`; what follows up to the next command is its output. A line `...` stands for any number of
//! lines, `[..]` for anything within a line (seconds, say). Blocks ```console,slow simulate many walls and are run on demand;
//! a block ```console,exit-3 shows what is said by a command that ends with that code.
//!
//! The commands of a page are run one after another in one folder, as a reader would. A block ```json is its `wall.json`, a block
//! whose language is followed by a name, as ```toml mine/study.toml, the file of that name.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a page has the reader do.
#[derive(Debug, PartialEq)]
enum Step {
    /// Write a file.
    Write { name: String, text: String },
    /// Save a picture of the page.
    Save(String),
    /// Type a command.
    Run(Example),
}

/// A command of a page, and what is shown of its output.
#[derive(Debug, PartialEq)]
struct Example {
    command: String,
    shown: Vec<String>,
    slow: bool,
    exit: i32,
}

/// The repository.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The pages that speak to users, by their paths in the repository.
pub fn pages() -> Vec<PathBuf> {
    let mut pages = vec![root().join("README.md"), root().join("src/references.md")];
    let mut folders = vec![root().join("docs"), root().join("studies")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder of the repository") {
            let path = entry.expect("a file").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                pages.push(path);
            }
        }
    }
    pages.iter_mut().for_each(|page| *page = page.strip_prefix(root()).expect("it lies there").to_path_buf());
    pages.sort();
    pages
}

/// The text of a page.
pub fn text(page: &Path) -> String {
    fs::read_to_string(root().join(page)).expect("a page")
}

/// What a page has the reader do, in order.
fn steps(page: &Path, text: &str) -> Vec<Step> {
    let mut all = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let Some(kind) = line.strip_prefix("```") else {
            all.extend(picture(line).map(Step::Save));
            continue;
        };
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        let file = match kind.split_once(' ') {
            Some((_, name)) => Some(name),
            None if kind == "json" => Some("wall.json"),
            None => None,
        };
        if let Some(name) = file {
            all.push(Step::Write { name: name.to_string(), text: block.join("\n") + "\n" });
        }
        let (language, how) = kind.split_once(',').unwrap_or((kind, ""));
        if language != "console" {
            continue;
        }
        let exit = how.strip_prefix("exit-").map_or(0, |code| code.parse().expect("a number"));
        assert!(matches!(how, "" | "slow") || exit > 0, "{}: {kind}", page.display());
        for line in block {
            match (line.strip_prefix("$ pirca "), all.last_mut()) {
                (Some(command), _) => all.push(Step::Run(Example {
                    command: command.to_string(),
                    shown: Vec::new(),
                    slow: how == "slow",
                    exit,
                })),
                (None, Some(Step::Run(example))) => example.shown.push(line.to_string()),
                _ => panic!("{}: a block that begins with no command: {line}", page.display()),
            }
        }
    }
    all
}

/// The picture beside the page that a line shows.
fn picture(line: &str) -> Option<String> {
    let name = line.strip_prefix("![")?.split_once("](")?.1.strip_suffix(')')?;
    (name.ends_with(".png") && !name.contains('/')).then(|| name.to_owned())
}

/// Whether a line is what is shown, `[..]` standing for anything.
fn same(shown: &str, line: &str) -> bool {
    let mut parts = shown.split("[..]");
    let Some(mut rest) = parts.next().and_then(|first| line.strip_prefix(first)) else { return false };
    let parts: Vec<&str> = parts.collect();
    let Some((last, inner)) = parts.split_last() else { return rest.is_empty() };
    for part in inner {
        match rest.find(part) {
            Some(at) => rest = &rest[at + part.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

/// Whether an output is what is shown, a line `...` standing for any lines.
fn shows(shown: &[String], output: &[&str]) -> bool {
    match shown.split_first() {
        None => output.is_empty(),
        Some((first, rest)) if first == "..." => (0..=output.len()).any(|from| shows(rest, &output[from..])),
        Some((first, rest)) => {
            output.split_first().is_some_and(|(line, left)| same(first, line) && shows(rest, left))
        }
    }
}

/// The words of a command; quotes hold together what has blanks.
fn words(command: &str) -> Vec<String> {
    let parts = command.split('"').enumerate();
    parts
        .flat_map(|(k, part)| if k % 2 == 1 { vec![part] } else { part.split_whitespace().collect() })
        .map(String::from)
        .collect()
}

/// Runs a command in a folder, and compares what it prints.
fn holds(page: &Path, example: &Example, folder: &Path) {
    let (page, Example { command, shown, exit, .. }) = (page.display(), example);
    let ran = Command::new(env!("CARGO_BIN_EXE_pirca"))
        .args(words(command))
        .current_dir(folder)
        .output()
        .expect("it is built");
    let errors = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(*exit), "{page}: pirca {command}: {errors}");
    let output = if *exit == 0 { String::from_utf8_lossy(&ran.stdout) } else { errors };
    let lines: Vec<&str> = output.lines().map(str::trim_end).collect();
    assert!(
        shows(shown, &lines),
        "{page}: pirca {command} is shown with\n{}\n\nbut prints\n{output}",
        shown.join("\n")
    );
}

/// Does what a page has the reader do, beside the repository's studies; how many commands that were.
fn follow(page: &Path, slow: bool) -> usize {
    let steps = steps(page, &text(page));
    let has = |wanted: bool| steps.iter().any(|step| matches!(step, Step::Run(own) if own.slow == wanted));
    if !has(slow) {
        return 0;
    }
    let name = page.display().to_string().replace('/', "-");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("page-{name}-{slow}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a scratch folder");
    for name in ["studies", "distributions"] {
        std::os::unix::fs::symlink(root().join(name), folder.join(name)).expect("a link");
    }
    let mut count = 0;
    for step in &steps {
        match step {
            Step::Write { name, text } => {
                let path = folder.join(name);
                fs::create_dir_all(path.parent().expect("it has one")).expect("a scratch folder");
                fs::write(path, text).expect("a scratch file");
            }
            Step::Save(name) => {
                fs::copy(root().join(page).with_file_name(name), folder.join(name))
                    .expect("a picture beside the page");
            }
            // What is slow may need what was done before it.
            Step::Run(example) if slow || !example.slow => {
                holds(page, example, &folder);
                count += 1;
            }
            Step::Run(_) => {}
        }
    }
    let _ = fs::remove_dir_all(&folder);
    count
}

/// Whether a page belongs to the manual; the others are README.md and those of the studies.
fn is_manual(page: &Path) -> bool {
    page.starts_with("docs")
}

/// How many commands of those pages were run, each of which prints what is shown.
fn followed(wanted: impl Fn(&Path) -> bool, slow: bool) -> usize {
    pages().iter().filter(|page| wanted(page)).map(|page| follow(page, slow)).sum()
}

#[test]
fn what_the_readme_and_the_studies_show_is_what_the_program_prints() {
    let count = followed(|page| !is_manual(page), false);
    assert!(count >= 4, "they have more than {count} commands");
}

#[test]
fn what_the_manual_shows_is_what_the_program_prints() {
    let count = followed(is_manual, false);
    assert!(count >= 30, "it has more than {count} commands");
}

#[test]
#[ignore = "simulates the walls of an example: minutes"]
fn what_the_readme_and_the_studies_show_of_long_commands_is_what_they_print() {
    assert!(followed(|page| !is_manual(page), true) > 0, "they have long commands");
}

#[test]
#[ignore = "slow: diagnoses an example, minutes"]
fn what_the_manual_shows_of_long_commands_is_what_they_print() {
    assert!(followed(is_manual, true) > 0, "it has long commands");
}

#[test]
fn an_output_that_differs_is_seen() {
    let shown = |text: &str| text.lines().map(String::from).collect::<Vec<_>>();
    let output = ["collapses at 18.435 deg", "  0.001 s", "end"];
    assert!(shows(&shown("collapses at 18.435 deg\n  [..] s\nend"), &output));
    assert!(shows(&shown("collapses at [..] deg\n...\nend"), &output));
    assert!(shows(&shown("...\nend"), &output) && shows(&shown("..."), &output));
    assert!(!shows(&shown("collapses at 18.436 deg\n...\nend"), &output));
    assert!(!shows(&shown("collapses at 18.435 deg\n  [..] s"), &output));
    assert!(!shows(&shown("...\n  [..] m\nend"), &output));
    let page = "```json\n{}\n```\n\n```csv a/b.csv\nx\n```\n```console,exit-3\n$ pirca check x\nno\n$ pirca run \"a b\" c\n```\n";
    let found = steps(Path::new("page"), page);
    let [Step::Write { name, text }, Step::Write { name: other, .. }, Step::Run(first), Step::Run(second)] =
        &found[..]
    else {
        panic!("{found:?}")
    };
    assert_eq!([name, text, other], ["wall.json", "{}\n", "a/b.csv"]);
    assert_eq!((first.command.as_str(), first.exit, first.shown.len()), ("check x", 3, 1));
    assert_eq!(
        (words(&second.command), second.shown.len()),
        (vec!["run".into(), "a b".into(), "c".into()], 0)
    );
}
