//! A study shared out: its walls are evaluated by any number of processes, on any machines that see one folder, and put together to
//! what one machine would have written, byte for byte.
//!
//! An engine (Dask, Slurm, GNU parallel) starts [`compute`] with the number of a shard, as often as it likes: a shard that is complete is
//! not computed again, two that compute the same one write the same bytes, and what a killed one evaluated is taken over. No clock, no
//! name of a machine and no count of threads decides anything.

mod compute;
mod error;
mod file;
mod indices;
mod merge;
mod part;
mod status;
mod timing;
mod work;

pub use compute::{Computed, compute};
pub use error::ShardError;
pub(super) use file::recorded;
pub use indices::array;
pub use merge::Merge;
pub use status::{Begun, Status};
pub use timing::merged_timing;
pub use work::{Share, Walls, Work};

/// The folder of the shards in the output folder.
pub const SHARDS: &str = "shards";
