//! What a user meets before anything is computed: input files and their faults, and the house's own layering.

mod catalogue;
mod layering;
mod malformed;
mod scratch;
mod study;
