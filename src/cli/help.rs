//! What frames the help: the verbs in groups, and the texts below the options of each. A paragraph is one line here, and is
//! wrapped to the terminal.

use std::fmt::Write;

use clap::builder::PossibleValue;
use clap::{Arg, Command};
use console::Term;

use crate::verb::codes;

/// Longer lines are hard to read, however wide the terminal is.
const WIDEST: usize = 100;
/// Lines that begin with so many spaces are to be typed.
const TYPED: usize = 8;
/// Columns before what is said of an option, which stands below its name.
const INDENT: usize = 10;

/// The verbs in the order in which they are met, under what they are about.
const GROUPS: [(&str, &[&str]); 5] = [
    ("One wall", &["analyse", "wall"]),
    (
        "Many walls",
        &["init", "check", "run", "report", "capacity", "compare", "sensitivity", "homogenise", "readings"],
    ),
    ("Measured walls", &["plan-tests", "detectability", "diagnose"]),
    ("Many machines", &["shards"]),
    ("To look up", &["reference"]),
];

/// Of the program.
pub(super) const WHOLE: &str = concat!(
    "\
Examples: pirca analyse wall.obj --phi-deg 35
          pirca init my-wall
          pirca run my-wall
          pirca run my-wall --variant joint.phi_deg=30

A study is a folder with a study.toml: which walls, under which load, by which solver. Each kind of wall in it is an arm; [sweep] gives a \
key several values. `pirca VERB --help` explains a verb. \
With --json it prints one JSON object; warnings and progress go to standard error, and nowhere with --quiet. \
NO_COLOR=1 keeps terminals plain.

",
    codes!()
);

/// The command with its verbs in groups, and all its texts wrapped to the terminal.
pub(super) fn framed(command: Command) -> Command {
    let columns = columns();
    wrapped(grouped(command), columns, columns)
}

/// Columns that the help fills: of the terminal, or of COLUMNS where there is none.
fn columns() -> usize {
    let terminal = Term::stdout().size_checked().or_else(|| Term::stderr().size_checked());
    let told = || std::env::var("COLUMNS").ok()?.parse().ok();
    terminal.map(|(_, columns)| usize::from(columns)).or_else(told).map_or(WIDEST, |n| n.clamp(40, WIDEST))
}

/// The command and its verbs with their texts in lines of so many columns, and what it does, as the command above lists it, in lines of
/// as many as are left there.
fn wrapped(mut command: Command, columns: usize, listed: usize) -> Command {
    if let Some(about) = command.get_about().map(ToString::to_string) {
        command = command.about(lines(&about, listed));
    }
    if let Some(about) = command.get_long_about().or(command.get_about()).map(ToString::to_string) {
        command = command.long_about(lines(&about, columns));
    }
    if let Some(after) = command.get_after_help().map(ToString::to_string) {
        command = command.after_help(lines(&after, columns));
    }
    command
        .next_line_help(true)
        .mut_args(|arg| said(arg, columns.saturating_sub(INDENT)))
        .mut_subcommands(|verb| wrapped(verb, columns, columns.saturating_sub(INDENT)))
}

/// An option with all that is said of it: what it is, its default, and what each of its values is.
fn said(arg: Arg, columns: usize) -> Arg {
    let Some(help) = arg.get_long_help().or(arg.get_help()).map(ToString::to_string) else { return arg };
    let mut text = help;
    let defaults: Vec<_> = arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    if !defaults.is_empty() && !arg.is_hide_default_value_set() && arg.get_action().takes_values() {
        let _ = write!(text, " [default: {}]", defaults.join(", "));
    }
    let values: Vec<PossibleValue> =
        if arg.get_action().takes_values() { arg.get_possible_values() } else { Vec::new() };
    for value in &values {
        let what = value.get_help().map(ToString::to_string).unwrap_or_default();
        let _ = write!(text, "\n- {}: {what}", value.get_name());
    }
    let text = lines(&text, columns);
    arg.hide_default_value(true).hide_possible_values(true).long_help(text.clone()).help(text)
}

/// The text with its lines broken at spaces so that none is longer than so many columns, where a space comes early enough. What is
/// to be typed stays whole: broken it would not work.
fn lines(text: &str, columns: usize) -> String {
    let mut broken = Vec::new();
    for line in text.lines() {
        let words = line.trim_start();
        let own = line.len() - words.len();
        if own >= TYPED || words.starts_with("Example") {
            broken.push(line.to_owned());
            continue;
        }
        let indent = if words.starts_with("- ") { own + 2 } else { own };
        let mut current = line[..own].to_owned();
        let mut is_empty = true;
        for word in words.split(' ') {
            if !is_empty && current.chars().count() + 1 + word.chars().count() > columns {
                broken.push(std::mem::replace(&mut current, " ".repeat(indent)));
                is_empty = true;
            }
            if !is_empty {
                current.push(' ');
            }
            current.push_str(word);
            is_empty = false;
        }
        broken.push(current);
    }
    broken.join("\n")
}

/// The command with its verbs in groups.
fn grouped(command: Command) -> Command {
    let header = command.get_styles().get_header();
    let template = format!(
        "{{name}} {{version}}\n{{about-with-newline}}\n{{usage-heading}} {{usage}}\n{}\n{header}Options:{header:#}\n{{options}}{{after-help}}",
        verbs(&command)
    );
    command.help_template(template)
}

/// A line for each verb, below the heading of its group.
fn verbs(command: &Command) -> String {
    let mut text = String::new();
    let header = command.get_styles().get_header();
    for (heading, verbs) in GROUPS {
        let _ = writeln!(text, "\n{header}{heading}:{header:#}");
        for verb in verbs.iter().filter_map(|name| command.find_subcommand(name)) {
            let about = verb.get_about().map(ToString::to_string).unwrap_or_default();
            let _ = writeln!(text, "  {:<14} {about}", verb.get_name());
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;
    use crate::cli::arguments::Arguments;
    use crate::study::built_in_studies;

    /// 80 columns: the narrowest terminal that is usual.
    #[test]
    fn every_verb_is_in_one_group_with_a_line_that_fits() {
        let command = Arguments::command();
        let listed: Vec<&str> = GROUPS.iter().flat_map(|(_, verbs)| verbs.iter().copied()).collect();
        for verb in command.get_subcommands().map(Command::get_name) {
            assert_eq!(listed.iter().filter(|name| **name == verb).count(), 1, "{verb} in {listed:?}");
        }
        for study in built_in_studies() {
            assert!(crate::verb::init::HELP.contains(study.name), "{} in the help of init", study.name);
        }
        assert_eq!(listed.len(), command.get_subcommands().count());
        for line in verbs(&command).lines() {
            assert!(line.len() <= 80, "{line}");
        }
    }

    #[test]
    fn lines_are_broken_at_spaces_and_keep_their_indent() {
        assert_eq!(lines("a bb ccc\n\n  dd eee\n- ff ggg", 6), "a bb\nccc\n\n  dd\n  eee\n- ff\n  ggg");
        assert_eq!(lines("abcdefgh i", 4), "abcdefgh\ni");
        assert_eq!(
            lines("Example: pirca run x\n         pirca y z", 9),
            "Example: pirca run x\n         pirca y z"
        );
    }

    /// Whatever the terminal, and whether all or the short help is asked for.
    #[test]
    fn no_line_of_help_is_wider_than_the_terminal() {
        for columns in [60, 80, 100] {
            let mut command = wrapped(grouped(Arguments::command()), columns, columns);
            command.build();
            // `help` lists the verbs again, a line each whatever the width.
            let verbs = command.get_subcommands().map(|verb| verb.get_name().to_owned());
            let verbs: Vec<String> = verbs.filter(|name| name != "help").collect();
            let mut texts = Vec::new();
            for verb in &verbs {
                let verb = command.find_subcommand_mut(verb).expect("it is listed");
                texts.extend([verb.render_help().to_string(), verb.render_long_help().to_string()]);
                let steps = verb.get_subcommands_mut();
                texts.extend(steps.map(|step| step.render_long_help().to_string()));
            }
            // What is to be typed is not broken: it would not work.
            let typed = |line: &str| line.contains("pirca ");
            for line in texts.iter().flat_map(|text| text.lines()).filter(|line| !typed(line)) {
                assert!(line.chars().count() <= columns, "{columns}: {line}");
            }
        }
    }
}
