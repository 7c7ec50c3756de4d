//! `pirca shard`, `pirca status` and `pirca merge`: the walls of a study on many machines.

pub(crate) mod ask;
mod engine;
mod job;
mod merge;
mod plan;
mod status;

pub(crate) use engine::Engine;
pub(crate) use merge::merge;
pub(crate) use status::status;

use serde_json::json;

use crate::ensemble::Settings;
use crate::ensemble::shard::{Share, Work, compute};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::progress;
use crate::verb::shard::ask::Shard;
use crate::verb::shard::job::{Job, Made};

/// Plans how a study's walls are shared out, or computes a shard of them.
pub(crate) fn shard(arguments: &Shard) -> Result<Answer, Failure> {
    let job = Job::asked(arguments)?;
    if let Some(engine) = arguments.plan {
        return plan::plan(&job, arguments, engine);
    }
    let (Some(index), Some(of)) = (arguments.index, arguments.of) else {
        return Err(Failure::Usage("--index needs --of".to_owned()));
    };
    let out = match (&job.made, &arguments.out) {
        (Made::Batch(..), _) => &arguments.which.study,
        (_, Some(out)) => out,
        (_, None) => {
            let text = "--index needs --out, the folder of all shards: the same one for each, on a file system that all machines see";
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
    let settings = Settings { out: out.clone(), threads: arguments.threads };
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
