//! `pirca analyse`: a wall that somebody else made, with one command.

mod answer;
mod files;
mod meetings;
mod numbers;
mod solve;
mod state;
mod upright;
mod verb;
mod worst;

pub(crate) use numbers::{
    Tolerance, cohesion, density, direction, friction_angle, length, step, stiffness, tolerance,
};
pub(crate) use verb::analyse;
