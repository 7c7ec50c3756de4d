//! Effects are hidden in campaigns of real walls, and must be found; where nothing is hidden, nothing may be found.
//!
//! `towers` does so on small walls, `kept`, a slow test, on a few of the campaigns of the sealed test. That test does so on
//! the walls of `studies/tilting-table`, is run by hand, and is described in `studies/hidden-effects`: `run` leads through it, `truth`
//! makes campaigns, `hide` seals what is hidden in them, `inference` judges what lies in the campaigns' folders and nothing else,
//! `conflict` and `shift` ask what it makes of the true cause, `laws` has it learn laws of no catalogue, `record` keeps what it said, `table`
//! sets the two against each other, `wanted` against what was asked of it beforehand, and `looks` stops a group when that is decided;
//! `recount` counts the published table anew from the record.

mod conflict;
mod figure;
mod folders;
mod hide;
mod inference;
mod joint_law;
mod kept;
mod laws;
mod looks;
mod printed;
mod record;
mod recount;
mod run;
mod sealed;
mod shift;
mod table;
mod towers;
mod truth;
mod wanted;
