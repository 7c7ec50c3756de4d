//! The verbs: a room for each, with its options and their help, its work, and its answer. What several share stands beside them.

macro_rules! codes {
    () => {
        "Exit codes: 0 done; 1 the run or a file failed; 2 wrong arguments; 3 invalid study or wall."
    };
}
pub(crate) use codes;

pub mod analyse;
pub(crate) mod arguments;
pub(crate) mod arms;
pub mod capacity;
pub(crate) mod check;
pub(crate) mod cite;
pub mod compare;
pub mod detectability;
pub mod diagnose;
pub mod homogenise;
pub(crate) mod init;
pub(crate) mod locate;
pub(crate) mod measured;
pub(crate) mod mechanisms;
pub mod plan_tests;
pub(crate) mod question;
pub mod readings;
pub(crate) mod report;
pub mod run;
pub(crate) mod schema;
pub mod sensitivity;
pub(crate) mod shard;
pub(crate) mod share;
#[cfg(test)]
mod tests;
pub mod wall;
