//! Statistics and distributions against certified values, closed forms, independent programs and simulation.

mod always_valid;
mod bootstrap;
mod calibration;
mod certified;
mod characteristic;
mod coverage;
mod effort;
mod families;
mod fragility;
mod order;
mod printed;
mod published_tables;
mod rand_distr_agrees;
mod randomised;
mod rare;
mod ratios;
mod selection;
mod sensitivity;
mod sequential;
mod stated_cov;
mod support;
mod tally;
mod test_plan;
mod truncated;
