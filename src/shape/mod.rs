//! Convex polygons and polyhedra: cut, clip, inertia, overlap, validity; unions of balls, outlines in balls. Knows shapes, never the world.

mod balls;
mod hull;
mod outline;
mod overlap;
mod plane;
mod polygon;
mod polyhedron;
#[cfg(test)]
mod tests;
mod triangles;
mod union;

pub use balls::{Ball, union_of_balls};
pub use hull::Hull;
pub use outline::{OutlineFault, Rows};
pub use overlap::overlap_depth;
pub use plane::{Frame, Plane};
pub use polygon::{Moments, Polygon, bounds, distance, encloses, moments, sides};
pub use polyhedron::{MassProperties, Polyhedron, ShapeFault, corners_apart};
pub use triangles::triangles;
pub use union::convex_union;
