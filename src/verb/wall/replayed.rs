//! The files of a replay: series for ParaView, an animation, and the wall at rest and at the end as OBJ.

use std::fs;
use std::path::Path;

use crate::ensemble::{RunError, replace_file};
use crate::exchange::write_obj;
use crate::model::{Replay, ReplayState, Support, Wall};
use crate::render::gltf::{Actor, Role, write_glb};
use crate::render::picture::{Picture, Stone};
use crate::render::vtk::{SERIES, write_series};
use crate::shape::MassProperties;
use crate::terminal::failure::Failure;
use crate::terminal::output;

/// A wall, the names of its blocks by their ids, and which of them take part in the mechanism.
type Named<'w> = (&'w Wall, &'w dyn Fn(usize) -> String, &'w dyn Fn(usize) -> bool);

/// Writes the files of a wall's replay; `names` are those of its blocks, `moving` those that take part in the mechanism.
pub(crate) fn write(
    folder: &Path,
    title: &str,
    (wall, names, moving): Named<'_>,
    replay: &Replay,
) -> Result<(), Failure> {
    output::folder(&folder.join(SERIES))?;
    forget(&folder.join(SERIES));
    write_series(wall, replay, |name, text| replace_file(&folder.join(name), text.as_bytes()))?;
    let role = |id: usize| match () {
        () if wall.blocks[id].support == Support::Fixed => Role::Fixed,
        () if moving(id) => Role::Moving,
        () => Role::Standing,
    };
    let actors: Vec<Actor> = wall
        .blocks
        .iter()
        .enumerate()
        .map(|(id, block)| Actor { name: names(id), shape: &block.shape, role: role(id) })
        .collect();
    replace_file(&folder.join("wall.glb"), &write_glb(title, &actors, replay, magnification(wall, replay)))?;
    let moved = |name: &str, state: &ReplayState| -> Result<(), RunError> {
        replace_file(&folder.join(name), write_obj(&in_state(wall, state)).as_bytes())
    };
    if let Some(rest) = replay.states.iter().rev().find(|state| state.is_equilibrium) {
        moved("rest.obj", rest)?;
    }
    let end = if replay.is_in_time() { "end.obj" } else { "collapse.obj" };
    if let Some(last) = replay.states.last().filter(|state| !state.is_equilibrium) {
        moved(end, last)?;
    }
    Ok(())
}

/// Removes the files of an earlier replay, which may have had more states: a program that opens them by their numbers would mix the two.
pub(crate) fn forget(series: &Path) {
    let Ok(entries) = fs::read_dir(series) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let is_ours = ["wall-", "joints-", "frame-"].iter().any(|stem| name.starts_with(stem));
        if is_ours && (name.ends_with(".vtu") || name.ends_with(".svg")) {
            // One that cannot be removed cannot be replaced either, which is told then.
            let _ = fs::remove_file(&path);
        }
    }
}

/// The blocks of a wall where a state has them, without those that fell out before.
pub(crate) fn in_state(wall: &Wall, state: &ReplayState) -> Wall {
    let here = wall.blocks.iter().zip(&state.poses).enumerate();
    let there = here.filter(|(id, _)| state.gone.binary_search(&(*id as u32)).is_err());
    let moved = there.map(|(_, (block, pose))| {
        let mut block = block.clone();
        let centroid = block.shape.mass_properties().centroid;
        block.shape.vertices = pose.taking(centroid, &block.shape.vertices);
        if let Some(scan) = &mut block.scan {
            let moved = pose.taking(centroid, &[scan.centroid])[0];
            *scan = MassProperties { centroid: moved, ..scan.mapped(&pose.rotation()) };
        }
        block
    });
    Wall { blocks: moved.collect() }
}

/// A fall is shown in its true size, and so is what is followed in time; what a wall moves by that stands is magnified to be seen.
pub(crate) fn magnification(wall: &Wall, replay: &Replay) -> f64 {
    match replay.states.last() {
        Some(last) if last.is_equilibrium && !replay.is_in_time() => {
            let blocks = wall.blocks.iter().zip(&last.poses);
            let stones: Vec<Stone> =
                blocks.map(|(block, pose)| Stone::moved(block.shape.clone(), *pose)).collect();
            Picture::fitting(&stones)
        }
        _ => 1.0,
    }
}
