//! The command line: arguments, messages, exit codes. Nothing else in the library prints.

mod analyse;
mod arguments;
mod bank;
mod capacity;
mod check;
mod cite;
mod compare;
mod completions;
mod condition;
mod diagnose;
mod doing;
mod drawn;
mod elements;
mod failure;
mod frames;
mod generate;
mod help;
mod influence;
mod init;
mod judge;
mod locate;
mod man;
mod measured;
mod mechanisms;
mod one_wall;
mod origin;
mod output;
mod picture;
mod plan_tests;
mod progress;
mod question;
mod rare;
mod readings;
mod replayed;
mod report;
mod run;
mod schema;
mod sensitivity;
mod threads;

use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches};

use crate::cli::arguments::{Arguments, Verb};

/// Reads the arguments of the process, does what they ask, and gives the exit code: 0 done, 1 the run or its files
/// failed, 2 the arguments make no sense, 3 the study or the wall is invalid.
pub fn main() -> ExitCode {
    output::report_full_files();
    let matches = help::framed(Arguments::command()).try_get_matches();
    let arguments = match matches.and_then(|matches| Arguments::from_arg_matches(&matches)) {
        Ok(arguments) => arguments,
        Err(error) => return output::usage(&error),
    };
    output::set_quiet(arguments.quiet);
    let done = match &arguments.verb {
        Verb::Analyse(arguments) => analyse::analyse(arguments),
        Verb::Bank(arguments) => bank::bank(arguments),
        Verb::Capacity(arguments) => capacity::capacity(arguments),
        Verb::Check(arguments) => check::check(arguments),
        Verb::Cite(arguments) => cite::cite(arguments),
        Verb::Compare(arguments) => compare::compare(arguments),
        Verb::Completions(arguments) => completions::completions(arguments),
        Verb::Diagnose(arguments) => diagnose::diagnose(arguments),
        Verb::Generate(arguments) => generate::generate(arguments),
        Verb::Man(arguments) => man::man(arguments),
        Verb::Measured(arguments) => measured::measured(arguments),
        Verb::Influence(arguments) => influence::influence(arguments),
        Verb::Init(arguments) => init::init(arguments),
        Verb::Mechanisms(arguments) => mechanisms::mechanisms(arguments),
        Verb::Picture(arguments) => picture::picture(arguments),
        Verb::PlanTests(arguments) => plan_tests::plan_tests(arguments),
        Verb::Readings(arguments) => readings::readings(arguments),
        Verb::Report(arguments) => report::report(arguments),
        Verb::Run(arguments) => run::run(arguments),
        Verb::Schema(arguments) => schema::schema(arguments),
        Verb::Sensitivity(arguments) => sensitivity::sensitivity(arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            output::error(&failure.message());
            failure.code()
        }
    }
}
