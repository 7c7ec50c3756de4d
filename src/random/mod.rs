//! Seeded streams keyed by (seed, member, quantity), and the distribution families that are sampled from them.
//!
//! Every variable is the inverse CDF of exactly one uniform, so the same uniforms can also come from a stratified or a
//! low-discrepancy design, and two studies that differ in one family keep all their other draws.

mod design;
mod discrete;
mod family;
mod fault;
mod flat;
mod gaussian;
mod pairs;
mod spread;
pub mod standard_normal;
mod stream;
mod truncated;

pub use design::{Design, PARTNER, Place, RANDOMISATIONS};
pub use family::Family;
pub use fault::BadFamily;
pub use pairs::Pairs;
pub use spread::{Scale, Spread};
pub use stream::{Move, Quantities, Stream, Streams, Taken};

#[cfg(test)]
mod tests;
