//! Pictures of a wall in every state of its replay, all on the same stage.

use std::path::Path;

use crate::ensemble::replace_file;
use crate::model::{BuiltJoint, JointReading, Replay, Wall};
use crate::render::picture::{Picture, Seam, Stage, Stone};
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::wall::drawn::{Measure, sides};
use crate::verb::wall::replayed;

/// What all frames show alike.
pub(crate) struct Shown<'s> {
    pub title: String,
    pub wall: &'s Wall,
    pub colour: Measure,
    pub magnify: Option<f64>,
    pub from_front: bool,
}

/// Writes `frame-000.svg` and so on into a folder; how many there are.
pub(crate) fn write(folder: &Path, shown: &Shown<'_>, replay: &Replay) -> Result<usize, Failure> {
    output::folder(folder)?;
    replayed::forget(folder);
    let magnification = shown.magnify.unwrap_or_else(|| replayed::magnification(shown.wall, replay));
    let frames: Vec<Picture> =
        (0..replay.states.len()).map(|number| frame(shown, replay, number, magnification)).collect();
    let Some(stage) = frames.iter().map(Picture::stage).reduce(|all, next| Stage::with(&all, &next)) else {
        return Ok(0);
    };
    for (number, frame) in frames.iter().enumerate() {
        replace_file(&folder.join(format!("frame-{number:03}.svg")), frame.svg_on(&stage).as_bytes())?;
    }
    Ok(frames.len())
}

fn frame(shown: &Shown<'_>, replay: &Replay, number: usize, magnification: f64) -> Picture {
    let state = &replay.states[number];
    // Blocks that have fallen out are not drawn: those behind them are counted on.
    let gone_before = |id: usize| state.gone.partition_point(|gone| (*gone as usize) < id);
    let is_there = |id: usize| state.gone.binary_search(&(id as u32)).is_err();
    let blocks = shown.wall.blocks.iter().zip(&state.poses).enumerate().filter(|(id, _)| is_there(*id));
    let stones = blocks.map(|(_, (block, pose))| Stone::moved(block.shape.clone(), *pose)).collect();
    let all = shown.wall.blocks.len();
    let drawn = |id: u32| if (id as usize) < all { id as usize - gone_before(id as usize) } else { all };
    let seam = |(joint, reading): (&BuiltJoint, &JointReading)| {
        joint.blocks.iter().all(|id| is_there(*id as usize)).then(|| Seam {
            blocks: joint.blocks.map(drawn),
            polygon: joint.polygon.clone(),
            value: shown.colour.read(reading),
        })
    };
    let (side, end) = sides(shown.from_front);
    Picture {
        stones,
        seams: replay.joints.iter().zip(&state.joints).filter_map(seam).collect(),
        hinges: Vec::new(),
        thrusts: Vec::new(),
        measure: shown.colour.in_words().to_owned(),
        unit: shown.colour.unit(),
        from_front: shown.from_front,
        magnification,
        title: shown.title.clone(),
        remarks: vec![
            format!("State {} of {}: {}.", number + 1, replay.states.len(), replay.said(state)),
            format!("Movements times {magnification}; seen from the {side}, x = 0 on the {end}."),
        ],
    }
}
