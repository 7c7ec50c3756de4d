//! What frames the help: the verbs in groups, and the texts below the options of each. A paragraph is one line here, and is
//! wrapped to the terminal.

use std::fmt::Write;

use clap::builder::PossibleValue;
use clap::{Arg, Command};
use console::Term;

/// Longer lines are hard to read, however wide the terminal is.
const WIDEST: usize = 100;
/// Lines that begin with so many spaces are to be typed.
const TYPED: usize = 8;
/// Columns before what is said of an option, which stands below its name.
const INDENT: usize = 10;

/// The verbs in the order in which they are met, under what they are about.
const GROUPS: [(&str, &[&str]); 5] = [
    ("One wall", &["analyse", "generate", "picture"]),
    (
        "Many walls",
        &[
            "init",
            "check",
            "run",
            "report",
            "cite",
            "capacity",
            "compare",
            "influence",
            "homogenise",
            "readings",
        ],
    ),
    ("Many machines", &["shard", "status", "merge"]),
    ("Measured walls", &["plan-tests", "measured", "sensitivity", "bank", "diagnose", "mechanisms"]),
    ("Shell and editor", &["completions", "man", "schema"]),
];

macro_rules! codes {
    () => {
        "Exit codes: 0 done; 1 the run or a file failed; 2 wrong arguments; 3 invalid study or wall."
    };
}

/// Of the program.
pub(super) const WHOLE: &str = concat!(
    "\
Examples: pirca analyse wall.json --phi-deg 35
          pirca init my-wall
          pirca run my-wall

A study is a folder with a study.toml: which walls, under which load, by which solver. `pirca VERB --help` explains a verb. \
With --json it prints one JSON object; warnings and progress go to standard error, and nowhere with --quiet. \
NO_COLOR=1 keeps terminals plain.

",
    codes!()
);

/// Of `init`.
pub(super) const INIT: &str = concat!(
    "\
Example: pirca init my-wall
         pirca run my-wall
         pirca init my-tests --from tilting-table

Built in are arrangements, dry-shear-walls, earthquake, edge-restraint, element-types, homogenisation, joint-arrangement, sources-of-scatter, \
tilting-block and tilting-table. A folder that exists is left alone: choose another name.

",
    codes!()
);

/// Of `check`.
pub(super) const CHECK: &str = concat!(
    "Example: pirca check studies/joint-arrangement\n         pirca check studies/joint-arrangement --keys\n         pirca check studies/joint-arrangement --columns\n\n",
    codes!()
);

/// Of `generate`.
pub(super) const GENERATE: &str = concat!(
    "\
Example: pirca generate studies/joint-arrangement --arm irregular --member 17 --out wall.vtu
         pirca generate studies/tilting-block --with-base --out wall.json   (for pirca analyse)

",
    codes!(),
    "\nA wall whose geometry is invalid ends with 1 and the reason."
);

/// Of `picture`.
pub(super) const PICTURE: &str = concat!(
    "\
Example: pirca picture studies/tilting-table --arm sbl --member 0 --out wall.svg
         pirca picture studies/tilting-table --arm sbl --out wall.svg --series fall --frames fall/frames

The last state at rest is drawn in true size, the movement of the fall magnified. A wall that does not fall is drawn at rest, \
with its displacements magnified. Every way a wall can end is drawn, and ends with 0.

--frames and --series show the wall in at most 100 states: those at rest as the load grows, and where it falls up to 40 more in which \
the explicit solver lets it fall from the last one at rest, until a stone has gone 0.3 of the wall's height. Limit analysis has the \
mechanism further and further instead. A fall is in true size unless --magnify says otherwise.

",
    codes!(),
    "\nA wall whose geometry is invalid ends with 1 and the reason."
);

/// Of `run`.
pub(super) const RUN: &str = concat!(
    "\
Example: pirca run studies/joint-arrangement --members 5 --out runs/first-try
         pirca run studies/joint-arrangement --beside runs/explicit --out runs/both

Stopped and started again with the same arguments, it goes on where it stood and ends with the same files. With more members, \
another stiffness or another arm in the same folder it computes only what is new, and says what it takes over. A wall that falls or \
cannot be built is counted in the results; it is no error.

",
    codes!()
);

/// Of `shard`.
pub(super) const SHARD: &str = concat!(
    "\
Example: pirca shard studies/arrangements --plan --out runs/shared
         pirca shard studies/arrangements --plan slurm --out runs/shared > shards.sh
         pirca shard studies/arrangements --index 3 --of 64 --out runs/shared
         pirca shard studies/tilting-table --bank --index 3 --of 64 --out runs/bank

Shard I of N has the walls whose place in the order of the results leaves I when divided by N. A shard that is complete is not computed \
again, a damaged one is; of one that was stopped the walls that had ended are taken over. Shards of another study, seed, version \
or N are never mixed: that is an error, and nothing is changed. A wall that fails is a row of the results and no error; an exit code \
other than 0 means that the shard is not complete.

",
    codes!()
);

/// Of `status`.
pub(super) const STATUS: &str = concat!(
    "\
Example: pirca status runs/shared

What is missing is written as Slurm takes it: sbatch --array=$(pirca status runs/shared --json | jq -r .missing)

",
    codes!()
);

/// Of `merge`.
pub(super) const MERGE: &str = concat!(
    "\
Example: pirca merge runs/shared
         pirca merge runs/shared --partial

Every line of every shard is checked on the way. Shards that are missing end it with their numbers, unless --partial says that some \
are enough. Memory does not grow with the load steps of the walls, unless the study compares with measurements or shears its walls.

",
    codes!()
);

/// Of `report`.
pub(super) const REPORT: &str = concat!(
    "\
Example: pirca run studies/tilting-block --out runs/first
         pirca report runs/first
         pirca report runs/first --out for-a-colleague.html
         pirca report studies/tilting-block
         pirca report wall.json -- --phi-deg 35

A study is run first, as far as it has not been. Of a run the study must be as it was run. The walls that are drawn are solved again; no other wall is. `pirca run --report` writes the same \
page at the end of a run.

",
    codes!()
);

/// Of `capacity`.
pub(super) const CAPACITY: &str = concat!(
    "\
Example: pirca capacity studies/tilting-table --members 100
         pirca capacity studies/tilting-table --below-deg 12
         pirca capacity studies/tilting-table --quantile 0.05 --half-width 0.1
         pirca capacity studies/tilting-block --variant restrained-ends --below-deg 20 --walls 4000 --cov 0.2
         pirca generate studies/tilting-block --variant restrained-ends --draw 0 --out wall.vtu
         pirca capacity studies/tilting-table --measured --known-cov 0.1

Without a question it seeks the value that 5 % of walls lie below. It writes capacity.json, probability.svg, .png and .csv beside the \
files of the walls, and evaluations.parquet of walls drawn for a rare level. Intervals are at 95 %. A wall that brings no value is \
counted, and the \
interval that holds whatever it would have borne is given too. Characteristic and design values are those of EN 1990 Annex D, \
computed and not read from its tables; the design value is undercut with a probability of 0.1 %.

",
    codes!()
);

/// Of `influence`.
pub(super) const INFLUENCE: &str = concat!(
    "\
Example: pirca influence studies/tilting-block --points 64
         pirca influence studies/tilting-table --arm sbl --points 128 --json

First order: the share of the variance that would go if the source were known. Total: the share that would be left if all others \
were known. They differ by interactions. Sources are independent of each other, as a study cannot state a correlation; so Shapley's \
shares lie between the two and are not given. Intervals are at 95 %, over 16 independent randomisations.

Walls without a value are counted; a base point that lacks one is left out of the shares that need it. It writes influence.json, \
influence.csv, influence.parquet (every evaluation), influence.svg and influence.png. Stopped and started again, it goes on \
where it stood, with more --points as well unless the design is a Latin hypercube.

",
    codes!()
);

/// Of `compare`.
pub(super) const COMPARE: &str = concat!(
    "\
Example: pirca compare studies/arrangements
         pirca compare studies/arrangements --arms continuous,irregular --same-within-deg 0.1 --walls 2000
         pirca compare studies/tilting-table --arms sbl,sbr --below-deg 14

Without a question it compares means. It writes compare.json, compare.csv, a figure of the differences (compare.svg, compare.png), the \
distributions (distributions.csv, .svg, .png) and the files of the walls. Intervals hold together and at every number of walls, so \
that looking early costs nothing. Stopped and started again it goes on where it stood; with more --walls it goes on from there.

",
    codes!(),
    "\nAn answer, \"cannot be told apart\" and \"not decided\" all end with 0."
);

/// Of `homogenise`.
pub(super) const HOMOGENISE: &str = concat!(
    "\
Example: pirca homogenise studies/homogenisation
         pirca homogenise studies/homogenisation --arms random-heads --stones 4,8,16 --cells 100
         pirca homogenise studies/homogenisation --method associative,elastic --directions in-plane
         pirca homogenise studies/homogenisation --variant led --walls 200 --directions none

A cell repeats itself without end, and the image of a stone moves as the stone does and with the plate's strain. It writes \
homogenised.json, a line per cell (cells.csv), a line per point of its surface (surface.csv), sections of the surface (surface.svg, .png) and \
the COV against the size of the cells (scatter.svg, .png); with --walls a line per wall and plate (walls.csv) and how long each took \
(timing.csv). A mean has converged where it changes by less than its standard error as cells \
grow and sigma falls as 1/n; a mean that goes on changing is reported as an effect of size.

",
    codes!()
);

/// Of `readings`.
pub(super) const READINGS: &str = concat!(
    "\
Example: pirca readings studies/joint-arrangement
         pirca run studies/joint-arrangement --variant mean-size-varies+unequal-courses

A reading is the study with some of its variants, which must change different keys; variants of the solver are left out. Every \
reading is judged by the statements in published.toml. One that refutes two of them with its first walls at the ends of kn is \
dropped; the others are evaluated in full. It writes readings.csv, readings.json, readings.svg and readings.png.

",
    codes!()
);

/// Of `bank`.
pub(super) const BANK: &str = concat!(
    "\
Example: pirca bank studies/tilting-table --points 120

More points later leave the first ones as they are, in another folder. The priors are in mechanism and nuisance of the \
distributions that the study takes.

",
    codes!()
);

/// Of `diagnose`.
pub(super) const DIAGNOSE: &str = concat!(
    "\
Example: pirca diagnose studies/tilting-table --measured my-tests.csv

It writes verdict.json, figures as SVG and PNG (best-fit: the readings on the base model and on the best cause; one per family; \
residuals), with --report a page with all of it, report.html, and, for each \
cause of the verdict, the study extended by it: extended/<cause>. That is an ordinary study at the medians of what is not known, \
with draws from it as variants (run extended/<cause> --variant draw-07).

The walls it needs are simulated once for a design, which takes minutes to hours; see bank. What looks odd about the measurements \
(a value far beyond what is simulated, one specimen alone) is noted on standard error and judged all the same.

",
    codes!(),
    "\nEvery verdict (named, ambiguous, unexplained, nothing found) ends with 0."
);

/// Of `measured`.
pub(super) const MEASURED: &str = concat!(
    "\
Example: pirca measured studies/tilting-table --template --wide --out my-tests.csv
         pirca measured studies/tilting-table my-tests.csv

Commas, semicolons or tabs; decimals with a point, or with a comma where it does not separate; a row per value, or a row per tilt. \
`pirca check STUDY --keys` lists all columns and quantities. Every fault is told with its line.

",
    codes!()
);

/// Of `plan-tests`.
pub(super) const PLAN_TESTS: &str = concat!(
    "\
Example: pirca plan-tests studies/tilting-table --specimens 3
         pirca plan-tests studies/tilting-table --specimens 3 --cov 0.052 --error-deg 0.25

The walls of each arm are simulated as `run` does. Real specimens scatter by what simulated walls do and by the error of the reading; \
--cov states another scatter. A difference is seen by Student's test of two groups of specimens built of different stones. Where the same \
stones are laid twice, the pairs correlate as simulated walls do, and fewer suffice. It writes plan-tests.json and plan-tests.csv.

",
    codes!()
);

/// Of `sensitivity`.
pub(super) const SENSITIVITY: &str = concat!(
    "\
Example: pirca sensitivity studies/tilting-table --members 3 --out runs/sensitivity

It writes sensitivity.csv, sensitivity.json, sensitivity.svg and sensitivity.png. The strength of each mechanism comes from the \
priors in mechanism of the distributions that the study takes.

",
    codes!()
);

/// Of `mechanisms`.
pub(super) const MECHANISMS: &str = concat!(
    "\
Example: pirca mechanisms --json

A table [mechanism.creep] in a study, with its keys, switches creep on; [arm.mechanism.creep] does for one arm.

",
    codes!()
);

/// Of `cite`.
pub(super) const CITE: &str = concat!(
    "\
Example: pirca cite runs/tilting-block
         pirca cite runs/tilting-block --bibtex >> references.bib

Whoever runs that version on a study of that hash with that seed gets the same walls. The run must be of this version of pirca.

",
    codes!()
);

/// Of `completions`.
pub(super) const COMPLETIONS: &str = concat!(
    "\
Example: pirca completions bash > ~/.local/share/bash-completion/completions/pirca
         pirca completions zsh > ~/.zfunc/_pirca
         pirca completions fish > ~/.config/fish/completions/pirca.fish

Zsh reads ~/.zfunc if ~/.zshrc has the line fpath+=~/.zfunc before compinit. New shells know the completions.

",
    codes!()
);

/// Of `man`.
pub(super) const MAN: &str = concat!(
    "\
Example: pirca man --out ~/.local/share/man/man1
         man pirca-run

",
    codes!()
);

/// Of `schema`.
pub(super) const SCHEMA: &str = concat!(
    "\
Example: pirca schema --out study.schema.json
         pirca schema --of published --out published.schema.json

Editors with taplo (in VS Code: Even Better TOML) take it from the first line of a study: #:schema ./study.schema.json. \
`pirca init` writes both. The schema is made from the table of keys that `pirca check` goes by; what needs more than one key, and the \
references to distributions, `check` alone sees.

",
    codes!()
);

/// Of `analyse`.
pub(super) const ANALYSE: &str = concat!(
    "\
Example: pirca analyse wall.json --phi-deg 30
         pirca analyse arch.obj --unit mm --density-kg-per-m3 2300 --phi-deg 35
         pirca analyse wall.json --phi-deg 35 --solver explicit --kn 1e9 --json
         pirca analyse wall.json --phi-deg 35 --worst-direction --out seen
         pirca analyse wall.json --phi-deg 35 --load lateral --vertical 0.3 --dead-load 12=1500
         pirca analyse wall.json --phi-deg 35 --solver implicit --kn 1e9 --settle 0=0.01
         pirca analyse wall.json --phi-deg 35 --solver nonsmooth --fclib step.json --at-deg 5
         pirca analyse wall.json --phi-deg 30..38 --solver implicit --kn 5e7..5e8 --density normal(2200,80)

Ranges: of --phi-deg, --kn and --density a number, LOW..HIGH, or uniform(low, high), triangular(low, mode, high), normal(mean, sd), \
lognormal(mean, sd), truncated_normal(mean, sd, low, high), truncated_lognormal(median, log_sd, low, high). The wall is then solved \
with the middle values, at the ends of each parameter (the 5 and 95 % points of a distribution), and over a design. With --out the \
evaluations are in uncertainty.csv, .svg and .png.

wall.json: {\"unit\": \"m\", \"blocks\": [{\"id\": 0, \"vertices\": [[x, y, z], ...], \"faces\": [[i, j, k, ...], ...], \
\"density\": 2400, \"fixed\": false, \"tag\": \"stone\", \"group\": \"keystone\"}, ...]}. Convex blocks; faces count their \
block's vertices from 0, counter-clockwise seen from outside; z up. unit: m (default), cm, mm. density in kg/m^3, not needed where \
fixed is true. fixed (default false): a support. tag: stone, header, wedge, base, end or a word of your own; may be left out. group: \
blocks of the same group are one rigid body: divide a concave stone into convex parts. May be left out.

OBJ: one object (o, or g without any o) per block, z up (or --up y). A name that comes again goes on with the same block, unless each \
piece is a closed solid. A block is fixed when a word of its name is base, end, fixed, ground or support (base_0, \
Left_support.001). Objects keystone.part1, keystone.part2, ... are one rigid body. A comment \"# density 2400 kg/m^3\" holds for the \
next object.

In both, triangles of one plane are merged into faces; corners within 1e-4 of the block are one, also where each face has its own, \
and a corner may lie on the edge of another face. Joints have no tensile strength. Limits: 64 MiB, 50000 blocks, 2000 vertices and \
faces of a block in the file, 200 corners after merging; stones of 1 mm to 25 m; faces plane and convex to 1e-4 of the block (more \
with --flatness); overlaps up to 1 % of the smaller block, other than among the parts of a group.

",
    codes!(),
    "\nEvery way a wall can end (stable, collapsed, unstable at rest, not converged) ends with 0."
);

/// The command with its verbs in groups, and all its texts wrapped to the terminal.
pub(super) fn framed(command: Command) -> Command {
    wrapped(grouped(command), columns())
}

/// Columns that the help fills: of the terminal, or of COLUMNS where there is none.
fn columns() -> usize {
    let terminal = Term::stdout().size_checked().or_else(|| Term::stderr().size_checked());
    let told = || std::env::var("COLUMNS").ok()?.parse().ok();
    terminal.map(|(_, columns)| usize::from(columns)).or_else(told).map_or(WIDEST, |n| n.clamp(40, WIDEST))
}

/// The command and its verbs with their texts in lines of so many columns.
fn wrapped(mut command: Command, columns: usize) -> Command {
    if let Some(about) = command.get_about().map(ToString::to_string) {
        command = command.about(lines(&about, columns));
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
        .mut_subcommands(|verb| wrapped(verb, columns))
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
            let _ = writeln!(text, "  {:<12} {about}", verb.get_name());
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
            assert!(INIT.contains(study.name), "{} in {INIT}", study.name);
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
            let mut command = wrapped(grouped(Arguments::command()), columns);
            command.build();
            // `help` lists the verbs again, a line each whatever the width.
            let verbs = command.get_subcommands().map(|verb| verb.get_name().to_owned());
            let verbs: Vec<String> = verbs.filter(|name| name != "help").collect();
            let mut texts = Vec::new();
            for verb in &verbs {
                let verb = command.find_subcommand_mut(verb).expect("it is listed");
                texts.extend([verb.render_help().to_string(), verb.render_long_help().to_string()]);
            }
            // What is to be typed is not broken: it would not work.
            let typed = |line: &str| line.contains("pirca ");
            for line in texts.iter().flat_map(|text| text.lines()).filter(|line| !typed(line)) {
                assert!(line.chars().count() <= columns, "{columns}: {line}");
            }
        }
    }
}
