//! Shear in the wall's plane: a rigid beam presses on the wall's top with a constant load, and a jack pushes it along the wall.
//!
//! The jack is a spring much stiffer than the wall, whose far end is moved: displacement control, which goes on through limit
//! points. Blocks that are wedged between others let go all of a sudden, at limit points of their own. Newton's method ends
//! there; the wall is then let go from the last state at rest, in time and damped, and comes to rest nearby.

mod drive;
mod limit;
mod readings;
mod settings;
mod stage;

pub(super) use drive::{Begin, push};
pub(super) use limit::{by_limit, push_on};
pub use readings::{ShearMode, Sheared, first_at, force_at};
pub use settings::{Head, History, Shear};
pub(super) use stage::{beam, jack};
