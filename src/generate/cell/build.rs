//! A member's cell from its layout and its streams.

use crate::generate::cell::{CellFault, bond, check_cell, courses};
use crate::generate::course::MAX_STONES;
use crate::generate::coursed::Coursed;
use crate::generate::cut::{self, Cuts};
use crate::generate::draft::{Draft, Extent, Fault, Stone, Tally};
use crate::generate::wall::{build, size_factor};
use crate::generate::{Arrangement, InvalidGeometry, Layout, Outline, Realised};
use crate::model::Cell;
use crate::random::Streams;

/// A cell and what it took to make it.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneratedCell {
    /// The cell, its stones from below upwards.
    pub cell: Cell,
    /// Fresh starts needed, 1 when the first one was valid.
    pub attempts: u32,
    /// Slivers merged into a neighbour: stones before the joint where a course began that were too short to be one.
    pub merges: u32,
    /// Single redraws (phase, bed, length, cut, wedge) over all attempts.
    pub redraws: u32,
    /// What was realised, beside what was asked for.
    pub realised: Realised,
}

/// Builds the periodic cell of one member, of `stones` stones along the wall and courses: a pure function of the layout, the
/// stones, and the streams' seed and member.
///
/// The cell is as long as so many mean stones and as high as so many mean courses, times the wall's size factor where one is
/// drawn; the outline gives its thickness only. All head joints have the layout's gap, and stones of all courses may have
/// wedges. Across the period:
///
/// * A stack bond goes on.
/// * A running bond goes on as well, for an even number of courses. An odd number is raking instead: every course is shifted from
///   the one below by `overlap`, the next cell as well, so that one stone is a cell of it. For a half bond both are the same.
/// * Random courses: exactly as many as asked for, with heights fitted to fill the cell. There is one bed under each course; that
///   under the lowest is also that on the highest. Each course begins at a head joint of its own random place (stream
///   `cell phase`) and fills the length as in a wall. Head joints keep their overlap from the course below and, for the
///   last one, from the first course of the next cell.
/// * Cuts divide the box. Its border is a through joint, which no stone crosses: a level bed below and above, and head joints at
///   both ends as high as the cell. Cells of one row stand half a cell over those below, so that no head joint
///   runs through all of them.
///
/// ```
/// use pirca::generate::{Arrangement, generate_cell};
/// use pirca::random::Streams;
/// # use pirca::generate::{BatteredFace, Layout, Limits, Outline, Wythes};
/// # use pirca::random::Family;
/// let layout = Layout {
///     arrangement: Arrangement::Discontinuous { length: 0.25, height: 0.1, overlap: 0.5 },
///     // ...
/// #   outline: Outline { length: 1.0, height: 1.0, base_thickness: 0.12, top_thickness: 0.12, battered_face: BatteredFace::Front },
/// #   density: Family::Constant { value: 2000.0 },
/// #   wythes: Wythes { count: 1, header_share: 0.0 },
/// #   head_joint_gap: 0.0,
/// #   wedges: None,
/// #   limits: Limits { min_size: 0.01, max_aspect: 10.0, min_volume: 1e-6, max_redraws: 10, max_attempts: 1 },
/// };
/// let made = generate_cell(&layout, [1, 1], &Streams::new(1, 0)).expect("one stone");
/// assert_eq!(made.cell.lattice, [[0.25, 0.0], [0.125, 0.1]]);
/// ```
///
/// # Errors
/// [`CellFault`] when the layout or the number of stones can be no cell, or no valid one came out of the attempts.
pub fn generate_cell(
    layout: &Layout,
    stones: [u32; 2],
    streams: &Streams,
) -> Result<GeneratedCell, CellFault> {
    check_cell(layout, stones)?;
    let lattice = lattice(layout, stones, member_factor(layout, streams)?).ok_or(CellFault::File)?;
    let outline = Outline { length: lattice[0][0], height: lattice[1][1], ..layout.outline };
    let filled = Layout { outline, ..layout.clone() };
    let made = build(&filled, Extent::Cell, streams, |draft| lay(draft, stones))?;
    Ok(GeneratedCell {
        cell: Cell { blocks: made.wall.blocks, lattice, thickness: outline.base_thickness },
        attempts: made.attempts,
        merges: made.merges,
        redraws: made.redraws,
        realised: made.realised,
    })
}

/// The factor on all sizes of this member, the same in all its attempts.
fn member_factor(layout: &Layout, streams: &Streams) -> Result<f64, InvalidGeometry> {
    match &layout.arrangement {
        Arrangement::Continuous { .. } | Arrangement::Discontinuous { .. } | Arrangement::File { .. } => {
            Ok(1.0)
        }
        Arrangement::Coursed { wall_size_factor, .. } | Arrangement::Cut { wall_size_factor, .. } => {
            let mut tally = Tally::default();
            let mut draft = Draft::new(layout, Extent::Cell, streams, 1, &mut tally);
            let factor = size_factor(&mut draft, wall_size_factor);
            factor.map_err(|fault| InvalidGeometry {
                reason: fault.to_string(),
                attempts: 1,
                redraws: tally.redraws,
            })
        }
    }
}

/// The two lattice vectors (m), see [`generate_cell`]; `None` of a file, whose stones do not repeat.
fn lattice(layout: &Layout, stones: [u32; 2], factor: f64) -> Option<[[f64; 2]; 2]> {
    let [along, courses] = stones.map(f64::from);
    Some(match &layout.arrangement {
        Arrangement::File { .. } => return None,
        Arrangement::Continuous { length, height } => [[along * length, 0.0], [0.0, courses * height]],
        Arrangement::Discontinuous { length, height, overlap } => {
            let shift = length * bond::shift(*overlap, stones[1], stones[1]);
            [[along * length, 0.0], [shift, courses * height]]
        }
        Arrangement::Coursed { sizes, .. } => {
            let [length, height] = sizes.means();
            [[factor * along * length, 0.0], [0.0, factor * courses * height]]
        }
        Arrangement::Cut { sizes, .. } => {
            let [length, height] = sizes.means().map(|mean| factor * mean);
            [[along * length, 0.0], [0.5 * along * length, courses * height]]
        }
    })
}

/// Lays the stones of a cell.
fn lay(draft: &mut Draft, stones: [u32; 2]) -> Result<Vec<Stone>, Fault> {
    if u64::from(stones[0]) * u64::from(stones[1]) > MAX_STONES as u64 {
        return Err(Fault::TooMany { limit: MAX_STONES });
    }
    match &draft.layout.arrangement {
        // It has no lattice either, and so nothing is laid.
        Arrangement::File { .. } => Err(Fault::NoOutline),
        Arrangement::Continuous { length, .. } => bond::lay(draft, stones, *length, 0.0),
        Arrangement::Discontinuous { length, overlap, .. } => bond::lay(draft, stones, *length, *overlap),
        Arrangement::Coursed { sizes, wall_size_factor, dip, least_overlap } => {
            let factor = size_factor(draft, wall_size_factor)?;
            courses::lay(draft, &Coursed { sizes, factor, dip, least_overlap: *least_overlap }, stones[1])
        }
        Arrangement::Cut { sizes, wall_size_factor, dip, dip_about } => {
            let factor = size_factor(draft, wall_size_factor)?;
            cut::lay(draft, &Cuts { sizes, factor, dip, dip_about: *dip_about })
        }
    }
}
