//! `pirca shards`: the walls of a study on many machines.

pub(crate) mod ask;
mod engine;
mod job;
mod merge;
mod plan;
mod status;

pub(crate) use engine::Engine;

use serde_json::json;

use crate::ensemble::Settings;
use crate::ensemble::shard::{Share, Work, compute};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::progress;
use crate::verb::shards::ask::{Run, Shards, Step};
use crate::verb::shards::job::{Job, Made};

/// Does a step.
pub(crate) fn shards(arguments: &Shards) -> Result<Answer, Failure> {
    match &arguments.step {
        Step::Plan(asked) => plan::plan(asked),
        Step::Run(asked) => run(asked),
        Step::Status(asked) => status::status(asked),
        Step::Merge(asked) => merge::merge(asked),
    }
}

/// Computes a shard.
fn run(arguments: &Run) -> Result<Answer, Failure> {
    let Run { walls, index, of } = arguments;
    let (index, of) = (*index, *of);
    let job = Job::asked(walls)?;
    let out = match (&job.made, &walls.out) {
        (Made::Batch(..), _) => &walls.which.study,
        (_, Some(out)) => out,
        (_, None) => {
            let text = "shards run needs --out, the folder of all shards: the same one for each, on a file system that all machines see";
            return Err(Failure::Usage(text.to_owned()));
        }
    };
    if index >= of {
        return Err(Failure::Usage(format!(
            "--index {index}: the shards of --of {of} are numbered from 0 to {}",
            of - 1
        )));
    }
    let (study, share) = (job.walls(), Share { index, of });
    let work = Work::of(study, &job.place, job.kind.clone(), of);
    let settings = Settings { out: out.clone(), threads: walls.threads };
    let progress = progress::on_stderr(study);
    let done = compute(study, &work, share, &settings, progress.as_ref(), &|_, task| job.evaluate(task))?;
    let text = match done.was_complete {
        true => format!("shard {index} of {of} was complete: {} walls\n", done.walls),
        false => {
            format!("shard {index} of {of}: {} walls, {} of them evaluated before\n", done.walls, done.before)
        }
    };
    let object = json!({
        "index": index, "of": of, "walls": done.walls, "before": done.before, "was_complete": done.was_complete,
    });
    Ok(Answer::of(text, &object)?.in_place(out))
}
