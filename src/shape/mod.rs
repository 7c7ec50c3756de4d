//! Convex polygons and polyhedra: cut, clip, inertia, overlap, validity. Knows shapes, never the world.

mod overlap;
mod plane;
mod polygon;
mod polyhedron;
#[cfg(test)]
mod tests;

pub use overlap::overlap_depth;
pub use plane::{Frame, Plane};
pub use polygon::{Moments, Polygon};
pub use polyhedron::{MassProperties, Polyhedron, ShapeFault};
