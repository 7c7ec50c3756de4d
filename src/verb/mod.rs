//! The verbs: a room for each, with its options and their help, its work, and its answer. What several share stands beside them.

macro_rules! codes {
    () => {
        "Exit codes: 0 done; 1 the run or a file failed; 2 wrong arguments; 3 invalid study or wall; 4 a demand is not met (--assert)."
    };
}
pub(crate) use codes;

pub mod analyse;
pub(crate) mod arguments;
pub(crate) mod arms;
pub mod capacity;
pub(crate) mod check;
pub mod compare;
pub(crate) mod demand;
pub mod detectability;
pub mod diagnose;
pub mod homogenise;
pub(crate) mod init;
pub(crate) mod locate;
pub mod plan_tests;
pub(crate) mod question;
pub mod readings;
pub(crate) mod reference;
pub(crate) mod report;
pub mod run;
pub mod sensitivity;
pub(crate) mod shards;
pub(crate) mod share;
#[cfg(test)]
mod tests;
pub mod wall;
