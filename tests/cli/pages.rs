//! What README.md, docs/ and the studies' READMEs show of the program is what the program does: every block ```console is run.
//!
//! A block begins with `$ pirca ...`; what follows up to the next command is its output. A line `...` stands for any number of
//! lines, `[..]` for anything within a line (seconds, say). A block ```json before it is `wall.json`. Blocks ```console,slow
//! simulate many walls and are run on demand.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A command of a page, and what is shown of its output.
struct Example {
    page: String,
    /// What the folder holds as `wall.json`.
    wall: Option<String>,
    command: String,
    shown: Vec<String>,
    slow: bool,
}

/// The pages that speak to users.
fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let below = |folder: &str| fs::read_dir(root.join(folder)).expect("a folder of the repository");
    let mut pages = vec![root.join("README.md")];
    pages.extend(below("docs").map(|entry| entry.expect("a file").path()));
    pages.extend(below("studies").map(|entry| entry.expect("a folder").path().join("README.md")));
    pages.retain(|page| page.is_file() && page.extension().is_some_and(|ending| ending == "md"));
    pages.sort();
    pages
}

/// The examples of a page.
fn examples(page: &str, text: &str) -> Vec<Example> {
    let (mut all, mut wall): (Vec<Example>, _) = (Vec::new(), None);
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let Some(kind) = line.strip_prefix("```") else { continue };
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        match kind {
            "json" => wall = Some(block.join("\n")),
            "console" | "console,slow" => {
                for line in block {
                    match (line.strip_prefix("$ pirca "), all.last_mut()) {
                        (Some(command), _) => all.push(Example {
                            page: page.to_string(),
                            wall: wall.clone(),
                            command: command.to_string(),
                            shown: Vec::new(),
                            slow: kind == "console,slow",
                        }),
                        (None, Some(example)) => example.shown.push(line.to_string()),
                        (None, None) => panic!("{page}: a block that begins with no command: {line}"),
                    }
                }
            }
            _ => {}
        }
    }
    all
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

/// Runs an example beside the repository's studies, and compares what it prints.
fn holds(example: &Example, number: usize) {
    let Example { page, command, shown, .. } = example;
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("page-{number}-{}", example.slow));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a scratch folder");
    for name in ["studies", "distributions"] {
        std::os::unix::fs::symlink(root.join(name), folder.join(name)).expect("a link");
    }
    if let Some(wall) = &example.wall {
        fs::write(folder.join("wall.json"), wall).expect("a scratch file");
    }
    let ran = Command::new(env!("CARGO_BIN_EXE_pirca"))
        .args(command.split_whitespace())
        .current_dir(&folder)
        .output()
        .expect("it is built");
    let output = String::from_utf8_lossy(&ran.stdout).into_owned();
    let errors = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert!(ran.status.success(), "{page}: pirca {command}: {errors}");
    let lines: Vec<&str> = output.lines().map(str::trim_end).collect();
    assert!(
        shows(shown, &lines),
        "{page}: pirca {command} is shown with\n{}\n\nbut prints\n{output}",
        shown.join("\n")
    );
    let _ = fs::remove_dir_all(&folder);
}

fn all(slow: bool) -> Vec<Example> {
    let of = |page: &PathBuf| {
        let text = fs::read_to_string(page).expect("a page");
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        examples(&page.strip_prefix(root).unwrap_or(page).display().to_string(), &text)
    };
    pages().iter().flat_map(of).filter(|example| example.slow == slow).collect()
}

#[test]
fn what_the_pages_show_is_what_the_program_prints() {
    let quick = all(false);
    assert!(quick.len() >= 3, "the README alone has three");
    quick.iter().enumerate().for_each(|(number, example)| holds(example, number));
}

#[test]
#[ignore = "simulates the walls of an example: minutes"]
fn what_the_pages_show_of_long_commands_is_what_they_print() {
    all(true).iter().enumerate().for_each(|(number, example)| holds(example, number));
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
    let page = "```json\n{}\n```\n\n```console\n$ pirca check x\nok\n$ pirca run x\n```\n";
    let found = examples("page", page);
    assert_eq!(found.iter().map(|e| e.command.as_str()).collect::<Vec<_>>(), ["check x", "run x"]);
    assert_eq!((found[0].wall.as_deref(), found[0].shown.len(), found[1].shown.len()), (Some("{}"), 1, 0));
}
