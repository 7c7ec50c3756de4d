//! A window: a piece cut out of a wall, with the stones around it.

use std::collections::BTreeMap;
use std::fmt;

use crate::math::Vec3;
use crate::model::{Block, Support, Wall};
use crate::shape::{MassProperties, Polyhedron};

/// Stones are neighbours when their boxes come this close, as a share of the root of a stone's mean area in the window: further
/// than any head joint is open, much less than a stone.
const REACH: f64 = 0.05;
/// Lengths that differ by this share of the thickness are equal: far above round-off, far below what an eye sees.
const EQUAL: f64 = 1e-6;

/// A piece of a wall of one thickness, for tests of what it is as a material.
///
/// Positions are those of the wall, but moved along y where necessary so that the wall spans y = -`thickness` / 2 to
/// `thickness` / 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// The stones of the window, in the order of the wall.
    pub inside: Vec<Block>,
    /// Their neighbours: stones outside that touch one of them or nearly do, in the order of the wall.
    pub around: Vec<Block>,
    /// Thickness of the wall (m).
    pub thickness: f64,
    /// Area (m^2): the volume of the stones inside over the thickness. Open joints do not count.
    pub area: f64,
}

/// A side of a stone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Towards x = 0.
    Left,
    /// Towards the wall's other end.
    Right,
    /// Downwards.
    Below,
    /// Upwards.
    Above,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Side::Left => "to its left",
            Side::Right => "to its right",
            Side::Below => "below it",
            Side::Above => "above it",
        })
    }
}

/// Why a wall has no such window. Places are along x and along z (m).
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WindowFault {
    /// The rectangle has no area, or none that is finite.
    #[error(
        "a window from ({}, {}) to ({}, {}) m has no finite area above 0: give its lower left corner, then its upper right one",
        from[0], from[1], to[0], to[1]
    )]
    NoRectangle {
        /// Lower left corner asked for.
        from: [f64; 2],
        /// Upper right corner asked for.
        to: [f64; 2],
    },
    /// No stone has its middle in the rectangle.
    #[error(
        "no stone has its middle between ({}, {}) and ({}, {}) m: the wall's stones reach from ({}, {}) to ({}, {}) m",
        from[0], from[1], to[0], to[1], wall[0][0], wall[0][1], wall[1][0], wall[1][1]
    )]
    Empty {
        /// Lower left corner asked for.
        from: [f64; 2],
        /// Upper right corner asked for.
        to: [f64; 2],
        /// Lowest and highest corner of the box around the stones.
        wall: [[f64; 2]; 2],
    },
    /// A stone of the window lacks a neighbour.
    #[error(
        "stone {stone} at ({:.3}, {:.3}) m is in the window, but has no stone {side}: a window needs neighbours on every side, so keep \
         it a stone away from the wall's ends, base and top",
        at[0], at[1]
    )]
    Border {
        /// Index of the stone.
        stone: usize,
        /// Its middle.
        at: [f64; 2],
        /// Where it has no neighbour.
        side: Side,
    },
    /// The faces of the wall are not two upright planes.
    #[error(
        "the wall reaches from y = {:.6} to {:.6} m at the height of {height:.3} m, but from {:.6} to {:.6} m elsewhere in the window: a \
         window needs one thickness between upright faces, so take a wall that is not battered and does not lean",
        here[0], here[1], elsewhere[0], elsewhere[1]
    )]
    Uneven {
        /// Where it is thinner (m).
        height: f64,
        /// From the back to the front there (m).
        here: [f64; 2],
        /// From the back to the front of all (m).
        elsewhere: [f64; 2],
    },
}

impl Wall {
    /// The stones whose middle lies in a rectangle, from its lower left to its upper right corner, each along x and along z (m),
    /// and their neighbours. A stone of several parts is in it as a whole or not at all.
    ///
    /// # Errors
    /// [`WindowFault`] when the rectangle has no area or no stone, when the thickness of the wall is not the same all over the
    /// window, or when a stone in it has no neighbour on one of its four sides.
    pub fn window(&self, from: [f64; 2], to: [f64; 2]) -> Result<Window, WindowFault> {
        let spans = |axis: usize| from[axis] < to[axis] && (to[axis] - from[axis]).is_finite();
        if !(spans(0) && spans(1)) {
            return Err(WindowFault::NoRectangle { from, to });
        }
        let stones = self.located();
        let is_inside =
            |stone: &Located| (0..2).all(|axis| (from[axis]..to[axis]).contains(&stone.middle[axis]));
        let (inside, outside): (Vec<Located>, Vec<Located>) = stones.iter().partition(|own| is_inside(own));
        if inside.is_empty() {
            let [low, high] = bounds(&stones);
            return Err(WindowFault::Empty { from, to, wall: [[low.x, low.z], [high.x, high.z]] });
        }
        let volume: f64 = inside.iter().map(|own| self.blocks[own.id].shape.volume()).sum();
        let [low, high] = bounds(&inside);
        let reach = REACH * (volume / (high.y - low.y) / inside.len() as f64).sqrt();
        let touches = |other: &Located| inside.iter().any(|own| own.is_near(other, reach));
        let around: Vec<Located> = outside.into_iter().filter(touches).collect();
        let all = [&inside[..], &around].concat();
        let [back, front] = self.faces(&inside, &all)?;
        let thickness = front - back;
        for own in &inside {
            if let Some(side) = own.open_side(&all, reach, EQUAL * thickness) {
                return Err(WindowFault::Border { stone: own.id, at: own.middle, side });
            }
        }
        let centred = |own: &Located| {
            let mut block = self.blocks[own.id].clone();
            block.shape = block.shape.translated(&Vec3::new(0.0, -0.5 * (back + front), 0.0));
            block
        };
        Ok(Window {
            inside: inside.iter().map(centred).collect(),
            around: around.iter().map(centred).collect(),
            thickness,
            area: volume / thickness,
        })
    }

    /// Where its stones are, without those that have fallen out.
    fn located(&self) -> Vec<Located> {
        let leads = self.leads();
        let mut parts: BTreeMap<usize, Vec<MassProperties>> = BTreeMap::new();
        for (id, block) in self.stones() {
            parts.entry(leads[id]).or_default().push(block.shape.mass_properties());
        }
        let there = self.stones().filter(|(_, block)| block.support != Support::Absent);
        let located = there.map(|(id, block)| {
            let centroid = MassProperties::together(&parts[&leads[id]]).centroid;
            let (low, high) = block.shape.bounds();
            Located { id, middle: [centroid.x, centroid.z], low, high }
        });
        located.collect()
    }

    /// The y of the back and of the front face (m), the same at the height of every stone inside.
    fn faces(&self, inside: &[Located], all: &[Located]) -> Result<[f64; 2], WindowFault> {
        let [low, high] = bounds(all);
        let elsewhere = [low.y, high.y];
        let equal = EQUAL * (high.y - low.y);
        for own in inside {
            let height = 0.5 * (own.low.z + own.high.z);
            let mut here = [f64::INFINITY, f64::NEG_INFINITY];
            for other in all.iter().filter(|other| other.low.z <= height && height <= other.high.z) {
                for y in ys_at(&self.blocks[other.id].shape, height) {
                    here = [here[0].min(y), here[1].max(y)];
                }
            }
            if (0..2).any(|face| (here[face] - elsewhere[face]).abs() > equal) {
                return Err(WindowFault::Uneven { height, here, elsewhere });
            }
        }
        Ok(elsewhere)
    }
}

/// Where a stone, or a part of one, is in a wall.
#[derive(Clone, Copy)]
struct Located {
    id: usize,
    /// Along x and along z (m): of the whole stone, where this is a part of one.
    middle: [f64; 2],
    /// Lowest corner of the box around it (m).
    low: Vec3,
    /// Highest corner (m).
    high: Vec3,
}

impl Located {
    /// Whether the boxes come within `reach` (m) of each other.
    fn is_near(&self, other: &Located, reach: f64) -> bool {
        (0..3).all(|axis| {
            self.low[axis] <= other.high[axis] + reach && other.low[axis] <= self.high[axis] + reach
        })
    }

    /// A side on which none of the others goes on: none begins within `reach` (m) of it, goes further than it, and lies beside it;
    /// all by more than `equal` (m).
    fn open_side(&self, others: &[Located], reach: f64, equal: f64) -> Option<Side> {
        let goes_on = |side: Side, other: &Located| {
            let (axis, beside) = match side {
                Side::Left | Side::Right => (0, 2),
                Side::Below | Side::Above => (2, 0),
            };
            let further = match side {
                Side::Left | Side::Below => other.low[axis] < self.low[axis] - equal,
                Side::Right | Side::Above => other.high[axis] > self.high[axis] + equal,
            };
            let overlap = self.high[beside].min(other.high[beside]) - self.low[beside].max(other.low[beside]);
            further && overlap > equal && self.is_near(other, reach)
        };
        [Side::Left, Side::Right, Side::Below, Side::Above]
            .into_iter()
            .find(|side| !others.iter().any(|other| goes_on(*side, other)))
    }
}

/// Lowest and highest corner of the box around stones (m).
fn bounds(stones: &[Located]) -> [Vec3; 2] {
    let none = [Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)];
    stones.iter().fold(none, |[low, high], own| [low.inf(&own.low), high.sup(&own.high)])
}

/// The y (m) at which the edges of a solid pass a height (m).
fn ys_at(solid: &Polyhedron, height: f64) -> impl Iterator<Item = f64> + '_ {
    let edges = solid.faces.iter().flat_map(|face| face.iter().zip(face.iter().cycle().skip(1)));
    edges.filter_map(move |(&a, &b)| {
        let (p, q) = (solid.vertices[a as usize], solid.vertices[b as usize]);
        let passes = p.z <= height && height <= q.z && p.z < q.z;
        passes.then(|| p.y + (q.y - p.y) * ((height - p.z) / (q.z - p.z)))
    })
}
