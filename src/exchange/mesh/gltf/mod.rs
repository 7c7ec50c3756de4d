//! Reading glTF 2.0 (`.glb`, `.gltf`): a stone for each node with a mesh, where the scene places it.
//!
//! Source: Khronos Group, glTF 2.0 Specification (2021), sections 3 and 4. By the specification y points up and lengths are in metres.

mod buffers;
mod document;
mod numbers;
mod placed;

pub(in crate::exchange) use buffers::with_buffers;

use crate::exchange::draft::MOST_BLOCKS;
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::mesh::gltf::buffers::{Parts, buffers};
use crate::exchange::mesh::gltf::document::{Document, MeshEntry, PLAIN, Primitive};
use crate::exchange::mesh::gltf::numbers::{File, INDICES, POSITIONS, position, whole};
use crate::exchange::mesh::gltf::placed::{Pose, name, placed};
use crate::exchange::mesh::{
    AGAIN, MOST_FACES, MOST_FAULTS, MOST_VERTICES, Mesh, SIMPLIFY, enough, is_sliver, quoted, refusal,
};
use crate::exchange::read_obj::is_support;

/// Names of the ways to draw, by their codes; the fifth one is read.
const MODES: [&str; 7] = [
    "points",
    "lines",
    "a loop of lines",
    "a strip of lines",
    "triangles",
    "a strip of triangles",
    "a fan of triangles",
];
const TRIANGLES: u64 = 4;
/// What multiplies a node, which is one stone here.
const INSTANCES: &str = "EXT_mesh_gpu_instancing";

/// The bodies in a glTF file, one for each node with a mesh of the scene that is shown, in the order of the nodes. They are called as their nodes
/// are, or else as their meshes, and are supports where a material of theirs is called so. Animations are passed over: a node is where it is
/// without them. Triangles with a corner twice hold no area and are left out.
///
/// # Errors
/// Everything that is wrong with the file, mesh by mesh.
pub(in crate::exchange) fn read_gltf(bytes: &[u8]) -> Result<Vec<Mesh>, WallFaults> {
    let mut faults = WallFaults::new("mesh.gltf");
    let read = read(bytes, &mut faults).unwrap_or_else(|fault| {
        faults.push_last(*fault);
        Vec::new()
    });
    if read.is_empty() && faults.is_empty() {
        let fix = "export the stones as meshes, in the scene that is shown";
        faults.push(Fault::of("", "it shows no meshes", "a node with a mesh for each stone", fix));
    }
    if faults.is_empty() { Ok(read) } else { Err(faults) }
}

fn read(bytes: &[u8], faults: &mut WallFaults) -> Result<Vec<Mesh>, Box<Fault>> {
    let parts = Parts::of(bytes)?;
    let document = Document::of(parts.text)?;
    if let Some(extension) = document.unread_extension() {
        let found = format!("it cannot be read without the extension {}", quoted(extension.as_bytes()));
        return Err(refusal("", found, "meshes of plain triangles", PLAIN));
    }
    let nodes = placed(&document)?;
    let stones = nodes.iter().filter(|(node, _)| document.nodes[*node].mesh.is_some()).count();
    if stones > MOST_BLOCKS {
        let found = format!("{stones} nodes with meshes");
        return Err(refusal("", found, format!("at most {MOST_BLOCKS}"), "divide the wall"));
    }
    let file = File { buffers: buffers(&document, &parts), document };
    let mut reader = Reader { file: &file, vertices: 0, faces: 0 };
    let mut done = Vec::with_capacity(stones);
    for (node, pose) in nodes {
        match reader.stone(node, &pose) {
            Ok(mesh) => done.extend(mesh),
            Err(fault) => faults.push(*fault),
        }
        if faults.count() >= MOST_FAULTS {
            return Err(enough());
        }
    }
    Ok(done)
}

/// A file whose meshes are read one by one.
struct Reader<'a> {
    file: &'a File<'a>,
    /// Corners and triangles so far: meshes that are there several times count each time.
    vertices: u64,
    faces: u64,
}

impl<'a> Reader<'a> {
    /// The stone of a node, where the node has a mesh.
    fn stone(&mut self, number: usize, pose: &Pose) -> Result<Option<Mesh>, Box<Fault>> {
        let node = &self.file.document.nodes[number];
        let Some(place) = node.mesh else { return Ok(None) };
        let named = name(number, node);
        let Some(entry) = self.file.document.meshes.get(place) else {
            let found = format!("its mesh is {place}, and there are {}", self.file.document.meshes.len());
            return Err(refusal(&named, found, "the number of a mesh from 0", AGAIN));
        };
        let title = title(place, entry, &named);
        if node.skin.is_some() || node.extensions.contains_key(INSTANCES) {
            let found = if node.skin.is_some() {
                "it has a skin, whose bones bend it"
            } else {
                "its node is there several times (EXT_mesh_gpu_instancing)"
            };
            let fix = "apply modifiers and armatures, make instances real, and export it again";
            return Err(refusal(&title, found, "a node for each stone, which is rigid", fix));
        }
        let mut mesh = Mesh {
            name: [&node.name, &entry.name]
                .into_iter()
                .flatten()
                .find(|name| !name.trim().is_empty())
                .cloned(),
            // A stone of any other material may be held by its name.
            is_support: entry.primitives.iter().all(|own| self.is_support(own)).then_some(true),
            ..Mesh::default()
        };
        for primitive in &entry.primitives {
            self.primitive(primitive, &title, pose, &mut mesh)?;
        }
        if mesh.faces.is_empty() {
            return Err(refusal(&title, "it has no triangles with an area", "a mesh of triangles", PLAIN));
        }
        Ok(Some(mesh))
    }

    /// Whether the name of a material says that what is made of it is held.
    fn is_support(&self, primitive: &Primitive) -> bool {
        let material = primitive.material.and_then(|own| self.file.document.materials.get(own));
        material.and_then(|own| own.name.as_deref()).is_some_and(is_support)
    }

    /// Adds a piece to a mesh, in the axes and the unit of the scene.
    fn primitive(
        &mut self,
        own: &Primitive,
        title: &str,
        pose: &Pose,
        mesh: &mut Mesh,
    ) -> Result<(), Box<Fault>> {
        readable(own, title)?;
        let Some(positions) = own.attributes.get("POSITION") else {
            return Err(refusal(title, "it has no POSITION", "corners with positions", PLAIN));
        };
        let file: &'a File<'a> = self.file;
        let positions = file.numbers(*positions, title, &POSITIONS)?;
        let indices = own.indices.map(|own| file.numbers(own, title, &INDICES)).transpose()?;
        let corners = indices.as_ref().map_or(positions.count, |own| own.count);
        if !corners.is_multiple_of(3) {
            let found = format!("its triangles have {corners} corners");
            return Err(refusal(title, found, "three of each", AGAIN));
        }
        self.vertices += positions.count;
        self.faces += corners / 3;
        for (count, what, most) in
            [(self.vertices, "corners", MOST_VERTICES), (self.faces, "triangles", MOST_FACES)]
        {
            if count > most as u64 {
                let found = format!("with it there are {count} {what}");
                return Err(refusal(title, found, format!("at most {most} in a file"), SIMPLIFY));
            }
        }
        let first = mesh.vertices.len() as u32;
        for (number, bytes) in positions.items().enumerate() {
            let at = pose.of(&position(bytes));
            if !at.iter().all(|c| c.is_finite()) {
                let found = format!("its corner {number} is at ({}, {}, {})", at.x, at.y, at.z);
                return Err(refusal(title, found, "finite coordinates", "correct or remove the corner"));
            }
            mesh.vertices.push(at);
        }
        // Without indices the corners are those of the triangles in turn.
        let all: Vec<u32> = match &indices {
            Some(own) => own.items().map(whole).collect(),
            None => (0..positions.count as u32).collect(),
        };
        if let Some(corner) = all.iter().find(|corner| u64::from(**corner) >= positions.count) {
            let found = format!("a triangle of it names corner {corner}");
            let allowed = format!("corners from 0 to {}", positions.count - 1);
            return Err(refusal(title, found, allowed, AGAIN));
        }
        let faces =
            all.chunks_exact(3).map(|own| own.iter().map(|corner| first + corner).collect::<Vec<u32>>());
        mesh.faces.extend(faces.filter(|face| !is_sliver(face)));
        Ok(())
    }
}

/// Refuses a piece that is no plain mesh of triangles.
fn readable(own: &Primitive, title: &str) -> Result<(), Box<Fault>> {
    let mode = own.mode.unwrap_or(TRIANGLES);
    if mode != TRIANGLES {
        let found = match MODES.get(mode as usize) {
            Some(what) => format!("it is drawn as {what}"),
            None => format!("it is drawn in the mode {mode}"),
        };
        return Err(refusal(title, found, "triangles (mode 4)", "triangulate it, and export it again"));
    }
    if let Some(extension) = own.compression() {
        return Err(refusal(title, format!("it is compressed ({extension})"), "plain triangles", PLAIN));
    }
    if !own.targets.is_empty() {
        let fix = "apply its shape keys (morph targets), and export it again";
        return Err(refusal(title, "it has shapes to morph into", "one shape", fix));
    }
    Ok(())
}

/// What a mesh is called in faults.
fn title(place: usize, entry: &MeshEntry, node: &str) -> String {
    match entry.name.as_deref().map(|name| quoted(name.as_bytes())).filter(|name| !name.is_empty()) {
        Some(name) => format!("mesh {name} ({node})"),
        None => format!("mesh {place} ({node})"),
    }
}

#[cfg(test)]
mod tests;
