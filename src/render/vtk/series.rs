//! The states of a replay as a series of files, with a collection for the blocks and one for the joints.

use std::fmt::Write;

use crate::math::Vec3;
use crate::model::{Replay, Wall};
use crate::render::vtk::{joints, wall};

/// The folder of the files of the states, beside the collections.
pub const SERIES: &str = "series";

/// Hands over the files of a replay, each with its name from the folder that they are for: `wall.pvd` and `joints.pvd`, which ParaView
/// opens and plays, and a `.vtu` of the blocks and one of the joints for every state. The time of a state is its number; its load and
/// whether it is at rest are field data. In all files the wall is where it was built, with the displacements in point data.
///
/// # Errors
/// Whatever `write` answers, which then is not called any more.
pub fn write_series<E>(
    built: &Wall,
    replay: &Replay,
    mut write: impl FnMut(&str, &str) -> Result<(), E>,
) -> Result<(), E> {
    let centroids: Vec<Vec3> =
        built.blocks.iter().map(|block| block.shape.mass_properties().centroid).collect();
    for (number, state) in replay.states.iter().enumerate() {
        write(&name("wall", number), &wall::in_state(built, state))?;
        write(&name("joints", number), &joints::in_state(replay, &centroids, state))?;
    }
    for stem in ["wall", "joints"] {
        write(&format!("{stem}.pvd"), &collection(stem, replay.states.len()))?;
    }
    Ok(())
}

/// The file of a state.
fn name(stem: &str, number: usize) -> String {
    format!("{SERIES}/{stem}-{number:03}.vtu")
}

fn collection(stem: &str, states: usize) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for number in 0..states {
        let file = name(stem, number);
        let _ = writeln!(text, "<DataSet timestep=\"{number}\" group=\"\" part=\"0\" file=\"{file}\"/>");
    }
    text + "</Collection>\n</VTKFile>\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Block, BuiltJoint, JointReading, Level, Movement, ReplayState};
    use crate::shape::Polyhedron;

    #[test]
    fn a_replay_is_two_collections_with_a_file_for_every_state() {
        let shape = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(1.0, 1.0, 1.0));
        let polygon = shape.vertices[..4].to_vec();
        let block = Block::stone(shape, 2400.0);
        let wall = Wall { blocks: vec![block] };
        let joint = |blocks| BuiltJoint {
            blocks,
            gaps: vec![0.0; 4],
            polygon: polygon.clone(),
            normal: -Vec3::z(),
            middle: Vec3::zeros(),
            area: 1.0,
        };
        let state = |is_equilibrium: bool, gone: Vec<u32>| ReplayState {
            level: Level::Tilt(0.25),
            is_equilibrium,
            poses: vec![Movement { shift: Vec3::x(), turn: Vec3::zeros() }],
            joints: vec![JointReading { normal_stress: 5.0, opening: 0.125, ..JointReading::default() }; 2],
            gone,
        };
        let states = vec![state(true, vec![]), state(false, vec![]), state(false, vec![0])];
        // The second joint is between blocks beside the wall.
        let replay = Replay { joints: vec![joint([0, 1]), joint([1, 2])], states, is_mechanism: false };
        let mut files: Vec<(String, String)> = Vec::new();
        let taken: Result<(), ()> = write_series(&wall, &replay, |name, text| {
            files.push((name.to_owned(), text.to_owned()));
            Ok(())
        });
        assert_eq!((taken, files.len()), (Ok(()), 8));
        let of = |name: &str| &files.iter().find(|file| file.0 == name).expect("it was written").1;
        assert_eq!(of("wall.pvd").matches("<DataSet").count(), 3);
        assert!(
            of("joints.pvd").contains("timestep=\"2\" group=\"\" part=\"0\" file=\"series/joints-002.vtu\"")
        );
        let after = |text: &str, name: &str| {
            let at = text.find(&format!("Name=\"{name}\"")).expect("an array");
            text[at..].lines().nth(1).expect("its first entry").to_owned()
        };
        let joints = of("series/joints-001.vtu");
        assert!(joints.contains("NumberOfPoints=\"4\" NumberOfCells=\"1\""), "{joints}");
        let read = ["second", "opening", "normal_stress", "state", "displacement", "load", "at_rest"];
        assert_eq!(read.map(|name| after(joints, name)), ["-1", "0.125", "5", "1", "1 0 0", "0.25", "0"]);
        assert_eq!(after(of("series/joints-002.vtu"), "state"), "3");
        assert_eq!(
            ["wall-000", "wall-002"].map(|of_| after(of(&format!("series/{of_}.vtu")), "there")),
            ["1", "0"]
        );
        assert_eq!(after(of("series/wall-000.vtu"), "at_rest"), "1");
        assert!(files.iter().all(|(_, text)| !text.contains("NumberOfComponents=\"1\"")));
    }
}
