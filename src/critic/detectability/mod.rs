//! Which mechanisms the measurements could see.

mod map;
mod observable;
#[cfg(test)]
mod tests;

pub use map::{
    Cell, Change, Detectability, DetectabilitySettings, Effect, NoDetectability, SEEN, Sight, detectability,
};
pub use observable::Observable;
