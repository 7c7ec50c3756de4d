//! What a user meets: input files and their faults, the verbs, and the house's own layering.

mod analyse;
mod bad_walls;
mod catalogue;
mod commands;
mod diagnose;
mod extended;
#[path = "../ensemble/fixture.rs"]
mod fixture;
mod init;
mod layering;
mod malformed;
mod measured;
mod mechanisms;
mod mutated_walls;
mod picture;
mod scratch;
mod study;
mod walls;
