//! The engines that start shards, and the script of each.

use clap::ValueEnum;

use crate::verb::arguments::quoted;

const SLURM: &str = include_str!("slurm.sh");
const PARALLEL: &str = include_str!("parallel.sh");
const DASK: &str = include_str!("../../../python/examples/dask_shards.py");

/// What starts shards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Engine {
    /// A Python script for Dask, on a laptop, in a network or on a cluster.
    Dask,
    /// A script for bash that submits an array job to Slurm, and the merge behind it.
    Slurm,
    /// A script for bash that runs GNU parallel on one machine.
    Parallel,
}

/// What the script of an engine says of its shards.
pub(crate) struct Asked<'a> {
    /// Arguments of the command of a shard but its number, without the program.
    pub arguments: &'a [String],
    /// The output folder.
    pub out: &'a str,
    /// The number of shards.
    pub of: u32,
    /// Most minutes of a shard.
    pub minutes: u64,
    /// Threads of a shard.
    pub threads: usize,
    /// Name of the study.
    pub study: &'a str,
}

impl Engine {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Dask => "dask",
            Engine::Slurm => "slurm",
            Engine::Parallel => "parallel",
        }
    }

    /// Its script.
    pub(crate) fn script(self, asked: &Asked<'_>) -> String {
        let template = match self {
            Engine::Dask => DASK,
            Engine::Slurm => SLURM,
            Engine::Parallel => PARALLEL,
        };
        let words = asked.arguments.iter().map(|word| quoted(word));
        let command: Vec<String> = std::iter::once("pirca".to_owned()).chain(words).collect();
        let plain = |c: char| if c.is_ascii_alphanumeric() || "_-".contains(c) { c } else { '_' };
        let json = |value: serde_json::Value| value.to_string();
        [
            ("@SHARD@", command.join(" ")),
            ("@SHARD_LIST@", json(asked.arguments.into())),
            ("@OUT@", quoted(asked.out)),
            ("@OUT_TEXT@", json(asked.out.into())),
            ("@OF@", asked.of.to_string()),
            ("@LAST@", (asked.of - 1).to_string()),
            ("@MINUTES@", asked.minutes.to_string()),
            ("@THREADS@", asked.threads.to_string()),
            ("@NAME@", asked.study.chars().map(plain).collect()),
        ]
        .iter()
        .fold(template.to_owned(), |script, (place, text)| script.replace(place, text))
    }
}
