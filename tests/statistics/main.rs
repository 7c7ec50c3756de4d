//! Statistics and distributions against certified values, closed forms, independent programs and simulation.

mod bootstrap;
mod calibration;
mod certified;
mod characteristic;
mod coverage;
mod families;
mod influence;
mod order;
mod published_tables;
mod rand_distr_agrees;
mod randomised;
mod rare;
mod ratios;
mod sequential;
mod support;
mod truncated;
