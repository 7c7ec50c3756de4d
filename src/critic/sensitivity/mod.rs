//! Which mechanisms the measurements could see.

mod map;
mod observable;
#[cfg(test)]
mod tests;

pub use map::{
    Cell, Change, Effect, NoSensitivity, SEEN, Sensitivity, SensitivitySettings, Sight, sensitivity,
};
pub use observable::Observable;
