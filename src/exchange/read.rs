//! Walls that others made: the file by its ending, its size and its text.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::exchange::draft::WallFile;
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::read_json::read_wall_json_with;
use crate::exchange::read_obj::read_obj;
use crate::math::Vec3;

/// Largest file that is read (bytes).
pub const LARGEST_FILE: u64 = 64 << 20;

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
    /// The second one, as programs for pictures have it: the file's x, y, z become x, z, -y of the wall.
    Y,
    /// The third one.
    #[default]
    Z,
}

impl Up {
    /// A point of the file in the wall's axes.
    pub fn of_wall(&self, point: &Vec3) -> Vec3 {
        match self {
            Up::Y => Vec3::new(point.x, -point.z, point.y),
            Up::Z => *point,
        }
    }
}

/// What a file does not say about itself, and what is allowed of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Unit of the coordinates of an OBJ file; metres without it.
    pub unit: Option<Unit>,
    /// Density (kg/m^3) of the objects of an OBJ file without a density comment; 2400 with a warning without it.
    pub density: Option<f64>,
    /// The axis of an OBJ file that points up; the third one unless it is changed.
    pub up: Up,
    /// How far (m) corners may lie off the plane of their face, or outside the plane of another one: such faces are made plane,
    /// and how far corners were moved is told. Without it, or where it is less, 1e-4 of the block's size is allowed, and
    /// nothing is moved.
    pub flatness: Option<f64>,
}

/// Reads a wall from a `.json` or `.obj` file.
///
/// # Errors
/// Everything that is wrong with the file, block by block; see [`WallFaults`].
pub fn read_wall(path: &Path, options: &ReadOptions) -> Result<WallFile, WallFaults> {
    let name = path.display().to_string();
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let refused = |fault: Fault| {
        let mut faults = WallFaults::new(&name);
        faults.push(fault);
        Err(faults)
    };
    if !matches!(ending.as_deref(), Some("json" | "obj")) {
        let found = "the ending of the file says no format that is read";
        return refused(Fault::of("", found, ".json or .obj", "rename or convert the file"));
    }
    let mut bytes = Vec::new();
    // One byte more than allowed tells a file that is too large, also where its length cannot be asked for.
    let read = File::open(path).and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes));
    if let Err(error) = read {
        return refused(Fault::of("", format!("cannot be read: {error}"), "a file", "check the path"));
    }
    if bytes.len() as u64 > LARGEST_FILE {
        let allowed = format!("at most {} MiB", LARGEST_FILE >> 20);
        return refused(Fault::of("", "the file is too large", allowed, "divide or simplify the wall"));
    }
    let Ok(text) = String::from_utf8(bytes) else {
        return refused(Fault::of("", "the file is no text", "UTF-8 text", "save it as UTF-8"));
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let read = match ending.as_deref() {
        Some("obj") => read_obj(text, options),
        _ => read_wall_json_with(text, options.flatness),
    };
    read.map_err(|faults| WallFaults { file: name, ..faults })
}
