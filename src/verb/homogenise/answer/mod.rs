//! What comes of cells: masonry as a plate, its stiffness, its surface, and what both do as cells grow.

mod csv;
mod document;
mod entry;
mod plot;
mod walls;

pub use document::homogenised_document;
pub use entry::{
    HomogenisedSummary, ModulusBounds, NestedCells, PlateArm, PlateCells, PlateUnits, PlateValue,
    SurfaceEntry, ValueBySize, homogenised_summary,
};
pub use walls::{HeldWalls, WallSample, WallShare, WallsAsPlates};
