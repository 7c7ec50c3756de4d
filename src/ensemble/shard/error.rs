//! What can go wrong with shards, beside what can go wrong with any run.

use std::path::PathBuf;

/// Why walls cannot be shared out, or shards not be put together.
#[derive(Debug, thiserror::Error)]
pub enum ShardError {
    /// The folder holds shards of other work.
    #[error(
        "{} holds shards of other work:\n{}\nnothing was changed; choose another folder with --out, or remove {} to start afresh",
        folder.display(), listed(differences), folder.display()
    )]
    OtherWork {
        /// The output folder.
        folder: PathBuf,
        /// One sentence per thing that differs.
        differences: Vec<String>,
    },
    /// The study is not the one that the shards are of.
    #[error(
        "{} is not the study that the shards in {} are of:\n{}\nnothing was changed; name the folder of that study with --study, or put its \
         files back as they were when the shards were begun",
        study.display(), folder.display(), listed(differences)
    )]
    OtherStudy {
        /// The output folder.
        folder: PathBuf,
        /// The folder of the study.
        study: PathBuf,
        /// One sentence per thing that differs.
        differences: Vec<String>,
    },
    /// A shard that is none of this work.
    #[error("{}: {found}; nothing was changed; it was copied here, or computed by another version: remove it", file.display())]
    Foreign {
        /// The file.
        file: PathBuf,
        /// Of what it is.
        found: String,
    },
    /// A shard whose file is not as it was written.
    #[error("{}: {found}; nothing was changed; compute it again: pirca shards run --index {index} replaces a damaged file", file.display())]
    Damaged {
        /// The file.
        file: PathBuf,
        /// The number of the shard.
        index: u32,
        /// What is wrong.
        found: String,
    },
    /// No shards are in the folder.
    #[error("{}: {found}; give the folder that pirca shards run --out wrote to", folder.display())]
    NoShards {
        /// The folder.
        folder: PathBuf,
        /// What was found.
        found: String,
    },
    /// Shards are missing.
    #[error(
        "{}: {} of {of} shards are missing: {}\ncompute them (as a Slurm array: --array={}), or merge what there is with --partial",
        folder.display(), missing.len(), super::array(missing), super::array(missing)
    )]
    Missing {
        /// The folder.
        folder: PathBuf,
        /// Their numbers.
        missing: Vec<u32>,
        /// Into so many the walls are shared out.
        of: u32,
    },
}

/// Sentences, a line each.
fn listed(differences: &[String]) -> String {
    differences.iter().map(|difference| format!("  {difference}")).collect::<Vec<_>>().join("\n")
}
