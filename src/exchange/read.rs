//! Walls that others made: the file by its ending, its size and its text.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::exchange::draft::WallFile;
use crate::exchange::drawing::{Drawing, Size, built, read_dxf, read_geojson, read_picture, read_svg};
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::format::{Format, WALL_FILES};
use crate::exchange::mesh::{self, read_folder, read_gltf, read_ply, read_stl, with_buffers};
use crate::exchange::read_compas::{compas, read_compas};
use crate::exchange::read_json::read_json;
use crate::exchange::read_obj::read_obj;
use crate::exchange::read_table::{numbered, read_rows, read_table};
use crate::exchange::sheet::sheet_rows;
use crate::exchange::threedec::read_3dec;
use crate::math::Vec3;

/// Largest file that is read (bytes).
pub const LARGEST_FILE: u64 = 64 << 20;

/// So much of a file (bytes) has the type that COMPAS states at its beginning.
const BEGINNING: u64 = 4096;

/// The unit of a file's coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unit {
    /// Metres.
    #[default]
    Metre,
    /// Centimetres.
    Centimetre,
    /// Millimetres.
    Millimetre,
}

impl Unit {
    /// By its name in files: `m`, `cm` or `mm`.
    pub fn named(name: &str) -> Option<Unit> {
        [Unit::Metre, Unit::Centimetre, Unit::Millimetre].into_iter().find(|unit| unit.name() == name)
    }

    /// Its name in files.
    pub fn name(&self) -> &'static str {
        match self {
            Unit::Metre => "m",
            Unit::Centimetre => "cm",
            Unit::Millimetre => "mm",
        }
    }

    /// How many of it make a metre. Coordinates are divided by it, which rounds once: 400 mm are 0.4 m to the bit.
    pub fn per_metre(&self) -> f64 {
        match self {
            Unit::Metre => 1.0,
            Unit::Centimetre => 100.0,
            Unit::Millimetre => 1000.0,
        }
    }
}

/// The axis of a file that points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// The first one: the file's x, y, z become z, x, y of the wall.
    X,
    /// The second one, as programs for pictures have it: the file's x, y, z become x, z, -y of the wall.
    Y,
    /// The third one.
    #[default]
    Z,
}

impl Up {
    /// By its name in files: `x`, `y` or `z`.
    pub fn named(name: &str) -> Option<Up> {
        [("x", Up::X), ("y", Up::Y), ("z", Up::Z)].iter().find(|(own, _)| *own == name).map(|(_, up)| *up)
    }

    /// The axis that points up in files of a format unless somebody says otherwise: in glTF it is the second one by its specification.
    pub fn usual(format: Format) -> Up {
        if format == Format::Gltf { Up::Y } else { Up::Z }
    }

    /// A point of the file in the wall's axes.
    pub fn of_wall(&self, point: &Vec3) -> Vec3 {
        match self {
            Up::X => Vec3::new(point.y, point.z, point.x),
            Up::Y => Vec3::new(point.x, -point.z, point.y),
            Up::Z => *point,
        }
    }
}

/// What a file does not say about itself, and what is allowed of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Unit of the coordinates of an OBJ file; metres without it.
    pub unit: Option<Unit>,
    /// Density (kg/m^3) of the objects of an OBJ file without a density comment; 2400 with a warning without it.
    pub density: Option<f64>,
    /// The axis of a file of meshes that points up; without it the usual one of the format ([`Up::usual`]).
    pub up: Option<Up>,
    /// How far (m) corners may lie off the plane of their face, or outside the plane of another one: such faces are made plane,
    /// and how far corners were moved is told. Without it, or where it is less, 1e-4 of the block's size is allowed, and
    /// nothing is moved.
    pub flatness: Option<f64>,
    /// The objects of an OBJ file are scans of stones, of any shape: how far (m) above its lowest point a stone bears. Each touches others as
    /// its hull, and weighs as its scan. A file without fixed blocks is lowered onto the plane z = 0.
    pub scan_bearing: Option<f64>,
    /// Blocks that are not convex become their hulls, and weigh as they did; so do those of meshes (`.ply`, `.stl`, glTF) always.
    pub any_shape: bool,
    /// Concave blocks become convex parts of one stone, which fill it exactly; without it they are refused.
    pub parts: bool,
    /// How deep (m) stones of an elevation are of which it says nothing.
    pub thickness: Option<f64>,
    /// How large a pixel of a picture is (m).
    pub pixel: Option<f64>,
    /// How long all stones of a picture or of a drawing are together (m).
    pub width: Option<f64>,
    /// A drawing or a picture shows the wall in section, its thickness to the right: a slice as long as `thickness`, or 1 m.
    pub section: bool,
    /// Up to which width (m) the joints of a picture or of a drawing are closed.
    pub closing: Option<f64>,
    /// Blocks that are fixed besides those of which the file says so, by their ids.
    pub fixed: Vec<u64>,
    /// By how much all is turned about the z axis (rad), counter-clockwise seen from above.
    pub turn: f64,
    /// Whether a wall without a fixed block is one: it stands on a platform that is put under it.
    pub on_platform: bool,
}

/// Whether a file states neither its unit nor its densities, by its ending and its beginning: OBJ, tables, and JSON of COMPAS.
pub fn leaves_units_open(path: &Path) -> bool {
    let mut beginning = Vec::new();
    // What cannot be read is told when it is to be read.
    let _ = File::open(path).and_then(|file| file.take(BEGINNING).read_to_end(&mut beginning));
    states_no_units(&path.display().to_string(), &beginning)
}

/// The same by the file's name and its bytes, or its first ones.
pub fn states_no_units(name: &str, bytes: &[u8]) -> bool {
    match Format::of(name) {
        Some(Format::Json) => {
            let beginning = &bytes[..bytes.len().min(BEGINNING as usize)];
            compas(&String::from_utf8_lossy(beginning)).is_some()
        }
        Some(_) => true,
        None => false,
    }
}

/// Reads a wall from a file, whose format its ending tells ([`Format`]), or from a folder with a mesh for each stone.
///
/// # Errors
/// Everything that is wrong with the file, block by block; see [`WallFaults`].
pub fn read_wall(path: &Path, options: &ReadOptions) -> Result<WallFile, WallFaults> {
    let name = path.display().to_string();
    if path.is_dir() {
        return read_folder(path, options).map_err(|faults| WallFaults { file: name, ..faults });
    }
    read_wall_bytes(&name, &wall_bytes(path, &name)?, options)
}

/// The bytes of a file that may be a wall, by its ending and its size; messages call it `name`. The bytes of a `.gltf` hold those of the files
/// beside it.
///
/// # Errors
/// The fault of a file that cannot be one, or cannot be read.
pub fn wall_bytes(path: &Path, name: &str) -> Result<Vec<u8>, WallFaults> {
    if Format::of(name).is_none() {
        let found = "the ending of the file says no format that is read";
        return refused(name, Fault::of("", found, WALL_FILES, "rename or convert the file"));
    }
    let mut bytes = Vec::new();
    // One byte more than allowed tells a file that is too large, also where its length cannot be asked for.
    let read = File::open(path).and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes));
    if let Err(error) = read {
        let found = format!("cannot be read: {error}");
        return refused(name, Fault::of("", found, "a file", "check the path"));
    }
    if bytes.len() as u64 > LARGEST_FILE {
        let allowed = format!("at most {} MiB", LARGEST_FILE >> 20);
        let fault = Fault::of("", "the file is too large", allowed, "divide or simplify the wall");
        return refused(name, fault);
    }
    if Format::of(name) == Some(Format::Gltf) {
        return with_buffers(path, bytes, LARGEST_FILE).or_else(|fault| refused(name, *fault));
    }
    Ok(bytes)
}

/// The wall that the bytes of a file say; its name tells the format.
///
/// # Errors
/// As [`read_wall`].
pub fn read_wall_bytes(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<WallFile, WallFaults> {
    let of_rows =
        |(rows, warnings): (Vec<Vec<String>>, Vec<String>)| read_rows(&numbered(rows), warnings, options);
    let drawn = |drawing: Drawing| built(drawing, Size::OfUnits, options);
    let format = Format::of(name);
    let up = format.map_or(Up::Z, Up::usual);
    let stones = |meshes| mesh::stones(meshes, Vec::new(), up, options);
    let read = match format {
        Some(Format::Picture) => {
            read_picture(bytes).and_then(|picture| built(picture, Size::OfPixels, options))
        }
        Some(Format::Dxf) => read_dxf(bytes).and_then(drawn),
        Some(Format::Xlsx) => sheet_rows(bytes).and_then(of_rows),
        Some(Format::Ply) => read_ply(bytes).and_then(stones),
        Some(Format::Stl) => read_stl(bytes).and_then(stones),
        Some(Format::Gltf) => read_gltf(bytes).and_then(stones),
        // Remarks in it may be of any coding.
        Some(Format::ThreeDec) => read_3dec(&String::from_utf8_lossy(bytes))
            .and_then(|(meshes, warnings)| mesh::stones(meshes, warnings, up, options)),
        format => {
            let Ok(text) = std::str::from_utf8(bytes) else {
                return refused(name, Fault::of("", "the file is no text", "UTF-8 text", "save it as UTF-8"));
            };
            of_text(format, text.strip_prefix('\u{feff}').unwrap_or(text), options)
        }
    };
    read.map_err(|faults| WallFaults { file: name.to_owned(), ..faults })
}

fn of_text(format: Option<Format>, text: &str, options: &ReadOptions) -> Result<WallFile, WallFaults> {
    match (format, compas(text)) {
        (Some(Format::Obj), _) => read_obj(text, options),
        (Some(Format::Csv), _) => read_table(text, options),
        (Some(Format::Svg), _) => read_svg(text).and_then(|drawing| built(drawing, Size::OfUnits, options)),
        (Some(Format::GeoJson), _) => {
            read_geojson(text).and_then(|drawing| built(drawing, Size::OfUnits, options))
        }
        (_, Some(kind)) => read_compas(kind, text, options),
        (_, None) => read_json(text, options),
    }
}

fn refused<T>(name: &str, fault: Fault) -> Result<T, WallFaults> {
    let mut faults = WallFaults::new(name);
    faults.push(fault);
    Err(faults)
}
