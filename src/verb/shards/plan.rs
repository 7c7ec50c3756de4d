//! `pirca shards plan`: into how many shards walls are best shared out, by what a few of them take, and what starts the shards.

use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde_json::json;

use crate::ensemble::{Task, evaluations};
use crate::study::Study;
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::arguments::quoted;
use crate::verb::shards::ask::{Plan, Walls};
use crate::verb::shards::engine::Asked;
use crate::verb::shards::job::{Job, Made};

/// Walls that are timed, if that takes no longer than this; four at least.
const TIMED: u64 = 24;
const LONG_ENOUGH: Duration = Duration::from_secs(30);
const FEWEST: usize = 4;
/// Most shards that are proposed: Slurm's arrays end there, unless it is set up otherwise.
const MOST_SHARDS: u64 = 1000;
/// The time limit of a shard over what is expected of it, as walls differ, and the least limit (minutes).
const LIMIT: f64 = 3.0;
const LEAST_LIMIT: u64 = 5;

/// What the timed walls took (s).
struct Timed {
    walls: usize,
    mean: f64,
    least: f64,
    most: f64,
}

/// Says how the walls are best shared out, or prints the script of an engine.
pub(crate) fn plan(arguments: &Plan) -> Result<Answer, Failure> {
    let asked = &arguments.walls;
    let job = &Job::asked(asked)?;
    let study = job.walls();
    let evaluations = evaluations(study);
    let timed = timed(job, evaluations);
    let total = timed.mean * evaluations as f64;
    let proposed = (total / (60.0 * arguments.minutes)).ceil().clamp(1.0, MOST_SHARDS as f64) as u64;
    let of = arguments.of.unwrap_or(proposed.min(evaluations.max(1)) as u32);
    let minutes = total / f64::from(of) / 60.0;
    let out = match &job.made {
        Made::Batch(..) => asked.which.study.clone(),
        Made::Bank(_) => asked_out(asked, &job.study, "bank-shards"),
        Made::Own => asked_out(asked, &job.study, "shards"),
    };
    let out = std::path::absolute(&out).unwrap_or(out);
    let words = words(job, asked, of, &out);
    if let Some(engine) = arguments.script {
        let limit = ((LIMIT * minutes).ceil() as u64).max(LEAST_LIMIT);
        let out = out.display().to_string();
        let script = engine.script(&Asked {
            arguments: &words,
            out: &out,
            of,
            minutes: limit,
            threads: threads(asked),
            study: &job.study.name,
        });
        let object = json!({"engine": engine.name(), "shards": of, "script": script});
        return Answer::verbatim(script, &object);
    }
    let Timed { walls, mean, least, most } = timed;
    let each = evaluations.div_ceil(u64::from(of));
    // Behind `shards run`.
    let planned: Vec<String> = words.iter().skip(2).map(|word| quoted(word)).collect();
    let planned = format!("pirca shards plan {} --script", planned.join(" "));
    let text = format!(
        "{}: {evaluations} evaluations of {} s each ({walls} timed, {} to {} s): {} on one processor\n\
         {of} shards of {each} evaluations, {} each\n\n\
         Start them by one of these, with the folder on a file system that all machines see:\n  \
         Dask           {planned} dask > shards.py; python shards.py ADDRESS\n  \
         Slurm          {planned} slurm > shards.sh; bash shards.sh\n  \
         GNU parallel   {planned} parallel > shards.sh; bash shards.sh\n\
         then           pirca shards status {out}\n                 pirca shards merge {out}\n",
        job.study.name,
        seconds(mean),
        seconds(least),
        seconds(most),
        duration(total),
        duration(60.0 * minutes),
        out = quoted(&out.display().to_string()),
    );
    let object = json!({
        "study": job.study.name, "evaluations": evaluations,
        "timed": {"walls": walls, "mean_s": mean, "least_s": least, "most_s": most},
        "processor_hours": total / 3600.0, "shards": of, "evaluations_per_shard": each,
        "minutes_per_shard": minutes, "out": out.display().to_string(),
    });
    Answer::of(text, &object)
}

fn asked_out(arguments: &Walls, study: &Study, what: &str) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| output::default_folder(study, what))
}

/// Times walls on one thread, spread over all that are planned, in an order in which any number of them is spread.
fn timed(job: &Job, evaluations: u64) -> Timed {
    let begun = Instant::now();
    let mut took: Vec<f64> = Vec::new();
    doing("timing some walls", |doing| {
        let mut places: Vec<u64> = (0..TIMED).map(|k| (spread(k) * evaluations as f64) as u64).collect();
        let mut seen = std::collections::BTreeSet::new();
        places.retain(|place| *place < evaluations && seen.insert(*place));
        for place in places {
            if took.len() >= FEWEST && begun.elapsed() > LONG_ENOUGH {
                break;
            }
            let own = Instant::now();
            job.evaluate(at(job.walls(), place));
            took.push(own.elapsed().as_secs_f64());
            doing.say(format!("{} timed", took.len()));
        }
    });
    let walls = took.len();
    let least = took.iter().copied().fold(f64::INFINITY, f64::min);
    let most = took.iter().copied().fold(0.0, f64::max);
    Timed { walls, mean: took.iter().sum::<f64>() / walls.max(1) as f64, least, most }
}

/// The numbers 0, 1/2, 1/4, 3/4, 1/8, ... (van der Corput).
fn spread(k: u64) -> f64 {
    k.reverse_bits() as f64 / (u64::MAX as f64)
}

/// The evaluation at a place in the order of the results.
fn at(study: &Study, mut place: u64) -> Task {
    for (arm, own) in (0u32..).zip(&study.arms) {
        for point in 0..own.kn_points.len() as u32 {
            if place < own.members {
                return Task { arm, point, member: place };
            }
            place -= own.members;
        }
    }
    unreachable!("a place is below the number of evaluations")
}

/// Threads of a shard: one, unless others are asked for, as many shards go on at a time.
fn threads(arguments: &Walls) -> usize {
    arguments.threads.map_or(1, NonZero::get)
}

/// The arguments of a shard but its number, without the program. Paths are whole, as jobs begin in other folders.
fn words(job: &Job, arguments: &Walls, of: u32, out: &Path) -> Vec<String> {
    let whole =
        |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf()).display().to_string();
    let is_batch = matches!(job.made, Made::Batch(..));
    let mut words =
        vec!["shards".to_owned(), "run".to_owned(), whole(if is_batch { out } else { &job.place })];
    let mut option = |name: &str, value: Option<String>| {
        words.extend(value.map(|value| [name.to_owned(), value]).into_iter().flatten());
    };
    option("--variant", arguments.which.variant.clone());
    option("--members", arguments.ensemble.members.map(|n| n.to_string()));
    option("--seed", arguments.ensemble.seed.map(|n| n.to_string()));
    option("--solver", arguments.solver.map(|solver| solver.name().to_owned()));
    option("--measured", arguments.measured.as_deref().map(whole));
    option("--points", arguments.points.map(|n| n.to_string()));
    option("--threads", Some(threads(arguments).to_string()));
    option("--of", Some(of.to_string()));
    option("--out", (!is_batch).then(|| out.display().to_string()));
    words.extend(arguments.bank.then(|| "--bank".to_owned()));
    words
}

fn seconds(s: f64) -> String {
    match s {
        s if s >= 10.0 => format!("{s:.0}"),
        s if s >= 0.1 => format!("{s:.2}"),
        s => format!("{s:.1e}"),
    }
}

fn duration(s: f64) -> String {
    match s {
        s if s >= 7200.0 => format!("{:.1} h", s / 3600.0),
        s if s >= 120.0 => format!("{:.0} min", s / 60.0),
        s => format!("{} s", seconds(s)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_number_of_timed_walls_is_spread() {
        let first: Vec<f64> = (0..5).map(spread).collect();
        assert_eq!(first, [0.0, 0.5, 0.25, 0.75, 0.125]);
    }

    #[test]
    fn times_are_said_in_their_size() {
        let said = [0.0123, 0.5, 42.0, 600.0, 86_400.0].map(duration);
        assert_eq!(said, ["1.2e-2 s", "0.50 s", "42 s", "10 min", "24.0 h"]);
    }
}
