//! What a file is by the ending of its name, and what that says about its contents.

use std::path::Path;

/// The formats of walls that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `wall.json`, or an assembly of COMPAS.
    Json,
    /// Wavefront OBJ.
    Obj,
    /// A table of the stones of an elevation.
    Csv,
    /// The same as a workbook.
    Xlsx,
    /// A mesh or a cloud of points, as PLY.
    Ply,
    /// A mesh, as STL.
    Stl,
    /// A scene of meshes, as glTF.
    Gltf,
    /// Blocks as commands of 3DEC.
    ThreeDec,
    /// A drawing of an elevation, as DXF.
    Dxf,
    /// The same as SVG.
    Svg,
    /// The same as GeoJSON.
    GeoJson,
    /// A picture of an elevation.
    Picture,
}

/// The formats by the endings of files.
const ENDINGS: [(&str, Format); 18] = [
    ("json", Format::Json),
    ("obj", Format::Obj),
    ("csv", Format::Csv),
    ("xlsx", Format::Xlsx),
    ("ply", Format::Ply),
    ("stl", Format::Stl),
    ("glb", Format::Gltf),
    ("gltf", Format::Gltf),
    ("3ddat", Format::ThreeDec),
    ("dat", Format::ThreeDec),
    ("dxf", Format::Dxf),
    ("svg", Format::Svg),
    ("geojson", Format::GeoJson),
    ("png", Format::Picture),
    ("tif", Format::Picture),
    ("tiff", Format::Picture),
    ("jpg", Format::Picture),
    ("jpeg", Format::Picture),
];

/// The endings in words.
pub const WALL_FILES: &str = ".json, .obj, .ply, .stl, .glb, .gltf or .3ddat; a drawing (.dxf, .svg, .geojson), a picture (.png, .tif, .jpg) or a table (.csv, .xlsx)";

impl Format {
    /// That of a file, by its name.
    pub fn of(name: &str) -> Option<Format> {
        let ending = Path::new(name).extension()?.to_str()?.to_ascii_lowercase();
        ENDINGS.iter().find(|(own, _)| *own == ending).map(|(_, format)| *format)
    }

    /// Whether it shows the face of a wall, which stands on the platform unless a ground is drawn, and whose depth is asked for.
    pub fn is_elevation(self) -> bool {
        matches!(self, Format::Csv | Format::Xlsx) || self.is_drawn()
    }

    /// Whether it shows outlines, whose joints are closed as they are read.
    pub fn is_drawn(self) -> bool {
        matches!(self, Format::Dxf | Format::Svg | Format::GeoJson | Format::Picture)
    }

    /// Whether it holds meshes of any shape, of which none need be the ground.
    pub fn is_mesh(self) -> bool {
        matches!(self, Format::Ply | Format::Stl | Format::Gltf | Format::ThreeDec)
    }
}
