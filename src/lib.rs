//! pirca: a stochastic masonry generator and analyser.

pub mod cli;
pub mod contact;
pub mod ensemble;
pub mod exchange;
pub mod generate;
pub mod law;
pub mod math;
pub mod model;
pub mod protocol;
pub mod random;
pub mod report;
pub mod shape;
pub mod solve;
pub mod stats;
pub mod study;
