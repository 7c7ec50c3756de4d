//! The manual in docs/: pages of the reference are what the program prints, every page is in the table of contents, and every link
//! leads somewhere.
//!
//! `PIRCA_REFERENCE=write cargo test --release --test cli reference` writes the pages of the reference anew.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

use crate::pages::{pages, root, text};

const COMMAND: &str = "PIRCA_REFERENCE=write cargo test --release --test cli reference";

/// What the program prints.
fn printed(arguments: &[&str]) -> String {
    let ran = Command::new(env!("CARGO_BIN_EXE_pirca"))
        .args(arguments)
        .current_dir(root())
        .output()
        .expect("it is built");
    assert!(ran.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8(ran.stdout).expect("it is text")
}

/// The verbs, in the order of the help.
fn verbs(help: &str) -> Vec<&str> {
    let lines = help.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let first = lines.filter_map(|line| line.split_whitespace().next());
    first
        .filter(|word| word.chars().all(|c| c.is_ascii_lowercase() || c == '-') && !word.starts_with('-'))
        .collect()
}

/// The steps of a verb that has some, in the order of its help.
fn steps(help: &str) -> Vec<&str> {
    let listed = help.split("Steps:\n").nth(1).or(help.split("What:\n").nth(1)).unwrap_or_default();
    let lines = listed.lines().take_while(|line| !line.starts_with(char::is_alphabetic));
    lines.filter(|line| line.starts_with("  ") && !line.starts_with("   ")).map(str::trim).collect()
}

/// The page of all commands.
fn commands() -> String {
    let help = printed(&["--help"]);
    let mut page = format!(
        "# Commands\n\nWhat `pirca --help` and `pirca VERB --help` print.\n\n<!-- Written by the program: {COMMAND} -->\n\n\
         ```text\n{}\n```\n",
        help.trim_end()
    );
    for verb in verbs(&help) {
        let whole = printed(&[verb, "--help"]);
        let _ = write!(page, "\n## pirca {verb}\n\n```text\n{}\n```\n", whole.trim_end());
        for step in steps(&whole) {
            let help = printed(&[verb, step, "--help"]);
            let _ = write!(page, "\n### pirca {verb} {step}\n\n```text\n{}\n```\n", help.trim_end());
        }
    }
    page
}

/// The page of all keys, and of the columns of measured.csv.
fn keys() -> String {
    let said = printed(&["reference", "keys"]);
    let keys = said.strip_prefix("## ").expect("tables of keys");
    format!(
        "# Keys\n\nEvery key of `study.toml`, of `published.toml` and of the files below `distributions`, and every column of \
         `measured.csv`, as `pirca reference keys` prints them.\n\n<!-- Written by the program: {COMMAND} -->\n\n## {}\n",
        keys.trim_end()
    )
}

/// The page of the columns of a run's tables: a heading for each table, and its columns with unit, kind and meaning.
fn columns() -> String {
    let said = printed(&["reference", "columns"]);
    let mut page = format!(
        "# Columns\n\nThe columns of the tables that `pirca run` writes, as `pirca reference columns` prints them. Those that do not \
         apply to a study are null. The columns of `measured.csv` are among the [keys](keys.md#measuredcsv).\n\n\
         <!-- Written by the program: {COMMAND} -->\n"
    );
    for line in said.lines() {
        let cells: Vec<&str> =
            line.trim().split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect();
        let _ = match cells[..] {
            [] => Ok(()),
            [name, unit, kind, meaning] => {
                writeln!(page, "| `{name}` | {unit} | {kind} | {meaning} |")
            }
            [title] if !line.starts_with(' ') => {
                let (name, what) = title.split_once(": ").unwrap_or((title, ""));
                let head = "| column | unit | kind | meaning |\n|---|---|---|---|";
                writeln!(page, "\n## {name}\n\nHolds {what}.\n\n{head}")
            }
            _ => panic!("neither a table nor a column: {line}"),
        };
    }
    page
}

/// The page of all causes that a diagnosis looks for: a heading for each, and its lines as a list.
fn causes() -> String {
    let mut page = format!(
        "# Causes\n\nWhat the base model leaves out, and a diagnosis looks for, as `pirca reference causes` prints it. Each is a table \
         `[mechanism.NAME]` that a study or one of its arms may have.\n\n<!-- Written by the program: {COMMAND} -->\n"
    );
    for line in printed(&["reference", "causes"]).lines() {
        let (depth, words) = (line.len() - line.trim_start().len(), line.trim_start());
        let _ = match (depth, words.split_once(": ")) {
            (0, Some((name, meaning))) => write!(page, "\n## {name}\n\n{meaning}\n\n"),
            (2, _) => writeln!(page, "- {words}"),
            (4, _) => writeln!(page, "  - {words}"),
            _ => {
                assert!(words.is_empty(), "neither a cause nor what is said of it: {line}");
                Ok(())
            }
        };
    }
    page
}

#[test]
fn the_reference_is_what_the_program_prints() {
    for (name, page) in
        [("commands", commands()), ("keys", keys()), ("columns", columns()), ("causes", causes())]
    {
        let path = root().join("docs/reference").join(name).with_extension("md");
        if std::env::var_os("PIRCA_REFERENCE").is_some_and(|value| value == "write") {
            fs::write(&path, &page).expect("a page");
        }
        let committed = fs::read_to_string(&path).unwrap_or_default();
        assert!(committed == page, "{} is not what the program prints: {COMMAND}", path.display());
    }
}

/// What a page holds for those who link: where it leads to, and its own places.
#[derive(Default)]
struct Links {
    to: Vec<String>,
    places: BTreeSet<String>,
}

/// The name of a heading in addresses, as GitHub and mdBook make it.
fn place(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>().to_lowercase()
}

fn links(text: &str) -> Links {
    let (mut found, mut heading) = (Links::default(), None::<String>);
    for event in Parser::new_ext(text, Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                found.to.push(dest_url.into_string());
            }
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::Text(words) | Event::Code(words) => {
                if let Some(heading) = &mut heading {
                    heading.push_str(&words);
                }
            }
            Event::End(TagEnd::Heading(_)) => {
                let own = place(&heading.take().unwrap_or_default());
                found.places.insert(own);
            }
            _ => {}
        }
    }
    found
}

/// A path without `..`, from the folder of a page.
fn resolved(page: &Path, link: &str) -> PathBuf {
    let mut path = page.parent().map(Path::to_path_buf).unwrap_or_default();
    for part in Path::new(link).components() {
        match part {
            Component::ParentDir => assert!(path.pop(), "{}: {link} leaves the repository", page.display()),
            Component::CurDir => {}
            part => path.push(part),
        }
    }
    path
}

#[test]
fn every_link_leads_somewhere() {
    let all: BTreeMap<PathBuf, Links> =
        pages().into_iter().map(|page| (page.clone(), links(&text(&page)))).collect();
    let (mut count, mut broken) = (0, Vec::new());
    for (page, links) in &all {
        for link in links.to.iter().filter(|link| !link.contains("://")) {
            count += 1;
            let (path, place) = link.split_once('#').unwrap_or((link, ""));
            let to = if path.is_empty() { page.clone() } else { resolved(page, path) };
            let there = root().join(&to).exists()
                && (place.is_empty() || all.get(&to).is_some_and(|own| own.places.contains(place)));
            if !there {
                broken.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert!(broken.is_empty(), "links to nowhere:\n{}", broken.join("\n"));
    assert!(count > 100, "the manual has more than {count} links");
}

#[test]
fn every_page_is_in_the_table_of_contents() {
    let summary = Path::new("docs/SUMMARY.md");
    let listed: Vec<PathBuf> = links(&text(summary)).to.iter().map(|link| resolved(summary, link)).collect();
    let all: BTreeSet<PathBuf> = pages().into_iter().filter(|page| page != summary).collect();
    assert_eq!(listed.iter().cloned().collect::<BTreeSet<_>>(), all, "docs/SUMMARY.md beside the pages");
    assert_eq!(listed.len(), all.len(), "each page once");
}

#[test]
fn headings_get_the_names_that_links_use() {
    assert_eq!(place("How is it built? Part 2: `kn`_x, and-so"), "how-is-it-built-part-2-kn_x-and-so");
    let found = links("# A `b`\n\n[x](y.md#z) ![p](q.svg)\n\n```text\n[no](link)\n```\n");
    assert_eq!(
        (found.to, found.places),
        (vec!["y.md#z".into(), "q.svg".into()], BTreeSet::from(["a-b".into()]))
    );
}
