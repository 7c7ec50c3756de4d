//! Walls that hold back earth or water, and walls under a pressure or a load on their crest.

pub(crate) mod ask;
mod pressing;
mod refused;
mod told;

pub(crate) use pressing::{behind, checked, factored};
pub(crate) use refused::refused;
pub(crate) use told::{Held, counted};
