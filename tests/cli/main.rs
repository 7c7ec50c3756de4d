//! What a user meets: input files and their faults, the verbs, and the house's own layering.

mod analyse;
mod analyse_loads;
mod analyse_ranges;
mod bad_walls;
mod capacity;
mod catalogue;
mod commands;
mod compare;
mod diagnose;
mod extended;
mod files_of_others;
#[path = "../ensemble/fixture.rs"]
mod fixture;
mod groups;
mod influence;
mod init;
mod joint_laws;
mod layering;
mod malformed;
mod manual;
mod measured;
mod measured_verb;
mod mechanisms;
mod mutated_walls;
mod pages;
mod picture;
mod plan_tests;
mod readings;
mod records;
mod report;
mod scratch;
mod spreadsheets;
mod study;
mod uncertain;
mod walls;
