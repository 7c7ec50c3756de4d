//! Convex polygons and polyhedra: cut, clip, inertia, overlap, validity. Knows shapes, never the world.

mod plane;
mod polygon;
mod polyhedron;

pub use plane::{Frame, Plane};
pub use polygon::{Moments, Polygon};
pub use polyhedron::{MassProperties, Polyhedron, ShapeFault};
