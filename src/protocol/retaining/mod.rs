//! Walls that hold back earth or water: what presses on their backs at every height, and the height at which they fall.
//!
//! Fill presses as Coulomb's wedge does (`wedge`), water by its depth; both on the faces of the wall as built (`behind`). It does not follow a wall that
//! moves: a wall that gives way loses some of its pressure, which is on the safe side. The fill has no cohesion and lies level or at one slope. Under the foot
//! and in the joints no water presses.

mod behind;
mod hold;
mod lifts;
mod limit;
mod retained;
mod settings;
mod wedge;

pub use behind::{Behind, NoBack};
pub(super) use hold::hold;
pub use hold::left_open_at;
pub use lifts::raise;
pub use limit::{Highest, highest};
pub use retained::{Fill, NoFill, Retained, WATER};
pub use settings::{Lifts, Retaining};
pub use wedge::Wedge;
