//! Runs as a user starts them: worker counts, kills, changed studies, full disks, shared random numbers.

mod failed_members;
mod fixture;
mod kill;
mod machinery;
mod mechanisms;
mod refusal;
mod same_walls;
mod threads;
