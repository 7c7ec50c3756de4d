//! A member's wall from its layout and its streams: attempt after attempt until one is valid.

use crate::generate::coursed::{self, Coursed};
use crate::generate::cut::{self, Cuts};
use crate::generate::draft::{Draft, Extent, Fault, Stone, Tally};
use crate::generate::{Arrangement, Layout, regular, wedge};
use crate::model::{Block, Tag, Wall};
use crate::random::{Family, Streams};

/// A wall and what it took to make it.
#[derive(Clone, Debug, PartialEq)]
pub struct Generated {
    /// Stones only, ids from the base up; the base is the plane z = 0 and is added by the protocol, as are the ends.
    pub wall: Wall,
    /// Fresh starts needed, 1 when the first one was valid.
    pub attempts: u32,
    /// Slivers merged into a neighbour: stones at the end of a course that were too short to be one.
    pub merges: u32,
    /// Single redraws (bed, length, cut, wedge) over all attempts.
    pub redraws: u32,
    /// What was realised, beside what was asked for.
    pub realised: Realised,
}

/// Realised values, in the order of drawing.
///
/// The `first_` values are draws before any rejection, of failed attempts as well: their distribution is the one asked
/// for, and the difference to the realised ones is what rejection costs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Realised {
    /// Factor on the lengths and heights of this wall; 1 where none is drawn.
    pub size_factor: f64,
    /// Dips of beds or cuts (rad).
    pub dips: Vec<f64>,
    /// Dips as first drawn, before any rejection (rad).
    pub first_dips: Vec<f64>,
    /// Stone lengths along x (m), from the middle of one head joint to that of the next; those of a cut wall
    /// through the centroid, between slots.
    pub lengths: Vec<f64>,
    /// Lengths as first drawn, with the wall's size factor (m).
    pub first_lengths: Vec<f64>,
    /// Course heights, in a cut wall stone heights through the centroid (m).
    pub heights: Vec<f64>,
    /// Heights as first drawn, with the wall's size factor, before they were fitted to the wall (m).
    pub first_heights: Vec<f64>,
    /// Height and depth of every wedge stone (m).
    pub wedge_sizes: Vec<[f64; 2]>,
    /// Number of wedge stones.
    pub wedges: u32,
    /// Number of stones that were to get a wedge; more than `wedges` where none fitted.
    pub wedges_wanted: u32,
    /// Number of header stones.
    pub headers: u32,
    /// Volume of the outline less the stated gaps (m^3).
    pub volume: f64,
}

/// Why no valid wall came out within the attempts.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason} ({attempts} attempts, {redraws} redraws)")]
pub struct InvalidGeometry {
    /// The fault of the last attempt, in words.
    pub reason: String,
    /// Attempts made.
    pub attempts: u32,
    /// Single redraws made over all attempts.
    pub redraws: u32,
}

/// Builds the wall of one member: a pure function of the layout and the streams' seed and member.
///
/// Every stone is cut from the outline, so that neighbours fit; every attempt draws from its own streams.
///
/// # Errors
/// [`InvalidGeometry`] when the attempts ran out, or at once when no attempt could succeed; never a substitute.
pub fn generate(layout: &Layout, streams: &Streams) -> Result<Generated, InvalidGeometry> {
    let build =
        |lay: &dyn Fn(&mut Draft) -> Result<Vec<Stone>, Fault>| build(layout, Extent::Wall, streams, lay);
    match &layout.arrangement {
        Arrangement::File { wall, unseen, .. } => {
            let drawn = unseen.as_ref().map(|unseen| unseen.drawn(wall, streams)).transpose()?;
            Ok(stated(drawn.as_ref().unwrap_or(wall), layout.density.mean()))
        }
        Arrangement::Continuous { length, height } => {
            build(&|draft| regular::lay(draft, *length, *height, 0.0))
        }
        Arrangement::Discontinuous { length, height, overlap } => {
            build(&|draft| regular::lay(draft, *length, *height, *overlap))
        }
        Arrangement::Coursed { sizes, wall_size_factor, dip, least_overlap } => build(&|draft| {
            let factor = size_factor(draft, wall_size_factor)?;
            coursed::lay(draft, &Coursed { sizes, factor, dip, least_overlap: *least_overlap })
        }),
        Arrangement::Cut { sizes, wall_size_factor, dip, dip_about } => build(&|draft| {
            let factor = size_factor(draft, wall_size_factor)?;
            cut::lay(draft, &Cuts { sizes, factor, dip, dip_about: *dip_about })
        }),
    }
}

/// Mean density (kg/m^3) of a wall's stones, by volume; NaN without stones.
pub fn mean_density(wall: &Wall) -> f64 {
    let [mass, volume] = mass_and_volume(wall);
    mass / volume
}

/// Mass (kg) and volume (m^3) of a wall's stones.
fn mass_and_volume(wall: &Wall) -> [f64; 2] {
    let mass = wall.stones().map(|(_, block)| block.mass()).sum();
    [mass, wall.stones().map(|(_, block)| block.volume()).sum()]
}

/// The wall of a file, its stones made as much heavier or lighter as their mean density (kg/m^3) asks.
fn stated(wall: &Wall, density: f64) -> Generated {
    let (mut wall, [mass, volume]) = (wall.clone(), mass_and_volume(wall));
    let factor = if density == mass / volume { 1.0 } else { density * volume / mass };
    let stones = wall.before_base();
    wall.blocks[..stones].iter_mut().for_each(|stone| stone.density *= factor);
    let count = |tag: Tag| wall.stones().filter(|(_, block)| block.tag == tag).count() as u32;
    let (wedges, headers) = (count(Tag::Wedge), count(Tag::Header));
    let realised = Realised { size_factor: 1.0, wedges, headers, volume, ..Realised::default() };
    Generated { wall, attempts: 1, merges: 0, redraws: 0, realised }
}

/// Attempt after attempt until `lay` has filled the outline.
pub(crate) fn build(
    layout: &Layout,
    extent: Extent,
    streams: &Streams,
    lay: impl Fn(&mut Draft) -> Result<Vec<Stone>, Fault>,
) -> Result<Generated, InvalidGeometry> {
    let mut tally = Tally::default();
    let most = layout.limits.max_attempts.max(1);
    let mut attempts = 1;
    loop {
        let mut draft = Draft::new(layout, extent, streams, attempts, &mut tally);
        match attempt(&mut draft, &lay) {
            Ok(stones) => return Ok(finish(draft, stones, attempts)),
            Err(fault) if attempts == most || fault.is_final() => {
                return Err(InvalidGeometry { reason: fault.to_string(), attempts, redraws: tally.redraws });
            }
            Err(_) => attempts += 1,
        }
    }
}

/// The stones of one attempt, with their wedges.
fn attempt(
    draft: &mut Draft,
    lay: impl Fn(&mut Draft) -> Result<Vec<Stone>, Fault>,
) -> Result<Vec<Stone>, Fault> {
    if !draft.layout.outline.has_volume() {
        return Err(Fault::NoOutline);
    }
    draft.realised.size_factor = 1.0;
    let stones = lay(draft)?;
    Ok(wedge::insert(draft, stones))
}

/// The factor on all sizes of this wall. It is the same in every attempt: a mean size of which no wall can be built is
/// an invalid geometry, not a reason to draw another one and so to narrow the population.
pub(crate) fn size_factor(draft: &mut Draft, family: &Family) -> Result<f64, Fault> {
    let mut stream = draft.member_stream("wall size");
    let factor = draft.draw("wall size factor", family, 1.0, 0.0, &mut stream)?;
    draft.realised.size_factor = factor;
    Ok(factor)
}

/// Draws the densities and closes the books.
fn finish(draft: Draft, stones: Vec<Stone>, attempts: u32) -> Generated {
    let (layout, mut realised) = (draft.layout, draft.realised.clone());
    let blocks: Vec<Block> = stones
        .into_iter()
        .map(|stone| {
            let quantity = if stone.tag == Tag::Wedge { "wedge density" } else { "density" };
            Block {
                tag: stone.tag,
                ..Block::stone(stone.shape, layout.density.sample(&mut draft.stream(quantity, stone.place)))
            }
        })
        .collect();
    let count = |tag: Tag| blocks.iter().filter(|b| b.tag == tag).count() as u32;
    (realised.wedges, realised.headers) = (count(Tag::Wedge), count(Tag::Header));
    realised.volume = layout.outline.volume() - draft.gaps;
    let volume: f64 = blocks.iter().map(|b| b.shape.volume()).sum();
    // A cut may move a vertex by the cut tolerance, 1e-9 m of metres: far below this bound.
    let fills = (volume - realised.volume).abs() <= 1e-6 * realised.volume;
    crate::check!(fills, "the stones fill {volume} m^3 of {} m^3", realised.volume);
    let Tally { redraws, first_dips, first_lengths, first_heights } = std::mem::take(draft.tally);
    let realised = Realised { first_dips, first_lengths, first_heights, ..realised };
    Generated { wall: Wall { blocks }, attempts, merges: draft.merges, redraws, realised }
}
