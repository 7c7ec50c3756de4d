//! What a layout must be to have a cell.

use crate::generate::{Arrangement, InvalidGeometry, Layout};

/// Why a layout has no cell of the size asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CellFault {
    /// No stones along the wall, or no course.
    #[error(
        "a cell of {} stones along the wall in {} courses has none: give at least 1 stone and 1 course",
        stones[0], stones[1]
    )]
    NoStones {
        /// Stones along the wall and courses, as asked for.
        stones: [u32; 2],
    },
    /// The stones are those of a file.
    #[error(
        "a file says where the stones of one wall are, and they repeat in no direction: a plate is homogenised from cells that repeat. Draw \
         the masonry by an arrangement with the same sizes of stones"
    )]
    File,
    /// The outline is battered.
    #[error(
        "the wall is {base} m thick at its base and {top} m at its top, but cells tile a plate of one thickness: give both the same"
    )]
    Battered {
        /// Thickness at the base (m).
        base: f64,
        /// Thickness at the top (m).
        top: f64,
    },
    /// A running bond whose courses are not shifted, or by no share of a stone.
    #[error(
        "a running bond that shifts its courses by {overlap} stone lengths is none: give an overlap above 0 and below 1, such as 0.5, or \
         take a stack bond"
    )]
    NoOverlap {
        /// The shift asked for, as a share of the stone length.
        overlap: f64,
    },
    /// Random courses, odd in number, that cannot all keep their head joints apart.
    #[error(
        "head joints of neighbouring courses are to keep {asked} stone lengths apart, but in a cell of {courses} courses, the last of \
         which lies under the first one of the next cell, they can keep {most:.3} at most: take an even number of courses, more of \
         them, or a lower least overlap"
    )]
    NoRoom {
        /// Courses of the cell.
        courses: u32,
        /// The least overlap asked for, as a share of the mean stone length.
        asked: f64,
        /// The largest that equal stones allow.
        most: f64,
    },
    /// The cell was asked for well, but no valid one came out within the attempts.
    #[error(transparent)]
    Invalid(#[from] InvalidGeometry),
}

/// Refuses what no draw could make a cell of, before anything is drawn.
///
/// # Errors
/// [`CellFault`], of every kind but an invalid draw.
pub fn check_cell(layout: &Layout, stones: [u32; 2]) -> Result<(), CellFault> {
    let (base, top) = (layout.outline.base_thickness, layout.outline.top_thickness);
    if stones.contains(&0) {
        return Err(CellFault::NoStones { stones });
    }
    if layout.arrangement.is_file() {
        return Err(CellFault::File);
    }
    if base != top {
        return Err(CellFault::Battered { base, top });
    }
    match layout.arrangement {
        Arrangement::Discontinuous { overlap, .. } if !(overlap > 0.0 && overlap < 1.0) => {
            Err(CellFault::NoOverlap { overlap })
        }
        Arrangement::Coursed { least_overlap: asked, .. } => {
            let courses = stones[1];
            let most = room(courses);
            if asked > most { Err(CellFault::NoRoom { courses, asked, most }) } else { Ok(()) }
        }
        _ => Ok(()),
    }
}

/// How far, in stone lengths, the head joints of neighbouring courses of equal stones can keep apart all round the period.
///
/// The shifts from course to course add up to whole stones; an odd number of shifts by half a stone does not.
fn room(courses: u32) -> f64 {
    if courses.is_multiple_of(2) { 0.5 } else { 0.5 * f64::from(courses - 1) / f64::from(courses) }
}
