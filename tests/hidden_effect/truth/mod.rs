//! The truth: campaigns of walls with something hidden in them. Nothing here knows how they are judged.

pub mod campaign;
pub mod decoys;
pub mod designs;
mod effect;
pub mod label;
pub mod laws;
pub mod readings;
pub mod roster;
pub mod strength;
#[cfg(test)]
mod tests;
pub mod unknown;
mod variants;
mod walls;
