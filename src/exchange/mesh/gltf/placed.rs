//! Where the nodes of a glTF scene are: their transforms, one below the other.

use nalgebra::{Quaternion, UnitQuaternion};

use crate::exchange::fault::Fault;
use crate::exchange::mesh::gltf::document::{Document, Node};
use crate::exchange::mesh::{quoted, refusal};
use crate::math::{Mat3, Vec3};

const TREE: &str = "nodes that hang below one other node or none, as trees";
const EXPORT: &str = "export it again";

/// A transform of points: `p` goes to `turn * p + shift`.
#[derive(Clone, Copy)]
pub(super) struct Pose {
    turn: Mat3,
    shift: Vec3,
}

impl Pose {
    const NONE: Pose = Pose {
        turn: Mat3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        shift: Vec3::new(0.0, 0.0, 0.0),
    };

    /// Where a point of the node is in the scene.
    pub fn of(&self, point: &Vec3) -> Vec3 {
        self.turn * point + self.shift
    }

    /// The pose in the scene of what has this pose below a node.
    fn below(self, above: &Pose) -> Pose {
        Pose { turn: above.turn * self.turn, shift: above.of(&self.shift) }
    }

    /// That of a node relative to the one above it, or what is wrong with it.
    fn stated(node: &Node) -> Result<Pose, String> {
        if let Some(m) = &node.matrix {
            if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
                return Err("its matrix does not end with the row 0, 0, 0, 1".to_owned());
            }
            let turn = Mat3::new(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]);
            return Ok(Pose { turn, shift: Vec3::new(m[12], m[13], m[14]) });
        }
        let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let quaternion = Quaternion::new(w, x, y, z);
        let norm = quaternion.norm();
        if !(norm.is_finite() && norm > 0.0) {
            return Err(format!("its rotation ({x}, {y}, {z}, {w}) is none"));
        }
        // Of single precision in the file: its length is 1 to seven digits.
        let turn = UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix().into_inner();
        let scale = Mat3::from_diagonal(&Vec3::from(node.scale.unwrap_or([1.0; 3])));
        Ok(Pose { turn: turn * scale, shift: Vec3::from(node.translation.unwrap_or([0.0; 3])) })
    }
}

/// The nodes of the scene that is shown, by their numbers and in the order of the file, each with its pose.
///
/// # Errors
/// Nodes that are no trees, or are not there; several scenes of which none is the one to show; a transform that is none.
pub(super) fn placed(document: &Document) -> Result<Vec<(usize, Pose)>, Box<Fault>> {
    let nodes = &document.nodes;
    let mut seen = vec![false; nodes.len()];
    let mut open = Vec::new();
    let mut hang = |numbers: &[usize], above: Pose, open: &mut Vec<(usize, Pose)>| {
        for &number in numbers {
            match seen.get_mut(number) {
                Some(true) => {
                    let found = "it hangs below two nodes, or below itself";
                    return Err(refusal(&name(number, &nodes[number]), found, TREE, EXPORT));
                }
                Some(own) => *own = true,
                None => {
                    let found = format!("node {number} is named, and there are {}", nodes.len());
                    return Err(refusal("", found, "numbers of nodes from 0", EXPORT));
                }
            }
            open.push((number, above));
        }
        Ok(())
    };
    hang(&roots(document)?, Pose::NONE, &mut open)?;
    let mut all = Vec::new();
    while let Some((number, above)) = open.pop() {
        let node = &nodes[number];
        let pose = Pose::stated(node)
            .map_err(|found| {
                refusal(&name(number, node), found, "a translation, a rotation and a scale", EXPORT)
            })?
            .below(&above);
        hang(&node.children, pose, &mut open)?;
        all.push((number, pose));
    }
    all.sort_by_key(|(number, _)| *number);
    Ok(all)
}

/// What a node is called in faults.
pub(super) fn name(number: usize, node: &Node) -> String {
    match node.name.as_deref().map(|name| quoted(name.as_bytes())).filter(|name| !name.is_empty()) {
        Some(name) => format!("node {name}"),
        None => format!("node {number}"),
    }
}

/// The nodes with which the scene begins.
fn roots(document: &Document) -> Result<Vec<usize>, Box<Fault>> {
    let scenes = &document.scenes;
    let shown = match (document.scene, scenes.len()) {
        (Some(scene), _) => scenes.get(scene).ok_or_else(|| {
            let found = format!("scene {scene} is to be shown, and there are {}", scenes.len());
            refusal("", found, "the number of a scene from 0", EXPORT)
        })?,
        (None, 1) => &scenes[0],
        // A library of nodes: those that hang below none.
        (None, 0) => {
            let mut hangs = vec![false; document.nodes.len()];
            for child in document.nodes.iter().flat_map(|node| &node.children) {
                hangs.get_mut(*child).into_iter().for_each(|own| *own = true);
            }
            let free = hangs.iter().enumerate().filter(|(_, hangs)| !**hangs);
            let free: Vec<usize> = free.map(|(number, _)| number).collect();
            if free.is_empty() && !document.nodes.is_empty() {
                return Err(refusal("", "every node hangs below another one", TREE, EXPORT));
            }
            return Ok(free);
        }
        (None, count) => {
            let found = format!("{count} scenes, and none of them is the one to show");
            return Err(refusal("", found, "one scene, or \"scene\" with its number", "export one scene"));
        }
    };
    Ok(shown.nodes.clone())
}
