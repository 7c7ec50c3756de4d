//! A block: a rigid convex stone, a wedge, or a piece of the surroundings.

use crate::shape::Polyhedron;

/// A rigid convex block in world coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its shape at rest, in world coordinates (m).
    pub shape: Polyhedron,
    /// Density (kg/m^3).
    pub density: f64,
    /// How it is held.
    pub support: Support,
    /// What it is.
    pub tag: Tag,
}

/// How a block is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Support {
    /// Moves freely.
    Free,
    /// Does not move.
    Fixed,
    /// Cannot move out of plane (y) nor turn about x or z; free in the wall's plane.
    OutOfPlane,
    /// Not there any more: a stone that has fallen out. It has neither weight nor joints; the others keep their ids.
    Absent,
}

/// What a block is, for reports and for the rules that treat it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tag {
    /// A stone of the wall.
    Stone,
    /// A stone that spans all wythes.
    Header,
    /// A small wedge stone in a joint.
    Wedge,
    /// The ground or the platform under the wall.
    Base,
    /// A block that restrains an end of the wall.
    End,
}
