//! The wall along its axes, as it stands before the load; and what mending moved, in colours.

use crate::exchange::WallFile;
use crate::math::Vec3;
use crate::mend::Mended;
use crate::model::Support;
use crate::render::number::significant;
use crate::render::picture::{Shade, Views};
use crate::verb::analyse::ask::Analyse;

/// Stones that are named, those that moved most.
const NAMED: usize = 3;

/// Drawings of a wall along its axes.
pub(crate) struct AlongAxes {
    /// The wall before the load.
    pub whole: Views,
    /// What mending moved, where it moved anything.
    pub moved: Option<Views>,
}

impl AlongAxes {
    /// Of a wall, and of what was done to its stones.
    pub fn of(asked: &Analyse, file: &WallFile, done: Option<&Mended>) -> AlongAxes {
        AlongAxes { whole: views(asked, file), moved: done.and_then(|done| moved(asked, file, done)) }
    }
}

/// Its face, a section and its plan.
pub(crate) fn views(asked: &Analyse, file: &WallFile) -> Views {
    let towards = (asked.direction.unit(), format!("load {}", asked.direction));
    drawn(file, format!("{}: before the load", asked.title()), Some(towards), None)
}

/// Its face and a section, stones coloured by how far mending moved them; `None` where it moved none.
fn moved(asked: &Analyse, file: &WallFile, done: &Mended) -> Option<Views> {
    let mut values = vec![0.0; file.wall.blocks.len()];
    done.stones.iter().for_each(|own| values[own.block] = own.moved_m);
    let mut most: Vec<usize> =
        done.stones.iter().map(|own| own.block).filter(|at| values[*at] > 0.0).collect();
    most.sort_by(|a, b| values[*b].total_cmp(&values[*a]).then(a.cmp(b)));
    most.truncate(NAMED);
    let named = |at: &usize| format!("{} by {} mm", file.names[*at], significant(1e3 * values[*at], 3));
    let named: Vec<String> = most.iter().map(named).collect();
    if named.is_empty() {
        return None;
    }
    let shade = Shade {
        labels: most.iter().map(|at| (*at, file.ids[*at].to_string())).collect(),
        values,
        measure: "largest distance that a corner was moved".to_owned(),
        unit: ("mm", 1e3),
    };
    let title = format!("{}: what mending moved", asked.title());
    let mut drawn = drawn(file, title, None, Some(shade));
    drawn.remarks.push(format!("Moved most: {}.", named.join(", ")));
    Some(drawn)
}

fn drawn(file: &WallFile, title: String, load: Option<(Vec3, String)>, shade: Option<Shade>) -> Views {
    let blocks = &file.wall.blocks;
    Views {
        title,
        shapes: blocks.iter().map(|block| block.shape.clone()).collect(),
        fixed: blocks.iter().map(|block| block.support == Support::Fixed).collect(),
        load,
        shade,
        remarks: vec![
            "In brackets the axes to the right and up; the face is seen from the back (-y), the section A-A towards -x."
                .to_owned(),
            "Dimensions are those of all blocks that are not fixed.".to_owned(),
        ],
    }
}
