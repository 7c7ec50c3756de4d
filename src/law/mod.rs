//! Constitutive laws of a joint, one per file, with their parameters. Plain numbers in, stresses out.

mod coulomb;
mod crushing;
mod damping;
mod normal;
mod seating;
mod slopes;
mod spheres;
mod stiffening;
mod table;
mod weakening;

pub use coulomb::{
    CohesionAfterSlip, Coulomb, Motion, PATCHES_ALONG, Pressed, Sampling, ShearSum, SubContact,
};
pub use crushing::Crushing;
pub use damping::local_damping;
pub use normal::NormalLaw;
pub use seating::{MOST_SEATS, Seat, Seating};
pub use slopes::{PressedSlopes, ShearSlopes};
pub use spheres::{Frictional, SphereSpring};
pub use stiffening::Stiffening;
pub use table::{ClosureTable, LEAST_KNOTS, MOST_KNOTS};
pub use weakening::Weakening;
