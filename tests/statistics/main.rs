//! Statistics and distributions against certified values, closed forms, independent programs and simulation.

mod always_valid;
mod bootstrap;
mod calibration;
mod certified;
mod characteristic;
mod coverage;
mod families;
mod order;
mod published_tables;
mod rand_distr_agrees;
mod rare;
mod ratios;
mod selection;
mod support;
mod test_plan;
mod truncated;
