//! From stones to a plate: what random masonry is when seen from afar, and what a wall of it bears.
//!
//! A cell of stones, repeated without end, is strained like a plate (see [`crate::model::image_motion`] for the conventions). Its
//! joints as springs give the plate's stiffness (`moduli`), its stones as rigid blocks the stresses that it bears (`surface`); between the
//! two, joints that open and slip give how it comes to bear them (`strained`).

mod answer;
mod moduli;
pub mod plate;
mod springs;
mod strained;
mod surface;
mod wall;

use crate::solve::limit::Flow;
pub use answer::{AskedOfCell, CellAnswer};
pub use moduli::{Border, Loose, Moduli};
pub use springs::Springs;
pub use strained::{Ending, Path, Strained, strained};
pub use surface::{Direction, Found, IN_PLANE, Method, Point, out_of_plane, surface};
pub use wall::plate_collapse;
