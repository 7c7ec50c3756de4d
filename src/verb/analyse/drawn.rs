//! What was read of a drawing or a picture, over what was drawn: the stones with their numbers.

use std::fmt::Write;
use std::path::Path;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use crate::exchange::{Drawn, WallFile};
use crate::math::Vec3;
use crate::model::{Block, Support};
use crate::shape::{Polygon, bounds};

/// Width of the picture (units of the SVG), and its rim.
const WIDE: f64 = 900.0;
const RIM: f64 = 10.0;
/// Largest picture that is put into it (bytes); of others the outlines are drawn.
const MOST_BYTES: usize = 4 << 20;
/// Numbers are as high as this share of the edge of a square of a stone's area, and no higher than so many units.
const NUMBER: f64 = 0.3;
const HIGHEST: f64 = 16.0;

/// The picture as SVG; `bytes` are those of the file. `None` where nothing was drawn.
pub(crate) fn svg(file: &WallFile, path: &Path, bytes: &[u8]) -> Option<String> {
    let drawn = file.drawn.as_ref()?;
    let [left, low, right, high] = drawn.frame.unwrap_or_else(|| bounds(drawn.outlines.iter().flatten()));
    let scale = WIDE / (right - left);
    let place = |[x, z]: [f64; 2]| [RIM + scale * (x - left), RIM + scale * (high - z)];
    let (width, height) = (WIDE + 2.0 * RIM, scale * (high - low) + 2.0 * RIM);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.1} {height:.1}\" font-family=\"sans-serif\">\n"
    );
    match background(drawn, path, bytes) {
        Some(data) => {
            let (wide, high) = (WIDE, scale * (high - low));
            let _ = writeln!(
                text,
                "<image x=\"{RIM}\" y=\"{RIM}\" width=\"{wide:.1}\" height=\"{high:.1}\" opacity=\"0.6\" href=\"{data}\"/>"
            );
        }
        None => {
            for outline in &drawn.outlines {
                let points = points(outline.iter().copied().map(place));
                let _ = writeln!(
                    text,
                    "<polygon points=\"{points}\" fill=\"#f4c9b8\" stroke=\"#c0552d\" stroke-width=\"0.8\"/>"
                );
            }
        }
    }
    let stones: Vec<(&Block, u64)> = file
        .wall
        .blocks
        .iter()
        .zip(file.ids.iter().copied())
        .filter(|(block, _)| block.support == Support::Free)
        .collect();
    for (block, id) in stones {
        let across = |v: &Vec3| if drawn.section { v.y } else { v.x };
        let face = Polygon::around(block.shape.vertices.iter().map(|v| [across(v), v.z]).collect());
        let outline = points(face.vertices.iter().copied().map(place));
        let [x, y] = place(face.moments().centroid());
        let size = (NUMBER * scale * face.area().sqrt()).min(HIGHEST);
        let _ = writeln!(
            text,
            "<polygon points=\"{outline}\" fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"1.2\"/><text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"{size:.1}\" \
             text-anchor=\"middle\" fill=\"#10305a\" stroke=\"#ffffff\" stroke-width=\"2\" paint-order=\"stroke\">{id}</text>",
            y + 0.35 * size
        );
    }
    text.push_str("</svg>\n");
    Some(text)
}

/// The picture itself, as far as a browser shows it.
fn background(drawn: &Drawn, path: &Path, bytes: &[u8]) -> Option<String> {
    drawn.frame?;
    let kind = match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "png" => "png",
        "jpg" | "jpeg" => "jpeg",
        _ => return None,
    };
    (bytes.len() <= MOST_BYTES).then(|| format!("data:image/{kind};base64,{}", BASE64_STANDARD.encode(bytes)))
}

fn points(places: impl Iterator<Item = [f64; 2]>) -> String {
    let all: Vec<String> = places.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
    all.join(" ")
}
