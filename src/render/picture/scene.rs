//! What is drawn: blocks where a magnified movement takes them, and what their joints did.

use crate::math::Vec3;
use crate::model::Movement;
use crate::shape::Polyhedron;

/// Without a stated magnification the largest movement is drawn as this share of the wall's height.
const SHARE_OF_HEIGHT: f64 = 0.1;

/// A block and how it moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Stone {
    /// Its shape as built (m).
    pub shape: Polyhedron,
    /// How it came to where it was at rest, drawn in its true size.
    pub before: Movement,
    /// How it moves from there; this is magnified.
    pub movement: Movement,
}

/// A joint and what it did.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// Its blocks, by index; one that is not among the stones is the ground.
    pub blocks: [usize; 2],
    /// Its polygon as built (m, world axes), in order around.
    pub polygon: Vec<Vec3>,
    /// What it is coloured by (SI units).
    pub value: f64,
}

/// A hinge: the edge about which two blocks turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Hinge {
    /// One of the blocks, by index.
    pub block: usize,
    /// The ends of the edge (m), where the block is at rest.
    pub edge: [Vec3; 2],
}

/// The force that passes through a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Thrust {
    /// The block that it moves with, by index.
    pub block: usize,
    /// Where it passes, its centre of pressure as built (m).
    pub at: Vec3,
    /// The force (N).
    pub force: Vec3,
}

/// A picture of a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The blocks.
    pub stones: Vec<Stone>,
    /// The joints that may be coloured.
    pub seams: Vec<Seam>,
    /// The hinges, each a dot.
    pub hinges: Vec<Hinge>,
    /// The forces between blocks, each a line along it through its centre of pressure; none where they are not drawn.
    pub thrusts: Vec<Thrust>,
    /// What their values are, for the colour bar: "largest opening of a joint".
    pub measure: String,
    /// The unit in which the colour bar shows them, and how many of it make one of theirs.
    pub unit: (&'static str, f64),
    /// Whether the wall is seen from its front (+y).
    pub from_front: bool,
    /// Magnification of the movement.
    pub magnification: f64,
    /// Headline.
    pub title: String,
    /// Lines below the wall.
    pub remarks: Vec<String>,
}

impl Stone {
    /// A block that has moved since it was built, all of it magnified.
    pub fn moved(shape: Polyhedron, movement: Movement) -> Stone {
        Stone { shape, before: Movement::NONE, movement }
    }

    /// Points of the block as built, taken to where they are drawn.
    pub(crate) fn taking(&self, points: &[Vec3], magnification: f64) -> Vec<Vec3> {
        let built = self.shape.mass_properties().centroid;
        let at_rest = self.before.taking(built, points);
        self.movement.times(magnification).taking(built + self.before.shift, &at_rest)
    }

    /// Points of the block where it is at rest, taken to where they are drawn. Where nothing falls, the movement is the one that led to
    /// rest: points then are as good as built, as it is small but for its magnification.
    pub(crate) fn falling(&self, points: &[Vec3], magnification: f64) -> Vec<Vec3> {
        let at_rest = self.shape.mass_properties().centroid + self.before.shift;
        self.movement.times(magnification).taking(at_rest, points)
    }

    /// The block where it is drawn.
    pub fn drawn(&self, magnification: f64) -> Polyhedron {
        Polyhedron {
            vertices: self.taking(&self.shape.vertices, magnification),
            faces: self.shape.faces.clone(),
        }
    }
}

/// What pictures of the same wall that are shown one after the other have in common, so that nothing jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Left and right, bottom and top of what is seen (m, in the plane of the picture).
    pub(crate) extent: [[f64; 2]; 2],
    /// The value of a joint at the end of the colour bar (SI units).
    pub(crate) largest: f64,
}

impl Stage {
    /// The smallest one that holds both.
    pub fn with(&self, other: &Stage) -> Stage {
        let both = |k: usize| {
            let ([low, high], [least, most]) = (self.extent[k], other.extent[k]);
            [low.min(least), high.max(most)]
        };
        Stage { extent: [both(0), both(1)], largest: self.largest.max(other.largest) }
    }
}

impl Picture {
    /// The magnification that makes the largest movement of a block's centroid a tenth of the height of the wall; 1 where
    /// nothing moves. To two significant digits, so that it can be said in words.
    pub fn fitting(stones: &[Stone]) -> f64 {
        let furthest = stones.iter().map(|stone| stone.movement.shift.norm()).fold(0.0, f64::max);
        let (low, high) = height(stones);
        if furthest == 0.0 {
            return 1.0;
        }
        let exact = SHARE_OF_HEIGHT * (high - low) / furthest;
        format!("{exact:.1e}").parse().unwrap_or(exact)
    }

    /// The blocks where they are drawn.
    pub(crate) fn drawn(&self) -> Vec<Polyhedron> {
        self.stones.iter().map(|stone| stone.drawn(self.magnification)).collect()
    }
}

/// Lowest and highest point as built (m).
pub(crate) fn height(stones: &[Stone]) -> (f64, f64) {
    stones
        .iter()
        .map(|stone| stone.shape.bounds())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (from, to)| (low.min(from.z), high.max(to.z)))
}
