//! A wall on a base that shakes.
//!
//! Motions are those against the base: on every block acts `-m a` of the base's acceleration `a` beside gravity, which is exact for a rigid base.
//! The wall first comes to rest under gravity. Then it is followed in time, through the motion and until it has come to rest or has lost most of
//! its weight.

mod observe;
mod seam;
mod settings;
mod settled;
mod shake;
mod wall;

pub use observe::{Energy, Extreme, Shaken, Verdict};
pub use settings::{BaseMotion, InTime, Lean, Shaking};
pub use settled::Settled;
pub use shake::{Rested, shake, shake_twice};
pub use wall::shake_wall;
