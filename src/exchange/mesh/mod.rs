//! Meshes and clouds of points: one or more bodies as corners and faces.

mod built;
mod gltf;
mod oriented;
mod ply;
mod split;
mod stl;
#[cfg(test)]
pub(super) mod twisted;

pub use built::meshes_of;
pub(super) use built::{read_folder, stones};
pub(super) use gltf::{read_gltf, with_buffers};
pub(super) use ply::read_ply;
pub(super) use stl::read_stl;

use crate::exchange::fault::Fault;
use crate::math::Vec3;

/// Most corners of a file.
const MOST_VERTICES: usize = 2_000_000;
/// Most faces of a file.
const MOST_FACES: usize = 4_000_000;
/// Faults after which the rest of a file is not worth reading.
const MOST_FAULTS: usize = 100;
const SIMPLIFY: &str = "simplify the mesh, or write a file per stone";
const AGAIN: &str = "the file is cut off or damaged: export it again";

/// A body as a file of a mesh gives it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Its name, where the file gives one.
    pub name: Option<String>,
    /// Whether the file says that it is held; `None` where its name does.
    pub is_support: Option<bool>,
    /// Line where it begins, from 1; 0 in a binary file.
    pub line: usize,
    /// Corners, in the file's unit, as found.
    pub vertices: Vec<Vec3>,
    /// Faces by the numbers of their corners from 0; none of a cloud of points.
    pub faces: Vec<Vec<u32>>,
}

/// A fault after which the rest of a file is not read.
pub(super) fn refusal(
    block: &str,
    found: impl Into<String>,
    allowed: impl Into<String>,
    fix: &str,
) -> Box<Fault> {
    Box::new(Fault::of(block, found, allowed, fix))
}

/// The last one of too many faults.
fn enough() -> Box<Fault> {
    refusal("", "the rest of the file was not looked at", "a few faults", "mend these first")
}

/// Whether a face is a triangle with a corner twice. It holds no area, and the faces beside it close without it.
fn is_sliver(face: &[u32]) -> bool {
    matches!(*face, [a, b, c] if a == b || b == c || c == a)
}

/// A position by its bits, by which equal ones are found; -0 is 0.
fn bits(at: &Vec3) -> [u64; 3] {
    [at.x, at.y, at.z].map(|c| (c + 0.0).to_bits())
}

/// A text of the file as a fault may quote it: its beginning, as far as it can be read.
pub(super) fn quoted(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(&text[..text.len().min(240)]);
    text.trim().chars().filter(|c| !c.is_control() && *c != '"').take(60).collect()
}
