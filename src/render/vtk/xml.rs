//! VTK's XML as ASCII text. Every number is the shortest one that reads back to the same bits.

use std::fmt::{Display, Write};

use crate::math::Vec3;
use crate::model::ReplayState;

/// An unstructured grid of so many points and cells. `field` are numbers of the grid as a whole, `body` writes its points, cells and
/// data.
pub fn grid([points, cells]: [usize; 2], field: &[(&str, f64)], body: impl FnOnce(&mut String)) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n",
    );
    if !field.is_empty() {
        text.push_str("<FieldData>\n");
        for (name, value) in field {
            let _ = writeln!(
                text,
                "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfTuples=\"1\" format=\"ascii\">\n{value}\n</DataArray>"
            );
        }
        text.push_str("</FieldData>\n");
    }
    let _ = writeln!(text, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">");
    body(&mut text);
    text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"
}

/// What is said of a state as a whole: its load (SI units, see [`Level`](crate::model::Level)), and whether it is at rest (1) or
/// falling (0).
pub fn field(state: &ReplayState) -> [(&'static str, f64); 2] {
    [("load", state.level.value()), ("at_rest", f64::from(u8::from(state.is_equilibrium)))]
}

/// One data array, an entry per line. A single component is left unsaid, as VTK's writer leaves it: readers such as meshio take the word
/// for a matrix of one column.
pub fn array<T: Display>(
    text: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    entries: impl IntoIterator<Item = T>,
) {
    let mut line = |arguments: std::fmt::Arguments| {
        writeln!(text, "{arguments}").expect("a string takes every text");
    };
    let said = match components {
        1 => String::new(),
        more => format!(" NumberOfComponents=\"{more}\""),
    };
    line(format_args!("<DataArray type=\"{kind}\" Name=\"{name}\"{said} format=\"ascii\">"));
    for entry in entries {
        line(format_args!("{entry}"));
    }
    line(format_args!("</DataArray>"));
}

/// A vector as an entry.
pub fn vector(v: &Vec3) -> String {
    format!("{} {} {}", v.x, v.y, v.z)
}
