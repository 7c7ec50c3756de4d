//! What a glTF file describes, as far as the shapes of its meshes need it.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::exchange::fault::Fault;
use crate::exchange::mesh::{AGAIN, SIMPLIFY, quoted, refusal};

/// Most objects of a description: five or six describe a mesh, so more of them are no wall, and would not fit into memory.
const MOST_OBJECTS: usize = 1_000_000;
/// Most commas between what it lists; the numbers of meshes are not among them.
const MOST_COMMAS: usize = 8_000_000;
/// Beginnings of the names of extensions that change how a mesh looks, and not where it is.
const LOOKS: [&str; 7] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "KHR_lights_",
    "EXT_lights_",
    "KHR_animation_",
    "KHR_xmp",
];
/// What is written for the names of extensions that hold compressed meshes.
const COMPRESSED: [&str; 3] =
    ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"];
/// How a mesh becomes one that is read.
pub(super) const PLAIN: &str =
    "export it without compression, instances and quantization (in Blender: Compression off)";

/// Extensions of an object by their names.
type Extensions = BTreeMap<String, IgnoredAny>;

/// A file.
#[derive(Deserialize, Default)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Document {
    pub extensions_required: Vec<String>,
    pub scene: Option<usize>,
    pub scenes: Vec<Scene>,
    pub nodes: Vec<Node>,
    pub meshes: Vec<MeshEntry>,
    pub materials: Vec<Material>,
    pub accessors: Vec<Accessor>,
    pub buffer_views: Vec<View>,
    pub buffers: Vec<Buffer>,
}

/// What is shown together.
#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Scene {
    pub nodes: Vec<usize>,
}

/// A place in the scene, relative to the node above it.
#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Node {
    pub name: Option<String>,
    pub children: Vec<usize>,
    pub mesh: Option<usize>,
    pub skin: Option<usize>,
    /// Column by column.
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    /// A quaternion, its scalar last.
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    pub extensions: Extensions,
}

/// A mesh: the pieces that it is drawn by.
#[derive(Deserialize)]
pub(super) struct MeshEntry {
    pub name: Option<String>,
    pub primitives: Vec<Primitive>,
}

/// A piece of a mesh.
#[derive(Deserialize)]
pub(super) struct Primitive {
    /// Accessors by what they hold, as `POSITION`.
    pub attributes: BTreeMap<String, usize>,
    pub indices: Option<usize>,
    pub material: Option<usize>,
    /// 4, triangles, where it is not stated.
    pub mode: Option<u64>,
    #[serde(default)]
    pub targets: Vec<IgnoredAny>,
    #[serde(default)]
    pub extensions: Extensions,
}

impl Primitive {
    /// The extension that holds it compressed.
    pub fn compression(&self) -> Option<&str> {
        compression(&self.extensions)
    }
}

/// What a mesh looks like: of it, its name alone.
#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Material {
    pub name: Option<String>,
}

/// Numbers of one kind in a part of a buffer.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u64,
    pub count: u64,
    #[serde(rename = "type")]
    pub kind: String,
    pub sparse: Option<IgnoredAny>,
}

/// A part of a buffer.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: u64,
    pub byte_length: u64,
    pub byte_stride: Option<u64>,
    #[serde(default)]
    pub extensions: Extensions,
}

impl View {
    /// The extension that holds it compressed.
    pub fn compression(&self) -> Option<&str> {
        compression(&self.extensions)
    }
}

/// Bytes, or where they are.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub uri: Option<String>,
    pub byte_length: u64,
}

fn compression(extensions: &Extensions) -> Option<&str> {
    extensions.keys().map(String::as_str).find(|name| COMPRESSED.contains(name))
}

/// What is looked at before anything else.
#[derive(Deserialize)]
struct Head {
    asset: Asset,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
}

impl Document {
    /// The description in a text, which is glTF 2.
    ///
    /// # Errors
    /// What is no such description, with its line; a version that is not 2; more objects than a wall has.
    pub fn of(text: &str) -> Result<Document, Box<Fault>> {
        let count = |own: u8| text.bytes().filter(|byte| *byte == own).count();
        if count(b'{') > MOST_OBJECTS || count(b',') > MOST_COMMAS {
            let found = format!("more than {MOST_OBJECTS} objects describe it, or {MOST_COMMAS} numbers");
            return Err(refusal("", found, "fewer", SIMPLIFY));
        }
        let head: Head = serde_json::from_str(text).map_err(|error| unread(&error))?;
        let version = &head.asset.version;
        if version.split('.').next() != Some("2") {
            let found = format!("it is glTF {}", quoted(version.as_bytes()));
            return Err(refusal("", found, "glTF 2.0", "export it as glTF 2.0"));
        }
        serde_json::from_str(text).map_err(|error| unread(&error))
    }

    /// The extension without which the file does not say where its stones are, and which is not read. One that holds compressed meshes is told
    /// of the mesh that it holds.
    pub fn unread_extension(&self) -> Option<&str> {
        let mut required = self.extensions_required.iter().map(String::as_str);
        required.find(|name| !LOOKS.iter().any(|own| name.starts_with(own)) && !COMPRESSED.contains(name))
    }
}

/// The fault that stopped the reader of JSON.
fn unread(error: &serde_json::Error) -> Box<Fault> {
    let said = error.to_string();
    let said = said.split(" at line ").next().unwrap_or(&said);
    let (found, fix) = if error.is_eof() {
        ("its description ends too early".to_owned(), AGAIN)
    } else {
        (
            format!("its description is not what is expected: {}", quoted(said.as_bytes())),
            "export it again as glTF 2.0",
        )
    };
    let fault = Fault::of("", found, "glTF 2.0 with finite numbers, indices from 0, and its asset", fix);
    Box::new(fault.at(error.line(), error.column()))
}
