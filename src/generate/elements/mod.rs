//! Assemblies of unlike elements that fill the same cube: spheres, clumps of spheres, blocks, irregular polyhedra.
//!
//! The cube stands on z = 0 with its lower corner at the origin. Random ones draw from streams of the member, so an
//! assembly is a pure function of its description, the seed and the member.

mod clumps;
mod polyhedra;
mod spheres;
#[cfg(test)]
mod tests;

use crate::random::{Family, Streams};
use crate::shape::{Ball, Polyhedron};

/// Which elements, and how they are arranged.
#[derive(Clone, Debug, PartialEq)]
pub enum Elements {
    /// Equal spheres on a regular grid, each touching its neighbours.
    AlignedSpheres {
        /// Spheres along x, y and z.
        along: [u32; 3],
    },
    /// Spheres at random places without overlap (YADE's `makeCloud`).
    SphereCloud {
        /// Number of spheres.
        count: u32,
        /// Radius of a sphere (m).
        radius: Family,
        /// Draws of a place before the cloud is given up.
        max_draws: u32,
    },
    /// Rough stones: clumps of overlapping spheres, one per cell of a grid, laid layer upon layer. A stone is a ball in the
    /// middle of its cell and one in each corner, as large as drawn and tangent to the cell's three faces there.
    RoughStones {
        /// Number of stones; the last layer may be incomplete.
        count: u32,
        /// Cells of a layer along x and y.
        per_layer: [u32; 2],
        /// Radius of the ball in the middle as a share of half the cell's smallest side.
        core_share: f64,
        /// The same for a ball in a corner, drawn for each.
        corner_share: Family,
    },
    /// Blocks made of equal spheres that touch in a square mesh ("regular mesh" assembly).
    MeshClumps {
        /// Blocks along x, y and z.
        along: [u32; 3],
        /// Spheres across the width (y) of a block.
        across: u32,
    },
    /// Blocks made of equal spheres whose rows stand in the gaps of the rows below ("compact" assembly): seen along x a
    /// hexagonal packing that runs through all blocks, so that they interlock.
    CompactClumps {
        /// Blocks along x, y and z.
        along: [u32; 3],
        /// Spheres across the width (y) of a block.
        across: u32,
    },
    /// Equal blocks with eight vertices on a regular grid.
    Blocks {
        /// Blocks along x, y and z.
        along: [u32; 3],
    },
    /// Convex polyhedra around random points, without overlap (YADE's `fillBox`): each is what is nearer to its point than
    /// to any other, less half a gap.
    RandomPolyhedra {
        /// Number of polyhedra.
        count: u32,
        /// Least distance of two points, as a share of the side that each would have as a cube.
        least_distance_share: f64,
        /// Gap between neighbours (m).
        gap: f64,
        /// Draws of a point before the assembly is given up.
        max_draws: u32,
    },
}

/// The shapes of an assembly.
#[derive(Clone, Debug, PartialEq)]
pub enum Shapes {
    /// Rigid bodies made of balls.
    Balls(Vec<Vec<Ball>>),
    /// Convex polyhedra.
    Polyhedra(Vec<Polyhedron>),
}

/// Why no assembly came out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoRoom {
    /// No free place was found for an element.
    #[error("no free place for element {element} in {draws} draws")]
    Draws {
        /// The element, from 0.
        element: u32,
        /// Draws made for it.
        draws: u32,
    },
    /// A cell is no valid polyhedron.
    #[error("cell {element} is no valid polyhedron: {fault}")]
    Cell {
        /// The element, from 0.
        element: u32,
        /// What is wrong with it.
        fault: crate::shape::ShapeFault,
    },
}

impl Shapes {
    /// Number of elements.
    pub fn len(&self) -> usize {
        match self {
            Shapes::Balls(clumps) => clumps.len(),
            Shapes::Polyhedra(solids) => solids.len(),
        }
    }

    /// Whether there is no element.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Elements {
    /// The elements in a cube of the given side (m).
    ///
    /// # Errors
    /// [`NoRoom`] where random elements do not fit.
    pub fn fill(&self, side: f64, streams: &Streams) -> Result<Shapes, NoRoom> {
        Ok(match self {
            Elements::AlignedSpheres { along } => Shapes::Balls(spheres::aligned(side, *along)),
            Elements::SphereCloud { count, radius, max_draws } => {
                Shapes::Balls(spheres::cloud(side, *count, radius, *max_draws, streams)?)
            }
            Elements::RoughStones { count, per_layer, core_share, corner_share } => {
                Shapes::Balls(clumps::rough(side, *count, *per_layer, *core_share, corner_share, streams))
            }
            Elements::MeshClumps { along, across } => Shapes::Balls(clumps::mesh(side, *along, *across)),
            Elements::CompactClumps { along, across } => {
                Shapes::Balls(clumps::compact(side, *along, *across))
            }
            Elements::Blocks { along } => Shapes::Polyhedra(polyhedra::blocks(side, *along)),
            Elements::RandomPolyhedra { count, least_distance_share, gap, max_draws } => {
                let points = polyhedra::points(side, *count, *least_distance_share, *max_draws, streams)?;
                Shapes::Polyhedra(polyhedra::cells(side, &points, *gap)?)
            }
        })
    }

    /// Whether every member is the same.
    pub fn is_fixed(&self) -> bool {
        !matches!(
            self,
            Elements::SphereCloud { .. } | Elements::RoughStones { .. } | Elements::RandomPolyhedra { .. }
        )
    }
}

/// Every cell of a grid: its place along x, y and z, lowest layer first.
fn places([nx, ny, nz]: [u32; 3]) -> impl Iterator<Item = [u32; 3]> {
    (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])))
}
