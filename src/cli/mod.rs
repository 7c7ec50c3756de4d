//! The command line: arguments, messages, exit codes. Nothing else in the library prints.

mod arguments;
mod help;

use std::ffi::OsString;
use std::sync::{Arc, Mutex, PoisonError};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches};

use crate::cli::arguments::{Arguments, Verb};
use crate::interrupt;
pub use crate::terminal::answer::Answer;
pub use crate::terminal::failure::Failure;
pub use crate::terminal::session::Hear;
use crate::terminal::{output, session};
use crate::verb::{
    analyse, capacity, check, compare, detectability, diagnose, homogenise, init, plan_tests, readings,
    reference, report, run, sensitivity, shards, wall,
};

/// Does what arguments ask, of which the first is the name of the program, prints what comes out, and gives the exit code: 0 done,
/// 1 the run or its files failed, 2 the arguments make no sense, 3 the study or the wall is invalid, 4 a demand is not met and was to be.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    output::report_full_files();
    let given: Vec<OsString> = arguments.into_iter().collect();
    let _served = session::begin(shown(&given), None);
    let arguments = match read(given) {
        Ok(arguments) => arguments,
        Err(error) => return output::usage(&error),
    };
    output::set_quiet(arguments.quiet);
    let told = |answer: Answer| answer.tell(arguments.verb.is_json()).map(|()| answer.code);
    match done(&arguments.verb).and_then(told) {
        Ok(code) => code,
        Err(failure) => {
            output::failed(&failure);
            failure.code()
        }
    }
}

/// Does what arguments ask, without the name of the program, for another program: gives the answer where the command prints it, and lets
/// `hear` hear what the command says on standard error meanwhile.
///
/// One command is done at a time, on all processors: a second one waits. [`interrupt::ask`] stops those that go on.
///
/// # Errors
/// See [`Failure`]; its message is that of the command.
pub fn answered(arguments: Vec<OsString>, hear: Arc<Hear>) -> Result<Answer, Failure> {
    static ONE: Mutex<()> = Mutex::new(());
    interrupt::stoppable(|| {
        let _one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
        interrupt::look();
        let given: Vec<OsString> = std::iter::once(OsString::from("pirca")).chain(arguments).collect();
        let _served = session::begin(shown(&given), Some(hear));
        let arguments = read(given).map_err(|error| Failure::Usage(error.to_string()))?;
        output::set_quiet(arguments.quiet);
        done(&arguments.verb)
    })?
}

/// The arguments behind the name of the program, as text.
fn shown(given: &[OsString]) -> Vec<String> {
    given.iter().skip(1).map(|argument| argument.to_string_lossy().into_owned()).collect()
}

fn read(given: Vec<OsString>) -> Result<Arguments, clap::Error> {
    let verb = given.get(1).map(|verb| verb.to_string_lossy().into_owned()).unwrap_or_default();
    let matches = help::framed(Arguments::command()).try_get_matches_from(given);
    Arguments::from_arg_matches(&matches.map_err(|error| renamed(&verb, error))?)
}

/// What verbs of before are now.
const RENAMED: [(&str, &str); 13] = [
    ("influence", "`sensitivity`"),
    ("generate", "`wall --out FILE` with .vtu, .obj or .json"),
    ("picture", "`wall --out FILE` with .svg"),
    ("cite", "`report RUN --cite`"),
    ("shard", "`shards run`, and with --plan `shards plan`"),
    ("status", "`shards status`"),
    ("merge", "`shards merge`"),
    ("bank", "`diagnose --prepare`, with --bank for its folder"),
    ("measured", "`check STUDY --measured FILE`, and with --template `init FILE --measured STUDY`"),
    ("mechanisms", "`reference causes`"),
    ("completions", "`reference completions`"),
    ("man", "`reference man`"),
    ("schema", "`reference schema`"),
];

/// The error of arguments, with the new name of a verb that was renamed, or whose option belongs to another verb now.
fn renamed(verb: &str, error: clap::Error) -> clap::Error {
    let command = Arguments::command();
    let moved = |option: &str| {
        let verb = command.find_subcommand("detectability").expect("it is a verb");
        verb.get_arguments().any(|known| known.get_long() == option.strip_prefix("--"))
    };
    let words = match (verb, error.kind(), error.get(ContextKind::InvalidArg)) {
        (_, ErrorKind::InvalidSubcommand, _) => match RENAMED.iter().find(|(before, _)| *before == verb) {
            Some((before, now)) => format!("`{before}` is now {now}"),
            None => return error,
        },
        ("sensitivity", ErrorKind::UnknownArgument, Some(ContextValue::String(option))) if moved(option) => {
            "`sensitivity` shares a variance out to its sources; what data could show of causes is `detectability` now".to_owned()
        }
        ("check", ErrorKind::UnknownArgument, Some(ContextValue::String(option)))
            if ["--keys", "--columns"].contains(&option.as_str()) =>
        {
            format!("`check {option}` is now `reference {}`", option.trim_start_matches('-'))
        }
        _ => return error,
    };
    clap::Error::raw(error.kind(), format!("{words}\n"))
}

/// Does what a verb asks.
fn done(verb: &Verb) -> Result<Answer, Failure> {
    match verb {
        Verb::Analyse(arguments) => analyse::analyse(arguments),
        Verb::Capacity(arguments) => capacity::work::capacity(arguments),
        Verb::Check(arguments) => check::check(arguments),
        Verb::Compare(arguments) => compare::work::compare(arguments),
        Verb::Detectability(arguments) => detectability::work::detectability(arguments),
        Verb::Diagnose(arguments) => diagnose::work::diagnose(arguments),
        Verb::Homogenise(arguments) => homogenise::homogenise(arguments),
        Verb::Init(arguments) => init::init(arguments),
        Verb::PlanTests(arguments) => plan_tests::work::plan_tests(arguments),
        Verb::Readings(arguments) => readings::work::readings(arguments),
        Verb::Reference(arguments) => reference::reference(arguments, Arguments::command()),
        Verb::Report(arguments) => report::report(arguments),
        Verb::Run(arguments) => run::work::run(arguments),
        Verb::Sensitivity(arguments) => sensitivity::work::sensitivity(arguments),
        Verb::Shards(arguments) => shards::shards(arguments),
        Verb::Wall(arguments) => wall::wall(arguments),
    }
}
