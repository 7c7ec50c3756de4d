//! Runs as a user starts them: worker counts, kills, changed studies, full disks, shared random numbers.

mod batches;
mod bearing;
mod columns;
mod enough;
mod failed_members;
mod fixture;
mod grow;
mod kill;
mod loads;
mod machinery;
mod mechanisms;
mod memory;
mod refusal;
mod same_walls;
mod shaken;
mod shards;
mod tables;
mod threads;
