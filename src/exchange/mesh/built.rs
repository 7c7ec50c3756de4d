//! The wall in meshes: one file with all stones, or a folder with a file for each.

use std::io;
use std::path::{Path, PathBuf};

use crate::exchange::draft::{Draft, MOST_BLOCKS, USUAL_DENSITY, WallFile, assumed_density, build};
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::mesh::oriented::orient;
use crate::exchange::mesh::split::pieces;
use crate::exchange::mesh::{Mesh, read_gltf, read_ply, read_stl};
use crate::exchange::read::wall_bytes;
use crate::exchange::read_obj::{is_support, obj_drafts};
use crate::exchange::{Format, ReadOptions, Unit, Up};

/// The wall of meshes, a stone for each that hangs together. `usual` is the axis that points up unless the options say otherwise.
///
/// # Errors
/// All that is wrong with its stones.
pub(in crate::exchange) fn stones(
    meshes: Vec<Mesh>,
    warnings: Vec<String>,
    usual: Up,
    options: &ReadOptions,
) -> Result<WallFile, WallFaults> {
    finished(drafts(meshes, usual, options), WallFaults::new("mesh"), warnings, options)
}

/// The wall in a folder with a mesh for each stone (.obj, .ply, .stl, .glb, .gltf), by their names.
///
/// # Errors
/// All that is wrong with the files and with their stones.
pub(in crate::exchange) fn read_folder(folder: &Path, options: &ReadOptions) -> Result<WallFile, WallFaults> {
    let (mut faults, mut warnings, mut all) = (WallFaults::new("folder"), Vec::new(), Vec::new());
    let options = ReadOptions { any_shape: true, ..options.clone() };
    let files = meshes_of(folder).unwrap_or_else(|error| {
        faults.push(Fault::of("", format!("cannot be read: {error}"), "a folder", "check the path"));
        Vec::new()
    });
    if files.is_empty() && faults.is_empty() {
        let found = "the folder has no meshes";
        faults.push(Fault::of(
            "",
            found,
            "a file for each stone (.obj, .ply, .stl, .glb, .gltf)",
            "check the path",
        ));
    }
    for path in files {
        let title = stem(&path);
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match of_file(&path, &file, &options) {
            Ok((drafts, notes)) => {
                let alone = drafts.len() == 1;
                for mut draft in drafts {
                    draft.name = if alone { title.clone() } else { format!("{title}, {}", draft.name) };
                    draft.fixed |= is_support(&title);
                    all.push(draft);
                }
                warnings.extend(notes.into_iter().map(|note| format!("{file}: {note}")));
            }
            Err(found) => found.faults.into_iter().for_each(|fault| {
                let block =
                    if fault.block.is_empty() { file.clone() } else { format!("{file}, {}", fault.block) };
                faults.push(Fault { block, ..fault });
            }),
        }
    }
    if all.len() > MOST_BLOCKS {
        let found = format!("{} stones", all.len());
        faults.push(Fault::of("", found, format!("at most {MOST_BLOCKS}"), "divide the wall"));
    }
    numbered(&mut all);
    finished(all, faults, warnings, &options)
}

/// The files of meshes in a folder, those with a smaller number in their names first.
///
/// # Errors
/// A folder that cannot be read.
pub fn meshes_of(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder)?;
    let mut files = entries.map(|own| own.map(|own| own.path())).collect::<io::Result<Vec<PathBuf>>>()?;
    files.retain(|path| {
        let format = Format::of(&path.display().to_string());
        let is_mesh =
            |format: Format| format == Format::Obj || format.is_mesh() && format != Format::ThreeDec;
        format.is_some_and(is_mesh) && path.is_file()
    });
    files.sort_by_cached_key(|path| (number(&stem(path)), path.clone()));
    Ok(files)
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The number that a name ends in.
fn number(name: &str) -> Option<u64> {
    let digits = name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    name[digits..].parse().ok()
}

/// Stones get the numbers in the names of their files where each has one of its own.
fn numbered(drafts: &mut [Draft]) {
    let mut numbers: Vec<u64> = drafts.iter().filter_map(|draft| number(&draft.name)).collect();
    let all = numbers.len();
    numbers.sort_unstable();
    numbers.dedup();
    let by_name = all == drafts.len() && numbers.len() == all;
    for (place, draft) in (0..).zip(drafts) {
        draft.id = if by_name { number(&draft.name) } else { Some(place) };
    }
}

fn of_file(path: &Path, file: &str, options: &ReadOptions) -> Result<(Vec<Draft>, Vec<String>), WallFaults> {
    let bytes = wall_bytes(path, file)?;
    let format = Format::of(file);
    let meshes = match format {
        Some(Format::Ply) => read_ply(&bytes)?,
        Some(Format::Stl) => read_stl(&bytes)?,
        Some(Format::Gltf) => read_gltf(&bytes)?,
        _ => {
            // The densities of all are told together.
            let of_object =
                ReadOptions { density: Some(options.density.unwrap_or(USUAL_DENSITY)), ..options.clone() };
            let read = obj_drafts(&String::from_utf8_lossy(&bytes), &of_object)?;
            return if read.faults.is_empty() { Ok((read.drafts, read.warnings)) } else { Err(read.faults) };
        }
    };
    Ok((drafts(meshes, format.map_or(Up::Z, Up::usual), options), Vec::new()))
}

/// The stones of meshes, each with a number of its own.
fn drafts(meshes: Vec<Mesh>, usual: Up, options: &ReadOptions) -> Vec<Draft> {
    let all = meshes.into_iter().flat_map(pieces).enumerate();
    all.map(|(place, mesh)| draft(place as u64, mesh, usual, options)).collect()
}

fn draft(place: u64, mut mesh: Mesh, usual: Up, options: &ReadOptions) -> Draft {
    orient(&mut mesh);
    let fixed = mesh.is_support.unwrap_or_else(|| mesh.name.as_deref().is_some_and(is_support));
    let block = format!("block {place}");
    // A written wall has such names already.
    let has_number =
        |name: &str| name.strip_prefix(&block).is_some_and(|rest| rest.is_empty() || rest.starts_with(" ("));
    let name = match &mesh.name {
        Some(name) if has_number(name) => name.clone(),
        Some(name) => format!("{block} ({name})"),
        None => block,
    };
    let up = options.up.unwrap_or(usual);
    let corners = mesh.vertices.iter().map(|own| up.of_wall(own)).collect();
    let faces = mesh.faces.iter().map(|face| face.iter().map(|own| i64::from(*own)).collect()).collect();
    let plain = Draft::plain(name, place, fixed, (corners, faces));
    Draft { line: mesh.line, density: options.density.or(plain.density), ..plain }
}

fn finished(
    drafts: Vec<Draft>,
    faults: WallFaults,
    mut warnings: Vec<String>,
    options: &ReadOptions,
) -> Result<WallFile, WallFaults> {
    let unstated = if options.density.is_none() { drafts.iter().filter(|own| !own.fixed).count() } else { 0 };
    warnings.extend(assumed_density(unstated));
    let options = ReadOptions { any_shape: true, on_platform: true, ..options.clone() };
    build(drafts, options.unit.unwrap_or(Unit::Metre), &options, faults, warnings)
}
