//! What a user meets: input files and their faults, the verbs, and the house's own layering.

mod catalogue;
mod commands;
mod layering;
mod malformed;
mod scratch;
mod study;
