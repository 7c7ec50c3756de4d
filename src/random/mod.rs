//! Seeded streams keyed by (seed, member, quantity), and the distribution families that are sampled from them.

mod family;
mod stream;

pub use family::{BadFamily, Family};
pub use stream::{Stream, Streams};
