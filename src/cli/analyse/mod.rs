//! `pirca analyse`: a wall that somebody else made, with one command.

mod answer;
mod meetings;
mod numbers;
mod solve;
mod upright;
mod verb;

pub(crate) use numbers::{
    Tolerance, cohesion, density, direction, friction_angle, length, step, stiffness, tolerance,
};
pub(crate) use verb::analyse;
