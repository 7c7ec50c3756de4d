//! Reading `wall.json`.

use std::cell::{Cell, RefCell};
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

use crate::exchange::draft::{Draft, MOST_BLOCKS, WallFile, build};
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::json_node::{MOST_VALUES, Node, NodeSeed};
use crate::exchange::json_place::syntax_fault;
use crate::exchange::{ReadOptions, Unit};
use crate::math::{Mat3, Vec3, edit_distance};
use crate::model::Tag;
use crate::shape::MassProperties;

const KEYS: [&str; 2] = ["unit", "blocks"];
const BLOCK_KEYS: [&str; 8] = ["id", "vertices", "faces", "density", "fixed", "tag", "group", "scan"];

/// A wall from the text of a `wall.json` (see [`crate::exchange::write_wall_json`]).
///
/// `unit` is `m` (default), `cm` or `mm`. Every block has `id` (whole, unique), `vertices` and `faces`; `density`
/// (kg/m^3) unless it is fixed; `fixed` (default false) and `tag` (default `stone`, or `base` where fixed): `stone`, `header`,
/// `wedge`, `base`, `end` or a word of one's own, which is a stone. Blocks with the same `group` (a name) are the convex parts of
/// one rigid stone. `scan` (`volume`, `centroid`, `inertia` about the centroid, at unit density) is what a stone holds whose faces are
/// those of its hull. Other keys are refused. Corners of neighbouring faces within 1e-4 of the block are one, also where a corner
/// of one face lies on the edge of another; coplanar faces are merged.
///
/// # Errors
/// Everything that is wrong with the text; a fault of the JSON itself stands alone, with its line and column.
///
/// ```
/// let wall = pirca::generate::canonical::wall_72();
/// let read = pirca::exchange::read_wall_json(&pirca::exchange::write_wall_json(&wall.with_base())).unwrap();
/// assert_eq!(read.wall.blocks.len(), 73);
/// ```
pub fn read_wall_json(text: &str) -> Result<WallFile, WallFaults> {
    read_json(text, &ReadOptions::default())
}

/// The same with warped faces made plane, see [`crate::exchange::ReadOptions::flatness`] (m).
///
/// # Errors
/// As [`read_wall_json`].
pub fn read_wall_json_with(text: &str, flatness: Option<f64>) -> Result<WallFile, WallFaults> {
    read_json(text, &ReadOptions { flatness, ..ReadOptions::default() })
}

/// The same with all that is allowed of a `wall.json`; it states its unit and its densities itself.
pub(super) fn read_json(text: &str, options: &ReadOptions) -> Result<WallFile, WallFaults> {
    let mut faults = WallFaults::new("wall.json");
    if text.trim().is_empty() {
        let fix = "see `pirca analyse --help` for an example";
        faults.push(Fault::of("", "the file is empty", "a JSON object with \"blocks\"", fix));
        return Err(faults);
    }
    let reading = Reading { faults: RefCell::new(faults), left: Cell::new(MOST_VALUES) };
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let read = WholeSeed(&reading).deserialize(&mut deserializer).and_then(|whole| {
        deserializer.end()?;
        Ok(whole)
    });
    let mut faults = reading.faults.into_inner();
    match read {
        Ok((unit, drafts)) => build(drafts, unit, options, faults, Vec::new()),
        Err(error) => {
            faults.push_last(syntax_fault(text, &error));
            Err(faults)
        }
    }
}

/// What the seeds share while the text is read.
struct Reading {
    faults: RefCell<WallFaults>,
    /// Values that the block being read may still have.
    left: Cell<usize>,
}

impl Reading {
    fn fault(&self, block: &str, found: String, allowed: impl Into<String>, fix: impl Into<String>) {
        self.faults.borrow_mut().push(Fault::of(block, found, allowed, fix));
    }

    fn unknown_key(&self, block: &str, key: &str, known: &[&str]) {
        let nearest =
            known.iter().min_by_key(|k| edit_distance(k, key)).filter(|k| edit_distance(k, key) <= 3);
        let fix = nearest.map_or("remove it".to_owned(), |k| format!("did you mean \"{k}\"?"));
        let key: String = key.chars().take(40).collect();
        self.fault(block, format!("\"{key}\" is not a known key"), known.join(", "), fix);
    }
}

/// The file's one object. Blocks are drafted one by one, so that memory holds one of them as JSON at a time.
struct WholeSeed<'a>(&'a Reading);

impl<'de> DeserializeSeed<'de> for WholeSeed<'_> {
    type Value = (Unit, Vec<Draft>);

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for WholeSeed<'_> {
    type Value = (Unit, Vec<Draft>);

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an object with \"unit\" and \"blocks\"")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        let (mut unit, mut blocks) = (None, None);
        while let Some(key) = entries.next_key::<String>()? {
            self.0.left.set(MOST_VALUES);
            let known = match key.as_str() {
                "unit" => unit
                    .replace(the_unit(self.0, &entries.next_value_seed(NodeSeed(&self.0.left))?))
                    .is_some(),
                "blocks" => blocks.replace(entries.next_value_seed(BlocksSeed(self.0))?).is_some(),
                other => {
                    entries.next_value_seed(NodeSeed(&self.0.left))?;
                    self.0.unknown_key("", other, &KEYS);
                    false
                }
            };
            if known {
                self.0.fault("", format!("\"{key}\" is there twice"), "every key once", "remove one of them");
            }
        }
        if blocks.is_none() {
            self.0.fault("", "\"blocks\" is missing".to_owned(), "a list of blocks", "add \"blocks\": [...]");
        }
        Ok((unit.unwrap_or_default(), blocks.unwrap_or_default()))
    }
}

fn the_unit(reading: &Reading, node: &Node) -> Unit {
    let named = if let Node::Text(name) = node { Unit::named(name) } else { None };
    named.unwrap_or_else(|| {
        let found = format!("\"unit\" is {}", node.told());
        reading.fault("", found, "\"m\", \"cm\" or \"mm\"", "say in which unit the coordinates are");
        Unit::Metre
    })
}

struct BlocksSeed<'a>(&'a Reading);

impl<'de> DeserializeSeed<'de> for BlocksSeed<'_> {
    type Value = Vec<Draft>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<Draft>, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for BlocksSeed<'_> {
    type Value = Vec<Draft>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a list of blocks")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Vec<Draft>, A::Error> {
        let mut drafts = Vec::new();
        loop {
            self.0.left.set(MOST_VALUES);
            let Some(node) = items.next_element_seed(NodeSeed(&self.0.left))? else { return Ok(drafts) };
            if drafts.len() == MOST_BLOCKS {
                return Err(A::Error::custom(format!("more than {MOST_BLOCKS} blocks")));
            }
            drafts.push(draft(self.0, drafts.len(), node));
        }
    }
}

/// The block that an entry of the list describes, with everything that cannot be read told.
fn draft(reading: &Reading, place: usize, node: Node) -> Draft {
    let before = reading.faults.borrow().count();
    let entries = match node {
        Node::Object(entries) => entries,
        other => {
            let name = format!("entry {place} of \"blocks\"");
            reading.fault(&name, format!("it is {}", other.told()), "an object", "write the block as {...}");
            Vec::new()
        }
    };
    let told = reading.faults.borrow().count() > before;
    let get = |key: &str| entries.iter().find(|(k, _)| k == key).map(|(_, node)| node);
    let id = get("id").and_then(Node::whole).and_then(|id| u64::try_from(id).ok());
    let name = id.map_or_else(|| format!("entry {place} of \"blocks\""), |id| format!("block {id}"));
    if !told {
        keys(reading, &name, &entries);
    }
    let wrong = |key: &str, node: &Node, allowed: &str, fix: &str| {
        reading.fault(&name, format!("\"{key}\" is {}", node.told()), allowed, fix);
    };
    if let (None, Some(node)) = (id, get("id")) {
        wrong("id", node, "a whole number from 0 to 9007199254740991", "number the blocks");
    }
    let mut block = Draft {
        id,
        line: 0,
        vertices: get("vertices").map_or_else(Vec::new, |node| vertices(reading, &name, node)),
        faces: get("faces").map_or_else(Vec::new, |node| faces(reading, &name, node)),
        density: None,
        fixed: false,
        tag: Tag::Stone,
        group: None,
        scan: None,
        readable: true,
        name: name.clone(),
    };
    match get("density") {
        Some(Node::Number(x)) => block.density = Some(*x),
        Some(node) => {
            wrong("density", node, "a number (kg/m^3)", "give the density as a number without quotes")
        }
        None => {}
    }
    match get("fixed") {
        Some(Node::Bool(fixed)) => block.fixed = *fixed,
        Some(node) => wrong("fixed", node, "true or false", "write true or false without quotes"),
        None => {}
    }
    match get("tag") {
        Some(Node::Text(name)) => block.tag = Tag::named(name),
        Some(node) => {
            wrong("tag", node, "a word: stone, header, wedge, base, end or your own", "write it in quotes")
        }
        // What is fixed and not named otherwise is the ground.
        None if block.fixed => block.tag = Tag::Base,
        None => {}
    }
    match get("group") {
        Some(Node::Text(name)) if !name.is_empty() => block.group = Some(name.clone()),
        Some(node) => wrong("group", node, "a name that all parts of a stone have", "write it in quotes"),
        None => {}
    }
    if let Some(node) = get("scan") {
        block.scan = scan(node);
        if block.scan.is_none() {
            let allowed = "{\"volume\": V, \"centroid\": [x, y, z], \"inertia\": [[..], [..], [..]]} with a volume above 0";
            wrong(
                "scan",
                node,
                allowed,
                "give what the stone itself holds, at unit density and in the file's unit of length",
            );
        }
    }
    block.readable = reading.faults.borrow().count() == before;
    block
}

/// What a stone holds whose vertices are those of the hull of its scan.
fn scan(node: &Node) -> Option<MassProperties> {
    let Node::Object(entries) = node else { return None };
    let get = |key: &str| entries.iter().find(|(k, _)| k == key).map(|(_, node)| node);
    let triple = |node: &Node| match node {
        Node::List(list) => match list[..] {
            [Node::Number(x), Node::Number(y), Node::Number(z)] => Some(Vec3::new(x, y, z)),
            _ => None,
        },
        _ => None,
    };
    let (Some(Node::Number(volume)), Some(Node::List(rows))) = (get("volume"), get("inertia")) else {
        return None;
    };
    let [a, b, c] = rows.iter().map(triple).collect::<Option<Vec<Vec3>>>()?[..] else { return None };
    let inertia = Mat3::from_rows(&[a.transpose(), b.transpose(), c.transpose()]);
    let centroid = triple(get("centroid")?)?;
    let is_whole = entries.len() == 3 && *volume > 0.0 && inertia.symmetric_eigenvalues().min() > 0.0;
    is_whole.then_some(MassProperties { volume: *volume, centroid, inertia })
}

/// Unknown, repeated and missing keys.
fn keys(reading: &Reading, name: &str, entries: &[(String, Node)]) {
    for (place, (key, _)) in entries.iter().enumerate() {
        if !BLOCK_KEYS.contains(&key.as_str()) {
            reading.unknown_key(name, key, &BLOCK_KEYS);
        } else if entries[..place].iter().any(|(k, _)| k == key) {
            reading.fault(name, format!("\"{key}\" is there twice"), "every key once", "remove one of them");
        }
    }
    for (key, fix) in [
        ("id", "add \"id\": a whole number that no other block has"),
        ("vertices", "add \"vertices\": [[x, y, z], ...]"),
        ("faces", "add \"faces\": [[i, j, k, ...], ...], counter-clockwise seen from outside"),
    ] {
        if entries.iter().all(|(k, _)| k != key) {
            reading.fault(
                name,
                format!("\"{key}\" is missing"),
                "id, vertices and faces in every block",
                fix,
            );
        }
    }
}

fn vertices(reading: &Reading, name: &str, node: &Node) -> Vec<Vec3> {
    let allowed = "a list of vertices, each [x, y, z] with three numbers";
    let Node::List(list) = node else {
        reading.fault(name, format!("\"vertices\" is {}", node.told()), allowed, "write [[x, y, z], ...]");
        return Vec::new();
    };
    let mut vertices = Vec::with_capacity(list.len());
    for (i, entry) in list.iter().enumerate() {
        match entry {
            Node::List(c) => match c[..] {
                [Node::Number(x), Node::Number(y), Node::Number(z)] => vertices.push(Vec3::new(x, y, z)),
                _ => {
                    let parts: Vec<String> = c.iter().take(5).map(Node::told).collect();
                    let found = format!("vertex {i} is [{}] ({} values)", parts.join(", "), c.len());
                    let commas = c.len() > 3 && c.iter().all(|node| matches!(node, Node::Number(_)));
                    let fix = match commas {
                        true => "give it three numbers; decimal commas? Write 0.5 for 0,5",
                        false => "give it three numbers",
                    };
                    reading.fault(name, found, allowed, fix);
                }
            },
            other => reading.fault(
                name,
                format!("vertex {i} is {}", other.told()),
                allowed,
                "write it as [x, y, z]",
            ),
        }
    }
    vertices
}

fn faces(reading: &Reading, name: &str, node: &Node) -> Vec<Vec<i64>> {
    let allowed = "a list of faces, each a list of vertex numbers counted from 0";
    let Node::List(list) = node else {
        reading.fault(name, format!("\"faces\" is {}", node.told()), allowed, "write [[i, j, k, ...], ...]");
        return Vec::new();
    };
    let mut faces = Vec::with_capacity(list.len());
    for (i, entry) in list.iter().enumerate() {
        let Node::List(numbers) = entry else {
            reading.fault(
                name,
                format!("face {i} is {}", entry.told()),
                allowed,
                "write it as [i, j, k, ...]",
            );
            continue;
        };
        match numbers.iter().find(|n| n.whole().is_none()) {
            None => faces.push(numbers.iter().filter_map(Node::whole).collect()),
            Some(bad) => {
                let found = format!("face {i} names vertex {}", bad.told());
                reading.fault(name, found, allowed, "write whole numbers without quotes");
            }
        }
    }
    faces
}
