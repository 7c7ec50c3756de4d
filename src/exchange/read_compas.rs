//! Reading assemblies of COMPAS, as `compas_assembly` and `compas_cra` write them: JSON of a graph whose nodes are meshes.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::exchange::draft::{Draft, WallFile, assumed_density, build};
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::json_place::syntax_fault;
use crate::exchange::{ReadOptions, Unit};
use crate::math::Vec3;

/// What is read of COMPAS.
const READ: &str = "an Assembly, whose graph has a block at each node";

/// The type that COMPAS states of its data at the beginning of its files (`"dtype": "compas.datastructures/Mesh"`); `None` of others.
pub fn compas(text: &str) -> Option<&str> {
    ["\"dtype\"", "\"datatype\""].iter().find_map(|key| {
        let (_, rest) = text.split_once(key)?;
        let value = rest.trim_start().strip_prefix(':')?.trim_start().strip_prefix('"')?;
        let kind = value.split('"').next()?;
        kind.starts_with("compas").then_some(kind)
    })
}

/// The assembly: `data` in the newer files, `value` in the older ones.
#[derive(Deserialize)]
struct Whole {
    #[serde(alias = "value")]
    data: Option<AssemblyData>,
}

#[derive(Deserialize)]
struct AssemblyData {
    graph: Option<Graph>,
}

/// A graph by itself, or with its type around it.
#[derive(Deserialize)]
struct Graph {
    #[serde(alias = "value")]
    data: Option<Nodes>,
    node: Option<BTreeMap<String, Node>>,
}

#[derive(Deserialize)]
struct Nodes {
    node: Option<BTreeMap<String, Node>>,
}

#[derive(Deserialize)]
struct Node {
    block: Option<Block>,
    #[serde(default)]
    is_support: Option<bool>,
}

#[derive(Deserialize)]
struct Block {
    #[serde(alias = "value")]
    data: Option<Mesh>,
}

#[derive(Deserialize)]
struct Mesh {
    vertex: Option<BTreeMap<String, Point>>,
    face: Option<BTreeMap<String, Vec<Key>>>,
}

/// A corner; what is not stated is 0, as COMPAS has it.
#[derive(Deserialize)]
struct Point {
    #[serde(default)]
    x: f64,
    #[serde(default)]
    y: f64,
    #[serde(default)]
    z: f64,
}

/// A vertex in a face, as a number or as the key that JSON makes of it.
#[derive(Deserialize)]
#[serde(untagged)]
enum Key {
    Number(i64),
    Text(String),
}

impl Key {
    fn text(&self) -> String {
        match self {
            Key::Number(number) => number.to_string(),
            Key::Text(text) => text.clone(),
        }
    }
}

/// The wall in such a file. COMPAS states neither unit nor density; supports are nodes with `is_support`, and those that are asked for.
pub(super) fn read_compas(kind: &str, text: &str, options: &ReadOptions) -> Result<WallFile, WallFaults> {
    let mut faults = WallFaults::new("assembly.json");
    // A list of meshes is no assembly.
    let is_list = text.trim_start().starts_with('[');
    let read = if is_list { Ok(Whole { data: None }) } else { serde_json::from_str(text) };
    let whole: Whole = match read {
        Ok(whole) => whole,
        Err(error) => {
            faults.push(syntax_fault(text, &error));
            return Err(faults);
        }
    };
    let graph = whole.data.and_then(|data| data.graph);
    let nodes = graph.and_then(|graph| graph.node.or(graph.data?.node));
    let Some(nodes) = nodes else {
        let found = format!("this is JSON of COMPAS ({kind}) without a graph of blocks");
        let fix = "write the meshes of its blocks from COMPAS as the objects of one OBJ file, a name each";
        faults.push(Fault::of("", found, READ, fix));
        return Err(faults);
    };
    let mut all: Vec<(String, Node)> = nodes.into_iter().collect();
    // The order of a file written in Python is no order.
    all.sort_by_key(|(key, _)| (key.parse().unwrap_or(u64::MAX), key.clone()));
    let (mut drafts, mut unstated) = (Vec::with_capacity(all.len()), 0);
    for (place, (key, node)) in all.into_iter().enumerate() {
        let name = format!("block {key}");
        let mesh = node.block.and_then(|block| block.data);
        let Some((vertex, face)) = mesh.and_then(|mesh| mesh.vertex.zip(mesh.face)) else {
            let found = "the node has no mesh of vertices and faces";
            faults.push(Fault::of(&name, found, READ, "write the assembly with its blocks"));
            continue;
        };
        let places: BTreeMap<&str, i64> = vertex.keys().map(String::as_str).zip(0..).collect();
        // A corner that does not exist gets a number that none has, which is told.
        let number = |key: &Key| places.get(key.text().as_str()).copied().unwrap_or(-1);
        let mut faces: Vec<(&String, &Vec<Key>)> = face.iter().collect();
        faces.sort_by_key(|(key, _)| (key.parse().unwrap_or(u64::MAX), *key));
        let fixed = node.is_support == Some(true);
        unstated += usize::from(!fixed && options.density.is_none());
        let id = key.parse().unwrap_or(place as u64);
        let corners = vertex
            .values()
            .map(|own| options.up.unwrap_or_default().of_wall(&Vec3::new(own.x, own.y, own.z)));
        let faces = faces.iter().map(|(_, own)| own.iter().map(number).collect());
        let plain = Draft::plain(name, id, fixed, (corners.collect(), faces.collect()));
        drafts.push(Draft { density: options.density.or(plain.density), ..plain });
    }
    let warnings = assumed_density(unstated).into_iter().collect();
    build(drafts, options.unit.unwrap_or(Unit::Metre), options, faults, warnings)
}
