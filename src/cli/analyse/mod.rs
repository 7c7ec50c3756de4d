//! `pirca analyse`: a wall that somebody else made, with one command.

mod answer;
mod meetings;
mod numbers;
mod solve;
mod verb;

pub(crate) use numbers::{cohesion, density, direction, friction_angle, step, stiffness, tolerance};
pub(crate) use verb::analyse;
