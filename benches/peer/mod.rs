//! Other programs on the same scenes.

pub mod rapier;
