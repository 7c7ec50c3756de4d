//! A block as a file states it, before anything about it is believed; and the wall made of the blocks that hold.

use std::collections::{BTreeMap, BTreeSet};

use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::mended::Mended;
use crate::exchange::scan::{hulled, scanned, stated};
use crate::exchange::solid::{diagonal, divided, solid};
use crate::exchange::{ReadOptions, Unit};
use crate::face::Closed;
use crate::math::{Mat3, Vec3, cos, sin};
use crate::model::{Block, Support, Tag, Wall};
use crate::shape::{MassProperties, Polyhedron};

/// Most blocks of a file.
pub const MOST_BLOCKS: usize = 50_000;
/// Most vertices, and most faces, of one block as the file gives them.
pub const MOST_VERTICES: usize = 2_000;
/// The same of a scan.
pub const MOST_SCANNED: usize = 500_000;
/// Largest coordinate (m): beyond it a position keeps fewer than 9 digits after the point.
const FARTHEST: f64 = 1e7;
/// Sizes of a block (m), corner to corner, that a wall can have: smaller or larger ones are a wrong unit.
const SMALLEST: f64 = 1e-3;
const LARGEST_STONE: f64 = 25.0;
const LARGEST_FIXED: f64 = 250.0;
/// Densities (kg/m^3) from cork to osmium.
const LIGHTEST: f64 = 10.0;
const HEAVIEST: f64 = 23_000.0;
/// What a fixed block without a density gets (kg/m^3); its weight acts on nothing.
const FIXED_DENSITY: f64 = USUAL_DENSITY;

/// What a block gets whose file states no density (kg/m^3): a usual limestone.
pub const USUAL_DENSITY: f64 = 2400.0;

/// The warning of so many blocks that got it.
pub fn assumed_density(blocks: usize) -> Option<String> {
    (blocks > 0).then(|| {
        format!("density of {blocks} object(s) not stated: {USUAL_DENSITY} kg/m^3 is taken; --density-kg-per-m3 sets another")
    })
}

/// One block of a file.
#[derive(Debug)]
pub struct Draft {
    /// Its name for messages: `block 7`.
    pub name: String,
    /// Its id in the file; `None` where the file's is no id.
    pub id: Option<u64>,
    /// Line where it begins, 0 where lines do not matter.
    pub line: usize,
    /// Vertices in the file's unit.
    pub vertices: Vec<Vec3>,
    /// Faces as vertex numbers from 0, as found.
    pub faces: Vec<Vec<i64>>,
    /// Density (kg/m^3) if there is one.
    pub density: Option<f64>,
    /// Whether it is a support.
    pub fixed: bool,
    /// What it is.
    pub tag: Tag,
    /// The stone that it is a part of.
    pub group: Option<String>,
    /// What it holds where its vertices are those of a hull, in the file's unit.
    pub scan: Option<MassProperties>,
    /// Whether the file's text about it could be read; if not, its faults have been told.
    pub readable: bool,
}

impl Draft {
    /// A stone or a support of this shape, of which the file says nothing else.
    pub fn plain(name: String, id: u64, fixed: bool, (vertices, faces): (Vec<Vec3>, Vec<Vec<i64>>)) -> Draft {
        Draft {
            name,
            id: Some(id),
            line: 0,
            vertices,
            faces,
            density: Some(USUAL_DENSITY),
            fixed,
            tag: if fixed { Tag::Base } else { Tag::Stone },
            group: None,
            scan: None,
            readable: true,
        }
    }
}

/// A wall from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct WallFile {
    /// The wall (m); a block's id is its place in the file, from 0.
    pub wall: Wall,
    /// The ids in the file, by block.
    pub ids: Vec<u64>,
    /// The names for messages, by block: `block 7`, `block 12 (stone_12)`.
    pub names: Vec<String>,
    /// What a careful reader would like to know.
    pub warnings: Vec<String>,
    /// What was drawn, where the file shows the face of the wall.
    pub drawn: Option<Drawn>,
}

/// What a drawing or a picture shows of a wall: its face in x and z, or its section in y and z (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Whether it is a section.
    pub section: bool,
    /// The outlines before their joints were closed, by block.
    pub outlines: Vec<Vec<[f64; 2]>>,
    /// The joints that were closed; none of a drawing that is taken as it is.
    pub joints: Vec<Closed>,
    /// Area gained by closing them, as a share of what the outline surrounds, by block; negative where it lost.
    pub gained: Vec<f64>,
    /// Where a picture lies: its left, lower, right and upper rim; `None` of a drawing.
    pub frame: Option<[f64; 4]>,
}

impl WallFile {
    /// The wall as it stands: on its own fixed blocks, or on the platform.
    pub fn on_ground(&self) -> WallFile {
        let mut grounded = self.clone();
        if !self.wall.has_base() {
            grounded.wall = grounded.wall.with_base();
            grounded.ids.push(u64::MAX);
            grounded.names.push("the platform (the plane z = 0)".to_owned());
        }
        grounded
    }

    /// The wall as a file of so many blocks has it, without a platform that was put under it.
    pub fn without_platform(mut self, read: &WallFile) -> WallFile {
        let blocks = read.wall.blocks.len();
        self.wall.blocks.truncate(blocks);
        self.ids.truncate(blocks);
        self.names.truncate(blocks);
        self
    }
}

/// Checks every block and puts the wall together; `faults` holds what the reading has found already, ``options` what is allowed
/// beyond the usual.
pub fn build(
    mut drafts: Vec<Draft>,
    unit: Unit,
    options: &ReadOptions,
    mut faults: WallFaults,
    mut warnings: Vec<String>,
) -> Result<WallFile, WallFaults> {
    if drafts.is_empty() && faults.is_empty() {
        faults.push(Fault::of(
            "",
            "there are no blocks",
            "at least one fixed block and one that moves",
            "add blocks",
        ));
    }
    hold(&mut drafts, &options.fixed, &mut faults);
    same_ids(&drafts, &mut faults);
    supports(&drafts, options.on_platform, &mut faults);
    groups(&drafts, &mut faults, &mut warnings);
    let mut mended = Mended::default();
    let mut next_id = drafts.iter().filter_map(|draft| draft.id).max().map_or(0, |id| id.saturating_add(1));
    let mut file = WallFile {
        wall: Wall::default(),
        ids: Vec::new(),
        names: Vec::new(),
        warnings: Vec::new(),
        drawn: None,
    };
    for draft in drafts.into_iter().filter(|draft| draft.readable) {
        let line = draft.line;
        let found = match checked(&draft, unit, options, &mut mended, &mut warnings) {
            Ok(blocks) => {
                let several = blocks.len() > 1;
                for (nth, block) in blocks.into_iter().enumerate() {
                    file.wall.blocks.push(block);
                    // The first part has the block's id, the others what no block has.
                    file.ids.push(if nth == 0 { draft.id.unwrap_or(0) } else { next_id });
                    next_id += u64::from(nth > 0);
                    let part = if several { format!(", part {}", nth + 1) } else { String::new() };
                    file.names.push(format!("{}{part}", draft.name));
                }
                continue;
            }
            Err(found) => found,
        };
        for fault in found {
            let line = if fault.line > 0 { fault.line } else { line };
            faults.push(fault.at(line, 0));
        }
    }
    if options.scan_bearing.is_some() || options.any_shape {
        lower(&mut file.wall);
    }
    warnings.extend(mended.told(options.flatness));
    file.warnings = warnings;
    if faults.is_empty() { Ok(file) } else { Err(faults) }
}

/// Lowers stones without ground onto the plane z = 0.
fn lower(wall: &mut Wall) {
    if wall.blocks.is_empty() || wall.blocks.iter().any(|block| block.support == Support::Fixed) {
        return;
    }
    let down = Vec3::new(0.0, 0.0, -wall.bounds().0.z);
    wall.blocks.iter_mut().for_each(|block| block.shift(&down));
}

/// Fixes the blocks with these ids.
fn hold(drafts: &mut [Draft], ids: &[u64], faults: &mut WallFaults) {
    for id in ids {
        match drafts.iter_mut().find(|draft| draft.id == Some(*id)) {
            Some(draft) => {
                draft.fixed = true;
                draft.tag = Tag::Base;
            }
            None => faults.push(Fault::of(
                "",
                format!("there is no block with the id {id}, which is to be fixed"),
                format!("ids of the file, such as {}", ids_shown(drafts)),
                "correct --fixed",
            )),
        }
    }
}

/// Some ids of a file.
fn ids_shown(drafts: &[Draft]) -> String {
    let ids: Vec<String> =
        drafts.iter().filter_map(|draft| draft.id).take(5).map(|id| id.to_string()).collect();
    ids.join(", ")
}

fn same_ids(drafts: &[Draft], faults: &mut WallFaults) {
    let mut seen = BTreeMap::new();
    for (place, draft) in drafts.iter().enumerate() {
        let Some(id) = draft.id else { continue };
        if let Some(first) = seen.insert(id, place) {
            faults.push(Fault::of(
                &draft.name,
                format!("the id {id} is there twice: entries {first} and {place} of the list"),
                "every id once",
                "give one of them another id",
            ));
        }
    }
}

fn supports(drafts: &[Draft], on_platform: bool, faults: &mut WallFaults) {
    let readable = drafts.iter().all(|draft| draft.readable);
    if !drafts.is_empty() && readable && !on_platform && drafts.iter().all(|draft| !draft.fixed) {
        faults.push(Fault::of(
            "",
            "there is no support: no block is fixed",
            "at least one fixed block, for example the ground",
            "set \"fixed\": true on the ground's block (in OBJ: name its object base or fixed), or ask --fixed ID; to a generated wall, `pirca wall --with-base` adds one",
        ));
    }
    if !drafts.is_empty() && readable && drafts.iter().all(|draft| draft.fixed) {
        faults.push(Fault::of(
            "",
            "every block is fixed",
            "at least one block that moves",
            "leave the stones free",
        ));
    }
}

/// The parts of a stone are held alike.
fn groups(drafts: &[Draft], faults: &mut WallFaults, warnings: &mut Vec<String>) {
    let mut of: BTreeMap<&str, Vec<&Draft>> = BTreeMap::new();
    for draft in drafts.iter().filter(|draft| draft.readable) {
        if let Some(group) = &draft.group {
            of.entry(group).or_default().push(draft);
        }
    }
    for (group, parts) in of {
        if let [only] = parts[..] {
            warnings.push(format!("{} is the only part of group \"{group}\"", only.name));
        }
        if let Some(other) = parts.iter().find(|part| part.fixed != parts[0].fixed) {
            let (free, fixed) = if other.fixed { (parts[0], *other) } else { (*other, parts[0]) };
            faults.push(Fault::of(
                &free.name,
                format!("it is free and {} is fixed, and both are parts of group \"{group}\"", fixed.name),
                "all parts of a group fixed or none, as they are one body",
                "set the same \"fixed\" for all of them",
            ));
        }
    }
}

/// The block, or its convex parts where it is concave and may be divided; or all its faults.
fn checked(
    draft: &Draft,
    unit: Unit,
    options: &ReadOptions,
    mended: &mut Mended,
    warnings: &mut Vec<String>,
) -> Result<Vec<Block>, Vec<Fault>> {
    let turn = turned(options.turn);
    let in_metres = |v: &Vec3| v / unit.per_metre();
    let vertices: Vec<Vec3> =
        draft.vertices.iter().map(|v| turn.map_or(in_metres(v), |t| t * in_metres(v))).collect();
    let bearing = options.scan_bearing.filter(|_| !draft.fixed);
    let mut faults = density(draft);
    let is_mesh = options.any_shape && !draft.fixed;
    let mut numbers =
        counts(draft, if bearing.is_some() || is_mesh { MOST_SCANNED } else { MOST_VERTICES }, is_mesh);
    numbers.extend(coordinates(draft, &vertices));
    let (faces, outside) = indices(draft);
    numbers.extend(outside);
    // A shape is looked at only where its numbers make sense.
    if !numbers.is_empty() {
        faults.extend(numbers);
        return Err(faults);
    }
    faults.extend(size(draft, &vertices, unit));
    if let (Some(bearing), true) = (bearing, faults.is_empty()) {
        let stone = scanned(&draft.name, &vertices, &faces, bearing)?;
        return Ok(vec![block(draft, stone.hull, Some(stone.holds))]);
    }
    if let (Some(scan), true) = (draft.scan, faults.is_empty()) {
        let scan = in_unit(&scan, 1.0 / unit.per_metre());
        let scan = turn.map_or(scan, |turn| scan.mapped(&turn));
        return Ok(vec![block(draft, stated(&draft.name, &vertices, &faces)?, Some(scan))]);
    }
    // What is a hull anyway need not be a solid with few corners.
    let solid = if is_mesh && faces.len() > MOST_VERTICES {
        Err(Vec::new())
    } else {
        solid(&draft.name, &vertices, &faces, options.flatness)
    };
    if let (Err(_), true, true) = (&solid, options.parts, faults.is_empty())
        && let Some(parts) = divided(&draft.name, &vertices, &faces)
    {
        let group = Some(draft.group.clone().unwrap_or_else(|| draft.name.clone()));
        warnings.push(format!("{}: concave; taken as {} convex parts of one stone", draft.name, parts.len()));
        return Ok(parts
            .into_iter()
            .map(|part| Block { group: group.clone(), ..block(draft, part, None) })
            .collect());
    }
    if let (Err(_), true, true) = (&solid, is_mesh, faults.is_empty()) {
        let stone = hulled(&draft.name, &vertices, &faces, options.flatness)?;
        warnings.push(format!("{}: {}", draft.name, stone.told()));
        return Ok(vec![block(draft, stone.hull, stone.holds)]);
    }
    let (Ok(solid), true) = (&solid, faults.is_empty()) else {
        faults.extend(solid.err().unwrap_or_default());
        return Err(faults);
    };
    mended.note(&draft.name, solid, diagonal(&vertices));
    let used: BTreeSet<&u32> = faces.iter().flatten().collect();
    if used.len() < vertices.len() {
        let idle = vertices.len() - used.len();
        warnings.push(format!("{}: {idle} vertices belong to no face and are dropped", draft.name));
    }
    Ok(vec![block(draft, solid.shape.clone(), None)])
}

fn block(draft: &Draft, shape: Polyhedron, scan: Option<MassProperties>) -> Block {
    Block {
        shape,
        density: draft.density.unwrap_or(FIXED_DENSITY),
        support: if draft.fixed { Support::Fixed } else { Support::Free },
        tag: draft.tag.clone(),
        group: draft.group.clone(),
        scan,
    }
}

/// The turn about the z axis by an angle (rad); `None` of none, which leaves every bit as it is.
fn turned(angle: f64) -> Option<Mat3> {
    let (s, c) = (sin(angle), cos(angle));
    (angle != 0.0).then(|| Mat3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0))
}

/// In another unit of length, of which one of before has so many.
fn in_unit(scan: &MassProperties, length: f64) -> MassProperties {
    let volume = length * length * length;
    MassProperties {
        volume: scan.volume * volume,
        centroid: scan.centroid * length,
        inertia: scan.inertia * (volume * length * length),
    }
}

fn density(draft: &Draft) -> Vec<Fault> {
    let fault = |found: String, fix: &str| {
        let allowed = format!("a density from {LIGHTEST} to {HEAVIEST} kg/m^3");
        vec![Fault::of(&draft.name, found, allowed, fix)]
    };
    match draft.density {
        Some(d) if (LIGHTEST..=HEAVIEST).contains(&d) => Vec::new(),
        None if draft.fixed => Vec::new(),
        None => fault("density is missing".to_owned(), "add \"density\": 2400, in kg/m^3"),
        Some(d) if (LIGHTEST..=HEAVIEST).contains(&(1000.0 * d)) => {
            fault(format!("density is {d}"), "t/m^3 or g/cm^3 by mistake? Multiply it by 1000")
        }
        Some(d) => fault(format!("density is {d}"), "give the stone's density in kg/m^3"),
    }
}

/// Too few or too many vertices and faces; a mesh of triangles has twice as many faces, and a cloud of points none.
fn counts(draft: &Draft, most: usize, is_mesh: bool) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (n, what) in [(draft.vertices.len(), "vertices"), (draft.faces.len(), "faces")] {
        if is_mesh && what == "faces" && (n == 0 || (most..=2 * most).contains(&n)) {
            continue;
        }
        if !(4..=most).contains(&n) {
            let fix = if n < 4 { "a solid needs at least 4" } else { "simplify the block's surface" };
            faults.push(Fault::of(&draft.name, format!("{n} {what}"), format!("4 to {most} {what}"), fix));
        }
    }
    faults
}

fn coordinates(draft: &Draft, vertices: &[Vec3]) -> Vec<Fault> {
    let far = |v: &Vec3| !v.iter().all(|c| c.abs() <= FARTHEST);
    vertices
        .iter()
        .enumerate()
        .filter(|(_, v)| far(v))
        .map(|(i, v)| {
            let found = format!("vertex {i} is at ({:e}, {:e}, {:e}) m", v.x, v.y, v.z);
            let allowed = format!("finite coordinates up to {FARTHEST:e} m");
            Fault::of(&draft.name, found, allowed, "correct it, or move the wall's origin near the wall")
        })
        .collect()
}

/// The faces with numbers of vertices that exist, each once per face; and what is wrong with the others.
fn indices(draft: &Draft) -> (Vec<Vec<u32>>, Vec<Fault>) {
    let count = draft.vertices.len();
    let (mut faces, mut faults) = (Vec::with_capacity(draft.faces.len()), Vec::new());
    for (number, face) in draft.faces.iter().enumerate() {
        let mut fault = |found: String, allowed: String, fix: &str| {
            faults.push(Fault::of(&draft.name, found, allowed, fix));
        };
        if face.len() < 3 {
            fault(
                format!("face {number} has {} vertices", face.len()),
                "at least 3 vertices of a face".to_owned(),
                "complete or remove the face",
            );
        } else if let Some(bad) = face.iter().find(|&&v| v < 0 || v >= count as i64) {
            fault(
                format!("face {number} names vertex {bad}, which is out of range"),
                format!("0 to {} (the block has {count} vertices, counted from 0)", count.saturating_sub(1)),
                "correct the number",
            );
        } else if let Some(twice) = repeated(face) {
            fault(
                format!("face {number} names vertex {twice} twice"),
                "every vertex once in a face".to_owned(),
                "remove the repetition",
            );
        } else {
            faces.push(face.iter().map(|&v| v as u32).collect());
        }
    }
    (faces, faults)
}

fn repeated(face: &[i64]) -> Option<i64> {
    let mut seen = BTreeSet::new();
    face.iter().copied().find(|v| !seen.insert(*v))
}

/// A block of a size that no wall has: the unit is wrong.
fn size(draft: &Draft, vertices: &[Vec3], unit: Unit) -> Option<Fault> {
    let size = diagonal(vertices);
    let largest = if draft.fixed { LARGEST_FIXED } else { LARGEST_STONE };
    if (SMALLEST..=largest).contains(&size) {
        return None;
    }
    // A usual stone measures some decimetres.
    let usual = |other: Unit| (0.02..=5.0).contains(&(size * unit.per_metre() / other.per_metre()));
    let fix = match [Unit::Metre, Unit::Centimetre, Unit::Millimetre].into_iter().find(|&other| usual(other))
    {
        Some(other) => format!("coordinates in {0} by mistake? Set the unit to {0}", other.name()),
        None => "check the coordinates and the unit".to_owned(),
    };
    Some(Fault::of(
        &draft.name,
        format!("it measures {size:.4} m from corner to corner (unit {})", unit.name()),
        format!("{SMALLEST} to {largest} m for a {}", if draft.fixed { "fixed block" } else { "stone" }),
        fix,
    ))
}
