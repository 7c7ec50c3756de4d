//! What can go wrong with a run as a whole; a wall that fails is not an error but a row.

use std::path::{Path, PathBuf};

use crate::ensemble::Task;
use crate::ensemble::shard::ShardError;
use crate::math::compact;

/// Why a run ended without its results. What was recorded before stays in the journal, and the same run started
/// again goes on from there.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A file or folder could not be made, read or written.
    #[error("cannot {action} {}: {source}", path.display())]
    File {
        /// What was tried: "write", "create the folder".
        action: &'static str,
        /// Which file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The folder holds results of another run.
    #[error(
        "{} holds results of another run:\n{}\nnothing was changed; choose another folder with --out, or remove {} to start afresh",
        folder.display(), differences.iter().map(|d| format!("  {d}")).collect::<Vec<_>>().join("\n"), folder.display()
    )]
    OtherRun {
        /// The output folder.
        folder: PathBuf,
        /// One sentence per thing that differs.
        differences: Vec<String>,
    },
    /// The folder holds files that this run would overwrite and that it cannot tell to be its own.
    #[error("{}: {found}; nothing was changed; choose another folder with --out, or remove this one to start afresh", folder.display())]
    NotOurs {
        /// The output folder.
        folder: PathBuf,
        /// What was found.
        found: String,
    },
    /// The folder holds no finished run of this study.
    #[error("{}: {found}; {fix}", folder.display())]
    NotARun {
        /// The folder that was named.
        folder: PathBuf,
        /// What was found.
        found: String,
        /// What to do about it.
        fix: String,
    },
    /// Another process is writing into the folder.
    #[error("another run is writing to {}; wait for it, or choose another folder with --out", folder.display())]
    Busy {
        /// The output folder.
        folder: PathBuf,
    },
    /// Members whose evaluation broke one of our own invariants; all other members are recorded.
    #[error(
        "{} of the members broke an invariant of the program (the others are recorded):\n{}",
        faults.len(), faults.iter().map(|f| format!("  {f}")).collect::<Vec<_>>().join("\n")
    )]
    Broken {
        /// The members, in order.
        faults: Vec<MemberFault>,
    },
    /// The shards of a study's walls.
    #[error(transparent)]
    Shard(#[from] ShardError),
    /// No worker threads could be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The tables could not be encoded.
    #[error("cannot encode {table}: {reason}")]
    Table {
        /// Name of the file.
        table: &'static str,
        /// The encoder's reason.
        reason: String,
    },
}

/// A member whose evaluation panicked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("arm {arm} at kn {} Pa/m, member {}: {message}", compact(*kn_pa_per_m), task.member)]
pub struct MemberFault {
    /// Which evaluation.
    pub task: Task,
    /// Name of its arm.
    pub arm: String,
    /// Its normal stiffness (Pa/m).
    pub kn_pa_per_m: f64,
    /// What the panic said.
    pub message: String,
}

impl RunError {
    /// Wraps a system error with what was tried on which path.
    pub fn file(action: &'static str, path: &Path, source: std::io::Error) -> Self {
        RunError::File { action, path: path.to_path_buf(), source }
    }
}
