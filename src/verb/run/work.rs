//! `pirca run`: generate, solve, statistics, figures.

use std::path::PathBuf;

use crate::ensemble;
use crate::ensemble::{Quantity, Settings};
use crate::study::{ElementStudy, Study};
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::terminal::{output, progress};
use crate::verb::arguments::{Ensemble, SolverName};
use crate::verb::locate;
use crate::verb::run::answer::beside::Earlier;
use crate::verb::run::answer::demand::DemandSummary;
use crate::verb::run::answer::files::write_all;
use crate::verb::run::answer::table::terminal_table;
use crate::verb::run::ask::Run;
use crate::verb::run::origin::Origin;
use crate::verb::run::{elements, page};

/// Runs a study, or what is still missing of it, and says what came out.
pub(crate) fn run(arguments: &Run) -> Result<Answer, Failure> {
    with_page(arguments, None)
}

/// The same with its page, if it is asked for, in a file of its own.
pub(crate) fn with_page(arguments: &Run, page: Option<PathBuf>) -> Result<Answer, Failure> {
    let folder = locate::folder(&arguments.which.study)?;
    if ElementStudy::is_in(&folder) {
        return elements::run(&folder, arguments, page);
    }
    let loaded = locate::any_study(&arguments.which)?;
    let study = asked(loaded.study.clone(), arguments.solver, &arguments.ensemble)?;
    if arguments.report || arguments.beside.is_some() {
        locate::not_shaken(&study, page::SHAKEN)?;
    }
    let study = arguments.demanded.of(study)?;
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, ""));
    let quantity = Quantity::of(&study);
    let beside = arguments.beside.as_ref().map(|dir| Earlier::read(dir, &study.name, quantity));
    let beside = beside.transpose().map_err(|error| Failure::Usage(format!("--beside: {error:#}")))?;
    let settings = Settings { out: out.clone(), threads: arguments.threads };
    let rows = ensemble::run(&study, &settings, progress::on_stderr(&study).as_ref())?;
    let study = ensemble::come_to(study, &rows);
    let what = format!("statistics and figures of {} evaluations", rows.len());
    let summary = doing(&what, |_| write_all(&study, &rows, &out, beside.as_ref()))
        .map_err(|error| Failure::Run(format!("{error:#}")))?;
    let origin = Origin::now(&folder, arguments.threads);
    origin.write(&out)?;
    if arguments.csv {
        for (name, table) in ensemble::tables_as_csv(&rows) {
            ensemble::replace_file(&out.join(name), table.as_bytes())?;
        }
    }
    let is_beside = arguments.report && page.is_none();
    let removed = if is_beside { String::new() } else { page::without_page(&out)? };
    if arguments.report {
        let file = page.unwrap_or_else(|| out.join(page::PAGE));
        page::write(&file, (&study, &loaded), &rows, &origin)?;
    }
    let text = format!("{}\nwritten to {}\n{removed}", terminal_table(&summary).trim_end(), out.display());
    let answer = Answer::of(text, &summary)?.in_place(&out);
    // A demand of which nothing is known is not met.
    let at_most = summary.demand.as_ref().map_or(1.0, DemandSummary::at_most);
    Ok(arguments.demanded.judged(answer, at_most))
}

/// The study with what is asked for in the place of its own values.
pub(crate) fn asked(
    mut study: Study,
    solver: Option<SolverName>,
    ensemble: &Ensemble,
) -> Result<Study, Failure> {
    if let Some(name) = solver {
        study = study.with_solver(name.name()).map_err(|faults| Failure::Usage(faults.to_string()))?;
    }
    locate::with_ensemble(study, ensemble)
}
